//! Runs of one shot held against a reference run: what each cost and how far off it was.

use serde_json::{Map, Value, json};

use crate::compare::{Judged, Metric, short, visible_error_values};

/// A reference and what was held against it.
#[derive(Clone, Debug)]
pub struct Study {
    pub shot: String,
    pub reference: Reference,
    pub subjects: Vec<Subject>,
}

/// What the reference run was.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Asked for: the 10th percentile of the adaptive run's edges (m, flat cloth).
    pub edge_length_wanted: f64,
    /// The mean that its mesh has (m).
    pub edge_length_mean: f64,
    pub steps_per_frame: u32,
    pub newton_iterations: u32,
    /// Steps of both references that used up their Newton iterations: 0, or the reference is not as
    /// exact as it is meant to be.
    pub unconverged_steps: u64,
    /// How far apart the two references of the floor started (m).
    pub perturbation: f64,
    pub face_count: usize,
    /// Mean over the frames after the first (s).
    pub cpu_seconds: f64,
}

/// A run that was held against the reference.
#[derive(Clone, Debug)]
pub struct Subject {
    /// How fineness was decided, such as `view`.
    pub name: String,
    /// Means over the frames after the first: CPU time (s), faces.
    pub cpu_seconds: f64,
    pub face_count: f64,
    pub frames: Vec<FrameFigures>,
}

/// One frame of a subject.
#[derive(Clone, Copy, Debug)]
pub struct FrameFigures {
    /// As shown.
    pub frame: i64,
    pub judged: Judged,
    /// Mean FLIP of shaded pictures, where they were drawn.
    pub flip: Option<f64>,
}

impl FrameFigures {
    pub fn rms_px(&self) -> f64 {
        self.judged.error.displacement.rms
    }

    pub fn floor_rms_px(&self) -> Option<f64> {
        Some(self.judged.floor?.displacement.rms)
    }

    pub fn value(&self, metric: Metric) -> Option<f64> {
        if metric == Metric::Flip {
            return self.flip;
        }
        let values = visible_error_values(&self.judged.error);
        values.into_iter().find(|(m, _)| *m == metric)?.1
    }
}

impl Subject {
    pub fn judged_frames(&self) -> impl Iterator<Item = &FrameFigures> {
        self.frames.iter().filter(|f| !f.judged.is_chaos)
    }

    /// Mean of a metric over the frames that are judged; `None` if none has it.
    pub fn mean(&self, metric: Metric) -> Option<f64> {
        let values: Vec<f64> = self.judged_frames().filter_map(|f| f.value(metric)).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }
}

/// What files and tables hold of a frame.
const COLUMNS: [Metric; 10] = [
    Metric::RmsPx,
    Metric::P95Px,
    Metric::Over1px,
    Metric::SilhouetteShare,
    Metric::SilhouettePx,
    Metric::PoppingRmsPx,
    Metric::PoppingP95Px,
    Metric::UnseenRmsM,
    Metric::UnseenP95M,
    Metric::Flip,
];

impl Study {
    /// A row a subject and frame; empty where there is no value.
    pub fn csv(&self) -> String {
        let mut header = vec!["subject", "frame", "judged"];
        header.extend(COLUMNS.map(Metric::name));
        header.push("floor_rms_px");
        let mut lines = vec![header.join(",")];
        for subject in &self.subjects {
            for figures in &subject.frames {
                let number = |value: Option<f64>| value.map_or(String::new(), |v| v.to_string());
                let mut row = vec![
                    subject.name.clone(),
                    figures.frame.to_string(),
                    (!figures.judged.is_chaos).to_string(),
                ];
                row.extend(COLUMNS.map(|m| number(figures.value(m))));
                row.push(number(figures.floor_rms_px()));
                lines.push(row.join(","));
            }
        }
        lines.join("\n") + "\n"
    }

    pub fn json(&self) -> String {
        let Reference {
            edge_length_wanted,
            edge_length_mean,
            steps_per_frame,
            newton_iterations,
            unconverged_steps,
            perturbation,
            face_count,
            cpu_seconds,
        } = self.reference;
        let value = json!({
            "shot": self.shot,
            "reference": {
                "edge_length_wanted": edge_length_wanted,
                "edge_length_mean": edge_length_mean,
                "steps_per_frame": steps_per_frame,
                "newton_iterations": newton_iterations,
                "unconverged_steps": unconverged_steps,
                "perturbation": perturbation,
                "faces": face_count,
                "cpu_s_per_frame": cpu_seconds,
            },
            "subjects": self.subjects.iter().map(subject_json).collect::<Vec<_>>(),
        });
        serde_json::to_string_pretty(&value).expect("a study is plain data") + "\n"
    }

    /// A line a subject: cost, and means over the frames that are judged; the reference last.
    pub fn table(&self) -> String {
        let shown = [
            Metric::RmsPx,
            Metric::P95Px,
            Metric::Over1px,
            Metric::SilhouettePx,
            Metric::PoppingRmsPx,
            Metric::UnseenRmsM,
            Metric::Flip,
        ];
        let mut line = format!("{:10} {:>9} {:>9} {:>9}", "subject", "judged", "faces", "cpu_s");
        shown.iter().for_each(|m| line += &format!(" {:>14}", m.name()));
        let mut lines = vec![line];
        for subject in &self.subjects {
            let judged = format!("{}/{}", subject.judged_frames().count(), subject.frames.len());
            let mut line = format!(
                "{:10} {judged:>9} {:>9.0} {:>9}",
                subject.name,
                subject.face_count,
                short(subject.cpu_seconds)
            );
            for &metric in &shown {
                let mean = subject.mean(metric).map_or("-".to_owned(), short);
                line += &format!(" {mean:>14}");
            }
            lines.push(line);
        }
        let Reference { face_count, cpu_seconds, unconverged_steps, .. } = &self.reference;
        lines.push(format!(
            "{:10} {:>9} {face_count:>9} {:>9} {unconverged_steps:>14} unconverged steps",
            "reference",
            "",
            short(*cpu_seconds)
        ));
        lines.join("\n")
    }
}

fn subject_json(subject: &Subject) -> Value {
    let mut means = Map::new();
    for metric in COLUMNS {
        means.insert(metric.name().to_owned(), json!(subject.mean(metric)));
    }
    let frame = |figures: &FrameFigures| {
        let mut entry = Map::new();
        entry.insert("frame".into(), json!(figures.frame));
        entry.insert("judged".into(), json!(!figures.judged.is_chaos));
        for metric in COLUMNS {
            entry.insert(metric.name().into(), json!(figures.value(metric)));
        }
        entry.insert("floor_rms_px".into(), json!(figures.floor_rms_px()));
        Value::Object(entry)
    };
    json!({
        "name": subject.name,
        "cpu_s_per_frame": subject.cpu_seconds,
        "faces_mean": subject.face_count,
        "judged_frames": subject.judged_frames().count(),
        "means": means,
        "frames": subject.frames.iter().map(frame).collect::<Vec<_>>(),
    })
}
