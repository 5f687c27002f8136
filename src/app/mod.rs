//! The previewer's window: what artists see and touch.
//!
//! The [`Desk`] is the whole program but for where it is shown: it lays out panels, which read the
//! [`Previewer`](crate::preview::Previewer) and answer with [`Action`](crate::preview::Action)s, and
//! draws the viewports through the same renderer as the command line. [`window`] shows a desk in a
//! real window; [`replay`] drives one without.

mod desk;
pub mod export;
mod exports;
mod keys;
mod pace;
mod panel;
mod preferences;
mod presses;
pub mod replay;
mod script;
mod theme;
mod viewport;
pub mod window;

pub use desk::Desk;
pub use pace::{Pace, PaceReport};
pub use preferences::{Preferences, cache_folder};
pub use script::{ScriptError, ScriptStep, script_from_text};

#[cfg(test)]
mod tests;
