//! Where the program stands, as JSON.

use std::path::Path;

use anyhow::{Context as _, Result};
use serde_json::json;

use crate::app::Desk;
use crate::preview::FrameStatus;

/// # Errors
/// If the file cannot be written.
pub(super) fn write_report(desk: &mut Desk, to: &Path) -> Result<()> {
    let text = serde_json::to_string_pretty(&report(desk)).expect("numbers and words");
    std::fs::write(to, text + "\n").with_context(|| format!("cannot write {:?}", to.display()))
}

fn report(desk: &mut Desk) -> serde_json::Value {
    let pace = desk.pace().report();
    let previewer = desk.previewer();
    let (state, timeline) = (previewer.state(), previewer.timeline());
    let letter = |frame| match timeline.status(frame) {
        FrameStatus::Ready => 'r',
        FrameStatus::Mixed => 'm',
        FrameStatus::Stale => 's',
        FrameStatus::Missing => '.',
    };
    let keys: Vec<Option<String>> =
        timeline.keys().into_iter().map(|key| key.map(|key| key.to_string())).collect();
    let messages: Vec<&str> = state.messages.iter().map(|m| m.text.as_str()).collect();
    json!({
        "current": state.playback.current,
        "playing": state.playback.playing,
        "statuses": (0..timeline.len() as u32).map(letter).collect::<String>(),
        "keys": keys,
        "simulated": previewer.simulated(),
        "seconds": (0..timeline.len() as u32)
            .filter_map(|frame| Some(timeline.slot(frame)?.cost?.wall))
            .sum::<f64>(),
        "edits": state.version.edits,
        "settings_hash": previewer.scenery().map(|s| s.settings_hash.clone()),
        "messages": messages,
        "memory_bytes": previewer.store().used(),
        "pace": pace,
    })
}
