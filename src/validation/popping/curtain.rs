//! A curtain gathered into folds along its upper edge, which hangs still before a camera that pans.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::super::sheet::{Layout, Sheet};
use super::super::specimen::{Rest, Specimen};
use super::super::{ExperimentError, GRAVITY, stage};
use crate::dynamics::HandleSpring;
use crate::mesh::{Id, IdVec, Mesh, NodeId};
use crate::scene::{
    Air, ElasticFabric, Fabric, Handle, Preset, Scene, SizingSettings, StageSwitches,
};
use crate::shot::{CameraKey, CameraPath, Lens, Track};
use crate::sim::{Frame, SimSettings, Simulation, SizingMode};

/// Of the cloth, square (m).
const SIDE: f64 = 0.8;
/// Of the mesh before it is first refined (m).
const CELL: f64 = 0.04;

/// Cloth in a fold (m), and the steepest angle of its flanks to the rod (rad).
const FOLD: f64 = 0.2;
const STEEPNESS: f64 = 1.0;

/// Of the camera before the curtain (m), and the angle of view (rad): 1.5 mm a pixel.
const DISTANCE: f64 = 1.1;
const FIELD_OF_VIEW: f64 = 0.7;
const RESOLUTION: [u32; 2] = [960, 540];

/// Frames in which the camera stands still: none of them foresees the pan.
const STILL: u32 = 5;
/// Frames in which it is foreseen.
const FORESEEN: u32 = 5;
/// Frames of the pan, either way.
const PAN: u32 = 30;
pub const LAST: u32 = STILL + FORESEEN + 2 * PAN;

/// How far the camera pans (m): most of the curtain leaves the frame, its far end by more than the
/// margin of the view factor.
const REACH: f64 = 0.9;

/// Rounds of meshing and settling.
const ROUNDS: usize = 6;

/// Of forces on the curtain at rest, in its weight.
const RESIDUAL: f64 = 1e-4;

/// Shortest and longest edge that the remesher makes before the view coarsens it (m).
const FINEST: f64 = 0.015;
const COARSEST: f64 = 0.15;

/// All but the camera hangs still.
pub fn scene() -> Scene {
    let (mesh, held) = gathered();
    let mut garment = stage::garment(mesh, Fabric::Elastic(cotton()));
    garment.sizing = SizingSettings {
        edge_length_min: FINEST,
        edge_length_max: COARSEST,
        ..SizingSettings::default()
    };
    let mut scene = stage::scene(vec![garment]);
    scene.air = Air::default();
    scene.stages.remeshing = true;
    scene.handles = vec![Handle {
        garment: 0,
        nodes: held,
        motion: None,
        start_time: 0.0,
        end_time: f64::INFINITY,
    }];
    scene.viewers = vec![camera()];
    scene
}

fn cotton() -> ElasticFabric {
    Preset::named("cotton").expect("there is such a preset").fabric()
}

/// E h e / (rho l), what a strain e of the faces beside it does to a node among the shortest edges l
/// (m/s^2).
pub fn acceleration_of(strain: f64) -> f64 {
    let cotton = cotton();
    let [warp, weft] = cotton.membrane_stiffness;
    warp.max(weft) * strain / (cotton.density * FINEST)
}

/// How many pixels the curtain goes in a frame at 1 m/s.
pub fn pixels_a_frame() -> f64 {
    let pixel = 2.0 * DISTANCE * (0.5 * FIELD_OF_VIEW).tan() / f64::from(RESOLUTION[1]);
    scene().frame_time() / pixel
}

/// The mesh and the nodes of its upper edge.
fn gathered() -> (Mesh, Vec<u32>) {
    let sheet = Sheet {
        origin: DVec2::splat(-0.5 * SIDE),
        size: DVec2::splat(SIDE),
        cell: CELL,
        layout: Layout::Irregular,
        columns: Vec::new(),
    };
    let raw = sheet.raw(|u| folded(u.x).extend(u.y));
    let upper = (0..).zip(&raw.vertices).filter(|(_, (_, u))| u.y > 0.4999 * SIDE);
    let held: Vec<u32> = upper.map(|(_, (node, _))| *node).collect();
    (Mesh::from_raw(&raw, &held).expect("a sheet is a mesh"), held)
}

/// Where a vertical line of the cloth is seen from above, along the rod and off it (m). Along the
/// cloth the angle to the rod is a sine, so that nothing is stretched.
fn folded(u: f64) -> DVec2 {
    const PARTS: u32 = 200;
    let step = u / f64::from(PARTS);
    let angle = |k: u32| STEEPNESS * (TAU * (f64::from(k) + 0.5) * step / FOLD).sin();
    (0..PARTS).map(|k| DVec2::from_angle(angle(k)) * step).sum()
}

fn camera() -> CameraPath {
    let key = |frame: u32, way: f64| CameraKey {
        frame: f64::from(frame),
        eye: DVec3::new(way, -DISTANCE, 0.0),
        target: DVec3::X * way,
        up: DVec3::Z,
        lens: Lens::FieldOfView { fov_y: FIELD_OF_VIEW },
        cut: false,
    };
    let start = STILL + FORESEEN;
    CameraPath {
        name: "shot".into(),
        resolution: RESOLUTION,
        pixel_aspect: 1.0,
        near: 0.05,
        far: 20.0,
        track: Track::Keys(vec![
            key(0, 0.0),
            key(start, 0.0),
            key(start + PAN, REACH),
            key(start + 2 * PAN, 0.0),
        ]),
    }
}

/// The curtain at rest, meshed as the camera asks at frame 0; meshing and settling take turns.
pub fn at_rest(scene: &Scene) -> Result<Frame, ExperimentError> {
    let frozen = StageSwitches { dynamics: false, ..scene.stages };
    let meshing = Arc::new(Scene { stages: frozen, ..scene.clone() });
    let mesh = &scene.garments[0].mesh;
    let place = |&input: &u32| Some(mesh.position[node_of(mesh, input)?]);
    let given = Frame {
        garments: vec![Arc::new(mesh.clone())],
        handle_anchors: vec![scene.handles[0].nodes.iter().map(place).collect()],
        ..Frame::default()
    };
    let mut frame = settled(scene, given)?;
    for _ in 0..ROUNDS {
        let meshed = next(&meshing, &frame)?;
        frame = settled(scene, meshed)?;
    }
    Ok(frame)
}

/// The same at rest, as frame 0.
fn settled(scene: &Scene, frame: Frame) -> Result<Frame, ExperimentError> {
    let mut specimen = specimen(scene, &frame);
    let load = specimen.mass() * GRAVITY;
    specimen.settle(&Rest { residual: RESIDUAL, load, first_step: 1e-2, steps_max: 3000 })?;
    let mut mesh = specimen.into_mesh();
    mesh.velocity = IdVec::filled(DVec3::ZERO, mesh.node_count());
    Ok(Frame { number: 0, time: 0.0, garments: vec![Arc::new(mesh)], ..frame })
}

/// The frame after another.
pub fn next(scene: &Arc<Scene>, frame: &Frame) -> Result<Frame, ExperimentError> {
    let settings = SimSettings { sizing: SizingMode::View };
    Ok(Simulation::from_frame(scene.clone(), settings, frame)?.advance()?)
}

/// The curtain of a frame, hung where the scene holds it.
pub fn specimen(scene: &Scene, frame: &Frame) -> Specimen {
    let mut specimen = Specimen::new((*frame.garments[0]).clone(), &scene.garments[0].fabric);
    specimen.gravity = scene.gravity;
    let held = scene.handles[0].nodes.iter().zip(&frame.handle_anchors[0]);
    for (&input, &target) in held {
        if let (Some(node), Some(target)) = (node_of(&specimen.mesh, input), target) {
            let (node, stiffness) = (node.index(), scene.handle_stiffness);
            specimen.clamps.push(HandleSpring { node, target, stiffness });
        }
    }
    specimen
}

fn node_of(mesh: &Mesh, input: u32) -> Option<NodeId> {
    mesh.node_ids().find(|&n| mesh.node_origin(n).input_index() == Some(input))
}
