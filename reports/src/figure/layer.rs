//! What is drawn in a panel, in data coordinates.

use super::{color::Color, colormap::Bands, contour::Field, geometry::Point};

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

    /// On and off lengths in turn, in multiples of the width.
    pub(super) fn pattern(self) -> &'static [f64] {
        match self {
            Dash::Solid => &[],
            Dash::Dashed => &[4.5, 2.0],
            Dash::Dotted => &[1.0, 1.6],
            Dash::DashDotted => &[5.5, 1.7, 1.1, 1.7],
        }
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
        use Marker::*;
        [Circle, Square, Triangle, Diamond, Cross, Plus][i % 6]
    }
}

/// Where a text stands relative to its position, along its own direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The text begins at the position.
    Start,
    /// The text is centred on the position.
    Middle,
    /// The text ends at the position.
    End,
}

/// Setters that take the layer and return it.
macro_rules! setters {
    ($name:ident: $($(#[$doc:meta])* $field:ident: $type:ty,)*) => {
        impl $name {$(
            $(#[$doc])*
            pub fn $field(mut self, $field: impl Into<$type>) -> $name {
                self.$field = $field.into();
                self
            }
        )*}
    };
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
        let points = points.into_iter().map(|(x, y)| [x, y]).collect();
        Line { points, color: Color::BLACK, width: 1.1, dash: Dash::Solid, label: String::new() }
    }

    /// A line through `(x[i], y[i])`; the longer slice is cut.
    pub fn xy(x: &[f64], y: &[f64]) -> Line {
        Line::new(x.iter().copied().zip(y.iter().copied()))
    }
}

setters! { Line:
    /// Sets the colour.
    color: Color,
    /// Sets the width in points.
    width: f64,
    /// Sets the dash pattern.
    dash: Dash,
    /// Names the line in the legend; lines and markers of one name share an entry.
    label: String,
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
}

setters! { Markers:
    /// Sets the filling apart from the outline: white makes open markers that hide what is below.
    fill: Option<Color>,
    /// Sets the diameter in points.
    size: f64,
    /// Sets the width of the outline in points.
    width: f64,
    /// Names the markers in the legend; lines and markers of one name share an entry.
    label: String,
}

/// Vertical bars from a lower to an upper value, with caps.
#[derive(Debug, Clone)]
pub struct ErrorBars {
    /// x, lower, upper.
    pub(super) bars: Vec<[f64; 3]>,
    pub(super) color: Color,
}

impl ErrorBars {
    /// Bars `(x, lower, upper)`.
    pub fn new(bars: impl IntoIterator<Item = (f64, f64, f64)>) -> ErrorBars {
        let bars = bars.into_iter().map(|(x, low, high)| [x, low, high]).collect();
        ErrorBars { bars, color: Color::BLACK }
    }
}

setters! { ErrorBars:
    /// Sets the colour.
    color: Color,
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
        let (color, dash, label) = (Color::GREY, Dash::Dashed, String::new());
        Rule { vertical: true, at, color, width: 0.8, dash, label }
    }

    /// The line y = `at`.
    pub fn horizontal(at: f64) -> Rule {
        Rule { vertical: false, ..Rule::vertical(at) }
    }
}

setters! { Rule:
    /// Sets the colour.
    color: Color,
    /// Sets the width in points.
    width: f64,
    /// Sets the dash pattern.
    dash: Dash,
    /// Names the line in the legend.
    label: String,
}

/// A marked area: tinted, hatched or both.
#[derive(Debug, Clone)]
pub struct Region {
    pub(super) outline: Vec<Point>,
    pub(super) fill: Option<(Color, f64)>,
    pub(super) hatch: Option<Color>,
    pub(super) label: String,
}

impl Region {
    /// The inside of a polygon. Infinite coordinates mean the border of the panel.
    pub fn polygon(points: impl IntoIterator<Item = (f64, f64)>) -> Region {
        let outline = points.into_iter().map(|(x, y)| [x, y]).collect();
        Region { outline, fill: None, hatch: None, label: String::new() }
    }

    /// Tints the area; the opacity is from 0 to 1.
    pub fn fill(mut self, color: Color, opacity: f64) -> Region {
        self.fill = Some((color, opacity));
        self
    }
}

setters! { Region:
    /// Hatches the area.
    hatch: Option<Color>,
    /// Names the area in the legend.
    label: String,
}

/// A field painted in bands of value. Cells with a corner that is not finite stay blank.
#[derive(Debug, Clone)]
pub struct FilledContours {
    pub(super) field: Field,
    pub(super) bands: Bands,
}

impl FilledContours {
    /// The field in the colours of the bands.
    pub fn new(field: Field, bands: Bands) -> FilledContours {
        FilledContours { field, bands }
    }
}

/// Lines of equal value of a field.
#[derive(Debug, Clone)]
pub struct Isolines {
    pub(super) field: Field,
    pub(super) levels: Vec<f64>,
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) labelled: bool,
}

impl Isolines {
    /// Thin black lines with their values written into them.
    pub fn new(field: Field, levels: impl IntoIterator<Item = f64>) -> Isolines {
        let levels = levels.into_iter().collect();
        Isolines { field, levels, color: Color::BLACK, width: 0.6, labelled: true }
    }

    /// Leaves out the values in the lines.
    pub fn without_values(mut self) -> Isolines {
        self.labelled = false;
        self
    }
}

setters! { Isolines:
    /// Sets the colour.
    color: Color,
    /// Sets the width in points.
    width: f64,
}

/// A short text at a point of the data, with a white border that keeps it readable.
#[derive(Debug, Clone)]
pub struct Note {
    pub(super) at: Point,
    pub(super) text: String,
    pub(super) anchor: Anchor,
    pub(super) color: Color,
}

impl Note {
    /// A text centred on the point.
    pub fn new(x: f64, y: f64, text: impl Into<String>) -> Note {
        Note { at: [x, y], text: text.into(), anchor: Anchor::Middle, color: Color::BLACK }
    }
}

setters! { Note:
    /// Sets where the text stands relative to the point.
    anchor: Anchor,
    /// Sets the colour.
    color: Color,
}

macro_rules! layers {
    ($($(#[$doc:meta])* $name:ident),*) => {
        /// Anything that can be drawn in a panel.
        #[derive(Debug, Clone)]
        pub enum Layer {
            $($(#[$doc])* $name($name),)*
        }

        $(impl From<$name> for Layer {
            fn from(layer: $name) -> Layer {
                Layer::$name(layer)
            }
        })*
    };
}

layers! {
    /// A polyline.
    Line,
    /// Markers.
    Markers,
    /// Vertical bars.
    ErrorBars,
    /// A straight line across the panel.
    Rule,
    /// A marked area.
    Region,
    /// A field in bands of colour.
    FilledContours,
    /// Lines of equal value.
    Isolines,
    /// A text.
    Note
}

impl Layer {
    /// The points that an axis without a range should show.
    pub(super) fn extent(&self) -> Vec<Point> {
        match self {
            Layer::Line(line) => line.points.clone(),
            Layer::Markers(markers) => markers.points.clone(),
            Layer::ErrorBars(e) => {
                e.bars.iter().flat_map(|b| [[b[0], b[1]], [b[0], b[2]]]).collect()
            }
            Layer::FilledContours(FilledContours { field, .. })
            | Layer::Isolines(Isolines { field, .. }) => {
                let (x, y) = (field.x(), field.y());
                x.iter().map(|&x| [x, y[0]]).chain(y.iter().map(|&y| [x[0], y])).collect()
            }
            Layer::Rule(_) | Layer::Region(_) | Layer::Note(_) => Vec::new(),
        }
    }

    /// Whether the layer shows a field.
    pub(super) fn is_map(&self) -> bool {
        matches!(self, Layer::FilledContours(_) | Layer::Isolines(_))
    }
}
