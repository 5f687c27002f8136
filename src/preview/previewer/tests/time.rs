//! Playing.

use super::super::*;
use super::stage::{LAST, Stage};
use crate::preview::FrameStatus;

#[test]
fn playing_keeps_the_rate_and_drops_frames_rather_than_time() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::GoTo { frame: 0 });
    p.act(Action::SetLooping { on: false });
    p.act(Action::Play);
    assert_eq!(p.0.tick(10.0), Some(10.0 + 1.0 / 24.0));
    p.0.tick(10.0 + 5.5 / 24.0);
    assert_eq!(p.0.state.playback.current, 5);
    assert_eq!(p.0.tick(10.0 + 13.5 / 24.0), None);
    assert_eq!((p.0.state.playback.current, p.0.state.playback.playing), (LAST, false));
    p.act(Action::SetLooping { on: true });
    p.act(Action::SetIn { frame: 3 });
    p.act(Action::SetOut { frame: 5 });
    p.act(Action::Play);
    p.0.tick(20.0);
    assert_eq!(p.0.state.playback.current, 3);
    for (passed, frame) in [(2.5, 5), (3.2, 3), (4.2, 4), (7.9, 4), (300.2, 3)] {
        p.0.tick(20.0 + passed / 24.0);
        assert_eq!(p.0.state.playback.current, frame, "after {passed} frames");
    }
}

#[test]
fn playing_waits_for_frames_that_are_not_there_yet() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until("some frames", |p| p.timeline().slot(4).is_some());
    p.act(Action::Simulate { on: false });
    p.act(Action::GoTo { frame: 0 });
    p.act(Action::Play);
    p.0.tick(0.0);
    p.0.tick(100.0);
    let current = p.0.state.playback.current;
    assert!(current >= 4 && p.0.state.playback.playing);
    if current < LAST {
        assert_eq!(p.0.timeline().status(current + 1), FrameStatus::Missing);
    }
}
