//! Nodes that are held, or led along a motion.

use std::collections::HashMap;

use glam::DVec3;

use crate::dynamics::HandleSpring;
use crate::mesh::{Id, Mesh, NodeId};
use crate::scene::{Handle, Scene};

/// Where each held node was when its handle took hold.
pub struct Anchors {
    /// Per handle and node of it, as in [`Frame::handle_anchors`](super::Frame::handle_anchors).
    points: Vec<Vec<Option<DVec3>>>,
}

/// The global numbers of the nodes that handles hold: per handle and node of it. They change with
/// every remeshing.
pub struct HeldNodes(Vec<Vec<Option<usize>>>);

impl HeldNodes {
    pub fn new(scene: &Scene, garments: &[Mesh]) -> Self {
        let of = |handle: &Handle| {
            let first: usize = garments[..handle.garment].iter().map(Mesh::node_count).sum();
            let nodes = nodes_by_input(&garments[handle.garment]);
            handle.nodes.iter().map(|input| Some(first + nodes.get(input)?.index())).collect()
        };
        Self(scene.handles.iter().map(of).collect())
    }
}

impl Anchors {
    /// Handles that hold from the beginning hold the nodes where the scene puts them.
    pub fn new(scene: &Scene) -> Self {
        let of = |handle: &Handle| {
            let mesh = &scene.garments[handle.garment].mesh;
            let nodes = nodes_by_input(mesh);
            let place = |n: &u32| {
                (handle.start_time <= 0.0)
                    .then(|| nodes.get(n).map(|&n| mesh.position[n]))
                    .flatten()
            };
            handle.nodes.iter().map(place).collect()
        };
        Self { points: scene.handles.iter().map(of).collect() }
    }

    /// The anchors of a published frame.
    pub fn published(points: &[Vec<Option<DVec3>>]) -> Self {
        Self { points: points.to_vec() }
    }

    pub fn points(&self) -> &[Vec<Option<DVec3>>] {
        &self.points
    }

    /// The springs of all handles that hold at a time (s). A node's target moves with the handle's
    /// motion since the handle took hold; a node that it takes hold of now is held where it is.
    pub fn springs(
        &self,
        scene: &Scene,
        held: &HeldNodes,
        position: &[DVec3],
        time: f64,
    ) -> Vec<HandleSpring> {
        let mut springs = Vec::new();
        for (index, handle) in scene.handles.iter().enumerate().filter(|(_, h)| holds(h, time)) {
            for (&node, &point) in held.0[index].iter().zip(&self.points[index]) {
                let Some(node) = node else { continue };
                let target = moved(scene, handle, point.unwrap_or(position[node]), time);
                springs.push(HandleSpring { node, target, stiffness: scene.handle_stiffness });
            }
        }
        springs
    }

    /// Remembers where the nodes were of which a handle took hold in a step that ended at `time`
    /// (s). `position` is from the start of the step.
    pub fn take_hold(&mut self, scene: &Scene, held: &HeldNodes, position: &[DVec3], time: f64) {
        for (index, _) in scene.handles.iter().enumerate().filter(|(_, h)| holds(h, time)) {
            for (&node, point) in held.0[index].iter().zip(&mut self.points[index]) {
                if let Some(node) = node {
                    point.get_or_insert(position[node]);
                }
            }
        }
    }
}

fn holds(handle: &Handle, time: f64) -> bool {
    (handle.start_time..=handle.end_time).contains(&time)
}

fn moved(scene: &Scene, handle: &Handle, anchor: DVec3, time: f64) -> DVec3 {
    match handle.motion {
        None => anchor,
        Some(motion) => {
            let motion = &scene.motions[motion];
            let from_start = motion.pose(time) * motion.pose(handle.start_time.max(0.0)).inverse();
            from_start.transform_point(anchor)
        }
    }
}

fn nodes_by_input(mesh: &Mesh) -> HashMap<u32, NodeId> {
    let pairs = mesh.node_ids().filter_map(|n| Some((mesh.node_origin(n).input_index()?, n)));
    pairs.collect()
}
