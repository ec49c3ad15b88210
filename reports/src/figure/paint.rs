//! From data coordinates to the page: the layers of a panel.

use super::{
    axis::Axis,
    field::Field,
    geometry::{Point, Rect, clip, distance, simplify},
    ink::{Drawn, Ink, Pen},
    isoline_label::Obstacles,
    layer::{FilledContours, Isolines, Layer, Line},
    text::{self, POINT},
};
use crate::number::format_number;
use rayon::prelude::*;

/// Points of curves closer than this to their neighbours' chord are left out: 0.01 point.
const TOLERANCE: f64 = 0.01 * POINT;
pub(super) const ISOLINE_SIZE: f64 = 6.8;
const NOTE_SIZE: f64 = 7.5;

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
pub(super) fn layers(canvas: &impl Ink, frame: &Frame, layers: &[Layer]) -> Drawn {
    // Side by side: following contours is most of the work.
    layers.par_iter().for_each(|layer| match layer {
        Layer::FilledContours(contours) => contours.field.follow(&contours.bands.ascending().0),
        Layer::Isolines(lines) => lines.field.follow(&lines.levels),
        _ => {}
    });
    let mut labels = Obstacles::new(frame, layers);
    for layer in layers {
        match layer {
            Layer::Line(Line { points, color, width, dash, .. }) => {
                let pen = Pen { color: *color, width: *width, dash: *dash };
                frame.curve(points).iter().try_for_each(|piece| canvas.stroke(piece, pen))?;
            }
            Layer::Markers(markers) => {
                let places = markers.points.iter().map(|&p| frame.at(p));
                for at in places.filter(|&at| frame.rect.grown(0.5).contains(at)) {
                    canvas.marker(at, markers)?;
                }
            }
            Layer::FilledContours(contours) => bands(canvas, frame, contours)?,
            Layer::Isolines(lines) => isolines(canvas, frame, lines, &mut labels)?,
            Layer::Note(note) => {
                canvas.letters(&note.text, NOTE_SIZE, (frame.at(note.at), 0.0))?;
            }
        }
    }
    Ok(())
}

/// Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no seam of
/// background can show between them.
fn bands(canvas: &impl Ink, frame: &Frame, contours: &FilledContours) -> Drawn {
    let (levels, colors) = contours.bands.ascending();
    for (rings, color) in frame.field(&contours.field).regions(&levels).into_iter().zip(colors) {
        let rings: Vec<_> = rings.iter().map(|ring| simplify(ring, TOLERANCE)).collect();
        if !rings.is_empty() {
            canvas.fill(&rings, color)?;
        }
    }
    Ok(())
}

fn isolines(
    canvas: &impl Ink,
    frame: &Frame,
    isolines: &Isolines,
    labels: &mut Obstacles,
) -> Drawn {
    let pen = Pen::solid(isolines.color, isolines.width);
    let lines = frame.isolines(&isolines.field, &isolines.levels);
    for (&level, lines) in isolines.levels.iter().zip(lines) {
        let value = format_number(level);
        let width = text::width(&value, ISOLINE_SIZE * POINT);
        for line in lines {
            canvas.stroke(&line, pen)?;
            if let Some(place) = isolines.values.then(|| labels.place(&line, width)).flatten() {
                canvas.letters(&value, ISOLINE_SIZE, place)?;
            }
        }
    }
    Ok(())
}
