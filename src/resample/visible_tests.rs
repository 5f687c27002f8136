//! Displacements of known size.

use glam::{DVec2, DVec3};

use super::super::testing::{frame, moved, overhead, sheet};
use super::super::{ClothMap, Pair};
use super::*;
use crate::mesh::{Mesh, RawMesh};
use crate::scene::Pose;

const SIZE: [u32; 2] = [200, 200];

fn map(meshes: impl IntoIterator<Item = Mesh>) -> ClothMap {
    ClothMap::new(frame(meshes))
}

fn measured(reference: &ClothMap, other: &ClothMap) -> VisibleError {
    measured_in(reference, other, SIZE)
}

fn measured_in(reference: &ClothMap, other: &ClothMap, size: [u32; 2]) -> VisibleError {
    let now = Pair { reference, other };
    let view = overhead(SIZE);
    let shown = Shown { now, before: None, surfaces: &[], view: &view, size };
    shown.measure().unwrap().error
}

/// 2 m on 200 pixels, where the sheet is.
const PX_PER_M: f64 = 100.0;

#[test]
fn a_shift_along_the_image_is_its_length_in_pixels() {
    let reference = map([sheet(5, 5)]);
    let shift = DVec3::new(0.03, -0.04, 0.0);
    let error = measured(&reference, &map([moved(&sheet(5, 5), |p| p + shift)]));
    assert!((error.cloth_share - 0.25).abs() < 1e-12);
    for length in [error.displacement.rms, error.displacement.p95, error.displacement.largest] {
        assert!((length - 0.05 * PX_PER_M).abs() < 1e-9, "{length}");
    }
    assert_eq!(error.share_over_1px, 1.0);
    // Strips of three and four pixels on two sides of a square of a hundred, twice over.
    let (common, each) = (97.0 * 96.0, 10_000.0);
    let expected = 2.0 * (each - common) / (2.0 * each - common);
    assert!((error.silhouette.share - expected).abs() < 1e-12);
    assert!(error.silhouette.distance.unwrap() > 1.0);
}

#[test]
fn fewer_pixels_measure_the_same_shift() {
    let reference = map([sheet(5, 5)]);
    let other = map([moved(&sheet(5, 5), |p| p + 0.04 * DVec3::X)]);
    let [full, half] = [SIZE, [100, 100]].map(|size| measured_in(&reference, &other, size));
    assert!((full.displacement.rms - half.displacement.rms).abs() < 1e-9);
    assert!((half.displacement.rms - 4.0).abs() < 1e-9);
    let [a, b] = [full, half].map(|e| e.silhouette.distance.unwrap());
    assert!((a - b).abs() < 0.1, "{a} {b}");
}

#[test]
fn another_triangulation_of_the_same_sheet_has_no_error() {
    let bent = |p: DVec3| DVec3::new(p.x, p.y, 0.3 * p.x);
    let reference = map([moved(&sheet(16, 12), bent)]);
    let error = measured(&reference, &map([moved(&sheet(3, 2), bent)]));
    assert!(error.displacement.largest < 1e-9 && error.unseen.displacement.largest < 1e-12);
    assert_eq!(error.share_over_1px, 0.0);
    // But for pixels whose centres lie on the very outline.
    assert!(error.silhouette.share < 1e-3, "{}", error.silhouette.share);
}

#[test]
fn rounding_is_no_shift_and_the_least_shift_is_one() {
    let bent = |p: DVec3| DVec3::new(p.x, p.y, 0.3 * p.x);
    let reference = map([moved(&sheet(16, 12), bent)]);
    let view = overhead(SIZE);
    for mesh in [sheet(16, 12), sheet(3, 2)] {
        let other = map([moved(&mesh, bent)]);
        let now = Pair { reference: &reference, other: &other };
        let shown = Shown { now, before: Some(now), surfaces: &[], view: &view, size: SIZE };
        let error = shown.measure().unwrap().error;
        let none = Spread::default();
        assert_eq!(
            (error.displacement, error.popping, error.unseen.displacement),
            (none, Some(none), none)
        );
    }
    let hair = moved(&sheet(16, 12), |p| bent(p) + 1e-10 * DVec3::X);
    let error = measured(&reference, &map([hair]));
    assert!(error.displacement.rms > 1e-10 * PX_PER_M, "{}", error.displacement.rms);
}

#[test]
fn a_turn_about_the_line_of_sight_grows_with_the_distance_from_it() {
    let angle = 0.02;
    let turned = |p: DVec3| (DVec2::from_angle(angle).rotate(p.truncate() - 0.5) + 0.5).extend(p.z);
    let error = measured(&map([sheet(4, 4)]), &map([moved(&sheet(4, 4), turned)]));
    // A chord of 2 sin(angle / 2) r; the mean of r^2 over the unit square about its middle is 1/6.
    let chord = 2.0 * (0.5 * angle).sin() * PX_PER_M;
    assert!((error.displacement.rms - chord * (1.0f64 / 6.0).sqrt()).abs() < 1e-3 * chord);
    assert!(error.displacement.largest < chord * 0.5f64.sqrt());
}

#[test]
fn motion_along_the_line_of_sight_is_seen_by_perspective_alone() {
    let lifted = moved(&sheet(4, 4), |p| p + DVec3::Z);
    let error = measured(&map([sheet(4, 4)]), &map([lifted]));
    // Half as far away, all is twice as far from the middle.
    let expected = (1.0f64 / 6.0).sqrt() * PX_PER_M;
    assert!((error.displacement.rms - expected).abs() < 1e-3 * expected);
}

#[test]
fn cloth_that_is_hidden_in_the_other_run_still_counts() {
    let other = moved(&sheet(4, 4), |p| p + DVec3::new(0.02, 0.0, -0.5));
    let lid = moved(&sheet(1, 1), |p| DVec3::new(4.0 * p.x - 2.0, 4.0 * p.y - 2.0, 0.5));
    // The lid is far aside in the reference.
    let aside = moved(&lid, |p| p + 100.0 * DVec3::X);
    let error = measured(&map([sheet(4, 4), aside]), &map([other, lid]));
    assert!((error.cloth_share - 0.25).abs() < 1e-12);
    // It has moved aside and away; near one point of the image the two cancel.
    assert!(error.displacement.rms > 1.0 && error.share_over_1px > 0.9);
}

#[test]
fn what_an_obstacle_or_cloth_hides_is_unseen_error_only() {
    let lid = || moved(&sheet(1, 1), |p| DVec3::new(4.0 * p.x - 2.0, 4.0 * p.y - 2.0, 0.5));
    let (still, shifted) = (sheet(4, 4), moved(&sheet(4, 4), |p| p + 0.25 * DVec3::X));
    let error = measured(&map([lid(), still.clone()]), &map([lid(), shifted.clone()]));
    assert!(error.displacement.largest < 1e-9);
    assert!((error.unseen.displacement.p95 - 0.25).abs() < 1e-12);

    let surface = Arc::new(Surface {
        positions: lid().position.as_slice().to_vec(),
        triangles: vec![[0, 1, 2], [1, 3, 2]],
    });
    let behind = |mesh: Mesh| {
        let mut frame = frame([mesh]);
        frame.obstacle_poses = vec![Pose::IDENTITY];
        ClothMap::new(frame)
    };
    let (a, b) = (behind(still), behind(shifted));
    let now = Pair { reference: &a, other: &b };
    let view = overhead(SIZE);
    let shown = Shown { now, before: None, surfaces: &[surface], view: &view, size: SIZE };
    let error = shown.measure().unwrap().error;
    assert_eq!((error.cloth_share, error.displacement), (0.0, Spread::default()));
    assert_eq!(error.unseen.area_share, 1.0);
    assert!((error.unseen.displacement.rms - 0.25).abs() < 1e-12);
}

#[test]
fn what_is_seen_is_not_unseen_even_in_folds_and_faces_below_a_pixel() {
    let wavy = moved(&sheet(150, 150), |p| DVec3::new(p.x, p.y, 0.02 * (20.0 * p.x).sin()));
    let error = measured(&map([wavy.clone()]), &map([wavy]));
    assert!(error.unseen.area_share < 1e-3, "{}", error.unseen.area_share);
}

#[test]
fn cloth_partly_out_of_frame_is_measured_where_it_is_in_frame() {
    let place = |p: DVec3| p + 0.9 * DVec3::X;
    let reference = map([moved(&sheet(6, 6), place)]);
    let other = map([moved(&sheet(6, 6), |p| place(p) + 0.02 * DVec3::Y)]);
    let error = measured(&reference, &other);
    assert!((error.cloth_share - 0.6 * 0.5 * 0.5).abs() < 1e-12, "{}", error.cloth_share);
    assert!((error.displacement.rms - 2.0).abs() < 1e-9);
    assert!((error.unseen.area_share - 0.4).abs() < 0.02);
    assert!((error.unseen.displacement.rms - 0.02).abs() < 1e-12);
}

#[test]
fn pictures_without_cloth_have_defined_values() {
    let away = |z: f64| map([moved(&sheet(2, 2), |p| p + z * DVec3::Z)]);
    let nothing = measured(&away(50.0), &away(60.0));
    assert_eq!((nothing.cloth_share, nothing.displacement), (0.0, Spread::default()));
    assert_eq!(nothing.silhouette, SilhouetteDifference { share: 0.0, distance: Some(0.0) });
    assert!((nothing.unseen.displacement.rms - 10.0).abs() < 1e-12);

    let gone = measured(&away(0.0), &away(60.0));
    let diagonal = 200.0 * 2.0f64.sqrt();
    assert!((gone.displacement.rms - diagonal).abs() < 1e-9, "behind the camera");
    assert_eq!(gone.silhouette, SilhouetteDifference { share: 1.0, distance: None });
}

#[test]
fn popping_is_the_change_beyond_the_references_own() {
    let at = |x: f64| map([moved(&sheet(4, 4), |p| p + x * DVec3::X)]);
    let view = overhead(SIZE);
    // The reference moves by 10 px; the other follows exactly, or jumps ahead by 3 px more.
    for (other_now, expected) in [(0.12, 0.0), (0.15, 3.0)] {
        let [r0, r1, o0, o1] = [at(0.0), at(0.1), at(0.02), at(other_now)];
        let now = Pair { reference: &r1, other: &o1 };
        let before = Some(Pair { reference: &r0, other: &o0 });
        let shown = Shown { now, before, surfaces: &[], view: &view, size: SIZE };
        let popping = shown.measure().unwrap().error.popping.unwrap();
        assert!((popping.rms - expected).abs() < 1e-9 && (popping.p95 - expected).abs() < 1e-9);
    }
}

/// Two panels which lie over one another in the flat cloth and side by side in the world, each of
/// n by n quads, sewn together.
fn sewn(n: u32, shift_of_second: f64) -> Mesh {
    let half = sheet(n, n);
    let (count, columns) = (half.vertex_count() as u32, n + 1);
    let (mut raw, mut node_of_second) = (RawMesh::default(), Vec::new());
    for vertex in half.vertex_ids() {
        let index = raw.positions.len() as u32;
        raw.positions.push(half.vertex_position(vertex));
        raw.vertices.push((index, half.material(vertex)));
    }
    for vertex in half.vertex_ids() {
        let place = half.material(vertex);
        let index = node_of_second.len() as u32;
        // Its left side is the first one's right side.
        if index.is_multiple_of(columns) {
            node_of_second.push(index + n);
        } else {
            let slide = DVec3::new(1.0, shift_of_second * place.x, 0.0);
            node_of_second.push(raw.positions.len() as u32);
            raw.positions.push(half.vertex_position(vertex) + slide);
        }
    }
    let second = half.vertex_ids().zip(&node_of_second);
    raw.vertices.extend(second.map(|(vertex, &node)| (node, half.material(vertex))));
    let faces = half.face_ids().map(|f| half.face_vertices(f).map(crate::mesh::Id::index));
    let faces: Vec<[u32; 3]> = faces.map(|f| f.map(|v| v as u32)).collect();
    raw.faces = faces.iter().copied().chain(faces.iter().map(|f| f.map(|v| v + count))).collect();
    Mesh::from_raw(&raw, &[]).unwrap()
}

#[test]
fn panels_that_overlap_in_the_flat_cloth_are_not_mistaken_for_one_another() {
    let (reference, other) = (map([sewn(4, 0.0)]), map([sewn(4, 0.02)]));
    assert_eq!(reference.locators()[0].panels().count(), 2);
    let error = measured(&reference, &reference);
    assert!(error.displacement.largest < 1e-9);
    // The frame ends in the middle of the second panel, which is sheared by up to 1 px there.
    let error = measured(&reference, &other);
    assert!((error.displacement.largest - 1.0).abs() < 0.02, "{:?}", error.displacement);
    let expected = (1.0f64 / 9.0).sqrt();
    assert!((error.displacement.rms - expected).abs() < 0.01, "{:?}", error.displacement);
}

#[test]
fn different_cloth_is_refused() {
    let (one, two) = (map([sheet(2, 2)]), map([sheet(2, 2), sheet(2, 2)]));
    let view = overhead(SIZE);
    for (reference, other, text) in
        [(&one, &two, "garments"), (&one, &map([sewn(2, 0.0)]), "pieces")]
    {
        let now = Pair { reference, other };
        let shown = Shown { now, before: None, surfaces: &[], view: &view, size: SIZE };
        let refusal = shown.measure().unwrap_err().to_string();
        assert!(refusal.contains(text), "{refusal}");
    }
}

#[test]
fn a_frame_is_judged_while_its_floor_is_under_a_quarter() {
    let of = |rms| VisibleError {
        displacement: Spread { rms, ..Spread::default() },
        ..VisibleError::default()
    };
    assert!(of(4.0).is_judged(&of(1.0)) && !of(4.0).is_judged(&of(1.01)));
    assert!(of(0.0).is_judged(&of(0.0)));
}
