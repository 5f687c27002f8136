//! What is wrong with a request, before anything is opened.

use std::collections::HashSet;
use std::ffi::OsString;
use std::fs;
use std::path::Path;

use anyhow::{Result, bail, ensure};

use super::{ExportKind, ExportRequest, ExportView};
use crate::shot::View;

/// The least and the greatest width of a view's picture (px): as small as a folder's icon, and as large
/// as graphics adapters draw.
pub const WIDTH_MIN: u32 = 16;
pub const WIDTH_MAX: u32 = 16_384;

/// The pixels of all pictures on a contact sheet: 1.6 GB in memory, and as much for the page.
pub const SHEET_PIXELS_MAX: u64 = 400_000_000;

/// The frames to export, in order; at least one.
///
/// # Errors
/// A range without frames, a width beyond the limits, a file name of another kind, or a contact sheet
/// without a witness.
pub(super) fn checked_frames(request: &ExportRequest) -> Result<Vec<u32>> {
    let frames = frames(&request.what)?;
    match &request.what {
        ExportKind::Still { .. } => check_png(&request.to)?,
        ExportKind::Sheet { .. } => {
            check_png(&request.to)?;
            sheet_witness(&request.view)?;
        }
        ExportKind::Sequence { .. } | ExportKind::Video { .. } => {}
        // Its files are no pictures.
        ExportKind::Run { .. } => return Ok(frames),
    }
    let width = request.width;
    ensure!(
        (WIDTH_MIN..=WIDTH_MAX).contains(&width),
        "a picture cannot be {width} px wide: {WIDTH_MIN} to {WIDTH_MAX} px are possible"
    );
    Ok(frames)
}

/// What an export would write over, in words; `first_frame` is what frame 0 is called. A run folder that
/// is there is left alone by whoever writes one, and a folder in a file's place by whoever writes the file.
pub fn in_the_way(request: &ExportRequest, first_frame: i64) -> Option<String> {
    let to = &request.to;
    match &request.what {
        ExportKind::Run { .. } => None,
        ExportKind::Still { .. } | ExportKind::Sheet { .. } | ExportKind::Video { .. } => {
            let is_file = to.exists() && !to.is_dir();
            is_file.then(|| format!("there is a {:?} already", to.display()))
        }
        ExportKind::Sequence { .. } => {
            let there = names_in(to);
            let name = |&frame: &u32| picture_name(i64::from(frame) + first_frame, &request.view);
            let is_there = |frame: &&u32| there.contains(&OsString::from(name(frame)));
            let frames = frames(&request.what).unwrap_or_default();
            let count = frames.iter().filter(is_there).count();
            let words = || format!("{:?} holds {count} of these pictures already", to.display());
            (count > 0).then(words)
        }
    }
}

/// By one look, since whoever asks waits: none for a folder that is missing or cannot be read, which is
/// said when it is written.
fn names_in(folder: &Path) -> HashSet<OsString> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    entries.filter_map(|entry| Some(entry.ok()?.file_name())).collect()
}

/// Of a frame of a sequence, as the shot counts.
pub(super) fn picture_name(shown: i64, view: &ExportView) -> String {
    let view = match view {
        ExportView::Shot => "shot",
        ExportView::Witness(_) => "witness",
        ExportView::Both(_) => "both",
    };
    format!("{shown:04}.{view}.png")
}

fn frames(what: &ExportKind) -> Result<Vec<u32>> {
    let range = |first: u32, last: u32, stride: u32| {
        ensure!(first <= last, "the first frame, {first}, is after the last, {last}");
        ensure!(stride > 0, "every 0th frame is none: the least step is 1");
        Ok((first..=last).step_by(stride as usize).collect())
    };
    match what {
        ExportKind::Still { frame } => Ok(vec![*frame]),
        ExportKind::Sheet { frames } => {
            ensure!(!frames.is_empty(), "a contact sheet needs at least one frame");
            Ok(frames.clone())
        }
        ExportKind::Sequence { first, last, stride } => range(*first, *last, *stride),
        ExportKind::Video { first, last } | ExportKind::Run { first, last } => {
            range(*first, *last, 1)
        }
    }
}

fn check_png(path: &Path) -> Result<()> {
    let is_png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    ensure!(
        is_png,
        "cannot write {:?}: it is a PNG file: let its name end in .png",
        path.display()
    );
    Ok(())
}

/// Who looks from outside on a contact sheet.
pub(super) fn sheet_witness(view: &ExportView) -> Result<&View> {
    match view {
        ExportView::Witness(view) | ExportView::Both(view) => Ok(view),
        ExportView::Shot => bail!("a contact sheet shows both views: it needs a witness's"),
    }
}

/// Whether a page of so many frames can be put together; `size` is that of one view's picture (px).
pub(super) fn check_page(frame_count: usize, size: [u32; 2]) -> Result<()> {
    let [width, height] = size.map(u64::from);
    let pixels = (2 * width * height).saturating_mul(frame_count as u64);
    ensure!(
        pixels <= SHEET_PIXELS_MAX,
        "a contact sheet of {frame_count} frames, each view {width} x {height} px, has {} million \
         pixels: {} million are possible, with fewer frames or smaller pictures",
        pixels.div_ceil(1_000_000),
        SHEET_PIXELS_MAX / 1_000_000
    );
    Ok(())
}
