//! The bundled font, DejaVu Sans: widths and outlines of its letters.

use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve, Point};
use std::sync::LazyLock;

static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(include_bytes!("../../fonts/DejaVuSans.ttf"))
        .expect("the bundled font is valid")
});

/// Height of capital letters and digits, as a fraction of the size.
pub(super) const CAP_HEIGHT: f64 = 0.729;
/// Depth of descenders, as a fraction of the size.
pub(super) const DESCENT: f64 = 0.236;

/// Font units in the height of a line.
pub(super) fn units_per_em() -> f64 {
    f64::from(FONT.units_per_em().expect("the bundled font states its units"))
}

/// The letters of a text, each with its start in font units, and the end of the last one.
pub(super) fn shape(text: &str) -> (Vec<(GlyphId, f64)>, f64) {
    let mut x = 0.0;
    let mut last = None;
    let mut glyphs = Vec::new();
    for letter in text.chars() {
        let id = FONT.glyph_id(letter);
        if let Some(last) = last {
            x += f64::from(FONT.kern_unscaled(last, id));
        }
        glyphs.push((id, x));
        x += f64::from(FONT.h_advance_unscaled(id));
        last = Some(id);
    }
    (glyphs, x)
}

/// The width of a text, in the unit of `size`.
pub(super) fn width(text: &str, size: f64) -> f64 {
    shape(text).1 * size / units_per_em()
}

/// The contours of a letter in font units, y upwards, each a chain of curves; none for a space.
pub(super) fn contours(glyph: GlyphId) -> Vec<Vec<OutlineCurve>> {
    let curves = FONT.outline(glyph).map(|outline| outline.curves).unwrap_or_default();
    curves.chunk_by(|a, b| ends(a).1 == ends(b).0).map(<[_]>::to_vec).collect()
}

/// Where a curve begins and where it ends.
pub(super) fn ends(curve: &OutlineCurve) -> (Point, Point) {
    match *curve {
        OutlineCurve::Line(a, b)
        | OutlineCurve::Quad(a, _, b)
        | OutlineCurve::Cubic(a, _, _, b) => (a, b),
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
    fn capitals_have_the_stated_height() {
        let top = |c| {
            let bounds = FONT.outline(FONT.glyph_id(c)).unwrap().bounds;
            f64::from(bounds.min.y.max(bounds.max.y)) / units_per_em()
        };
        assert!((top('H') - CAP_HEIGHT).abs() < 0.01, "{}", top('H'));
    }

    #[test]
    fn widths_add_up() {
        // Digits share one width and no kerning, so that tick labels align.
        assert!((width("0000", 10.0) - 4.0 * width("8", 10.0)).abs() < 1e-9);
        assert!(width("", 10.0) == 0.0);
    }
}
