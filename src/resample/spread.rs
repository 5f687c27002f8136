//! Many values in a few numbers.

/// How values are spread; all zero for none at all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// The root of the mean square.
    pub rms: f64,
    /// The least value that 95 % of the weight does not exceed.
    pub p95: f64,
    pub largest: f64,
}

const PERCENTILE: f64 = 0.95;

impl Spread {
    /// Of values that weigh the same.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        Self::weighted(values.into_iter().map(|value| (value, 1.0)))
    }

    /// Of (value, weight); values and weights at least 0.
    pub fn weighted(values: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut values: Vec<(f64, f64)> = values.into_iter().filter(|v| v.1 > 0.0).collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = values.iter().map(|v| v.1).sum();
        let Some(&(largest, _)) = values.last() else { return Self::default() };
        let square: f64 = values.iter().map(|(value, weight)| weight * value * value).sum();
        let mut below = 0.0;
        let reached = values.iter().find(|(_, weight)| {
            below += weight;
            below >= PERCENTILE * total
        });
        let p95 = reached.map_or(largest, |v| v.0);
        Self { rms: (square / total).sqrt(), p95, largest }
    }
}

/// Share of the values above a limit; 0 of none.
pub fn share_above(limit: f64, values: &[f64]) -> f64 {
    let count = values.iter().filter(|&&value| value > limit).count();
    count as f64 / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_are_their_own_spread() {
        let spread = Spread::of([3.0; 7]);
        assert_eq!(spread, Spread { rms: 3.0, p95: 3.0, largest: 3.0 });
    }

    #[test]
    fn the_95th_percentile_leaves_out_the_largest_twentieth() {
        let spread = Spread::of((1..=100).map(f64::from));
        assert_eq!((spread.p95, spread.largest), (95.0, 100.0));
        let weighted = Spread::weighted([(1.0, 94.0), (2.0, 6.0), (9.0, 0.0)]);
        assert_eq!((weighted.p95, weighted.largest), (2.0, 2.0));
    }

    #[test]
    fn nothing_has_no_spread_and_no_share() {
        assert_eq!(Spread::of([]), Spread::default());
        assert_eq!(share_above(1.0, &[]), 0.0);
        assert_eq!(share_above(1.0, &[1.0, 1.5, 0.0, 2.0]), 0.5);
    }
}
