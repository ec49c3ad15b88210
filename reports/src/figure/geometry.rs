//! Plane geometry of drawing: clipping, simplifying, hatching, dashing.

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
        Rect {
            left: self.left - by,
            top: self.top - by,
            right: self.right + by,
            bottom: self.bottom + by,
        }
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
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The point a fraction `t` of the way from `a` to `b`.
pub(super) fn between(a: Point, b: Point, t: f64) -> Point {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

/// The part of the segment within the rectangle (Liang & Barsky 1984), as fractions of its length.
fn clip_segment(a: Point, b: Point, rect: &Rect) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    let d = [b[0] - a[0], b[1] - a[1]];
    for (p, q) in [
        (-d[0], a[0] - rect.left),
        (d[0], rect.right - a[0]),
        (-d[1], a[1] - rect.top),
        (d[1], rect.bottom - a[1]),
    ] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            from = from.max(q / p);
        } else {
            to = to.min(q / p);
        }
    }
    (from <= to).then_some((from, to))
}

/// The pieces of a polyline within the rectangle, broken where a coordinate is not finite.
pub(super) fn clip_polyline(points: &[Point], rect: &Rect) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut connected = false;
    for w in points.windows(2) {
        let finite = w.iter().flatten().all(|v| v.is_finite());
        let Some((from, to)) = finite.then(|| clip_segment(w[0], w[1], rect)).flatten() else {
            connected = false;
            continue;
        };
        if !(connected && from == 0.0) {
            pieces.push(vec![between(w[0], w[1], from)]);
        }
        let end = if to == 1.0 { w[1] } else { between(w[0], w[1], to) };
        pieces.last_mut().expect("a piece was begun").push(end);
        connected = to == 1.0;
    }
    pieces
}

/// The polygon within the rectangle (Sutherland & Hodgman 1974). Concave polygons may get edges along the border.
pub(super) fn clip_polygon(polygon: &[Point], rect: &Rect) -> Vec<Point> {
    let mut points = polygon.to_vec();
    for (axis, limit, sign) in
        [(0, rect.left, 1.0), (0, rect.right, -1.0), (1, rect.top, 1.0), (1, rect.bottom, -1.0)]
    {
        let inside = |p: Point| sign * (p[axis] - limit) >= 0.0;
        let mut kept = Vec::with_capacity(points.len() + 4);
        for (k, &p) in points.iter().enumerate() {
            let q = points[(k + 1) % points.len()];
            if inside(p) {
                kept.push(p);
            }
            if inside(p) != inside(q) {
                kept.push(between(p, q, (limit - p[axis]) / (q[axis] - p[axis])));
            }
        }
        points = kept;
    }
    points
}

/// The polyline with as few of its points as keep it within `tolerance` (Douglas & Peucker 1973). Closed rings, which
/// repeat their first point, are split at the point farthest from it.
pub(super) fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[points.len() - 1] = true;
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let farthest = (first + 1..last)
            .map(|k| (distance_to_segment(points[k], points[first], points[last]), k))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((d, k)) = farthest
            && d > tolerance
        {
            keep[k] = true;
            open.push((first, k));
            open.push((k, last));
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(p, _)| *p).collect()
}

/// The distance of a point from a segment.
pub(super) fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let length2 = d[0] * d[0] + d[1] * d[1];
    if length2 == 0.0 {
        return distance(p, a);
    }
    let t = (((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / length2).clamp(0.0, 1.0);
    distance(p, between(a, b, t))
}

/// Parallel strokes at 45 degrees over the inside (even–odd) of a polygon, `spacing` apart.
pub(super) fn hatch(polygon: &[Point], spacing: f64) -> Vec<Vec<Point>> {
    // In the turned coordinates u = x + y, v = x - y a stroke has constant u.
    let step = spacing * std::f64::consts::SQRT_2;
    let turned: Vec<Point> = polygon.iter().map(|p| [p[0] + p[1], p[0] - p[1]]).collect();
    let low = turned.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    let high = turned.iter().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
    let mut strokes = Vec::new();
    let mut k = (low / step).ceil();
    while k * step < high {
        let u = k * step;
        let mut crossings: Vec<f64> = (0..turned.len())
            .map(|i| (turned[i], turned[(i + 1) % turned.len()]))
            .filter(|(a, b)| (a[0] <= u) != (b[0] <= u))
            .map(|(a, b)| a[1] + (u - a[0]) / (b[0] - a[0]) * (b[1] - a[1]))
            .collect();
        crossings.sort_by(f64::total_cmp);
        let stroke = |pair: &[f64]| pair.iter().map(|v| [0.5 * (u + v), 0.5 * (u - v)]).collect();
        strokes.extend(crossings.chunks_exact(2).map(stroke));
        k += 1.0;
    }
    strokes
}

/// The on-pieces of a dashed polyline; `dash` lists on and off lengths in turn, starting with on; empty for a solid line.
pub(super) fn dashes(points: &[Point], dash: &[f64]) -> Vec<Vec<Point>> {
    if dash.is_empty() {
        return vec![points.to_vec()];
    }
    let mut pieces: Vec<Vec<Point>> = points.first().map(|&p| vec![p]).into_iter().collect();
    let (mut phase, mut left) = (0, dash[0]);
    for w in points.windows(2) {
        let length = distance(w[0], w[1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let at = between(w[0], w[1], done / length);
            match phase % 2 {
                0 => pieces.last_mut().expect("an on-piece is open").push(at),
                _ => pieces.push(vec![at]),
            }
            phase = (phase + 1) % (2 * dash.len());
            left = dash[phase % dash.len()];
        }
        left -= length - done;
        if phase % 2 == 0 {
            pieces.last_mut().expect("an on-piece is open").push(w[1]);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UNIT: Rect = Rect { left: 0.0, top: 0.0, right: 1.0, bottom: 1.0 };

    fn length(points: &[Point]) -> f64 {
        points.windows(2).map(|w| distance(w[0], w[1])).sum()
    }

    #[test]
    fn clipping_breaks_at_gaps_and_borders() {
        let nan = [f64::NAN, 0.5];
        let line = [[-1.0, 0.5], [0.5, 0.5], nan, [0.6, 0.5], [0.7, 0.5], [0.7, 2.0], [0.9, 2.0]];
        let pieces = clip_polyline(&line, &UNIT);
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[0], vec![[0.0, 0.5], [0.5, 0.5]]);
        assert_eq!(pieces[1].last(), Some(&[0.7, 1.0]));
    }

    #[test]
    fn hatch_strokes_cover_the_area() {
        // Stroke length times spacing tends to the area; the error is one spacing times the extent.
        let triangle = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];
        let total: f64 = hatch(&triangle, 0.001).iter().map(|s| length(s)).sum();
        assert!((total * 0.001 - 6.0).abs() < 5.0 * 0.001);
    }

    #[test]
    fn dashes_have_their_lengths() {
        let pieces = dashes(&[[0.0, 0.0], [1.0, 0.0], [1.0, 9.0]], &[2.0, 1.0]);
        let lengths: Vec<f64> = pieces.iter().map(|p| length(p)).collect();
        assert_eq!(lengths, vec![2.0, 2.0, 2.0, 1.0]);
    }

    proptest! {
        #[test]
        fn clipped_points_lie_inside_and_simple_lines_stay_close(
            points in prop::collection::vec(prop::array::uniform2(-2.0f64..3.0), 2..20),
            tolerance in 0.0f64..0.5,
        ) {
            for p in clip_polyline(&points, &UNIT).iter().flatten() {
                prop_assert!(UNIT.grown(1e-12).contains(*p));
            }
            let simple = simplify(&points, tolerance);
            for &p in &points {
                let d = simple.windows(2).map(|w| distance_to_segment(p, w[0], w[1])).fold(f64::INFINITY, f64::min);
                prop_assert!(d <= tolerance + 1e-12);
            }
        }
    }
}
