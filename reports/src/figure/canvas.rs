//! Lines, areas and letters on the page, in units of a twentieth of a point, as plotters draws them.

use super::geometry::Point;
use super::{Color, Dash, FigureError, POINT, text};
use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{
    DashedPathElement, DynElement, IntoDynElement, PathElement, PointCollection, Polygon,
};
use plotters::style::{Color as _, ShapeStyle, TextStyle};
use plotters_backend::BackendCoord;

pub(super) type Done = Result<(), FigureError>;

/// The style of a line; the width in points.
pub(super) fn pen(color: Color, width: f64) -> ShapeStyle {
    // At least one unit: of width 0 is a line that cannot be seen.
    color.stroke_width((width * POINT).round().max(1.0) as u32)
}

/// What plotters draws.
pub(super) type Element<'a> = DynElement<'a, SVGBackend<'a>, BackendCoord>;

/// A polyline.
pub(super) fn stroke<'a>(line: &[Point], style: ShapeStyle, dash: Dash) -> Element<'a> {
    let line: Vec<BackendCoord> = line.iter().map(units).collect();
    match dash.lengths() {
        None => PathElement::new(line, style).into_dyn(),
        Some(lengths) => {
            let width = f64::from(style.stroke_width).max(0.8 * POINT);
            let [on, off] = lengths.map(|length| (length * width) as i32);
            DashedPathElement::new(line, on, off, style).into_dyn()
        }
    }
}

/// A polygon's outline.
pub(super) fn outline<'a>(ring: &[Point], style: ShapeStyle) -> Element<'a> {
    // Past the first corner, which is joined so too.
    let closed: Vec<Point> = ring.iter().chain(ring.iter().take(2)).copied().collect();
    stroke(&closed, style, Dash::Solid)
}

/// The inside of rings.
pub(super) fn fill<'a>(rings: &[Vec<Point>], color: Color) -> Element<'a> {
    let first = rings.iter().find_map(|ring| ring.first());
    let rings = rings.iter().filter(|ring| !ring.is_empty());
    // The way to a further ring and back encloses nothing.
    let points = rings.flat_map(|ring| ring.iter().chain([&ring[0]]).chain(first).map(units));
    Polygon::new(points.collect::<Vec<_>>(), color).into_dyn()
}

/// The whole page.
pub(super) struct Canvas<'a>(pub(super) DrawingArea<SVGBackend<'a>, Shift>);

impl<'a> Canvas<'a> {
    /// Draws one after the other.
    pub(super) fn draw(&self, elements: impl IntoIterator<Item = Element<'a>>) -> Done {
        let is_something = |element: &Element| !element.point_iter().is_empty();
        let mut elements = elements.into_iter().filter(is_something);
        Ok(elements.try_for_each(|element| self.0.draw(&element))?)
    }

    /// A text in a style of [`text`].
    pub(super) fn write(&self, text: &str, style: &TextStyle, at: Point) -> Done {
        Ok(self.0.draw_text(text, style, units(&at))?)
    }

    /// A black text of `size` points centred on a point, at an angle in radians; a white border around its letters sets
    /// it off from what is below.
    pub(super) fn letters(&self, text: &str, size: f64, at: Point, angle: f64) -> Done {
        let rings = text::rings(text, size * POINT, at, angle);
        let border = rings.iter().map(|ring| outline(ring, pen(Color::WHITE, 0.28 * size)));
        self.draw(border.chain([fill(&rings, Color::BLACK)]))
    }
}

pub(super) fn units(point: &Point) -> BackendCoord {
    (point[0].round() as i32, point[1].round() as i32)
}
