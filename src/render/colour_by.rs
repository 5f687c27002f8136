//! What the cloth's colour means: which quantity of a face, on which scale, with which ticks.

use crate::mesh::{FaceId, Mesh};
use crate::scene::ViewSettings;

use super::colour_table::ColourTable;

/// Two positive ends of a logarithmic scale; `start` has coordinate 0 and may be the larger one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogRange {
    pub start: f64,
    pub end: f64,
}

impl LogRange {
    /// 0 at the start, 1 at the end; a range without extent is all start.
    pub fn coordinate(self, value: f64) -> f64 {
        let span = (self.end / self.start).ln();
        if span == 0.0 {
            return 0.0;
        }
        // A value at or below zero has no logarithm: it is past the smaller end.
        ((value.max(f64::MIN_POSITIVE) / self.start).ln() / span).clamp(0.0, 1.0)
    }

    fn contains(self, value: f64) -> bool {
        let (low, high) = (self.start.min(self.end), self.start.max(self.end));
        (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&value)
    }
}

/// The strain at the ends of its colour scale, unless somebody says otherwise: what woven cloth hardly
/// ever exceeds.
pub const STRAIN_LIMIT: f64 = 0.1;

/// What the colour of a face shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourBy {
    /// The view factor nu, blue at `start` (nu_front) to red at `end` (the smallest in use).
    ViewFactor(LogRange),
    /// The mean length of the face's edges in the flat cloth (m).
    EdgeSize(LogRange),
    /// The principal stretch furthest from 1, minus 1: stretch positive, compression negative;
    /// from `-limit` to `limit`.
    Strain { limit: f64 },
    /// The length of the mean of the velocities of the face's nodes (m/s): how fast its middle moves;
    /// from rest to `limit`, and even, since a logarithmic scale has no place for cloth at rest.
    Speed { limit: f64 },
    /// Nothing: the fabric.
    Plain,
}

/// A mark on a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// 0..1 along the scale.
    pub coordinate: f64,
    pub label: String,
}

impl ColourBy {
    /// The view factor over all that is in use by these settings, one for each garment.
    pub fn view_factor<'a>(settings: impl IntoIterator<Item = &'a ViewSettings>) -> Self {
        let mut range: Option<LogRange> = None;
        for s in settings {
            let least = s.nu_front.min(s.nu_back).min(s.nu_out);
            let so_far = range.get_or_insert(LogRange { start: s.nu_front, end: least });
            so_far.start = so_far.start.max(s.nu_front);
            so_far.end = so_far.end.min(least);
        }
        let papers = ViewSettings::default();
        Self::ViewFactor(range.unwrap_or(LogRange { start: papers.nu_front, end: papers.nu_out }))
    }

    /// The speed from rest to a round value that the fastest face (m/s) does not exceed.
    pub fn speed(fastest: f64) -> Self {
        Self::Speed { limit: round_limit(fastest) }
    }

    /// `None` where colour shows nothing.
    pub fn table(self) -> Option<ColourTable> {
        match self {
            Self::ViewFactor(_) => Some(ColourTable::ViewFactor),
            Self::EdgeSize(_) => Some(ColourTable::EdgeSize),
            Self::Strain { .. } => Some(ColourTable::Strain),
            Self::Speed { .. } => Some(ColourTable::Speed),
            Self::Plain => None,
        }
    }

    /// The face's value, in the quantity's own unit.
    pub fn value(self, mesh: &Mesh, face: FaceId) -> f64 {
        match self {
            Self::ViewFactor(_) => mesh.view_factor[face],
            Self::EdgeSize(_) => mean_edge_length(mesh, face),
            Self::Strain { .. } => {
                let strains = mesh.deformation_gradient(face).singular_values().map(|s| s - 1.0);
                if strains[0] >= -strains[1] { strains[0] } else { strains[1] }
            }
            Self::Speed { .. } => {
                let [a, b, c] = mesh.face_nodes(face).map(|node| mesh.velocity[node]);
                ((a + b + c) / 3.0).length()
            }
            Self::Plain => 0.0,
        }
    }

    /// Where a value stands on the scale, 0..1.
    pub fn coordinate(self, value: f64) -> f64 {
        match self {
            Self::ViewFactor(range) | Self::EdgeSize(range) => range.coordinate(value),
            Self::Strain { limit } => (0.5 + 0.5 * value / limit).clamp(0.0, 1.0),
            // Of a scale without extent, all is start.
            Self::Speed { limit } if limit > 0.0 => (value / limit).clamp(0.0, 1.0),
            Self::Speed { .. } => 0.0,
            Self::Plain => 0.0,
        }
    }

    pub fn title(self) -> &'static str {
        match self {
            Self::ViewFactor(_) => "view factor",
            Self::EdgeSize(_) => "edge length",
            Self::Strain { .. } => "strain",
            Self::Speed { .. } => "speed (m/s)",
            Self::Plain => "",
        }
    }

    /// The ends and round values between them, in the order of their coordinates.
    pub fn ticks(self) -> Vec<Tick> {
        let tick = |value: f64, label: String| Tick { coordinate: self.coordinate(value), label };
        match self {
            Self::ViewFactor(range) => {
                round_values(range).into_iter().map(|v| tick(v, format!("{v}"))).collect()
            }
            Self::EdgeSize(range) => {
                round_values(range).into_iter().map(|v| tick(v, length_label(v))).collect()
            }
            Self::Strain { limit } => [-1.0, -0.5, 0.0, 0.5, 1.0]
                .map(|share: f64| tick(share * limit, percent_label(share * limit)))
                .to_vec(),
            Self::Speed { limit } => {
                even_values(limit).into_iter().map(|v| tick(v, tidy(v))).collect()
            }
            Self::Plain => Vec::new(),
        }
    }
}

fn mean_edge_length(mesh: &Mesh, face: FaceId) -> f64 {
    let [a, b, c] = mesh.face_material(face);
    (a.distance(b) + b.distance(c) + c.distance(a)) / 3.0
}

/// 1, 2 and 5 times the powers of ten within a range, and its ends where they crowd nothing.
fn round_values(range: LogRange) -> Vec<f64> {
    /// Ticks closer than this (share of the scale) would write over one another.
    const ROOM: f64 = 0.09;
    let mut values = vec![range.start];
    if range.end != range.start {
        values.push(range.end);
    }
    // Powers of ten have the first claim, then 2, then 5.
    for mantissa in [1i32, 2, 5] {
        for exponent in -6i32..=3 {
            // Divided, not multiplied: 2 / 10 prints as 0.2, 2 * 0.1 might not.
            let value = if exponent < 0 {
                f64::from(mantissa) / 10f64.powi(-exponent)
            } else {
                f64::from(mantissa) * 10f64.powi(exponent)
            };
            let place = range.coordinate(value);
            let free = values.iter().all(|&v| (range.coordinate(v) - place).abs() >= ROOM);
            if range.contains(value) && free {
                values.push(value);
            }
        }
    }
    values.sort_by(|&a, &b| range.coordinate(a).total_cmp(&range.coordinate(b)));
    values
}

/// The steps that decimal scales are divided by, as shares of a power of ten.
const ROUND: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// The shortest scale of speed (m/s): what nobody sees move needs no finer one.
const SPEED_LIMIT_MIN: f64 = 0.01;

/// The least 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 or 10 times a power of ten that is not below a value: little
/// of the scale is lost. 1 for a value that is not above 0 or not finite: cloth at rest has a scale
/// too; not below [`SPEED_LIMIT_MIN`].
fn round_limit(value: f64) -> f64 {
    const LIMITS: [f64; 10] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    if !(value > 0.0 && value.is_finite()) {
        return 1.0;
    }
    let power = 10f64.powf(value.log10().floor());
    // The power may be off by a rounding, so that ten times it is not enough.
    let found = LIMITS.iter().map(|l| l * power).find(|&l| l >= value * (1.0 - 1e-9));
    found.unwrap_or(value).max(SPEED_LIMIT_MIN)
}

/// 0, the limit, and multiples of a round step between them, four to six in all.
fn even_values(limit: f64) -> Vec<f64> {
    /// Steps of an even scale are at least this share of it.
    const STEP_MIN: f64 = 0.199;
    if !(limit > 0.0 && limit.is_finite()) {
        return vec![0.0];
    }
    let power = 10f64.powf((limit * STEP_MIN).log10().floor());
    let steps = ROUND.iter().chain(&[10.0]).map(|r| r * power);
    let step = steps.into_iter().find(|&s| s >= limit * STEP_MIN).unwrap_or(limit);
    // Five at most, as the step is a fifth of the limit or more.
    let inner = (0..).map(|i| f64::from(i) * step).take_while(|&v| v < limit - 0.5 * step);
    inner.chain([limit]).collect()
}

fn length_label(metres: f64) -> String {
    if metres < 0.01 {
        format!("{} mm", tidy(metres * 1e3))
    } else if metres < 1.0 {
        format!("{} cm", tidy(metres * 1e2))
    } else {
        format!("{} m", tidy(metres))
    }
}

fn percent_label(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{} %", tidy(value * 100.0))
}

/// At most three significant decimals, no trailing zeros.
fn tidy(value: f64) -> String {
    let rounded = (value * 1e3).round() / 1e3;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::fixture::square;
    use super::*;

    const PAPERS: LogRange = LogRange { start: 1.0, end: 0.01 };

    #[test]
    fn the_scale_is_logarithmic_and_ends_where_it_says() {
        let by = ColourBy::ViewFactor(PAPERS);
        for (value, coordinate) in [(1.0, 0.0), (0.1, 0.5), (0.01, 1.0), (2.0, 0.0), (0.0, 1.0)] {
            assert!((by.coordinate(value) - coordinate).abs() < 1e-12, "{value}");
        }
        let nobody = LogRange { start: 1.0, end: 1.0 };
        assert_eq!(nobody.coordinate(1.0), 0.0);
    }

    #[test]
    fn the_legend_of_the_papers_view_factor_has_their_values() {
        let labels: Vec<String> =
            ColourBy::ViewFactor(PAPERS).ticks().into_iter().map(|t| t.label).collect();
        for wanted in ["1", "0.2", "0.1", "0.01"] {
            assert!(labels.iter().any(|l| l == wanted), "{wanted} is missing in {labels:?}");
        }
    }

    #[test]
    fn the_scale_covers_every_garments_settings() {
        let coarse = ViewSettings { nu_out: 0.1, ..Default::default() };
        let by = ColourBy::view_factor([&coarse, &ViewSettings::default()]);
        assert_eq!(by, ColourBy::ViewFactor(PAPERS));
    }

    #[test]
    fn no_strain_is_in_the_middle() {
        let by = ColourBy::Strain { limit: 0.05 };
        assert_eq!(by.coordinate(0.0), 0.5);
        assert_eq!(by.ticks()[4].label, "+5 %");
    }

    #[test]
    fn a_face_is_as_fast_as_its_middle() {
        let mut mesh = square(0.0, 1.0);
        let face = mesh.face_ids().next().unwrap();
        let by = ColourBy::Speed { limit: 4.0 };
        assert_eq!(by.value(&mesh, face), 0.0);
        // Two nodes fly apart, the third one goes ahead: a third of its speed is the middle's.
        let [a, b, c] = mesh.face_nodes(face);
        mesh.velocity[a] = DVec3::X;
        mesh.velocity[b] = -DVec3::X;
        mesh.velocity[c] = DVec3::new(0.0, 3.0, 0.0);
        assert!((by.value(&mesh, face) - 1.0).abs() < 1e-12);
        assert_eq!(by.coordinate(1.0), 0.25);
        assert_eq!(by.coordinate(9.0), 1.0);
    }

    #[test]
    fn the_scale_of_speed_ends_at_a_round_value_and_has_even_ticks() {
        let labels = |fastest: f64| -> Vec<String> {
            ColourBy::speed(fastest).ticks().into_iter().map(|t| t.label).collect()
        };
        assert_eq!(labels(1.7), ["0", "0.5", "1", "1.5", "2"]);
        assert_eq!(labels(4.9), ["0", "1", "2", "3", "4", "5"]);
        assert_eq!(labels(5.7), ["0", "2", "4", "6"]);
        assert_eq!(labels(0.011), ["0", "0.005", "0.01", "0.015"]);
        assert_eq!(labels(1e-7), ["0", "0.002", "0.004", "0.006", "0.008", "0.01"]);
        assert_eq!(labels(100.0), ["0", "20", "40", "60", "80", "100"]);
    }

    #[test]
    fn cloth_at_rest_and_speeds_that_are_none_have_a_scale() {
        for fastest in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(ColourBy::speed(fastest), ColourBy::Speed { limit: 1.0 }, "{fastest}");
        }
        let empty = ColourBy::Speed { limit: 0.0 };
        assert_eq!((empty.coordinate(3.0), empty.ticks().len()), (0.0, 1));
    }
}
