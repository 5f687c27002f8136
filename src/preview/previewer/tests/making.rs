//! The simulation, what stops it and what it costs.

use std::time::{Duration, Instant};

use serde_json::json;

use super::super::*;
use super::stage::{LAST, Stage, windy};
use crate::preview::FrameStatus;

#[test]
fn the_adaptive_run_counts_costs_and_keeps_no_frames() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let (used, simulated) = (p.0.store().used(), p.0.simulated());
    p.act(Action::MeasureAdaptive { on: true });
    p.until("all costs", |p| {
        p.rival_costs().len() == LAST as usize + 1 && p.rival_costs().iter().all(Option::is_some)
    });
    assert_eq!((p.0.store().used(), p.0.simulated()), (used, simulated));
}

#[test]
fn the_adaptive_run_and_its_costs_end_where_a_finished_run_is_opened() {
    let stage = Stage::set();
    let run = stage.finished_run();
    let mut p = stage.opened();
    p.act(Action::MeasureAdaptive { on: true });
    p.until("a cost", |p| p.rival_costs().iter().any(Option::is_some));
    p.act(Action::Open { path: run });
    p.until_opened();
    assert!(matches!(p.0.source(), Source::Run(_)));
    assert_eq!(p.0.rival(), (false, false));
    assert!(p.0.rival_costs().is_empty());
    p.act(Action::MeasureAdaptive { on: true });
    assert_eq!(p.0.rival(), (false, false));
}

#[test]
fn after_a_step_that_failed_the_simulation_goes_on_with_the_next_settings() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::GoTo { frame: 4 });
    p.act(Action::Set { path: "gravity".into(), value: json!([0.0, 0.0, -1e300]) });
    p.wait_for(|p| p.failed_frame() == Some(5));
    let said = p.0.state.messages.last().unwrap().text.clone();
    assert!(
        said.starts_with("frame 5 cannot be simulated with these settings: the step"),
        "{said}"
    );
    assert!(p.0.state.simulating && !p.0.is_working());
    // It is not tried again until somebody asks.
    p.act(Action::GoTo { frame: 0 });
    assert!(!p.0.is_working());
    p.act(Action::Simulate { on: p.0.would_simulate() });
    assert!(p.0.is_working());
    p.wait_for(|p| p.failed_frame() == Some(5));
    // Halted or not, it is said no more when other settings are in force.
    p.act(Action::Simulate { on: false });
    p.act(Action::Undo);
    p.wait_for(|p| p.timeline().is_clean(0, LAST) && p.failed_frame().is_none());
    assert!(p.0.state.messages.is_empty(), "{:?}", p.0.state.messages);
    p.act(Action::Simulate { on: p.0.would_simulate() });
    p.act(windy(3.0));
    p.until("frames of other settings", |p| {
        !p.is_opening() && p.timeline().status(LAST) == FrameStatus::Ready
    });
}

#[test]
fn what_a_frame_cost_is_known_when_the_shot_is_opened_again() {
    let stage = Stage::set();
    let run = stage.finished_run();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::Open { path: run });
    p.until_opened();
    p.act(Action::Open { path: stage.shot() });
    p.until("the frames again", |p| !p.is_opening() && p.timeline().slot(3).is_some());
    let costs = |p: &Previewer| (0..4).all(|f| p.timeline().slot(f).unwrap().cost.is_some());
    assert!(costs(&p.0));
}

#[test]
fn the_same_warning_of_many_frames_is_said_once() {
    let stage = Stage::set();
    let mut p = stage.opened();
    for (shown, warning) in
        [(3, "3 crossings"), (4, "12 crossings"), (4, "thin"), (5, "1 crossings")]
    {
        p.0.warn_of_frame(shown, warning);
    }
    let said: Vec<&str> = p.0.state.messages.iter().map(|m| &*m.text).collect();
    assert_eq!(said, ["frame 4: thin", "frame 5: 1 crossings (and 2 frames before it likewise)"]);
    let text = said[1].to_owned();
    p.act(Action::DismissMessage { text });
    p.0.warn_of_frame(6, "2 crossings");
    assert_eq!(p.0.state.messages.last().unwrap().text, "frame 6: 2 crossings");
    // Made again, frames do not count those behind them, nor themselves.
    p.0.warn_of_frame(5, "7 crossings");
    assert_eq!(p.0.state.messages.last().unwrap().text, "frame 5: 7 crossings");
    p.0.warn_of_frame(6, "7 crossings");
    let said = "frame 6: 7 crossings (and a frame before it likewise)";
    assert_eq!(p.0.state.messages.last().unwrap().text, said);
    // With other settings they are other frames.
    p.act(windy(2.0));
    p.until_opened();
    assert!(p.0.state.messages.is_empty());
}

#[test]
fn dropped_while_it_works_it_ends_at_once() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until("a frame", |p| p.timeline().slot(1).is_some());
    let began = Instant::now();
    drop(p);
    assert!(began.elapsed() < Duration::from_millis(500));
}
