//! Letters of the bundled font, DejaVu Sans: their widths and their outlines.

use super::geometry::{Point, between};
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, IntoFont, TextStyle};
use std::{ops::Range, sync::LazyLock};

/// The bundled font.
pub(super) const FONT_FILE: &[u8] = include_bytes!("../../fonts/DejaVuSans.ttf");
static FONT: LazyLock<FontRef<'static>> =
    LazyLock::new(|| FontRef::try_from_slice(FONT_FILE).expect("the bundled font is valid"));

/// Units of the canvas in a point.
pub(super) const POINT: f64 = 20.0;
/// The bundled font by name, and what is as wide where a viewer of SVG does not have it.
const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";
/// Plotters' size of a font over its em.
const SIZE_OVER_EM: f64 = 1.24;
/// Height of capital letters and digits over the em.
pub(super) const CAP_HEIGHT: f64 = 0.729;
/// Depth of descenders over the em.
pub(super) const DESCENT: f64 = 0.236;
/// From the upper end of a text to its baseline over the em, as plotters has it in SVG.
pub(super) const ASCENT: f64 = 0.76;

fn units_per_em() -> f64 {
    f64::from(FONT.units_per_em().expect("the bundled font states its units"))
}

/// The letters of a text with their starts, and the end of the last one, in ems.
fn shaped(text: &str) -> (Vec<(GlyphId, f64)>, f64) {
    let mut x = 0.0;
    let mut letters: Vec<(GlyphId, f64)> = Vec::new();
    for id in text.chars().map(|c| FONT.glyph_id(c)) {
        let last = letters.last();
        x += last.map_or(0.0, |last| f64::from(FONT.kern_unscaled(last.0, id))) / units_per_em();
        letters.push((id, x));
        x += f64::from(FONT.h_advance_unscaled(id)) / units_per_em();
    }
    (letters, x)
}

/// The width of a text of `size` points.
pub(super) fn width(text: &str, size: f64) -> f64 {
    shaped(text).1 * size * POINT
}

/// The outlines of a text as closed rings: its capitals are centred on a place, and it runs at `angle` (radians,
/// counterclockwise on the page); `em` in units of the page.
pub(super) fn rings(text: &str, em: f64, [x, y]: Point, angle: f64) -> Vec<Vec<Point>> {
    let (letters, length) = shaped(text);
    let (back, down) = (0.5 * length, 0.5 * CAP_HEIGHT);
    let (sin, cos) = angle.sin_cos();
    let mut rings: Vec<Vec<Point>> = Vec::new();
    for (id, start) in letters {
        let place = |p: ab_glyph::Point| {
            let [along, up] = [p.x, p.y].map(|v| f64::from(v) / units_per_em());
            let (along, up) = (em * (along + start - back), em * (up - down));
            [x + along * cos - up * sin, y - along * sin - up * cos]
        };
        let mut end = None;
        for curve in FONT.outline(id).map(|outline| outline.curves).unwrap_or_default() {
            let (from, control, to, parts) = match curve {
                OutlineCurve::Line(a, b) => (a, a, b, 1),
                OutlineCurve::Quad(a, c, b) => (a, c, b, 4),
                OutlineCurve::Cubic(..) => unreachable!("curves of TrueType are quadratic"),
            };
            if end != Some(from) {
                rings.push(vec![place(from)]);
            }
            let ring = rings.last_mut().expect("a ring was begun");
            let [a, c, b] = [from, control, to].map(place);
            let parts = (1..=parts).map(|k| f64::from(k) / f64::from(parts));
            ring.extend(parts.map(|t| between(between(a, c, t), between(c, b, t), t)));
            end = Some(to);
        }
    }
    rings
}

/// The style of a black text of `size` points, centred above a place.
pub(super) fn above(size: f64) -> TextStyle<'static> {
    let font = (FAMILY, size * POINT * SIZE_OVER_EM).into_font();
    let pos = Pos::new(HPos::Center, VPos::Bottom);
    TextStyle { color: BLACK.to_backend_color(), font, pos }
}

/// The style of a black text of `size` points, to the right of a place.
pub(super) fn beside(size: f64) -> TextStyle<'static> {
    TextStyle { pos: Pos::new(HPos::Left, VPos::Center), ..above(size) }
}

/// Things of these widths in as few lines no longer than `length` as can be, about equally long.
pub(super) fn lines(widths: &[f64], length: f64) -> Vec<Range<usize>> {
    let broken = |length: f64| {
        let mut lines: Vec<Range<usize>> = Vec::new();
        for k in 0..widths.len() {
            match lines.last_mut() {
                Some(line) if widths[line.start..=k].iter().sum::<f64>() <= length => {
                    line.end = k + 1
                }
                _ => lines.push(k..k + 1),
            }
        }
        lines
    };
    let fewest = broken(length);
    let even = widths.iter().sum::<f64>() / fewest.len().max(1) as f64;
    let mut tried = (0..20).map(|k| broken(even + (length - even) * f64::from(k) / 20.0));
    tried.find(|lines| lines.len() <= fewest.len()).unwrap_or(fewest)
}

/// A text of `size` points broken at spaces.
pub(super) fn wrapped(text: &str, size: f64, length: f64) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let space = width(" ", size);
    let widths: Vec<f64> = words.iter().map(|word| width(word, size) + space).collect();
    lines(&widths, length + space).into_iter().map(|line| words[line].join(" ")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scientific_letters_are_there() {
        for letter in "φκΔξωρνλσαβγπ≤≥×·²³⁻¹⁰⁴⁵⁶⁷⁸⁹₀₁₂₃ₓ±−∞√∂|∈→′".chars()
        {
            assert_ne!(FONT.glyph_id(letter).0, 0, "{letter}");
        }
    }

    #[test]
    fn letters_have_their_height_and_width() {
        let rings = rings("H", 1.0, [0.0, 0.0], 0.0);
        let top = rings.iter().flatten().map(|p| -p[1]).fold(0.0, f64::max);
        assert!((top - 0.5 * CAP_HEIGHT).abs() < 0.01, "{top}");
        // Digits share one width and no kerning, so that numbers align.
        assert!((width("0000", 10.0) - 4.0 * width("8", 10.0)).abs() < 1e-9);
    }

    #[test]
    fn long_texts_are_broken() {
        let long = "of the most damped wave where stable, of the fastest growing one where not";
        let lines = wrapped(long, 9.0, 200.0 * POINT);
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|line| width(line, 9.0) <= 200.0 * POINT));
        assert_eq!(lines.join(" "), long);
        assert!(wrapped("", 9.0, 10.0).is_empty());
        // A line holds at least one thing, however short it is.
        assert_eq!(super::lines(&[2.0, 1.0, 1.0], 0.5), [0..1, 1..2, 2..3]);
        assert_eq!(super::lines(&[1.0; 5], 4.0), [0..3, 3..5]);
    }
}
