//! Arguments that several commands share.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, ValueEnum};

use super::failure::Failure;
use crate::request::FrameRange;
use crate::sim::SizingMode;

/// Which shot, and what to change about it.
#[derive(Args, Clone, Debug, Default)]
pub struct ShotArgs {
    /// A shot file or an ARCSim scene; to draw also a folder that `simulate` wrote; without one the
    /// shot that comes with the program
    pub shot: Option<PathBuf>,
    /// Camera file that takes the place of the shot camera
    #[arg(long, value_name = "FILE")]
    pub camera: Option<PathBuf>,
    /// Override a setting: path.to.field=value; may be repeated
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = parse_override)]
    pub sets: Vec<String>,
    /// Frames per second, where scene and camera disagree
    #[arg(long, value_parser = parse_rate, allow_negative_numbers = true)]
    pub fps: Option<f64>,
    /// Frames, both ends included, counted from 0 whatever the shot calls them: N means 0..N.
    /// Without it as far as both shot and camera go
    #[arg(long, value_name = "A..B", value_parser = parse_frames)]
    pub frames: Option<FrameRange>,
    /// How the resolution of the cloth is chosen; without it view
    #[arg(long, value_enum)]
    pub sizing: Option<Sizing>,
    /// Edge length of uniform sizing (m); without it the finest of the garment's sizing
    #[arg(long, value_name = "METRES", value_parser = parse_length, allow_negative_numbers = true)]
    pub edge_length: Option<f64>,
    /// Threads to compute with; without it all there are. The result does not depend on it
    #[arg(long, value_parser = |text: &str| parse_count(text, 1..=u16::MAX))]
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

impl ShotArgs {
    /// What `--sizing` says.
    pub fn sizing(&self) -> Sizing {
        self.sizing.unwrap_or(Sizing::View)
    }

    /// What `--sizing` and `--edge-length` say together.
    ///
    /// # Errors
    /// An edge length for a sizing that finds its own.
    pub fn sizing_mode(&self) -> Result<SizingMode, Failure> {
        match (self.sizing(), self.edge_length) {
            (Sizing::Uniform, edge_length) => Ok(SizingMode::Uniform { edge_length }),
            (_, Some(_)) => Err(Failure::Usage("--edge-length needs --sizing uniform".into())),
            (Sizing::Adaptive, None) => Ok(SizingMode::Adaptive),
            (Sizing::View, None) => Ok(SizingMode::View),
        }
    }

    /// Whether something is asked for that only a simulation can give.
    pub fn changes_the_simulation(&self) -> bool {
        !self.sets.is_empty() || self.sizing.is_some() || self.edge_length.is_some()
    }
}

/// The last frame that can be asked for: days of film, and a list of its frames still fits in memory.
pub(super) const FRAME_MAX: u32 = 9_999_999;

pub(super) fn parse_frames(text: &str) -> Result<FrameRange, String> {
    let number = |part: &str| {
        let number = part.trim().parse().ok().filter(|&n| n <= FRAME_MAX);
        number.ok_or_else(|| format!("{part:?} is not a frame number (0 to {FRAME_MAX})"))
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

/// A whole number within limits.
pub(super) fn parse_count<T>(text: &str, limits: RangeInclusive<T>) -> Result<T, String>
where
    T: FromStr + PartialOrd + Display,
{
    let number = text.parse().ok().filter(|number| limits.contains(number));
    let (least, most) = (limits.start(), limits.end());
    number.ok_or_else(|| format!("{text:?} is not a whole number from {least} to {most}"))
}

fn parse_length(text: &str) -> Result<f64, String> {
    parse_positive(text, "m is not a length above 0")
}

fn parse_rate(text: &str) -> Result<f64, String> {
    parse_positive(text, "frames a second are not a rate above 0")
}

fn parse_positive(text: &str, otherwise: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| format!("{text:?} is not a number"))?;
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err(format!("{number} {otherwise}"))
    }
}

fn parse_override(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((path, _)) if !path.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("an override is path.to.field=value, such as view.nu_out=0.1".to_owned()),
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
        for text in ["7..3", "a..3", "-1", "1...3", "", "4294967295"] {
            assert!(parse_frames(text).is_err(), "{text:?}");
        }
    }

    #[test]
    fn counts_are_whole_numbers_within_limits() {
        assert_eq!((parse_count("1", 1..=64), parse_count("64", 1..=64)), (Ok(1), Ok(64)));
        for text in ["0", "65", "-1", "1.5", "many", "99999999999", ""] {
            let error = parse_count::<u32>(text, 1..=64).unwrap_err();
            assert_eq!(error, format!("{text:?} is not a whole number from 1 to 64"));
        }
    }

    #[test]
    fn lengths_and_rates_are_positive_and_finite() {
        assert_eq!((parse_length("0.02"), parse_rate("24")), (Ok(0.02), Ok(24.0)));
        for text in ["0", "-1", "inf", "NaN", "ten"] {
            assert!(parse_length(text).is_err(), "{text:?}");
            assert!(parse_rate(text).is_err(), "{text:?}");
        }
    }

    #[test]
    fn overrides_name_a_setting() {
        assert!(parse_override("garments.0.name=").is_ok());
        for text in ["fps", "=3", " =3", ""] {
            assert!(parse_override(text).is_err(), "{text:?}");
        }
    }
}
