//! Wavefront OBJ: the flat pieces of a garment, and the surfaces of obstacles.

mod cloth;
mod surface;

pub(super) use cloth::ClothObj;
pub(super) use surface::{Flat, surface_from_obj};

use std::str::SplitWhitespace;
use std::sync::Arc;

use glam::DVec3;

use super::error::{LoadError, Place, Problem};

/// Corners of the largest polygon that is read.
const POLYGON_CORNER_COUNT_MAX: usize = 32;

/// One line: its keyword, the words after it, and where it is.
struct Line<'a> {
    number: usize,
    file: &'a Arc<str>,
    keyword: &'a str,
    words: SplitWhitespace<'a>,
}

/// The lines that hold something, without comments.
fn lines<'a>(file: &'a Arc<str>, text: &'a str) -> impl Iterator<Item = Line<'a>> {
    text.lines().enumerate().filter_map(move |(index, line)| {
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        let keyword = words.next()?;
        Some(Line { number: index + 1, file, keyword, words })
    })
}

impl Line<'_> {
    fn error(&self, problem: Problem) -> LoadError {
        problem.at(Place::Line { file: self.file.clone(), line: self.number })
    }

    fn number(&mut self) -> Result<f64, LoadError> {
        let word = self.words.next().unwrap_or_default();
        match word.parse() {
            Ok(number) if f64::is_finite(number) => Ok(number),
            _ => {
                let expected = "a finite number";
                Err(self.error(Problem::Token { expected, found: word.to_owned() }))
            }
        }
    }

    fn point(&mut self) -> Result<DVec3, LoadError> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    /// Corners of a face: index of the node, and of the vertex if there is one, both from 0.
    fn corners(&mut self, counts: Counts) -> Result<Vec<(u32, Option<u32>)>, LoadError> {
        let mut corners = Vec::new();
        while let Some(word) = self.words.next() {
            let mut parts = word.split('/');
            let node = self.index(word, parts.next().unwrap_or_default(), "node", counts.nodes)?;
            let vertex = match parts.next() {
                None | Some("") => None,
                Some(part) => Some(self.index(word, part, "vertex", counts.vertices)?),
            };
            corners.push((node, vertex));
        }
        if !(3..=POLYGON_CORNER_COUNT_MAX).contains(&corners.len()) {
            return Err(self.error(Problem::OutOfRange {
                thing: "the number of corners of a face".into(),
                value: corners.len().to_string(),
                limit: format!("3 to {POLYGON_CORNER_COUNT_MAX}"),
            }));
        }
        Ok(corners)
    }

    /// Counts from 1, or backwards from -1.
    fn index(
        &self,
        word: &str,
        part: &str,
        what: &'static str,
        count: usize,
    ) -> Result<u32, LoadError> {
        let Ok(index) = part.parse::<i64>() else {
            let expected = "a corner such as 1 or 1/2";
            return Err(self.error(Problem::Token { expected, found: word.to_owned() }));
        };
        let from_zero = if index < 0 { count as i64 + index } else { index - 1 };
        match u32::try_from(from_zero) {
            Ok(valid) if (valid as usize) < count => Ok(valid),
            _ => Err(self.error(Problem::Index { thing: "face", what, index, count })),
        }
    }
}

/// How many nodes (`v`) and vertices (`vt`) the whole file has.
#[derive(Clone, Copy)]
struct Counts {
    nodes: usize,
    vertices: usize,
}

impl Counts {
    fn of(file: &Arc<str>, text: &str) -> Self {
        let count = |keyword| lines(file, text).filter(|line| line.keyword == keyword).count();
        Self { nodes: count("v"), vertices: count("vt") }
    }
}

/// A polygon as triangles that share its first corner.
fn fan<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> {
    corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]])
}
