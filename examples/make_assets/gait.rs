//! The poses of all parts at a frame: legs reach from the pelvis to the feet, or kick; chest, arms
//! and head go along.

use glam::{DMat3, DQuat, DVec3};
use shotsilk::scene::Pose;

use super::body::Body;
use super::kick::{Bent, Kick};
use super::parts::{self, Part, SHIN_LENGTH, Side, THIGH_LENGTH, UPPER_ARM_LENGTH};
use super::steps::{Steps, facing, smooth};

/// What a figure does.
pub struct Choreography {
    pub steps: Steps,
    /// The foot that kicks must be off the ground meanwhile: it makes a step from its place to it.
    pub kicks: &'static [Kick],
    /// In order of their frames, at least one.
    pub arms: &'static [ArmKey],
}

/// How the arms are held from a frame on: both alike, gently from each to the next.
#[derive(Clone, Copy)]
pub struct ArmKey {
    pub frame: f64,
    /// Away from the body, and then forward (rad).
    pub out: f64,
    pub forward: f64,
    /// Bend of the elbow (rad).
    pub elbow: f64,
}

/// The figure at a frame.
pub struct Figure {
    choreography: &'static Choreography,
    frame: f64,
    pelvis: Pose,
    chest: Pose,
}

/// Twist of the chest against the pelvis' for feet a metre apart (rad).
const CHEST_TWIST: f64 = -0.35;
/// Frames by which chest and head look ahead of the pelvis.
const CHEST_AHEAD: f64 = 1.5;
const HEAD_AHEAD: f64 = 5.0;
/// Arms: how much further out in a turn, for each rad/frame of it (rad); swing for feet a metre
/// apart; bend of the elbow as the arm swings forward.
const ARM_OUT_BY_TURN: f64 = 2.8;
const ARM_SWING: f64 = 0.85;
const ELBOW_BY_SWING: f64 = 0.6;
/// How far the chest leans back in a kick (rad).
const CHEST_LEAN: f64 = 0.28;

impl Figure {
    pub fn at(choreography: &'static Choreography, frame: f64) -> Self {
        let body = Body(choreography);
        let pelvis = body.pelvis(frame);
        let lean = DQuat::from_rotation_x(CHEST_LEAN * body.lean(frame) - 0.03);
        let upright = facing(body.heading(frame + CHEST_AHEAD) + CHEST_TWIST * body.stride(frame));
        let chest = Pose {
            scale: 1.0,
            rotation: upright * lean,
            translation: pelvis.transform_point(parts::WAIST),
        };
        Self { choreography, frame, pelvis, chest }
    }

    /// World from a part's own space.
    pub fn pose(&self, part: Part) -> Pose {
        match part {
            Part::Pelvis => self.pelvis,
            Part::Chest => self.chest,
            Part::Head => Pose {
                scale: 1.0,
                rotation: facing(Body(self.choreography).heading(self.frame + HEAD_AHEAD)),
                translation: self.chest.transform_point(parts::NECK),
            },
            Part::Thigh(side) => self.leg(side)[0],
            Part::Shin(side) => self.leg(side)[1],
            Part::Foot(side) => self.leg(side)[2],
            Part::UpperArm(side) => self.arm(side)[0],
            Part::Forearm(side) => self.arm(side)[1],
        }
    }

    /// Thigh, shin and foot.
    fn leg(&self, side: Side) -> [Pose; 3] {
        let standing = self.standing_leg(side);
        let kicks = self.choreography.kicks.iter().filter(|kick| kick.side == side);
        match kicks.filter_map(|kick| kick.bent(self.frame)).next() {
            None => standing,
            Some(bent) => self.kicking_leg(side, standing, &bent),
        }
    }

    /// Thigh and shin reach from the hip to the ankle with the knee forward.
    fn standing_leg(&self, side: Side) -> [Pose; 3] {
        let steps = &self.choreography.steps;
        let hip = self.pelvis.transform_point(parts::hip(side));
        let foot = steps.foot(side, self.frame);
        let to_ankle = foot.translation - hip;
        let length = to_ankle.length().min(0.9999 * (THIGH_LENGTH + SHIN_LENGTH));
        let down = to_ankle.normalize();
        let toes = facing(steps.footing(side, self.frame).heading) * DVec3::Y;
        let forward = (toes + self.pelvis.rotation * DVec3::Y).reject_from(down).normalize();
        // The knee's place along and off the line from hip to ankle: two circles meet.
        let (a, b) = (THIGH_LENGTH, SHIN_LENGTH);
        let along = (length * length + a * a - b * b) / (2.0 * length);
        let off = (a * a - along * along).max(0.0).sqrt();
        let knee = hip + down * along + forward * off;
        [bone(hip, knee - hip, forward), bone(knee, foot.translation - knee, forward), foot]
    }

    /// From the hip on each part is turned between how it would stand and how it kicks.
    fn kicking_leg(&self, side: Side, standing: [Pose; 3], bent: &Bent) -> [Pose; 3] {
        let turned = |stands: DQuat, kicks: DQuat| {
            let near = if stands.dot(kicks) < 0.0 { -kicks } else { kicks };
            stands.slerp(near, bent.weight)
        };
        let [thigh, shin, foot] = standing.map(|pose| pose.rotation);
        let thigh_kicks = self.pelvis.rotation * bent.hip;
        let shin_kicks = thigh_kicks * bent.knee;
        let hip = self.pelvis.transform_point(parts::hip(side));
        let hung = |rotation: DQuat, translation: DVec3| Pose { scale: 1.0, rotation, translation };
        let thigh = hung(turned(thigh, thigh_kicks), hip);
        let knee = thigh.transform_point(DVec3::NEG_Z * THIGH_LENGTH);
        let shin = hung(turned(shin, shin_kicks), knee);
        let ankle = shin.transform_point(DVec3::NEG_Z * SHIN_LENGTH);
        [thigh, shin, hung(turned(foot, shin_kicks * bent.ankle), ankle)]
    }

    /// Upper arm and forearm, which swing against the legs.
    fn arm(&self, side: Side) -> [Pose; 2] {
        let body = Body(self.choreography);
        let held = held_arms(self.choreography.arms, self.frame);
        let swing = ARM_SWING * body.stride(self.frame) * side.sign();
        let out = held.out + ARM_OUT_BY_TURN * body.turn(self.frame).abs();
        let upper = Pose {
            scale: 1.0,
            rotation: self.chest.rotation
                * DQuat::from_rotation_z(held.forward * side.sign())
                * DQuat::from_rotation_x(swing)
                * DQuat::from_rotation_y(-out * side.sign()),
            translation: self.chest.transform_point(parts::shoulder(side)),
        };
        let bend = held.elbow + ELBOW_BY_SWING * swing.max(-0.5 * held.elbow);
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

/// Between two keys how the arms are held.
fn held_arms(keys: &[ArmKey], frame: f64) -> ArmKey {
    let next = keys.partition_point(|key| key.frame <= frame);
    let (a, b) = (keys[next.saturating_sub(1)], keys[next.min(keys.len() - 1)]);
    let share =
        if a.frame < b.frame { smooth((frame - a.frame) / (b.frame - a.frame)) } else { 0.0 };
    let mix = |from: f64, to: f64| from + share * (to - from);
    ArmKey {
        frame,
        out: mix(a.out, b.out),
        forward: mix(a.forward, b.forward),
        elbow: mix(a.elbow, b.elbow),
    }
}

/// A limb from a joint along a direction, its own y as near to `forward` as it can be.
fn bone(joint: DVec3, direction: DVec3, forward: DVec3) -> Pose {
    let z = -direction.normalize();
    let y = forward.reject_from(z).normalize();
    let rotation = DQuat::from_mat3(&DMat3::from_cols(y.cross(z), y, z));
    Pose { scale: 1.0, rotation, translation: joint }
}
