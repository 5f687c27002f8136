//! How little remeshing may disturb cloth that hangs still.
//!
//! Nothing moves but the camera: without remeshing the curtain would hang as it hangs. Whatever it
//! does is the work of edits. Figures are those of the worst frame; lengths on the image are in
//! pixels of the shot's own resolution.

mod change;
mod curtain;

use super::{Claim, Experiment, ExperimentError};
use change::{Change, Shot};

/// Motion of less than half a pixel a frame is swaying that nobody sees.
const SWAY_PX: f64 = 0.5;

/// What jumps at once must be less than what sways (px).
const JUMP_PX: f64 = 0.1;

/// Share of the pixels that are cloth before or after an edit and not both.
const OUTLINE_SHARE: f64 = 1e-3;

/// Strain that edits may leave in the cloth: what it shows in many places anyway.
const STRAIN: f64 = 0.01;

pub fn experiments() -> Vec<Experiment> {
    let claims = vec![
        Claim::none("popping/acceleration", curtain::acceleration_of(STRAIN)),
        Claim::none("popping/velocity-gained", SWAY_PX),
        Claim::none("popping/speed", SWAY_PX),
        Claim::none("popping/shift", JUMP_PX),
        Claim::none("popping/silhouette-distance", JUMP_PX),
        Claim::none("popping/silhouette-share", OUTLINE_SHARE),
    ];
    vec![Experiment::new(claims, || {
        let changes = changes(curtain::LAST)?;
        match changes.iter().any(|c| c.edits > 0) {
            true => Ok(worst(&changes).into()),
            false => Err(ExperimentError::Nothing("nothing was remeshed")),
        }
    })]
}

/// What each of the first frames changes, once the curtain is meshed and at rest.
fn changes(frames: u32) -> Result<Vec<Change>, ExperimentError> {
    let shot = Shot::new(curtain::scene());
    let mut frame = curtain::at_rest(&shot.remeshed)?;
    let mut changes = Vec::new();
    for _ in 0..frames {
        let (next, change) = shot.advance(&frame)?;
        frame = next;
        changes.push(change);
    }
    Ok(changes)
}

/// Root mean squares over the cloth, the worst of all frames: acceleration that edits cause (m/s^2),
/// velocity that they give over a frame and speed (px a frame, in the picture), shift, and distance
/// of the outlines (px), and share of pixels between these.
fn worst(changes: &[Change]) -> [f64; 6] {
    let most = |of: fn(&Change) -> f64| changes.iter().map(of).fold(0.0, f64::max);
    // An outline that is there only before or after is as far off as it can be.
    [
        most(|c| c.acceleration[1].rms - c.acceleration[0].rms),
        most(|c| c.gain_in_picture.rms) * curtain::pixels_a_frame(),
        most(|c| c.speed_in_picture.rms) * curtain::pixels_a_frame(),
        most(|c| c.shift.rms),
        most(|c| c.silhouette.distance.unwrap_or(f64::INFINITY)),
        most(|c| c.silhouette.share),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remeshing_does_not_kick_a_curtain_that_hangs_still() {
        let changes = changes(1).unwrap();
        assert!(changes[0].edits > 0);
        let [acceleration, gain, _, shift, ..] = worst(&changes);
        assert!(acceleration > 0.0 && acceleration < curtain::acceleration_of(STRAIN));
        assert!(gain > 0.0 && gain < SWAY_PX, "{gain}");
        assert!(shift > 0.0 && shift < JUMP_PX, "{shift}");
    }
}
