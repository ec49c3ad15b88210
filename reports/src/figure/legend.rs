//! The legend below all panels: names of layers beside samples of their look. Plotters' own has but one column in a
//! corner of one plot, and measures its text without the font.

use super::panel::LABEL_GAP;
use super::{Canvas, Color, Dash, Layer, POINT, Rect, Way, pen, text};
use std::ops::Range;

/// Size of the names, in points.
const SIZE: f64 = 7.8;
/// From line to line.
const ROW: f64 = 1.55 * SIZE * POINT;
/// Length of a sample, and of the room between entries.
const SAMPLE: f64 = 20.0 * POINT;
/// From sample to name.
const GAP: f64 = 4.0 * POINT;

/// Names, each with the layers that bear it and the room it takes up to the next one, in rows.
pub(super) struct Legend<'a> {
    entries: Vec<(&'a str, Vec<&'a Layer>)>,
    widths: Vec<f64>,
    rows: Vec<Range<usize>>,
}

impl<'a> Legend<'a> {
    /// The legend of the named layers, `room` wide at most; layers of the same name share an entry.
    pub(super) fn new(layers: impl Iterator<Item = &'a Layer>, room: f64) -> Legend<'a> {
        let mut entries: Vec<(&str, Vec<&Layer>)> = Vec::new();
        for layer in layers.filter(|layer| !layer.label().is_empty()) {
            match entries.iter_mut().find(|entry| entry.0 == layer.label()) {
                Some(entry) => entry.1.push(layer),
                None => entries.push((layer.label(), vec![layer])),
            }
        }
        let width = |entry: &(&str, _)| 2.0 * SAMPLE + GAP + text::width(entry.0, SIZE);
        let widths: Vec<f64> = entries.iter().map(width).collect();
        let rows = text::lines(&widths, room + SAMPLE);
        Legend { entries, widths, rows }
    }

    pub(super) fn height(&self) -> f64 {
        self.rows.len() as f64 * ROW + if self.rows.is_empty() { 0.0 } else { LABEL_GAP }
    }

    /// Draws the legend from `top` down, each row centred on `middle`.
    pub(super) fn draw(&self, canvas: &mut Canvas, middle: f64, top: f64) {
        for (k, row) in self.rows.iter().enumerate() {
            let y = top + LABEL_GAP + (k as f64 + 0.5) * ROW;
            let mut x = middle - 0.5 * (self.widths[row.clone()].iter().sum::<f64>() - SAMPLE);
            for n in row.clone() {
                let (label, layers) = &self.entries[n];
                layers.iter().for_each(|layer| sample(canvas, layer, x, y));
                canvas.write(label, SIZE, [x + SAMPLE + GAP, y], Way::Beside);
                x += self.widths[n];
            }
        }
    }
}

/// The look of a layer, to the right of a place.
fn sample(canvas: &mut Canvas, layer: &Layer, x: f64, y: f64) {
    let line = [[x, y], [x + SAMPLE, y]];
    match layer {
        Layer::Series(series) => match series.marker {
            Some(marker) => canvas.marker([x + 0.5 * SAMPLE, y], marker, series),
            None => canvas.stroke(&line, pen(series.color, series.width), series.dash),
        },
        Layer::Isolines(lines) => canvas.stroke(&line, pen(Color::BLACK, lines.width), Dash::Solid),
        Layer::FilledContours(contours) => {
            let half = 0.4 * SIZE * POINT;
            let patch = Rect { left: x, top: y - half, right: x + SAMPLE, bottom: y + half };
            canvas.fill(vec![patch.corners()], contours.bands.colors[0]);
            canvas.outline(&patch.corners(), pen(Color::GREY, 0.4));
        }
        Layer::Note(_) => {}
    }
}
