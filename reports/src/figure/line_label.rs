//! Where along an isoline its value is written.

use super::{
    geometry::{Point, Rect, between, clip_polyline, distance, distance_to_segment},
    layer::Layer,
    paint::Frame,
};

/// What labels must keep clear of: the border, other labels, and the curves and markers of the panel.
#[derive(Debug)]
pub(super) struct Obstacles {
    rect: Rect,
    /// Centres of labels and half their widths.
    labels: Vec<(Point, f64)>,
    curves: Vec<[Point; 2]>,
}

/// A place for a label, and the line without the stretch it covers.
#[derive(Debug)]
pub(super) struct Place {
    pub(super) middle: Point,
    /// Counterclockwise, in radians, within a right angle.
    pub(super) angle: f64,
    pub(super) rest: Vec<Vec<Point>>,
}

impl Obstacles {
    /// The curves and markers among the layers.
    pub(super) fn new(frame: &Frame, layers: &[Layer]) -> Obstacles {
        let mut curves = Vec::new();
        let mut add = |points: &[Point]| {
            for piece in clip_polyline(points, &frame.rect) {
                curves.extend(piece.windows(2).map(|w| [w[0], w[1]]));
            }
        };
        for layer in layers {
            match layer {
                Layer::Line(line) => {
                    add(&line.points.iter().map(|&p| frame.at(p)).collect::<Vec<_>>());
                }
                Layer::Isolines(lines) if !lines.labelled => {
                    let all = frame.isolines(&lines.field, &lines.levels);
                    all.iter().flat_map(|(_, lines)| lines).for_each(|line| add(line));
                }
                Layer::Markers(markers) => {
                    markers.points.iter().for_each(|&p| add(&[frame.at(p); 2]));
                }
                Layer::Note(note) => add(&[frame.at(note.at); 2]),
                _ => {}
            }
        }
        Obstacles { rect: frame.rect, labels: Vec::new(), curves }
    }

    /// The straightest, most central stretch of the line that is as long as the text and clear of border, labels and
    /// curves; `None` if the line is too short or nowhere clear. The place is then taken.
    pub(super) fn place(&mut self, line: &[Point], width: f64, size: f64) -> Option<Place> {
        const TRIALS: usize = 41;
        let mut lengths = vec![0.0];
        for w in line.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + distance(w[0], w[1]));
        }
        let total = *lengths.last()?;
        let gap = width + MARGIN * size;
        if total < 2.2 * gap {
            return None;
        }
        let inner = self.rect.grown(-0.75 * size);
        let cost = |k: usize| {
            let t = (k as f64 + 0.5) / TRIALS as f64;
            let start = t * (total - gap);
            let (a, b) = (at(line, &lengths, start), at(line, &lengths, start + gap));
            let centre = between(a, b, 0.5);
            let apart = |l: &(Point, f64)| distance(l.0, centre) > 1.15 * (l.1 + 0.5 * gap);
            let bend = (0..=8)
                .map(|m| at(line, &lengths, start + gap * f64::from(m) / 8.0))
                .map(|p| distance_to_segment(p, a, b))
                .fold(0.0, f64::max);
            let clear = inner.contains(a)
                && inner.contains(b)
                && self.labels.iter().all(apart)
                && distance(a, b) >= 0.85 * gap
                && bend <= 0.3 * size;
            clear.then_some((bend / size + 0.25 * (t - 0.5).abs(), [a, b], start))
        };
        // The cheapest first: few are held against all curves.
        let mut trials: Vec<_> = (0..TRIALS).filter_map(cost).collect();
        trials.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (.., start) =
            trials.into_iter().find(|(_, [a, b], _)| self.nearest_curve(*a, *b) > size)?;
        let (mut a, mut b) = (at(line, &lengths, start), at(line, &lengths, start + gap));
        let rest = vec![cut(line, &lengths, 0.0, start), cut(line, &lengths, start + gap, total)];
        if a[0] > b[0] || (a[0] == b[0] && a[1] < b[1]) {
            std::mem::swap(&mut a, &mut b); // upright
        }
        // Onto the middle of a bent stretch rather than its chord.
        let middle = between(between(a, b, 0.5), at(line, &lengths, start + 0.5 * gap), 0.5);
        self.labels.push((middle, 0.5 * gap));
        // A figure or two read better level, and a minus sign is not taken for the line.
        let level = width < 1.6 * size;
        let angle = if level { 0.0 } else { (a[1] - b[1]).atan2(b[0] - a[0]) };
        Some(Place { middle, angle, rest })
    }

    /// The distance from the text between `a` and `b` to the nearest curve.
    fn nearest_curve(&self, a: Point, b: Point) -> f64 {
        let parts = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| between(a, b, t));
        let to_text = |c: &[Point; 2]| {
            parts.iter().map(|&p| distance_to_segment(p, c[0], c[1])).fold(f64::INFINITY, f64::min)
        };
        self.curves.iter().map(to_text).fold(f64::INFINITY, f64::min)
    }
}

/// Room between line and text, both sides together, as a fraction of the size: wide enough that a minus sign at the
/// beginning of the text does not look like a piece of the line.
const MARGIN: f64 = 1.0;

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

#[cfg(test)]
mod tests {
    use super::*;

    fn empty() -> Obstacles {
        let rect = Rect { left: 0.0, top: 0.0, right: 200.0, bottom: 100.0 };
        Obstacles { rect, labels: Vec::new(), curves: Vec::new() }
    }

    #[test]
    fn labels_read_upright_and_interrupt_the_line_by_their_length() {
        // Drawn right to left and downwards to the left on the page.
        let line = [[150.0, 10.0], [50.0, 90.0]];
        let mut obstacles = empty();
        let first = obstacles.place(&line, 20.0, 7.0).unwrap();
        assert!((first.angle - 0.8f64.atan()).abs() < 1e-9);
        let length = |r: &Vec<Point>| r.windows(2).map(|w| distance(w[0], w[1])).sum::<f64>();
        let drawn: f64 = first.rest.iter().map(length).sum();
        assert!((distance(line[0], line[1]) - drawn - (20.0 + MARGIN * 7.0)).abs() < 1e-9);
        let second = obstacles.place(&line, 20.0, 7.0).unwrap();
        assert!(distance(first.middle, second.middle) > 27.0);
        assert_eq!(empty().place(&line, 5.0, 7.0).unwrap().angle, 0.0);
    }

    #[test]
    fn labels_keep_off_curves_and_short_lines() {
        let mut obstacles = empty();
        obstacles.curves.push([[100.0, 0.0], [100.0, 100.0]]);
        let place = obstacles.place(&[[0.0, 50.0], [200.0, 50.0]], 20.0, 7.0).unwrap();
        assert!((place.middle[0] - 100.0).abs() > 10.0, "{place:?}");
        assert!(empty().place(&[[20.0, 50.0]], 20.0, 7.0).is_none());
        assert!(empty().place(&[[20.0, 50.0], [60.0, 50.0]], 20.0, 7.0).is_none());
    }
}
