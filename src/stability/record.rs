//! What came of a scene at one value of a stress, and what that is called.

use serde::Serialize;

/// What was seen over all frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Record {
    pub stress: String,
    pub value: f64,
    /// The value with its unit.
    pub label: String,
    pub frames_asked: u32,
    pub frames_done: u32,
    /// Most at any frame.
    pub faces: usize,
    /// What ended it before its time, in words: an error, a crash, a state that is not finite.
    pub broken: Option<String>,
    /// It used up its CPU time.
    pub is_too_slow: bool,
    /// Rise of the cloth's energy while nothing outside did work on it but gravity, as a share of
    /// the energy there was ([`watch::Ledger`](super::watch::Ledger)).
    pub energy_gain: f64,
    /// The same of kinetic energy and that in gravity alone, where the mesh changes: what remeshing
    /// does to the elastic energy is no motion yet.
    pub kick: Option<f64>,
    /// Largest root mean square speed of the cloth as a share of what its fall and its drive allow
    /// ([`watch::Ledger`](super::watch::Ledger)).
    pub speed_share: f64,
    /// Pairs of faces of the cloth that cross: most at a frame, and at the last.
    pub crossings: usize,
    pub crossings_at_end: usize,
    /// Faces of the cloth that an obstacle cuts, counted for each obstacle: most at a frame, and at
    /// the last.
    pub cuts: usize,
    pub cuts_at_end: usize,
    /// Nodes inside an obstacle, as the simulator says: most at a frame.
    pub trapped: usize,
    /// Largest principal stretch of a face at any frame, minus 1.
    pub largest_stretch: f64,
    /// How far the middle of the cloth's mass came down at most, and has to come down (m).
    pub fall: f64,
    pub fall_min: f64,
    /// Steps beyond those asked for, where they were halved.
    pub extra_steps: u32,
    /// Steps that did not converge in the iterations they were allowed.
    pub unconverged_steps: u64,
    /// Warnings of the simulator other than of halved steps.
    pub warnings: usize,
    /// CPU time of all frames (s).
    pub cpu_seconds: f64,
}

/// How bad something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// It heals by itself, or shows in the picture only.
    Degraded,
    /// The frames are wrong, or not there.
    Failed,
}

/// Something that is not as it should be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Flaw {
    pub severity: Severity,
    /// In a few words.
    pub text: String,
}

/// What a record is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    Ok,
    Degraded,
    Failed,
}

/// Rise of energy: contact layers and pins keep energy that is not counted, and give it back. Half as
/// much again is no longer the same motion.
const GAIN_DEGRADED: f64 = 0.05;
const GAIN_FAILED: f64 = 0.5;

/// Cotton tears at a quarter or less; what is twice as long as it was looks like no cloth.
const STRETCH_DEGRADED: f64 = 0.25;
const STRETCH_FAILED: f64 = 1.0;

impl Record {
    pub fn verdict(&self) -> Verdict {
        match self.flaws().first().map(|flaw| flaw.severity) {
            None => Verdict::Ok,
            Some(Severity::Degraded) => Verdict::Degraded,
            Some(Severity::Failed) => Verdict::Failed,
        }
    }

    /// What is wrong, the worst first.
    pub fn flaws(&self) -> Vec<Flaw> {
        let mut flaws = self.failures();
        flaws.extend(self.blemishes());
        flaws
    }

    fn failures(&self) -> Vec<Flaw> {
        let of =
            |is_so: bool, text: String| is_so.then_some(Flaw { severity: Severity::Failed, text });
        let broken = self.broken.clone().map(|text| Flaw { severity: Severity::Failed, text });
        let [gain, speed, stretch] = [self.energy_gain, self.speed_share, self.largest_stretch];
        let kick = self.kick.unwrap_or(0.0);
        // One that was broken off has not had the time.
        let hangs = self.frames_done == self.frames_asked && !(self.fall >= self.fall_min);
        let fall = format!("fell {:.0} of {:.0} mm", 1e3 * self.fall, 1e3 * self.fall_min);
        let found = [
            broken,
            of(self.is_too_slow, format!("too slow: frame {}", self.frames_done)),
            // Written so that a NaN fails.
            // Where the mesh changes a gain is strain, unless it moves something.
            of(
                !(gain <= GAIN_FAILED) && (self.kick.is_none() || !gain.is_finite()),
                format!("energy +{}", percent(gain)),
            ),
            of(!(kick <= GAIN_FAILED), format!("kick +{}", percent(kick))),
            of(!(speed <= 1.0), format!("speed x{speed:.1}")),
            of(self.crossings_at_end > 0, counted(self.crossings_at_end, "crossing")),
            of(self.cuts_at_end > 0, counted(self.cuts_at_end, "face") + " cut"),
            of(!(stretch <= STRETCH_FAILED), format!("stretch {}", percent(stretch))),
            of(hangs, fall),
        ];
        found.into_iter().flatten().collect()
    }

    fn blemishes(&self) -> Vec<Flaw> {
        let of = |is_so: bool, text: String| {
            is_so.then_some(Flaw { severity: Severity::Degraded, text })
        };
        let (gain, stretch) = (self.energy_gain, self.largest_stretch);
        let kick = self.kick.unwrap_or(0.0);
        let found = [
            of(
                self.crossings > 0 && self.crossings_at_end == 0,
                counted(self.crossings, "crossing") + " for a time",
            ),
            of(
                self.cuts > 0 && self.cuts_at_end == 0,
                counted(self.cuts, "face") + " cut for a time",
            ),
            of(
                gain > GAIN_DEGRADED && gain <= GAIN_FAILED && self.kick.is_none(),
                format!("energy +{}", percent(gain)),
            ),
            of(
                gain > GAIN_DEGRADED && self.kick.is_some(),
                format!("strain energy +{}", percent(gain)),
            ),
            of(kick > GAIN_DEGRADED && kick <= GAIN_FAILED, format!("kick +{}", percent(kick))),
            of(self.trapped > 0, counted(self.trapped, "node") + " trapped"),
            of(
                stretch > STRETCH_DEGRADED && stretch <= STRETCH_FAILED,
                format!("stretch {}", percent(stretch)),
            ),
            of(self.extra_steps > 0, format!("{} more steps", self.extra_steps)),
            of(self.unconverged_steps > 0, format!("{} unconverged", self.unconverged_steps)),
            of(self.warnings > 0, counted(self.warnings, "warning")),
        ];
        found.into_iter().flatten().collect()
    }
}

fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value < 1e4 { format!("{value:.0} %") } else { format!("{value:.0e} %") }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn good() -> Record {
        Record { frames_asked: 5, frames_done: 5, speed_share: 0.5, ..Record::default() }
    }

    #[test]
    fn a_good_record_has_no_flaw() {
        assert_eq!((good().verdict(), good().flaws()), (Verdict::Ok, vec![]));
    }

    #[test]
    fn every_failure_is_found_and_named() {
        for (record, text) in [
            (Record { broken: Some("crash: no".into()), ..good() }, "crash: no"),
            (Record { is_too_slow: true, frames_done: 3, ..good() }, "too slow: frame 3"),
            (Record { energy_gain: 1.5, ..good() }, "energy +150 %"),
            (Record { energy_gain: f64::NAN, ..good() }, "energy +NaN %"),
            (Record { energy_gain: f64::NAN, kick: Some(0.0), ..good() }, "energy +NaN %"),
            (Record { energy_gain: 9.0, kick: Some(2.0), ..good() }, "kick +200 %"),
            (Record { kick: Some(f64::NAN), ..good() }, "kick +NaN %"),
            (Record { speed_share: 3.0, ..good() }, "speed x3.0"),
            (Record { speed_share: f64::NAN, ..good() }, "speed xNaN"),
            (Record { crossings: 9, crossings_at_end: 2, ..good() }, "2 crossings"),
            (Record { cuts: 9, cuts_at_end: 1, ..good() }, "1 face cut"),
            (Record { largest_stretch: 2.0, ..good() }, "stretch 200 %"),
            (Record { largest_stretch: f64::NAN, ..good() }, "stretch NaN %"),
            (Record { fall: 0.01, fall_min: 0.1, ..good() }, "fell 10 of 100 mm"),
        ] {
            assert_eq!(record.verdict(), Verdict::Failed, "{text}");
            assert!(record.flaws()[0].text.starts_with(text), "{:?}", record.flaws());
        }
    }

    #[test]
    fn what_heals_or_only_shows_is_degraded() {
        for record in [
            Record { crossings: 2, ..good() },
            Record { cuts: 2, ..good() },
            Record { energy_gain: 0.1, ..good() },
            Record { energy_gain: 9.0, kick: Some(0.01), ..good() },
            Record { kick: Some(0.2), ..good() },
            Record { trapped: 1, ..good() },
            Record { largest_stretch: 0.3, ..good() },
            Record { extra_steps: 1, ..good() },
            Record { unconverged_steps: 1, ..good() },
            Record { warnings: 1, ..good() },
        ] {
            assert_eq!(record.verdict(), Verdict::Degraded, "{record:?}");
            assert_eq!(record.flaws().len(), 1, "{record:?}");
        }
    }

    #[test]
    fn the_worst_comes_first() {
        let record = Record { trapped: 1, crossings: 4, crossings_at_end: 4, ..good() };
        let texts: Vec<String> = record.flaws().into_iter().map(|flaw| flaw.text).collect();
        assert_eq!(texts, ["4 crossings", "1 node trapped"]);
    }
}
