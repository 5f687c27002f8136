//! Finished runs.

use std::fs;

use super::super::*;
use super::stage::{Stage, windy};
use crate::preview::FrameStatus;

#[test]
fn a_finished_run_can_be_scrubbed_and_not_changed() {
    let stage = Stage::set();
    let mut p = stage.open(Source::Run(stage.finished_run()), true);
    p.until_opened();
    assert_eq!(p.frame(3).number, 3);
    assert_eq!(p.statuses(), "rrrr");
    p.act(windy(1.0));
    assert!(p.0.state.messages.last().unwrap().text.contains("finished run"));
    assert_eq!(p.0.simulated(), 0);
}

#[test]
fn of_a_finished_run_a_frame_that_cannot_be_read_is_named_with_the_reason_and_the_others_are_shown()
{
    let stage = Stage::set();
    let run = stage.finished_run();
    fs::write(run.join("frames/000002.sfr"), "no state").unwrap();
    let mut p = stage.open(Source::Run(run), true);
    p.until("word of the frame", |p| {
        p.state.messages.iter().any(|m| m.text.contains("frame 2 of the run cannot be shown"))
    });
    let text = &p.0.state.messages.last().unwrap().text;
    assert!(text.contains("000002.sfr") && text.contains("not a shotsilk state"), "{text}");
    assert!(!text.contains("made again"), "{text}");
    assert_eq!(p.frame(3).number, 3);
    assert_eq!(p.0.simulated(), 0);
}

#[test]
fn frames_that_a_run_lacks_are_named_when_it_is_opened() {
    for (lacks, words) in [
        (vec![1], "frame 1 is missing in the run"),
        (vec![1, 2], "2 frames are missing in the run, the first is 1"),
    ] {
        let stage = Stage::set();
        let run = stage.finished_run();
        for number in &lacks {
            fs::remove_file(run.join(format!("frames/{number:06}.sfr"))).unwrap();
        }
        let mut p = stage.open(Source::Run(run), false);
        p.until_opened();
        assert_eq!(p.0.state.messages.last().unwrap().text, words);
        assert_eq!(p.0.timeline().status(1), FrameStatus::Missing);
    }
}
