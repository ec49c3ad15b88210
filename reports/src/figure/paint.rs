//! Layers on the page: from data coordinates to shapes.

use super::{
    axis::AxisRange,
    color::Color,
    contour::Field,
    geometry::{self, Point, Rect, clip_polygon, clip_polyline, simplify},
    layer::{
        Anchor, ErrorBars, FilledContours, Isolines, Layer, Line, Marker, Markers, Region, Rule,
    },
    line_label::Obstacles,
    number::format_number,
    picture::{Pen, Picture},
    text::{self, POINT},
};

/// Points of curves closer than this to their neighbours' chord are left out: 0.01 point.
const TOLERANCE: f64 = 0.01 * POINT;
/// Distance of hatch strokes in points, and their width.
const HATCH: (f64, f64) = (6.5, 0.35);
const ISOLINE_SIZE: f64 = 6.8;
const NOTE_SIZE: f64 = 7.5;

/// Where data lie on the page.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    pub(super) rect: Rect,
    pub(super) x: AxisRange,
    pub(super) y: AxisRange,
}

impl Frame {
    pub(super) fn x_at(&self, x: f64) -> f64 {
        self.rect.left + self.x.fraction(x) * self.rect.width()
    }

    pub(super) fn y_at(&self, y: f64) -> f64 {
        self.rect.bottom - self.y.fraction(y) * self.rect.height()
    }

    pub(super) fn at(&self, p: Point) -> Point {
        [self.x_at(p[0]), self.y_at(p[1])]
    }

    /// The nodes of a field on the page, where contours are drawn straight from side to side of its cells.
    fn nodes(&self, field: &Field) -> (Vec<f64>, Vec<f64>) {
        let x = field.x().iter().map(|&x| self.x_at(x)).collect();
        (x, field.y().iter().map(|&y| self.y_at(y)).collect())
    }

    /// The lines of each value of a field, within the panel: values in the order in which they are given.
    pub(super) fn isolines(&self, field: &Field, levels: &[f64]) -> Vec<(f64, Vec<Vec<Point>>)> {
        let (x, y) = self.nodes(field);
        let mut ascending: Vec<f64> = levels.to_vec();
        ascending.sort_by(f64::total_cmp);
        let lines = field.on(&x, &y).isolines(&ascending);
        let clipped = |lines: &Vec<Vec<Point>>| {
            lines.iter().flat_map(|l| clip_polyline(&simplify(l, TOLERANCE), &self.rect)).collect()
        };
        let of = |level: &f64| {
            let which = ascending.partition_point(|other| other.total_cmp(level).is_lt());
            (*level, clipped(&lines[which]))
        };
        levels.iter().map(of).collect()
    }
}

/// The layers in order.
pub(super) fn layers(frame: &Frame, layers: &[Layer]) -> Picture {
    let mut picture = Picture::default();
    let mut labels = Obstacles::new(frame, layers);
    for layer in layers {
        match layer {
            Layer::Line(line) => curve(&mut picture, frame, line),
            Layer::Markers(markers) => {
                let inside = |p: &Point| frame.rect.grown(0.5).contains(*p);
                let places = markers.points.iter().map(|&p| frame.at(p)).filter(inside);
                places.for_each(|at| marker(&mut picture, at, markers));
            }
            Layer::ErrorBars(bars) => error_bars(&mut picture, frame, bars),
            Layer::Rule(line) => rule(&mut picture, frame, line),
            Layer::Region(area) => region(&mut picture, frame, area),
            Layer::FilledContours(contours) => bands(&mut picture, frame, contours),
            Layer::Isolines(lines) => isolines(&mut picture, frame, lines, &mut labels),
            Layer::Note(note) => {
                let at = frame.at(note.at);
                if at.iter().all(|v| v.is_finite()) {
                    let look = (note.anchor, 0.0, note.color);
                    picture.text(&note.text, at, NOTE_SIZE, look, 0.3 * NOTE_SIZE);
                }
            }
        }
    }
    picture
}

fn curve(picture: &mut Picture, frame: &Frame, line: &Line) {
    let points: Vec<Point> = line.points.iter().map(|&p| frame.at(p)).collect();
    let pen = Pen { color: line.color, width: line.width, dash: line.dash };
    for piece in clip_polyline(&points, &frame.rect) {
        picture.stroke(&simplify(&piece, TOLERANCE), pen);
    }
}

/// One marker at a place of the page. Sizes are such that all forms weigh about the same.
pub(super) fn marker(picture: &mut Picture, at: Point, markers: &Markers) {
    let r = 0.5 * markers.size * POINT;
    let pen = Pen::solid(markers.color, markers.width);
    let ring = |corners: &[Point]| -> Vec<Point> {
        corners.iter().map(|c| [at[0] + r * c[0], at[1] + r * c[1]]).collect()
    };
    let corners = match markers.marker {
        Marker::Circle => return picture.circle(at, r, markers.fill, pen),
        Marker::Cross => {
            let d = 0.85;
            picture.stroke(&ring(&[[-d, -d], [d, d]]), pen);
            return picture.stroke(&ring(&[[-d, d], [d, -d]]), pen);
        }
        Marker::Plus => {
            let d = 1.1;
            picture.stroke(&ring(&[[-d, 0.0], [d, 0.0]]), pen);
            return picture.stroke(&ring(&[[0.0, -d], [0.0, d]]), pen);
        }
        Marker::Square => ring(&[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]]),
        Marker::Triangle => ring(&[[0.0, -1.25], [1.1, 0.7], [-1.1, 0.7]]),
        Marker::Diamond => ring(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
    };
    if let Some(fill) = markers.fill {
        picture.fill(std::slice::from_ref(&corners), fill, 1.0);
    }
    if markers.width > 0.0 {
        picture.outline(&corners, pen);
    }
}

fn error_bars(picture: &mut Picture, frame: &Frame, bars: &ErrorBars) {
    const CAP: f64 = 2.0 * POINT;
    let pen = Pen::solid(bars.color, 0.8);
    for &[x, low, high] in &bars.bars {
        let (a, b) = (frame.at([x, low]), frame.at([x, high]));
        for piece in clip_polyline(&[a, b], &frame.rect) {
            picture.stroke(&piece, pen);
        }
        for end in [a, b].into_iter().filter(|&end| frame.rect.contains(end)) {
            picture.stroke(&[[end[0] - CAP, end[1]], [end[0] + CAP, end[1]]], pen);
        }
    }
}

fn rule(picture: &mut Picture, frame: &Frame, rule: &Rule) {
    let Rect { left, top, right, bottom } = frame.rect;
    let ends = if rule.vertical {
        let x = frame.x_at(rule.at);
        [[x, bottom], [x, top]]
    } else {
        let y = frame.y_at(rule.at);
        [[left, y], [right, y]]
    };
    let pen = Pen { color: rule.color, width: rule.width, dash: rule.dash };
    clip_polyline(&ends, &frame.rect).iter().for_each(|piece| picture.stroke(piece, pen));
}

fn region(picture: &mut Picture, frame: &Frame, region: &Region) {
    // Infinite coordinates, and zero on a logarithmic axis, lie one panel beyond the border.
    let place = |fraction: f64, value: f64| match fraction.is_finite() {
        true => fraction.clamp(-1e6, 1e6),
        false if value > 0.0 => 2.0,
        false => -1.0,
    };
    let r = frame.rect;
    let on_page = |p: &Point| {
        let x = r.left + place(frame.x.fraction(p[0]), p[0]) * r.width();
        [x, r.bottom - place(frame.y.fraction(p[1]), p[1]) * r.height()]
    };
    let outline: Vec<Point> = region.outline.iter().map(on_page).collect();
    patch(picture, clip_polygon(&outline, &r), region);
}

/// An area of the page in the look of a region.
pub(super) fn patch(picture: &mut Picture, outline: Vec<Point>, region: &Region) {
    let strokes = region.hatch.map(|color| (geometry::hatch(&outline, HATCH.0 * POINT), color));
    if let Some((fill, opacity)) = region.fill {
        picture.fill(&[outline], fill, opacity);
    }
    if let Some((strokes, color)) = strokes {
        strokes.iter().for_each(|stroke| picture.stroke(stroke, Pen::solid(color, HATCH.1)));
    }
}

/// Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no seam of
/// background can show between them.
fn bands(picture: &mut Picture, frame: &Frame, contours: &FilledContours) {
    let FilledContours { field, bands } = contours;
    let (x, y) = frame.nodes(field);
    let trace = field.on(&x, &y);
    let edges = bands.edges();
    // From below all of them up to above the last one: that edge itself belongs to the last band.
    let levels: Vec<f64> = std::iter::once(f64::NEG_INFINITY)
        .chain(edges[..edges.len() - 1].iter().copied())
        .chain(edges.last().map(|last| last.next_up()))
        .collect();
    let clipped = |rings: Vec<Vec<Point>>| -> Vec<Vec<Point>> {
        let rings = rings.into_iter().map(|mut ring| {
            ring.push(ring[0]);
            clip_polygon(&simplify(&ring, TOLERANCE), &frame.rect)
        });
        rings.filter(|ring| ring.len() > 2).collect()
    };
    let levels = if bands.below().is_some() { &levels[..] } else { &levels[1..] };
    let mut regions: Vec<_> = trace.regions(levels).into_iter().map(clipped).collect();
    let above = regions.pop().unwrap_or_default();
    // What is not to be painted above the last edge is cut out of every region as a hole.
    let hole: Vec<Vec<Point>> = match bands.above() {
        Some(_) => Vec::new(),
        None => above.iter().map(|ring| ring.iter().rev().copied().collect()).collect(),
    };
    let mut paint = |mut rings: Vec<Vec<Point>>, color: Color| {
        if !rings.is_empty() {
            rings.extend(hole.iter().cloned());
            picture.fill(&rings, color, 1.0);
        }
    };
    let colors = bands.below().into_iter().chain(bands.colors().iter().copied());
    for (region, color) in regions.into_iter().zip(colors) {
        paint(region, color);
    }
    if let Some(color) = bands.above() {
        paint(above, color);
    }
}

fn isolines(picture: &mut Picture, frame: &Frame, isolines: &Isolines, labels: &mut Obstacles) {
    let pen = Pen::solid(isolines.color, isolines.width);
    let size = ISOLINE_SIZE * POINT;
    for (level, lines) in frame.isolines(&isolines.field, &isolines.levels) {
        let value = format_number(level);
        for line in lines {
            let width = text::width(&value, size);
            match isolines.labelled.then(|| labels.place(&line, width, size)).flatten() {
                Some(place) => {
                    place.rest.iter().for_each(|piece| picture.stroke(piece, pen));
                    let look = (Anchor::Middle, place.angle, isolines.color);
                    picture.text(&value, place.middle, ISOLINE_SIZE, look, 0.0);
                }
                None => picture.stroke(&line, pen),
            }
        }
    }
}
