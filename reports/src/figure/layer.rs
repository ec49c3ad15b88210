//! What is drawn in a panel, in data coordinates.

use super::{Bands, Color, Field, Point};

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
    pub(super) fn lengths(self) -> Option<[f64; 2]> {
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

/// Points, in black, joined by a line or each with a marker.
///
/// A line is broken where a coordinate is not finite or has no place on a logarithmic axis; markers whose centre lies
/// outside the panel are left out.
#[derive(Debug, Clone)]
pub struct Series {
    /// A single point without one of its coordinates is a line across the whole panel.
    pub(super) points: Vec<Point>,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
    pub(super) marker: Option<Marker>,
    pub(super) size: f64,
    pub(super) fill: Option<Color>,
    pub(super) label: String,
}

impl Series {
    /// A line through the points, 1.1 points wide.
    pub fn line(points: impl IntoIterator<Item = (f64, f64)>) -> Series {
        let points = points.into_iter().map(|(x, y)| [x, y]).collect();
        let (color, dash, label) = (Color::BLACK, Dash::Solid, String::new());
        Series { points, color, width: 1.1, dash, marker: None, size: 4.0, fill: None, label }
    }

    /// Markers at the points, filled, 4 points in diameter, with an outline of 0.8 points.
    pub fn markers(points: impl IntoIterator<Item = (f64, f64)>, marker: Marker) -> Series {
        let fill = Some(Color::BLACK);
        Series { marker: Some(marker), fill, width: 0.8, ..Series::line(points) }
    }

    /// The line x = `at` across the panel, thin and grey; axes are not made longer for it.
    pub fn vertical(at: f64) -> Series {
        Series::line([(at, f64::NAN)]).color(Color::GREY).width(0.8)
    }

    /// The line y = `at` across the panel, thin and grey; axes are not made longer for it.
    pub fn horizontal(at: f64) -> Series {
        Series::line([(f64::NAN, at)]).color(Color::GREY).width(0.8)
    }

    /// Sets the colour, that of filled markers too.
    pub fn color(self, color: Color) -> Series {
        Series { color, fill: self.fill.map(|_| color), ..self }
    }

    /// Markers of which there is only the outline: what is below shows through. A white `fill` hides it.
    pub fn open(self) -> Series {
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
    pub(super) width: f64,
    pub(super) values: bool,
    pub(super) label: String,
}

impl Isolines {
    /// The lines of these values.
    pub fn new(field: Field, levels: impl IntoIterator<Item = f64>) -> Isolines {
        let levels = levels.into_iter().collect();
        Isolines { field, levels, width: 0.6, values: true, label: String::new() }
    }
}

/// A short text centred on a point of the data, in black with a white border that keeps it readable.
#[derive(Debug, Clone)]
pub struct Note {
    pub(super) at: Point,
    pub(super) text: String,
}

impl Note {
    /// The text at (`x`, `y`).
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
    Series { width: f64, dash: Dash, size: f64, fill: Option<Color>, label: String }
    FilledContours { label: String }
    Isolines { width: f64, values: bool, label: String }
    Note {}
}

impl Layer {
    /// Its name in the legend; empty if it is not shown there.
    pub(super) fn label(&self) -> &str {
        match self {
            Layer::Series(Series { label, .. })
            | Layer::FilledContours(FilledContours { label, .. })
            | Layer::Isolines(Isolines { label, .. }) => label,
            Layer::Note(_) => "",
        }
    }

    /// The points that an axis without a range should show.
    pub(super) fn extent(&self) -> &[Point] {
        match self {
            // A line across the panel has no length of its own.
            Layer::Series(Series { points, .. }) if !matches!(points[..], [[x, y]] if (x + y).is_nan()) => {
                points
            }
            _ => &[],
        }
    }

    /// The field that it shows.
    pub(super) fn field(&self) -> Option<&Field> {
        match self {
            Layer::FilledContours(FilledContours { field, .. })
            | Layer::Isolines(Isolines { field, .. }) => Some(field),
            _ => None,
        }
    }
}
