//! From data coordinates to the page.

use super::geometry::{Point, Rect, clip, simplify};
use super::{Axis, POINT};

/// Points of curves closer than this to their neighbours' chord are left out: 0.01 point.
const TOLERANCE: f64 = 0.01 * POINT;

/// Where data lie on the page.
pub(super) struct Frame<'a> {
    pub(super) rect: Rect,
    pub(super) x: &'a Axis,
    pub(super) y: &'a Axis,
}

impl Frame<'_> {
    pub(super) fn at(&self, [x, y]: Point) -> Point {
        let (across, up) = (self.x.fraction(x), self.y.fraction(y));
        [self.rect.left + across * self.rect.width(), self.rect.bottom - up * self.rect.height()]
    }

    /// A curve within the panel; a single point without one of its coordinates is a line across.
    pub(super) fn curve(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let Rect { left, top, right, bottom } = self.rect;
        let mut on_page: Vec<Point> = points.iter().map(|&p| self.at(p)).collect();
        match on_page[..] {
            [[x, y]] if y.is_nan() => on_page = vec![[x, bottom], [x, top]],
            [[x, y]] if x.is_nan() => on_page = vec![[left, y], [right, y]],
            _ => {}
        }
        clip(&on_page, &self.rect).iter().map(|line| simplify(line, TOLERANCE)).collect()
    }

    /// A part of a contour: what a cell has beyond the panel is drawn onto its edge.
    pub(super) fn contour(&self, points: &[Point]) -> Vec<Point> {
        let Rect { left, top, right, bottom } = self.rect;
        let places = points.iter().map(|&p| self.at(p));
        let inside = places.map(|[x, y]| [x.clamp(left, right), y.clamp(top, bottom)]);
        simplify(&inside.collect::<Vec<_>>(), TOLERANCE)
    }
}
