//! Arguments that several commands share.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::sim::SizingMode;

/// Which shot, and what to change about it.
#[derive(Args, Clone, Debug)]
pub struct ShotArgs {
    /// A shot file, an ARCSim scene, or a folder that `simulate` wrote; without one the shot that
    /// comes with the program
    pub shot: Option<PathBuf>,
    /// Camera file that takes the place of the shot camera
    #[arg(long, value_name = "FILE")]
    pub camera: Option<PathBuf>,
    /// Override a setting: path.to.field=value; may be repeated
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub sets: Vec<String>,
    /// Frames per second, where scene and camera disagree
    #[arg(long)]
    pub fps: Option<f64>,
    /// Frames, both ends included: N means 0..N
    #[arg(long, value_name = "A..B", value_parser = parse_frames)]
    pub frames: Option<FrameRange>,
    /// How the resolution of the cloth is chosen
    #[arg(long, value_enum, default_value_t = Sizing::View)]
    pub sizing: Sizing,
    /// Edge length of uniform sizing (m); without it the finest of the garment's sizing
    #[arg(long, value_name = "METRES", value_parser = parse_length)]
    pub edge_length: Option<f64>,
    /// Threads to compute with; without it all there are. The result does not depend on it
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

/// `--sizing`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Sizing {
    /// A fixed mesh
    Uniform,
    /// As fine as shape and motion ask for, whoever looks
    Adaptive,
    /// As fine as that, where the cameras can see it
    View,
}

impl Sizing {
    pub fn name(self) -> &'static str {
        match self {
            Sizing::Uniform => "uniform",
            Sizing::Adaptive => "adaptive",
            Sizing::View => "view",
        }
    }
}

impl ShotArgs {
    /// What `--sizing` and `--edge-length` say together.
    pub fn sizing_mode(&self) -> SizingMode {
        match self.sizing {
            Sizing::Uniform => SizingMode::Uniform { edge_length: self.edge_length },
            Sizing::Adaptive => SizingMode::Adaptive,
            Sizing::View => SizingMode::View,
        }
    }
}

/// Frames from the first to the last, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRange {
    pub first: u32,
    pub last: u32,
}

impl FrameRange {
    pub fn contains(self, frame: u32) -> bool {
        (self.first..=self.last).contains(&frame)
    }
}

fn parse_frames(text: &str) -> Result<FrameRange, String> {
    let number = |part: &str| {
        part.trim()
            .parse::<u32>()
            .map_err(|_| format!("{part:?} is not a frame number (0 or more)"))
    };
    let (first, last) = match text.split_once("..") {
        Some((first, last)) => (number(first)?, number(last)?),
        None => (0, number(text)?),
    };
    if first > last {
        return Err(format!("the first frame {first} is after the last, {last}"));
    }
    Ok(FrameRange { first, last })
}

fn parse_length(text: &str) -> Result<f64, String> {
    let length: f64 = text.parse().map_err(|_| format!("{text:?} is not a number"))?;
    if length > 0.0 && length.is_finite() {
        Ok(length)
    } else {
        Err(format!("{length} m is not a length above 0"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_ranges_include_both_ends_and_start_at_zero() {
        assert_eq!(parse_frames("3..7"), Ok(FrameRange { first: 3, last: 7 }));
        assert_eq!(parse_frames("7"), Ok(FrameRange { first: 0, last: 7 }));
        assert!(parse_frames("3..7").unwrap().contains(7));
        assert!(!parse_frames("3..7").unwrap().contains(8));
    }

    #[test]
    fn backward_and_unreadable_ranges_are_refused() {
        for text in ["7..3", "a..3", "-1", "1...3", ""] {
            assert!(parse_frames(text).is_err(), "{text:?}");
        }
    }

    #[test]
    fn lengths_are_positive_and_finite() {
        assert_eq!(parse_length("0.02"), Ok(0.02));
        for text in ["0", "-1", "inf", "NaN", "ten"] {
            assert!(parse_length(text).is_err(), "{text:?}");
        }
    }
}
