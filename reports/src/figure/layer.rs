//! What is drawn in a panel, in data coordinates.

use super::{
    area::{FilledContours, Isolines, Region},
    color::Color,
    curve::{ErrorBars, Line, Markers, Rule},
    geometry::Point,
    scene::Anchor,
};

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
