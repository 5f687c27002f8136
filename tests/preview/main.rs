//! The previewer as its users meet it: the built program, driven by scripts, in memory and in a real
//! window on a display that nobody sees.

mod memory;
mod picture;
#[cfg(target_os = "linux")]
mod window;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// Pixels of the program's window, in memory and in a window alike.
const SIZE: [u32; 2] = [1280, 720];

/// The program with a script, on the software adapter, keeping nothing but what is in `folder`.
fn preview(folder: &Path, script: &Value) -> Command {
    preview_on("software", folder, script)
}

fn preview_on(adapter: &str, folder: &Path, script: &Value) -> Command {
    let file = folder.join("script.json");
    std::fs::write(&file, script.to_string()).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_shotsilk"));
    command.arg("preview").args(["--adapter", adapter, "--replay-actions"]).arg(file);
    command.arg("--cache").arg(folder.join("cache"));
    command
}

fn succeeded(output: &Output) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {said}", output.status);
}

fn report(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}
