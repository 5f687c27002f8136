//! `stats.csv`: a row per frame, readable while the simulation runs.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::RunError;
use crate::sim::{Frame, FrameReport};

/// The columns in order. More may follow in later versions; these stay first.
pub const STATS_COLUMNS: [&str; 36] = [
    "frame",
    "time_s",
    "faces",
    "vertices",
    "nodes",
    "wall_s",
    "cpu_s",
    "obstacles_s",
    "proximity_s",
    "dynamics_s",
    "collision_s",
    "sizing_s",
    "view_s",
    "remesh_s",
    "untangle_s",
    "other_s",
    "view_factor_min",
    "view_factor_mean",
    "intersections",
    "steps_taken",
    "largest_stretch",
    "stretch_99",
    "trapped_nodes",
    "contacts",
    "impacts",
    "degenerate_hinges",
    "splits",
    "collapses",
    "flips",
    "vetoes",
    "solutions",
    "solver_iterations",
    "factorisations",
    "unconverged_steps",
    "elastic_energy",
    "kinetic_energy",
];

/// Appends rows; each is in the file when `append` returns.
pub(super) struct StatsFile {
    file: File,
    path: PathBuf,
}

impl StatsFile {
    pub fn create(path: &Path) -> Result<Self, RunError> {
        let mut stats = Self {
            file: File::create(path).map_err(RunError::io("create", path))?,
            path: path.to_owned(),
        };
        stats.append_line(&STATS_COLUMNS.join(","))?;
        Ok(stats)
    }

    pub fn append_to(path: &Path) -> Result<Self, RunError> {
        let file = OpenOptions::new().append(true).open(path);
        Ok(Self { file: file.map_err(RunError::io("open", path))?, path: path.to_owned() })
    }

    /// `shown` is the frame's number with the shot's first frame added, `writing_cpu_seconds` what
    /// it took to write the frame's files.
    pub fn append(
        &mut self,
        shown: i64,
        frame: &Frame,
        writing_cpu_seconds: f64,
    ) -> Result<(), RunError> {
        self.append_line(&row(shown, frame, writing_cpu_seconds))
    }

    pub fn sync(self) -> Result<(), RunError> {
        self.file.sync_all().map_err(RunError::io("write", &self.path))
    }

    fn append_line(&mut self, line: &str) -> Result<(), RunError> {
        // One write a row, so that a reader never sees half of one.
        self.file
            .write_all(format!("{line}\n").as_bytes())
            .map_err(RunError::io("write", &self.path))
    }
}

/// The whole rows of a file by the frame they show; a row cut short is left out.
pub(super) fn rows(path: &Path) -> Vec<(i64, String)> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let is_whole = |line: &&str| line.ends_with('\n');
    text.split_inclusive('\n')
        .skip(1)
        .filter(is_whole)
        .map(str::trim_end)
        .filter(|line| line.split(',').count() >= STATS_COLUMNS.len())
        .filter_map(|line| Some((line.split(',').next()?.parse().ok()?, line.to_owned())))
        .collect()
}

/// Of the material area may be stretched more than `stretch_99` says.
const REST_SHARE: f64 = 0.01;

/// Numbers in the shortest form that reads back to the same bits.
pub(super) fn row(shown: i64, frame: &Frame, writing_cpu_seconds: f64) -> String {
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
        warnings: _,
    } = &frame.report;
    let mut fields = vec![
        shown.to_string(),
        frame.time.to_string(),
        frame.face_count().to_string(),
        frame.vertex_count().to_string(),
        frame.node_count().to_string(),
        stages.total().to_string(),
        (cpu_seconds + writing_cpu_seconds).to_string(),
    ];
    fields.extend(stages.entries().map(|(_, seconds)| seconds.to_string()));
    fields.extend([
        view_factor_min.to_string(),
        view_factor_mean.to_string(),
        intersections.map(|count| count.to_string()).unwrap_or_default(),
        steps_taken.to_string(),
        largest_stretch.to_string(),
        frame.stretch_of_all_but(REST_SHARE).to_string(),
        trapped_nodes.to_string(),
    ]);
    fields.extend(counts.entries().map(|(_, count)| count.to_string()));
    fields.extend([elastic_energy.to_string(), kinetic_energy.to_string()]);
    debug_assert_eq!(fields.len(), STATS_COLUMNS.len());
    fields.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{StageCounts, StageSeconds};

    #[test]
    fn the_stage_columns_are_the_stages_in_their_order() {
        let names = StageSeconds::default().entries().map(|(name, _)| format!("{name}_s"));
        assert_eq!(STATS_COLUMNS[7..16], names);
        let counts = StageCounts::default().entries().map(|(name, _)| name);
        assert_eq!(STATS_COLUMNS[23..34], counts);
    }
}
