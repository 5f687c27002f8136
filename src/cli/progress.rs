//! How far a command is: a bar on a terminal, plain lines or log events otherwise; on stderr.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::log::{LogArgs, LogFormat, TERMINAL};
use crate::sim::Frame;

/// How progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgressMode {
    Bar,
    /// A line a frame.
    Lines,
    /// An event of the log a frame.
    Log,
    Silent,
}

impl ProgressMode {
    /// What suits stderr and the flags.
    pub fn detect(log: LogArgs) -> Self {
        match log {
            LogArgs { quiet: true, .. } => ProgressMode::Silent,
            LogArgs { format: LogFormat::Json, .. } => ProgressMode::Log,
            _ if io::stderr().is_terminal() => ProgressMode::Bar,
            _ => ProgressMode::Lines,
        }
    }
}

/// The progress of one command over its frames.
#[derive(Debug)]
pub struct Progress {
    mode: ProgressMode,
    total: u64,
    done: u64,
    started: Instant,
    /// When the last frame was done.
    last: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// `total` frames are to be done.
    pub fn new(total: u64, mode: ProgressMode) -> Self {
        let bar = (mode == ProgressMode::Bar).then(|| {
            let style = ProgressStyle::with_template("{bar:30} {pos}/{len}  {msg}  {eta} left")
                .expect("the template is well formed");
            TERMINAL.add(ProgressBar::new(total).with_style(style))
        });
        let started = Instant::now();
        Self { mode, total, done: 0, started, last: started, bar }
    }

    /// A frame is done, whatever was done with it; `first_frame` is what the shot calls frame 0.
    pub fn frame(&mut self, frame: &Frame, first_frame: i64) {
        let number = i64::from(frame.number) + first_frame;
        let now = Instant::now();
        let seconds = (now - std::mem::replace(&mut self.last, now)).as_secs_f64();
        let faces = frame.face_count();
        self.done += 1;
        let left = time_left(self.started.elapsed(), self.done, self.total);
        match self.mode {
            ProgressMode::Bar => {
                if let Some(bar) = &self.bar {
                    bar.set_message(format!("frame {number}, {faces} faces, {seconds:.2} s"));
                    bar.inc(1);
                }
            }
            ProgressMode::Lines => eprintln!(
                "frame {number} ({} of {}): {faces} faces, {seconds:.2} s, {} left",
                self.done,
                self.total,
                in_words(left)
            ),
            ProgressMode::Log => tracing::info!(
                frame = number,
                done = self.done,
                total = self.total,
                faces,
                seconds,
                seconds_left = left.as_secs_f64(),
                "frame done"
            ),
            ProgressMode::Silent => {}
        }
    }

    /// Takes the bar away.
    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}

/// As if the frames to come took as long as the frames so far; zero when all are done.
fn time_left(elapsed: Duration, done: u64, total: u64) -> Duration {
    let to_come = total.saturating_sub(done);
    elapsed.mul_f64(to_come as f64 / done.max(1) as f64)
}

/// To the second, and above an hour to the minute.
fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64().round() as u64;
    match seconds {
        0..60 => format!("{seconds} s"),
        60..3600 => format!("{} min {:02} s", seconds / 60, seconds % 60),
        _ => format!("{} h {:02} min", seconds / 3600, seconds % 3600 / 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_the_mean_frame_times_the_frames_to_come() {
        let elapsed = Duration::from_secs(30);
        assert_eq!(time_left(elapsed, 10, 40), Duration::from_secs(90));
        assert_eq!(time_left(elapsed, 40, 40), Duration::ZERO);
        assert_eq!(time_left(elapsed, 41, 40), Duration::ZERO);
    }

    #[test]
    fn times_are_written_in_the_unit_that_suits_them() {
        assert_eq!(in_words(Duration::from_millis(7600)), "8 s");
        assert_eq!(in_words(Duration::from_secs(61)), "1 min 01 s");
        assert_eq!(in_words(Duration::from_secs(2 * 3600 + 300)), "2 h 05 min");
    }

    #[test]
    fn flags_choose_how_progress_is_shown() {
        let quiet = LogArgs { quiet: true, ..LogArgs::default() };
        assert_eq!(ProgressMode::detect(quiet), ProgressMode::Silent);
        let json = LogArgs { format: LogFormat::Json, ..LogArgs::default() };
        assert_eq!(ProgressMode::detect(json), ProgressMode::Log);
    }

    #[test]
    fn frames_are_counted_in_every_mode() {
        for mode in
            [ProgressMode::Bar, ProgressMode::Lines, ProgressMode::Log, ProgressMode::Silent]
        {
            let mut progress = Progress::new(2, mode);
            let start = progress.last;
            progress.frame(&Frame::default(), 1001);
            progress.frame(&Frame::default(), 1001);
            assert_eq!(progress.done, 2);
            assert!(progress.last > start);
            progress.finish();
        }
    }
}
