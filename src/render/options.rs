//! How a frame is shown. Plain data with defaults.

use crate::scene::ViewSettings;
use crate::shot::View;

use super::colour::Srgb;
use super::colour_by::{ColourBy, LogRange};

/// How a frame is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureOptions {
    /// Width and height (px); `None` takes the view's own resolution. The view fills the picture:
    /// one of another shape is stretched, see [`size_of_width`].
    pub size: Option<[u32; 2]>,
    pub colour_by: ColourBy,
    pub shading: Shading,
    pub edges: Edges,
    /// How dark the mesh's edges are drawn, 0 (not at all) to 1.
    pub wire_strength: f32,
    /// Width of the mesh's edges (px).
    pub wire_width_px: f32,
    pub crossings: CrossingMarks,
    /// Height of a grid on the ground (m); `None` draws none.
    pub ground_height: Option<f64>,
    pub background: Background,
    /// Height of the legend's text (px); `None` draws no legend.
    pub legend_px: Option<f32>,
}

/// The size (px) of a picture of some width in the view's own shape.
pub fn size_of_width(view: &View, width: u32) -> [u32; 2] {
    let [full_width, full_height] = view.resolution.map(|px| f64::from(px.max(1)));
    let height = f64::from(width) * full_height / full_width;
    [width.max(1), (height.round() as u32).max(1)]
}

/// Whether light sees the folds or the faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Normals per node, across seams.
    #[default]
    Smooth,
    /// Normals per face: shows the mesh as it is.
    Flat,
}

/// How the mesh's edges are coloured.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Edges {
    /// Darker than the face.
    #[default]
    Dark,
    /// By where the faces are to the shot camera, see [`FramePlace`](super::FramePlace); with the
    /// settings of each garment, whose margins count.
    ByFrame(Vec<ViewSettings>),
}

/// Whether faces that pass through others are marked, see [`Crossings`](super::Crossings).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CrossingMarks {
    #[default]
    None,
    /// In magenta. They are looked for in every frame drawn, which costs about a third of drawing
    /// it in software.
    Magenta,
}

/// A gradient behind everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Background {
    pub top: Srgb,
    pub bottom: Srgb,
}

impl Default for Background {
    /// Pale and neutral: both ends of every colour map and black lines stand out against it.
    fn default() -> Self {
        Self { top: Srgb([243, 244, 246]), bottom: Srgb([221, 222, 226]) }
    }
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self {
            size: None,
            colour_by: ColourBy::ViewFactor(LogRange { start: 1.0, end: 0.01 }),
            shading: Shading::Smooth,
            edges: Edges::default(),
            wire_strength: 0.55,
            wire_width_px: 1.0,
            crossings: CrossingMarks::None,
            ground_height: None,
            background: Background::default(),
            legend_px: None,
        }
    }
}
