//! How much of the window panels may take, so that the views keep most of it: where the window is small,
//! or text is large, the bar becomes menus, and of settings and costs one is shown.

use std::ops::RangeInclusive;

use egui::{Ui, Vec2};

use crate::preview::{Look, PanelName};

/// The bar with all its words takes so much (points).
const BAR_WIDTH: f32 = 1275.0;
/// Settings and costs together leave the views half of a window of this size at least (points).
const BOTH_PANELS: Vec2 = Vec2::new(1100.0, 640.0);

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Of the window (points).
    pub size: Vec2,
}

impl Room {
    /// Of a window that nothing is laid out in yet.
    pub fn of(ui: &Ui) -> Self {
        Self { size: ui.max_rect().size() }
    }

    /// Whether the bar's groups have to be menus.
    pub fn is_narrow(&self) -> bool {
        self.size.x < BAR_WIDTH
    }

    /// Whether a panel that is open is shown: where there is room for one, settings come first.
    pub fn shows(&self, panel: PanelName, look: &Look) -> bool {
        let is_open = *look.clone().panel_mut(panel);
        is_open && (panel != PanelName::Costs || self.has_both() || !look.parameters_panel)
    }

    /// The panel that there is no room for beside this one.
    pub fn yields_to(&self, panel: PanelName) -> Option<PanelName> {
        match panel {
            _ if self.has_both() => None,
            PanelName::Parameters => Some(PanelName::Costs),
            PanelName::Costs => Some(PanelName::Parameters),
            _ => None,
        }
    }

    /// Whether there is room for settings and costs.
    pub fn has_both(&self) -> bool {
        self.size.x >= BOTH_PANELS.x && self.size.y >= BOTH_PANELS.y
    }

    /// (points).
    pub fn parameters_widths(&self) -> RangeInclusive<f32> {
        match self.has_both() {
            true => 220.0..=520.0,
            false => 160.0..=(0.27 * self.size.x).max(160.0),
        }
    }

    /// (points).
    pub fn costs_heights(&self) -> RangeInclusive<f32> {
        match self.has_both() {
            true => 90.0..=420.0,
            false => 60.0..=(0.2 * self.size.y).max(60.0),
        }
    }
}
