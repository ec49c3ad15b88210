//! Colours: the qualitative palette, colour maps, and the bands of value that maps are painted in.

use plotters::style::RGBColor;
use plotters::style::colors::colormaps::{ColorMap as _, DerivedColorMap, ViridisRGB};
use plotters_backend::BackendColor;

/// An opaque sRGB colour: red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

/// The Okabe–Ito palette (Okabe & Ito 2008), safe under colour blindness, and more.
#[allow(missing_docs, reason = "the names say it")]
impl Color {
    pub const BLACK: Color = Color(0, 0, 0);
    pub const WHITE: Color = Color(255, 255, 255);
    /// For what stays in the background.
    pub const GREY: Color = Color(120, 120, 120);
    pub const ORANGE: Color = Color(230, 159, 0);
    pub const SKY: Color = Color(86, 180, 233);
    pub const GREEN: Color = Color(0, 158, 115);
    /// Too pale for thin lines on white.
    pub const YELLOW: Color = Color(240, 228, 66);
    pub const BLUE: Color = Color(0, 114, 178);
    pub const VERMILION: Color = Color(213, 94, 0);
    pub const PURPLE: Color = Color(204, 121, 167);
    /// Darker than every colour of [`ColorMap::Reds`]: what grows beyond the last band.
    pub const DARK_RED: Color = Color(92, 8, 18);

    /// The `i`-th colour for curves that must be told apart, ordered so that the first ones differ most; repeats after
    /// seven.
    ///
    /// ```
    /// use courant_reports::figure::Color;
    /// assert_eq!(Color::qualitative(7), Color::BLUE);
    /// ```
    pub const fn qualitative(i: usize) -> Color {
        use Color as C;
        [C::BLUE, C::VERMILION, C::GREEN, C::ORANGE, C::PURPLE, C::SKY, C::BLACK][i % 7]
    }

    fn from_hex(rgb: u32) -> Color {
        let [_, red, green, blue] = rgb.to_be_bytes();
        Color(red, green, blue)
    }

    /// The colour a fraction `t` of the way to `other`, linear in the sRGB components.
    pub fn mix(self, other: Color, t: f64) -> Color {
        along(&[self, other], t)
    }
}

/// The colour at `t` in 0..=1 along some at equal distances.
fn along(stops: &[Color], t: f64) -> Color {
    let stops: Vec<RGBColor> = stops.iter().map(|c| RGBColor(c.0, c.1, c.2)).collect();
    opaque(DerivedColorMap::new(&stops).get_color(t))
}

impl plotters::style::Color for Color {
    fn to_backend_color(&self) -> BackendColor {
        BackendColor { alpha: 1.0, rgb: (self.0, self.1, self.2) }
    }
}

fn opaque(RGBColor(red, green, blue): RGBColor) -> Color {
    Color(red, green, blue)
}

/// A continuous, colour-blind-safe sequence of colours over 0..=1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorMap {
    /// Dark violet to yellow, perceptually uniform (van der Walt & Smith 2015).
    Viridis,
    /// Near-white to dark blue.
    Blues,
    /// Near-white over orange to dark red.
    Reds,
    /// Dark blue over near-white, at a half, to dark red: for quantities whose sign matters.
    BluesReds,
}

const BLUES: [u32; 5] = [0xf7f9fb, 0xcbe1ef, 0x86bbda, 0x3a83b9, 0x144880];
const REDS: [u32; 5] = [0xfbf8f6, 0xfdd9b8, 0xf7a56a, 0xd65634, 0x89161c];

impl ColorMap {
    /// The colour at `t` in 0..=1; values outside are clamped.
    pub fn at(self, t: f64) -> Color {
        match self {
            ColorMap::Viridis => opaque(ViridisRGB.get_color(t)),
            ColorMap::Blues => along(&BLUES.map(Color::from_hex), t),
            ColorMap::Reds => along(&REDS.map(Color::from_hex), t),
            ColorMap::BluesReds if t < 0.5 => ColorMap::Blues.at(1.0 - 2.0 * t),
            ColorMap::BluesReds => ColorMap::Reds.at(2.0 * t - 1.0),
        }
    }
}

/// Values cut into bands, each with its colour: what contours and their colour bar share.
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    pub(super) edges: Vec<f64>,
    pub(super) colors: Vec<Color>,
    pub(super) below: Option<Color>,
    pub(super) above: Option<Color>,
}

impl Bands {
    /// Bands `edges[k] <= v < edges[k+1]` in colours at equal steps along a map from 0 to 1, its ends included. Smaller
    /// values stay blank, larger ones have the last colour.
    ///
    /// # Panics
    /// If there are fewer than two edges, or they do not increase.
    pub fn new(edges: Vec<f64>, color: impl Fn(f64) -> Color) -> Bands {
        assert!(edges.len() > 1 && edges.windows(2).all(|w| w[0] < w[1]), "edges {edges:?}");
        let bands = edges.len() - 1;
        let step = 1.0 / (bands.max(2) - 1) as f64;
        let colors = (0..bands).map(|k| color(k as f64 * step)).collect();
        Bands { edges, colors, below: None, above: None }
    }

    /// Lower edges and colours from the lowest band to the highest.
    pub(super) fn ascending(&self) -> impl Iterator<Item = (f64, Color)> {
        let last = self.edges[self.edges.len() - 1].next_up();
        let below = self.below.map(|color| (f64::NEG_INFINITY, color));
        let inner = self.edges.iter().copied().zip(self.colors.iter().copied());
        below.into_iter().chain(inner).chain(self.above.map(|color| (last, color)))
    }

    /// Paints values below the first edge too; the colour bar shows a pointed end.
    pub fn extend_below(mut self, color: Color) -> Bands {
        self.below = Some(color);
        self
    }

    /// Paints values above the last edge apart; the colour bar shows a pointed end.
    pub fn extend_above(mut self, color: Color) -> Bands {
        self.above = Some(color);
        self
    }

    /// The same bands, without the ends that none of the values needs: a colour bar must not promise what is not drawn.
    pub fn needed_for(mut self, values: impl Iterator<Item = f64> + Clone) -> Bands {
        let (first, last) = (self.edges[0], self.edges[self.edges.len() - 1]);
        self.below = self.below.filter(|_| values.clone().any(|value| value < first));
        self.above = self.above.filter(|_| values.clone().any(|value| value > last));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_tell_the_sign() {
        let bands =
            Bands::new(vec![-2.0, -1.0, -0.5, 0.5, 1.0, 2.0], |t| ColorMap::BluesReds.at(t));
        let redness = bands.colors.iter().map(|c| (i32::from(c.0) - i32::from(c.2)) / 20);
        assert_eq!(redness.map(i32::signum).collect::<Vec<_>>(), [-1, -1, 0, 1, 1]);
        assert_eq!(Color::BLACK.mix(Color::WHITE, 0.5), Color(128, 128, 128));
    }

    #[test]
    fn ends_stay_where_values_lie_beyond_them() {
        let bands = Bands::new(vec![0.0, 1.0, 2.0], |t| ColorMap::Blues.at(t));
        let bands = bands.extend_below(Color::BLACK).extend_above(Color::GREY);
        let ends = |values: &[f64]| {
            let bands = bands.clone().needed_for(values.iter().copied());
            (bands.below.is_some(), bands.above.is_some())
        };
        assert_eq!(ends(&[0.0, 1.3, 2.0, f64::NAN]), (false, false));
        assert_eq!(ends(&[2f64.next_up()]), (false, true));
        assert_eq!(ends(&[-1e-9, 1.0]), (true, false));
    }
}
