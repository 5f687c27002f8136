use proptest::prelude::*;

use super::*;

fn image(lens: Lens) -> ImagePlane {
    ImagePlane { lens, resolution: [1280, 720], pixel_aspect: 1.0 }
}

fn fov() -> ImagePlane {
    image(Lens::FieldOfView { fov_y: 0.6 })
}

fn film_back() -> ImagePlane {
    let (aperture_mm, offset_mm) = (DVec2::new(36.0, 24.0), DVec2::new(2.0, -1.0));
    image(Lens::FilmBack { focal_mm: 35.0, aperture_mm, offset_mm })
}

fn point(size: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
}

fn pair() -> impl Strategy<Value = EyeAndTarget> {
    (point(5.0), point(5.0))
        .prop_map(|(eye, target)| EyeAndTarget { eye, target })
        .prop_filter("looks straight up or down, or nowhere", |pair| {
            (pair.eye - pair.target).truncate().length() > 0.05 * pair.distance().max(0.1)
        })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_orbit_keeps_distance_and_target_and_stops_short_of_the_poles(
        pair in pair(), azimuth in -9.0..9.0f64, elevation in -9.0..9.0f64,
    ) {
        let moved = pair.orbited(azimuth, elevation);
        prop_assert_eq!(moved.target, pair.target);
        prop_assert!((moved.distance() - pair.distance()).abs() < 1e-9);
        let arm = moved.eye - moved.target;
        prop_assert!((arm.z / arm.length()).asin().abs() < ELEVATION_MAX + 1e-9);
        let view = moved.view(&fov());
        prop_assert!(view.up.z > 0.0 && view.right.z.abs() < 1e-9);
        let back = pair.orbited(azimuth, 0.0).orbited(-azimuth, 0.0);
        prop_assert!(back.eye.distance(pair.eye) < 1e-9);
    }

    #[test]
    fn a_pan_takes_what_is_under_the_pointer_along(
        pair in pair(), from in prop::array::uniform2(0.0..720.0f64), drag in prop::array::uniform2(-400.0..400.0f64),
    ) {
        for image in [fov(), film_back()] {
            let view = pair.view(&image);
            let [from, drag] = [from, drag].map(DVec2::from_array);
            let size = DVec2::new(1280.0, 720.0);
            let on_gate = DVec2::new(from.x, size.y - from.y) / size;
            let at = view.gate_min + (view.gate_max - view.gate_min) * on_gate;
            let seen = view.eye + pair.distance() * (view.right * at.x + view.up * at.y - view.back);
            prop_assert!(view.point_in_image(seen).unwrap().distance(from) < 1e-6);
            let moved = pair.panned(&view, drag).view(&image);
            let to = moved.point_in_image(seen).unwrap();
            prop_assert!(to.distance(from + drag) < 1.0, "{} and not {}", to, from + drag);
        }
    }

    #[test]
    fn a_framed_box_has_all_corners_in_the_image_and_fills_it(
        pair in pair(), a in point(3.0), b in point(3.0), margin in 0.0..0.5f64,
    ) {
        let bounds = [a.min(b), a.max(b)];
        for image in [fov(), film_back()] {
            let framed = pair.framed(bounds, &image, margin);
            let view = framed.view(&image);
            let size = DVec2::new(1280.0, 720.0);
            let mut fullest = 0.0f64;
            for corner in corners(bounds[0], bounds[1]) {
                let at = view.point_in_image(corner).expect("in front of the camera");
                prop_assert!(at.cmpge(DVec2::ZERO - 1e-6).all() && at.cmple(size + 1e-6).all());
                let centre = -view.gate_min / (view.gate_max - view.gate_min) * size;
                let centre = DVec2::new(centre.x, size.y - centre.y);
                let room = centre.min(size - centre);
                fullest = fullest.max(((at - centre).abs() / room).max_element());
            }
            prop_assert!((fullest - (1.0 - margin)).abs() < 1e-6, "{}", fullest);
        }
    }

    #[test]
    fn a_dolly_goes_there_and_back_and_never_through_the_target(
        pair in pair(), amount in -2.0..2.0f64,
    ) {
        let moved = pair.dollied(amount);
        prop_assert!((moved.distance() / pair.distance() - (-amount).exp()).abs() < 1e-9);
        prop_assert!(moved.dollied(-amount).eye.distance(pair.eye) < 1e-9);
        let close = pair.dollied(1e3);
        prop_assert!((close.eye - close.target).dot(pair.eye - pair.target) > 0.0);
        prop_assert!(pair.dollied(-1e3).distance() <= DISTANCE_MAX);
    }

    #[test]
    fn a_flight_goes_along_the_axes_of_the_view_and_a_look_stays_in_place(
        pair in pair(), along in point(2.0), yaw in -3.0..3.0f64, pitch in -3.0..3.0f64,
    ) {
        let view = pair.view(&fov());
        let moved = pair.flown(along);
        let expected = view.right * along.x + view.up * along.y - view.back * along.z;
        prop_assert!((moved.eye - pair.eye).distance(expected) < 1e-9);
        prop_assert!((moved.target - pair.target).distance(expected) < 1e-9);
        let looking = pair.looked(yaw, pitch);
        prop_assert_eq!(looking.eye, pair.eye);
        prop_assert!((looking.distance() - pair.distance()).abs() < 1e-9);
    }
}

#[test]
fn a_look_to_the_left_and_up_turns_the_view_there() {
    let pair = EyeAndTarget { eye: DVec3::ZERO, target: DVec3::Y };
    let left = pair.looked(0.1, 0.0).target;
    assert!(left.distance(DVec3::new(-0.1f64.sin(), 0.1f64.cos(), 0.0)) < 1e-12, "{left}");
    assert!(pair.looked(0.0, 0.1).target.z > 0.0);
    assert!(pair.orbited(0.1, 0.0).eye.x > 0.0, "the eye goes counter-clockwise");
}

#[test]
fn a_view_is_taken_over_without_its_roll() {
    let view = crate::shot::tests::sample_view();
    let pair = EyeAndTarget::of_view(&view, 2.0);
    let upright = pair.view(&film_back());
    assert!(upright.eye == view.eye && upright.back.distance(view.back) < 1e-12);
    assert!(upright.right.z.abs() < 1e-12 && view.right.z.abs() > 0.01);
}

#[test]
fn degenerate_boxes_and_moves_leave_a_view_that_can_be_used() {
    let pair = EyeAndTarget { eye: DVec3::new(0.0, -4.0, 1.0), target: DVec3::ZERO };
    let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    assert_eq!(pair.framed(empty, &fov(), 0.1), pair);
    let dot = pair.framed([DVec3::X; 2], &fov(), 0.1);
    assert!(dot.target == DVec3::X && (dot.distance() - pair.distance()).abs() < 1e-12);
    assert_eq!(pair.orbited(f64::NAN, 0.0), pair);
    assert_eq!(pair.flown(DVec3::NAN), pair);
    assert_eq!(pair.dollied(f64::NAN), pair);
    let nowhere = EyeAndTarget { eye: DVec3::ONE, target: DVec3::ONE };
    for moved in [nowhere.orbited(0.1, 0.1), nowhere.dollied(-1.0), nowhere.looked(0.1, 0.1)] {
        assert!(moved.eye.is_finite() && moved.eye != moved.target, "{moved:?}");
    }
}
