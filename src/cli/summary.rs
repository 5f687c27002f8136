//! What a simulation came to, in one line for people.

use std::fmt;

use crate::sim::Frame;

/// Sums over the frames after frame 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    frames: usize,
    faces_min: usize,
    faces_max: usize,
    faces_sum: usize,
    /// Nodes times the steps asked for.
    node_steps: f64,
    cpu_seconds: f64,
    sizing_and_view_seconds: f64,
    wall_seconds: f64,
}

impl Summary {
    /// Counts a frame in, which was asked for in so many steps.
    pub fn add(&mut self, frame: &Frame, steps_per_frame: u32) {
        if frame.number == 0 {
            return;
        }
        let faces = frame.face_count();
        self.faces_min = if self.frames == 0 { faces } else { self.faces_min.min(faces) };
        self.faces_max = self.faces_max.max(faces);
        self.faces_sum += faces;
        self.frames += 1;
        self.node_steps += frame.node_count() as f64 * f64::from(steps_per_frame);
        self.cpu_seconds += frame.report.cpu_seconds;
        let stages = &frame.report.stages;
        self.sizing_and_view_seconds += stages.sizing + stages.view;
        self.wall_seconds += stages.total();
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.frames == 0 {
            return write!(f, "frame 0 only");
        }
        let frames = self.frames as f64;
        write!(
            f,
            "{} frames; faces {} / {:.0} / {} (least / mean / most); {:.3} CPU s a frame, {:.1} us \
             a node and step; sizing and view {:.1} % of the time",
            self.frames,
            self.faces_min,
            self.faces_sum as f64 / frames,
            self.faces_max,
            self.cpu_seconds / frames,
            1e6 * self.cpu_seconds / self.node_steps.max(1.0),
            100.0 * self.sizing_and_view_seconds / self.wall_seconds.max(f64::MIN_POSITIVE),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{FrameReport, StageSeconds};

    #[test]
    fn frame_zero_is_not_counted_and_the_others_are_averaged() {
        let mut summary = Summary::default();
        for (number, cpu_seconds) in [(0, 9.0), (1, 1.0), (2, 2.0)] {
            let stages = StageSeconds { dynamics: 0.9, view: 0.1, ..StageSeconds::default() };
            let report = FrameReport { stages, cpu_seconds, ..FrameReport::default() };
            summary.add(&Frame { number, report, ..Frame::default() }, 8);
        }
        let text = summary.to_string();
        assert!(text.starts_with("2 frames") && text.contains("1.500 CPU s"), "{text}");
        assert!(text.ends_with("10.0 % of the time"), "{text}");
    }
}
