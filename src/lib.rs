//! Shotsilk simulates cloth only as finely as the shot's camera can see it.
//!
//! The modules stand in reading order; each uses only those above it:
//! what is simulated ([`math`], [`mesh`], [`scene`], [`shot`]), how fine ([`sizing`], [`view`],
//! [`remesh`]), how it moves ([`dynamics`], [`collision`], [`sim`]), how right that is
//! ([`validation`]) and where it fails ([`stability`]), what two runs have in common ([`resample`]),
//! how it is kept ([`run`]), asked for ([`request`]), tried out ([`preview`]) and shown
//! ([`render`], [`sheet`]), how it is judged ([`compare`], [`chart`]), and how it is started: in
//! a window ([`app`]) or not ([`cli`]).
//!
//! # One frame
//! ```text
//! for each step:   obstacles and handles move -> contacts -> implicit step -> collisions resolved
//! once a frame:    base metric per face -> view factor per face -> view-dependent metric
//!                  -> faces to vertices -> remesh -> the frame is published
//! ```
//!
//! # Invariants
//! - Nothing above `sim` knows threads, files, GPU or clocks; nothing above `render` knows wgpu.
//! - The simulation computes in `f64`; `f32` begins at upload.
//! - A published frame never changes.
//! - The simulation is a pure function of shot and settings.
//! - SI units: metres, kilograms, seconds, radians. Z is up, right-handed.
//!
//! Symbols and citations are collected in [`papers`].

pub mod papers;

pub mod math;
pub mod mesh;
pub mod scene;
pub mod shot;

pub mod sizing;
pub mod view;

pub mod remesh;

pub mod collision;
pub mod dynamics;
pub mod sim;

pub mod validation;

pub mod stability;

pub mod resample;

mod output;
pub mod run;

pub mod own_shot;
pub mod request;

pub mod preview;

pub mod render;
pub mod sheet;

pub mod compare;

pub mod chart;

pub mod app;

pub mod cli;
