//! The poses of all parts at a frame: the pelvis follows the feet, legs reach from one to the
//! other, chest, arms and head go along.

use std::ops::{Add, Mul};

use glam::{DMat3, DQuat, DVec3};
use shotsilk::scene::Pose;

use super::parts::{self, Part, SHIN_LENGTH, Side, THIGH_LENGTH, UPPER_ARM_LENGTH};
use super::steps::{airborne, facing, foot, footing};

/// The figure at a frame.
pub struct Figure {
    frame: f64,
    pelvis: Pose,
    chest: Pose,
}

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
/// Twist of pelvis and chest against each other for feet a metre apart (rad).
const PELVIS_TWIST: f64 = 0.25;
const CHEST_TWIST: f64 = -0.35;
/// Frames by which chest and head look ahead of the pelvis.
const CHEST_AHEAD: f64 = 1.5;
const HEAD_AHEAD: f64 = 5.0;
/// Arms: out from the body at rest and more in a turn, for each rad/frame of it (rad); swing for
/// feet a metre apart; bend of the elbow at rest, and more as the arm swings forward.
const ARM_OUT: f64 = 0.50;
const ARM_OUT_BY_TURN: f64 = 2.8;
const ARM_SWING: f64 = 0.85;
const ELBOW: f64 = 0.38;
const ELBOW_BY_SWING: f64 = 0.6;

impl Figure {
    pub fn at(frame: f64) -> Self {
        let pelvis = pelvis(frame);
        let lean = DQuat::from_rotation_x(-0.03);
        let upright = facing(heading(frame + CHEST_AHEAD) + CHEST_TWIST * stride(frame));
        let chest = Pose {
            scale: 1.0,
            rotation: upright * lean,
            translation: pelvis.transform_point(parts::WAIST),
        };
        Self { frame, pelvis, chest }
    }

    /// World from a part's own space.
    pub fn pose(&self, part: Part) -> Pose {
        match part {
            Part::Pelvis => self.pelvis,
            Part::Chest => self.chest,
            Part::Head => Pose {
                scale: 1.0,
                rotation: facing(heading(self.frame + HEAD_AHEAD)),
                translation: self.chest.transform_point(parts::NECK),
            },
            Part::Thigh(side) => self.leg(side)[0],
            Part::Shin(side) => self.leg(side)[1],
            Part::Foot(side) => foot(side, self.frame),
            Part::UpperArm(side) => self.arm(side)[0],
            Part::Forearm(side) => self.arm(side)[1],
        }
    }

    /// Thigh and shin, which reach from the hip to the ankle with the knee forward.
    fn leg(&self, side: Side) -> [Pose; 2] {
        let hip = self.pelvis.transform_point(parts::hip(side));
        let foot = foot(side, self.frame);
        let to_ankle = foot.translation - hip;
        let length = to_ankle.length().min(0.9999 * (THIGH_LENGTH + SHIN_LENGTH));
        let down = to_ankle.normalize();
        let toes = facing(footing(side, self.frame).heading) * DVec3::Y;
        let forward = (toes + self.pelvis.rotation * DVec3::Y).reject_from(down).normalize();
        // The knee's place along and off the line from hip to ankle: two circles meet.
        let (a, b) = (THIGH_LENGTH, SHIN_LENGTH);
        let along = (length * length + a * a - b * b) / (2.0 * length);
        let off = (a * a - along * along).max(0.0).sqrt();
        let knee = hip + down * along + forward * off;
        [bone(hip, knee - hip, forward), bone(knee, foot.translation - knee, forward)]
    }

    /// Upper arm and forearm, which swing against the legs.
    fn arm(&self, side: Side) -> [Pose; 2] {
        let swing = ARM_SWING * stride(self.frame) * side.sign();
        let turn =
            smoothed(self.frame, FOLLOW, |f| heading(f + 1.0) - heading(f - 1.0)).abs() / 2.0;
        let out = ARM_OUT + ARM_OUT_BY_TURN * turn;
        let upper = Pose {
            scale: 1.0,
            rotation: self.chest.rotation
                * DQuat::from_rotation_x(swing)
                * DQuat::from_rotation_y(-out * side.sign()),
            translation: self.chest.transform_point(parts::shoulder(side)),
        };
        let bend = ELBOW + ELBOW_BY_SWING * swing.max(-0.5 * ELBOW);
        let forearm = Pose {
            scale: 1.0,
            rotation: upper.rotation
                * DQuat::from_rotation_y(0.35 * out * side.sign())
                * DQuat::from_rotation_x(bend),
            translation: upper.transform_point(DVec3::NEG_Z * UPPER_ARM_LENGTH),
        };
        [upper, forearm]
    }
}

/// A limb from a joint along a direction, its own y as near to `forward` as it can be.
fn bone(joint: DVec3, direction: DVec3, forward: DVec3) -> Pose {
    let z = -direction.normalize();
    let y = forward.reject_from(z).normalize();
    let rotation = DQuat::from_mat3(&DMat3::from_cols(y.cross(z), y, z));
    Pose { scale: 1.0, rotation, translation: joint }
}

fn pelvis(frame: f64) -> Pose {
    let ground = smoothed(frame, FOLLOW, |f| between_feet(|side| footing(side, f).position));
    let weight = bearing(frame);
    let rotation = facing(heading(frame) + PELVIS_TWIST * stride(frame))
        * DQuat::from_rotation_y(LIST * weight);
    let sway = facing(heading(frame)) * DVec3::X * (SWAY * weight);
    let height = smoothed(frame, BOB, |f| height_in_reach(f, ground_at(f)));
    Pose { scale: 1.0, rotation, translation: ground + sway + DVec3::Z * height }
}

fn ground_at(frame: f64) -> DVec3 {
    smoothed(frame, FOLLOW, |f| between_feet(|side| footing(side, f).position))
}

/// The greatest height of the pelvis at which both legs reach their ankles.
fn height_in_reach(frame: f64, ground: DVec3) -> f64 {
    let turned = facing(heading(frame));
    let reach = REACH * (THIGH_LENGTH + SHIN_LENGTH);
    let of_leg = |side: Side| {
        let hip = parts::hip(side);
        let ankle = foot(side, frame).translation;
        let across = (ground + turned * hip - ankle).truncate().length();
        ankle.z + (reach * reach - across * across).max(0.0).sqrt() - hip.z
    };
    Side::BOTH.map(of_leg).into_iter().fold(f64::INFINITY, f64::min)
}

/// Which way the figure faces (rad).
fn heading(frame: f64) -> f64 {
    smoothed(frame, FOLLOW, |f| between_feet(|side| footing(side, f).heading))
}

/// How far the left foot is ahead of the right one (m).
fn stride(frame: f64) -> f64 {
    smoothed(frame, BOB, |f| {
        let apart = footing(Side::Left, f).position - footing(Side::Right, f).position;
        apart.dot(facing(heading(f)) * DVec3::Y)
    })
}

/// 1 if the right foot bears all weight, -1 if the left one does.
fn bearing(frame: f64) -> f64 {
    smoothed(frame, SHIFT, |f| airborne(Side::Left, f) - airborne(Side::Right, f))
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
