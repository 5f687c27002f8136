//! The program as a user meets it, without pictures: panels are clicked and read by what they say.

mod camera;
mod costs;
mod exports;
mod files;
mod parameters;
mod room;
pub(super) mod seat;
mod timeline;
mod words;
