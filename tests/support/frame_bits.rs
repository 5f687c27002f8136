//! What two runs of the same bits share.

use shotsilk::sim::{Frame, StageSeconds};

/// All that a frame holds but its timings. Debug output tells every number from every other, and
/// 0 from -0.
pub fn bits(frame: &Frame) -> String {
    let mut untimed = frame.clone();
    untimed.report.stages = StageSeconds::default();
    untimed.report.cpu_seconds = 0.0;
    format!("{untimed:?}")
}
