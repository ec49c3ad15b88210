//! From data coordinates to the page: strokes, areas, markers, letters, and the layers made of them.

use super::{
    axis::Axis,
    color::Color,
    field::Field,
    geometry::{Point, Rect, clip, distance, simplify},
    isoline_label::Obstacles,
    layer::{Dash, FilledContours, Isolines, Layer, Line, Marker, Markers},
    text::{self, POINT},
};
use crate::number::format_number;
use plotters::{
    coord::Shift,
    drawing::{DrawingArea, DrawingAreaErrorKind},
    element::{Circle, DashedPathElement, PathElement, Polygon},
    style::{Color as _, ShapeStyle},
};
use plotters_backend::{BackendCoord, DrawingBackend};

/// What is drawn on, in units of a twentieth of a point.
pub(super) type Canvas<DB> = DrawingArea<DB, Shift>;
/// Whether the backend could draw.
pub(super) type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// Points of curves closer than this to their neighbours' chord are left out: 0.01 point.
const TOLERANCE: f64 = 0.01 * POINT;
pub(super) const ISOLINE_SIZE: f64 = 6.8;
const NOTE_SIZE: f64 = 7.5;

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

pub(super) fn unit(p: Point) -> BackendCoord {
    (p[0].round() as i32, p[1].round() as i32)
}

/// Draws a polyline.
pub(super) fn stroke<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    line: &[Point],
    pen: Pen,
) -> Drawn<DB> {
    let points = line.iter().copied().map(unit);
    match pen.dash.pattern() {
        None => canvas.draw(&PathElement::new(points.collect::<Vec<_>>(), pen.style())),
        Some(lengths) => {
            let [dash, gap] = lengths.map(|l| (l * pen.width.max(0.8) * POINT) as i32);
            canvas.draw(&DashedPathElement::new(points, dash, gap, pen.style()))
        }
    }
}

/// Draws a polygon's outline.
pub(super) fn outline<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    ring: &[Point],
    pen: Pen,
) -> Drawn<DB> {
    // Past the first corner, which is joined so too.
    let closed: Vec<Point> = ring.iter().chain(ring.iter().take(2)).copied().collect();
    stroke(canvas, &closed, pen)
}

/// Paints the inside of rings; the way to a further ring and back encloses nothing.
pub(super) fn fill<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    rings: &[Vec<Point>],
    color: Color,
) -> Drawn<DB> {
    let mut points = Vec::new();
    for ring in rings.iter().filter(|ring| !ring.is_empty()) {
        points.extend(ring.iter().chain(ring.first()).map(|&p| unit(p)));
        points.push(points[0]);
    }
    canvas.draw(&Polygon::new(points, color.plotters()))
}

/// Draws one marker. Sizes are such that all forms weigh about the same.
pub(super) fn marker<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    at: Point,
    markers: &Markers,
) -> Drawn<DB> {
    let r = 0.5 * markers.size * POINT;
    let pen = Pen::solid(markers.color, markers.width);
    let ring = |corners: &[Point]| -> Vec<Point> {
        corners.iter().map(|c| [at[0] + r * c[0], at[1] + r * c[1]]).collect()
    };
    let corners = match markers.marker {
        Marker::Circle => {
            if let Some(color) = markers.fill {
                canvas.draw(&Circle::new(unit(at), r, color.plotters().filled()))?;
            }
            return canvas.draw(&Circle::new(unit(at), r, pen.style()));
        }
        Marker::Cross | Marker::Plus => {
            let (d, e) = if markers.marker == Marker::Plus { (1.1, 0.0) } else { (0.85, 0.85) };
            stroke(canvas, &ring(&[[-d, -e], [d, e]]), pen)?;
            return stroke(canvas, &ring(&[[-e, d], [e, -d]]), pen);
        }
        Marker::Square => ring(&[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]]),
        Marker::Triangle => ring(&[[0.0, -1.25], [1.1, 0.7], [-1.1, 0.7]]),
        Marker::Diamond => ring(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
    };
    if let Some(color) = markers.fill {
        fill(canvas, std::slice::from_ref(&corners), color)?;
    }
    outline(canvas, &corners, pen)
}

/// Draws a black text of `size` points centred on a point, at an angle in radians; a white border around its letters sets
/// it off from what is below.
fn letters<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    text: &str,
    size: f64,
    (at, angle): (Point, f64),
) -> Drawn<DB> {
    let em = size * POINT;
    let (back, down) = (0.5 * text::width(text, em), 0.5 * text::CAP_HEIGHT * em);
    let (sin, cos) = angle.sin_cos();
    let origin = [at[0] - back * cos + down * sin, at[1] + back * sin + down * cos];
    let rings = text::rings(text, origin, em, angle);
    let border = Pen::solid(Color::WHITE, 0.28 * size);
    rings.iter().try_for_each(|ring| outline(canvas, ring, border))?;
    fill(canvas, &rings, Color::BLACK)
}

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

    /// A curve on the page, within the panel.
    pub(super) fn curve(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let Rect { left, top, right, bottom } = self.rect;
        let on_page: Vec<Point> = points.iter().map(|&p| self.at(p)).collect();
        let lines = match on_page[..] {
            // Across the panel.
            [[x, y]] if y.is_nan() => clip(&[[x, bottom], [x, top]], &self.rect),
            [[x, y]] if x.is_nan() => clip(&[[left, y], [right, y]], &self.rect),
            _ => clip(&on_page, &self.rect),
        };
        lines.iter().map(|line| simplify(line, TOLERANCE)).collect()
    }

    /// A field on the page, where contours are drawn straight from side to side of its cells.
    fn field(&self, field: &Field) -> Field {
        let Rect { left, top, right, bottom } = self.rect;
        let x = field.x.iter().map(|&x| self.at([x, f64::NAN])[0].clamp(left, right)).collect();
        field.on(x, field.y.iter().map(|&y| self.at([f64::NAN, y])[1].clamp(top, bottom)).collect())
    }

    /// The lines of each value of a field, without specks: islands no larger than a letter.
    pub(super) fn isolines(&self, field: &Field, levels: &[f64]) -> Vec<Vec<Vec<Point>>> {
        let far = |line: &&Vec<Point>| line.iter().any(|&p| distance(p, line[0]) > 6.0 * POINT);
        let lines_of = |lines: Vec<Vec<Point>>| {
            lines.iter().filter(far).map(|line| simplify(line, TOLERANCE)).collect()
        };
        self.field(field).isolines(levels).into_iter().map(lines_of).collect()
    }
}

/// Draws layers in order.
pub(super) fn layers<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    frame: &Frame,
    layers: &[Layer],
) -> Drawn<DB> {
    let mut labels = Obstacles::new(frame, layers);
    for layer in layers {
        match layer {
            Layer::Line(Line { points, color, width, dash, .. }) => {
                let pen = Pen { color: *color, width: *width, dash: *dash };
                frame.curve(points).iter().try_for_each(|piece| stroke(canvas, piece, pen))?;
            }
            Layer::Markers(markers) => {
                let places = markers.points.iter().map(|&p| frame.at(p));
                for at in places.filter(|&at| frame.rect.grown(0.5).contains(at)) {
                    marker(canvas, at, markers)?;
                }
            }
            Layer::FilledContours(contours) => bands(canvas, frame, contours)?,
            Layer::Isolines(lines) => isolines(canvas, frame, lines, &mut labels)?,
            Layer::Note(note) => {
                letters(canvas, &note.text, NOTE_SIZE, (frame.at(note.at), 0.0))?;
            }
        }
    }
    Ok(())
}

/// Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no seam of
/// background can show between them.
fn bands<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    frame: &Frame,
    FilledContours { field, bands, .. }: &FilledContours,
) -> Drawn<DB> {
    let field = frame.field(field);
    let last = bands.edges[bands.edges.len() - 1].next_up();
    let below = bands.below.map(|color| (f64::NEG_INFINITY, color));
    let inner = bands.edges.iter().copied().zip(bands.colors.iter().copied());
    let above = bands.above.map(|color| (last, color));
    let (levels, colors): (Vec<f64>, Vec<Color>) =
        below.into_iter().chain(inner).chain(above).unzip();
    for (rings, color) in field.regions(&levels).into_iter().zip(colors) {
        let rings: Vec<_> = rings.iter().map(|ring| simplify(ring, TOLERANCE)).collect();
        if !rings.is_empty() {
            fill(canvas, &rings, color)?;
        }
    }
    Ok(())
}

fn isolines<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    frame: &Frame,
    isolines: &Isolines,
    labels: &mut Obstacles,
) -> Drawn<DB> {
    let pen = Pen::solid(isolines.color, isolines.width);
    let lines = frame.isolines(&isolines.field, &isolines.levels);
    for (&level, lines) in isolines.levels.iter().zip(lines) {
        let value = format_number(level);
        let width = text::width(&value, ISOLINE_SIZE * POINT);
        for line in lines {
            stroke(canvas, &line, pen)?;
            if let Some(place) = isolines.values.then(|| labels.place(&line, width)).flatten() {
                letters(canvas, &value, ISOLINE_SIZE, place)?;
            }
        }
    }
    Ok(())
}
