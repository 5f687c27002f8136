//! What is worn above the waist, cut like a kimono: over the shoulders lies half a cylinder whose
//! axis leads from side to side, and sleeves go on as it begins. Before and behind hangs a plane, to
//! the sides bends a cone, and plane and cone widen to the hem. All of it can be unfolded, so that
//! nothing is stretched at first.
//!
//! ```text
//!      sleeve ---- yoke ---- sleeve      everything above `yoke` is half a cylinder
//!        mitre  |  front  |  mitre       a mitre leads from the front under the arm to the back
//!              /   plane   \
//!             / side   side \            cones about one apex
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use shotsilk::mesh::RawMesh;
use shotsilk::scene::Pose;

use super::sew::{Panel, sewn};

/// A cut, all in the chest's space (m).
pub struct Top {
    /// Height of the yoke's axis, and of the hem.
    pub yoke: f64,
    pub hem: f64,
    /// The yoke's radius: half the depth.
    pub radius: f64,
    /// Half the width of the planes before and behind, and how far the sides bulge beyond.
    pub plane: f64,
    pub bulge: f64,
    /// How much wider it is for a metre below the yoke's axis.
    pub flare: f64,
    /// Of the armhole below the yoke's axis.
    pub armhole: f64,
    /// How far from the middle the sleeves reach.
    pub sleeve: f64,
    pub neck: Neck,
}

/// How the front, and at the neck the back, is cut out.
pub struct Neck {
    /// Half the width, on top of the shoulders.
    pub half_width: f64,
    /// How far it reaches down, measured on the cloth.
    pub front: f64,
    pub back: f64,
    /// Half the width of the gap from there to the hem; 0 closes the front.
    pub gap: f64,
}

/// Fields of the input mesh: down the planes and sides, over the shoulders, around a side, from
/// the neck outward, and along a sleeve.
const DOWN: usize = 5;
const OVER: usize = 8;
const AROUND: usize = 6;
const OUTWARD: usize = 3;
const SLEEVE: usize = 3;

impl Top {
    /// Around a chest.
    pub fn mesh(&self, chest: Pose) -> RawMesh {
        let right = [self.body(), self.side(), self.sleeve()];
        let left = right.each_ref().map(Panel::mirrored);
        let mut mesh = sewn(&[right, left].into_iter().flatten().collect::<Vec<_>>());
        for position in &mut mesh.positions {
            *position = chest.transform_point(*position);
        }
        mesh
    }

    /// The right half, from the front's hem over the shoulder to the back's, from the middle
    /// outward.
    fn body(&self) -> Panel {
        let plane = |k: usize, sign: f64| {
            let z = self.yoke + (self.hem - self.yoke) * k as f64 / DOWN as f64;
            let along = sign * (FRAC_PI_2 * self.radius + self.yoke - z);
            (along, self.wider(z), DVec3::new(0.0, sign * self.wider(z) * self.radius, z))
        };
        let yoke = |k: usize| {
            let turn = PI * k as f64 / OVER as f64;
            let along = (FRAC_PI_2 - turn) * self.radius;
            (along, 1.0, self.on_yoke(turn, 0.0))
        };
        let front = (1..=DOWN).rev().map(|k| plane(k, 1.0));
        let back = (1..=DOWN).map(|k| plane(k, -1.0));
        let middle = front.chain((0..=OVER).map(yoke)).chain(back);
        let row = |(along, wider, point): (f64, f64, DVec3)| {
            let inner = self.neck.cut(along);
            let column = |c: usize| inner + (self.plane - inner) * c as f64 / OUTWARD as f64;
            (0..=OUTWARD).map(|c| point + DVec3::X * (wider * column(c))).collect()
        };
        Panel { rows: middle.map(row).collect() }
    }

    /// The right side, from the front to the back, from the armhole down to the hem.
    fn side(&self) -> Panel {
        let row = |around: usize| {
            let top = self.yoke - self.armhole * turn(around).sin();
            let down = |k: usize| top + (self.hem - top) * k as f64 / DOWN as f64;
            (0..=DOWN).map(|k| self.on_side(turn(around), down(k))).collect()
        };
        Panel { rows: (0..=AROUND).map(row).collect() }
    }

    /// The right sleeve, from under the arm by the front over it and back, from the body outward.
    fn sleeve(&self) -> Panel {
        let mitre = |around: usize| {
            let turn = turn(around);
            self.on_side(turn, self.yoke - self.armhole * turn.sin())
        };
        let under_front = (0..=AROUND / 2).rev().map(mitre);
        let over = (1..OVER).map(|k| self.on_yoke(PI * k as f64 / OVER as f64, self.plane));
        let under_back = (AROUND / 2..=AROUND).rev().map(mitre);
        let row = |inner: DVec3| {
            let x = |c: usize| inner.x + (self.sleeve - inner.x) * c as f64 / SLEEVE as f64;
            (0..=SLEEVE).map(|c| DVec3::new(x(c), inner.y, inner.z)).collect()
        };
        Panel { rows: under_front.chain(over).chain(under_back).map(row).collect() }
    }

    /// Width at a height, for the width at the yoke's axis.
    fn wider(&self, z: f64) -> f64 {
        1.0 + self.flare * (self.yoke - z)
    }

    /// A turn begins at the front and leads over the shoulder.
    fn on_yoke(&self, turn: f64, x: f64) -> DVec3 {
        DVec3::new(x, self.radius * turn.cos(), self.yoke + self.radius * turn.sin())
    }

    /// A turn begins at the front and leads around the right side.
    fn on_side(&self, turn: f64, z: f64) -> DVec3 {
        let across = self.plane + self.bulge * turn.sin();
        self.wider(z) * DVec3::new(across, self.radius * turn.cos(), 0.0) + DVec3::Z * z
    }
}

impl Neck {
    /// Half the width of what is cut out so far along the cloth: 0 on top of the shoulders, more
    /// to the front.
    fn cut(&self, along: f64) -> f64 {
        let (depth, gap) = if along > 0.0 { (self.front, self.gap) } else { (self.back, 0.0) };
        let share = (along / depth).abs().min(1.0);
        gap + (self.half_width - gap) * (1.0 - share * share).sqrt()
    }
}

fn turn(around: usize) -> f64 {
    PI * around as f64 / AROUND as f64
}
