//! Shapes that plotters draws as one element.

use super::{
    color::Color,
    geometry::{Point, dashes},
    layer::{Anchor, Dash},
    text::{self, POINT},
};
use plotters::element::{Drawable, PointCollection};
use plotters::style::{Color as _, ShapeStyle};
use plotters_backend::{BackendCoord, DrawingBackend, DrawingErrorKind};

/// How a line is drawn; the width in points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pen {
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
}

impl Pen {
    pub(super) fn solid(color: Color, width: f64) -> Pen {
        Pen { color, width, dash: Dash::Solid }
    }

    pub(super) fn style(self) -> ShapeStyle {
        // At least one unit: of width 0 is a line that cannot be seen.
        self.color.plotters().stroke_width((self.width * POINT).round().max(1.0) as u32)
    }
}

#[derive(Debug, Clone)]
pub(super) enum Shape {
    /// A polyline.
    Stroke(Vec<BackendCoord>, ShapeStyle),
    /// The inside of a polygon (of winding number not zero).
    Fill(Vec<BackendCoord>, ShapeStyle),
    /// A disc or its border.
    Circle(BackendCoord, u32, ShapeStyle),
}

/// Shapes in units of the canvas, relative to a place.
#[derive(Debug, Clone, Default)]
pub(super) struct Picture {
    at: BackendCoord,
    pub(super) shapes: Vec<Shape>,
}

fn unit(p: Point) -> BackendCoord {
    (p[0].round() as i32, p[1].round() as i32)
}

impl Picture {
    /// The same picture at another place.
    pub(super) fn moved(&self, at: BackendCoord) -> Picture {
        Picture { at, shapes: self.shapes.clone() }
    }

    /// Adds a polyline.
    pub(super) fn stroke(&mut self, line: &[Point], pen: Pen) {
        let lengths = pen.dash.pattern().iter().map(|l| l * pen.width.max(0.8) * POINT);
        for piece in dashes(line, &lengths.collect::<Vec<_>>()) {
            self.shapes.push(Shape::Stroke(piece.into_iter().map(unit).collect(), pen.style()));
        }
    }

    /// Adds a polygon's outline.
    pub(super) fn outline(&mut self, ring: &[Point], pen: Pen) {
        // Past the first corner, which is joined so too.
        let closed: Vec<Point> = ring.iter().chain(ring.iter().take(2)).copied().collect();
        self.stroke(&closed, pen);
    }

    /// Adds the inside of rings; the way to a further ring and back encloses nothing.
    pub(super) fn fill(&mut self, rings: &[Vec<Point>], color: Color, opacity: f64) {
        let mut points = Vec::new();
        for ring in rings.iter().filter(|ring| !ring.is_empty()) {
            points.extend(ring.iter().map(|&p| unit(p)));
            points.push(unit(ring[0]));
            points.push(points[0]);
        }
        if !points.is_empty() {
            let style = color.plotters().mix(opacity).filled();
            self.shapes.push(Shape::Fill(points, style));
        }
    }

    /// Adds a circle; radius in units.
    pub(super) fn circle(&mut self, centre: Point, radius: f64, fill: Option<Color>, pen: Pen) {
        let (at, radius) = (unit(centre), radius.round() as u32);
        if let Some(color) = fill {
            self.shapes.push(Shape::Circle(at, radius, color.plotters().filled()));
        }
        if pen.width > 0.0 {
            self.shapes.push(Shape::Circle(at, radius, pen.style()));
        }
    }

    /// Adds a text as outlines, centred in height on a point, at an angle in radians; with a white border around the
    /// letters that sets them off from what is below.
    pub(super) fn text(
        &mut self,
        text: &str,
        at: Point,
        size: f64,
        (anchor, angle, color): (Anchor, f64, Color),
        border: f64,
    ) {
        let em = size * POINT;
        let back = text::width(text, em)
            * match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
        let (sin, cos) = angle.sin_cos();
        let down = 0.5 * text::CAP_HEIGHT * em;
        let origin = [at[0] - back * cos + down * sin, at[1] + back * sin + down * cos];
        let rings = text::rings(text, origin, em, angle);
        if border > 0.0 {
            rings.iter().for_each(|ring| self.outline(ring, Pen::solid(Color::WHITE, border)));
        }
        self.fill(&rings, color, 1.0);
    }
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Picture {
    type Point = &'a BackendCoord;
    type IntoIter = std::iter::Once<&'a BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::once(&self.at)
    }
}

impl<DB: DrawingBackend> Drawable<DB> for Picture {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut place: I,
        backend: &mut DB,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<DB::ErrorType>> {
        let Some((x, y)) = place.next() else { return Ok(()) };
        let at = |p: &BackendCoord| (p.0 + x, p.1 + y);
        for shape in &self.shapes {
            match shape {
                Shape::Stroke(points, style) => backend.draw_path(points.iter().map(at), style)?,
                Shape::Fill(points, style) => backend.fill_polygon(points.iter().map(at), style)?,
                Shape::Circle(centre, radius, style) => {
                    backend.draw_circle(at(centre), *radius, style, style.filled)?;
                }
            }
        }
        Ok(())
    }
}
