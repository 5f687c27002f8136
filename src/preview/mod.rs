//! What the previewer knows and does, without a window: the shot being edited, the frames it has,
//! the thread that makes them. Plain data wherever possible, so that it is tested as such.

mod action;
mod camera_edit;
mod courtesy;
mod differences;
mod edits;
mod engine;
mod history;
mod keeper;
mod key;
mod message;
mod navigate;
mod parameters;
mod plan;
mod planner;
mod previewer;
mod reader;
mod save;
mod scenery;
mod state;
mod store;
mod timeline;

pub use action::{Action, Direction, Export, ExportKind, Reach};
pub use camera_edit::{
    CameraEdit, CameraEditError, Cut, LensScope, LensValue, Placement, camera_setting,
};
pub use courtesy::give_way;
pub use differences::{Difference, Said, differences, tuned_differences};
pub use edits::Edits;
pub use engine::{Engine, Job, JobId};
pub use history::{History, Version};
pub use keeper::{DISK_BUDGET, Keeper};
pub use key::{FrameKey, StepKey};
pub use message::{Event, Outbox, Wake};
pub use navigate::{EyeAndTarget, ImagePlane};
pub use parameters::{Off, Parameter, ParameterKind, Scale, default_value, parameters, value};
pub use plan::{Anchor, Plan};
pub use planner::{Opened, Planner, Source};
#[cfg(test)]
pub use previewer::tests::stage;
pub use previewer::{Effect, Previewer, Shown, Start};
pub use reader::FrameReader;
pub use save::{SaveError, rebased, saved_text, seen_from, wrapped_text};
pub use scenery::Scenery;
pub use state::{
    ColourMode, Layout, Level, Look, Message, Overlay, Overwriting, PanelName, Playback,
    Remembered, State, Viewport,
};
pub use store::{FrameStore, MEMORY_BUDGET, Place};
pub use timeline::{Cost, FrameStatus, Slot, Timeline};
