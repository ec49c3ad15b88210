//! Strokes, areas, markers and letters on a canvas of plotters.

use super::{
    FigureError,
    color::Color,
    geometry::Point,
    layer::{Dash, Marker, Markers},
    text::{self, POINT},
};
use plotters::{
    coord::Shift,
    drawing::DrawingArea,
    element::{Circle, DashedPathElement, PathElement, Polygon},
    style::{
        Color as _, FontTransform, ShapeStyle,
        text_anchor::{HPos, VPos},
    },
};
use plotters_backend::{BackendCoord, DrawingBackend};

/// Whether something could be drawn.
pub(super) type Drawn = Result<(), FigureError>;

/// What the drawing library says when it fails.
pub(super) fn failed(error: impl std::fmt::Display) -> FigureError {
    FigureError::Drawing(error.to_string())
}

/// How a line is drawn; the width in points.
#[derive(Debug, Clone, Copy)]
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

fn unit(p: Point) -> BackendCoord {
    (p[0].round() as i32, p[1].round() as i32)
}

/// A canvas in units of a twentieth of a point.
pub(super) trait Ink {
    /// Draws a polyline.
    fn stroke(&self, line: &[Point], pen: Pen) -> Drawn;
    /// Paints the inside of rings; the way to a further ring and back encloses nothing.
    fn fill(&self, rings: &[Vec<Point>], color: Color) -> Drawn;
    /// Draws a disc or, with a pen, a circle.
    fn circle(&self, at: Point, radius: f64, style: ShapeStyle) -> Drawn;
    /// Writes a black text of `size` points, level or upwards.
    fn write(&self, text: &str, size: f64, at: Point, to: (HPos, VPos, FontTransform)) -> Drawn;

    /// Draws a polygon's outline.
    fn outline(&self, ring: &[Point], pen: Pen) -> Drawn {
        // Past the first corner, which is joined so too.
        let closed: Vec<Point> = ring.iter().chain(ring.iter().take(2)).copied().collect();
        self.stroke(&closed, pen)
    }

    /// Draws one marker. Sizes are such that all forms weigh about the same.
    fn marker(&self, at: Point, markers: &Markers) -> Drawn {
        let r = 0.5 * markers.size * POINT;
        let pen = Pen::solid(markers.color, markers.width);
        let ring = |corners: &[Point]| -> Vec<Point> {
            corners.iter().map(|c| [at[0] + r * c[0], at[1] + r * c[1]]).collect()
        };
        let corners = match markers.marker {
            Marker::Circle => {
                if let Some(color) = markers.fill {
                    self.circle(at, r, color.plotters().filled())?;
                }
                return self.circle(at, r, pen.style());
            }
            Marker::Cross | Marker::Plus => {
                let (d, e) = if markers.marker == Marker::Plus { (1.1, 0.0) } else { (0.85, 0.85) };
                self.stroke(&ring(&[[-d, -e], [d, e]]), pen)?;
                return self.stroke(&ring(&[[-e, d], [e, -d]]), pen);
            }
            Marker::Square => ring(&[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]]),
            Marker::Triangle => ring(&[[0.0, -1.25], [1.1, 0.7], [-1.1, 0.7]]),
            Marker::Diamond => ring(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
        };
        if let Some(color) = markers.fill {
            self.fill(std::slice::from_ref(&corners), color)?;
        }
        self.outline(&corners, pen)
    }

    /// Draws a black text of `size` points centred on a point, at an angle in radians; a white border around its letters
    /// sets it off from what is below.
    fn letters(&self, text: &str, size: f64, (at, angle): (Point, f64)) -> Drawn {
        let em = size * POINT;
        let (back, down) = (0.5 * text::width(text, em), 0.5 * text::CAP_HEIGHT * em);
        let (sin, cos) = angle.sin_cos();
        let origin = [at[0] - back * cos + down * sin, at[1] + back * sin + down * cos];
        let rings = text::rings(text, origin, em, angle);
        let border = Pen::solid(Color::WHITE, 0.28 * size);
        rings.iter().try_for_each(|ring| self.outline(ring, border))?;
        self.fill(&rings, Color::BLACK)
    }
}

impl<DB: DrawingBackend> Ink for DrawingArea<DB, Shift> {
    fn stroke(&self, line: &[Point], pen: Pen) -> Drawn {
        let (points, style) = (line.iter().copied().map(unit), pen.style());
        match pen.dash.pattern() {
            None => self.draw(&PathElement::new(points.collect::<Vec<_>>(), style)),
            Some(lengths) => {
                let [dash, gap] = lengths.map(|l| (l * pen.width.max(0.8) * POINT) as i32);
                self.draw(&DashedPathElement::new(points, dash, gap, style))
            }
        }
        .map_err(failed)
    }

    fn fill(&self, rings: &[Vec<Point>], color: Color) -> Drawn {
        let mut points = Vec::new();
        for ring in rings.iter().filter(|ring| !ring.is_empty()) {
            points.extend(ring.iter().chain(ring.first()).map(|&p| unit(p)));
            points.push(points[0]);
        }
        self.draw(&Polygon::new(points, color.plotters())).map_err(failed)
    }

    fn circle(&self, at: Point, radius: f64, style: ShapeStyle) -> Drawn {
        self.draw(&Circle::new(unit(at), radius, style)).map_err(failed)
    }

    fn write(&self, text: &str, size: f64, at: Point, to: (HPos, VPos, FontTransform)) -> Drawn {
        let style = text::style(size, to.0, to.1).transform(to.2);
        self.draw_text(text, &style, unit(at)).map_err(failed)
    }
}
