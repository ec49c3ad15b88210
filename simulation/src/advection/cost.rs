//! Speed against error: which runs no other beats, and which to choose.

/// The points `(cost, error)` that no other point beats in both, as indices by ascending cost. Points
/// that are not finite are passed over; of equal points the first is kept.
///
/// ```
/// use courant_simulation::advection::pareto_front;
/// let points = [(1.0, 9.0), (2.0, 9.5), (3.0, 1.0), (4.0, f64::NAN), (2.0, 4.0)];
/// assert_eq!(pareto_front(&points), [0, 4, 2]);
/// ```
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
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

/// The cheapest choice for one error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recommendation {
    /// The error asked for.
    pub target: f64,
    /// Which point to choose; `None` when none is that good.
    pub choice: Option<usize>,
}

/// For each target the cheapest of the points `(cost, error)` whose error is at most that.
pub fn recommend(points: &[(f64, f64)], targets: &[f64]) -> Vec<Recommendation> {
    let front = pareto_front(points);
    let cheapest = |target: f64| front.iter().copied().find(|&index| points[index].1 <= target);
    targets.iter().map(|&target| Recommendation { target, choice: cheapest(target) }).collect()
}
