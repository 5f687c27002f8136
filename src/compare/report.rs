//! What a comparison found, and whether it is within its tolerance.

use std::fmt;

use super::metric::{Metric, Value};
use super::tolerance::Tolerance;

/// All that was compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What is compared and with what, as the user calls them.
    pub a: String,
    pub b: String,
    pub kind: Kind,
    pub tolerance: Option<Tolerance>,
    pub items: Vec<Item>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Runs,
    Pictures,
}

impl Kind {
    pub fn name(self) -> &'static str {
        match self {
            Self::Runs => "runs",
            Self::Pictures => "pictures",
        }
    }

    /// What one item is.
    pub fn item_name(self) -> &'static str {
        match self {
            Self::Runs => "frame",
            Self::Pictures => "picture",
        }
    }
}

/// One frame, or one picture.
#[derive(Clone, Debug, Default)]
pub struct Item {
    pub name: String,
    pub values: Vec<Value>,
    /// What keeps the two from being compared.
    pub fault: Option<Fault>,
    /// `rms_px` between two references that start a hair apart, where that is known.
    pub floor_rms_px: Option<f64>,
    /// The floor is too high: chaos, and not B, may make the difference.
    pub is_chaos: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    OnlyInA,
    OnlyInB,
    /// Width and height of both (px).
    Sizes {
        a: [u32; 2],
        b: [u32; 2],
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OnlyInA => write!(f, "only in A"),
            Self::OnlyInB => write!(f, "only in B"),
            Self::Sizes { a, b } => {
                write!(f, "{}x{} px in A, {}x{} px in B", a[0], a[1], b[0], b[1])
            }
        }
    }
}

/// A limit and the value that is above it; `None` is without bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    pub metric: Metric,
    pub value: Option<f64>,
    pub limit: f64,
}

impl fmt::Display for Excess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value.map_or("without bound".to_owned(), short);
        write!(f, "{} is {value}, allowed is {}", self.metric.name(), short(self.limit))
    }
}

/// What became of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    Within,
    Faulty(Fault),
    Exceeded(Vec<Excess>),
    /// Chaos: nothing can be said.
    NotJudged,
}

impl Item {
    pub fn value(&self, metric: Metric) -> Option<Option<f64>> {
        self.values.iter().find(|(m, _)| *m == metric).map(|(_, value)| *value)
    }

    pub fn verdict(&self, tolerance: Option<&Tolerance>) -> Verdict {
        if let Some(fault) = self.fault {
            return Verdict::Faulty(fault);
        }
        if self.is_chaos {
            return Verdict::NotJudged;
        }
        let exceeded = tolerance.map_or(Vec::new(), |tolerance| exceeded(&self.values, tolerance));
        if exceeded.is_empty() { Verdict::Within } else { Verdict::Exceeded(exceeded) }
    }
}

/// The values that are above their limits, or are no numbers.
pub fn exceeded(values: &[Value], tolerance: &Tolerance) -> Vec<Excess> {
    let excess = |&(metric, value): &Value| {
        let limit = tolerance.limit(metric)?;
        let is_above = value.is_none_or(|value| !(value <= limit));
        is_above.then_some(Excess { metric, value, limit })
    };
    values.iter().filter_map(excess).collect()
}

impl Comparison {
    /// False if there is nothing but chaos: a check that says nothing has not been passed.
    pub fn is_judged(&self) -> bool {
        self.items.iter().any(|item| !item.is_chaos)
    }

    /// True if something was judged and nothing failed.
    pub fn has_passed(&self) -> bool {
        self.is_judged() && self.failed().next().is_none()
    }

    pub fn verdict(&self, item: &Item) -> Verdict {
        item.verdict(self.tolerance.as_ref())
    }

    /// Items that are faulty or above a limit.
    pub fn failed(&self) -> impl Iterator<Item = &Item> {
        self.items
            .iter()
            .filter(|item| matches!(self.verdict(item), Verdict::Faulty(_) | Verdict::Exceeded(_)))
    }

    /// The metrics that any item has, in order.
    pub fn metrics(&self) -> Vec<Metric> {
        let has = |metric: &Metric| self.items.iter().any(|item| item.value(*metric).is_some());
        Metric::ALL.into_iter().filter(has).collect()
    }

    /// The largest value over the items that are judged; `None` inside if it is without bound.
    pub fn largest(&self, metric: Metric) -> Option<Option<f64>> {
        let judged = self.items.iter().filter(|item| !item.is_chaos);
        judged.filter_map(|item| item.value(metric)).reduce(|a, b| Some(a?.max(b?)))
    }
}

/// Four significant digits, and no more zeros than that takes.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if (-4.0..6.0).contains(&exponent) {
        let decimals = (3.0 - exponent).max(0.0) as usize;
        return format!("{value:.decimals$}");
    }
    format!("{value:.3e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(value: Option<f64>) -> Item {
        Item { values: vec![(Metric::RmsPx, value)], ..Item::default() }
    }

    fn limit(rms_px: f64) -> Tolerance {
        Tolerance { rms_px: Some(rms_px), ..Tolerance::default() }
    }

    #[test]
    fn a_value_at_its_limit_is_within_and_one_above_is_not() {
        assert_eq!(item(Some(1.0)).verdict(Some(&limit(1.0))), Verdict::Within);
        assert_eq!(item(Some(9.0)).verdict(None), Verdict::Within);
        for value in [Some(1.1), Some(f64::NAN), None] {
            let verdict = item(value).verdict(Some(&limit(1.0)));
            assert!(matches!(verdict, Verdict::Exceeded(_)), "{value:?}: {verdict:?}");
        }
    }

    #[test]
    fn chaos_is_not_judged_but_a_fault_is() {
        let chaotic = Item { is_chaos: true, ..item(Some(9.0)) };
        assert_eq!(chaotic.verdict(Some(&limit(1.0))), Verdict::NotJudged);
        let missing = Item { fault: Some(Fault::OnlyInA), ..Item::default() };
        assert_eq!(missing.verdict(None), Verdict::Faulty(Fault::OnlyInA));
    }

    #[test]
    fn chaos_alone_does_not_pass() {
        let chaotic = Item { is_chaos: true, ..item(Some(0.1)) };
        let mut comparison = Comparison {
            a: "a".into(),
            b: "b".into(),
            kind: Kind::Runs,
            tolerance: Some(limit(1.0)),
            items: vec![chaotic.clone(), chaotic],
        };
        assert!(!comparison.is_judged() && !comparison.has_passed());
        comparison.items.push(item(Some(0.5)));
        assert!(comparison.has_passed());
        comparison.items.push(item(Some(1.5)));
        assert!(!comparison.has_passed());
    }

    #[test]
    fn the_largest_is_over_what_is_judged() {
        let chaotic = Item { is_chaos: true, ..item(Some(9.0)) };
        let items = vec![item(Some(1.0)), chaotic, item(Some(3.0)), Item::default()];
        let comparison = Comparison {
            a: "a".into(),
            b: "b".into(),
            kind: Kind::Runs,
            tolerance: Some(limit(2.0)),
            items,
        };
        assert_eq!(comparison.largest(Metric::RmsPx), Some(Some(3.0)));
        assert_eq!(comparison.largest(Metric::Flip), None);
        assert_eq!(comparison.metrics(), [Metric::RmsPx]);
        assert_eq!(comparison.failed().count(), 1);
    }

    #[test]
    fn numbers_keep_four_digits() {
        let cases = [(0.0, "0"), (1.0, "1.000"), (123_456.7, "123457"), (0.012_345_6, "0.01235")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!(short(1.234e-9), "1.234e-9");
    }
}
