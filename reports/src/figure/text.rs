//! Letters of the bundled font, DejaVu Sans: their widths and their outlines.

use super::{color::Color, geometry::Point};
use ab_glyph::{Font, FontRef, OutlineCurve};
use plotters::style::{
    Color as _, FontTransform, IntoFont, TextStyle,
    text_anchor::{HPos, Pos, VPos},
};
use plotters_backend::BackendTextStyle;
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
const SIZE_OVER_EM: f64 = 1.24;
/// Height of capital letters and digits over the em.
pub(super) const CAP_HEIGHT: f64 = 0.729;
/// Depth of descenders over the em.
pub(super) const DESCENT: f64 = 0.236;

/// The width of a text, in the unit of `size`.
pub(super) fn width(text: &str, size: f64) -> f64 {
    shape(text, |_, _| {}) * size
}

/// Hands over the letters of a text, each with its start in ems, and returns the end of the last one.
fn shape(text: &str, mut letter: impl FnMut(ab_glyph::GlyphId, f64)) -> f64 {
    let em = f64::from(FONT.units_per_em().expect("the bundled font states its units"));
    let (mut x, mut last) = (0.0, None);
    for id in text.chars().map(|c| FONT.glyph_id(c)) {
        x += last.map_or(0.0, |last| f64::from(FONT.kern_unscaled(last, id)));
        letter(id, x / em);
        x += f64::from(FONT.h_advance_unscaled(id));
        last = Some(id);
    }
    x / em
}

/// The letters of a text as closed rings: its baseline begins at `origin` and runs at `angle` (radians,
/// counterclockwise on the page); `em` in units of the page.
pub(super) fn rings(text: &str, origin: Point, em: f64, angle: f64) -> Vec<Vec<Point>> {
    let unit = em / f64::from(FONT.units_per_em().expect("the bundled font states its units"));
    let (sin, cos) = angle.sin_cos();
    let mut rings: Vec<Vec<Point>> = Vec::new();
    shape(text, |id, start| {
        let place = |p: ab_glyph::Point| {
            let (x, y) = (em * start + unit * f64::from(p.x), unit * f64::from(p.y));
            [origin[0] + x * cos - y * sin, origin[1] - x * sin - y * cos]
        };
        let mut end = None;
        for curve in FONT.outline(id).map(|outline| outline.curves).unwrap_or_default() {
            // Quadratic curves are cubic ones; straight lines need no inner points.
            let (a, c, d, b) = match curve {
                OutlineCurve::Line(a, b) => (a, None, None, b),
                OutlineCurve::Quad(a, c, b) => (a, Some(c), None, b),
                OutlineCurve::Cubic(a, c, d, b) => (a, Some(c), Some(d), b),
            };
            if end != Some(a) {
                rings.push(vec![place(a)]);
            }
            let ring = rings.last_mut().expect("a ring was begun");
            if let Some(c) = c {
                ring.extend([0.25, 0.5, 0.75].map(|t| {
                    let at = |from: ab_glyph::Point, to: ab_glyph::Point| {
                        let part = |a: f32, b: f32| a + t * (b - a);
                        ab_glyph::point(part(from.x, to.x), part(from.y, to.y))
                    };
                    let (l, m, r) = (at(a, c), at(c, d.unwrap_or(b)), at(d.unwrap_or(b), b));
                    place(match d {
                        None => at(l, m),
                        Some(_) => at(at(l, m), at(m, r)),
                    })
                }));
            }
            ring.push(place(b));
            end = Some(b);
        }
    });
    rings
}

/// The style of a text for plotters; `size` in points.
pub(super) fn style(size: f64, color: Color, h: HPos, v: VPos) -> TextStyle<'static> {
    let font = (FAMILY, size * POINT * SIZE_OVER_EM).into_font();
    TextStyle { color: color.plotters().to_backend_color(), font, pos: Pos::new(h, v) }
}

/// The em of a style in units of the canvas.
pub(super) fn em<S: BackendTextStyle>(style: &S) -> f64 {
    style.size() / SIZE_OVER_EM
}

/// Width and height of a text without its turn, in units of the canvas.
pub(super) fn extent<S: BackendTextStyle>(text: &str, style: &S) -> (u32, u32) {
    let em = em(style);
    (width(text, em).ceil() as u32, em.ceil() as u32)
}

/// How far below its anchor the baseline of a text lies, in ems: capitals hang from, are centred on and, with their
/// descenders, stand on it.
pub(super) fn drop(v: &VPos) -> f64 {
    match v {
        VPos::Top => 0.76,
        VPos::Center => 0.5 * CAP_HEIGHT,
        VPos::Bottom => -DESCENT,
    }
}

/// The turn of a style in radians, counterclockwise.
pub(super) fn turn(transform: &FontTransform) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI};
    match transform {
        FontTransform::None => 0.0,
        FontTransform::Rotate270 => FRAC_PI_2,
        FontTransform::Rotate180 => PI,
        FontTransform::Rotate90 => -FRAC_PI_2,
    }
}

/// How much of its width a text begins before its anchor.
pub(super) fn back(h: &HPos) -> f64 {
    match h {
        HPos::Left => 0.0,
        HPos::Center => 0.5,
        HPos::Right => 1.0,
    }
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
}
