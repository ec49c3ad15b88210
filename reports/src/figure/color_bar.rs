//! Colour bars: the bands of a map and their edges.

use super::{
    color::{Bands, Color},
    geometry::{Point, Rect},
    ink::{Drawn, Ink, Pen},
    panel::{FRAME_WIDTH, LABEL_GAP, LABEL_SIZE, TICK, TICK_SIZE, widest},
    text::{self, POINT},
};
use crate::number::format_numbers;
use plotters::style::{
    FontTransform,
    text_anchor::{HPos, VPos},
};

const BREADTH: f64 = 9.0 * POINT;
/// From line to line of a label.
const LINE: f64 = 1.25 * LABEL_SIZE * POINT;

/// The key to the colours of filled contours: all bands equally long, their edges labelled; set apart by lines where
/// their steps are not even.
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
    pub(super) fn draw(&self, canvas: &impl Ink, left: f64, (bottom, top): (f64, f64)) -> Drawn {
        let Bands { edges, colors, below, above } = &self.bands;
        let pen = Pen::solid(Color::BLACK, FRAME_WIDTH);
        let right = left + BREADTH;
        let low = if below.is_some() { bottom - BREADTH } else { bottom };
        let high = if above.is_some() { top + BREADTH } else { top };
        let at = |k: usize| low + (high - low) * k as f64 / colors.len() as f64;
        let band = |k: usize| Rect { left, right, top: at(k + 1), bottom: at(k) }.corners();
        let step = edges[1] - edges[0];
        let even = edges.windows(2).all(|w| (w[1] - w[0] - step).abs() < 1e-9 * step);
        for (k, color) in colors.iter().enumerate() {
            canvas.fill(&[band(k)], *color)?;
        }
        for k in (0..colors.len()).filter(|_| !even) {
            canvas.outline(&band(k), pen)?;
        }
        for (color, from, to) in [(below, low, bottom), (above, high, top)] {
            let tip: Vec<Point> = vec![[left, from], [0.5 * (left + right), to], [right, from]];
            if let Some(color) = color {
                canvas.fill(std::slice::from_ref(&tip), *color)?;
                canvas.outline(&tip, pen)?;
            }
        }
        canvas.outline(&Rect { left, right, top: high, bottom: low }.corners(), pen)?;
        // As many numbers as do not touch.
        let numbers = format_numbers(edges);
        let room = 1.15 * TICK_SIZE * POINT * colors.len() as f64 / (low - high).abs();
        let to = (HPos::Left, VPos::Center, FontTransform::None);
        for (k, number) in numbers.iter().enumerate().step_by(room.ceil().max(1.0) as usize) {
            canvas.stroke(&[[right, at(k)], [right + TICK, at(k)]], pen)?;
            canvas.write(number, TICK_SIZE, [right + 2.0 * TICK, at(k)], to.clone())?;
        }
        let to = (HPos::Center, VPos::Bottom, FontTransform::Rotate270);
        let lines = text::wrapped(&self.label, LABEL_SIZE, bottom - top);
        let first = right + 2.0 * TICK + widest(&numbers) + LABEL_GAP;
        for (k, line) in lines.iter().enumerate() {
            let across = first + (k + 1) as f64 * LINE;
            canvas.write(line, LABEL_SIZE, [across, 0.5 * (bottom + top)], to.clone())?;
        }
        Ok(())
    }
}
