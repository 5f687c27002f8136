//! Properties of pictures, by counting pixels. They draw with the software adapter and fail
//! without one.

use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use glam::DVec3;
use image::{Rgba, RgbaImage};

use super::fixture::{flat, frame, look_at, overhead, square};
use super::*;
use crate::shot::View;

static HEADLESS: LazyLock<Mutex<Headless>> = LazyLock::new(|| {
    Mutex::new(Headless::new(&AdapterChoice::Software).expect("the software adapter is installed"))
});

fn headless() -> MutexGuard<'static, Headless> {
    HEADLESS.lock().unwrap_or_else(PoisonError::into_inner)
}

const SIZE: [u32; 2] = [200, 200];
const BACKGROUND: Srgb = Srgb([250, 250, 250]);

/// Nothing but the surfaces, on an even background.
fn bare(colour_by: ColourBy) -> PictureOptions {
    PictureOptions {
        colour_by,
        wire_strength: 0.0,
        background: Background { top: BACKGROUND, bottom: BACKGROUND },
        ..Default::default()
    }
}

fn count(image: &RgbaImage, wanted: impl Fn([u8; 3]) -> bool) -> usize {
    image.pixels().filter(|&&Rgba([r, g, b, _])| wanted([r, g, b])).count()
}

fn covered(image: &RgbaImage) -> usize {
    count(image, |pixel| pixel != BACKGROUND.0)
}

fn centre(image: &RgbaImage) -> [f32; 3] {
    let Rgba([r, g, b, _]) = *image.get_pixel(image.width() / 2, image.height() / 2);
    [r, g, b].map(f32::from)
}

fn view_factor() -> ColourBy {
    ColourBy::ViewFactor(LogRange { start: 1.0, end: 0.01 })
}

#[test]
fn a_triangle_over_half_the_frame_covers_half_the_pixels() {
    let half = flat(&[[[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0]]]);
    let options = bare(ColourBy::Plain);
    let image = headless().picture(&frame([half]), &[], &overhead(SIZE), &options).unwrap();
    let share = covered(&image) as f64 / 40_000.0;
    assert!((share - 0.5).abs() < 0.006, "{share}");
    // The lower right half, not a mirrored one.
    assert_ne!(image.get_pixel(150, 180).0[..3], BACKGROUND.0);
    assert_eq!(image.get_pixel(50, 20).0[..3], BACKGROUND.0);
}

#[test]
fn the_nearer_cloth_hides_the_farther_in_either_order() {
    let (near, far) = (square(0.3, 1.0), square(0.0, 0.01));
    let options = bare(view_factor());
    for order in [[near.clone(), far.clone()], [far, near]] {
        let image = headless().picture(&frame(order), &[], &overhead(SIZE), &options).unwrap();
        let [r, _, b] = centre(&image);
        assert!(b > r + 40.0, "the near cloth is blue, the pixel {r} {b}");
    }
}

#[test]
fn both_sides_of_cloth_are_lit_and_told_apart() {
    let options = bare(ColourBy::Plain);
    let cloth = frame([square(0.0, 1.0)]);
    let [above, below] = [0.9, -0.9].map(|z| {
        let view = look_at(DVec3::new(0.0, -0.1, z), DVec3::ZERO, 40.0, SIZE);
        centre(&headless().picture(&cloth, &[], &view, &options).unwrap())
    });
    let brightest = |pixel: [f32; 3]| pixel.into_iter().fold(0.0, f32::max);
    assert!(brightest(above) > 110.0 && brightest(below) > 70.0, "{above:?} {below:?}");
    let difference: f32 = above.iter().zip(&below).map(|(a, b)| (a - b).abs()).sum();
    assert!(difference > 24.0, "{above:?} {below:?}");
}

#[test]
fn a_picture_has_the_brightness_of_its_colours() {
    let options = bare(ColourBy::Plain);
    let image = headless().picture(&frame([]), &[], &overhead(SIZE), &options).unwrap();
    assert!(image.pixels().all(|p| p.0 == BACKGROUND.with_alpha(255)), "the background is encoded");

    let options = bare(view_factor());
    let image = headless().picture(&frame([square(0.0, 1.0)]), &[], &overhead(SIZE), &options);
    let shown = centre(&image.unwrap());
    let table = ColourTable::ViewFactor.colour(0.0).0.map(f32::from);
    for (shown, table) in shown.into_iter().zip(table) {
        assert!((shown - table).abs() < 40.0, "lit {shown}, in the table {table}");
    }
}

#[test]
fn the_view_factor_is_blue_where_it_is_largest_and_red_where_smallest() {
    let options = bare(view_factor());
    let [blue, red] = [1.0, 0.01].map(|nu| {
        let cloth = frame([square(0.0, nu)]);
        centre(&headless().picture(&cloth, &[], &overhead(SIZE), &options).unwrap())
    });
    assert!(blue[2] > blue[0] + 50.0 && red[0] > red[2] + 50.0, "{blue:?} {red:?}");
}

#[test]
fn cloth_outside_the_frustum_draws_nothing() {
    let options = bare(ColourBy::Plain);
    for height in [2.0, 0.97, -100.0] {
        let cloth = frame([square(height, 1.0)]);
        let image = headless().picture(&cloth, &[], &overhead(SIZE), &options).unwrap();
        assert_eq!(covered(&image), 0, "cloth at {height} m");
    }
}

fn line_picture(view: &View, start: DVec3, end: DVec3, width_px: f32) -> RgbaImage {
    let mut list = DrawList::new(&frame([]), &[], &bare(ColourBy::Plain));
    list.push_line(start, end, [0, 0, 0, 255], width_px);
    headless().draw(&list, view, SIZE).unwrap()
}

#[test]
fn a_line_is_as_wide_on_the_image_as_it_says_at_any_distance() {
    for (z, width_px) in [(0.0, 1.0), (0.0, 3.0), (-5.0, 3.0), (0.8, 6.0)] {
        let (start, end) = (DVec3::new(-20.0, 0.0013, z), DVec3::new(20.0, 0.0013, z));
        let image = line_picture(&overhead(SIZE), start, end, width_px);
        let linear_ink: f32 = (0..SIZE[1])
            .map(|y| {
                let pixel = image.get_pixel(100, y).0;
                let white = BACKGROUND.linear().x;
                (white - Srgb([pixel[0], pixel[1], pixel[2]]).linear().x) / white
            })
            .sum();
        assert!((linear_ink - width_px).abs() < 0.25, "{linear_ink} px of {width_px} at {z} m");
    }
}

#[test]
fn a_line_through_the_eye_plane_is_cut_and_one_behind_is_not_drawn() {
    let view = overhead(SIZE);
    let through = line_picture(&view, DVec3::new(0.0, 0.2, 3.0), DVec3::new(0.0, 0.2, -3.0), 2.0);
    let ink = covered(&through);
    assert!(ink > 50 && ink < 2_000, "{ink}");
    assert!((101..200).all(|y| (0..200).all(|x| through.get_pixel(x, y).0[0] == 250)));
    let behind = line_picture(&view, DVec3::new(0.0, 0.2, 3.0), DVec3::new(0.3, 0.2, 1.5), 2.0);
    assert_eq!(covered(&behind), 0);
}

#[test]
fn the_wireframe_is_thin_and_follows_the_edges() {
    let cloth = frame([square(0.0, 1.0)]);
    let without = bare(view_factor());
    let with = PictureOptions { wire_strength: 1.0, ..without.clone() };
    let mut headless = headless();
    let mut picture = |o: &_| headless.picture(&cloth, &[], &overhead(SIZE), o).unwrap();
    let (without, with) = (picture(&without), picture(&with));
    let darker = |x: u32, y: u32| with.get_pixel(x, y).0[2] + 20 < without.get_pixel(x, y).0[2];
    let dark = (0..200).flat_map(|y| (0..200).map(move |x| (x, y))).filter(|&(x, y)| darker(x, y));
    let dark: Vec<_> = dark.collect();
    assert!((400..1_600).contains(&dark.len()), "{} px of edges", dark.len());
    // The diagonal from the lower left to the upper right.
    assert!((10..190).all(|x| darker(x, 199 - x) || darker(x, 200 - x)));
    assert!(!darker(50, 40) && !darker(150, 180));
}

#[test]
fn a_size_of_nothing_or_far_too_much_is_an_error() {
    let list = DrawList::new(&frame([]), &[], &PictureOptions::default());
    let mut headless = headless();
    assert!(matches!(
        headless.draw(&list, &overhead(SIZE), [0, 10]),
        Err(RenderError::Empty { .. })
    ));
    assert!(matches!(
        headless.draw(&list, &overhead(SIZE), [1 << 20, 10]),
        Err(RenderError::TooLarge { .. })
    ));
    headless.draw(&list, &overhead(SIZE), SIZE).expect("the device still draws");
}

#[test]
fn equal_lists_give_equal_pictures_whatever_was_drawn_before() {
    let options = PictureOptions::default();
    let small = frame([square(0.0, 1.0)]);
    let large = frame((0..40).map(|i| square(0.01 * f64::from(i), 0.1)));
    let mut headless = headless();
    let mut picture = |f: &_| headless.picture(f, &[], &overhead(SIZE), &options).unwrap();
    let first = picture(&small);
    picture(&large);
    assert!(first == picture(&small));
}

#[test]
fn a_line_behind_cloth_shines_through_faintly() {
    let view = overhead(SIZE);
    let across = [DVec3::new(-0.4, 0.0013, 0.0), DVec3::new(0.4, 0.0013, 0.0)];
    let darkness_at = |cloth_height: f64| {
        let options = bare(view_factor());
        let cloth = frame([square(cloth_height, 0.1)]);
        let mut list = DrawList::new(&cloth, &[], &options);
        let without = headless().draw(&list, &view, SIZE).unwrap();
        list.push_line(across[0], across[1], [0, 0, 0, 255], 3.0);
        let with = headless().draw(&list, &view, SIZE).unwrap();
        f32::from(without.get_pixel(100, 99).0[1]) - f32::from(with.get_pixel(100, 99).0[1])
    };
    let (in_front, behind) = (darkness_at(-0.3), darkness_at(0.3));
    assert!(in_front > 150.0, "{in_front}");
    assert!((5.0..60.0).contains(&behind), "{behind}");
}

#[test]
fn the_witness_sees_the_shot_cameras_body_and_frustum() {
    let cloth = frame([square(0.0, 1.0)]);
    let shot = look_at(DVec3::new(2.0, 0.5, 0.8), DVec3::ZERO, 30.0, [1280, 720]);
    let bounds = Bounds::of_cloth(&cloth);
    let subject = WitnessSubject { cloth: bounds, views: vec![shot] };
    let witness = witness_view(&subject, [400, 300]);
    let trail = CameraTrail { eyes: vec![shot.eye], ..Default::default() };
    let frustum_depth = ShotCamera::frustum_depth_past(&shot, bounds);
    assert!((2.5..3.5).contains(&frustum_depth), "{frustum_depth} m");
    let camera = ShotCamera { view: &shot, trail: &trail, frustum_depth, ghost: None };
    let options = bare(view_factor());
    let mut headless = headless();
    let picture = headless.witness_picture(&cloth, &[], &witness, &camera, &options).unwrap();
    let without = headless.picture(&cloth, &[], &witness, &options).unwrap();
    let dark = |image: &RgbaImage| count(image, |[r, g, b]| r.max(g).max(b) < 90);
    assert!(dark(&picture) > dark(&without) + 400, "{} px", dark(&picture));
    let body = witness.point_in_image(shot.eye + shot.back * 0.05).unwrap();
    assert!(picture.get_pixel(body.x as u32, body.y as u32).0[1] < 110);
}

#[test]
fn the_ghost_of_the_shot_camera_is_fainter_than_the_camera() {
    let view = overhead(SIZE);
    let trail = CameraTrail::default();
    // Both look across the picture from the left, one above the other.
    let looking_right = |y: f64| {
        let eye = DVec3::new(-0.4, y, 0.0);
        look_at(eye, eye + DVec3::X, 10.0, SIZE)
    };
    let (now, later) = (looking_right(0.25), looking_right(-0.25));
    let ink = |ghost: Option<&View>, rows: std::ops::Range<u32>| -> f64 {
        let camera = ShotCamera { view: &now, trail: &trail, frustum_depth: 0.6, ghost };
        let options = bare(ColourBy::Plain);
        let picture =
            headless().witness_picture(&frame([]), &[], &view, &camera, &options).unwrap();
        // The lines of the frustum, without the body.
        rows.flat_map(|y| (60..180).map(move |x| (x, y)))
            .map(|(x, y)| 250.0 - f64::from(picture.get_pixel(x, y).0[0]))
            .sum()
    };
    let (upper, lower) = (0..100, 100..200);
    assert_eq!(ink(None, lower.clone()), 0.0);
    assert_eq!(ink(Some(&now), upper.clone()), ink(None, upper.clone()), "it is not drawn twice");
    let (now_ink, later_ink) = (ink(Some(&later), upper), ink(Some(&later), lower));
    assert!(later_ink > 0.1 * now_ink && later_ink < 0.6 * now_ink, "{later_ink} of {now_ink}");
}

/// A face at a height that another one, at 0.3 m and above it, stands in.
fn crossing_at(height: f64) -> crate::sim::Frame {
    let lying = flat(&[[[-0.4, -0.4, height], [0.4, -0.4, height], [0.0, 0.4, height]]]);
    let mut standing = flat(&[[[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.0, 0.1, 0.0]]]);
    let heights = [-0.05, -0.05, 0.1].map(|z| z + height);
    standing.position.iter_mut().zip(heights).for_each(|(p, z)| p.z = z);
    frame([lying, standing])
}

fn magenta(image: &RgbaImage) -> usize {
    count(image, |[r, g, b]| {
        r > 120 && i32::from(r) > i32::from(g) + 60 && b > g.saturating_add(30)
    })
}

#[test]
fn crossing_faces_are_magenta_where_asked_for_and_shine_through_cloth_in_front() {
    let off = bare(ColourBy::Plain);
    let on = PictureOptions { crossings: CrossingMarks::Magenta, ..off.clone() };
    let open = crossing_at(0.0);
    let mut headless = headless();
    let mut picture = |f: &_, o: &_| headless.picture(f, &[], &overhead(SIZE), o).unwrap();
    assert_eq!(magenta(&picture(&open, &off)), 0);
    let in_front = magenta(&picture(&open, &on));
    // The lying face alone has 0.32 of 40,000 px.
    assert!((12_000..14_500).contains(&in_front), "{in_front} px");

    let mut covered = open.clone();
    covered.garments.push(std::sync::Arc::new(square(0.3, 1.0)));
    let (plain, marked) = (picture(&covered, &off), picture(&covered, &on));
    let [reds, greens] = [0, 1].map(|channel| {
        let at = |image: &RgbaImage| f32::from(image.get_pixel(100, 110).0[channel]);
        at(&marked) - at(&plain)
    });
    assert!(reds - greens > 25.0, "red {reds}, green {greens}");
    assert_eq!(magenta(&picture(&frame([square(0.0, 1.0)]), &on)), 0);
}

/// `cargo test --release -- --ignored --nocapture finding_crossings` prints what looking for
/// crossings costs.
#[test]
#[ignore = "measures time"]
fn finding_crossings_of_twenty_thousand_faces_takes_less_than_a_fifth_of_a_cpu_second() {
    let cloth = frame([rippled(100)]);
    let seconds = || {
        let start = cpu_time::ProcessTime::now();
        std::hint::black_box(Crossings::of(&cloth, &[]));
        start.elapsed().as_secs_f64()
    };
    let best = (0..5).map(|_| seconds()).fold(f64::INFINITY, f64::min);
    println!("crossings of 20,000 faces: {:.1} ms of CPU", best * 1e3);
    assert!(best < 0.2, "{best} s");
}

#[test]
fn a_scene_far_from_the_origin_looks_the_same() {
    let far = DVec3::new(4_096.0, -8_192.0, 512.0);
    let moved = |offset: DVec3| {
        let mut mesh = square(0.0, 1.0);
        mesh.position.iter_mut().for_each(|p| *p += offset);
        let view = View { eye: overhead(SIZE).eye + offset, ..overhead(SIZE) };
        headless().picture(&frame([mesh]), &[], &view, &PictureOptions::default()).unwrap()
    };
    assert!(moved(DVec3::ZERO) == moved(far));
}

/// `cargo test --release -- --ignored --nocapture a_large_picture` prints what a picture costs.
#[test]
#[ignore = "measures time"]
fn a_large_picture_takes_less_than_a_quarter_of_a_cpu_second() {
    let cloth = frame([rippled(100)]);
    let view = overhead([1280, 720]);
    let mut headless = headless();
    // CPU time: another program on the machine would spoil wall time.
    let mut seconds = || {
        let start = cpu_time::ProcessTime::now();
        headless.picture(&cloth, &[], &view, &PictureOptions::default()).unwrap();
        start.elapsed().as_secs_f64()
    };
    seconds();
    let best = (0..10).map(|_| seconds()).fold(f64::INFINITY, f64::min);
    println!("20,000 faces at 1280 x 720: {:.1} ms of CPU", best * 1e3);
    assert!(best < 0.25, "{best} s");
}

/// A square of 1 m in waves, two faces to a cell.
fn rippled(rows: i32) -> crate::mesh::Mesh {
    let cell = 1.0 / f64::from(rows);
    let corner = |i: i32, j: i32| {
        let (x, y) = (f64::from(i) * cell - 0.5, f64::from(j) * cell - 0.5);
        [x, y, 0.03 * (30.0 * x).sin() * (20.0 * y).cos()]
    };
    let cells = (0..rows * rows).map(|k| (k % rows, k / rows));
    let triangles: Vec<_> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] =
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    flat(&triangles)
}
