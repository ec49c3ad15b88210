//! From data coordinates to the page: the layers of a panel.

use super::geometry::{clip, distance, simplify};
use super::isoline_label::Obstacles;
use super::{
    Axis, Canvas, Color, Dash, Field, FilledContours, Layer, POINT, Point, Rect, pen, text,
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
        let mut on_page: Vec<Point> = points.iter().map(|&p| self.at(p)).collect();
        match on_page[..] {
            // Across the panel.
            [[x, y]] if y.is_nan() => on_page = vec![[x, bottom], [x, top]],
            [[x, y]] if x.is_nan() => on_page = vec![[left, y], [right, y]],
            _ => {}
        }
        clip(&on_page, &self.rect).iter().map(|line| simplify(line, TOLERANCE)).collect()
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

/// Draws layers in order, and the values of isolines over them.
pub(super) fn layers(canvas: &mut Canvas, frame: &Frame, layers: &[Layer]) {
    // Side by side: following contours is most of the work.
    layers.par_iter().for_each(|layer| match layer {
        Layer::FilledContours(contours) => contours.field.follow(&contours.bands.ascending().0),
        Layer::Isolines(lines) => lines.field.follow(&lines.levels),
        _ => {}
    });
    let mut obstacles = Obstacles::new(frame.rect);
    let mut labelled = Vec::new();
    for layer in layers {
        match layer {
            Layer::Series(series) => match series.marker {
                Some(marker) => {
                    let places = series.points.iter().map(|&p| frame.at(p));
                    for at in places.filter(|&at| frame.rect.grown(0.5).contains(at)) {
                        canvas.marker(at, marker, series);
                        obstacles.add(&[at; 2]);
                    }
                }
                None => {
                    for piece in frame.curve(&series.points) {
                        canvas.stroke(&piece, pen(series.color, series.width), series.dash);
                        obstacles.add(&piece);
                    }
                }
            },
            Layer::FilledContours(contours) => bands(canvas, frame, contours),
            Layer::Isolines(isolines) => {
                let lines = frame.isolines(&isolines.field, &isolines.levels);
                let levels = isolines.levels.iter().zip(lines);
                for (&level, line) in
                    levels.flat_map(|(l, lines)| lines.into_iter().map(move |line| (l, line)))
                {
                    canvas.stroke(&line, pen(Color::BLACK, isolines.width), Dash::Solid);
                    match isolines.values {
                        true => labelled.push((level, line)),
                        false => obstacles.add(&line),
                    }
                }
            }
            Layer::Note(note) => {
                canvas.letters(&note.text, NOTE_SIZE, frame.at(note.at), 0.0);
                obstacles.add(&[frame.at(note.at); 2]);
            }
        }
    }
    for (level, line) in labelled {
        let value = format_number(level);
        let place = obstacles.place(&line, text::width(&value, ISOLINE_SIZE));
        if let Some((at, angle)) = place {
            canvas.letters(&value, ISOLINE_SIZE, at, angle);
        }
    }
}

/// Each band is painted from its lower edge all the way up and the next one over it: neighbours overlap, so no seam of
/// background can show between them.
fn bands(canvas: &mut Canvas, frame: &Frame, contours: &FilledContours) {
    let (levels, colors) = contours.bands.ascending();
    for (rings, color) in frame.field(&contours.field).regions(&levels).into_iter().zip(colors) {
        if !rings.is_empty() {
            canvas.fill(rings.iter().map(|ring| simplify(ring, TOLERANCE)).collect(), color);
        }
    }
}
