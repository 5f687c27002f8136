//! Frames in memory, on disk and gone.

use super::super::*;
use super::stage::{LAST, Stage, bits, windy};
use crate::preview::Reach;

#[test]
fn without_a_disk_the_memory_budget_holds_and_the_simulation_halts() {
    let stage = Stage::set();
    let mut p = stage.open_with(Source::Shot(stage.request()), true, None, 20_000);
    p.until("the halt", |p| !p.state.simulating);
    assert!(p.0.state.messages.last().unwrap().text.contains("do not fit"));
    assert!(p.0.store().used() <= 20_000 || p.0.store().len() == 1);
}

#[test]
fn frames_that_less_memory_has_no_room_for_are_said_to_be_gone() {
    let stage = Stage::set();
    let mut p = stage.open_with(Source::Shot(stage.request()), true, None, 64 << 20);
    p.until_done();
    p.0.set_budget(20_000);
    assert!(p.0.state.messages.last().unwrap().text.contains("do not fit"));
    assert!(!p.0.state.simulating && p.statuses().contains('.'));
}

#[test]
fn of_frames_that_are_gone_nothing_is_remembered() {
    let stage = Stage::set();
    let mut p = stage.open_with(Source::Shot(stage.request()), true, None, 20_000);
    for wind in [1.0, 2.0, 3.0, 4.0] {
        p.until("the halt", |p| !p.state.simulating);
        p.act(windy(wind));
        p.act(Action::SetReach { reach: Reach::FromStart });
        p.until_opened();
        let known = p.0.timeline().known_count();
        assert!(known <= p.0.store().len(), "{known}");
        p.act(Action::Simulate { on: true });
    }
}

#[test]
fn frames_survive_a_restart_and_are_not_computed_again() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let last = bits(&p.frame(LAST));
    p.until("all on disk", |p| {
        p.timeline().keys().iter().flatten().all(|&key| p.store().is_on_disk(key))
    });
    drop(p);
    let mut p = stage.start(true);
    p.until_done();
    assert_eq!(bits(&p.frame(LAST)), last);
    assert_eq!(p.0.simulated(), 0);
}

#[test]
fn memory_for_two_frames_is_enough_to_scrub_all() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.until("all on disk", |p| {
        p.timeline().keys().iter().flatten().all(|&key| p.store().is_on_disk(key))
    });
    let budget = 2 * p.0.store().used() / (u64::from(LAST) + 1);
    let _ = p.0.frames.store.set_budget(budget);
    for number in [0, 11, 3, 7, 12, 1] {
        assert_eq!(p.frame(number).number, number);
        assert!(p.0.store().used() <= budget);
    }
    assert_eq!(p.0.simulated(), u64::from(LAST) + 1);
}
