//! Colour scales: from values to colours, in discrete bands.

use super::{color::Color, error::FigureError};

/// A continuous, colour-blind-safe sequence of colours over 0..=1, linear in sRGB between equidistant control colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorMap {
    /// Dark violet to yellow, perceptually uniform (van der Walt & Smith 2015).
    Viridis,
    /// Near-white to dark blue: the lower half of a two-sided scale, away from the break.
    Blues,
    /// Near-white over orange to dark red: the upper half of a two-sided scale, away from the break.
    Reds,
}

const VIRIDIS: [Color; 9] = [
    Color::rgb(68, 1, 84),
    Color::rgb(71, 45, 123),
    Color::rgb(59, 82, 139),
    Color::rgb(44, 114, 142),
    Color::rgb(33, 145, 140),
    Color::rgb(40, 174, 128),
    Color::rgb(94, 201, 98),
    Color::rgb(173, 220, 48),
    Color::rgb(253, 231, 37),
];
const BLUES: [Color; 5] = [
    Color::rgb(247, 249, 251),
    Color::rgb(203, 225, 239),
    Color::rgb(134, 187, 218),
    Color::rgb(58, 131, 185),
    Color::rgb(20, 72, 128),
];
const REDS: [Color; 5] = [
    Color::rgb(251, 248, 246),
    Color::rgb(253, 217, 184),
    Color::rgb(247, 165, 106),
    Color::rgb(214, 86, 52),
    Color::rgb(137, 22, 28),
];

impl ColorMap {
    /// The colour at `t` in 0..=1; values outside are clamped.
    pub fn at(self, t: f64) -> Color {
        let stops: &[Color] = match self {
            ColorMap::Viridis => &VIRIDIS,
            ColorMap::Blues => &BLUES,
            ColorMap::Reds => &REDS,
        };
        let s = t.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let i = (s as usize).min(stops.len() - 2);
        stops[i].mix(stops[i + 1], s - i as f64)
    }
}

/// Values cut into bands, each with its colour: what filled contours and their colour bar share.
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    edges: Vec<f64>,
    colors: Vec<Color>,
    below: Option<Color>,
    above: Option<Color>,
    emphasis: Option<f64>,
}

impl Bands {
    /// Bands `edges[k] <= v < edges[k+1]` (the last one closed) in the colour `colors[k]`. Values outside stay blank.
    ///
    /// # Errors
    /// If there are fewer than two edges, they do not increase, or there is not one colour per band.
    pub fn new(edges: Vec<f64>, colors: Vec<Color>) -> Result<Bands, FigureError> {
        if edges.len() < 2 || !super::contour::strictly_increasing(&edges) {
            return Err(FigureError::NotIncreasing { what: "band edges (at least two)" });
        }
        if colors.len() + 1 != edges.len() {
            return Err(FigureError::BandColors { edges: edges.len(), colors: colors.len() });
        }
        Ok(Bands { edges, colors, below: None, above: None, emphasis: None })
    }

    /// Bands in colours taken at equal steps along a map, from its first to its last colour.
    ///
    /// # Errors
    /// As [`Bands::new`].
    ///
    /// ```
    /// use courant_reports::figure::{Bands, ColorMap};
    /// let bands = Bands::sequential(vec![0.0, 0.5, 1.0], ColorMap::Viridis)?;
    /// assert_eq!(bands.colors()[0], ColorMap::Viridis.at(0.0));
    /// # Ok::<(), courant_reports::figure::FigureError>(())
    /// ```
    pub fn sequential(edges: Vec<f64>, map: ColorMap) -> Result<Bands, FigureError> {
        let n = edges.len().saturating_sub(1);
        let step = 1.0 / (n.max(2) - 1) as f64;
        let colors = (0..n).map(|k| map.at(k as f64 * step)).collect();
        Bands::new(edges, colors)
    }

    /// Bands in blue below `at` and orange to red above it, palest at the break: for quantities with a meaningful
    /// threshold, as |g| = 1. Colours count bands from the break, so both sides are used fully whatever the edges.
    ///
    /// # Errors
    /// As [`Bands::new`], or if `at` is not one of the edges.
    pub fn two_sided(edges: Vec<f64>, at: f64) -> Result<Bands, FigureError> {
        let split = edges.iter().position(|&e| e == at).ok_or(FigureError::BreakNotAnEdge(at))?;
        let (low, high) = (split, edges.len() - 1 - split);
        // Band centres: the palest band is tinted, so that the two sides of the break differ.
        let side = |map: ColorMap, k: usize, n: usize| map.at((k as f64 + 0.6) / (n as f64 + 0.1));
        let colors = (0..low)
            .rev()
            .map(|k| side(ColorMap::Blues, k, low))
            .chain((0..high).map(|k| side(ColorMap::Reds, k, high)))
            .collect();
        let mut bands = Bands::new(edges, colors)?;
        bands.emphasis = Some(at);
        Ok(bands)
    }

    /// Paints values below the first edge too; the colour bar shows a pointed end.
    pub fn extend_below(mut self, color: Color) -> Bands {
        self.below = Some(color);
        self
    }

    /// Paints values above the last edge too; the colour bar shows a pointed end.
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

    /// The band edges.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// The colours of the bands, one fewer than the edges.
    pub fn colors(&self) -> &[Color] {
        &self.colors
    }

    /// The colour of values below the first edge, if they are painted.
    pub fn below(&self) -> Option<Color> {
        self.below
    }

    /// The colour of values above the last edge, if they are painted.
    pub fn above(&self) -> Option<Color> {
        self.above
    }

    /// The break of a two-sided scale: its edge is always labelled.
    pub fn emphasis(&self) -> Option<f64> {
        self.emphasis
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viridis_grows_lighter_in_even_steps() {
        // CIE lightness, how bright a colour looks; that of the original map is linear.
        let lightness = |c: Color| {
            let linear = |c: u8| ((f64::from(c) / 255.0 + 0.055) / 1.055).powf(2.4);
            let y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
            116.0 * y.cbrt() - 16.0
        };
        let at = |t: f64| lightness(ColorMap::Viridis.at(t));
        for t in (0..=64).map(|i| f64::from(i) / 64.0) {
            assert!((at(t) - (at(0.0) + t * (at(1.0) - at(0.0)))).abs() < 3.0, "{t}");
        }
    }

    #[test]
    fn two_sided_breaks_exactly_at_the_value() {
        let bands = Bands::two_sided(vec![0.0, 0.5, 0.9, 1.0, 1.1, 2.0], 1.0).unwrap();
        let blue = bands.colors().iter().map(|c| c.blue > c.red);
        assert_eq!(blue.collect::<Vec<_>>(), [true, true, true, false, false]);
        let wrong = Bands::two_sided(vec![0.0, 2.0], 1.0);
        assert!(matches!(wrong, Err(FigureError::BreakNotAnEdge(_))));
    }

    #[test]
    fn ends_stay_where_values_lie_beyond_them() {
        let bands = Bands::sequential(vec![0.0, 1.0, 2.0], ColorMap::Blues).unwrap();
        let bands = bands.extend_below(Color::BLACK).extend_above(Color::GREY);
        let ends = |values: &[f64]| {
            let bands = bands.clone().needed_for(values.iter().copied());
            (bands.below().is_some(), bands.above().is_some())
        };
        assert_eq!(ends(&[0.0, 1.3, 2.0, f64::NAN]), (false, false));
        assert_eq!(ends(&[2f64.next_up()]), (false, true));
        assert_eq!(ends(&[-1e-9, 1.0]), (true, false));
    }

    #[test]
    fn wrong_bands_are_errors() {
        assert!(Bands::sequential(vec![0.0, 0.0], ColorMap::Reds).is_err());
        assert!(Bands::new(vec![0.0, 1.0], vec![]).is_err());
    }
}
