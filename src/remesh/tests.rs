use glam::{DVec2, DVec3};

use super::*;
use crate::math::SymTensor2;
use crate::mesh::{RawMesh, aspect_ratio};

/// A unit square of n x n cells with alternating diagonals, lifted to a wavy surface.
fn square(n: usize) -> Mesh {
    let point = |i: usize, j: usize| DVec2::new(i as f64, j as f64) / n as f64;
    let id = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    let mut raw = RawMesh::default();
    for j in 0..=n {
        for i in 0..=n {
            let u = point(i, j);
            raw.positions.push(DVec3::new(u.x, u.y, 0.1 * (3.0 * u.x).sin()));
            raw.vertices.push((id(i, j), u));
        }
    }
    for j in 0..n {
        for i in 0..n {
            let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            if (i + j) % 2 == 0 {
                raw.faces.extend([[a, b, c], [a, c, d]]);
            } else {
                raw.faces.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    Mesh::from_raw(&raw, &[]).unwrap()
}

/// Two unit squares side by side which share their nodes at x = 1 through a seam.
fn seamed_pair() -> Mesh {
    let mut raw = RawMesh::default();
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 1.0), (1.0, 1.0), (2.0, 1.0)] {
        raw.positions.push(DVec3::new(x, y, 0.0));
    }
    let left = [(0, 0.0, 0.0), (1, 1.0, 0.0), (4, 1.0, 1.0), (3, 0.0, 1.0)];
    let right = [(1, 5.0, 0.0), (2, 6.0, 0.0), (5, 6.0, 1.0), (4, 5.0, 1.0)];
    for (node, u, v) in left.into_iter().chain(right) {
        raw.vertices.push((node, DVec2::new(u, v)));
    }
    raw.faces = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    Mesh::from_raw(&raw, &[]).unwrap()
}

fn set_metric(mesh: &mut Mesh, metric: impl Fn(DVec2) -> SymTensor2) {
    for v in mesh.vertex_ids() {
        mesh.metric[v] = metric(mesh.material(v));
    }
}

fn longest_metric_edge(mesh: &Mesh) -> f64 {
    mesh.edges().map(|c| mesh.metric_length_squared(c)).fold(0.0, f64::max).sqrt()
}

fn remeshed(mesh: Mesh) -> (Mesh, RemeshReport) {
    let (mesh, report) = remesh(mesh, &RemeshSettings::default(), &NoGuard);
    mesh.check().unwrap();
    (mesh, report)
}

#[test]
fn refining_makes_every_edge_valid_and_keeps_the_area() {
    let mut mesh = square(2);
    set_metric(&mut mesh, |u| {
        SymTensor2::new(400.0 + 2000.0 * u.x, 300.0 * u.y, 100.0 + 1000.0 * u.y)
    });
    let (mesh, report) = remeshed(mesh);
    assert!(report.splits > 100, "{report:?}");
    assert!(longest_metric_edge(&mesh) <= 1.0 + 1e-9);
    assert!((mesh.total_material_area() - 1.0).abs() < 1e-12);
    assert_eq!(report.invalid_edges, 0);
}

#[test]
fn coarsening_leaves_the_outline_and_little_else() {
    let mut mesh = square(4);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(900.0));
    let (mut mesh, _) = remeshed(mesh);
    assert!(mesh.face_count() > 1000);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(0.01));
    let (mesh, report) = remeshed(mesh);
    assert!(report.collapses > 500);
    // 16 boundary nodes are kept: a triangulation of them has 14 faces.
    assert!(mesh.face_count() <= 24, "{} faces", mesh.face_count());
    assert!((mesh.total_material_area() - 1.0).abs() < 1e-12);
}

#[test]
fn remeshing_twice_to_one_metric_changes_nothing_the_second_time() {
    let mut mesh = square(3);
    set_metric(&mut mesh, |u| SymTensor2::new(300.0 + 500.0 * u.y, 0.0, 200.0));
    let (once, _) = remeshed(mesh);
    let (twice, report) = remeshed(once.clone());
    assert_eq!((report.splits, report.collapses), (0, 0));
    assert_eq!(once.face_count(), twice.face_count());
}

#[test]
fn seams_stay_where_they_are_and_each_side_keeps_its_own_material() {
    let mut mesh = seamed_pair();
    set_metric(&mut mesh, |u| SymTensor2::isotropic(if u.x < 3.0 { 100.0 } else { 400.0 }));
    let (mut fine, _) = remeshed(mesh);
    let seam_length = |mesh: &Mesh| -> f64 {
        let side = |c| {
            let [i, j] = mesh.edge_vertices(c);
            mesh.material(i).distance(mesh.material(j))
        };
        mesh.edges().filter(|&c| mesh.is_seam(c)).map(side).sum()
    };
    assert!((seam_length(&fine) - 1.0).abs() < 1e-12);
    assert!(longest_metric_edge(&fine) <= 1.0 + 1e-9);
    set_metric(&mut fine, |_| SymTensor2::isotropic(0.1));
    let (coarse, _) = remeshed(fine);
    assert!((seam_length(&coarse) - 1.0).abs() < 1e-12);
    assert_eq!(coarse.face_count(), 4);
    assert!((coarse.total_material_area() - 2.0).abs() < 1e-12);
}

#[test]
fn collapses_keep_the_least_aspect() {
    let mut mesh = square(2);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(2500.0));
    let (mut mesh, _) = remeshed(mesh);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(50.0));
    let (mesh, _) = remeshed(mesh);
    for face in mesh.face_ids() {
        assert!(aspect_ratio(mesh.face_material(face)) >= 0.2 - 1e-12);
    }
}

#[test]
fn pinned_nodes_stay() {
    let mut raw_mesh = square(6);
    set_metric(&mut raw_mesh, |_| SymTensor2::isotropic(0.01));
    let (free, _) = remeshed(raw_mesh);
    let kept = free.node_ids().filter(|&n| free.node_origin(n).is_kept()).count();
    assert_eq!(kept, 24, "the outline of a 6 x 6 square");
    assert_eq!(free.node_count(), 24, "nothing else is left");
}

#[test]
fn the_limit_of_faces_ends_a_metric_that_asks_for_too_much() {
    let mut mesh = square(2);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(1e12));
    let settings = RemeshSettings { face_count_max: 500, ..Default::default() };
    let (mesh, report) = remesh(mesh, &settings, &NoGuard);
    mesh.check().unwrap();
    assert!(mesh.face_count() <= 501);
    assert!(report.invalid_edges > 0);
}

#[test]
fn a_guard_that_refuses_everything_leaves_only_splits() {
    struct Never;
    impl EditGuard for Never {
        fn allows(&self, _: &Change) -> bool {
            false
        }
    }
    let mut mesh = square(8);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(1.0));
    let (mesh, report) = remesh(mesh, &RemeshSettings::default(), &Never);
    mesh.check().unwrap();
    assert_eq!((report.collapses, report.flips), (0, 0));
    assert!(report.vetoes > 0);
    assert_eq!(mesh.face_count(), 128);
}

#[test]
fn an_anisotropic_metric_gives_stretched_triangles() {
    let mut mesh = square(1);
    // Edges of 0.05 across and 0.2 along: an ideal triangle covers sqrt(3)/4 in the metric.
    set_metric(&mut mesh, |_| SymTensor2::new(400.0, 0.0, 25.0));
    let (mesh, _) = remeshed(mesh);
    let ideal = (400.0f64 * 25.0).sqrt() / (3f64.sqrt() / 4.0);
    let count = mesh.face_count() as f64;
    assert!(count > ideal && count < 3.5 * ideal, "{count} faces, ideal {ideal}");
}

#[test]
fn an_edit_that_would_stretch_folded_cloth_is_left_out() {
    // A pleat: every other row of nodes is lifted so that the cloth keeps its lengths.
    let mut mesh = square(12);
    for v in mesh.vertex_ids() {
        let (u, node) = (mesh.material(v), mesh.node_of(v));
        let column = (u.x * 12.0).round() as i32;
        let lift = if column % 2 == 0 { 0.0 } else { 0.07 };
        let width = (1.0f64 / 144.0 - 0.07 * 0.07).sqrt();
        mesh.position[node] = DVec3::new(f64::from(column) * width, u.y, lift);
    }
    let stretch = |mesh: &Mesh| {
        let of = |f| mesh.deformation_gradient(f).singular_values()[0];
        mesh.face_ids().map(of).fold(0.0, f64::max)
    };
    assert!(stretch(&mesh) < 1.0 + 1e-9);
    set_metric(&mut mesh, |_| SymTensor2::isotropic(1.0));
    let (mesh, report) = remeshed(mesh);
    assert!(report.collapses > 10);
    assert!(stretch(&mesh) < 1.06, "{}", stretch(&mesh));
}
