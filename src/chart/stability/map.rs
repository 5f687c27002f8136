//! The map: a row a stress, a cell a value, coloured by what it is called.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{StabilityMap, StressRow};
use crate::stability::{Record, Verdict};

/// (px).
const WIDTH: u32 = 1020;
const MARGIN: i32 = 14;
const TITLE_HEIGHT: i32 = 62;
const NAME_WIDTH: i32 = 118;
/// Name and cells with their gap; above them a line that says what is done.
const ROW_HEIGHT: i32 = 80;
const ABOUT_HEIGHT: i32 = 20;
const GAP: i32 = 4;

/// As many as the longest row has: of more, the rest would be drawn beyond the edge.
const CELLS_MAX: i32 = 7;

/// Longer words are cut off in a cell; the tables have them whole.
const LETTERS_MAX: usize = 22;

const INK: RGBColor = RGBColor(44, 46, 52);
const PALE_INK: RGBColor = RGBColor(104, 106, 114);

/// From pale to dark, so that they are told apart in grey and by eyes of every kind.
fn colours(verdict: Verdict) -> [RGBColor; 2] {
    match verdict {
        Verdict::Ok => [RGBColor(214, 234, 226), INK],
        Verdict::Degraded => [RGBColor(247, 206, 120), INK],
        Verdict::Failed => [RGBColor(146, 42, 72), WHITE],
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome = Result<(), Box<dyn Error>>;

impl StabilityMap {
    /// As SVG.
    ///
    /// # Errors
    /// If the drawing library refuses.
    pub fn svg(&self) -> Result<String, Box<dyn Error>> {
        let mut text = String::new();
        {
            let height = TITLE_HEIGHT + ROW_HEIGHT * self.rows.len() as i32 + MARGIN;
            let size = (WIDTH, height as u32);
            let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
            area.fill(&WHITE)?;
            draw_title(&area)?;
            let mut top = TITLE_HEIGHT;
            for row in &self.rows {
                row.draw(&area, top)?;
                top += ROW_HEIGHT;
            }
            area.present()?;
        }
        Ok(text)
    }
}

fn draw_title(area: &Area<'_>) -> Outcome {
    let title = "Stability under stress that grows from left to right";
    write(area, title, (MARGIN, 24), 17, INK, HPos::Left)?;
    let mut left = MARGIN;
    for (verdict, text) in [
        (Verdict::Ok, "holds"),
        (Verdict::Degraded, "degraded: heals, or shows only"),
        (Verdict::Failed, "fails: frames are wrong or missing"),
    ] {
        area.draw(&Rectangle::new([(left, 38), (left + 14, 52)], colours(verdict)[0].filled()))?;
        write(area, text, (left + 20, 49), 12, INK, HPos::Left)?;
        left += 40 + 6 * text.len() as i32;
    }
    let note = "in a cell: the value, the worst that was found, CPU time";
    write(area, note, (WIDTH as i32 - MARGIN, 49), 12, PALE_INK, HPos::Right)
}

impl StressRow {
    fn draw(&self, area: &Area<'_>, top: i32) -> Outcome {
        write(area, &self.name, (MARGIN, top + 14), 13, INK, HPos::Left)?;
        let first = MARGIN + NAME_WIDTH;
        write(area, &self.about, (first, top + 14), 11, PALE_INK, HPos::Left)?;
        let width = (WIDTH as i32 - MARGIN - first) / CELLS_MAX;
        for (place, record) in (0..).zip(&self.records) {
            let left = first + place * width;
            let (from, to) = (top + ABOUT_HEIGHT, top + ROW_HEIGHT - GAP);
            draw_cell(area, [(left, from), (left + width - GAP, to)], record)?;
        }
        Ok(())
    }
}

fn draw_cell(area: &Area<'_>, [from, to]: [(i32, i32); 2], record: &Record) -> Outcome {
    let [fill, ink] = colours(record.verdict());
    area.draw(&Rectangle::new([from, to], fill.filled()))?;
    let left = from.0 + 6;
    write(area, &record.label, (left, from.1 + 15), 13, ink, HPos::Left)?;
    let time = format!("{:.1} s", record.cpu_seconds);
    write(area, &time, (to.0 - 6, from.1 + 15), 11, ink, HPos::Right)?;
    let flaws = record.flaws();
    for (line, flaw) in (0..).zip(flaws.iter().take(2)) {
        let text: String = flaw.text.chars().take(LETTERS_MAX).collect();
        write(area, &text, (left, from.1 + 33 + 15 * line), 11, ink, HPos::Left)?;
    }
    Ok(())
}

/// On a line (px).
fn write(
    area: &Area<'_>,
    text: &str,
    at: (i32, i32),
    size: i32,
    ink: RGBColor,
    side: HPos,
) -> Outcome {
    let style =
        ("sans-serif", size).into_text_style(area).color(&ink).pos(Pos::new(side, VPos::Bottom));
    area.draw_text(text, &style, (at.0, at.1 + 3))?;
    Ok(())
}
