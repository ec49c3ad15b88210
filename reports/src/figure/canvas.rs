//! Lines, areas and letters on the page, in units of a twentieth of a point, as plotters draws them.

use super::geometry::Point;
use super::{Color, Dash, FigureError, POINT, text};
use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon};
use plotters::style::{Color as _, ShapeStyle, TextStyle};
use plotters_backend::BackendCoord;

pub(super) type Done = Result<(), FigureError>;

/// The style of a line; the width in points.
pub(super) fn pen(color: Color, width: f64) -> ShapeStyle {
    // At least one unit: of width 0 is a line that cannot be seen.
    color.stroke_width((width * POINT).round().max(1.0) as u32)
}

/// The whole page.
pub(super) struct Canvas<'a>(pub(super) DrawingArea<SVGBackend<'a>, Shift>);

impl Canvas<'_> {
    /// A polyline.
    pub(super) fn stroke(&self, line: &[Point], style: ShapeStyle, dash: Dash) -> Done {
        let line = line.iter().map(units);
        Ok(match dash.lengths() {
            None => self.0.draw(&PathElement::new(line.collect::<Vec<_>>(), style)),
            Some(lengths) => {
                let width = f64::from(style.stroke_width).max(0.8 * POINT);
                let [on, off] = lengths.map(|length| (length * width) as i32);
                self.0.draw(&DashedPathElement::new(line, on, off, style))
            }
        }?)
    }

    /// A polygon's outline.
    pub(super) fn outline(&self, ring: &[Point], style: ShapeStyle) -> Done {
        // Past the first corner, which is joined so too.
        let closed: Vec<Point> = ring.iter().chain(ring.iter().take(2)).copied().collect();
        self.stroke(&closed, style, Dash::Solid)
    }

    /// The inside of rings.
    pub(super) fn fill(&self, rings: &[Vec<Point>], color: Color) -> Done {
        let Some(first) = rings.iter().find_map(|ring| ring.first()) else { return Ok(()) };
        let rings = rings.iter().filter(|ring| !ring.is_empty());
        // The way to a further ring and back encloses nothing.
        let points = rings.flat_map(|ring| ring.iter().chain([&ring[0], first]).map(units));
        Ok(self.0.draw(&Polygon::new(points.collect::<Vec<_>>(), color))?)
    }

    /// A circle, its inside or its outline.
    pub(super) fn circle(&self, centre: Point, radius: f64, style: ShapeStyle) -> Done {
        Ok(self.0.draw(&Circle::new(units(&centre), radius, style))?)
    }

    /// A text in a style of [`text`].
    pub(super) fn write(&self, text: &str, style: &TextStyle, at: Point) -> Done {
        Ok(self.0.draw_text(text, style, units(&at))?)
    }

    /// A black text of `size` points centred on a point, at an angle in radians; a white border around its letters sets
    /// it off from what is below.
    pub(super) fn letters(&self, text: &str, size: f64, at: Point, angle: f64) -> Done {
        let rings = text::rings(text, size * POINT, at, angle);
        rings.iter().try_for_each(|ring| self.outline(ring, pen(Color::WHITE, 0.28 * size)))?;
        self.fill(&rings, Color::BLACK)
    }
}

fn units(point: &Point) -> BackendCoord {
    (point[0].round() as i32, point[1].round() as i32)
}
