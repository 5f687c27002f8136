//! A camera baked to one matrix a frame.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::Lens;
use super::path::{Pose, Side};

/// The pose and the lens at a frame: the eye and the lens in a straight line between the two
/// neighbouring samples, the rotation at even speed; a cut is not crossed. Held outside.
///
/// # Panics
/// If there are no samples.
pub(super) fn interpolated(
    samples: &[(DMat4, Lens)],
    cuts: &[u32],
    side: Side,
    frame: f64,
) -> (Pose, Lens) {
    let last = samples.len() - 1;
    let at = frame.clamp(0.0, last as f64);
    let mut index = at as usize;
    let starts_run = |i: usize| cuts.iter().any(|&c| c as usize == i);
    if side == Side::Before && index as f64 == frame && index > 0 && starts_run(index) {
        index -= 1;
        return between(samples[index], samples[index], 0.0);
    }
    let next = if index == last || starts_run(index + 1) { index } else { index + 1 };
    between(samples[index], samples[next], at - index as f64)
}

/// Of two samples, a fraction s of the way from the first to the second.
fn between(a: (DMat4, Lens), b: (DMat4, Lens), s: f64) -> (Pose, Lens) {
    let turned = rotation(a.0).slerp(rotation(b.0), s);
    let [p, q] = [a, b].map(|(_, lens)| lens.components());
    let lens = a.1.with_components(std::array::from_fn(|c| p[c] + (q[c] - p[c]) * s));
    let pose = Pose {
        eye: a.0.w_axis.truncate().lerp(b.0.w_axis.truncate(), s),
        right: turned * DVec3::X,
        up: turned * DVec3::Y,
        back: turned * DVec3::Z,
    };
    (pose, lens)
}

fn rotation(world_from_camera: DMat4) -> DQuat {
    DQuat::from_mat3(&DMat3::from_mat4(world_from_camera)).normalize()
}
