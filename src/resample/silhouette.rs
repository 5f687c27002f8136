//! How two outlines of the cloth differ.

/// The difference of two masks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SilhouetteDifference {
    /// Pixels that are cloth in one only, as a share of those that are cloth in either; 0 if there
    /// are none.
    pub share: f64,
    /// Mean distance from the outline of each to the outline of the other (px of the mask); `None`
    /// if only one has an outline. The frame's edge is no outline.
    pub distance: Option<f64>,
}

impl SilhouetteDifference {
    /// Of two masks in rows of a width.
    pub fn of(a: &[bool], b: &[bool], width: usize) -> Self {
        let count = |test: fn(bool, bool) -> bool| {
            a.iter().zip(b).filter(|&(&a, &b)| test(a, b)).count() as f64
        };
        let share = count(|a, b| a != b) / count(|a, b| a || b).max(1.0);
        Self { share, distance: outline_distance(&outline(a, width), &outline(b, width), width) }
    }

    /// The same in pixels of another size.
    pub(super) fn in_pixels_of(self, size: f64) -> Self {
        Self { distance: self.distance.map(|d| d * size), ..self }
    }
}

/// Pixels of a mask with a neighbour in the picture, above, below or beside, that is not of it.
fn outline(mask: &[bool], width: usize) -> Vec<bool> {
    let height = mask.len() / width.max(1);
    let is_clear = |x: usize, y: usize| x < width && y < height && !mask[y * width + x];
    (0..mask.len())
        .map(|index| {
            let (x, y) = (index % width, index / width);
            // Before the first column or row a number wraps to one past the last.
            let sides = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
            mask[index] && sides.into_iter().any(|(x, y)| is_clear(x, y))
        })
        .collect()
}

fn outline_distance(a: &[bool], b: &[bool], width: usize) -> Option<f64> {
    match (a.contains(&true), b.contains(&true)) {
        (false, false) => return Some(0.0),
        (true, true) => {}
        _ => return None,
    }
    let one_way = |from: &[bool], to: &[bool]| -> Vec<f64> {
        let squared = squared_distances(to, width);
        from.iter().zip(squared).filter(|(f, _)| **f).map(|(_, d)| d.sqrt()).collect()
    };
    let distances = [one_way(a, b), one_way(b, a)].concat();
    Some(distances.iter().sum::<f64>() / distances.len() as f64)
}

/// Per pixel the squared distance to the nearest pixel of a set that is not empty, exactly: first
/// along columns, then along rows ([`FH12`](crate::papers::FH12)).
fn squared_distances(set: &[bool], width: usize) -> Vec<f64> {
    let height = set.len() / width;
    let far = ((width + height) * (width + height)) as f64;
    let mut distance: Vec<f64> = set.iter().map(|&s| if s { 0.0 } else { far }).collect();
    for x in 0..width {
        let column: Vec<f64> = (0..height).map(|y| distance[y * width + x]).collect();
        for (y, d) in lower_envelope(&column).into_iter().enumerate() {
            distance[y * width + x] = d;
        }
    }
    for row in distance.chunks_mut(width) {
        let lowest = lower_envelope(row);
        row.copy_from_slice(&lowest);
    }
    distance
}

/// At every place p the least of values[q] + (p - q)^2 over all q.
fn lower_envelope(values: &[f64]) -> Vec<f64> {
    let at = |q: usize| values[q] + (q * q) as f64;
    // The parabolas of the envelope, and where each takes over from the one before.
    let mut parabolas: Vec<(usize, f64)> = Vec::new();
    for q in 0..values.len() {
        let mut start = f64::NEG_INFINITY;
        while let Some(&(last, last_start)) = parabolas.last() {
            start = (at(q) - at(last)) / (2 * (q - last)) as f64;
            if start > last_start {
                break;
            }
            parabolas.pop();
            start = f64::NEG_INFINITY;
        }
        parabolas.push((q, start));
    }
    let mut current = 0;
    (0..values.len())
        .map(|p| {
            while parabolas.get(current + 1).is_some_and(|next| next.1 < p as f64) {
                current += 1;
            }
            let (q, _) = parabolas[current];
            values[q] + (p.abs_diff(q) * p.abs_diff(q)) as f64
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const WIDTH: usize = 40;
    const HEIGHT: usize = 30;

    fn rectangle(left: usize, top: usize, width: usize, height: usize) -> Vec<bool> {
        (0..WIDTH * HEIGHT)
            .map(|i| {
                let (x, y) = (i % WIDTH, i / WIDTH);
                (left..left + width).contains(&x) && (top..top + height).contains(&y)
            })
            .collect()
    }

    #[test]
    fn a_shift_by_two_pixels_shows_in_share_and_distance() {
        let (a, b) = (rectangle(5, 5, 20, 10), rectangle(7, 5, 20, 10));
        let difference = SilhouetteDifference::of(&a, &b, WIDTH);
        assert!((difference.share - 40.0 / 220.0).abs() < 1e-12);
        // The sides are two apart; along top and bottom the outlines lie on one another.
        let distance = difference.distance.unwrap();
        assert!(distance > 0.3 && distance < 2.0, "{distance}");
    }

    #[test]
    fn the_same_outline_does_not_differ_and_neither_do_two_empty_ones() {
        let none = vec![false; WIDTH * HEIGHT];
        let a = rectangle(5, 5, 9, 9);
        for mask in [&a, &none] {
            let difference = SilhouetteDifference::of(mask, mask, WIDTH);
            assert_eq!(difference, SilhouetteDifference { share: 0.0, distance: Some(0.0) });
        }
        let difference = SilhouetteDifference::of(&a, &none, WIDTH);
        assert_eq!(difference, SilhouetteDifference { share: 1.0, distance: None });
    }

    #[test]
    fn the_edge_of_the_frame_is_no_outline() {
        let all = vec![true; WIDTH * HEIGHT];
        assert!(!outline(&all, WIDTH).contains(&true));
        let left_half = rectangle(0, 0, 20, HEIGHT);
        let count = outline(&left_half, WIDTH).iter().filter(|&&o| o).count();
        assert_eq!(count, HEIGHT);
    }

    proptest! {
        #[test]
        fn distances_are_those_of_brute_force(
            points in prop::collection::vec((0..12usize, 0..9usize), 1..6),
        ) {
            let mut set = vec![false; 12 * 9];
            points.iter().for_each(|&(x, y)| set[y * 12 + x] = true);
            for (index, found) in squared_distances(&set, 12).into_iter().enumerate() {
                let (x, y) = (index % 12, index / 12);
                let squared = |&(px, py): &(usize, usize)| {
                    (px.abs_diff(x).pow(2) + py.abs_diff(y).pow(2)) as f64
                };
                let expected = points.iter().map(squared).fold(f64::MAX, f64::min);
                prop_assert_eq!(found, expected);
            }
        }
    }
}
