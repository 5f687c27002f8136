//! The pelvis follows the feet, and where the figure faces follows too.

use std::ops::{Add, Mul};

use glam::{DQuat, DVec3};
use shotsilk::scene::Pose;

use super::gait::Choreography;
use super::parts::{self, SHIN_LENGTH, Side, THIGH_LENGTH};
use super::steps::facing;

/// How slowly the pelvis follows the feet (frames, standard deviation).
const FOLLOW: f64 = 4.5;
/// How slowly weight shifts and height changes (frames).
const SHIFT: f64 = 3.0;
const BOB: f64 = 2.0;
/// Share of the legs' length that is used at most.
const REACH: f64 = 0.985;
/// Of the pelvis towards the foot that bears (m), and its list to the other side (rad).
const SWAY: f64 = 0.022;
const LIST: f64 = 0.06;
/// Twist of the pelvis against the chest for feet a metre apart (rad).
const PELVIS_TWIST: f64 = 0.25;
/// How far the pelvis leans back in a kick (rad), and goes over the other foot (m).
const PELVIS_LEAN: f64 = 0.16;
const KICK_SWAY: f64 = 0.035;

/// How pelvis and heading follow from the steps.
pub struct Body(pub &'static Choreography);

impl Body {
    pub fn pelvis(&self, frame: f64) -> Pose {
        let ground = self.ground_at(frame);
        let weight = self.bearing(frame);
        let rotation = facing(self.heading(frame) + PELVIS_TWIST * self.stride(frame))
            * DQuat::from_rotation_y(LIST * weight)
            * DQuat::from_rotation_x(PELVIS_LEAN * self.lean(frame));
        let sway = facing(self.heading(frame))
            * DVec3::X
            * (weight * (SWAY + KICK_SWAY * self.lean(frame)));
        let height = smoothed(frame, BOB, |f| self.height_in_reach(f, self.ground_at(f)));
        Pose { scale: 1.0, rotation, translation: ground + sway + DVec3::Z * height }
    }

    fn ground_at(&self, frame: f64) -> DVec3 {
        smoothed(frame, FOLLOW, |f| between_feet(|side| self.0.steps.footing(side, f).position))
    }

    /// The greatest height of the pelvis at which both legs reach their ankles.
    fn height_in_reach(&self, frame: f64, ground: DVec3) -> f64 {
        let turned = facing(self.heading(frame));
        let reach = REACH * (THIGH_LENGTH + SHIN_LENGTH);
        let of_leg = |side: Side| {
            let hip = parts::hip(side);
            let ankle = self.0.steps.foot(side, frame).translation;
            let across = (ground + turned * hip - ankle).truncate().length();
            ankle.z + (reach * reach - across * across).max(0.0).sqrt() - hip.z
        };
        Side::BOTH.map(of_leg).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Which way the figure faces (rad).
    pub fn heading(&self, frame: f64) -> f64 {
        smoothed(frame, FOLLOW, |f| between_feet(|side| self.0.steps.footing(side, f).heading))
    }

    /// How fast it turns (rad/frame).
    pub fn turn(&self, frame: f64) -> f64 {
        smoothed(frame, FOLLOW, |f| self.heading(f + 1.0) - self.heading(f - 1.0)) / 2.0
    }

    /// How far the left foot is ahead of the right one (m).
    pub fn stride(&self, frame: f64) -> f64 {
        smoothed(frame, BOB, |f| {
            let apart = self.0.steps.footing(Side::Left, f).position
                - self.0.steps.footing(Side::Right, f).position;
            apart.dot(facing(self.heading(f)) * DVec3::Y)
        })
    }

    /// 1 if the right foot bears all weight, -1 if the left one does.
    fn bearing(&self, frame: f64) -> f64 {
        smoothed(frame, SHIFT, |f| {
            self.0.steps.airborne(Side::Left, f) - self.0.steps.airborne(Side::Right, f)
        })
    }

    /// How much the figure leans back because it kicks (0 to 1).
    pub fn lean(&self, frame: f64) -> f64 {
        self.0.kicks.iter().map(|kick| kick.lean(frame)).sum()
    }
}

fn between_feet<T: Add<Output = T> + Mul<f64, Output = T>>(value: impl Fn(Side) -> T) -> T {
    (value(Side::Left) + value(Side::Right)) * 0.5
}

/// The mean of a value around a frame, weighted by a bell curve of a width (frames).
fn smoothed<T: Add<Output = T> + Mul<f64, Output = T>>(
    frame: f64,
    width: f64,
    value: impl Fn(f64) -> T,
) -> T {
    // Half frames, out to three widths.
    let reach = (6.0 * width).ceil() as i32;
    let sample = |k: i32| {
        let offset = 0.5 * f64::from(k);
        let weight = (-0.5 * (offset / width).powi(2)).exp();
        (value(frame + offset) * weight, weight)
    };
    let (sum, weights) = (-reach..=reach)
        .map(sample)
        .reduce(|a, b| (a.0 + b.0, a.1 + b.1))
        .expect("the range is not empty");
    sum * (1.0 / weights)
}
