//! Colours and the qualitative palette.

/// An opaque sRGB colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Color {
    /// Red, 0 to 255.
    pub red: u8,
    /// Green, 0 to 255.
    pub green: u8,
    /// Blue, 0 to 255.
    pub blue: u8,
}

impl Color {
    /// Black.
    pub const BLACK: Color = Color::rgb(0, 0, 0);
    /// White.
    pub const WHITE: Color = Color::rgb(255, 255, 255);
    /// Middle grey, for what stays in the background.
    pub const GREY: Color = Color::rgb(120, 120, 120);
    /// Okabe–Ito orange.
    pub const ORANGE: Color = Color::rgb(230, 159, 0);
    /// Okabe–Ito sky blue.
    pub const SKY: Color = Color::rgb(86, 180, 233);
    /// Okabe–Ito bluish green.
    pub const GREEN: Color = Color::rgb(0, 158, 115);
    /// Okabe–Ito yellow: too pale for thin lines on white.
    pub const YELLOW: Color = Color::rgb(240, 228, 66);
    /// Okabe–Ito blue.
    pub const BLUE: Color = Color::rgb(0, 114, 178);
    /// Okabe–Ito vermilion.
    pub const VERMILION: Color = Color::rgb(213, 94, 0);
    /// Okabe–Ito reddish purple.
    pub const PURPLE: Color = Color::rgb(204, 121, 167);

    /// Darker than every colour of [`ColorMap::Reds`](super::ColorMap::Reds): what grows beyond the last band.
    pub const DARK_RED: Color = Color::rgb(92, 8, 18);

    /// A colour from its three components.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Color {
        Color { red, green, blue }
    }

    /// The `i`-th colour for curves that must be told apart: the Okabe–Ito palette (Okabe & Ito 2008,
    /// safe under colour blindness), ordered so that the first ones differ most, repeating after seven.
    ///
    /// ```
    /// use courant_reports::figure::Color;
    /// assert_eq!(Color::qualitative(0), Color::BLUE);
    /// assert_eq!(Color::qualitative(7), Color::BLUE);
    /// ```
    pub const fn qualitative(i: usize) -> Color {
        const ORDER: [Color; 7] = [
            Color::BLUE,
            Color::VERMILION,
            Color::GREEN,
            Color::ORANGE,
            Color::PURPLE,
            Color::SKY,
            Color::BLACK,
        ];
        ORDER[i % ORDER.len()]
    }

    /// The colour a fraction `t` of the way to `other`, linear in the sRGB components.
    pub fn mix(self, other: Color, t: f64) -> Color {
        let t = t.clamp(0.0, 1.0);
        // The cast rounds a value already within 0..=255.
        let part = |a: u8, b: u8| (f64::from(a) + t * (f64::from(b) - f64::from(a))).round() as u8;
        Color::rgb(
            part(self.red, other.red),
            part(self.green, other.green),
            part(self.blue, other.blue),
        )
    }

    /// The same colour for plotters.
    pub(super) fn plotters(self) -> plotters::style::RGBColor {
        plotters::style::RGBColor(self.red, self.green, self.blue)
    }
}
