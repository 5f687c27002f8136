//! Motion files (`.mot`): a placement of each body at every sample.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::Pose;
use super::error::{LoadError, Place, Problem};

/// The samples of each body.
///
/// # Errors
/// Lines that are not as the format has them, with their number.
pub(super) fn bodies_from_mot(file: &str, text: &str) -> Result<Vec<Vec<Pose>>, LoadError> {
    let mut lines = Lines { file: file.into(), lines: text.lines().enumerate(), number: 0 };
    let header = lines.next_line()?.unwrap_or_default();
    let count = header.strip_prefix("NumFrames:").and_then(|n| n.trim().parse::<usize>().ok());
    let count = match count {
        Some(count) if count > 0 => count,
        _ => return Err(lines.unexpected("NumFrames: N with N at least 1", header)),
    };
    let mut bodies = Vec::new();
    while let Some(title) = lines.next_line()? {
        lines.title(title, bodies.len(), "position")?;
        let positions: Vec<[f64; 3]> = lines.block(count)?;
        let title = lines.next_line()?.unwrap_or_default();
        lines.title(title, bodies.len(), "orientation")?;
        let rotations: Vec<DQuat> = lines.rotations(count)?;
        let pose = |(translation, rotation)| Pose {
            scale: 1.0,
            rotation,
            translation: DVec3::from_array(translation),
        };
        bodies.push(positions.into_iter().zip(rotations).map(pose).collect());
    }
    Ok(bodies)
}

struct Lines<'a> {
    file: Arc<str>,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    /// Of the line read last, from 1.
    number: usize,
}

impl<'a> Lines<'a> {
    /// The next line that is not blank.
    fn next_line(&mut self) -> Result<Option<&'a str>, LoadError> {
        for (index, line) in self.lines.by_ref() {
            self.number = index + 1;
            if !line.trim().is_empty() {
                return Ok(Some(line.trim()));
            }
        }
        Ok(None)
    }

    fn unexpected(&self, expected: &'static str, found: &str) -> LoadError {
        let place = Place::Line { file: self.file.clone(), line: self.number };
        Problem::Token { expected, found: found.to_owned() }.at(place)
    }

    fn title(&self, title: &str, body: usize, kind: &'static str) -> Result<(), LoadError> {
        if title == format!("body[{body}] {kind}") {
            return Ok(());
        }
        let expected = match kind {
            "position" => "the position of the next body, body[i] position",
            _ => "the orientation of the same body, body[i] orientation",
        };
        Err(self.unexpected(expected, title))
    }

    fn block<const N: usize>(&mut self, count: usize) -> Result<Vec<[f64; N]>, LoadError> {
        (0..count).map(|_| self.numbers()).collect()
    }

    fn rotations(&mut self, count: usize) -> Result<Vec<DQuat>, LoadError> {
        let mut rotations = Vec::with_capacity(count);
        for _ in 0..count {
            let [w, x, y, z] = self.numbers()?;
            let quaternion = DQuat::from_xyzw(x, y, z, w);
            if quaternion.length_squared() < f64::EPSILON {
                return Err(self.unexpected("a quaternion w x y z that is not zero", "0 0 0 0"));
            }
            rotations.push(quaternion.normalize());
        }
        Ok(rotations)
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], LoadError> {
        let line = self.next_line()?.unwrap_or_default();
        let numbers: Vec<f64> = line.split_whitespace().map_while(|w| w.parse().ok()).collect();
        match <[f64; N]>::try_from(numbers) {
            Ok(numbers) if numbers.iter().all(|n| n.is_finite()) => Ok(numbers),
            _ => {
                let expected = if N == 3 { "x y z" } else { "w x y z" };
                Err(self.unexpected(expected, line))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO_SAMPLES: &str = "NumFrames: 2\nbody[0] position\n0 0 1\n1 2 3e-1\n\n\
        body[0] orientation\n1 0 0 0\n0 0 0 2\n\n";

    #[test]
    fn samples_are_read_with_w_first() {
        let bodies = bodies_from_mot("a.mot", TWO_SAMPLES).unwrap();
        assert_eq!(bodies.len(), 1);
        assert_eq!(bodies[0][1].translation, DVec3::new(1.0, 2.0, 0.3));
        assert_eq!(bodies[0][1].rotation, DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0));
    }

    #[test]
    fn bad_lines_are_named() {
        for (from, to, expected) in [
            ("NumFrames: 2", "NumFrames: no", "a.mot:1: expected NumFrames: N"),
            ("NumFrames: 2", "NumFrames: 3", "a.mot:6: expected x y z"),
            ("0 0 1", "0 0", "a.mot:3: expected x y z, found \"0 0\""),
            ("0 0 1", "0 inf 1", "a.mot:3: expected x y z"),
            ("0 0 0 2", "0 0 0 0", "a.mot:8: expected a quaternion"),
            ("body[0] orient", "body[1] orient", "a.mot:6: expected the orientation"),
        ] {
            let error = bodies_from_mot("a.mot", &TWO_SAMPLES.replace(from, to)).unwrap_err();
            assert!(error.to_string().starts_with(expected), "{error}");
        }
    }
}
