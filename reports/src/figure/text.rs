//! Letters of the bundled font, DejaVu Sans: their widths and their outlines.

use super::geometry::Point;
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve, point};
use plotters::style::{
    BLACK, Color as _, IntoFont, TextStyle,
    text_anchor::{HPos, Pos, VPos},
};
use std::sync::LazyLock;

static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(include_bytes!("../../fonts/DejaVuSans.ttf"))
        .expect("the bundled font is valid")
});

/// Units of the canvas in a point.
pub(super) const POINT: f64 = 20.0;
/// The bundled font by name, and what is as wide where a viewer of SVG does not have it.
const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";
/// Plotters' size of a font over its em.
pub(super) const SIZE_OVER_EM: f64 = 1.24;
/// Height of capital letters and digits over the em.
pub(super) const CAP_HEIGHT: f64 = 0.729;
/// Depth of descenders over the em.
pub(super) const DESCENT: f64 = 0.236;

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

/// The width of a text, in the unit of `size`.
pub(super) fn width(text: &str, size: f64) -> f64 {
    shaped(text).1 * size
}

/// The letters of a text as closed rings: its baseline begins at `origin` and runs at `angle` (radians,
/// counterclockwise on the page); `em` in units of the page.
pub(super) fn rings(text: &str, origin: Point, em: f64, angle: f64) -> Vec<Vec<Point>> {
    let (sin, cos) = angle.sin_cos();
    let mut rings: Vec<Vec<Point>> = Vec::new();
    for (id, start) in shaped(text).0 {
        let place = |p: ab_glyph::Point| {
            let [x, y] = [p.x, p.y].map(|v| em * f64::from(v) / units_per_em());
            let x = x + em * start;
            [origin[0] + x * cos - y * sin, origin[1] - x * sin - y * cos]
        };
        let mut end = None;
        for curve in FONT.outline(id).map(|outline| outline.curves).unwrap_or_default() {
            let controls = match curve {
                OutlineCurve::Line(a, b) => vec![a, b],
                OutlineCurve::Quad(a, c, b) => vec![a, c, b],
                OutlineCurve::Cubic(a, c, d, b) => vec![a, c, d, b],
            };
            if end != Some(controls[0]) {
                rings.push(vec![place(controls[0])]);
            }
            let parts: &[f32] = if controls.len() == 2 { &[1.0] } else { &[0.25, 0.5, 0.75, 1.0] };
            for t in parts {
                let mut points = controls.clone();
                while points.len() > 1 {
                    let part = |a: f32, b: f32| a + t * (b - a);
                    let pair =
                        |w: &[ab_glyph::Point]| point(part(w[0].x, w[1].x), part(w[0].y, w[1].y));
                    points = points.windows(2).map(pair).collect();
                }
                rings.last_mut().expect("a ring was begun").push(place(points[0]));
            }
            end = controls.last().copied();
        }
    }
    rings
}

/// The style of a black text for plotters; `size` in points.
pub(super) fn style(size: f64, h: HPos, v: VPos) -> TextStyle<'static> {
    let font = (FAMILY, size * POINT * SIZE_OVER_EM).into_font();
    TextStyle { color: BLACK.to_backend_color(), font, pos: Pos::new(h, v) }
}

/// A text of `size` points broken at spaces into as few lines no longer than `length` as can be, about equally long.
pub(super) fn wrapped(text: &str, size: f64, length: f64) -> Vec<String> {
    let width = |text: &str| width(text, size * POINT);
    let broken = |length: f64| {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split(' ').filter(|word| !word.is_empty()) {
            match lines.last_mut() {
                Some(line) if width(&format!("{line} {word}")) <= length => {
                    *line += &format!(" {word}")
                }
                _ => lines.push(word.into()),
            }
        }
        lines
    };
    let fewest = broken(length);
    let even = width(text) / fewest.len().max(1) as f64;
    let mut lengths = (0..20).map(|k| even + (length - even) * f64::from(k) / 20.0).map(broken);
    lengths.find(|lines| lines.len() <= fewest.len()).unwrap_or(fewest)
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
        let rings = rings("H", [0.0, 0.0], 1.0, 0.0);
        let top = rings.iter().flatten().map(|p| -p[1]).fold(0.0, f64::max);
        assert!((top - CAP_HEIGHT).abs() < 0.01, "{top}");
        // Digits share one width and no kerning, so that numbers align.
        assert!((width("0000", 10.0) - 4.0 * width("8", 10.0)).abs() < 1e-9);
    }

    #[test]
    fn long_texts_are_broken() {
        let long = "of the most damped wave where stable, of the fastest growing one where not";
        let lines = wrapped(long, 9.0, 200.0 * POINT);
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|l| width(l, 9.0) <= 200.0));
        assert_eq!(lines.join(" "), long);
        assert!(wrapped("", 9.0, 10.0).is_empty());
    }
}
