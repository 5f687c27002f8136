//! The built binary, run as from a shell.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

/// The program in a folder, without the settings of whoever runs the tests.
pub fn command(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shotsilk"));
    command.current_dir(folder).args(line.split_whitespace()).stdin(Stdio::null());
    // Temporary files are seen by the tests that look for what is left behind.
    command.env_remove("SHOTSILK_LOG").env("TMPDIR", folder);
    // Vulkan's loader complains without one.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        command.env("XDG_RUNTIME_DIR", folder);
    }
    command
}

/// The program at work, unheard.
pub fn start(folder: &Path, line: &str) -> Child {
    let mut command = command(folder, line);
    command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("the program starts")
}

/// What came of a command.
#[derive(Debug)]
pub struct Outcome {
    pub line: String,
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Outcome {
    pub fn of(line: &str, output: &Output) -> Self {
        Self {
            line: line.to_owned(),
            code: output.status.code(),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    #[track_caller]
    pub fn succeeds(self) -> Self {
        assert_eq!(self.code, Some(0), "{}\n{}", self.line, self.stderr);
        self
    }

    /// With an exit code and one error, which holds each of the parts; nothing on stdout.
    #[track_caller]
    pub fn fails(self, code: i32, parts: &[&str]) -> Self {
        let Self { line, stdout, stderr, .. } = &self;
        assert_eq!(self.code, Some(code), "{line}\n{stderr}");
        for part in parts {
            assert!(stderr.contains(part), "{line}\n{part:?} is not in {stderr}");
        }
        let errors = stderr.lines().filter(|l| l.to_lowercase().starts_with("error"));
        assert_eq!(errors.count(), 1, "{line}\n{stderr}");
        assert!(!stderr.contains("panicked"), "{line}\n{stderr}");
        assert_eq!(stdout, "", "{line}");
        self
    }
}

/// Runs a command to its end.
pub fn run(folder: &Path, line: &str) -> Outcome {
    let output = command(folder, line).output().expect("the program starts");
    Outcome::of(line, &output)
}
