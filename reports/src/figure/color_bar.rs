//! Colour bars: the bands of a map and their edges.

use super::canvas::{Canvas, Done, fill, outline, pen, stroke};
use super::geometry::Rect;
use super::panel::{FRAME_WIDTH, LABEL_GAP, LABEL_SIZE, TICK, TICK_SIZE, widest};
use super::{Bands, Color, Dash, POINT, text};
use crate::number::format_numbers;
use plotters::style::FontTransform;

const BREADTH: f64 = 9.0 * POINT;
/// From line to line of a label.
const LINE: f64 = 1.25 * LABEL_SIZE * POINT;

/// The key to the colours of contours: all bands equally long, their edges labelled; set apart by lines where their steps
/// are not even.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorBar {
    bands: Bands,
    label: String,
}

impl ColorBar {
    /// The bar of these bands; the label names the quantity.
    pub fn new(bands: Bands, label: impl Into<String>) -> ColorBar {
        ColorBar { bands, label: label.into() }
    }

    /// Breadth of a bar of this length with its numbers and its label.
    pub(super) fn breadth(&self, length: f64) -> f64 {
        let lines = text::wrapped(&self.label, LABEL_SIZE, length).len() as f64;
        let numbers = widest(format_numbers(&self.bands.edges));
        BREADTH + 2.0 * TICK + numbers + LABEL_GAP + lines * LINE
    }

    /// Draws the bar upwards at `left`.
    pub(super) fn draw(&self, canvas: &Canvas, left: f64, (bottom, top): (f64, f64)) -> Done {
        let Bands { edges, colors, below, above } = &self.bands;
        let (right, style) = (left + BREADTH, pen(Color::BLACK, FRAME_WIDTH));
        let low = if below.is_some() { bottom - BREADTH } else { bottom };
        let high = if above.is_some() { top + BREADTH } else { top };
        let at = |k: usize| low + (high - low) * k as f64 / colors.len() as f64;
        let band = |k: usize| Rect { left, right, top: at(k + 1), bottom: at(k) }.corners();
        let step = edges[1] - edges[0];
        let even = edges.windows(2).all(|w| (w[1] - w[0] - step).abs() < 1e-9 * step);
        canvas.draw(colors.iter().enumerate().map(|(k, color)| fill(&[band(k)], *color)))?;
        let bands = (0..colors.len()).filter(|_| !even);
        canvas.draw(bands.map(|k| outline(&band(k), style)))?;
        for (color, from, to) in [(below, low, bottom), (above, high, top)] {
            let tip = vec![[left, from], [0.5 * (left + right), to], [right, from]];
            if let Some(color) = color {
                let border = outline(&tip, style);
                canvas.draw([fill(&[tip], *color), border])?;
            }
        }
        canvas.draw([outline(&Rect { left, right, top: high, bottom: low }.corners(), style)])?;
        // As many numbers as do not touch.
        let numbers = format_numbers(edges);
        let room = 1.15 * TICK_SIZE * POINT * colors.len() as f64 / (low - high).abs();
        for (k, number) in numbers.iter().enumerate().step_by(room.ceil().max(1.0) as usize) {
            let tick = [[right, at(k)], [right + TICK, at(k)]];
            canvas.draw([stroke(&tick, style, Dash::Solid)])?;
            canvas.write(number, &text::beside(TICK_SIZE), [right + 2.0 * TICK, at(k)])?;
        }
        let mut across = right + 2.0 * TICK + widest(&numbers) + LABEL_GAP;
        let upwards = text::above(LABEL_SIZE).transform(FontTransform::Rotate270);
        for line in text::wrapped(&self.label, LABEL_SIZE, bottom - top) {
            across += LINE;
            canvas.write(&line, &upwards, [across, 0.5 * (bottom + top)])?;
        }
        Ok(())
    }
}
