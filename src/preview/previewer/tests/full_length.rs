//! A shot of usual length: what an edit of its camera costs, and that it costs nothing else.

use std::fs;

use glam::DVec3;

use super::stage::{SHOT, Stage, bits};
use crate::preview::{Action, Source};
use crate::request::{FrameRange, Request};
use crate::sim::Simulation;

const LAST: u32 = 150;
const ANTICIPATION: u32 = 5;
/// The camera's run with the moved key begins with a cut here.
const CUT: u32 = 60;
const MOVED: u32 = 100;

fn shot() -> String {
    let keys = r#"
            {"frame": 0, "eye": [0, -3, 0.2], "target": [0, 0, 0.2]},
            {"frame": 30, "eye": [0.4, -3, 0.2], "target": [0.2, 0, 0.2]},
            {"frame": 60, "eye": [0, -3, 0.2], "target": [0.6, 0, 0.2], "cut": true},
            {"frame": 100, "eye": [0.5, -3, 0.2], "target": [0.3, 0, 0.2]},
            {"frame": 150, "eye": [0, -3, 0.2], "target": [0, 0, 0.2]}
        "#;
    let (start, end) = (SHOT.find("\"keys\": [").unwrap() + 9, SHOT.rfind("]\n    }").unwrap());
    let shot = format!("{}{keys}{}", &SHOT[..start], &SHOT[end..]);
    // A wind that folds it, so that there is detail to lose.
    let shot = shot
        .replace(
            "\"steps_per_frame\": 2,",
            "\"steps_per_frame\": 2, \"air\": {\"velocity\": [3, 2, 0]},",
        )
        .replace("\"sizing\": {", "\"sizing\": {\"refine_angle\": 0.1, ");
    shot.replace("\"anticipation_frames\": 2", &format!("\"anticipation_frames\": {ANTICIPATION}"))
}

#[test]
fn a_key_moved_at_frame_100_of_150_has_nothing_computed_again_before_its_cut_and_gives_a_fresh_runs_bits()
 {
    let stage = Stage::set();
    fs::write(stage.shot(), shot()).unwrap();
    let frames = Some(FrameRange { first: 0, last: LAST });
    let mut p = stage.open(Source::Shot(Request { frames, ..stage.request() }), true);
    p.until_done();
    let frame_count = u64::from(LAST) + 1;
    assert_eq!(p.0.simulated(), frame_count);
    let (before, seen_before) = (p.0.timeline().keys(), bits(&p.frame(LAST)));
    p.act(Action::GoTo { frame: MOVED });
    p.act(Action::MoveCamera {
        eye: DVec3::new(0.5, -3.0, 0.4),
        // Past the sheet.
        target: DVec3::new(3.0, 0.0, 0.2),
    });
    p.act(Action::SetKey);
    p.until_done();
    assert_eq!(p.statuses(), "r".repeat(frame_count as usize));
    let kept = p.0.timeline().keys().iter().zip(&before).take_while(|(a, b)| a == b).count();
    assert!(kept >= (CUT - ANTICIPATION) as usize, "only {kept} frames are kept");
    assert!(kept <= MOVED as usize, "the moved key is not seen at all: {kept} frames are kept");
    assert_eq!(p.0.simulated(), 2 * frame_count - kept as u64);

    // The edit is no small matter: detail that the camera does not see is gone.
    assert_ne!(bits(&p.frame(LAST)), seen_before);
    let plan = p.0.plan().unwrap().clone();
    let (mut fresh, frame) =
        Simulation::start(plan.requested.scene.clone(), plan.settings()).unwrap();
    assert_eq!(bits(&p.frame(0)), bits(&frame));
    for number in 1..=LAST {
        assert_eq!(bits(&p.frame(number)), bits(&fresh.advance().unwrap()), "frame {number}");
    }
}
