//! The legend below all panels: names beside samples of the look. Plotters' own has but one column in a corner of one
//! plot, and measures its text without the font.

use super::canvas::{Canvas, Done, pen};
use super::geometry::Rect;
use super::panel::LABEL_GAP;
use super::{Color, Dash, POINT, Panel, text};

/// Size of the names, in points.
const SIZE: f64 = 7.8;
/// From line to line.
const ROW: f64 = 1.55 * SIZE * POINT;
/// Length of a sample, and of the room between entries.
const SAMPLE: f64 = 20.0 * POINT;
/// From sample to name.
const GAP: f64 = 4.0 * POINT;

/// All names in the panels, each with the first panel that has it and the room it takes up to the next one, in rows.
pub(super) struct Legend<'a>(Vec<Vec<(&'a str, &'a Panel, f64)>>);

impl<'a> Legend<'a> {
    /// The legend of the panels, `room` wide at most; what has the same name shares an entry.
    pub(super) fn new(panels: &'a [Panel], room: f64) -> Legend<'a> {
        let mut entries: Vec<(&str, &Panel, f64)> = Vec::new();
        for panel in panels {
            let contours = panel.contours.iter().map(|contours| contours.label.as_str());
            for name in contours.chain(panel.series.iter().map(|series| series.label.as_str())) {
                if !name.is_empty() && entries.iter().all(|entry| entry.0 != name) {
                    entries.push((name, panel, 2.0 * SAMPLE + GAP + text::width(name, SIZE)));
                }
            }
        }
        let widths: Vec<f64> = entries.iter().map(|entry| entry.2).collect();
        let rows = text::lines(&widths, room + SAMPLE).into_iter();
        Legend(rows.map(|row| entries[row].to_vec()).collect())
    }

    pub(super) fn height(&self) -> f64 {
        self.0.len() as f64 * ROW + if self.0.is_empty() { 0.0 } else { LABEL_GAP }
    }

    /// Draws the legend from `top` down, each row centred on `middle`.
    pub(super) fn draw(&self, canvas: &Canvas, middle: f64, top: f64) -> Done {
        for (k, row) in self.0.iter().enumerate() {
            let y = top + LABEL_GAP + (k as f64 + 0.5) * ROW;
            let width: f64 = row.iter().map(|entry| entry.2).sum();
            let mut x = middle - 0.5 * (width - SAMPLE);
            for (name, panel, room) in row {
                draw_sample(canvas, panel, name, x, y)?;
                canvas.write(name, &text::beside(SIZE), [x + SAMPLE + GAP, y])?;
                x += room;
            }
        }
        Ok(())
    }
}

/// The look of everything with a name, to the right of a place.
fn draw_sample(canvas: &Canvas, panel: &Panel, name: &str, x: f64, y: f64) -> Done {
    let line = [[x, y], [x + SAMPLE, y]];
    for contours in panel.contours.iter().filter(|contours| contours.label == name) {
        let Some(bands) = &contours.bands else {
            canvas.stroke(&line, pen(Color::BLACK, contours.width), Dash::Solid)?;
            continue;
        };
        let half = 0.4 * SIZE * POINT;
        let patch = Rect { left: x, top: y - half, right: x + SAMPLE, bottom: y + half };
        canvas.fill(&[patch.corners()], bands.colors[0])?;
        canvas.outline(&patch.corners(), pen(Color::GREY, 0.4))?;
    }
    for series in panel.series.iter().filter(|series| series.label == name) {
        series.draw(canvas, &line)?;
    }
    Ok(())
}
