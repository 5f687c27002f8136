//! Where and when each foot is set: nearly all of a figure's motion follows from such a list.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use shotsilk::scene::Pose;

use super::parts::{ANKLE_HEIGHT, Side};

/// A foot leaves the ground at one frame and is set down elsewhere at another.
pub struct Step {
    pub side: Side,
    pub frames: [f64; 2],
    /// Of the figure along its way (m).
    pub along: f64,
    /// Of the foot, from the way, counter-clockwise (degrees).
    pub heading_deg: f64,
}

pub const fn step(side: Side, frames: [f64; 2], along: f64, heading_deg: f64) -> Step {
    Step { side, frames, along, heading_deg }
}

/// Both feet's steps, each foot's in their order.
pub struct Steps {
    /// Where the way leads, from x, counter-clockwise (degrees).
    pub way_deg: f64,
    /// Which way the figure faces at first, from its way (degrees).
    pub first_heading_deg: f64,
    pub list: &'static [Step],
}

/// Of a foot from the line the figure walks on (m).
const HALF_TRACK: f64 = 0.075;
/// How high a foot is lifted in the middle of a step (m).
const LIFT: f64 = 0.045;
/// What a foot turns over, behind and before the ankle (m).
const HEEL: f64 = -0.05;
const TOES: f64 = 0.172;
/// Within this tilt the foot turns over a point between them (rad), so that it turns smoothly.
const FLAT: f64 = 0.08;
/// A step of this length rolls the foot fully (m).
const FULL_STEP: f64 = 0.9;
/// How far the heel rises before the foot leaves the ground, and the toes before it is set (rad).
const HEEL_RISE: f64 = 0.65;
const TOE_RISE: f64 = 0.30;
/// How long before the step the heel rises, and after it the toes sink (frames).
const HEEL_FRAMES: f64 = 7.0;
const TOE_FRAMES: f64 = 4.0;

/// Where a foot is on the ground.
#[derive(Clone, Copy)]
pub struct Footing {
    /// Below the ankle (m).
    pub position: DVec3,
    /// Of the toes, from x, counter-clockwise (rad).
    pub heading: f64,
}

/// Turns about z: a figure's own forward, y, to a heading (rad).
pub fn facing(heading: f64) -> DQuat {
    DQuat::from_rotation_z(heading - 0.5 * PI)
}

impl Steps {
    /// A foot's place at a frame, as if it were flat on the ground.
    pub fn footing(&self, side: Side, frame: f64) -> Footing {
        let (from, to, share) = self.around(side, frame);
        let s = smooth(share);
        Footing {
            position: from.position.lerp(to.position, s),
            heading: from.heading + s * (to.heading - from.heading),
        }
    }

    /// 1 while a foot is off the ground, else 0.
    pub fn airborne(&self, side: Side, frame: f64) -> f64 {
        let (_, _, share) = self.around(side, frame);
        if share > 0.0 && share < 1.0 { 1.0 } else { 0.0 }
    }

    /// World from a foot's own space, whose origin is the ankle.
    pub fn foot(&self, side: Side, frame: f64) -> Pose {
        let ground = self.footing(side, frame);
        let (_, _, share) = self.around(side, frame);
        let tilt = self.tilt(side, frame);
        let on_heel = smooth(0.5 + 0.5 * tilt / FLAT);
        let pivot = DVec3::new(0.0, TOES + on_heel * (HEEL - TOES), -ANKLE_HEIGHT);
        let heading = facing(ground.heading);
        let rotation = heading * DQuat::from_rotation_x(tilt);
        let lift = DVec3::Z * (ANKLE_HEIGHT + LIFT * (PI * share).sin().powi(2));
        let translation = ground.position + lift + heading * pivot - rotation * pivot;
        Pose { scale: 1.0, rotation, translation }
    }

    /// How far the toes are up (rad): below 0 before and at the start of a step, above at its end.
    fn tilt(&self, side: Side, frame: f64) -> f64 {
        let mut tilt = 0.0;
        for (index, step) in self.list.iter().enumerate().filter(|(_, s)| s.side == side) {
            let (from, to) = (self.before(index), self.landing(step));
            let roll = (from.position.distance(to.position) / FULL_STEP).clamp(0.15, 1.0);
            let [start, end] = step.frames;
            let share = ((frame - start) / (end - start)).clamp(0.0, 1.0);
            let heel =
                smooth((frame - start + HEEL_FRAMES) / HEEL_FRAMES) * (1.0 - smooth(share / 0.7));
            let toes = smooth((share - 0.5) / 0.5) * (1.0 - smooth((frame - end) / TOE_FRAMES));
            tilt += roll * (TOE_RISE * toes - HEEL_RISE * heel);
        }
        tilt
    }

    /// The footings between which a foot is at a frame, and its share of the way.
    fn around(&self, side: Side, frame: f64) -> (Footing, Footing, f64) {
        let of_side = |(_, s): &(usize, &Step)| s.side == side;
        let begun = |(_, s): &(usize, &Step)| s.frames[0] <= frame;
        let current = self.list.iter().enumerate().filter(of_side).rfind(begun);
        match current {
            None => (self.first(side), self.first(side), 0.0),
            Some((index, step)) => {
                let [start, end] = step.frames;
                (self.before(index), self.landing(step), ((frame - start) / (end - start)).min(1.0))
            }
        }
    }

    /// Where a step starts.
    fn before(&self, index: usize) -> Footing {
        let earlier = self.list[..index].iter().rev().find(|s| s.side == self.list[index].side);
        earlier.map_or_else(|| self.first(self.list[index].side), |step| self.landing(step))
    }

    fn first(&self, side: Side) -> Footing {
        self.landing(&step(side, [0.0; 2], 0.0, self.first_heading_deg))
    }

    fn landing(&self, step: &Step) -> Footing {
        let way = self.way_deg.to_radians();
        let heading = way + step.heading_deg.to_radians();
        let right = facing(heading) * DVec3::X;
        let position =
            facing(way) * DVec3::Y * step.along + right * (HALF_TRACK * step.side.sign());
        Footing { position, heading }
    }
}

/// From 0 to 1 with no slope and no curvature at either end.
pub fn smooth(share: f64) -> f64 {
    let s = share.clamp(0.0, 1.0);
    s * s * s * (s * (6.0 * s - 15.0) + 10.0)
}
