//! Nodes that are held, or led along a motion.

use std::collections::HashMap;

use glam::DVec3;

use crate::dynamics::HandleSpring;
use crate::mesh::{Id, Mesh, NodeId};
use crate::scene::{Handle, Scene};

/// Where each held node was when its handle took hold.
pub struct Anchors {
    /// Per handle and node of it.
    points: Vec<Vec<Option<DVec3>>>,
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

    /// The springs of all handles that hold at a time (s). A node's target moves with the handle's
    /// motion since the handle took hold.
    pub fn springs(
        &mut self,
        scene: &Scene,
        garments: &[Mesh],
        position: &[DVec3],
        time: f64,
    ) -> Vec<HandleSpring> {
        let mut springs = Vec::new();
        for (handle, points) in scene.handles.iter().zip(&mut self.points) {
            if time < handle.start_time || time > handle.end_time {
                continue;
            }
            let first: usize = garments[..handle.garment].iter().map(Mesh::node_count).sum();
            let nodes = nodes_by_input(&garments[handle.garment]);
            for (input, point) in handle.nodes.iter().zip(points) {
                let Some(node) = nodes.get(input) else { continue };
                let node = first + node.index();
                let anchor = *point.get_or_insert(position[node]);
                let target = moved(scene, handle, anchor, time);
                springs.push(HandleSpring { node, target, stiffness: scene.handle_stiffness });
            }
        }
        springs
    }
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
