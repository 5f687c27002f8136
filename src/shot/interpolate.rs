//! Smooth motion between keys which never overshoots them.

/// Values of the N components at each frame of one run, frames ascending, read through `value_at`.
///
/// Monotone cubic Hermite ([`FC80`](crate::papers::FC80)): between keys 0 and 1 with spacing h and
/// s = (frame - frame_0) / h,
/// y = y_0 (1 + 2s)(1 - s)^2 + y_1 s^2 (3 - 2s) + h m_0 s (1 - s)^2 + h m_1 s^2 (s - 1).
/// Held before the first key and after the last.
///
/// # Panics
/// If there are no keys.
pub(super) fn monotone<K, const N: usize>(
    keys: &[K],
    frame: f64,
    frame_of: impl Fn(&K) -> f64,
    value_at: impl Fn(&K) -> [f64; N],
) -> [f64; N] {
    let after = keys.partition_point(|k| frame_of(k) <= frame);
    if after == 0 {
        return value_at(&keys[0]);
    }
    if after == keys.len() {
        return value_at(&keys[after - 1]);
    }
    let [f0, f1] = [after - 1, after].map(|i| frame_of(&keys[i]));
    let [y0, y1] = [after - 1, after].map(|i| value_at(&keys[i]));
    let [m0, m1] = [after - 1, after].map(|i| slopes(keys, i, &frame_of, &value_at));
    let h = f1 - f0;
    let s = (frame - f0) / h;
    let r = 1.0 - s;
    std::array::from_fn(|c| {
        y0[c] * (1.0 + 2.0 * s) * r * r + y1[c] * s * s * (3.0 - 2.0 * s) + h * m0[c] * s * r * r
            - h * m1[c] * s * s * r
    })
}

/// Slope of each component at a key; zero at both ends of the run.
fn slopes<K, const N: usize>(
    keys: &[K],
    index: usize,
    frame_of: &impl Fn(&K) -> f64,
    value_at: &impl Fn(&K) -> [f64; N],
) -> [f64; N] {
    if index == 0 || index + 1 == keys.len() {
        return [0.0; N];
    }
    let [before, here, after] = [index - 1, index, index + 1].map(|i| &keys[i]);
    let [h0, h1] = [frame_of(here) - frame_of(before), frame_of(after) - frame_of(here)];
    let [y0, y1, y2] = [before, here, after].map(value_at);
    std::array::from_fn(|c| harmonic_slope([h0, h1], [(y1[c] - y0[c]) / h0, (y2[c] - y1[c]) / h1]))
}

/// The weighted harmonic mean of the slopes on both sides,
/// 3 (h0 + h1) / ((h0 + 2 h1) / d0 + (2 h0 + h1) / d1); zero where they change sign
/// ([`FC80`](crate::papers::FC80)).
fn harmonic_slope([h0, h1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    if d0 * d1 > 0.0 {
        3.0 * (h0 + h1) / ((h0 + 2.0 * h1) / d0 + (2.0 * h0 + h1) / d1)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(keys: &[(f64, f64)], frame: f64) -> f64 {
        monotone(keys, frame, |k| k.0, |k| [k.1])[0]
    }

    #[test]
    fn a_rise_between_two_keys_is_the_smooth_step() {
        let keys = [(0.0, 1.0), (2.0, 3.0)];
        assert_eq!(value(&keys, 1.0), 2.0);
        assert_eq!(value(&keys, -5.0), 1.0);
        assert_eq!(value(&keys, 9.0), 3.0);
    }

    #[test]
    fn no_value_overshoots_its_neighbouring_keys() {
        let keys: [(f64, f64); 5] =
            [(0.0, 0.0), (1.0, 10.0), (5.0, 10.0), (6.0, -3.0), (20.0, -2.9)];
        for pair in keys.windows(2) {
            let (low, high) = (pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1));
            for i in 0..=100 {
                let frame = pair[0].0 + (pair[1].0 - pair[0].0) * f64::from(i) / 100.0;
                let y = value(&keys, frame);
                assert!(y >= low - 1e-12 && y <= high + 1e-12, "{y} at frame {frame}");
            }
        }
    }
}
