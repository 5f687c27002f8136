//! What the remeshing at the end of a frame changes.

use std::sync::Arc;

use glam::DVec3;

use super::super::ExperimentError;
use super::curtain::{next, specimen};
use crate::mesh::{Id, Mesh, NodeId};
use crate::resample::{
    ClothMap, Locator, MaterialPoint, Pair, Shown, SilhouetteDifference, Spread,
};
use crate::scene::Scene;
use crate::shot::View;
use crate::sim::Frame;

/// The same cloth with and without a remeshing. What is of nodes is weighted by material area; all
/// zero where nothing was edited, but for the speed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Change {
    pub edits: u64,
    /// Of the free nodes, as if all were at rest, before and after (m/s^2).
    pub acceleration: [Spread; 2],
    /// Velocity gained over the next frame against the cloth that was not remeshed, of what is in
    /// the picture (m/s).
    pub gain_in_picture: Spread,
    /// Speed at the frame itself (m/s).
    pub speed_in_picture: Spread,
    /// Of the cloth in the picture (px).
    pub shift: Spread,
    pub silhouette: SilhouetteDifference,
}

/// A shot with and without remeshing.
pub struct Shot {
    pub remeshed: Arc<Scene>,
    pub kept: Arc<Scene>,
}

impl Shot {
    pub fn new(scene: Scene) -> Self {
        let mut kept = scene.clone();
        kept.stages.remeshing = false;
        Self { remeshed: Arc::new(scene), kept: Arc::new(kept) }
    }

    /// The frame after another, and what the remeshing at its end has changed.
    pub fn advance(&self, frame: &Frame) -> Result<(Frame, Change), ExperimentError> {
        let before = next(&self.kept, frame)?;
        let after = next(&self.remeshed, frame)?;
        let view = self.kept.viewers[0].view(f64::from(after.number));
        let mut change = Change {
            edits: after.report.counts.edits(),
            speed_in_picture: spread(&after.garments[0], |mesh, node| {
                is_in(&view, mesh.position[node]).then(|| mesh.velocity[node].length())
            }),
            silhouette: SilhouetteDifference { share: 0.0, distance: Some(0.0) },
            ..Change::default()
        };
        if change.edits == 0 {
            return Ok((after, change));
        }
        change.acceleration = [&before, &after].map(|frame| self.acceleration(frame));
        let [kept, gained] = [next(&self.kept, &before)?, next(&self.kept, &after)?];
        let gain = Gain { locator: Locator::new(kept.garments[0].clone()) };
        let mesh = &gained.garments[0];
        change.gain_in_picture = spread(mesh, |mesh, node| {
            is_in(&view, mesh.position[node]).then(|| gain.of(mesh, node))
        });
        let [reference, other] = [before, after.clone()].map(ClothMap::new);
        let now = Pair { reference: &reference, other: &other };
        let shown = Shown { now, before: None, surfaces: &[], view: &view, size: view.resolution };
        let error = shown.measure().expect("the cloth is the same").error;
        change.shift = error.displacement;
        change.silhouette = error.silhouette;
        Ok((after, change))
    }

    /// Of all nodes that nothing holds.
    fn acceleration(&self, frame: &Frame) -> Spread {
        let mut cloth = specimen(&self.kept, frame);
        let forces = cloth.forces();
        let masses = cloth.system.masses();
        spread(&cloth.mesh, |_, node| {
            let node = node.index();
            let is_held = cloth.clamps.iter().any(|clamp| clamp.node == node);
            (!is_held).then(|| forces[node].length() / masses[node])
        })
    }
}

/// What nodes have gained on the same points of another mesh.
struct Gain {
    locator: Locator,
}

impl Gain {
    fn of(&self, mesh: &Mesh, node: NodeId) -> f64 {
        let corner = mesh.corners_around(node).next().expect("a node has a face");
        let position = mesh.material(mesh.vertex_at(corner));
        let place = self.locator.locate(MaterialPoint { panel: 0, position });
        let other = self.locator.mesh();
        let nodes = other.face_nodes(place.face);
        let velocity: DVec3 = (0..3).map(|k| other.velocity[nodes[k]] * place.barycentric[k]).sum();
        mesh.velocity[node].distance(velocity)
    }
}

fn spread(mesh: &Mesh, value: impl Fn(&Mesh, NodeId) -> Option<f64>) -> Spread {
    let areas = mesh.node_areas();
    let nodes = mesh.node_ids();
    Spread::weighted(nodes.filter_map(|node| Some((value(mesh, node)?, areas[node]))))
}

fn is_in(view: &View, point: DVec3) -> bool {
    let [width, height] = view.resolution.map(f64::from);
    view.point_in_image(point)
        .is_some_and(|p| (0.0..=width).contains(&p.x) && (0.0..=height).contains(&p.y))
}
