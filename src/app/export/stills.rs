//! PNG pictures: one, a page of many, or a folder of them.

use anyhow::Result;

use super::Task;
use super::check::{check_page, picture_name, sheet_witness};
use super::job::Outcome;
use super::pictures::Pictures;
use super::place::{opened_folder, opened_folder_of};
use crate::output::PendingFile;
use crate::run::RunInfo;
use crate::sheet::{Caption, SheetItem, SheetOptions, compose};
use crate::sim::Frame;

/// What a cancelled export of one file leaves.
pub(super) const NOTHING_LEFT: &str = "cancelled: nothing is written";

/// # Errors
/// If the file cannot be written or the frame cannot be drawn.
pub(super) fn still(task: Task<'_>, number: u32) -> Result<Outcome> {
    let _folder = opened_folder_of(&task.request.to)?;
    let pending = PendingFile::create(&task.request.to)?;
    let picture = Pictures::new(task)?.picture(number)?;
    if task.ticket.is_cancelled() {
        return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
    }
    pending.write_png(&picture)?;
    task.ticket.step();
    Ok(Outcome::Whole)
}

/// # Errors
/// If the file cannot be written, the page is too large, or a frame cannot be drawn.
pub(super) fn sheet(task: Task<'_>, frames: &[u32]) -> Result<Outcome> {
    let witness = sheet_witness(&task.request.view)?;
    let _folder = opened_folder_of(&task.request.to)?;
    let pending = PendingFile::create(&task.request.to)?;
    let mut pictures = Pictures::new(task)?;
    check_page(frames.len(), pictures.size_of_view())?;
    let mut items = Vec::new();
    for &number in frames {
        if task.ticket.is_cancelled() {
            return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
        }
        let frame = pictures.frame(number)?;
        items.push(SheetItem {
            shot: pictures.shot(&frame)?,
            witness: pictures.witness(&frame, witness)?,
            caption: caption(&frame, pictures.info()),
        });
        task.ticket.step();
    }
    let options = SheetOptions {
        title: pictures.info().shot.clone(),
        subtitle: subtitle(frames, pictures.info()),
        colour_by: task.request.options.colour_by,
        thumbnail_width: task.request.width,
        pairs_per_row: None,
    };
    let page = compose(&items, &options);
    if task.ticket.is_cancelled() {
        return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
    }
    pending.write_png(&page)?;
    Ok(Outcome::Whole)
}

fn caption(frame: &Frame, info: &RunInfo) -> Caption {
    Caption {
        frame: i64::from(frame.number) + info.first_frame,
        face_count: frame.face_count(),
        wall_seconds: Some(frame.report.stages.total()),
        view_factor_mean: (info.sizing_mode == "view").then_some(frame.report.view_factor_mean),
    }
}

fn subtitle(frames: &[u32], info: &RunInfo) -> String {
    let shown = |f: Option<&u32>| f.map_or(0, |&f| i64::from(f) + info.first_frame);
    let (first, last) = (shown(frames.first()), shown(frames.last()));
    format!("{} sizing, frames {first} to {last}, {} fps", info.sizing_mode, info.fps)
}

/// # Errors
/// If the folder cannot be written or a frame cannot be drawn: the pictures before it stay.
pub(super) fn sequence(task: Task<'_>, frames: &[u32]) -> Result<Outcome> {
    let folder = opened_folder(&task.request.to)?;
    let mut pictures = Pictures::new(task)?;
    for &number in frames {
        if task.ticket.is_cancelled() {
            return Ok(Outcome::Cancelled(what_stays(task)));
        }
        let shown = i64::from(number) + pictures.info().first_frame;
        let pending = folder.file(&picture_name(shown, &task.request.view))?;
        pending.write_png(&pictures.picture(number)?)?;
        task.ticket.step();
    }
    Ok(Outcome::Whole)
}

/// What a cancelled export of many files leaves.
pub(super) fn what_stays(task: Task<'_>) -> String {
    match task.ticket.counts() {
        [0, _] => "cancelled before the first frame was written".to_owned(),
        [done, total] => format!(
            "cancelled: {done} of {total} frames are written and whole, in {:?}",
            task.request.to.display()
        ),
    }
}
