//! Drawing: the same call for files and for a window.
//!
//! A [`DrawList`] is plain data, built on the CPU from a frame. [`Renderer::draw`] draws it as a
//! [`View`](crate::shot::View) sees it into any texture; [`Headless`] owns such a texture and hands
//! back an image. Two views of one frame, the shot camera's and the witness's, are two lists.
//! No other module knows wgpu.

mod bounds;
mod buffer;
mod camera_glyph;
mod canvas;
mod cloth;
mod colour;
mod colour_by;
mod colour_table;
mod crossings;
mod draw_list;
mod film_gate;
mod frame_edges;
mod gpu;
mod ground;
mod headless;
mod legend;
mod obstacle;
mod options;
mod passes;
mod renderer;
mod screen_edges;
mod seen_ranges;
mod target;
mod text;
mod ui_painter;
mod uniforms;
mod window;
mod witness;

#[cfg(test)]
pub(crate) mod fixture;
#[cfg(test)]
mod picture_tests;

pub use bounds::Bounds;
pub use camera_glyph::{CameraTrail, ShotCamera};
pub use canvas::Canvas;
pub use colour::{Oklab, Srgb};
pub use colour_by::{ColourBy, LogRange, STRAIN_LIMIT, Tick};
pub use colour_table::{COLOURS_PER_TABLE, ColourTable};
pub use crossings::Crossings;
pub use draw_list::{DrawList, FillVertex, Line, Material, SurfaceBatch, SurfaceVertex};
pub use film_gate::{GateRect, SafeArea, gate_aspect, gate_rect};
pub use frame_edges::FramePlace;
pub use gpu::{AdapterChoice, Gpu, RenderError};
pub use headless::Headless;
pub use legend::{draw_legend, legend_size};
pub use options::{Background, CrossingMarks, Edges, PictureOptions, Shading, size_of_width};
pub use renderer::Renderer;
pub use screen_edges::{ScreenEdges, screen_edges};
pub use seen_ranges::SeenRanges;
pub use target::{TARGET_FORMAT, Target, TargetTexture, WINDOW_FORMAT};
pub use text::{Align, Face, draw_text, fitted_text, text_width};
pub use ui_painter::{Sheet, UiPainter};
pub use window::{Presented, WindowSurface};
pub use witness::{WITNESS_FOV_Y, WitnessSubject, witness_view};
