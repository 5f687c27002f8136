//! The film gate in a window: where the shot's picture stands, and what of it is safe.

use crate::shot::View;

/// A rectangle in a window, y down (px).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GateRect {
    pub left: f32,
    pub top: f32,
    pub width: f32,
    pub height: f32,
}

/// The part of a picture that every screen shows, whatever it cuts off at its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SafeArea {
    /// What the story needs.
    Action,
    /// What must be read.
    Title,
}

impl SafeArea {
    /// Of the picture's width and of its height, as SMPTE ST 2046-1:2009 has it.
    pub fn share(self) -> f32 {
        match self {
            Self::Action => 0.93,
            Self::Title => 0.90,
        }
    }
}

/// Width over height of the picture that a view makes; 1 for a gate without extent.
pub fn gate_aspect(view: &View) -> f64 {
    let size = view.gate_max - view.gate_min;
    let aspect = size.x / size.y;
    if aspect > 0.0 && aspect.is_finite() { aspect } else { 1.0 }
}

/// The largest rectangle of an aspect (width over height) in the middle of a viewport of a size (px),
/// its edges on whole pixels: bars are left above and below it or at its sides. The whole viewport for
/// an aspect that is not above 0 or not finite; at least one pixel of a viewport that has any.
pub fn gate_rect(aspect: f64, viewport: [f32; 2]) -> GateRect {
    let [width, height] = viewport.map(|px| if px.is_finite() { px.max(0.0) } else { 0.0 });
    let whole = GateRect { left: 0.0, top: 0.0, width, height };
    if !(aspect > 0.0 && aspect.is_finite()) || width < 1.0 || height < 1.0 {
        return whole;
    }
    let wanted = (f64::from(height) * aspect) as f32;
    let (gate_width, gate_height) = match wanted <= width {
        true => (wanted.round().max(1.0), height),
        false => (width, ((f64::from(width) / aspect) as f32).round().max(1.0)),
    };
    GateRect {
        left: (0.5 * (width - gate_width)).floor(),
        top: (0.5 * (height - gate_height)).floor(),
        width: gate_width,
        height: gate_height,
    }
}

impl GateRect {
    /// The safe area in this picture, about its middle. Not on whole pixels: it is drawn as lines.
    pub fn safe_area(self, area: SafeArea) -> Self {
        let (width, height) = (self.width * area.share(), self.height * area.share());
        Self {
            left: self.left + 0.5 * (self.width - width),
            top: self.top + 0.5 * (self.height - height),
            width,
            height,
        }
    }

    pub fn contains(self, [x, y]: [f32; 2]) -> bool {
        (self.left..self.left + self.width).contains(&x)
            && (self.top..self.top + self.height).contains(&y)
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::look_at;
    use super::*;
    use glam::DVec3;

    const WIDE: f64 = 16.0 / 9.0;

    fn rect(left: f32, top: f32, width: f32, height: f32) -> GateRect {
        GateRect { left, top, width, height }
    }

    #[test]
    fn a_wide_shot_has_bars_above_and_below_in_a_square_and_a_tall_one_at_its_sides() {
        assert_eq!(gate_rect(WIDE, [800.0, 800.0]), rect(0.0, 175.0, 800.0, 450.0));
        assert_eq!(gate_rect(0.5, [800.0, 800.0]), rect(200.0, 0.0, 400.0, 800.0));
        assert_eq!(gate_rect(WIDE, [1280.0, 720.0]), rect(0.0, 0.0, 1280.0, 720.0));
    }

    #[test]
    fn the_gate_stays_in_the_viewport_and_keeps_its_shape_to_a_pixel() {
        for aspect in [0.2, 0.5625, 1.0, 1.85, 2.39, 12.0] {
            for viewport in [[1.0, 1.0], [641.0, 359.0], [333.5, 900.25], [1920.0, 17.0]] {
                let gate = gate_rect(aspect, viewport);
                assert!(gate.left >= 0.0 && gate.left + gate.width <= viewport[0].max(1.0));
                assert!(gate.top >= 0.0 && gate.top + gate.height <= viewport[1].max(1.0));
                assert!(gate.width >= 1.0 && gate.height >= 1.0, "{gate:?}");
                let off = (f64::from(gate.width) - aspect * f64::from(gate.height)).abs();
                let is_tiny = gate.width == 1.0 || gate.height == 1.0;
                assert!(
                    is_tiny || off <= 0.51 * aspect.max(1.0),
                    "{aspect} in {viewport:?}: {gate:?}"
                );
            }
        }
    }

    #[test]
    fn impossible_aspects_and_viewports_give_no_strange_rectangle() {
        for aspect in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(gate_rect(aspect, [100.0, 50.0]), rect(0.0, 0.0, 100.0, 50.0));
        }
        assert_eq!(gate_rect(WIDE, [0.0, 50.0]), rect(0.0, 0.0, 0.0, 50.0));
        assert_eq!(gate_rect(WIDE, [f32::NAN, -3.0]), rect(0.0, 0.0, 0.0, 0.0));
    }

    #[test]
    fn safe_areas_leave_the_standards_margins() {
        let gate = rect(100.0, 40.0, 1000.0, 500.0);
        let near = |a: GateRect, b: GateRect| {
            [a.left - b.left, a.top - b.top, a.width - b.width, a.height - b.height]
                .into_iter()
                .all(|d| d.abs() < 1e-3)
        };
        assert!(near(gate.safe_area(SafeArea::Action), rect(135.0, 57.5, 930.0, 465.0)));
        assert!(near(gate.safe_area(SafeArea::Title), rect(150.0, 65.0, 900.0, 450.0)));
        assert!(gate.contains([100.0, 40.0]) && !gate.contains([1100.0, 40.0]));
    }

    #[test]
    fn the_aspect_is_the_gates() {
        let view = look_at(DVec3::ONE, DVec3::ZERO, 40.0, [1920, 1080]);
        assert!((gate_aspect(&view) - WIDE).abs() < 1e-12);
        assert_eq!(gate_aspect(&View { gate_max: view.gate_min, ..view }), 1.0);
    }
}
