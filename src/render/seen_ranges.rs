//! The ranges of what colours stand for, as far as frames have been looked at.

use super::colour_by::{ColourBy, LogRange};
use crate::sim::Frame;

/// See the module.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenRanges {
    /// From the shortest to the longest mean edge length of a face (m); `None` before any face.
    edge: Option<LogRange>,
    /// Of the fastest face (m/s).
    speed: f64,
}

/// Of usual cloth (m): for colours before there is any.
const USUAL_EDGES: LogRange = LogRange { start: 0.01, end: 0.1 };
/// A range spans this factor at least, so that there is one.
const SPAN_MIN: f64 = 1.001;

impl SeenRanges {
    pub fn see(&mut self, frame: &Frame) {
        let edge = ColourBy::EdgeSize(USUAL_EDGES);
        let speed = ColourBy::Speed { limit: 1.0 };
        for mesh in &frame.garments {
            for face in mesh.face_ids() {
                let length = edge.value(mesh, face);
                let range = self.edge.get_or_insert(LogRange { start: length, end: length });
                range.start = range.start.min(length);
                range.end = range.end.max(length);
                self.speed = self.speed.max(speed.value(mesh, face));
            }
        }
    }

    /// By edge length, over all that was seen.
    pub fn edge_size(&self) -> ColourBy {
        let range = self.edge.map_or(USUAL_EDGES, |LogRange { start, end }| LogRange {
            start,
            end: end.max(start * SPAN_MIN),
        });
        ColourBy::EdgeSize(range)
    }

    /// By speed, up to the fastest that was seen.
    pub fn speed(&self) -> ColourBy {
        ColourBy::speed(self.speed)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::render::fixture::{flat, frame, square};

    #[test]
    fn ranges_grow_with_what_is_seen() {
        let mut seen = SeenRanges::default();
        assert_eq!(seen.edge_size(), ColourBy::EdgeSize(USUAL_EDGES));
        let mut ends = Vec::new();
        for edge in [0.1, 0.02] {
            let corners = [[0.0; 3], [edge, 0.0, 0.0], [0.0, edge, 0.0]];
            seen.see(&frame([flat(&[corners])]));
            let ColourBy::EdgeSize(LogRange { start, end }) = seen.edge_size() else {
                panic!("{:?}", seen.edge_size())
            };
            assert!(start < end);
            ends.push((start, end));
        }
        assert!(ends[1].0 < ends[0].0, "shorter edges were seen");
        assert!((ends[1].1 - ends[0].1).abs() <= 1e-3 * ends[0].1, "longer ones were not");
    }

    #[test]
    fn speeds_reach_up_to_the_fastest_face_that_was_seen_in_any_frame() {
        let mut seen = SeenRanges::default();
        assert_eq!(seen.speed(), ColourBy::speed(0.0));
        for (speed, fastest) in [(2.0, 2.0), (0.5, 2.0), (30.0, 30.0)] {
            let mut mesh = square(0.0, 0.1);
            for node in mesh.node_ids() {
                mesh.velocity[node] = DVec3::new(0.0, -speed, 0.0);
            }
            seen.see(&frame([square(0.0, 0.1), mesh]));
            assert_eq!(seen.speed(), ColourBy::speed(fastest));
        }
        let ColourBy::Speed { limit } = seen.speed() else { panic!("{:?}", seen.speed()) };
        assert!(limit >= 30.0, "{limit}");
        assert_eq!(seen.edge_size(), {
            let mut still = SeenRanges::default();
            still.see(&frame([square(0.0, 0.1)]));
            still.edge_size()
        });
    }
}
