//! What is drawn in a panel, in data coordinates.

use super::{
    color::{Bands, Color},
    field::Field,
    geometry::Point,
};

/// How a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Dash {
    Solid,
    Dashed,
    Dotted,
    LongDashed,
}

impl Dash {
    /// The patterns in turn, for curves that must be told apart without colour.
    pub const fn nth(i: usize) -> Dash {
        [Dash::Solid, Dash::Dashed, Dash::LongDashed, Dash::Dotted][i % 4]
    }

    /// Lengths of dash and gap, in multiples of the width.
    pub(super) fn pattern(self) -> Option<[f64; 2]> {
        match self {
            Dash::Solid => None,
            Dash::Dashed => Some([4.5, 2.0]),
            Dash::Dotted => Some([1.0, 1.6]),
            Dash::LongDashed => Some([10.0, 1.8]),
        }
    }
}

/// The form of a marker; a cross has diagonal strokes, a plus upright ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
    Plus,
}

impl Marker {
    /// The forms in turn.
    pub const fn nth(i: usize) -> Marker {
        use Marker::*;
        [Circle, Square, Triangle, Diamond, Cross, Plus][i % 6]
    }
}

/// A polyline, black and 1.1 points wide; it is broken where a coordinate is not finite or has no place on a logarithmic
/// axis.
#[derive(Debug, Clone)]
pub struct Line {
    /// A single point without one of its coordinates is a line across the whole panel.
    pub(super) points: Vec<Point>,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
    pub(super) label: String,
}

impl Line {
    /// A line through the points.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Line {
        let points = points.into_iter().map(|(x, y)| [x, y]).collect();
        Line { points, color: Color::BLACK, width: 1.1, dash: Dash::Solid, label: String::new() }
    }

    /// The line x = `at` across the panel, thin and grey; axes are not made longer for it.
    pub fn vertical(at: f64) -> Line {
        Line::new([(at, f64::NAN)]).color(Color::GREY).width(0.8)
    }

    /// The line y = `at` across the panel, thin and grey; axes are not made longer for it.
    pub fn horizontal(at: f64) -> Line {
        Line::new([(f64::NAN, at)]).color(Color::GREY).width(0.8)
    }
}

/// Markers at points, filled and black, 4 points in diameter; those whose centre lies outside the panel are left out.
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
    /// Markers at the points.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>, marker: Marker) -> Markers {
        let points = points.into_iter().map(|(x, y)| [x, y]).collect();
        let (color, fill, label) = (Color::BLACK, Some(Color::BLACK), String::new());
        Markers { points, marker, color, size: 4.0, fill, width: 0.8, label }
    }

    /// Sets the colour of outline and filling.
    pub fn color(mut self, color: Color) -> Markers {
        self.color = color;
        self.fill = self.fill.map(|_| color);
        self
    }

    /// Only the outline: what is below shows through. A white `fill` hides it.
    pub fn open(self) -> Markers {
        self.fill(None)
    }
}

/// A field painted in bands of value. A name in the legend stands beside the colour of the first band.
#[derive(Debug, Clone)]
pub struct FilledContours {
    pub(super) field: Field,
    pub(super) bands: Bands,
    pub(super) label: String,
}

impl FilledContours {
    /// The field in the colours of the bands.
    pub fn new(field: Field, bands: Bands) -> FilledContours {
        FilledContours { field, bands, label: String::new() }
    }

    /// The region where the field is at least `level`, in one colour.
    pub fn region(field: Field, level: f64, color: Color) -> FilledContours {
        let (edges, colors) = (vec![level, f64::INFINITY], vec![color]);
        FilledContours::new(field, Bands { edges, colors, below: None, above: None })
    }
}

/// Lines of equal value of a field, black and 0.6 points wide, with their values written into them.
#[derive(Debug, Clone)]
pub struct Isolines {
    pub(super) field: Field,
    pub(super) levels: Vec<f64>,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) values: bool,
    pub(super) label: String,
}

impl Isolines {
    /// The lines of these values.
    pub fn new(field: Field, levels: impl IntoIterator<Item = f64>) -> Isolines {
        let (levels, color) = (levels.into_iter().collect(), Color::BLACK);
        Isolines { field, levels, color, width: 0.6, values: true, label: String::new() }
    }
}

/// A short text centred on a point of the data, with a white border that keeps it readable.
#[derive(Debug, Clone)]
pub struct Note {
    pub(super) at: Point,
    pub(super) text: String,
}

impl Note {
    /// A black text.
    pub fn new(x: f64, y: f64, text: impl Into<String>) -> Note {
        Note { at: [x, y], text: text.into() }
    }
}

/// Setters that take the layer and return it, and the layers as one type.
macro_rules! layers {
    ($($name:ident { $($field:ident: $type:ty),* })*) => {
        $(impl $name {$(
            #[doc = concat!("Sets the ", stringify!($field), "; lengths in points.")]
            pub fn $field(mut self, $field: impl Into<$type>) -> $name {
                self.$field = $field.into();
                self
            }
        )*}

        impl From<$name> for Layer {
            fn from(layer: $name) -> Layer {
                Layer::$name(layer)
            }
        })*

        /// Anything that can be drawn in a panel; layers of one label share an entry of the legend.
        #[derive(Debug, Clone)]
        pub enum Layer {
            $(#[doc = concat!("See [`", stringify!($name), "`].")] $name($name),)*
        }
    };
}

layers! {
    Line { color: Color, width: f64, dash: Dash, label: String }
    Markers { fill: Option<Color>, size: f64, width: f64, label: String }
    FilledContours { label: String }
    Isolines { color: Color, width: f64, values: bool, label: String }
    Note {}
}

impl Layer {
    /// The points that an axis without a range should show.
    pub(super) fn extent(&self) -> Vec<Point> {
        match self {
            Layer::Line(Line { points, .. }) if points.len() < 2 => Vec::new(),
            Layer::Line(Line { points, .. }) | Layer::Markers(Markers { points, .. }) => {
                points.clone()
            }
            Layer::FilledContours(FilledContours { field: Field { x, y, .. }, .. })
            | Layer::Isolines(Isolines { field: Field { x, y, .. }, .. }) => {
                x.iter().map(|&x| [x, y[0]]).chain(y.iter().map(|&y| [x[0], y])).collect()
            }
            Layer::Note(_) => Vec::new(),
        }
    }

    /// Whether the layer shows a field.
    pub(super) fn is_map(&self) -> bool {
        matches!(self, Layer::FilledContours(_) | Layer::Isolines(_))
    }
}
