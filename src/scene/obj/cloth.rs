//! A garment's OBJ: `v` are nodes in the world, `vt` vertices in the flat cloth, `f node/vert`.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{Counts, Line, fan, lines};
use crate::mesh::{MeshError, RawMesh};
use crate::scene::Pose;
use crate::scene::error::{LoadError, Place, Problem};

/// A garment's mesh and the line of the file which each part comes from.
#[derive(Clone, Debug)]
pub(in crate::scene) struct ClothObj {
    pub raw: RawMesh,
    file: Arc<str>,
    node_lines: Vec<usize>,
    face_lines: Vec<usize>,
}

impl ClothObj {
    /// Reads `v`, `vt`, `f`, `nv` (velocity of the node before it), `e` and `ea` (an edge's rest
    /// angle); other keywords are labels and are skipped. Without `vt` the flat cloth is the xy
    /// of the nodes.
    ///
    /// # Errors
    /// Numbers and indices that are none, with their line.
    pub fn parse(file: &str, text: &str) -> Result<Self, LoadError> {
        let file: Arc<str> = file.into();
        let mut parts = Parts { counts: Some(Counts::of(&file, text)), ..Parts::default() };
        for line in lines(&file, text) {
            parts.line(line)?;
        }
        Ok(parts.into_obj(file))
    }

    /// Places the cloth in the world; a scale applies to the flat cloth as well.
    pub fn transform(&mut self, pose: Pose) {
        for position in &mut self.raw.positions {
            *position = pose.transform_point(*position);
        }
        for velocity in &mut self.raw.velocities {
            *velocity = pose.transform_vector(*velocity);
        }
        for (_, material) in &mut self.raw.vertices {
            *material *= pose.scale;
        }
    }

    /// True if some node has several vertices.
    pub fn has_seams(&self) -> bool {
        let mut seen = vec![false; self.raw.positions.len()];
        let repeated =
            |&(node, _): &(u32, DVec2)| std::mem::replace(&mut seen[node as usize], true);
        self.raw.vertices.iter().any(repeated)
    }

    /// The line at fault, if the error is about one.
    pub fn place_of(&self, error: &MeshError) -> Place {
        let face = |face: usize| self.face_lines.get(face);
        let node = |node: usize| self.node_lines.get(node);
        let line = match *error {
            MeshError::VertexOutOfRange { face: f, .. }
            | MeshError::RepeatedNode { face: f }
            | MeshError::ZeroArea { face: f, .. }
            | MeshError::Inverted { face: f, .. }
            | MeshError::NonManifoldEdge { face: f, .. }
            | MeshError::InconsistentOrientation { second: f, .. } => face(f),
            MeshError::NonFiniteNode { node: n, .. } | MeshError::NonManifoldNode { node: n } => {
                node(n)
            }
            MeshError::NonFiniteVertex { vertex } => {
                let vertex = u32::try_from(vertex).unwrap_or(u32::MAX);
                face(self.raw.faces.iter().position(|f| f.contains(&vertex)).unwrap_or(usize::MAX))
            }
            _ => None,
        };
        let file = self.file.clone();
        match line {
            Some(&line) => Place::Line { file, line },
            None => Place::File { file },
        }
    }
}

#[derive(Default)]
struct Parts {
    counts: Option<Counts>,
    positions: Vec<DVec3>,
    velocities: Vec<(usize, DVec3)>,
    materials: Vec<DVec2>,
    /// Corners as (vertex, node), so that vertices keep the order of the file.
    faces: Vec<[(u32, u32); 3]>,
    edge: Option<[u32; 2]>,
    rest_angles: Vec<([u32; 2], f64)>,
    node_lines: Vec<usize>,
    face_lines: Vec<usize>,
}

impl Parts {
    fn line(&mut self, mut line: Line<'_>) -> Result<(), LoadError> {
        let counts = self.counts.expect("counted before reading");
        match line.keyword {
            "v" => {
                self.positions.push(line.point()?);
                self.node_lines.push(line.number);
            }
            "nv" => {
                let velocity = line.point()?;
                let node = self.positions.len().checked_sub(1);
                let found = "nv".to_owned();
                let node = node.ok_or_else(|| {
                    line.error(Problem::Token { expected: "v before its nv", found })
                })?;
                self.velocities.push((node, velocity));
            }
            "vt" => self.materials.push(DVec2::new(line.number()?, line.number()?)),
            "f" => self.face(line, counts)?,
            "e" => {
                let ends = [line.number()?, line.number()?];
                self.edge = Some(ends.map(|n| (n - 1.0) as u32));
            }
            "ea" => {
                let angle = line.number()?;
                self.rest_angles.extend(self.edge.map(|edge| (edge, angle)));
            }
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, mut line: Line<'_>, counts: Counts) -> Result<(), LoadError> {
        let mut corners = Vec::new();
        for (node, vertex) in line.corners(counts)? {
            match vertex {
                Some(vertex) => corners.push((vertex, node)),
                None if counts.vertices == 0 => corners.push((node, node)),
                None => {
                    let found = format!("{}", node + 1);
                    let expected = "a corner with its vertex, such as 1/2";
                    return Err(line.error(Problem::Token { expected, found }));
                }
            }
        }
        for triangle in fan(&corners) {
            self.faces.push(triangle);
            self.face_lines.push(line.number);
        }
        Ok(())
    }

    fn into_obj(self, file: Arc<str>) -> ClothObj {
        let Self { positions, materials, faces, node_lines, face_lines, rest_angles, .. } = self;
        let mut numbers: BTreeMap<(u32, u32), u32> =
            faces.iter().flatten().map(|&corner| (corner, 0)).collect();
        let mut vertices = Vec::with_capacity(numbers.len());
        for (&(vertex, node), number) in &mut numbers {
            *number = vertices.len() as u32;
            let flat = materials.get(vertex as usize).copied();
            vertices.push((node, flat.unwrap_or(positions[node as usize].truncate())));
        }
        let mut velocities = Vec::new();
        if !self.velocities.is_empty() {
            velocities = vec![DVec3::ZERO; positions.len()];
            self.velocities.iter().for_each(|&(node, velocity)| velocities[node] = velocity);
        }
        let faces = faces.iter().map(|face| face.map(|corner| numbers[&corner])).collect();
        let raw = RawMesh { positions, velocities, vertices, faces, rest_angles };
        ClothObj { raw, file, node_lines, face_lines }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    /// Two triangles joined by a seam along nodes 2 and 3.
    const SEAM: &str = "\
v 0 0 0\nnv 1 2 3\nv 1 0 0\nv 0 1 0\nv 1 1 0\nt 5
vt 0 0 0\nvv 0 0\nvt 1 0\nvt 0 1\nvt 5 0\nvt 6 1\nvt 5 1
f 1/1 2/2 3/3\nf 2/4 4/5 3/6/9
e 2 3\nea 0.5\nunknown words here\n";

    #[test]
    fn nodes_and_vertices_are_told_apart_at_seams() {
        let obj = ClothObj::parse("seam.obj", SEAM).unwrap();
        assert!(obj.has_seams());
        assert_eq!(obj.raw.positions.len(), 4);
        assert_eq!(obj.raw.vertices.len(), 6);
        assert_eq!(obj.raw.vertices[3], (1, DVec2::new(5.0, 0.0)));
        assert_eq!(obj.raw.velocities[0], DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(obj.raw.rest_angles, [([1, 2], 0.5)]);
        let mesh = Mesh::from_raw(&obj.raw, &[]).unwrap();
        assert_eq!(mesh.check(), Ok(()));
    }

    #[test]
    fn without_vt_the_flat_cloth_is_the_xy_of_the_nodes() {
        let text = "v 0 0 5\nv 2 0 5\nv 2 2 5\nv 0 2 5\nf 1 2 3 -1\n";
        let mut obj = ClothObj::parse("flat.obj", text).unwrap();
        assert!(!obj.has_seams());
        assert_eq!(obj.raw.faces, [[0, 1, 2], [0, 2, 3]]);
        obj.transform(Pose { scale: 0.5, translation: DVec3::X, ..Pose::IDENTITY });
        assert_eq!(obj.raw.vertices[2], (2, DVec2::ONE));
        assert_eq!(obj.raw.positions[2], DVec3::new(2.0, 1.0, 2.5));
    }

    #[test]
    fn bad_lines_are_named() {
        for (text, expected) in [
            ("v 0 0 0\nv 1 zero 0", "a.obj:2: expected a finite number, found \"zero\""),
            ("v 0 nan 0", "a.obj:1: expected a finite number, found \"nan\""),
            ("v 0 0", "a.obj:1: expected a finite number, found \"\""),
            ("v 0 0 0\n\nf 1 1 2", "a.obj:3: a face names node 2, but there are 1"),
            ("v 0 0 0\nf 0 1 1", "a.obj:2: a face names node 0, but there are 1"),
            ("v 0 0 0\nvt 0 0\nf 1/1 1/3 1/1", "a.obj:3: a face names vertex 3, but there are 1"),
            ("v 0 0 0\nf 1 1", "a.obj:2: the number of corners of a face is 2"),
            ("nv 0 0 0", "a.obj:1: expected v before its nv"),
        ] {
            let error = ClothObj::parse("a.obj", text).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }

    #[test]
    fn mesh_errors_point_at_the_line_of_the_face() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n";
        let obj = ClothObj::parse("a.obj", text).unwrap();
        let error = Mesh::from_raw(&obj.raw, &[]).unwrap_err();
        assert_eq!(obj.place_of(&error).to_string(), "a.obj:6");
    }
}
