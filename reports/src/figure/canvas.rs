//! Strokes, areas, markers and letters on the page, in units of a twentieth of a point, and their drawing by plotters.

use super::{Color, Dash, FigureError, Marker, POINT, Point, Series, text};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color as _, FontTransform, ShapeStyle};
use plotters_backend::{BackendCoord, DrawingBackend};

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for FigureError {
    fn from(error: DrawingAreaErrorKind<E>) -> FigureError {
        FigureError::Drawing(error.to_string())
    }
}

/// The style of a line; the width in points.
pub(super) fn pen(color: Color, width: f64) -> ShapeStyle {
    // At least one unit: of width 0 is a line that cannot be seen.
    color.stroke_width((width * POINT).round().max(1.0) as u32)
}

/// Where a text stands: beside a place, centred above it, or read upwards before it.
pub(super) enum Way {
    Beside,
    Above,
    Upwards,
}

enum Shape {
    Line(Vec<Point>, ShapeStyle, Dash),
    Area(Vec<Vec<Point>>, Color),
    Circle(Point, f64, ShapeStyle),
    Text(String, f64, Point, Way),
}

/// Shapes in the order in which they are drawn.
#[derive(Default)]
pub(super) struct Canvas(Vec<Shape>);

impl Canvas {
    /// A polyline.
    pub(super) fn stroke(&mut self, line: &[Point], style: ShapeStyle, dash: Dash) {
        self.0.push(Shape::Line(line.to_vec(), style, dash));
    }

    /// A polygon's outline.
    pub(super) fn outline(&mut self, ring: &[Point], style: ShapeStyle) {
        // Past the first corner, which is joined so too.
        let closed: Vec<Point> = ring.iter().chain(ring.iter().take(2)).copied().collect();
        self.stroke(&closed, style, Dash::Solid);
    }

    /// The inside of rings.
    pub(super) fn fill(&mut self, rings: Vec<Vec<Point>>, color: Color) {
        self.0.push(Shape::Area(rings, color));
    }

    /// A black text of `size` points.
    pub(super) fn write(&mut self, text: &str, size: f64, at: Point, way: Way) {
        self.0.push(Shape::Text(text.into(), size, at, way));
    }

    /// One marker of a series. Sizes are such that all forms weigh about the same.
    pub(super) fn marker(&mut self, at: Point, marker: Marker, series: &Series) {
        let (r, style) = (0.5 * series.size * POINT, pen(series.color, series.width));
        let form = |corners: &[Point]| -> Vec<Point> {
            corners.iter().map(|c| [at[0] + r * c[0], at[1] + r * c[1]]).collect()
        };
        let mut strokes = |d: f64, e: f64| {
            self.stroke(&form(&[[-d, -e], [d, e]]), style, Dash::Solid);
            self.stroke(&form(&[[-e, d], [e, -d]]), style, Dash::Solid);
        };
        let corners = match marker {
            Marker::Cross => return strokes(0.85, 0.85),
            Marker::Plus => return strokes(1.1, 0.0),
            Marker::Circle => {
                let inside = series.fill.map(|color| color.filled());
                let circles = inside.into_iter().chain([style]);
                return self.0.extend(circles.map(|style| Shape::Circle(at, r, style)));
            }
            Marker::Square => form(&[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]]),
            Marker::Triangle => form(&[[0.0, -1.25], [1.1, 0.7], [-1.1, 0.7]]),
            Marker::Diamond => form(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
        };
        if let Some(color) = series.fill {
            self.fill(vec![corners.clone()], color);
        }
        self.outline(&corners, style);
    }

    /// A black text of `size` points centred on a point, at an angle in radians; a white border around its letters sets
    /// it off from what is below.
    pub(super) fn letters(&mut self, text: &str, size: f64, at: Point, angle: f64) {
        let rings = text::rings(text, size * POINT, at, (HPos::Center, VPos::Center), angle);
        rings.iter().for_each(|ring| self.outline(ring, pen(Color::WHITE, 0.28 * size)));
        self.fill(rings, Color::BLACK);
    }

    /// Draws the shapes.
    pub(super) fn draw<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
    ) -> Result<(), FigureError> {
        for shape in &self.0 {
            match shape {
                Shape::Line(line, style, dash) => match dash.lengths() {
                    None => area.draw(&PathElement::new(units(line), *style)),
                    Some(lengths) => {
                        let width = f64::from(style.stroke_width).max(0.8 * POINT);
                        let [on, off] = lengths.map(|length| (length * width) as i32);
                        area.draw(&DashedPathElement::new(units(line), on, off, *style))
                    }
                },
                // The way to a further ring and back encloses nothing.
                Shape::Area(rings, color) => {
                    let Some(first) = rings.iter().find_map(|ring| ring.first()) else { continue };
                    let around = |ring: &Vec<Point>| [&ring[..], &ring[..1], &[*first]].concat();
                    let rings = || rings.iter().filter(|ring| !ring.is_empty());
                    let points: Vec<Point> = rings().flat_map(around).collect();
                    area.draw(&Polygon::new(units(&points), *color))
                }
                Shape::Circle(at, radius, style) => {
                    area.draw(&Circle::new(units(&[*at])[0], *radius, *style))
                }
                Shape::Text(text, size, at, way) => {
                    let (h, v, turn) = match way {
                        Way::Beside => (HPos::Left, VPos::Center, FontTransform::None),
                        Way::Above => (HPos::Center, VPos::Bottom, FontTransform::None),
                        Way::Upwards => (HPos::Center, VPos::Bottom, FontTransform::Rotate270),
                    };
                    let style = text::style(*size, h, v).transform(turn);
                    area.draw_text(text, &style, units(&[*at])[0])
                }
            }?;
        }
        Ok(())
    }
}

fn units(points: &[Point]) -> Vec<BackendCoord> {
    points.iter().map(|p| (p[0].round() as i32, p[1].round() as i32)).collect()
}
