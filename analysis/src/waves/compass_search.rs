//! The maximum of a function of a few variables, by ever smaller steps to the neighbours of the best point: compass search
//! (Kolda, Lewis & Torczon 2003, "Optimization by direct search").

/// Rounds about all neighbours at most: roundings can be climbed for ever.
const MOST_ROUNDS: usize = 200;

/// How a search goes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CompassSearch {
    /// The first step.
    pub(crate) first: f64,
    /// Where steps end; a smooth maximum is then wrong by the square of it.
    pub(crate) last: f64,
    /// Bounds on every coordinate.
    pub(crate) within: (f64, f64),
}

impl CompassSearch {
    /// Over all real coordinates.
    pub(crate) fn free(first: f64, last: f64) -> Self {
        Self { first, last, within: (f64::NEG_INFINITY, f64::INFINITY) }
    }

    /// The best value met and its place.
    pub(crate) fn maximum(
        &self,
        mut value: impl FnMut(&[f64]) -> f64,
        start: Vec<f64>,
    ) -> (f64, Vec<f64>) {
        let (mut best, mut place, mut step) = (value(&start), start, self.first);
        // Neighbours along axes and diagonals, by a digit of three for each axis.
        let neighbours = 3usize.pow(place.len() as u32);
        let sign =
            |number: usize, axis: usize| [0.0, 1.0, -1.0][number / 3usize.pow(axis as u32) % 3];
        for _ in 0..MOST_ROUNDS {
            if step <= self.last {
                break;
            }
            let mut moved = false;
            for number in 1..neighbours {
                let to = |(axis, x): (usize, &f64)| {
                    (x + sign(number, axis) * step).clamp(self.within.0, self.within.1)
                };
                let tried: Vec<f64> = place.iter().enumerate().map(to).collect();
                let found = value(&tried);
                if found > best {
                    (best, place, moved) = (found, tried, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        (best, place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_maxima_are_found() {
        // A long ridge across the axes, with its top at (0.3, -0.2).
        let ridge = |x: &[f64]| {
            let (u, v) = (x[0] - 0.3 + x[1] + 0.2, x[0] - 0.3 - x[1] - 0.2);
            1.0 - u * u - 100.0 * v * v
        };
        let (value, place) = CompassSearch::free(0.5, 1e-8).maximum(ridge, vec![0.0, 0.0]);
        // Wrong by the square of the last step, times the curvature.
        assert!((value - 1.0).abs() < 1e-12, "{value}");
        assert!((place[0] - 0.3).abs() < 1e-6 && (place[1] + 0.2).abs() < 1e-6, "{place:?}");
    }

    #[test]
    fn bounds_hold_and_noise_ends() {
        let search = CompassSearch { first: 0.25, last: 1e-6, within: (0.0, 1.0) };
        assert_eq!(
            search.maximum(|x| x[0] + x[1] - x[2], vec![0.5; 3]),
            (2.0, vec![1.0, 1.0, 0.0])
        );
        // Every call is higher than the last: the rounds are counted.
        let mut calls = 0;
        let climbing = |_: &[f64]| {
            calls += 1;
            f64::from(calls)
        };
        let (value, _) = CompassSearch::free(1.0, 1e-9).maximum(climbing, vec![0.0]);
        assert_eq!(value, 1.0 + 2.0 * MOST_ROUNDS as f64);
    }
}
