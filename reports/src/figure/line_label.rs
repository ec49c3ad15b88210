//! Where along an isoline its value is written.

use super::{
    font,
    geometry::{Point, Rect, between, distance},
};

/// A label already on the page: its centre and half its width.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    centre: Point,
    reach: f64,
}

/// A place for a label, and the line without the stretch it covers.
#[derive(Debug)]
pub(super) struct Place {
    pub(super) label: Placed,
    /// Middle of the baseline.
    pub(super) baseline: Point,
    /// Counterclockwise, in degrees, within ±90.
    pub(super) angle: f64,
    pub(super) rest: Vec<Vec<Point>>,
}

/// The straightest, most central stretch of the line that is as long as the text and clear of the border and of other
/// labels; `None` if the line is too short or nowhere clear.
pub(super) fn place(
    line: &[Point],
    width: f64,
    size: f64,
    rect: &Rect,
    others: &[Placed],
) -> Option<Place> {
    const TRIALS: usize = 41;
    let mut lengths = vec![0.0];
    for w in line.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + distance(w[0], w[1]));
    }
    let total = *lengths.last()?;
    let gap = width + 0.7 * size;
    if total < 2.2 * gap {
        return None;
    }
    let inner = rect.grown(-0.75 * size);
    let mut best: Option<(f64, f64)> = None;
    for k in 0..TRIALS {
        let t = (k as f64 + 0.5) / TRIALS as f64;
        let start = t * (total - gap);
        let (a, b) = (at(line, &lengths, start), at(line, &lengths, start + gap));
        let centre = between(a, b, 0.5);
        let chord = distance(a, b);
        let clear = inner.contains(a)
            && inner.contains(b)
            && others.iter().all(|o| distance(o.centre, centre) > 1.15 * (o.reach + 0.5 * gap));
        let bend = (0..=8)
            .map(|m| distance_to_line(at(line, &lengths, start + gap * f64::from(m) / 8.0), a, b))
            .fold(0.0, f64::max);
        if !clear || chord < 0.85 * gap || bend > 0.3 * size {
            continue;
        }
        let cost = bend / size + 0.25 * (t - 0.5).abs();
        if best.is_none_or(|(c, _)| cost < c) {
            best = Some((cost, start));
        }
    }
    let (_, start) = best?;
    let (mut a, mut b) = (at(line, &lengths, start), at(line, &lengths, start + gap));
    let rest = vec![cut(line, &lengths, 0.0, start), cut(line, &lengths, start + gap, total)];
    if a[0] > b[0] || (a[0] == b[0] && a[1] < b[1]) {
        std::mem::swap(&mut a, &mut b); // upright
    }
    // Onto the middle of a bent stretch rather than its chord.
    let middle = between(between(a, b, 0.5), at(line, &lengths, start + 0.5 * gap), 0.5);
    let angle = (a[1] - b[1]).atan2(b[0] - a[0]);
    let drop = 0.5 * font::CAP_HEIGHT * size;
    Some(Place {
        label: Placed { centre: middle, reach: 0.5 * gap },
        baseline: [middle[0] + drop * angle.sin(), middle[1] + drop * angle.cos()],
        angle: angle.to_degrees(),
        rest,
    })
}

fn at(line: &[Point], lengths: &[f64], s: f64) -> Point {
    let k = lengths.partition_point(|&l| l <= s).clamp(1, line.len() - 1);
    let span = lengths[k] - lengths[k - 1];
    let t = if span > 0.0 { ((s - lengths[k - 1]) / span).clamp(0.0, 1.0) } else { 0.0 };
    between(line[k - 1], line[k], t)
}

fn cut(line: &[Point], lengths: &[f64], from: f64, to: f64) -> Vec<Point> {
    let mut piece = vec![at(line, lengths, from)];
    piece.extend(line.iter().zip(lengths).filter(|(_, l)| **l > from && **l < to).map(|(p, _)| *p));
    piece.push(at(line, lengths, to));
    piece
}

fn distance_to_line(p: Point, a: Point, b: Point) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let length = d[0].hypot(d[1]).max(f64::MIN_POSITIVE);
    ((p[0] - a[0]) * d[1] - (p[1] - a[1]) * d[0]).abs() / length
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: Rect = Rect { left: 0.0, top: 0.0, right: 200.0, bottom: 100.0 };

    #[test]
    fn label_interrupts_the_line_by_its_own_length() {
        let line: Vec<Point> = (0..=100).map(|i| [2.0 * f64::from(i), 50.0]).collect();
        let place = place(&line, 20.0, 7.0, &PAGE, &[]).unwrap();
        let drawn: f64 =
            place.rest.iter().flat_map(|r| r.windows(2)).map(|w| distance(w[0], w[1])).sum();
        assert!((200.0 - drawn - (20.0 + 0.7 * 7.0)).abs() < 1e-9);
        assert!(place.angle.abs() < 1e-9 && (place.baseline[0] - 100.0).abs() < 1.0);
    }

    #[test]
    fn labels_read_upright_and_keep_apart() {
        // Drawn right to left and downwards to the left on the page.
        let line = [[150.0, 10.0], [50.0, 90.0]];
        let first = place(&line, 20.0, 7.0, &PAGE, &[]).unwrap();
        assert!((first.angle - 0.8f64.atan().to_degrees()).abs() < 1e-9);
        let second = place(&line, 20.0, 7.0, &PAGE, &[first.label]).unwrap();
        assert!(distance(first.label.centre, second.label.centre) > 20.0);
        assert!(place(&line[..1], 20.0, 7.0, &PAGE, &[]).is_none());
        assert!(place(&[[0.0, 0.0], [30.0, 0.0]], 20.0, 7.0, &PAGE, &[]).is_none());
    }
}
