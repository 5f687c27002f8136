//! Rasters against what they must show.

use proptest::prelude::*;

use super::super::testing::{frame, moved, overhead, sheet};
use super::*;
use crate::scene::Pose;

const SIZE: [u32; 2] = [64, 48];

fn cloth_count(raster: &Raster) -> usize {
    raster.cloth_mask().iter().filter(|&&c| c).count()
}

#[test]
fn a_square_covers_its_share_of_the_picture_without_holes_or_seams() {
    for columns in [1, 3, 17] {
        let view = overhead(SIZE);
        let raster = Raster::new(&frame([sheet(columns, 5)]), &[], &view, SIZE);
        // Half the width and half the height.
        assert_eq!(cloth_count(&raster), 32 * 24);
    }
}

#[test]
fn what_a_pixel_shows_is_the_point_on_its_ray() {
    let view = overhead(SIZE);
    let mesh = moved(&sheet(4, 4), |p| DVec3::new(p.x, p.y, 0.4 * p.x * p.y));
    let raster = Raster::new(&frame([mesh.clone()]), &[], &view, SIZE);
    assert!(cloth_count(&raster) > 500);
    for (index, seen) in raster.pixels().iter().enumerate() {
        let Some(Sighting { what: What::Cloth { face, .. }, barycentric, depth }) = *seen else {
            continue;
        };
        let corners = mesh.face_positions(face);
        let point: DVec3 = (0..3).map(|k| corners[k] * barycentric[k]).sum();
        let centre = DVec2::new((index % 64) as f64 + 0.5, (index / 64) as f64 + 0.5);
        assert!(view.point_in_image(point).unwrap().distance(centre) < 1e-9);
        assert!((depth - (view.eye - point).dot(view.back)).abs() < 1e-12);
    }
}

#[test]
fn an_obstacle_in_front_hides_and_one_behind_does_not() {
    let view = overhead(SIZE);
    let plate = |z: f64| {
        let corner = |x: f64, y: f64| DVec3::new(x, y, z);
        Arc::new(Surface {
            positions: vec![corner(-9.0, -9.0), corner(0.5, -9.0), corner(0.5, 9.0)],
            triangles: vec![[0, 1, 2]],
        })
    };
    for (z, expected) in [(-0.5, 32 * 24), (0.5, 16 * 24)] {
        let mut frame = frame([sheet(2, 2)]);
        frame.obstacle_poses = vec![Pose::IDENTITY];
        let raster = Raster::new(&frame, &[plate(z)], &view, SIZE);
        assert_eq!(cloth_count(&raster), expected);
    }
}

#[test]
fn cloth_through_the_near_plane_is_seen_up_to_it() {
    // A floor one metre below a level camera, from far behind it to far in front: only what is
    // beyond the near plane shows, in the lower half of the picture.
    let floor = moved(&sheet(1, 1), |p| DVec3::new(40.0 * p.x - 20.0, 40.0 * p.y - 20.0, -1.0));
    let level = View {
        eye: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Z,
        back: -DVec3::Y,
        near: 4.0,
        ..overhead([40, 40])
    };
    let raster = Raster::new(&frame([floor]), &[], &level, [40, 40]);
    let mask = raster.cloth_mask();
    let rows: Vec<usize> =
        (0..40).filter(|row| mask[row * 40..(row + 1) * 40].iter().any(|&c| c)).collect();
    // Row r looks down by (r + 0.5 - 20) / 40: depth 4 to 20 are slopes 1/4 to 1/20.
    assert_eq!(rows, (22..30).collect::<Vec<_>>());
    assert!(raster.pixels().iter().flatten().all(|s| s.depth >= 4.0 && s.depth <= 20.0));
}

#[test]
fn cloth_out_of_frame_or_not_finite_draws_nothing() {
    let view = overhead(SIZE);
    for place in
        [(|p| p + 50.0 * DVec3::X) as fn(DVec3) -> DVec3, |p| p + 5.0 * DVec3::Z, |p| p * f64::NAN]
    {
        let raster = Raster::new(&frame([moved(&sheet(2, 2), place)]), &[], &view, SIZE);
        assert_eq!(cloth_count(&raster), 0);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_picture() {
    let view = overhead([160, 90]);
    let mesh = moved(&sheet(20, 20), |p| DVec3::new(p.x, p.y, (9.0 * p.x).sin() * 0.2));
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Raster::new(&frame([mesh.clone()]), &[], &view, [160, 90]))
    };
    assert_eq!(with(1), with(7));
}

proptest! {
    #[test]
    fn edges_between_two_triangles_let_no_ray_through(
        shift in [-0.3..0.3, -0.3..0.3, -0.5..0.5], turn in 0.0..3.0,
    ) {
        // A sheet that fills the frame, turned so that its edges run anywhere.
        let place = |p: DVec3| {
            let flat = DVec2::from_angle(turn).rotate(p.truncate() - 0.5) * 9.0;
            flat.extend(0.0) + DVec3::new(0.5, 0.5, 0.0) + DVec3::from_array(shift)
        };
        let raster =
            Raster::new(&frame([moved(&sheet(13, 11), place)]), &[], &overhead(SIZE), SIZE);
        prop_assert_eq!(cloth_count(&raster), 64 * 48);
    }
}
