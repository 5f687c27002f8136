use std::time::Instant;

use super::*;
use crate::app::tests::seat::{Setting, desk_at};
use crate::preview::Action;
use crate::preview::stage::{self, LAST, Stage};

/// At which something is asked for that nobody ever does.
fn desk(stage: &Stage) -> Desk {
    let mut desk = desk_at(stage, &Setting::default());
    desk.act(Action::Play);
    desk
}

fn step(player: &mut Player, desk: &mut Desk, now: f64) -> Result<Request> {
    player.step(desk, &mut RawInput::default(), now)
}

#[test]
fn a_script_waits_for_its_end_as_long_as_for_a_step() {
    let stage = Stage::set();
    for steps in [vec![], vec![ScriptStep::WaitUntilIdle]] {
        let (mut desk, mut player) = (desk(&stage), Player::new(steps));
        for now in [7.0, 7.0 + PATIENCE] {
            assert_eq!(step(&mut player, &mut desk, now).unwrap(), Request::Nothing);
            assert!(!player.is_done(&desk));
        }
        let why = step(&mut player, &mut desk, 7.1 + PATIENCE).unwrap_err().to_string();
        assert!(why.contains("has waited for 600 s"), "{why}");
    }
}

#[test]
fn the_wait_for_the_end_begins_behind_the_last_step() {
    let stage = Stage::set();
    let (mut desk, mut player) = (desk(&stage), Player::new(vec![ScriptStep::ClearPace]));
    for now in [0.0, 500.0, 500.0 + PATIENCE] {
        assert_eq!(step(&mut player, &mut desk, now).unwrap(), Request::Nothing);
    }
    assert!(step(&mut player, &mut desk, 500.1 + PATIENCE).is_err());
}

#[test]
fn a_script_waits_as_long_as_frames_come() {
    let stage = Stage::set();
    let steps = vec![ScriptStep::WaitForFrames { first: 0, last: LAST + 1 }];
    let (mut desk, mut player) = (desk(&stage), Player::new(steps));
    assert_eq!(step(&mut player, &mut desk, 0.0).unwrap(), Request::Nothing);
    desk.act(Action::Simulate { on: true });
    let before = desk.work_done();
    let began = Instant::now();
    while desk.has_actions() || desk.is_busy() || desk.work_done() == before {
        desk.advance(0.0);
        assert!(began.elapsed() < stage::PATIENCE);
    }
    for now in [PATIENCE - 1.0, PATIENCE + 500.0, 2.0 * PATIENCE - 1.0] {
        assert_eq!(step(&mut player, &mut desk, now).unwrap(), Request::Nothing);
    }
    assert!(step(&mut player, &mut desk, 2.0 * PATIENCE).is_err());
}

#[test]
fn a_drag_ends_where_it_should_with_the_button_let_go() {
    let stage = Stage::set();
    let drag = ScriptStep::Drag {
        from: [10.0, 20.0],
        to: [50.0, 60.0],
        button: crate::app::script::Button::Middle,
    };
    let (mut desk, mut player) = (desk(&stage), Player::new(vec![drag]));
    let mut events = Vec::new();
    for pass in 0..20 {
        let mut input = RawInput::default();
        player.step(&mut desk, &mut input, f64::from(pass)).unwrap();
        assert!(input.events.len() <= 1, "an input a pass");
        events.extend(input.events);
    }
    let button = |pos: egui::Pos2, pressed: bool| Event::PointerButton {
        pos,
        button: egui::PointerButton::Middle,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    let [from, to] = [egui::pos2(10.0, 20.0), egui::pos2(50.0, 60.0)];
    assert_eq!(events[..2], [Event::PointerMoved(from), button(from, true)]);
    let end = events.len() - 2;
    assert_eq!(events[end..], [Event::PointerMoved(to), button(to, false)]);
}
