//! Layers made of points: lines, markers, error bars and rules.

use super::{color::Color, geometry::Point};

/// A dash pattern; lengths scale with the width of the line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// Unbroken.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dash, dot.
    DashDotted,
}

impl Dash {
    /// The patterns in turn, for curves that must be told apart without colour.
    pub const fn nth(i: usize) -> Dash {
        [Dash::Solid, Dash::Dashed, Dash::DashDotted, Dash::Dotted][i % 4]
    }

    pub(super) fn lengths(self, width: f64) -> Vec<f64> {
        let pattern: &[f64] = match self {
            Dash::Solid => &[],
            Dash::Dashed => &[4.5, 2.0],
            Dash::Dotted => &[1.0, 1.6],
            Dash::DashDotted => &[5.5, 1.7, 1.1, 1.7],
        };
        pattern.iter().map(|l| l * width.max(0.8)).collect()
    }
}

/// A polyline; it is broken where a coordinate is not finite or has no place on a logarithmic axis.
#[derive(Debug, Clone)]
pub struct Line {
    pub(super) points: Vec<Point>,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
    pub(super) label: String,
}

impl Line {
    /// A black line through the points.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Line {
        Line {
            points: points.into_iter().map(|(x, y)| [x, y]).collect(),
            color: Color::BLACK,
            width: 1.1,
            dash: Dash::Solid,
            label: String::new(),
        }
    }

    /// A line through `(x[i], y[i])`; the longer slice is cut.
    pub fn xy(x: &[f64], y: &[f64]) -> Line {
        Line::new(x.iter().copied().zip(y.iter().copied()))
    }

    /// Sets the colour.
    pub fn color(mut self, color: Color) -> Line {
        self.color = color;
        self
    }

    /// Sets the width in points.
    pub fn width(mut self, width: f64) -> Line {
        self.width = width;
        self
    }

    /// Sets the dash pattern.
    pub fn dash(mut self, dash: Dash) -> Line {
        self.dash = dash;
        self
    }

    /// Names the line in the legend; lines and markers of one name share an entry.
    pub fn label(mut self, label: impl Into<String>) -> Line {
        self.label = label.into();
        self
    }
}

/// The form of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A circle.
    Circle,
    /// A square.
    Square,
    /// A triangle standing on its side.
    Triangle,
    /// A square standing on its corner.
    Diamond,
    /// Two diagonal strokes.
    Cross,
    /// An upright and a level stroke.
    Plus,
}

impl Marker {
    /// The forms in turn.
    pub const fn nth(i: usize) -> Marker {
        [
            Marker::Circle,
            Marker::Square,
            Marker::Triangle,
            Marker::Diamond,
            Marker::Cross,
            Marker::Plus,
        ][i % 6]
    }
}

/// Markers at points; those whose centre lies outside the panel are left out.
#[derive(Debug, Clone)]
pub struct Markers {
    pub(super) points: Vec<Point>,
    pub(super) marker: Marker,
    pub(super) color: Color,
    pub(super) size: f64,
    pub(super) fill: Option<Color>,
    pub(super) width: f64,
    pub(super) label: String,
}

impl Markers {
    /// Filled black markers at the points.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>, marker: Marker) -> Markers {
        Markers {
            points: points.into_iter().map(|(x, y)| [x, y]).collect(),
            marker,
            color: Color::BLACK,
            size: 4.0,
            fill: Some(Color::BLACK),
            width: 0.8,
            label: String::new(),
        }
    }

    /// Sets the colour of outline and filling.
    pub fn color(mut self, color: Color) -> Markers {
        self.color = color;
        self.fill = self.fill.map(|_| color);
        self
    }

    /// Only the outline: what is below shows through.
    pub fn open(mut self) -> Markers {
        self.fill = None;
        self
    }

    /// Sets the filling apart from the outline: white makes open markers that hide what is below.
    pub fn fill(mut self, color: Color) -> Markers {
        self.fill = Some(color);
        self
    }

    /// Sets the diameter in points.
    pub fn size(mut self, size: f64) -> Markers {
        self.size = size;
        self
    }

    /// Sets the width of the outline in points.
    pub fn width(mut self, width: f64) -> Markers {
        self.width = width;
        self
    }

    /// Names the markers in the legend; lines and markers of one name share an entry.
    pub fn label(mut self, label: impl Into<String>) -> Markers {
        self.label = label.into();
        self
    }
}

/// Vertical bars from a lower to an upper value, with caps.
#[derive(Debug, Clone)]
pub struct ErrorBars {
    /// x, lower, upper.
    pub(super) bars: Vec<[f64; 3]>,
    pub(super) color: Color,
    pub(super) width: f64,
}

impl ErrorBars {
    /// Bars `(x, lower, upper)`.
    pub fn new(bars: impl IntoIterator<Item = (f64, f64, f64)>) -> ErrorBars {
        let bars = bars.into_iter().map(|(x, low, high)| [x, low, high]).collect();
        ErrorBars { bars, color: Color::BLACK, width: 0.8 }
    }

    /// Sets the colour.
    pub fn color(mut self, color: Color) -> ErrorBars {
        self.color = color;
        self
    }
}

/// A straight line across the whole panel.
#[derive(Debug, Clone)]
pub struct Rule {
    pub(super) vertical: bool,
    pub(super) at: f64,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
    pub(super) label: String,
}

impl Rule {
    /// The line x = `at`.
    pub fn vertical(at: f64) -> Rule {
        Rule {
            vertical: true,
            at,
            color: Color::GREY,
            width: 0.8,
            dash: Dash::Dashed,
            label: String::new(),
        }
    }

    /// The line y = `at`.
    pub fn horizontal(at: f64) -> Rule {
        Rule { vertical: false, ..Rule::vertical(at) }
    }

    /// Sets the colour.
    pub fn color(mut self, color: Color) -> Rule {
        self.color = color;
        self
    }

    /// Sets the width in points.
    pub fn width(mut self, width: f64) -> Rule {
        self.width = width;
        self
    }

    /// Sets the dash pattern.
    pub fn dash(mut self, dash: Dash) -> Rule {
        self.dash = dash;
        self
    }

    /// Names the line in the legend.
    pub fn label(mut self, label: impl Into<String>) -> Rule {
        self.label = label.into();
        self
    }
}
