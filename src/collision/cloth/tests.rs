use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use super::pairs::{ClothPair, ClothPairs};
use super::stop::{ClothSearch, stop_cloth};
use super::zones::Zones;
use super::*;
use crate::collision::MovedCloth;
use crate::collision::continuous::{Features, nearest};
use crate::collision::stop::{Surroundings, found_impacts};
use crate::math::{Random, segment_passes_through};
use crate::mesh::{Mesh, RawMesh};
use crate::remesh::{Change, EditGuard};

const SETTINGS: Contact =
    Contact { thickness: 0.01, stiffness: 1e6, friction_cloth: 0.6, friction_obstacle: 0.3 };
const DT: f64 = 5e-3;

mod keeping;

/// A square sheet of n x n cells with a side of 1 m, placed in the world.
fn sheet(n: u32, place: impl Fn(DVec2) -> DVec3) -> Mesh {
    let at = |i: u32, j: u32| DVec2::new(f64::from(i), f64::from(j)) / f64::from(n);
    grid(n, at, place)
}

/// n x n cells with corners at the given places in the flat cloth.
fn grid(n: u32, at: impl Fn(u32, u32) -> DVec2, place: impl Fn(DVec2) -> DVec3) -> Mesh {
    let node = |i: u32, j: u32| i * (n + 1) + j;
    let points: Vec<DVec2> =
        (0..=n).flat_map(|i| (0..=n).map(move |j| [i, j])).map(|[i, j]| at(i, j)).collect();
    let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let faces = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let raw = RawMesh {
        positions: points.iter().map(|&u| place(u)).collect(),
        vertices: (0..).zip(points).collect(),
        faces: faces.collect(),
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).unwrap()
}

/// Some meshes as the simulation sees them.
struct Scene {
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    area: Vec<f64>,
    thickness: Vec<f64>,
    faces: Vec<[u32; 3]>,
    tree: FaceTree,
    own: ClothContact,
}

impl Scene {
    fn new(meshes: &[Mesh]) -> Self {
        use crate::mesh::Id;
        let (mut position, mut area, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for mesh in meshes {
            let first = position.len() as u32;
            faces.extend(
                mesh.face_ids().map(|f| mesh.face_nodes(f).map(|n| first + n.index() as u32)),
            );
            position.extend_from_slice(mesh.position.as_slice());
            area.extend(mesh.node_areas().into_vec());
        }
        let tree = FaceTree::new(&position, &faces);
        let own = ClothContact::new(meshes, &tree, &position);
        let velocity = vec![DVec3::ZERO; position.len()];
        let thickness = vec![SETTINGS.thickness; position.len()];
        Self { velocity, position, area, thickness, faces, tree, own }
    }

    fn contacts(&mut self) -> Vec<ContactPoint> {
        let seen = Cloth {
            position: &self.position,
            velocity: &self.velocity,
            area: &self.area,
            thickness: &self.thickness,
            faces: &self.faces,
        };
        self.own.expect_motion(seen, &self.tree, &SETTINGS, DT);
        self.own.contacts(seen, &self.tree, &SETTINGS, DT)
    }

    /// Moves every node by its velocity and stops it as asked.
    fn advance(&mut self, stop: impl Fn(&mut MovedCloth<'_>, &mut ClothSearch<'_>)) {
        let start = self.position.clone();
        let way = |(x, v): (&DVec3, &DVec3)| *x + *v * DT;
        let mut position: Vec<DVec3> = start.iter().zip(&self.velocity).map(way).collect();
        let mut cloth = MovedCloth {
            position: &mut position,
            velocity: &mut self.velocity,
            position_at_start: &start,
            area: &self.area,
            thickness: &self.thickness,
            mass: &self.area,
            faces: &self.faces,
        };
        stop(&mut cloth, &mut self.own.search(&self.tree, &SETTINGS));
        self.position = position;
        self.tree.refit(&self.position);
    }

    fn crossings(&self) -> usize {
        crossings(&self.tree, &self.position).len()
    }
}

/// Two sheets that approach each other at random speeds of up to so much (m/s), for one step.
fn approaching(speed: f64, seed: u64) -> Scene {
    let lower = sheet(6, |u| DVec3::new(u.x, u.y, 0.02 * (9.0 * u.x + u.y).sin()));
    let upper = sheet(5, |u| DVec3::new(1.02 * u.x, u.y - 0.01, 0.05 + 0.02 * (7.0 * u.y).cos()));
    let mut scene = Scene::new(&[lower, upper]);
    let mut random = Random::new(seed);
    for (x, v) in scene.position.iter().zip(&mut scene.velocity) {
        let towards = if x.z > 0.025 { -1.0 } else { 1.0 };
        let aside = DVec3::new(random.number(), random.number(), random.number());
        *v = (DVec3::Z * towards + 0.5 * aside) * speed;
    }
    scene
}

#[test]
fn all_pairs_nearer_than_twice_the_reach_are_found_and_none_shares_a_node() {
    let mut scene = approaching(0.0, 1);
    let topology = scene.tree.topology().clone();
    let reach = 0.02;
    scene.own.pairs.find(&topology, &scene.position, |_| DVec3::ZERO, reach);
    let named = |features, nodes: [usize; 4]| {
        let (first, second) = nodes.split_at(if features == Features::VertexFace { 1 } else { 2 });
        let mut sides = [first.to_vec(), second.to_vec()];
        sides.iter_mut().for_each(|s| s.sort_unstable());
        sides.sort();
        (features, sides)
    };
    let found: Vec<_> =
        scene.own.pairs.found().iter().map(|p| named(p.features, p.nodes(&topology))).collect();
    let unique: BTreeSet<_> = found.iter().cloned().collect();
    assert_eq!(unique.len(), found.len(), "no pair twice");
    let is_near = |features, nodes: [usize; 4]| {
        nearest(features, nodes.map(|n| scene.position[n])).distance < 2.0 * reach
    };
    let mut near = BTreeSet::new();
    for node in 0..scene.position.len() {
        for face in &scene.faces {
            let nodes = [node, face[0] as usize, face[1] as usize, face[2] as usize];
            if !nodes[1..].contains(&node) && is_near(Features::VertexFace, nodes) {
                near.insert(named(Features::VertexFace, nodes));
            }
        }
    }
    for (k, one) in topology.edges().iter().enumerate() {
        for other in &topology.edges()[k + 1..] {
            let ([a, b], [c, d]) = (one.corners, other.corners);
            let nodes = [a, b, c, d].map(|n| n as usize);
            let shares = one.corners.iter().any(|n| other.corners.contains(n));
            if !shares && is_near(Features::EdgeEdge, nodes) {
                near.insert(named(Features::EdgeEdge, nodes));
            }
        }
    }
    assert!(near.len() > 100 && near.is_subset(&unique));
    assert!(unique.iter().flat_map(|(_, s)| [s]).all(|s| !s[0].iter().any(|n| s[1].contains(n))));
}

#[test]
fn pairs_cover_nodes_that_go_elsewhere_than_expected() {
    for seed in 0..5 {
        let mut scene = approaching(8.0, seed);
        let topology = scene.tree.topology().clone();
        let ends: Vec<DVec3> =
            scene.position.iter().zip(&scene.velocity).map(|(x, v)| *x + *v * DT).collect();
        scene.own.pairs.find(&topology, &scene.position, |_| DVec3::ZERO, 1e-4);
        let few = scene.own.pairs.found().len();
        scene.own.pairs.cover(&topology, &ends, 1e-4);
        let all: BTreeSet<_> = scene.own.pairs.found().iter().copied().collect();
        assert!(all.len() > few);
        scene.own.pairs.find(&topology, &scene.position, |n| scene.velocity[n] * DT, 0.0);
        let expected: BTreeSet<_> = scene.own.pairs.found().iter().copied().collect();
        let touch = |p: &ClothPair| {
            let nodes = p.nodes(&topology);
            impact::ClothImpact::of(*p, nodes, [&scene.position, &ends], 1e-5).is_some()
        };
        let touching: Vec<_> = expected.iter().filter(|p| touch(p)).collect();
        assert!(touching.len() > 10 && touching.iter().all(|p| all.contains(p)), "{seed}");
    }
}

#[test]
fn sheets_that_approach_at_any_speed_do_not_pass_through_each_other() {
    let mut would = 0;
    for (speed, seed) in [(2.0, 1), (8.0, 2), (8.0, 3), (20.0, 4), (40.0, 5), (100.0, 6)] {
        let mut free = approaching(speed, seed);
        free.advance(|_, _| {});
        would += free.crossings();
        let mut scene = approaching(speed, seed);
        assert_eq!(scene.crossings(), 0);
        scene.contacts();
        scene.advance(|cloth, search| {
            stop_cloth(cloth, search, None);
            let left = Zones::new(cloth).settle(cloth, search, &[], |_, _| Vec::new());
            assert_eq!(left, 0, "{speed} m/s");
            assert!(search.impacts(cloth, None).iter().all(|i| i.height_before < 1.1e-5));
        });
        assert_eq!(scene.crossings(), 0, "{speed} m/s");
        assert!(scene.position.iter().all(|x| x.is_finite()));
    }
    assert!(would > 100, "{would} crossings if nothing stops them");
}

#[test]
fn zones_alone_stop_everything_and_keep_the_momentum() {
    let mut scene = approaching(20.0, 7);
    let momentum =
        |s: &Scene| -> DVec3 { s.velocity.iter().zip(&s.area).map(|(v, m)| *v * *m).sum() };
    let before = momentum(&scene);
    scene.contacts();
    scene.advance(|cloth, search| {
        assert_eq!(Zones::new(cloth).settle(cloth, search, &[], |_, _| Vec::new()), 0);
    });
    assert_eq!(scene.crossings(), 0);
    assert!(momentum(&scene).distance(before) < 1e-12 * before.length());
}

#[test]
fn impacts_keep_the_momentum_and_end_the_approach() {
    let mut scene = approaching(2.0, 9);
    let momentum =
        |s: &Scene| -> DVec3 { s.velocity.iter().zip(&s.area).map(|(v, m)| *v * *m).sum() };
    let energy = |s: &Scene| {
        s.velocity.iter().zip(&s.area).map(|(v, m)| v.length_squared() * m).sum::<f64>()
    };
    let (before, energy_before) = (momentum(&scene), energy(&scene));
    scene.velocity.iter_mut().for_each(|v| *v *= 4.0);
    scene.contacts();
    scene.advance(|cloth, search| {
        assert!(stop_cloth(cloth, search, None).impacts > 0);
    });
    assert!(momentum(&scene).distance(4.0 * before) < 1e-12 * energy_before.sqrt());
    assert!(energy(&scene) < 16.0 * energy_before);
}

#[test]
fn flat_cloth_is_at_ease_however_fine_and_a_fold_may_close() {
    // Cells of 6 mm, thickness 10 mm.
    let mut flat = Scene::new(&[sheet(160, |u| u.extend(0.0)).in_local_order()]);
    assert_eq!(flat.contacts(), []);
    // Folded over at x = 0.5, 4 mm apart.
    let place = |u: DVec2| {
        let over = u.x > 0.5;
        DVec3::new(if over { 1.0 - u.x } else { u.x }, u.y, if over { 0.004 } else { 0.0 })
    };
    let mut folded = Scene::new(&[sheet(40, place)]);
    let contacts = folded.contacts();
    assert!(contacts.len() > 1000);
    let at = |c: &ContactPoint| -> f64 {
        c.weights().map(|(n, w)| folded.position[n].x * w.abs()).sum::<f64>() / 2.0
    };
    assert!(contacts.iter().all(|c| c.normal.z.abs() > 0.9 && at(c) < 0.5));
    assert!(contacts.iter().any(|c| (c.gap + 0.006).abs() < 1e-9), "far from the fold");
}

#[test]
fn slivers_narrower_than_a_touch_are_at_ease_and_still_stopped() {
    // Every other column is 3 um wide, and cloth touches at 10 um.
    let flat = |i: u32, j: u32| {
        DVec2::new(0.1 * f64::from(i / 2) + 3e-6 * f64::from(i % 2), 0.05 * f64::from(j))
    };
    let slivers = |height: f64| grid(20, flat, |u| u.extend(height));
    let mut alone = Scene::new(&[slivers(0.0)]);
    assert_eq!(alone.contacts(), []);
    alone.advance(|cloth, search| assert_eq!(search.impacts(cloth, None).len(), 0));
    let mut two = Scene::new(&[slivers(0.0), slivers(0.02)]);
    let count = two.position.len();
    two.velocity[count / 2..].fill(DVec3::new(0.1, 0.2, -8.0));
    two.contacts();
    two.advance(|cloth, search| {
        stop_cloth(cloth, search, None);
        assert_eq!(Zones::new(cloth).settle(cloth, search, &[], |_, _| Vec::new()), 0);
        assert!(search.impacts(cloth, None).is_empty());
    });
    assert_eq!(two.crossings(), 0);
    // Sliding by up to a millimetre, the sides come off those of the other sheet.
    let (below, above) = two.position.split_at(count / 2);
    let is_inside = |x: &DVec3| x.truncate().cmpgt(DVec2::splat(0.01)).all() && x.x.max(x.y) < 0.99;
    let inside: Vec<_> = below.iter().zip(above).filter(|(_, x)| is_inside(x)).collect();
    assert!(inside.len() > 300 && inside.iter().all(|(low, high)| low.z < high.z));
}

#[test]
fn layers_of_two_garments_are_held_apart_by_the_whole_thickness() {
    let mut scene =
        Scene::new(&[sheet(5, |u| u.extend(0.0)), sheet(7, |u| (0.9 * u + 0.03).extend(0.004))]);
    let contacts = scene.contacts();
    for contact in &contacts {
        let is_across = contact.normal.z.abs() > 1.0 - 1e-9;
        assert!((contact.gap + 0.006).abs() < 1e-9 && is_across, "{contact:?}");
        assert!(contact.weights().map(|(_, w)| w).sum::<f64>().abs() < 1e-12);
        let push: f64 = contact
            .weights()
            .map(|(n, w)| w * contact.normal.z * if scene.position[n].z > 0.0 { 1.0 } else { -1.0 })
            .sum();
        assert!(push > 0.0, "it pushes apart");
    }
    let nodes: BTreeSet<usize> =
        contacts.iter().flat_map(|c| c.weights().map(|(n, _)| n)).collect();
    assert_eq!(nodes.len(), 36 + 64);
}

#[test]
fn garments_are_held_apart_by_the_mean_of_their_thicknesses() {
    let mut scene =
        Scene::new(&[sheet(5, |u| u.extend(0.0)), sheet(7, |u| (0.9 * u + 0.03).extend(0.004))]);
    scene.thickness[..36].fill(0.5 * SETTINGS.thickness);
    let contacts = scene.contacts();
    assert!(contacts.len() > 50);
    for contact in contacts {
        assert!((contact.gap + 0.0035).abs() < 1e-9, "{contact:?}");
    }
}

#[test]
fn a_lining_node_over_node_is_held_at_every_node() {
    let mut scene = Scene::new(&[sheet(4, |u| u.extend(0.0)), sheet(4, |u| u.extend(0.004))]);
    let contacts = scene.contacts();
    let nodes: BTreeSet<usize> =
        contacts.iter().flat_map(|c| c.weights().map(|(n, _)| n)).collect();
    assert_eq!(nodes.len(), 50);
    assert!(contacts.iter().all(|c| c.normal.z.abs() > 1.0 - 1e-12));
}

#[test]
fn a_zone_that_a_second_obstacle_hits_is_counted_whatever_else_moves() {
    use crate::collision::{NearMemory, ObstacleMotion, Shape};
    // A sheet between two plates that close faster than it can leave, beside cloth that is free.
    let between = sheet(4, |u| DVec3::new(u.x - 0.5, u.y - 0.5, 0.0));
    let mut scene = Scene::new(&[between]);
    let shape = std::sync::Arc::new(Shape::new(&crate::collision::tests::cube()));
    let pose =
        |z: f64| crate::scene::Pose { translation: DVec3::Z * z, ..crate::scene::Pose::IDENTITY };
    let closing = |z: f64| ObstacleMotion::new(shape.clone(), pose(1.02 * z), pose(0.8 * z), DT);
    let obstacles = [closing(1.0), closing(-1.0)];
    let memory = NearMemory::new(scene.position.len(), 2);
    scene.contacts();
    let tree = FaceTree::new(&scene.position, &scene.faces);
    let around =
        Surroundings { tree: &tree, obstacles: &obstacles, memory: &memory, settings: &SETTINGS };
    scene.advance(|cloth, search| {
        let found =
            |cloth: &MovedCloth<'_>, among: Option<&[bool]>| found_impacts(cloth, &around, among);
        assert!(Zones::new(cloth).settle(cloth, search, &obstacles, found) > 0);
    });
    assert!(scene.position.iter().all(|x| x.is_finite()));
}

#[test]
fn crossings_are_those_that_every_pair_tells() {
    let mut scene = approaching(6.0, 3);
    scene.advance(|_, _| {});
    let found = crossings(&scene.tree, &scene.position);
    let topology = scene.tree.topology();
    let mut all = Vec::new();
    for (edge, ends) in topology.edges().iter().map(|e| e.corners).enumerate() {
        for (face, nodes) in scene.faces.iter().enumerate() {
            let line = ends.map(|n| scene.position[n as usize]);
            let triangle = nodes.map(|n| scene.position[n as usize]);
            if !ends.iter().any(|n| nodes.contains(n)) && segment_passes_through(line, triangle) {
                all.push(Crossing { edge: edge as u32, face: face as u32 });
            }
        }
    }
    assert!(all.len() > 20);
    assert_eq!(found, all);
}

#[test]
fn the_guard_follows_edits_and_refuses_what_would_cross() {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let floor = [at(0.0, 0.0, 0.0), at(4.0, 0.0, 0.0), at(0.0, 4.0, 0.0)];
    let above = [at(1.0, 1.0, 0.1), at(1.5, 1.0, 0.1), at(1.0, 1.5, 0.1)];
    let through = [at(1.0, 1.0, -0.1), at(1.5, 1.0, 0.1), at(1.0, 1.5, 0.1)];
    let guard = ClothGuard::new(vec![floor, above]);
    let edit = |old: &[[DVec3; 3]], new: &[[DVec3; 3]]| Change {
        old_faces: old.to_vec(),
        new_faces: new.to_vec(),
    };
    assert!(!guard.allows(&edit(&[above], &[through])));
    assert!(guard.allows(&edit(&[above], &[above.map(|p| p + 0.1 * DVec3::Z)])));
    // Faces with a common corner cross by their other edges.
    let beside = [floor[0], at(1.0, 0.5, 0.3), at(0.5, 1.0, 0.3)];
    assert!(guard.allows(&edit(&[], &[beside])));
    assert!(guard.allows(&edit(&[], &[[floor[0], at(1.0, 0.5, -0.3), at(0.5, 1.0, -0.3)]])));
    assert!(!guard.allows(&edit(&[], &[[floor[0], at(1.0, 0.5, -0.3), at(0.5, 1.0, 0.3)]])));
    let lower = floor.map(|p| p - DVec3::Z);
    guard.note(&edit(&[floor], &[lower]));
    assert!(guard.allows(&edit(&[above], &[through])), "the floor is elsewhere");
    assert!(!guard.allows(&edit(&[above], &[through.map(|p| p - 0.99 * DVec3::Z)])));
}

#[test]
fn the_guard_tells_a_lining_from_the_shell_that_it_lies_on() {
    let floor = [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0];
    let at = |z: [f64; 3]| {
        let corners =
            [DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.5, 1.0, 0.0), DVec3::new(1.0, 1.5, 0.0)];
        [0, 1, 2].map(|k| corners[k] + DVec3::Z * z[k])
    };
    let (above, through) = (at([0.1; 3]), at([-0.1, 0.1, 0.1]));
    let guard = ClothGuard::new(vec![floor, floor, above]);
    let edit = |old: &[[DVec3; 3]], new: &[[DVec3; 3]]| Change {
        old_faces: old.to_vec(),
        new_faces: new.to_vec(),
    };
    assert!(!guard.allows(&edit(&[floor], &[through])), "the other floor stays");
    assert!(guard.allows(&edit(&[floor, floor], &[through])));
    let lower = floor.map(|p| p - DVec3::Z);
    guard.note(&edit(&[floor], &[lower]));
    assert!(!guard.allows(&edit(&[above], &[through])), "one floor is where it was");
    guard.note(&edit(&[floor], &[lower]));
    assert!(guard.allows(&edit(&[above], &[through])), "both floors are elsewhere");
    guard.note(&edit(&[lower, lower], &[]));
    assert!(guard.allows(&edit(&[above], &[at([-1.1, 0.1, 0.1])])), "no floor is left");
}

/// Along their ends that are near, edges close at the sum of both speeds, though each end is no faster
/// against the first one than half of that.
#[test]
fn edges_that_swing_towards_each_other_are_contacts_in_time() {
    const SPEED: f64 = 10.0;
    let way = SPEED * DT;
    let height = SETTINGS.thickness + 1.5 * way;
    let triangle = |corners: [[f64; 2]; 3], z: f64| {
        let raw = RawMesh {
            positions: corners.map(|u| DVec2::from(u).extend(z)).to_vec(),
            vertices: (0..).zip(corners.map(DVec2::from)).collect(),
            faces: vec![[0, 1, 2]],
            ..RawMesh::default()
        };
        Mesh::from_raw(&raw, &[]).unwrap()
    };
    let lower = triangle([[-1.0, 0.0], [0.02, 0.0], [-0.5, 1.0]], 0.0);
    let upper = triangle([[0.0, -0.02], [0.0, 1.0], [-1.0, 0.5]], height);
    let mut scene = Scene::new(&[lower, upper]);
    scene.velocity[1] = DVec3::Z * SPEED;
    scene.velocity[3] = DVec3::NEG_Z * SPEED;
    let is_of_edges = |c: &ContactPoint| {
        let mut nodes = c.nodes.map(|(node, _)| node);
        nodes.sort_unstable();
        nodes == [0, 1, 3, 4]
    };
    assert_eq!(scene.contacts().iter().filter(|c| is_of_edges(c)).count(), 1);
    scene.velocity[1] = DVec3::ZERO;
    assert_eq!(scene.contacts().iter().filter(|c| is_of_edges(c)).count(), 0);
}
