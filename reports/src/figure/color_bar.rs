//! Colour bars: the bands of a map and their edges.

use super::{
    color::Color,
    colormap::Bands,
    font,
    geometry::{Point, Rect},
    scene::{Anchor, Pen, Scene, Text},
    ticks::format_number,
    typography::*,
};

/// The key to the colours of filled contours: all bands equally long, their edges labelled.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorBar {
    bands: Bands,
    label: String,
}

/// From line to line of a label.
const LINE: f64 = 1.25 * LABEL_SIZE;

/// Where the colour bar of a figure stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// At the right of the panels, upright.
    Right,
    /// Below the panels, level.
    Below,
}

impl ColorBar {
    /// The bar of these bands; the label names the quantity.
    pub fn new(bands: Bands, label: impl Into<String>) -> ColorBar {
        ColorBar { bands, label: label.into() }
    }

    /// Labels of the edges, with the same number of decimals where that is short.
    fn labels(&self) -> Vec<String> {
        let shortest: Vec<String> = self.bands.edges().iter().map(|&e| format_number(e)).collect();
        let decimals = shortest
            .iter()
            .map(|l| l.split_once('.').map_or(0, |(_, d)| d.len()))
            .max()
            .unwrap_or(0);
        if decimals > 2 || shortest.iter().any(|l| l.contains("10⁻") || l.contains('×')) {
            return shortest;
        }
        let edges = self.bands.edges().iter();
        edges.map(|e| format!("{e:.decimals$}").replace('-', "−")).collect()
    }

    /// The same bar with its label broken at spaces into lines no longer than `length`, where it is upright.
    pub(super) fn wrapped(&self, length: f64) -> ColorBar {
        let broken = |length: f64| {
            let mut lines: Vec<String> = Vec::new();
            for word in self.label.split(' ') {
                match lines.last_mut() {
                    Some(line) if font::width(&format!("{line} {word}"), LABEL_SIZE) <= length => {
                        line.push(' ');
                        line.push_str(word);
                    }
                    _ => lines.push(word.into()),
                }
            }
            lines
        };
        // As few lines as fit, and these about equally long.
        let fewest = broken(length);
        let even = font::width(&self.label, LABEL_SIZE) / fewest.len() as f64;
        let lengths = (0..20).map(|k| even + (length - even) * f64::from(k) / 20.0);
        let lines = lengths.map(broken).find(|lines| lines.len() <= fewest.len());
        ColorBar { bands: self.bands.clone(), label: lines.unwrap_or(fewest).join("\n") }
    }

    /// Breadth of an upright bar with its labels.
    pub(super) fn breadth_right(&self) -> f64 {
        let widest = self.labels().iter().map(|l| font::width(l, TICK_SIZE)).fold(0.0, f64::max);
        let lines = self.label.lines().count() as f64;
        let label = if lines > 0.0 { LABEL_GAP + LABEL_SIZE + (lines - 1.0) * LINE } else { 0.0 };
        BAR_BREADTH + MINOR_TICK_LENGTH + TICK_GAP + widest + label + font::DESCENT * LABEL_SIZE
    }

    /// Breadth of a level bar with its labels.
    pub(super) fn breadth_below(&self) -> f64 {
        let label = if self.label.is_empty() { 0.0 } else { LABEL_GAP + LABEL_SIZE };
        BAR_BREADTH + MINOR_TICK_LENGTH + TICK_GAP + TICK_SIZE + label + font::DESCENT * LABEL_SIZE
    }

    /// Draws the bar upright between two heights, its left side at `left`.
    pub(super) fn draw_right(&self, scene: &mut Scene, left: f64, top: f64, bottom: f64) {
        let right = left + BAR_BREADTH;
        let edges = self.draw_bands(scene, bottom, top, |along, across| [left + across, along]);
        let labels = self.labels();
        let heights = vec![1.15 * TICK_SIZE; labels.len()];
        for k in spaced(&edges, &heights, self.emphasis()) {
            let x = right + MINOR_TICK_LENGTH;
            scene.stroke(
                vec![vec![[right, edges[k]], [x, edges[k]]]],
                Pen::solid(Color::BLACK, FRAME_WIDTH),
            );
            let at = [x + TICK_GAP, edges[k] + 0.5 * font::CAP_HEIGHT * TICK_SIZE];
            scene.text(Text::new(labels[k].clone(), at, TICK_SIZE));
        }
        let x = left + self.breadth_right() - font::DESCENT * LABEL_SIZE;
        for (above, line) in self.label.lines().rev().enumerate() {
            let at = [x - above as f64 * LINE, 0.5 * (top + bottom)];
            scene.text(Text {
                angle: 90.0,
                anchor: Anchor::Middle,
                ..Text::new(line, at, LABEL_SIZE)
            });
        }
    }

    /// Draws the bar level between two abscissae, its upper side at `top`.
    pub(super) fn draw_below(&self, scene: &mut Scene, top: f64, left: f64, right: f64) {
        let bottom = top + BAR_BREADTH;
        let labels = self.labels();
        // The labels of the ends must not stick out of the page.
        let inset = 0.5 * labels.iter().map(|l| font::width(l, TICK_SIZE)).fold(0.0, f64::max);
        let edges = self
            .draw_bands(scene, left + inset, right - inset, |along, across| [along, top + across]);
        let widths: Vec<f64> =
            labels.iter().map(|l| font::width(l, TICK_SIZE) + 0.8 * TICK_SIZE).collect();
        let baseline = bottom + MINOR_TICK_LENGTH + TICK_GAP + font::CAP_HEIGHT * TICK_SIZE;
        for k in spaced(&edges, &widths, self.emphasis()) {
            scene.stroke(
                vec![vec![[edges[k], bottom], [edges[k], bottom + MINOR_TICK_LENGTH]]],
                Pen::solid(Color::BLACK, FRAME_WIDTH),
            );
            scene.text(Text {
                anchor: Anchor::Middle,
                ..Text::new(labels[k].clone(), [edges[k], baseline], TICK_SIZE)
            });
        }
        let at = [
            0.5 * (left + right),
            baseline
                + (1.0 - font::CAP_HEIGHT) * TICK_SIZE
                + LABEL_GAP
                + font::CAP_HEIGHT * LABEL_SIZE,
        ];
        scene
            .text(Text { anchor: Anchor::Middle, ..Text::new(self.label.clone(), at, LABEL_SIZE) });
    }

    fn emphasis(&self) -> Option<usize> {
        self.bands.edges().iter().position(|e| Some(*e) == self.bands.emphasis())
    }

    /// Draws the coloured part from `start` (low values) to `end`, and returns where the edges lie along it.
    fn draw_bands(
        &self,
        scene: &mut Scene,
        start: f64,
        end: f64,
        at: impl Fn(f64, f64) -> Point,
    ) -> Vec<f64> {
        let bands = &self.bands;
        let tip = BAR_BREADTH * (end - start).signum();
        let low = if bands.below().is_some() { start + tip } else { start };
        let high = if bands.above().is_some() { end - tip } else { end };
        let n = bands.colors().len();
        let edges: Vec<f64> = (0..=n).map(|k| low + (high - low) * k as f64 / n as f64).collect();
        let box_of = |a: f64, b: f64| -> Vec<Point> {
            vec![at(a, 0.0), at(b, 0.0), at(b, BAR_BREADTH), at(a, BAR_BREADTH)]
        };
        let pointed = |from: f64, to: f64| -> Vec<Point> {
            vec![at(from, 0.0), at(to, 0.5 * BAR_BREADTH), at(from, BAR_BREADTH)]
        };
        if let Some(color) = bands.below() {
            scene.fill(vec![pointed(low, start)], color, 1.0);
        }
        // Painted over one another as in the map, without seams.
        for (k, &color) in bands.colors().iter().enumerate() {
            scene.fill(vec![box_of(edges[k], high)], color, 1.0);
        }
        if let Some(color) = bands.above() {
            scene.fill(vec![pointed(high, end)], color, 1.0);
        }
        let mut outline = vec![at(low, 0.0)];
        outline.push(at(high, 0.0));
        if bands.above().is_some() {
            outline.push(at(end, 0.5 * BAR_BREADTH));
        }
        outline.extend([at(high, BAR_BREADTH), at(low, BAR_BREADTH)]);
        if bands.below().is_some() {
            outline.push(at(start, 0.5 * BAR_BREADTH));
        }
        scene.outline(outline, Pen::solid(Color::BLACK, FRAME_WIDTH));
        edges
    }
}

/// Which labels can stand without touching: the emphasised one, the ends, then every `s`-th with the smallest `s`.
fn spaced(at: &[f64], sizes: &[f64], emphasis: Option<usize>) -> Vec<usize> {
    let fits = |a: usize, b: usize| (at[a] - at[b]).abs() >= 0.5 * (sizes[a] + sizes[b]);
    let origin = emphasis.unwrap_or(0);
    let stride = (1..at.len().max(2))
        .find(|&s| {
            let chosen: Vec<usize> =
                (0..at.len()).filter(|k| k.abs_diff(origin) % s == 0).collect();
            chosen.windows(2).all(|w| fits(w[0], w[1]))
        })
        .unwrap_or(at.len());
    let mut chosen: Vec<usize> =
        (0..at.len()).filter(|k| k.abs_diff(origin) % stride == 0).collect();
    for end in [0, at.len() - 1] {
        if chosen.iter().all(|&k| k != end && fits(k, end)) {
            chosen.push(end);
        }
    }
    chosen.sort_unstable();
    chosen
}

impl ColorBar {
    /// Draws the bar beside or below the plots.
    pub(super) fn draw(&self, scene: &mut Scene, side: Side, plots: &Rect, at: f64) {
        match side {
            Side::Right => self.draw_right(scene, at, plots.top, plots.bottom),
            Side::Below => self.draw_below(scene, at, plots.left, plots.right),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::ColorMap;

    #[test]
    fn labels_agree_in_decimals() {
        let edges = vec![0.0, 0.5, 0.75, 1.0, 2.0];
        let bar = ColorBar::new(Bands::sequential(edges, ColorMap::Viridis).unwrap(), "");
        assert_eq!(bar.labels(), ["0.00", "0.50", "0.75", "1.00", "2.00"]);
    }

    #[test]
    fn long_labels_of_upright_bars_are_broken() {
        let bar = |label| {
            ColorBar::new(Bands::sequential(vec![0.0, 1.0], ColorMap::Viridis).unwrap(), label)
        };
        let long =
            bar("of the most damped wave where stable, of the fastest growing one where not");
        let wrapped = long.wrapped(200.0);
        assert_eq!(wrapped.label.lines().count(), 2);
        assert!(wrapped.label.lines().all(|line| font::width(line, LABEL_SIZE) <= 200.0));
        assert_eq!(wrapped.label.replace('\n', " "), long.label);
        assert!((wrapped.breadth_right() - long.breadth_right() - LINE).abs() < 1e-12);
        assert_eq!(bar("").wrapped(10.0), bar(""));
    }

    #[test]
    fn crowded_labels_keep_the_break_and_never_touch() {
        let at: Vec<f64> = (0..=20).map(|k| 5.0 * f64::from(k)).collect();
        let chosen = spaced(&at, &[12.0; 21], Some(7));
        assert!(chosen.contains(&7));
        assert!(chosen.windows(2).all(|w| at[w[1]] - at[w[0]] >= 12.0));
        assert_eq!(spaced(&at, &[1.0; 21], None).len(), 21);
    }
}
