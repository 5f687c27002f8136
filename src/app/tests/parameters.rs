//! The settings' panel.

use egui::accesskit::Role;
use serde_json::json;

use super::seat::{Seat, Setting};
use crate::preview::{parameters, stage::SHOT};

const NU_OUT: &str = "Detail out of frame";

fn edits(seat: &Seat) -> Vec<String> {
    seat.previewer().state().version.edits.overrides()
}

#[test]
fn a_slider_sets_its_setting_and_reset_takes_it_back() {
    let mut seat = Seat::take();
    assert!(!seat.is_offered("reset") && !seat.is_offered("Reset all"));
    seat.node(Role::Slider, NU_OUT).set_value_accesskit(0.05);
    seat.until_planned();
    assert_eq!(edits(&seat), ["view.nu_out=0.05"]);
    assert_eq!(seat.previewer().scenery().unwrap().view_settings[0].nu_out, 0.05);
    seat.click("reset");
    seat.until_planned();
    assert_eq!(edits(&seat), [""; 0]);
    assert_eq!(seat.previewer().scenery().unwrap().view_settings[0].nu_out, 0.2);
    seat.click("Undo");
    seat.until_planned();
    assert_eq!(edits(&seat), ["view.nu_out=0.05"]);
}

#[test]
fn all_settings_are_reset_at_once() {
    let mut seat = Seat::take();
    for (name, value) in [(NU_OUT, 0.05), ("Margin around the frame", 0.5)] {
        seat.node(Role::Slider, name).set_value_accesskit(value);
        seat.until_planned();
    }
    assert_eq!(edits(&seat).len(), 2);
    seat.click("Reset all");
    seat.until_planned();
    assert_eq!(edits(&seat), [""; 0]);
}

#[test]
fn a_setting_says_the_formats_own_sentence_its_range_default_and_path() {
    let mut seat = Seat::take();
    let plan = seat.previewer().plan().unwrap().clone();
    let all = parameters(&plan.requested.written, &plan.requested.scene);
    let nu_out = all.iter().find(|parameter| parameter.path == "view.nu_out").unwrap();
    assert!(!nu_out.help.is_empty() && !seat.mentions(&nu_out.help));
    seat.point_at(NU_OUT);
    for words in [&nu_out.help, "usual range 0.001 to 1", "default 0.01", "view.nu_out"] {
        assert!(seat.mentions(words), "{words:?}");
    }
}

#[test]
fn a_criterion_can_be_off() {
    let mut seat = Seat::take();
    seat.unfold("Sizing: sheet");
    let name = "Change of speed";
    assert!(!seat.says("off"));
    seat.tick(name);
    seat.until_planned();
    assert_eq!(edits(&seat), ["garments.0.sizing.refine_velocity=null"]);
    assert!(seat.says("off"));
    seat.tick(name);
    seat.until_planned();
    assert_eq!(edits(&seat), ["garments.0.sizing.refine_velocity=0.5"]);
    assert!(!seat.says("off"));
}

#[test]
fn garments_of_one_shot_have_view_settings_of_their_own() {
    let one = "\"garments\": [{";
    let another =
        "\"garments\": [{\"name\": \"cape\", \"mesh\": \"sheet.obj\", \"fabric\": \"cloth\"}, {";
    let shot = SHOT.replace(one, another);
    assert_ne!(shot, SHOT);
    let mut seat = Seat::take_with(Setting { shot, ..Setting::default() });
    seat.unfold("View");
    seat.unfold("View: cape");
    seat.node(Role::Slider, NU_OUT).set_value_accesskit(0.5);
    seat.until_planned();
    assert_eq!(edits(&seat), ["garments.0.view.nu_out=0.5"]);
    let scene = &seat.previewer().plan().unwrap().requested.scene;
    let own: Vec<_> = scene.garments.iter().map(|garment| json!(garment.view.nu_out)).collect();
    assert_eq!(own, [json!(0.5), json!(0.2)]);
}
