//! Where along an isoline its value is written.

use super::canvas::{Canvas, Done};
use super::geometry::{Point, Rect, between, distance, distance_to_segment};
use super::{POINT, text};
use crate::number::format_number;

const SIZE: f64 = 6.8;

/// Isolines that want their value written into them, and what labels must keep clear of: the border, other labels, and
/// the curves, markers and notes of the panel.
pub(super) struct IsolineLabels {
    rect: Rect,
    pub(super) wanted: Vec<(f64, Vec<Point>)>,
    /// Centres of labels and half their widths.
    labels: Vec<(Point, f64)>,
    curves: Vec<[Point; 2]>,
}

impl IsolineLabels {
    pub(super) fn new(rect: Rect) -> IsolineLabels {
        IsolineLabels { rect, wanted: Vec::new(), labels: Vec::new(), curves: Vec::new() }
    }

    /// Keeps labels off a curve.
    pub(super) fn keep_off(&mut self, curve: &[Point]) {
        self.curves.extend(curve.windows(2).map(|w| [w[0], w[1]]));
    }

    /// Writes the values for which there is room.
    pub(super) fn draw(mut self, canvas: &Canvas) -> Done {
        for (value, line) in std::mem::take(&mut self.wanted) {
            let value = format_number(value);
            if let Some((at, angle)) = self.place(&line, text::width(&value, SIZE)) {
                canvas.letters(&value, SIZE, at, angle)?;
            }
        }
        Ok(())
    }

    /// The middle and the angle (in radians, upright) of a text of this width on the straightest, most central stretch of
    /// the line that is clear of border, labels and curves; `None` if there is none. The place is then taken.
    fn place(&mut self, line: &[Point], width: f64) -> Option<(Point, f64)> {
        const TRIALS: usize = 41;
        let size = SIZE * POINT;
        let mut lengths = vec![0.0];
        for w in line.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + distance(w[0], w[1]));
        }
        let (total, gap) = (lengths[lengths.len() - 1], width + 0.6 * size);
        if total < 2.2 * gap {
            return None;
        }
        let at = |s: f64| {
            let k = lengths.partition_point(|&l| l <= s).clamp(1, line.len() - 1);
            between(line[k - 1], line[k], (s - lengths[k - 1]) / (lengths[k] - lengths[k - 1]))
        };
        let inner = self.rect.grown(-0.75 * size);
        let cost = |k: usize| {
            let t = (k as f64 + 0.5) / TRIALS as f64;
            let start = t * (total - gap);
            let (a, b) = (at(start), at(start + gap));
            let nodes = (1..8).map(|m| at(start + gap * f64::from(m) / 8.0));
            let bend = nodes.map(|p| distance_to_segment(p, a, b)).fold(0.0, f64::max);
            let clear = inner.contains(a) && inner.contains(b) && bend <= 0.3 * size;
            clear.then_some((bend / size + 0.25 * (t - 0.5).abs(), (start, a, b)))
        };
        // The best ones first: few are held against all curves.
        let mut trials: Vec<_> = (0..TRIALS).filter_map(cost).collect();
        trials.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut trials = trials.into_iter().map(|trial| trial.1);
        let (start, a, b) = trials.find(|&(_, a, b)| self.is_free(a, b, size))?;
        // Onto the middle of a bent stretch rather than its chord.
        let middle = between(between(a, b, 0.5), at(start + 0.5 * gap), 0.5);
        self.labels.push((middle, 0.5 * gap));
        let upright = if a[0] > b[0] || (a[0] == b[0] && a[1] < b[1]) { [b, a] } else { [a, b] };
        // A figure or two read better level.
        let level = width < 1.6 * size;
        let rise = (upright[0][1] - upright[1][1]).atan2(upright[1][0] - upright[0][0]);
        Some((middle, if level { 0.0 } else { rise }))
    }

    /// Whether a text from `a` to `b` is clear of other labels and of curves.
    fn is_free(&self, a: Point, b: Point, size: f64) -> bool {
        let (centre, half) = (between(a, b, 0.5), 0.5 * distance(a, b));
        let parts = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| between(a, b, t));
        let far = |c: &[Point; 2]| parts.iter().all(|&p| distance_to_segment(p, c[0], c[1]) > size);
        self.labels.iter().all(|l| distance(l.0, centre) > 1.15 * (l.1 + half))
            && self.curves.iter().all(far)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_read_upright_and_keep_off_each_other_and_off_curves() {
        let rect = Rect { left: 0.0, top: 0.0, right: 4000.0, bottom: 2000.0 };
        let empty = || IsolineLabels::new(rect);
        // Drawn right to left and downwards to the left on the page.
        let line = [[3000.0, 200.0], [1000.0, 1800.0]];
        let mut labels = empty();
        let (first, angle) = labels.place(&line, 400.0).unwrap();
        assert!((angle - 0.8f64.atan()).abs() < 1e-9);
        let (second, _) = labels.place(&line, 400.0).unwrap();
        assert!(distance(first, second) > 480.0);
        assert_eq!(empty().place(&line, 100.0).unwrap().1, 0.0);
        labels.keep_off(&[[2000.0, 0.0], [2000.0, 2000.0]]);
        let (middle, _) = labels.place(&[[0.0, 300.0], [4000.0, 300.0]], 400.0).unwrap();
        assert!((middle[0] - 2000.0).abs() > 200.0);
        assert!(empty().place(&[[400.0, 1000.0], [1200.0, 1000.0]], 400.0).is_none());
    }
}
