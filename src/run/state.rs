//! A frame as bytes and back, bit for bit. `docs/run-folder.md` gives the layout.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use super::StateError;
use super::bytes::{ByteReader, ByteWriter};
use crate::mesh::{Mesh, MeshParts, NodeOrigin};
use crate::scene::Surface;
use crate::sim::{Frame, FrameReport, StageCounts, StageSeconds};

/// A frame's content, without the envelope.
pub(super) fn frame_bytes(frame: &Frame) -> Vec<u8> {
    let Frame { number, time, garments, obstacle_poses, obstacle_points, handle_anchors, report } =
        frame;
    let mut writer = ByteWriter::default();
    writer.put(*number);
    writer.put(*time);
    put_report(&mut writer, report);
    writer.count(garments.len());
    for garment in garments {
        put_mesh(&mut writer, &garment.to_parts());
    }
    writer.count(obstacle_poses.len());
    writer.items(obstacle_poses);
    put_anchors(&mut writer, handle_anchors);
    writer.count(obstacle_points.len());
    for (obstacle, points) in obstacle_points {
        writer.put(*obstacle);
        writer.count(points.len());
        writer.items(points);
    }
    writer.into_bytes()
}

/// The frame in a content of a known version. In version 1 there are no anchors, so that nothing that
/// has handles can go on from it, and no obstacles whose points move by themselves.
pub(super) fn frame_from_bytes(version: u32, bytes: &[u8]) -> Result<Frame, StateError> {
    let mut reader = ByteReader::new(bytes);
    let number = reader.get("frame number")?;
    let time = reader.get("time")?;
    let report = get_report(version, &mut reader)?;
    let garment_count = reader.count("garment count")?;
    let garments = (0..garment_count)
        .map(|index| {
            let parts = get_mesh(&mut reader)?;
            let mesh =
                Mesh::from_parts(parts).map_err(|source| StateError::Garment { index, source })?;
            Ok(Arc::new(mesh))
        })
        .collect::<Result<_, StateError>>()?;
    let pose_count = reader.count("obstacle count")?;
    let obstacle_poses = reader.items("obstacle poses", pose_count)?;
    let handle_anchors = if version < 2 { Vec::new() } else { get_anchors(&mut reader)? };
    let obstacle_points = if version < 2 { BTreeMap::new() } else { get_points(&mut reader)? };
    reader.end()?;
    Ok(Frame { number, time, garments, obstacle_poses, obstacle_points, handle_anchors, report })
}

fn put_anchors(writer: &mut ByteWriter, handles: &[Vec<Option<DVec3>>]) {
    writer.count(handles.len());
    for anchors in handles {
        writer.count(anchors.len());
        for anchor in anchors {
            writer.put(u8::from(anchor.is_some()));
        }
        for anchor in anchors {
            writer.put(anchor.unwrap_or(DVec3::ZERO));
        }
    }
}

fn get_anchors(reader: &mut ByteReader) -> Result<Vec<Vec<Option<DVec3>>>, StateError> {
    let handle_count = reader.count("handle count")?;
    let handle = |_| {
        let count = reader.count("held node count")?;
        let taken: Vec<u8> = reader.items("anchor flags", count)?;
        let points: Vec<DVec3> = reader.items("anchors", count)?;
        Ok(taken.into_iter().zip(points).map(|(taken, x)| (taken != 0).then_some(x)).collect())
    };
    (0..handle_count).map(handle).collect()
}

fn get_points(reader: &mut ByteReader) -> Result<BTreeMap<u32, Arc<Vec<DVec3>>>, StateError> {
    let count = reader.count("count of deforming obstacles")?;
    let points = |_| {
        let obstacle = reader.get("number of a deforming obstacle")?;
        let count = reader.count("point count")?;
        Ok((obstacle, Arc::new(reader.items("points", count)?)))
    };
    (0..count).map(points).collect()
}

fn put_report(writer: &mut ByteWriter, report: &FrameReport) {
    // Exhaustive, so that a new field cannot be forgotten here.
    let FrameReport {
        stages,
        counts,
        cpu_seconds,
        view_factor_min,
        view_factor_mean,
        intersections,
        steps_taken,
        largest_stretch,
        elastic_energy,
        kinetic_energy,
        trapped_nodes,
        warnings,
    } = report;
    writer.put(stages.entries().map(|(_, seconds)| seconds));
    writer.put(counts.entries().map(|(_, count)| count));
    writer.put([*cpu_seconds, *view_factor_min, *view_factor_mean, *largest_stretch]);
    writer.put([*elastic_energy, *kinetic_energy]);
    writer.put(*steps_taken);
    writer.put(u8::from(intersections.is_some()));
    writer.put(intersections.unwrap_or(0) as u64);
    writer.count(*trapped_nodes);
    writer.count(warnings.len());
    for warning in warnings {
        writer.text(warning);
    }
}

fn get_report(version: u32, reader: &mut ByteReader) -> Result<FrameReport, StateError> {
    let [obstacles, proximity, dynamics, collision, sizing, view, remesh, untangle, other] =
        reader.get("stage seconds")?;
    let stages = StageSeconds {
        obstacles,
        proximity,
        dynamics,
        collision,
        sizing,
        view,
        remesh,
        untangle,
        other,
    };
    let counts = get_counts(version, reader)?;
    let [cpu_seconds, view_factor_min, view_factor_mean, largest_stretch] =
        reader.get("frame measures")?;
    let [elastic_energy, kinetic_energy] =
        if version < 2 { [0.0; 2] } else { reader.get("energies")? };
    let steps_taken = reader.get("step count")?;
    let counted = reader.get::<u8>("intersection flag")?;
    let intersections: u64 = reader.get("intersection count")?;
    let trapped_nodes = reader.count("trapped node count")?;
    let warnings = get_warnings(reader)?;
    Ok(FrameReport {
        stages,
        counts,
        cpu_seconds,
        view_factor_min,
        view_factor_mean,
        intersections: (counted != 0).then_some(intersections as usize),
        steps_taken,
        largest_stretch,
        elastic_energy,
        kinetic_energy,
        trapped_nodes,
        warnings,
    })
}

/// Version 1 does not count solutions.
fn get_counts(version: u32, reader: &mut ByteReader) -> Result<StageCounts, StateError> {
    let [contacts, impacts, degenerate_hinges, splits, collapses, flips, vetoes] =
        reader.get("stage counts")?;
    let [solutions, solver_iterations, factorisations, unconverged_steps] =
        if version < 2 { [0; 4] } else { reader.get("solver counts")? };
    Ok(StageCounts {
        contacts,
        impacts,
        degenerate_hinges,
        splits,
        collapses,
        flips,
        vetoes,
        solutions,
        solver_iterations,
        factorisations,
        unconverged_steps,
    })
}

fn get_warnings(reader: &mut ByteReader) -> Result<Vec<String>, StateError> {
    let count = reader.count("warning count")?;
    (0..count)
        .map(|index| {
            let length = reader.count("warning length")?;
            let text = std::str::from_utf8(reader.take("warning", length)?);
            text.map(str::to_owned).map_err(|_| StateError::Text { index })
        })
        .collect()
}

fn put_mesh(writer: &mut ByteWriter, parts: &MeshParts) {
    writer.count(parts.position.len());
    writer.count(parts.material.len());
    writer.count(parts.vertices_of_face.len());
    writer.items(&parts.position);
    writer.items(&parts.velocity);
    for origin in &parts.node_origin {
        writer.put(origin_kind(*origin));
    }
    for origin in &parts.node_origin {
        writer.put(origin.input_index().unwrap_or(0));
    }
    writer.items(&parts.corner_of_node);
    writer.items(&parts.node_of_vertex);
    writer.items(&parts.material);
    writer.items(&parts.metric);
    writer.items(&parts.vertices_of_face);
    writer.items(&parts.view_factor);
    writer.items(&parts.opposite);
    writer.items(&parts.rest_angle);
}

fn get_mesh(reader: &mut ByteReader) -> Result<MeshParts, StateError> {
    let nodes = reader.count("node count")?;
    let vertices = reader.count("vertex count")?;
    let faces = reader.count("face count")?;
    let corners = faces.saturating_mul(3);
    Ok(MeshParts {
        position: reader.items("node positions", nodes)?,
        velocity: reader.items("node velocities", nodes)?,
        node_origin: get_origins(reader, nodes)?,
        corner_of_node: reader.items("corners of nodes", nodes)?,
        node_of_vertex: reader.items("nodes of vertices", vertices)?,
        material: reader.items("material positions", vertices)?,
        metric: reader.items("vertex metrics", vertices)?,
        vertices_of_face: reader.items("faces", faces)?,
        view_factor: reader.items("view factors", faces)?,
        opposite: reader.items("opposite corners", corners)?,
        rest_angle: reader.items("rest angles", corners)?,
    })
}

const KIND_SPLIT: u8 = 0;
const KIND_INPUT: u8 = 1;
const KIND_KEPT: u8 = 2;

fn origin_kind(origin: NodeOrigin) -> u8 {
    match origin {
        NodeOrigin::Split => KIND_SPLIT,
        NodeOrigin::Input { .. } => KIND_INPUT,
        NodeOrigin::Kept { .. } => KIND_KEPT,
    }
}

fn get_origins(reader: &mut ByteReader, nodes: usize) -> Result<Vec<NodeOrigin>, StateError> {
    let kinds: Vec<u8> = reader.items("node origin kinds", nodes)?;
    let indices: Vec<u32> = reader.items("node origin indices", nodes)?;
    let origin = |(&kind, &index): (&u8, &u32)| match kind {
        KIND_SPLIT => Ok(NodeOrigin::Split),
        KIND_INPUT => Ok(NodeOrigin::Input { index }),
        KIND_KEPT => Ok(NodeOrigin::Kept { index }),
        _ => Err(StateError::Value {
            what: "kind of a node's origin",
            found: u64::from(kind),
            expected: "0, 1 or 2",
        }),
    };
    kinds.iter().zip(&indices).map(origin).collect()
}

/// The obstacles at rest, without the envelope.
pub(super) fn obstacle_bytes(obstacles: &[Arc<Surface>]) -> Vec<u8> {
    let mut writer = ByteWriter::default();
    writer.count(obstacles.len());
    for surface in obstacles {
        writer.count(surface.positions.len());
        writer.count(surface.triangles.len());
        writer.items(&surface.positions);
        writer.items(&surface.triangles);
    }
    writer.into_bytes()
}

/// The obstacles in a content of version 1, the only one so far.
pub(super) fn obstacles_from_bytes(
    _version: u32,
    bytes: &[u8],
) -> Result<Vec<Arc<Surface>>, StateError> {
    let mut reader = ByteReader::new(bytes);
    let obstacle_count = reader.count("obstacle count")?;
    let obstacles = (0..obstacle_count)
        .map(|index| {
            let points = reader.count("point count")?;
            let triangles = reader.count("triangle count")?;
            let surface = Surface {
                positions: reader.items("points", points)?,
                triangles: reader.items("triangles", triangles)?,
            };
            check_triangles(index, &surface)?;
            Ok(Arc::new(surface))
        })
        .collect::<Result<_, StateError>>()?;
    reader.end()?;
    Ok(obstacles)
}

fn check_triangles(obstacle: usize, surface: &Surface) -> Result<(), StateError> {
    let count = surface.positions.len();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|&&point| point as usize >= count) {
            return Err(StateError::Triangle { obstacle, triangle, point, count });
        }
    }
    Ok(())
}
