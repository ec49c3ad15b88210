//! Outlines of strokes and circles as polygons, for the bitmap.

use super::geometry::{Point, distance};
use std::f64::consts::{PI, TAU};

/// Rings of one orientation that together cover a stroke of the given width, with round joins and butt ends.
pub(super) fn stroke_rings(line: &[Point], closed: bool, width: f64) -> Vec<Vec<Point>> {
    let half = 0.5 * width;
    let mut points = line.to_vec();
    points.dedup();
    if closed && points.len() > 1 && points.first() != points.last() {
        points.push(points[0]);
    }
    let normals: Vec<Point> = points
        .windows(2)
        .map(|w| {
            let scale = half / distance(w[0], w[1]);
            [-(w[1][1] - w[0][1]) * scale, (w[1][0] - w[0][0]) * scale]
        })
        .collect();
    let mut rings = Vec::with_capacity(2 * normals.len());
    for (w, n) in points.windows(2).zip(&normals) {
        rings.push(vec![
            add(w[0], n, 1.0),
            add(w[0], n, -1.0),
            add(w[1], n, -1.0),
            add(w[1], n, 1.0),
        ]);
    }
    for k in 1..normals.len() {
        rings.extend(join(points[k], normals[k - 1], normals[k]));
    }
    if closed && normals.len() > 1 {
        rings.extend(join(points[0], normals[normals.len() - 1], normals[0]));
    }
    rings
}

fn add(p: Point, n: &Point, sign: f64) -> Point {
    [p[0] + sign * n[0], p[1] + sign * n[1]]
}

/// The wedge on the outer side of a bend.
fn join(at: Point, before: Point, after: Point) -> Option<Vec<Point>> {
    let turn = (before[0] * after[1] - before[1] * after[0])
        .atan2(before[0] * after[0] + before[1] * after[1]);
    if turn == 0.0 {
        return None;
    }
    // The outer side is the one the line turns away from; the order keeps the orientation of the segments.
    let side = -turn.signum();
    let (from, sweep) = if side > 0.0 { (after, -turn) } else { (before, turn) };
    let steps = (sweep.abs() / 0.3).ceil().max(1.0);
    let mut ring = vec![at];
    let mut k = 0.0;
    while k <= steps {
        let (sin, cos) = (sweep.abs() * k / steps).sin_cos();
        let n = [from[0] * cos - from[1] * sin, from[0] * sin + from[1] * cos];
        ring.push(add(at, &n, side));
        k += 1.0;
    }
    Some(ring)
}

/// A circle as a polygon, within a tenth of a unit of length for radii of page size.
pub(super) fn circle_ring(centre: Point, radius: f64) -> Vec<Point> {
    // The sagitta r (1 - cos(pi/n)) stays below 0.02.
    let n = (PI * (radius / 0.04).sqrt()).ceil().clamp(12.0, 400.0);
    (0..n as usize)
        .map(|k| {
            let (sin, cos) = (TAU * k as f64 / n).sin_cos();
            [centre[0] + radius * cos, centre[1] + radius * sin]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn area(ring: &[Point]) -> f64 {
        (0..ring.len())
            .map(|k| (ring[k], ring[(k + 1) % ring.len()]))
            .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
            .sum()
    }

    proptest! {
        #[test]
        fn all_rings_turn_the_same_way(
            line in prop::collection::vec(prop::array::uniform2(0.0f64..100.0), 2..12),
            closed: bool,
        ) {
            // Otherwise overlaps of one stroke would cancel under the winding rule.
            for ring in stroke_rings(&line, closed, 3.0) {
                prop_assert!(area(&ring) > -1e-9, "{ring:?}");
            }
        }
    }

    #[test]
    fn areas_are_those_of_stroke_and_disc() {
        let straight = stroke_rings(&[[0.0, 0.0], [3.0, 4.0]], false, 2.0);
        assert!((straight.iter().map(|r| area(r)).sum::<f64>() - 10.0).abs() < 1e-12);
        // Inscribed with a sagitta below 0.02: at most 0.02 times the circumference is missing.
        let missing = PI * 400.0 - area(&circle_ring([5.0, 5.0], 20.0));
        assert!(missing > 0.0 && missing < 0.02 * TAU * 20.0);
    }
}
