//! Plane geometry of drawing: clipping and simplifying.

/// A point `[x, y]`.
pub type Point = [f64; 2];

/// An axis-parallel rectangle; on the page y runs downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Rect {
    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// The rectangle with all sides moved outwards.
    pub(super) fn grown(&self, by: f64) -> Rect {
        let Rect { left, top, right, bottom } = *self;
        Rect { left: left - by, top: top - by, right: right + by, bottom: bottom + by }
    }

    pub(super) fn contains(&self, p: Point) -> bool {
        p[0] >= self.left && p[0] <= self.right && p[1] >= self.top && p[1] <= self.bottom
    }

    pub(super) fn corners(&self) -> Vec<Point> {
        let Rect { left, top, right, bottom } = *self;
        vec![[left, top], [right, top], [right, bottom], [left, bottom]]
    }
}

/// The distance of two points.
pub(super) fn distance(a: Point, b: Point) -> f64 {
    // The page is small: squares neither overflow nor vanish.
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
}

/// The point a fraction `t` of the way from `a` to `b`.
pub(super) fn between(a: Point, b: Point, t: f64) -> Point {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

/// The distance of a point from a segment.
pub(super) fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let along = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    distance(p, between(a, b, if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) }))
}

/// The pieces of a polyline within the rectangle, broken where a coordinate is not finite: cut by one side after the
/// other.
pub(super) fn clip(points: &[Point], rect: &Rect) -> Vec<Vec<Point>> {
    let finite = points.split(|p| p.iter().any(|v| !v.is_finite()));
    let mut pieces: Vec<Vec<Point>> = finite.map(<[Point]>::to_vec).collect();
    for (axis, limit, sign) in
        [(0, rect.left, 1.0), (0, rect.right, -1.0), (1, rect.top, 1.0), (1, rect.bottom, -1.0)]
    {
        let inside = |p: &Point| sign * (p[axis] - limit) >= 0.0;
        let mut kept = Vec::new();
        for piece in pieces {
            let mut run: Vec<Point> = piece.first().copied().filter(inside).into_iter().collect();
            for w in piece.windows(2) {
                if inside(&w[0]) != inside(&w[1]) {
                    run.push(between(w[0], w[1], (limit - w[0][axis]) / (w[1][axis] - w[0][axis])));
                }
                match inside(&w[1]) {
                    true => run.push(w[1]),
                    false => kept.push(std::mem::take(&mut run)),
                }
            }
            kept.push(run);
        }
        kept.retain(|run| run.len() > 1);
        pieces = kept;
    }
    pieces
}

/// The polyline with as few of its points as keep it within `tolerance` (Douglas & Peucker 1973).
pub(super) fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    let mut keep = vec![false; points.len()];
    let mut open = vec![(0, points.len().saturating_sub(1))];
    while let Some((first, last)) = open.pop() {
        keep.iter_mut().skip(first).step_by((last - first).max(1)).take(2).for_each(|k| *k = true);
        let away = |k: usize| distance_to_segment(points[k], points[first], points[last]);
        let farthest = (first + 1..last).map(|k| (away(k), k)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, k)) = farthest.filter(|far| far.0 > tolerance) {
            open.extend([(first, k), (k, last)]);
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(p, _)| *p).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UNIT: Rect = Rect { left: 0.0, top: 0.0, right: 1.0, bottom: 1.0 };

    #[test]
    fn clipping_breaks_at_gaps_and_borders() {
        let nan = [f64::NAN, 0.5];
        let line = [[-1.0, 0.5], [0.5, 0.5], nan, [0.6, 0.5], [0.7, 0.5], [0.7, 2.0], [0.9, 2.0]];
        let pieces = [vec![[0.0, 0.5], [0.5, 0.5]], vec![[0.6, 0.5], [0.7, 0.5], [0.7, 1.0]]];
        assert_eq!(clip(&line, &UNIT), pieces);
    }

    proptest! {
        #[test]
        fn clipped_points_lie_inside_and_simple_lines_stay_close(
            points in prop::collection::vec(prop::array::uniform2(-2.0f64..3.0), 2..20),
            tolerance in 0.0f64..0.5,
        ) {
            for p in clip(&points, &UNIT).iter().flatten() {
                prop_assert!(UNIT.grown(1e-12).contains(*p));
            }
            let simple = simplify(&points, tolerance);
            for &p in &points {
                let near = |w: &[Point]| distance_to_segment(p, w[0], w[1]) <= tolerance + 1e-12;
                prop_assert!(simple.windows(2).any(near));
            }
        }
    }
}
