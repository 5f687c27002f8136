//! The costs' panel.

use super::seat::Seat;
use crate::preview::stage::LAST;

#[test]
fn costs_are_summed_up_and_compared_with_the_adaptive_run() {
    let mut seat = Seat::take_simulated();
    assert!(seat.mentions(&format!("{} frames, ", LAST + 1)) && seat.mentions(" faces, "));
    assert!(!seat.mentions("the speed of adaptive"));
    seat.click("compare with adaptive");
    assert!(seat.previewer().rival().0);
    seat.until("all costs", |p| {
        p.rival_costs().len() == LAST as usize + 1 && p.rival_costs().iter().all(Option::is_some)
    });
    assert!(seat.mentions(&format!("of its faces over {} frames", LAST + 1)));
    seat.click("compare with adaptive");
    assert!(!seat.previewer().rival().0);
}

#[test]
fn nothing_is_summed_up_before_there_is_a_frame() {
    let mut seat = Seat::take();
    assert!(!seat.mentions(" faces, "));
    seat.click("Costs");
    assert!(!seat.is_offered("compare with adaptive"));
    seat.click("Costs");
    for quantity in ["seconds a frame", "seconds in all", "stages", "faces"] {
        seat.click(quantity);
    }
}
