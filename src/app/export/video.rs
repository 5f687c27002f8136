//! Video: raw frames through a pipe to an installed ffmpeg.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};

use anyhow::{Context, Result, anyhow, bail};
use image::RgbaImage;

use super::Task;
use super::job::{Outcome, Ticket};
use super::pictures::Pictures;
use super::place::opened_folder_of;
use super::stills::NOTHING_LEFT;
use crate::output::PendingFile;

/// A film at the shot's rate.
///
/// # Errors
/// If ffmpeg is missing or fails, in its own words, the file cannot be written, or a frame cannot be
/// drawn. No file is left then.
pub(super) fn film(task: Task<'_>, frames: &[u32]) -> Result<Outcome> {
    let format = format_of(&task.request.to)?;
    let _folder = opened_folder_of(&task.request.to)?;
    let pending = PendingFile::create(&task.request.to)?;
    let encoder = Encoder::of(&task.request.ffmpeg)?;
    let mut pictures = Pictures::new(task)?;
    let fps = pictures.info().fps;
    let mut command = Command::new(&task.request.ffmpeg);
    command.args(arguments(pictures.size(), fps, encoder, format)).arg(pending.temporary_path());
    let mut film = Film::begin(command, task.ticket)?;
    for &number in frames {
        if task.ticket.is_cancelled() {
            return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
        }
        let picture = pictures.picture(number)?;
        if let Err(error) = film.write(&picture) {
            return film.broken_off(&error);
        }
        task.ticket.step();
    }
    film.end()?;
    if task.ticket.is_cancelled() {
        return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
    }
    pending.finish()?;
    Ok(Outcome::Whole)
}

/// What ffmpeg calls the format of a file.
fn format_of(path: &Path) -> Result<&'static str> {
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("mp4") => Ok("mp4"),
        Some("mov") => Ok("mov"),
        Some("mkv") => Ok("matroska"),
        _ => bail!(
            "cannot write {:?}: it is a film: let its name end in .mp4, .mov or .mkv",
            path.display()
        ),
    }
}

/// Ways to encode, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoder {
    X264,
    OpenH264,
    /// Every ffmpeg has it.
    Mpeg4,
}

impl Encoder {
    /// The best that a program has.
    fn of(program: &Path) -> Result<Self> {
        let asked = Command::new(program)
            .args(["-hide_banner", "-encoders"])
            .stdin(Stdio::null())
            .output()
            .map_err(|error| cannot_start(program, error))?;
        let listed = String::from_utf8_lossy(&asked.stdout);
        let has = |encoder: Self| listed.split_whitespace().any(|word| word == encoder.name());
        let found = [Self::X264, Self::OpenH264, Self::Mpeg4].into_iter().find(|&e| has(e));
        found.ok_or_else(|| {
            anyhow!("{:?} can encode neither H.264 nor MPEG-4 video", program.display())
        })
    }

    fn name(self) -> &'static str {
        match self {
            Self::X264 => "libx264",
            Self::OpenH264 => "libopenh264",
            Self::Mpeg4 => "mpeg4",
        }
    }

    /// So good that thin lines stay clean.
    fn quality(self) -> [&'static str; 2] {
        match self {
            Self::X264 => ["-crf", "16"],
            Self::OpenH264 => ["-b:v", "20M"],
            Self::Mpeg4 => ["-q:v", "2"],
        }
    }
}

fn cannot_start(program: &Path, error: io::Error) -> anyhow::Error {
    match error.kind() {
        io::ErrorKind::NotFound => anyhow!(
            "video is encoded by ffmpeg, and there is no program {:?}: install the package ffmpeg",
            program.display()
        ),
        _ => anyhow::Error::new(error).context(format!("cannot start {:?}", program.display())),
    }
}

/// All but the file: pictures of a size (px) come at a rate (1/s) through the standard input. The colours
/// are converted as high-definition video has them, and labelled so.
fn arguments(
    [width, height]: [u32; 2],
    fps: f64,
    encoder: Encoder,
    format: &'static str,
) -> Vec<String> {
    let size = format!("{width}x{height}");
    let rate = format!("{fps}");
    let input = ["-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", &size];
    let timing = ["-framerate", &rate, "-i", "pipe:0"];
    let colours = [
        "-vf",
        concat!(
            "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p,",
            "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709:range=tv"
        ),
        "-colorspace",
        "bt709",
        "-color_primaries",
        "bt709",
        "-color_trc",
        "bt709",
        "-color_range",
        "tv",
    ];
    let mut all = vec!["-hide_banner", "-loglevel", "error", "-nostats", "-y"];
    all.extend(input.into_iter().chain(timing).chain(["-an"]).chain(colours));
    all.extend(["-c:v", encoder.name()].into_iter().chain(encoder.quality()));
    all.extend(["-f", format]);
    all.into_iter().map(str::to_owned).collect()
}

/// An ffmpeg that takes pictures; dropped, it is ended.
struct Film<'a> {
    pipe: Option<ChildStdin>,
    complaints: File,
    bytes: Vec<u8>,
    ticket: &'a Ticket,
}

impl<'a> Film<'a> {
    fn begin(mut command: Command, ticket: &'a Ticket) -> Result<Self> {
        // A file, since a pipe that nobody reads would hold the program up.
        let complaints = tempfile::tempfile().context("cannot create a temporary file")?;
        let errors = complaints.try_clone().context("cannot create a temporary file")?;
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(errors);
        let program = command.get_program().to_owned();
        let mut child =
            command.spawn().map_err(|error| cannot_start(Path::new(&program), error))?;
        let pipe = child.stdin.take();
        ticket.keep_child(child);
        Ok(Self { pipe, complaints, bytes: Vec::new(), ticket })
    }

    fn write(&mut self, picture: &RgbaImage) -> io::Result<()> {
        self.bytes.clear();
        self.bytes.extend(picture.pixels().flat_map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2]]));
        match &mut self.pipe {
            Some(pipe) => pipe.write_all(&self.bytes),
            None => Err(io::ErrorKind::BrokenPipe.into()),
        }
    }

    /// There are no more pictures.
    fn end(mut self) -> Result<()> {
        self.pipe = None;
        let status = self.ticket.wait_for_child().context("cannot wait for ffmpeg")?;
        if status.success() || self.ticket.is_cancelled() {
            return Ok(());
        }
        Err(anyhow!("ffmpeg failed ({status}): {}", self.last_complaint()))
    }

    /// It takes no more pictures: because of the user, or because it gave up.
    fn broken_off(mut self, error: &io::Error) -> Result<Outcome> {
        self.pipe = None;
        if self.ticket.is_cancelled() {
            return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
        }
        let status = self.ticket.wait_for_child().context("cannot wait for ffmpeg")?;
        if self.ticket.is_cancelled() {
            return Ok(Outcome::Cancelled(NOTHING_LEFT.to_owned()));
        }
        Err(anyhow!("ffmpeg took no more pictures ({status}, {error}): {}", self.last_complaint()))
    }

    /// The end of what it wrote to its standard error.
    fn last_complaint(&mut self) -> String {
        const BYTES_MAX: u64 = 400;
        let mut said = Vec::new();
        let end = self.complaints.seek(SeekFrom::End(0)).unwrap_or(0);
        let start = SeekFrom::Start(end.saturating_sub(BYTES_MAX));
        let read = self.complaints.seek(start).and_then(|_| self.complaints.read_to_end(&mut said));
        let said = String::from_utf8_lossy(&said);
        match (read, said.trim()) {
            (Ok(_), text) if !text.is_empty() => text.to_owned(),
            _ => "it does not say why".to_owned(),
        }
    }
}

impl Drop for Film<'_> {
    fn drop(&mut self) {
        self.pipe = None;
        self.ticket.stop_child();
    }
}
