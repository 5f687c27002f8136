//! A round cloth draped over a smaller round support: how much of the free ring's shadow is left.
//!
//! Cusick's drape coefficient: DC = (A_shadow - A_support) / (A_flat - A_support), for a disc of
//! 30 cm on a support of 18 cm. Done with the presets; folds may pass through each other.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::specimen::Specimen;
use super::{Claim, Experiment, ExperimentError, GRAVITY};
use crate::math::Random;
use crate::mesh::{Mesh, RawMesh};
use crate::scene::{Fabric, Preset};

/// (m).
const RADIUS: f64 = 0.15;
const SUPPORT: f64 = 0.09;

/// Rings of nodes outside the support's edge; one more is inside. With 10, as taut a mesh as silk's
/// locks: it drapes by 51 % instead of 32 %; with 30 by 28 %.
const RINGS: u32 = 20;
/// (m).
const SPACING: f64 = (RADIUS - SUPPORT) / (RINGS as f64 - 0.5);

/// Height of the bumps that tell folds where to begin (m).
const BUMPS: f64 = 1e-4;

/// Step (s), and what share of its velocity the cloth takes to the next.
const DT: f64 = 1.0 / 30.0;
const VELOCITY_KEPT: f64 = 0.85;

/// At rest is what has changed by less than this in so many steps.
const CHANGE_MAX: f64 = 0.002;
const STEPS_AT_REST: usize = 20;
const STEPS_MAX: usize = 400;
/// Folds have grown from their bumps by then.
const STEPS_MIN: usize = 200;

/// Side of a square that shadows are counted in (m).
const PIXEL: f64 = 1e-3;

/// Presets, and what is measured of such cloths (%); of leather by [`MCYZ21`](crate::papers::MCYZ21).
const RANGES: [(&str, [f64; 2]); 4] = [
    ("cotton", [60.0, 76.0]),
    ("silk", [20.0, 40.0]),
    ("denim", [70.0, 90.0]),
    ("leather", [47.0, 70.0]),
];

pub fn experiments() -> Vec<Experiment> {
    let of = |(preset, [low, high]): (&'static str, [f64; 2])| {
        let name = format!("drape/{preset}-percent");
        let claim = Claim::absolute(name, 0.5 * (low + high), 0.5 * (high - low));
        let measure = move || {
            let preset = Preset::named(preset).ok_or(ExperimentError::Nothing("no such preset"))?;
            Ok(vec![100.0 * coefficient(&Fabric::Elastic(preset.fabric()))?])
        };
        Experiment::new(vec![claim], measure)
    };
    RANGES.map(of).into()
}

/// Cusick's drape coefficient of a fabric, 0..1.
///
/// # Errors
/// If the cloth does not come to rest.
fn coefficient(fabric: &Fabric) -> Result<f64, ExperimentError> {
    let mut cloth = laid_out(fabric);
    let mut last: Vec<f64> = Vec::new();
    for step in 0..STEPS_MAX {
        cloth.step(DT)?;
        cloth.state.velocity.iter_mut().for_each(|v| *v *= VELOCITY_KEPT);
        last.push(drape(&cloth));
        let recent = &last[last.len().saturating_sub(STEPS_AT_REST)..];
        let least = recent.iter().copied().fold(f64::INFINITY, f64::min);
        let most = recent.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if step >= STEPS_MIN && most - least < CHANGE_MAX {
            return Ok(last[step]);
        }
    }
    Err(ExperimentError::Nothing("the cloth does not come to rest"))
}

/// Flat but for its bumps, and held as the plates of the tester hold it.
fn laid_out(fabric: &Fabric) -> Specimen {
    let mut cloth = Specimen::new(ring(), fabric);
    let is_held = |u: DVec2| u.length() < SUPPORT + SPACING;
    cloth.clamp(is_held);
    let mut random = Random::new(11);
    for vertex in cloth.vertices(|u| !is_held(u)) {
        let node = cloth.node_of(vertex);
        cloth.state.position[node].z += BUMPS * random.number();
    }
    cloth.gravity = DVec3::NEG_Z * GRAVITY;
    cloth
}

/// The free part of the cloth, and the support's edge half way between two rings that are held.
fn ring() -> Mesh {
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for number in 0..=RINGS {
        let outer = Ring::new(number, points.len() as u32);
        points.extend((0..outer.count).map(|k| DVec2::from_angle(outer.angle(k)) * outer.radius()));
        if number > 0 {
            let inner = Ring::new(number - 1, outer.first - Ring::count(number - 1));
            faces.extend(inner.triangles_to(&outer));
        }
    }
    let raw = RawMesh {
        positions: points.iter().map(|u| u.extend(0.0)).collect(),
        vertices: (0..).zip(points).collect(),
        faces,
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).expect("a ring is a mesh")
}

/// Nodes evenly on a circle.
struct Ring {
    number: u32,
    /// Its first node, and how many there are.
    first: u32,
    count: u32,
}

impl Ring {
    fn new(number: u32, first: u32) -> Self {
        Self { number, first, count: Self::count(number) }
    }

    fn count(number: u32) -> u32 {
        (TAU * Self::radius_of(number) / SPACING).round() as u32
    }

    /// (m).
    fn radius_of(number: u32) -> f64 {
        SUPPORT + SPACING * (f64::from(number) - 0.5)
    }

    fn radius(&self) -> f64 {
        Self::radius_of(self.number)
    }

    /// Neighbouring rings stand in each other's gaps, as far as their counts allow (rad).
    fn angle(&self, k: u32) -> f64 {
        TAU * (f64::from(k) + 0.5 * f64::from(self.number % 2)) / f64::from(self.count)
    }

    fn node(&self, k: u32) -> u32 {
        self.first + k % self.count
    }

    /// Once around, always on to the next node that comes first.
    fn triangles_to(&self, outer: &Ring) -> Vec<[u32; 3]> {
        let (mut i, mut j) = (0, 0);
        let mut triangles = Vec::new();
        while i < self.count || j < outer.count {
            let corners = [self.node(i), outer.node(j)];
            let is_inner_next =
                i < self.count && (j == outer.count || self.angle(i + 1) < outer.angle(j + 1));
            if is_inner_next {
                i += 1
            } else {
                j += 1
            };
            let next = if is_inner_next { self.node(i) } else { outer.node(j) };
            triangles.push([corners[0], corners[1], next]);
        }
        triangles
    }
}

fn drape(cloth: &Specimen) -> f64 {
    let area = |radius: f64| PI * radius * radius;
    let at = |v| cloth.state.position[cloth.node_of(v)].truncate();
    let faces = cloth.mesh.face_ids().map(|f| cloth.mesh.face_vertices(f).map(at));
    (shadow(faces) - area(SUPPORT)) / (area(RADIUS) - area(SUPPORT))
}

/// Area of the union of the support and of triangles on it (m^2), in squares whose middles are in
/// one.
fn shadow(triangles: impl Iterator<Item = [DVec2; 3]>) -> f64 {
    let half = (1.2 * RADIUS / PIXEL).ceil() as i32;
    let side = 2 * half;
    let middle = |k: i32| (f64::from(k - half) + 0.5) * PIXEL;
    let mut is_dark: Vec<bool> = (0..side * side)
        .map(|k| DVec2::new(middle(k % side), middle(k / side)).length() <= SUPPORT)
        .collect();
    let first = |x: f64| ((x / PIXEL - 0.5).ceil() as i32 + half).clamp(0, side);
    for corners in triangles {
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        for j in first(low.y)..first(high.y) {
            for i in first(low.x)..first(high.x) {
                if is_inside(corners, DVec2::new(middle(i), middle(j))) {
                    is_dark[(j * side + i) as usize] = true;
                }
            }
        }
    }
    is_dark.iter().filter(|dark| **dark).count() as f64 * PIXEL * PIXEL
}

/// Whichever way the triangle turns.
fn is_inside([a, b, c]: [DVec2; 3], x: DVec2) -> bool {
    let sides = [(b - a).perp_dot(x - a), (c - b).perp_dot(x - b), (a - c).perp_dot(x - c)];
    sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_is_covered_once_and_its_shadow_is_its_area() {
        let mesh = ring();
        mesh.check().unwrap();
        let inner = SUPPORT - 0.5 * SPACING;
        let area = PI * (RADIUS * RADIUS - inner * inner);
        assert!((mesh.total_material_area() / area - 1.0).abs() < 1e-3);
        let flat = mesh.face_ids().map(|f| mesh.face_material(f));
        assert!((shadow(flat) / (PI * RADIUS * RADIUS) - 1.0).abs() < 1e-3);
    }
}
