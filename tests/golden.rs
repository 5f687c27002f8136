//! Golden pictures: each folder of `tests/golden` but `states` is one, with `expected.png` and
//! `tolerance.json`. What a folder draws stands in [`PICTURES`]; the states drawn are committed
//! files, so that a change of the simulation changes no picture.
//!
//! A failure leaves the picture and the difference in the target folder. `SHOTSILK_BLESS=1` takes
//! new pictures as expected: look at them first.

#[path = "support/golden_image.rs"]
mod golden_image;
#[path = "support/wavy_state.rs"]
mod wavy_state;

use std::path::Path;
use std::sync::{LazyLock, Mutex, PoisonError};

use glam::{DVec2, DVec3};
use image::RgbaImage;
use shotsilk::render::{
    AdapterChoice, Bounds, CameraTrail, ColourBy, Headless, LogRange, PictureOptions, ShotCamera,
    WitnessSubject, witness_view,
};
use shotsilk::sheet::{self, Caption, SheetItem, SheetOptions};
use shotsilk::shot::View;
use wavy_state::State;

const SIZE: [u32; 2] = [640, 360];

type Drawing = fn(&mut Headless) -> RgbaImage;

/// Folders and what is drawn in them.
const PICTURES: [(&str, Drawing); 6] = [
    ("shot", |h| shot(h, &options(ColourBy::ViewFactor(NU)))),
    ("witness", |h| witness(h, 0.0, &options(ColourBy::ViewFactor(NU)))),
    ("plain", |h| shot(h, &PictureOptions { wire_strength: 0.0, ..options(ColourBy::Plain) })),
    ("edge_size", |h| shot(h, &options(ColourBy::EdgeSize(LogRange { start: 0.01, end: 0.2 })))),
    ("strain", |h| shot(h, &options(ColourBy::Strain { limit: 0.1 }))),
    ("sheet", contact_sheet),
];

const NU: LogRange = LogRange { start: 1.0, end: 0.01 };

static HEADLESS: LazyLock<Mutex<Headless>> = LazyLock::new(|| {
    Mutex::new(Headless::new(&AdapterChoice::Software).expect("the software adapter is installed"))
});

fn state() -> State {
    if golden_image::blessing() {
        return wavy_state::wavy();
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/states/wavy.json");
    let text = std::fs::read_to_string(&root).expect("the state is committed");
    serde_json::from_str(&text).expect("the state is whole")
}

fn options(colour_by: ColourBy) -> PictureOptions {
    PictureOptions {
        size: Some(SIZE),
        colour_by,
        ground_height: Some(0.0),
        legend_px: Some(11.0),
        ..Default::default()
    }
}

/// The camera drives around the scene; `time` in 0..1.
fn camera(time: f64) -> View {
    let angle = -0.9 + 0.9 * time;
    let eye = DVec3::new(2.6 * angle.sin(), -2.6 * angle.cos(), 1.25 + 0.2 * time);
    let back = (eye - DVec3::new(0.12, 0.0, 0.82)).normalize();
    let right = DVec3::Z.cross(back).normalize();
    let half_gate = DVec2::new(16.0 / 9.0, 1.0) * 0.36;
    View {
        eye,
        right,
        up: back.cross(right),
        back,
        gate_min: -half_gate,
        gate_max: half_gate,
        near: 0.1,
        far: 80.0,
        resolution: [1280, 720],
    }
}

/// The drive, and a cut to a close-up after it.
fn trail() -> CameraTrail {
    let drive = (0..=24).map(|i| camera(f64::from(i) / 24.0).eye);
    let close_up = (0..=8).map(|i| DVec3::new(1.1 + 0.08 * f64::from(i), -1.5, 0.75));
    CameraTrail { eyes: drive.chain(close_up).collect(), keys: vec![0, 12, 24, 33], cuts: vec![25] }
}

fn shot(headless: &mut Headless, options: &PictureOptions) -> RgbaImage {
    let state = state();
    headless.picture(&state.frame(), &state.surfaces(), &camera(0.0), options).expect("a picture")
}

fn witness(headless: &mut Headless, time: f64, options: &PictureOptions) -> RgbaImage {
    let state = state();
    let (frame, surfaces) = (state.frame(), state.surfaces());
    let cloth = Bounds::of_cloth(&frame);
    let trail = trail();
    let mut subject =
        WitnessSubject { cloth, views: (0..=6).map(|i| camera(f64::from(i) / 6.0)).collect() };
    for (surface, pose) in surfaces.iter().zip(&frame.obstacle_poses) {
        subject = subject.with_obstacle(&surface.positions, *pose);
    }
    let view = camera(time);
    let depth = ShotCamera::frustum_depth_past(&view, cloth);
    let shot_camera = ShotCamera { view: &view, trail: &trail, frustum_depth: depth, ghost: None };
    let placed = witness_view(&subject, SIZE);
    headless.witness_picture(&frame, &surfaces, &placed, &shot_camera, options).expect("a picture")
}

fn contact_sheet(headless: &mut Headless) -> RgbaImage {
    let state = state();
    let (frame, surfaces) = (state.frame(), state.surfaces());
    let options = PictureOptions {
        size: Some([320, 180]),
        legend_px: None,
        wire_strength: 0.4,
        ..options(ColourBy::ViewFactor(NU))
    };
    let items: Vec<SheetItem> = (0..6)
        .map(|i| {
            let time = f64::from(i) / 5.0;
            let view = camera(time);
            SheetItem {
                shot: headless.picture(&frame, &surfaces, &view, &options).expect("a picture"),
                witness: witness(headless, time, &options),
                caption: Caption {
                    frame: 1001 + 5 * i64::from(i),
                    face_count: frame.face_count(),
                    wall_seconds: Some(1.92 + time),
                    view_factor_mean: Some(0.43),
                },
            }
        })
        .collect();
    let options = SheetOptions {
        title: "wavy".into(),
        subtitle: "frames 1001 to 1026, every 5th".into(),
        ..Default::default()
    };
    sheet::compose(&items, &options)
}

fn check(name: &str) {
    let (_, draw) = PICTURES.into_iter().find(|(n, _)| *n == name).expect("a known picture");
    let picture = draw(&mut HEADLESS.lock().unwrap_or_else(PoisonError::into_inner));
    golden_image::check(name, &picture);
}

macro_rules! goldens {
    ($($test:ident: $name:literal),+ $(,)?) => {
        $(
            #[test]
            fn $test() {
                check($name);
            }
        )+

        #[test]
        fn every_golden_picture_has_a_test() {
            let tested = [$($name),+];
            assert!(PICTURES.iter().all(|(name, _)| tested.contains(name)));
        }
    };
}

goldens! {
    the_shot_view_looks_as_accepted: "shot",
    the_witness_view_looks_as_accepted: "witness",
    plain_cloth_looks_as_accepted: "plain",
    edge_size_looks_as_accepted: "edge_size",
    strain_looks_as_accepted: "strain",
    the_contact_sheet_looks_as_accepted: "sheet",
}

#[test]
fn the_committed_state_is_what_its_recipe_makes() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/states/wavy.json");
    let made = serde_json::to_string(&wavy_state::wavy()).unwrap();
    if golden_image::blessing() {
        std::fs::write(&path, &made).unwrap();
    }
    // Sines differ in the last bit between machines: the shape must agree, not the text.
    let (made, committed) = (wavy_state::wavy(), state());
    assert!(made.is_close_to(&committed));
}
