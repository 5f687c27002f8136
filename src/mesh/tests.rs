use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::*;

/// An n x n grid over the unit square with a seam along x = 1/2 if `seamed` and n is even.
fn grid(n: usize, seamed: bool) -> RawMesh {
    let node = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    let mut raw = RawMesh::default();
    for j in 0..=n {
        for i in 0..=n {
            let u = DVec2::new(i as f64, j as f64) / n as f64;
            raw.positions.push(DVec3::new(u.x, u.y, (5.0 * u.x * u.y).sin()));
            raw.velocities.push(DVec3::new(u.y, -u.x, u.x * u.y));
            raw.vertices.push((node(i, j), u));
        }
    }
    let seam_column = n / 2;
    let first_copy = raw.vertices.len() as u32;
    if seamed {
        for j in 0..=n {
            let (node, u) = raw.vertices[node(seam_column, j) as usize];
            raw.vertices.push((node, u + DVec2::X));
        }
    }
    for j in 0..n {
        for i in 0..n {
            let vertex = |i: usize, j: usize, right: bool| {
                if seamed && right && i == seam_column { first_copy + j as u32 } else { node(i, j) }
            };
            let right = i >= seam_column;
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(i, j, right));
            raw.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    if seamed {
        // The right half moves with its copies, so that its faces keep their shape.
        for (index, (_, u)) in raw.vertices.iter_mut().enumerate() {
            if index < first_copy as usize && index % (n + 1) > seam_column {
                *u += DVec2::X;
            }
        }
    }
    raw
}

fn momentum(mesh: &Mesh) -> DVec3 {
    mesh.node_areas().enumerate().map(|(n, area)| mesh.velocity[n] * *area).sum()
}

#[test]
fn euler_characteristic_of_a_disc_is_one() {
    let mesh = Mesh::from_raw(&grid(4, true), &[]).unwrap();
    mesh.check().unwrap();
    assert_eq!(mesh.node_count() + mesh.face_count() - mesh.edges().count(), 1);
}

#[test]
fn corners_are_visited_once_around_every_node() {
    let mesh = Mesh::from_raw(&grid(3, false), &[]).unwrap();
    let visits: usize = mesh.node_ids().map(|n| mesh.valence(n)).sum();
    assert_eq!(visits, 3 * mesh.face_count());
}

#[test]
fn a_seam_edge_has_two_faces_but_four_vertices() {
    let mesh = Mesh::from_raw(&grid(4, true), &[]).unwrap();
    assert_eq!(mesh.edges().filter(|&c| mesh.is_seam(c)).count(), 4);
    assert_eq!(mesh.vertex_count(), mesh.node_count() + 5);
}

#[test]
fn a_split_keeps_area_mass_and_momentum() {
    for seamed in [false, true] {
        let mesh = Mesh::from_raw(&grid(4, seamed), &[]).unwrap();
        let (area, before) = (mesh.total_material_area(), momentum(&mesh));
        let mut editor = MeshEditor::new(mesh);
        let edges: Vec<CornerId> = editor.edges().collect();
        for corner in edges {
            editor.split(corner);
        }
        let mesh = editor.finish();
        mesh.check().unwrap();
        assert!((mesh.total_material_area() - area).abs() < 1e-12);
        assert!((momentum(&mesh) - before).length() < 1e-12);
    }
}

#[test]
fn a_node_of_a_split_can_be_collapsed_away_again() {
    let mesh = Mesh::from_raw(&grid(2, true), &[]).unwrap();
    let seam = mesh.edges().find(|&c| mesh.is_seam(c)).unwrap();
    let kept = mesh.edge_nodes(seam)[0];
    let mut editor = MeshEditor::new(mesh.clone());
    let node = editor.split(seam);
    let corner = editor.mesh().edge_between(node, kept).unwrap();
    editor.collapse(Collapse { corner, removed: node, kept }).unwrap();
    let again = editor.finish();
    again.check().unwrap();
    assert_eq!(again.face_count(), mesh.face_count());
    assert_eq!(again.vertex_count(), mesh.vertex_count());
    assert!((again.total_material_area() - mesh.total_material_area()).abs() < 1e-12);
}

#[test]
fn a_node_may_not_leave_boundary_or_seam_nor_a_kept_node_go() {
    let mut editor = MeshEditor::new(Mesh::from_raw(&grid(2, true), &[]).unwrap());
    let mesh = editor.mesh();
    let seam = mesh.edges().find(|&c| mesh.is_seam(c)).unwrap();
    let boundary = mesh.edges().find(|&c| mesh.is_boundary(c)).unwrap();
    for (edge, refusal) in
        [(seam, CollapseRefusal::LeavesSeam), (boundary, CollapseRefusal::LeavesBoundary)]
    {
        let node = editor.split(edge);
        let mesh = editor.mesh();
        let mut around = mesh.corners_around(node).map(|c| c.next());
        let tip = around.find(|&c| !mesh.is_boundary(c) && !mesh.is_seam(c));
        let corner = tip.unwrap();
        let [a, b] = mesh.edge_nodes(corner);
        let kept = if a == node { b } else { a };
        assert_eq!(editor.check_collapse(Collapse { corner, removed: node, kept }), Err(refusal));
        if editor.mesh().node_origin(kept).is_kept() {
            let back = Collapse { corner, removed: kept, kept: node };
            assert_eq!(editor.check_collapse(back), Err(CollapseRefusal::Kept));
        }
    }
}

#[test]
fn flipping_an_edge_and_its_successor_back_restores_the_faces() {
    let mesh = Mesh::from_raw(&grid(2, false), &[]).unwrap();
    let mut editor = MeshEditor::new(mesh.clone());
    let corner = editor.edges().find(|&c| editor.check_flip(c).is_ok()).unwrap();
    let ends = editor.mesh().edge_nodes(corner);
    editor.flip(corner).unwrap();
    editor.mesh().check().unwrap();
    assert!(editor.mesh().edge_between(ends[0], ends[1]).is_none());
    editor.flip(corner.next()).unwrap();
    assert!(editor.mesh().edge_between(ends[0], ends[1]).is_some());
    editor.finish().check().unwrap();
}

#[test]
fn bad_meshes_are_refused_with_the_reason() {
    let error = |change: fn(&mut RawMesh)| {
        let mut raw = grid(2, false);
        change(&mut raw);
        Mesh::from_raw(&raw, &[]).unwrap_err()
    };
    assert_eq!(error(|r| r.faces.clear()), MeshError::Empty);
    assert!(matches!(
        error(|r| r.faces[0][0] = 99),
        MeshError::VertexOutOfRange { vertex: 99, .. }
    ));
    assert!(matches!(error(|r| r.vertices[3].0 = 99), MeshError::NodeOutOfRange { node: 99, .. }));
    assert!(matches!(
        error(|r| r.positions[4].z = f64::NAN),
        MeshError::NonFiniteNode { what: "position", node: 4 }
    ));
    assert!(matches!(
        error(|r| r.vertices[1].1.x = f64::INFINITY),
        MeshError::NonFiniteVertex { vertex: 1 }
    ));
    assert!(matches!(
        error(|r| r.faces[2][1] = r.faces[2][0]),
        MeshError::RepeatedNode { face: 2 }
    ));
    assert!(matches!(error(|r| r.vertices[4].1 = r.vertices[0].1), MeshError::ZeroArea { .. }));
    assert!(matches!(error(|r| r.faces[1].swap(0, 1)), MeshError::Inverted { face: 1, .. }));
    assert!(matches!(error(|r| r.faces.push(r.faces[0])), MeshError::NonManifoldEdge { .. }));
}

#[test]
fn the_local_order_renames_everything_and_changes_nothing() {
    let mut mesh = Mesh::from_raw(&grid(6, true), &[3]).unwrap();
    for node in mesh.node_ids() {
        mesh.velocity[node] = mesh.position[node] * 2.0;
    }
    let ordered = mesh.clone().in_local_order();
    ordered.check().unwrap();
    let faces = |mesh: &Mesh| {
        let mut faces: Vec<String> = mesh
            .face_ids()
            .map(|f| {
                let corner = |c: CornerId| {
                    let (v, n) = (mesh.vertex_at(c), mesh.node_at(c));
                    let node = (mesh.position[n], mesh.velocity[n], mesh.node_origin(n));
                    let across = mesh.opposite(c).map(|o| mesh.position[mesh.node_at(o)]);
                    format!("{:?} {node:?} {across:?} {}", mesh.material(v), mesh.rest_angle(c))
                };
                format!("{:?}", f.corners().map(corner))
            })
            .collect();
        faces.sort();
        faces
    };
    assert_eq!(faces(&ordered), faces(&mesh));
    let farthest = |mesh: &Mesh| {
        let apart = |c| {
            let [a, b] = mesh.edge_nodes(c);
            a.index().abs_diff(b.index())
        };
        mesh.edges().map(apart).max().unwrap()
    };
    assert!(farthest(&ordered) <= 2 * 7, "neighbours are {} apart", farthest(&ordered));
}

#[test]
fn a_face_that_is_inside_out_in_the_world_is_named() {
    // Its material corners are counter-clockwise, but it runs along shared edges the wrong way.
    let mut raw = grid(1, false);
    let copies: Vec<u32> = [0u32, 2, 3]
        .into_iter()
        .map(|v| {
            raw.vertices.push((
                raw.vertices[v as usize].0,
                raw.vertices[v as usize].1 * DVec2::new(-1.0, 1.0),
            ));
            raw.vertices.len() as u32 - 1
        })
        .collect();
    raw.faces[1] = [copies[0], copies[1], copies[2]];
    let error = Mesh::from_raw(&raw, &[]).unwrap_err();
    assert!(matches!(error, MeshError::InconsistentOrientation { .. }), "{error}");
}

#[test]
fn two_faces_that_touch_in_a_node_are_no_surface() {
    let mut raw = grid(2, false);
    // Two opposite cells of four.
    raw.faces = vec![raw.faces[0], raw.faces[1], raw.faces[6], raw.faces[7]];
    assert!(matches!(
        Mesh::from_raw(&raw, &[]).unwrap_err(),
        MeshError::NonManifoldNode { node: 4 }
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn random_edits_keep_the_mesh_valid(seamed: bool, edits in prop::collection::vec((0u8..3, 0usize..10_000), 1..120)) {
        let mesh = Mesh::from_raw(&grid(4, seamed), &[12]).unwrap();
        let area = mesh.total_material_area();
        let mut editor = MeshEditor::new(mesh);
        for (kind, pick) in edits {
            let edges: Vec<CornerId> = editor.edges().collect();
            let corner = edges[pick % edges.len()];
            match kind {
                0 => { editor.split(corner); }
                1 => { let _ = editor.flip(corner); }
                _ => {
                    let collapse = editor.collapses(corner)[pick % 2];
                    let replaced = editor.replacements(collapse);
                    let keeps_area = editor.moved_corners(collapse).all(|c| {
                        let mesh = editor.mesh();
                        let old = mesh.vertex_at(c);
                        let new = replaced.iter().flatten().find(|r| r.0 == old).map_or(old, |r| r.1);
                        signed_area([new, mesh.vertex_at(c.next()), mesh.vertex_at(c.previous())]
                            .map(|v| mesh.material(v))) > 1e-9
                    });
                    if keeps_area { let _ = editor.collapse(collapse); }
                }
            }
        }
        let mesh = editor.finish();
        prop_assert_eq!(mesh.check(), Ok(()));
        prop_assert!((mesh.total_material_area() - area).abs() < 1e-9);
    }
}
