//! The costs' panel.

use super::seat::Seat;
use crate::preview::stage::{LAST, windy};
use crate::preview::{Action, FrameStatus};

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

#[test]
fn frames_of_other_settings_are_left_out_of_the_sums() {
    let mut seat = Seat::take_simulated();
    seat.act(Action::Simulate { on: false });
    seat.act(Action::GoTo { frame: 6 });
    seat.act(windy(3.0));
    seat.until_planned();
    assert!(seat.mentions(&format!("no frame of these settings yet ({} stale", LAST + 1)));
    seat.act(Action::Simulate { on: true });
    seat.until("mixed frames", |p| p.timeline().status(LAST) == FrameStatus::Mixed);
    assert!(seat.mentions(&format!("{} frames, ", LAST - 6)));
    assert!(seat.mentions("(7 stale left out)"));
}
