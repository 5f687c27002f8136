//! A kick to the front: the knee is drawn up, the shin snaps forward and back, the foot is set down.

use std::f64::consts::PI;

use glam::DQuat;

use super::parts::Side;
use super::steps::smooth;

/// One leg's kick, from the frame at which the foot leaves the ground to that of its landing.
pub struct Kick {
    pub side: Side,
    pub frames: [f64; 2],
}

/// How a kicking leg is bent.
pub struct Bent {
    /// 0 where the leg stands, 1 where it only kicks.
    pub weight: f64,
    /// Pelvis from thigh, and thigh from shin.
    pub hip: DQuat,
    pub knee: DQuat,
    /// Shin from foot.
    pub ankle: DQuat,
}

/// How far the thigh is raised forward, and turned out (rad): just above hip height.
const RAISE: f64 = 1.45;
const TURNED_OUT: f64 = 0.15;
/// The knee drawn up, and when the leg is stretched out (rad).
const KNEE_FOLDED: f64 = 1.5;
const KNEE_STRETCHED: f64 = 0.12;
/// The toes point along the shin (rad).
const TOES_POINT: f64 = 0.7;
/// Shares of the kick: the thigh is up and goes down again; the shin snaps forward and back.
const UP: f64 = 0.34;
const DOWN: f64 = 0.64;
const FORWARD: [f64; 2] = [0.30, 0.46];
const BACK: [f64; 2] = [0.54, 0.72];

impl Kick {
    /// None while the leg does not kick.
    pub fn bent(&self, frame: f64) -> Option<Bent> {
        let share = self.share(frame)?;
        let between = |range: [f64; 2]| smooth((share - range[0]) / (range[1] - range[0]));
        let stretched = between(FORWARD) - between(BACK);
        let bend = KNEE_FOLDED + stretched * (KNEE_STRETCHED - KNEE_FOLDED);
        Some(Bent {
            weight: smooth(share / UP) * smooth((1.0 - share) / (1.0 - DOWN)),
            hip: DQuat::from_rotation_z(-TURNED_OUT * self.side.sign())
                * DQuat::from_rotation_x(RAISE),
            knee: DQuat::from_rotation_x(-bend),
            ankle: DQuat::from_rotation_x(-TOES_POINT),
        })
    }

    /// How much the body leans back (0 to 1): it begins and ends gently.
    pub fn lean(&self, frame: f64) -> f64 {
        self.share(frame).map_or(0.0, |share| (PI * share).sin().powi(2))
    }

    fn share(&self, frame: f64) -> Option<f64> {
        let [start, end] = self.frames;
        let share = (frame - start) / (end - start);
        (0.0..=1.0).contains(&share).then_some(share)
    }
}
