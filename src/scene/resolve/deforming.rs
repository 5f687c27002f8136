//! Obstacles whose points move by themselves: meshes with times, as a list or as numbered files.

use std::sync::Arc;

use super::{Limit, Resolver};
use crate::scene::error::{LoadError, Place, Problem};
use crate::scene::native::{MeshKeyFile, MeshSequenceFile, ObstacleFile};
use crate::scene::numbered::numbered;
use crate::scene::obj::{Flat, surface_from_obj};
use crate::scene::{Deformation, PointKey, Surface};

/// No sequence is longer; a pattern that always names a file would be read forever.
const SEQUENCE_LENGTH_MAX: u32 = 100_000;

impl Resolver<'_> {
    /// The first file, the surface in it, and how its points move.
    pub(super) fn deforming(
        &mut self,
        path: &str,
        file: &ObstacleFile,
    ) -> Result<(String, Arc<Surface>, Deformation), LoadError> {
        let (path, meshes) = match (&file.meshes, &file.mesh_sequence) {
            (Some(meshes), _) => (format!("{path}.meshes"), meshes.clone()),
            (None, Some(sequence)) => {
                let path = format!("{path}.mesh_sequence");
                let meshes = self.sequence(&path, sequence)?;
                (path, meshes)
            }
            (None, None) => (path.to_owned(), Vec::new()),
        };
        let place = self.document.place_of(&path);
        let Some(first_file) = meshes.first().map(|key| key.mesh.clone()) else {
            let (thing, needed) = (path, "at least one mesh");
            return Err(Problem::Missing { thing, needed }.at(place));
        };
        let mut first: Option<Surface> = None;
        let mut keys = Vec::with_capacity(meshes.len());
        for mesh in &meshes {
            let (file, text) = self.text_at(&path, &mesh.mesh)?;
            let file = file.to_string_lossy();
            let surface = surface_from_obj(&file, &text, Flat::Kept, self.warnings)?;
            let first = first.get_or_insert_with(|| surface.clone());
            check_same_triangles(&file, &first_file, first, &surface)?;
            keys.push(PointKey { time: mesh.time, positions: surface.positions });
        }
        let deformation = Deformation::from_keys(keys)
            .map_err(|error| Problem::Deformation { thing: path, error }.at(place))?;
        let first = Arc::new(first.unwrap_or_default());
        self.warn_of_open_edges(&first_file, &first);
        Ok((first_file, first, deformation))
    }

    /// The files of a sequence, as far as there are any, and their times.
    fn sequence(&self, path: &str, file: &MeshSequenceFile) -> Result<Vec<MeshKeyFile>, LoadError> {
        self.check(&format!("{path}.fps"), file.fps, Limit::Positive)?;
        self.check(&format!("{path}.start_time"), file.start_time, Limit::Finite)?;
        let last_max = file.first.saturating_add(SEQUENCE_LENGTH_MAX - 1);
        let last = file.last.unwrap_or(last_max);
        if last < file.first || last > last_max {
            let limit = format!("from {} (first) to {last_max}", file.first);
            return Err(self.out_of_range(&format!("{path}.last"), last, &limit));
        }
        let mut meshes = Vec::new();
        for number in file.first..=last {
            let Some(mesh) = numbered(&file.pattern, number as usize) else { break };
            // A last file that is named must be there.
            if file.last.is_none() && !self.is_file(&mesh) {
                break;
            }
            let time = file.start_time + f64::from(number - file.first) / file.fps;
            meshes.push(MeshKeyFile { time, mesh });
        }
        if meshes.is_empty() {
            let thing = format!("the pattern {:?}", file.pattern);
            let needed = "one %d, as in body.%04d.obj, and a file with the first number";
            let place = self.document.place_of(&format!("{path}.pattern"));
            return Err(Problem::Missing { thing, needed }.at(place));
        }
        Ok(meshes)
    }
}

fn check_same_triangles(
    file: &str,
    first_file: &str,
    first: &Surface,
    surface: &Surface,
) -> Result<(), LoadError> {
    if surface.positions.len() == first.positions.len() && surface.triangles == first.triangles {
        return Ok(());
    }
    let count = |s: &Surface| [s.positions.len(), s.triangles.len()];
    let (found, expected) = (count(surface), count(first));
    let problem = Problem::OtherTriangles { first: first_file.to_owned(), found, expected };
    Err(problem.at(Place::File { file: file.into() }))
}
