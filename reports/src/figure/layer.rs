//! What is drawn in a panel, in data coordinates.

use super::{color::Color, colormap::Bands, contour::Field, geometry::Point, scene::Anchor};

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
        Region {
            outline: points.into_iter().map(|(x, y)| [x, y]).collect(),
            fill: None,
            hatch: None,
            label: String::new(),
        }
    }

    /// The area between two curves over the same `x`; an infinite value means the border of the panel.
    ///
    /// ```
    /// use courant_reports::figure::{Color, Region};
    /// let x = [0.0, 1.0, 2.0];
    /// let unstable = Region::between(&x, &[0.5, 0.4, 0.3], &[f64::INFINITY; 3]).hatch(Color::GREY);
    /// ```
    pub fn between(x: &[f64], lower: &[f64], upper: &[f64]) -> Region {
        let way = |y: &[f64]| x.iter().copied().zip(y.iter().copied()).collect::<Vec<_>>();
        let mut points = way(lower);
        points.extend(way(upper).into_iter().rev());
        points.retain(|p| !p.0.is_nan() && !p.1.is_nan());
        Region::polygon(points)
    }

    /// Tints the area; the opacity is from 0 to 1.
    pub fn fill(mut self, color: Color, opacity: f64) -> Region {
        self.fill = Some((color, opacity));
        self
    }

    /// Hatches the area.
    pub fn hatch(mut self, color: Color) -> Region {
        self.hatch = Some(color);
        self
    }

    /// Names the area in the legend.
    pub fn label(mut self, label: impl Into<String>) -> Region {
        self.label = label.into();
        self
    }
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
    pub(super) dash: Dash,
    pub(super) labelled: bool,
    pub(super) label: String,
}

impl Isolines {
    /// Thin black lines with their values written into them.
    pub fn new(field: Field, levels: impl IntoIterator<Item = f64>) -> Isolines {
        Isolines {
            field,
            levels: levels.into_iter().collect(),
            color: Color::BLACK,
            width: 0.6,
            dash: Dash::Solid,
            labelled: true,
            label: String::new(),
        }
    }

    /// Sets the colour.
    pub fn color(mut self, color: Color) -> Isolines {
        self.color = color;
        self
    }

    /// Sets the width in points.
    pub fn width(mut self, width: f64) -> Isolines {
        self.width = width;
        self
    }

    /// Sets the dash pattern.
    pub fn dash(mut self, dash: Dash) -> Isolines {
        self.dash = dash;
        self
    }

    /// Leaves out the values in the lines.
    pub fn without_values(mut self) -> Isolines {
        self.labelled = false;
        self
    }

    /// Names the lines in the legend.
    pub fn label(mut self, label: impl Into<String>) -> Isolines {
        self.label = label.into();
        self
    }
}

/// A short text at a point of the data, with a white border that keeps it readable.
#[derive(Debug, Clone)]
pub struct Note {
    pub(super) at: Point,
    pub(super) text: String,
    pub(super) anchor: Anchor,
    pub(super) angle: f64,
    pub(super) color: Color,
    pub(super) size: f64,
}

impl Note {
    /// A text centred on the point.
    pub fn new(x: f64, y: f64, text: impl Into<String>) -> Note {
        Note {
            at: [x, y],
            text: text.into(),
            anchor: Anchor::Middle,
            angle: 0.0,
            color: Color::BLACK,
            size: 7.5,
        }
    }

    /// Sets where the text stands relative to the point.
    pub fn anchor(mut self, anchor: Anchor) -> Note {
        self.anchor = anchor;
        self
    }

    /// Turns the text counterclockwise, in degrees.
    pub fn angle(mut self, degrees: f64) -> Note {
        self.angle = degrees;
        self
    }

    /// Sets the colour.
    pub fn color(mut self, color: Color) -> Note {
        self.color = color;
        self
    }

    /// Sets the size in points.
    pub fn size(mut self, size: f64) -> Note {
        self.size = size;
        self
    }
}

/// Anything that can be drawn in a panel.
#[derive(Debug, Clone)]
pub enum Layer {
    /// A polyline.
    Line(Line),
    /// Markers.
    Markers(Markers),
    /// Vertical bars.
    ErrorBars(ErrorBars),
    /// A straight line across the panel.
    Rule(Rule),
    /// A marked area.
    Region(Region),
    /// A field in bands of colour.
    FilledContours(FilledContours),
    /// Lines of equal value.
    Isolines(Isolines),
    /// A text.
    Note(Note),
}

macro_rules! into_layer {
    ($($name:ident),*) => {$(
        impl From<$name> for Layer {
            fn from(layer: $name) -> Layer {
                Layer::$name(layer)
            }
        }
    )*};
}
into_layer!(Line, Markers, ErrorBars, Rule, Region, FilledContours, Isolines, Note);

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
}
