//! Which runs no other beats, and which to choose.

/// The points `(cost, error)` that no other point beats in both, as indices by ascending cost. Points
/// that are not finite are passed over; of equal points the first is kept.
pub(super) fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
    let finite = |&index: &usize| points[index].0.is_finite() && points[index].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    order.sort_by(|&a, &b| {
        let ((cost_a, error_a), (cost_b, error_b)) = (points[a], points[b]);
        cost_a.total_cmp(&cost_b).then(error_a.total_cmp(&error_b)).then(a.cmp(&b))
    });
    let mut best = f64::INFINITY;
    order.retain(|&index| {
        let better = points[index].1 < best;
        if better {
            best = points[index].1;
        }
        better
    });
    order
}

/// The cheapest of the points `(cost, error)` whose error is at most the target.
pub(super) fn cheapest(points: &[(f64, f64)], target: f64) -> Option<usize> {
    pareto_front(points).into_iter().find(|&index| points[index].1 <= target)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn points_that_are_no_numbers_are_passed_over() {
        let points = [(1.0, 9.0), (2.0, 9.5), (3.0, 1.0), (4.0, f64::NAN), (2.0, 4.0)];
        assert_eq!(pareto_front(&points), [0, 4, 2]);
    }

    proptest! {
        #[test]
        fn the_front_is_what_nothing_beats(points in prop::collection::vec((0u8..20, 0u8..20), 1..40)) {
            let points: Vec<(f64, f64)> =
                points.into_iter().map(|(a, b)| (f64::from(a), f64::from(b))).collect();
            let front = pareto_front(&points);
            for (index, &(cost, error)) in points.iter().enumerate() {
                let beaten = points.iter().enumerate().any(|(other, &(c, e))| {
                    c <= cost && e <= error && ((c, e) != (cost, error) || other < index)
                });
                prop_assert_eq!(front.contains(&index), !beaten);
            }
            for target in [0.0, 5.0, 19.0] {
                let found = cheapest(&points, target).map(|index| points[index].0);
                let least = points.iter().filter(|p| p.1 <= target).map(|p| p.0).reduce(f64::min);
                prop_assert_eq!(found, least);
            }
        }
    }
}
