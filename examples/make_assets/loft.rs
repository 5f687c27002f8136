//! Closed, smooth surfaces: ellipses along an axis, through a profile, rounded at both ends.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use shotsilk::scene::Surface;

/// An ellipse across the axis.
#[derive(Clone, Copy)]
pub struct Ring {
    /// Where on the axis.
    pub along: f64,
    /// Half the width, to the right.
    pub right: f64,
    /// Half the other width: forward for an upright axis, upward for a forward one.
    pub across: f64,
    /// How far the centre is off the axis in the latter direction.
    pub offset: f64,
}

/// Which way a part extends.
#[derive(Clone, Copy)]
pub enum Axis {
    Up,
    Forward,
}

/// A part's shape.
pub struct Loft {
    pub name: &'static str,
    pub axis: Axis,
    /// In order along the axis, at least two; the first and last close the surface.
    pub rings: &'static [Ring],
    /// Over what length the first and last end are rounded off.
    pub caps: [f64; 2],
    /// Points around, and rings along the axis.
    pub segments: [usize; 2],
}

impl Loft {
    /// Closed and counter-clockwise seen from outside.
    pub fn surface(&self) -> Surface {
        let [around, along] = self.segments;
        let ring = |k: usize| self.ring(0.5 * (1.0 - (PI * k as f64 / along as f64).cos()));
        let mut positions = vec![self.point(ring(0), None)];
        for k in 1..along {
            let angle = |i: usize| TAU * (i as f64 + 0.5 * (k % 2) as f64) / around as f64;
            positions.extend((0..around).map(|i| self.point(ring(k), Some(angle(i)))));
        }
        positions.push(self.point(ring(along), None));
        Surface { positions, triangles: triangles(around, along) }
    }

    /// The ellipse at a share of the length: of the smooth profile, narrowed as an ellipsoid
    /// towards the ends.
    fn ring(&self, share: f64) -> Ring {
        let (first, last) = (self.rings[0].along, self.rings[self.rings.len() - 1].along);
        let along = first + share * (last - first);
        let round = |from_end: f64, cap: f64| {
            let t = (1.0 - from_end / cap).clamp(0.0, 1.0);
            (1.0 - t * t).sqrt()
        };
        let cap = round(along - first, self.caps[0]) * round(last - along, self.caps[1]);
        let at = |value: fn(&Ring) -> f64| profile(self.rings, along, value);
        Ring {
            along,
            right: cap * at(|r| r.right),
            across: cap * at(|r| r.across),
            offset: at(|r| r.offset),
        }
    }

    /// A point of an ellipse; `None` is its centre.
    fn point(&self, ring: Ring, angle: Option<f64>) -> DVec3 {
        let (sin, cos) = angle.map_or((0.0, 0.0), f64::sin_cos);
        let (right, across) = (ring.right * cos, ring.offset + ring.across * sin);
        match self.axis {
            Axis::Up => DVec3::new(right, across, ring.along),
            // Turned by a quarter about x, which keeps the orientation.
            Axis::Forward => DVec3::new(-right, ring.along, across),
        }
    }
}

/// A fan, bands of alternating triangles (odd rings are shifted by half a segment), a fan.
fn triangles(around: usize, along: usize) -> Vec<[u32; 3]> {
    let at = |k: usize, i: usize| (1 + (k - 1) * around + i % around) as u32;
    let (bottom, top) = (0, (1 + (along - 1) * around) as u32);
    let mut triangles: Vec<[u32; 3]> =
        (0..around).map(|i| [bottom, at(1, i + 1), at(1, i)]).collect();
    for k in 1..along - 1 {
        for i in 0..around {
            let (a, b, c, d) = (at(k, i), at(k, i + 1), at(k + 1, i), at(k + 1, i + 1));
            triangles.extend(match k % 2 {
                1 => [[a, d, c], [a, b, d]],
                _ => [[a, b, c], [b, d, c]],
            });
        }
    }
    triangles.extend((0..around).map(|i| [at(along - 1, i), at(along - 1, i + 1), top]));
    triangles
}

/// A value of the rings between them: cubic, with the slopes of neighbours two apart.
fn profile(rings: &[Ring], along: f64, value: fn(&Ring) -> f64) -> f64 {
    let last = rings.len() - 1;
    let k = rings.partition_point(|r| r.along <= along).clamp(1, last) - 1;
    let slope = |k: usize| {
        let (a, b) = (&rings[k.saturating_sub(1)], &rings[(k + 1).min(last)]);
        (value(b) - value(a)) / (b.along - a.along)
    };
    let (a, b) = (&rings[k], &rings[k + 1]);
    let span = b.along - a.along;
    let s = (along - a.along) / span;
    let (s2, s3) = (s * s, s * s * s);
    value(a) * (2.0 * s3 - 3.0 * s2 + 1.0)
        + value(b) * (3.0 * s2 - 2.0 * s3)
        + span * (slope(k) * (s3 - 2.0 * s2 + s) + slope(k + 1) * (s3 - s2))
}
