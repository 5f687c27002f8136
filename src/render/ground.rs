//! A faint grid on the ground, for scale and for where down is.

use glam::DVec3;

use super::bounds::Bounds;
use super::draw_list::Line;

const COLOUR: [u8; 3] = [96, 100, 108];
/// Opacity of the lines where they are strongest.
const ALPHA: f64 = 64.0;
/// Lines on each side of the middle.
const REACH: i32 = 12;
/// Pieces a line is divided into, so that it can fade to all sides.
const PIECES: i32 = 12;
const WIDTH_PX: f32 = 1.0;

/// Lines under the subject at a height (m), 0.1, 1, 10... metres apart by its size; they fade out
/// with the distance. In the local space of `origin`.
pub(super) fn lines(height: f64, subject: Bounds, origin: DVec3) -> Vec<Line> {
    let spacing = spacing(subject.radius());
    let centre = (subject.centre() / spacing).round() * spacing;
    let reach = f64::from(REACH) * spacing;
    let mut lines = Vec::new();
    for i in -REACH..=REACH {
        let across = f64::from(i) * spacing;
        for piece in -PIECES..PIECES {
            let ends = [piece, piece + 1].map(|k| f64::from(k) * reach / f64::from(PIECES));
            let alphas = ends.map(|along| alpha(along.hypot(across) / reach));
            if alphas == [0, 0] {
                continue;
            }
            for swap in [false, true] {
                let place = |along: f64| {
                    let (x, y) = if swap { (across, along) } else { (along, across) };
                    let point = DVec3::new(centre.x + x, centre.y + y, height);
                    (point - origin).as_vec3().to_array()
                };
                let [start_colour, end_colour] = alphas.map(|a| with_alpha(COLOUR, a));
                let [start, end] = ends.map(place);
                lines.push(Line { start, end, start_colour, end_colour, width_px: WIDTH_PX });
            }
        }
    }
    lines
}

/// A tenth, a half or one of a power of ten (m), so that a subject covers a few cells.
fn spacing(radius: f64) -> f64 {
    let wanted = (radius * 0.4).clamp(1e-3, 1e3);
    let power = 10f64.powf(wanted.log10().floor());
    [5.0, 2.0, 1.0].map(|m| m * power).into_iter().find(|&s| s <= wanted).unwrap_or(power)
}

fn alpha(distance: f64) -> u8 {
    (ALPHA * (1.0 - distance * distance).max(0.0)).round() as u8
}

fn with_alpha([r, g, b]: [u8; 3], alpha: u8) -> [u8; 4] {
    [r, g, b, alpha]
}
