//! What a number must be.

use crate::scene::document::Node;
use crate::scene::error::{LoadError, Problem};
use crate::scene::native::TransformFile;

#[derive(Clone, Copy, Debug)]
pub(super) enum Limit {
    Finite,
    Positive,
    PositiveOrInfinite,
    AtLeastZero,
    /// Above 0 and up to 1.
    Share,
    /// Between two numbers, both left out.
    Between(f64, f64),
    /// Above one number and up to another.
    AboveUpTo(f64, f64),
    Above(f64),
    AtLeast(f64),
    AtMost(f64),
}

impl Limit {
    fn admits(self, value: f64) -> bool {
        match self {
            Limit::Finite => value.is_finite(),
            Limit::Positive => value > 0.0 && value.is_finite(),
            Limit::PositiveOrInfinite => value > 0.0,
            Limit::AtLeastZero => value >= 0.0 && value.is_finite(),
            Limit::Share => value > 0.0 && value <= 1.0,
            Limit::Between(low, high) => value > low && value < high,
            Limit::AboveUpTo(low, high) => value > low && value <= high,
            Limit::Above(low) => value > low,
            Limit::AtLeast(low) => value >= low,
            Limit::AtMost(high) => value <= high,
        }
    }

    fn text(self) -> String {
        match self {
            Limit::Finite => "finite".into(),
            Limit::Positive => "greater than 0".into(),
            Limit::PositiveOrInfinite => "greater than 0, or null for infinity".into(),
            Limit::AtLeastZero => "at least 0".into(),
            Limit::Share => "greater than 0 and at most 1".into(),
            Limit::Between(low, high) => format!("greater than {low} and less than {high}"),
            Limit::AboveUpTo(low, high) => format!("greater than {low} and at most {high}"),
            Limit::Above(low) => format!("greater than {low}"),
            Limit::AtLeast(low) => format!("at least {low}"),
            Limit::AtMost(high) => format!("at most {high}"),
        }
    }
}

/// # Errors
/// The value at `path` of the document is not what it must be.
pub(super) fn check(
    document: &Node,
    path: &str,
    value: f64,
    limit: Limit,
) -> Result<(), LoadError> {
    if limit.admits(value) {
        return Ok(());
    }
    Err(out_of_range(document, path, value, &limit.text()))
}

/// The error that names the setting, its value and its limit.
pub(super) fn out_of_range(
    document: &Node,
    path: &str,
    value: impl ToString,
    limit: &str,
) -> LoadError {
    let (thing, value, limit) = (path.to_owned(), value.to_string(), limit.to_owned());
    Problem::OutOfRange { thing, value, limit }.at(document.place_of(path))
}

/// # Errors
/// A part that is not finite, a scale that is not positive, a rotation without an axis.
pub(super) fn check_transform(
    document: &Node,
    path: &str,
    transform: &TransformFile,
) -> Result<(), LoadError> {
    for (k, value) in transform.translate.into_iter().enumerate() {
        check(document, &format!("{path}.translate.{k}"), value, Limit::Finite)?;
    }
    for (k, value) in transform.rotate.into_iter().enumerate() {
        check(document, &format!("{path}.rotate.{k}"), value, Limit::Finite)?;
    }
    check(document, &format!("{path}.scale"), transform.scale, Limit::Positive)?;
    let [degrees, axis @ ..] = transform.rotate;
    if degrees != 0.0 && axis == [0.0; 3] {
        let path = format!("{path}.rotate");
        return Err(out_of_range(document, &path, format!("{:?}", transform.rotate), AXIS));
    }
    Ok(())
}

const AXIS: &str = "an angle and an axis that is not zero";
