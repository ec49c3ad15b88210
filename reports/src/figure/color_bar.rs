//! Colour bars: the bands of a map and their edges.

use super::{
    color::Color,
    colormap::Bands,
    geometry::{Point, Rect},
    number::format_numbers,
    panel::{Canvas, Drawn, FRAME_WIDTH, LABEL_GAP, LABEL_SIZE, TICK, TICK_SIZE},
    picture::{Pen, Picture},
    text::{self, POINT},
};
use plotters::style::{
    FontTransform,
    text_anchor::{HPos, VPos},
};
use plotters_backend::DrawingBackend;

const BREADTH: f64 = 9.0 * POINT;
/// Between the two halves of a bar for two quantities.
const BREAK: f64 = 5.0 * POINT;
/// From line to line of a label.
const LINE: f64 = 1.25 * LABEL_SIZE * POINT;

/// The key to the colours of filled contours: all bands equally long, their edges labelled; set apart by lines where
/// their steps are not even.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorBar {
    bands: Bands,
    /// Of the whole bar, or of its part below the break and its part above.
    labels: Vec<String>,
}

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
        ColorBar { bands, labels: vec![label.into()] }
    }

    /// The bar of bands that show one quantity below their break and another one above: broken there, a label beside
    /// each part.
    pub fn of_two(bands: Bands, below: impl Into<String>, above: impl Into<String>) -> ColorBar {
        let labels = match bands.emphasis() {
            Some(_) => vec![below.into(), above.into()],
            None => vec![format!("{}; {}", below.into(), above.into())],
        };
        ColorBar { bands, labels }
    }

    /// How many bands lie below the break of a broken bar.
    fn broken_at(&self) -> Option<usize> {
        let at = self.bands.edges().iter().position(|e| Some(*e) == self.bands.emphasis())?;
        (self.labels.len() > 1).then_some(at)
    }

    /// Where each band begins and ends on a bar from `start` (low values) to `end`, tips left out.
    fn places(&self, start: f64, end: f64) -> Vec<[f64; 2]> {
        let (sign, n) = ((end - start).signum(), self.bands.colors().len());
        let low = start + if self.bands.below().is_some() { sign * BREADTH } else { 0.0 };
        let high = end - if self.bands.above().is_some() { sign * BREADTH } else { 0.0 };
        let gap = if self.broken_at().is_some() { sign * BREAK } else { 0.0 };
        let step = (high - low - gap) / n as f64;
        let beyond = |k: usize| if self.broken_at().is_some_and(|b| k >= b) { gap } else { 0.0 };
        (0..n).map(|k| [k, k + 1].map(|edge| low + step * edge as f64 + beyond(k))).collect()
    }

    /// The lines of each label where its part of a bar of this length has room for so much.
    fn lines(&self, length: f64) -> Vec<Vec<String>> {
        let n = self.bands.colors().len() as f64;
        let parts = match self.broken_at() {
            Some(at) => vec![at as f64 / n, 1.0 - at as f64 / n],
            None => vec![1.0],
        };
        self.labels.iter().zip(parts).map(|(label, part)| wrapped(label, part * length)).collect()
    }

    /// Breadth of the bar with its labels beside plots of this length together.
    pub(super) fn breadth(&self, side: Side, length: f64) -> f64 {
        let numbers = match side {
            Side::Right => widest(&format_numbers(self.bands.edges())),
            Side::Below => TICK_SIZE * POINT,
        };
        let lines = self.lines(length).iter().map(Vec::len).max().unwrap_or(0) as f64;
        BREADTH + 2.0 * TICK + numbers + LABEL_GAP + lines * LINE
    }

    /// Draws the bar along the plots, its near side `at`.
    pub(super) fn draw<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        side: Side,
        plots: &Rect,
        at: f64,
    ) -> Drawn<DB> {
        let numbers = format_numbers(self.bands.edges());
        // The numbers at the ends of a level bar must not stick out of the page.
        let inset = 0.5 * widest(&numbers);
        let (start, end) = match side {
            Side::Right => (plots.bottom, plots.top),
            Side::Below => (plots.left + inset, plots.right - inset),
        };
        let place = |along: f64, across: f64| match side {
            Side::Right => [at + across, along],
            Side::Below => [along, at + across],
        };
        let unit = |p: Point| (p[0].round() as i32, p[1].round() as i32);
        let places = self.places(start, end);
        let mut picture = self.picture(&places, [start, end], place);
        // An edge lies in the middle of the break.
        let first = places.first().map(|p| p[0]);
        let last = places.last().map(|p| p[1]);
        let inner = places.windows(2).map(|w| 0.5 * (w[0][1] + w[1][0]));
        let edges: Vec<f64> = first.into_iter().chain(inner).chain(last).collect();
        let room: Vec<f64> = match side {
            Side::Right => vec![1.15 * TICK_SIZE * POINT; edges.len()],
            Side::Below => {
                let width = |n: &String| text::width(n, TICK_SIZE) + 0.8 * TICK_SIZE;
                numbers.iter().map(|n| width(n) * POINT).collect()
            }
        };
        let emphasis = self.bands.edges().iter().position(|e| Some(*e) == self.bands.emphasis());
        let (h, v) = match side {
            Side::Right => (HPos::Left, VPos::Center),
            Side::Below => (HPos::Center, VPos::Top),
        };
        let style = text::style(TICK_SIZE, Color::BLACK, h, v);
        for k in spaced(&edges, &room, emphasis) {
            if self.broken_at() != Some(k) {
                let tick = [place(edges[k], BREADTH), place(edges[k], BREADTH + TICK)];
                picture.stroke(&tick, Pen::solid(Color::BLACK, FRAME_WIDTH));
            }
            let at = place(edges[k], BREADTH + 2.0 * TICK);
            canvas.draw_text(&numbers[k], &style, unit(at))?;
        }
        canvas.draw(&picture)?;
        let length = (end - start).abs();
        let across = self.breadth(side, length);
        let middles = match self.broken_at() {
            Some(k) => vec![0.5 * (start + places[k - 1][1]), 0.5 * (places[k][0] + end)],
            None => vec![0.5 * (start + end)],
        };
        let upright = text::style(LABEL_SIZE, Color::BLACK, HPos::Center, VPos::Bottom)
            .transform(FontTransform::Rotate270);
        let level = text::style(LABEL_SIZE, Color::BLACK, HPos::Center, VPos::Bottom);
        let style = if side == Side::Right { &upright } else { &level };
        let all = self.lines(length);
        let most = all.iter().map(Vec::len).max().unwrap_or(0);
        for (lines, middle) in all.iter().zip(middles) {
            for (k, line) in lines.iter().enumerate() {
                let at = place(middle, across - (most - 1 - k) as f64 * LINE);
                canvas.draw_text(line, style, unit(at))?;
            }
        }
        Ok(())
    }

    /// The coloured part.
    fn picture(
        &self,
        places: &[[f64; 2]],
        [start, end]: [f64; 2],
        place: impl Fn(f64, f64) -> Point,
    ) -> Picture {
        let mut picture = Picture::default();
        let pen = Pen::solid(Color::BLACK, FRAME_WIDTH);
        let mut add = |ring: Vec<Point>, color: Color, outlined: bool| {
            if outlined {
                picture.outline(&ring, pen);
            } else {
                picture.fill(&[ring], color, 1.0);
            }
        };
        let edges = self.bands.edges();
        let steps = || edges.windows(2).map(|w| w[1] - w[0]);
        let even = steps().all(|s| (s - (edges[1] - edges[0])).abs() < 1e-9 * s.abs());
        let rect = |[a, b]: [f64; 2]| {
            vec![place(a, 0.0), place(b, 0.0), place(b, BREADTH), place(a, BREADTH)]
        };
        let tip = |from: f64, to: f64| {
            vec![place(from, 0.0), place(to, 0.5 * BREADTH), place(from, BREADTH)]
        };
        let ends = [places[0][0], places[places.len() - 1][1]];
        let tips =
            [(self.bands.below(), tip(ends[0], start)), (self.bands.above(), tip(ends[1], end))];
        for outlined in [false, true] {
            for (&color, &place) in self.bands.colors().iter().zip(places) {
                // One frame around even bands.
                if !(outlined && even) {
                    add(rect(place), color, outlined);
                }
            }
            if outlined && even {
                add(rect(ends), Color::BLACK, true);
            }
            for (color, tip) in &tips {
                color.iter().for_each(|&color| add(tip.clone(), color, outlined));
            }
        }
        picture
    }
}

/// The width of the widest number at a tick.
pub(super) fn widest<T: AsRef<str>>(numbers: &[T]) -> f64 {
    numbers.iter().map(|n| text::width(n.as_ref(), TICK_SIZE * POINT)).fold(0.0, f64::max)
}

/// A label broken at spaces into as few lines no longer than `length` as can be, about equally long.
fn wrapped(label: &str, length: f64) -> Vec<String> {
    let width = |text: &str| text::width(text, LABEL_SIZE * POINT);
    let broken = |length: f64| {
        let mut lines: Vec<String> = Vec::new();
        for word in label.split_whitespace() {
            match lines.last_mut() {
                Some(line) if width(&format!("{line} {word}")) <= length => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.into()),
            }
        }
        lines
    };
    let fewest = broken(length);
    let even = width(label) / fewest.len().max(1) as f64;
    let mut lengths = (0..20).map(|k| even + (length - even) * f64::from(k) / 20.0).map(broken);
    lengths.find(|lines| lines.len() <= fewest.len()).unwrap_or(fewest)
}

/// Which labels can stand without touching: the emphasised one, the ends, then every `s`-th with the smallest `s`.
fn spaced(at: &[f64], sizes: &[f64], emphasis: Option<usize>) -> Vec<usize> {
    let fits = |a: usize, b: usize| (at[a] - at[b]).abs() >= 0.5 * (sizes[a] + sizes[b]);
    let every = |s: usize| -> Vec<usize> {
        (0..at.len()).filter(|k| k.abs_diff(emphasis.unwrap_or(0)) % s == 0).collect()
    };
    let apart = |s: &usize| every(*s).windows(2).all(|w| fits(w[0], w[1]));
    let mut chosen = every((1..at.len()).find(apart).unwrap_or(at.len()));
    for end in [0, at.len() - 1] {
        if chosen.iter().all(|&k| k != end && fits(k, end)) {
            chosen.push(end);
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_labels_are_broken() {
        let long = "of the most damped wave where stable, of the fastest growing one where not";
        let lines = wrapped(long, 200.0 * POINT);
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|l| text::width(l, LABEL_SIZE) <= 200.0));
        assert_eq!(lines.join(" "), long);
        assert!(wrapped("", 10.0).is_empty());
    }

    #[test]
    fn bands_of_a_broken_bar_are_equally_long() {
        let bands = Bands::two_sided(vec![0.0, 0.5, 1.0, 2.0], 1.0).unwrap();
        let places =
            ColorBar::of_two(bands.extend_above(Color::DARK_RED), "a", "b").places(0.0, 1000.0);
        let length = (1000.0 - BREAK - BREADTH) / 3.0;
        assert!(places.iter().all(|p| (p[1] - p[0] - length).abs() < 1e-9));
        assert!((places[2][0] - places[1][1] - BREAK).abs() < 1e-9);
    }

    #[test]
    fn crowded_labels_keep_the_break_and_never_touch() {
        let at: Vec<f64> = (0..=20).map(|k| 5.0 * f64::from(k)).collect();
        let mut chosen = spaced(&at, &[12.0; 21], Some(7));
        chosen.sort_unstable();
        assert!(chosen.contains(&7));
        assert!(chosen.windows(2).all(|w| at[w[1]] - at[w[0]] >= 12.0));
        assert_eq!(spaced(&at, &[1.0; 21], None).len(), 21);
    }
}
