//! Series of points: curves and markers.

use super::canvas::{Element, fill, outline, pen, stroke, units};
use super::frame::Frame;
use super::geometry::{Point, between};
use super::{Color, POINT};
use plotters::element::{Circle, IntoDynElement};
use plotters::style::Color as _;

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
/// outside the panel are left out. Series of one label share an entry of the legend.
#[derive(Debug, Clone)]
pub struct Series {
    /// A single point without one of its coordinates is a line across the whole panel.
    pub(super) points: Vec<Point>,
    color: Color,
    width: f64,
    dash: Dash,
    marker: Option<Marker>,
    size: f64,
    fill: Option<Color>,
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

    /// Fills markers with another colour: white hides what is below, with `None` it shows through.
    pub fn fill(self, color: impl Into<Option<Color>>) -> Series {
        Series { fill: color.into(), ..self }
    }

    /// Sets the width of the line or of the outline of markers, in points.
    pub fn width(self, width: f64) -> Series {
        Series { width, ..self }
    }

    /// Sets how the line is broken.
    pub fn dash(self, dash: Dash) -> Series {
        Series { dash, ..self }
    }

    /// Sets the diameter of markers, in points.
    pub fn size(self, size: f64) -> Series {
        Series { size, ..self }
    }

    /// Sets the name in the legend.
    pub fn label(self, label: impl Into<String>) -> Series {
        Series { label: label.into(), ..self }
    }

    /// The points that an axis without a range should show.
    pub(super) fn extent(&self) -> &[Point] {
        match self.points[..] {
            // A line across the panel has no length of its own.
            [[x, y]] if (x + y).is_nan() => &[],
            _ => &self.points,
        }
    }

    /// The markers in the panel, or the pieces of the line: what is drawn, as lines of points.
    pub(super) fn on_page(&self, frame: &Frame) -> Vec<Vec<Point>> {
        match self.marker {
            None => frame.curve(&self.points),
            Some(_) => {
                let places = self.points.iter().map(|&point| frame.at(point));
                let inside = places.filter(|&place| frame.rect.grown(0.5).contains(place));
                inside.map(|place| vec![place; 2]).collect()
            }
        }
    }

    /// A line of points, or a marker in the middle between the first two.
    pub(super) fn elements<'a>(&self, line: &[Point]) -> Vec<Element<'a>> {
        let style = pen(self.color, self.width);
        let Some(marker) = self.marker else { return vec![stroke(line, style, self.dash)] };
        let (at, r) = (between(line[0], line[1], 0.5), 0.5 * self.size * POINT);
        let form = |corners: &[Point]| -> Vec<Point> {
            corners.iter().map(|c| [at[0] + r * c[0], at[1] + r * c[1]]).collect()
        };
        let strokes = |d: f64, e: f64| {
            let lines = [[[-d, -e], [d, e]], [[-e, d], [e, -d]]];
            lines.iter().map(|line| stroke(&form(line), style, Dash::Solid)).collect()
        };
        // Sizes are such that all forms weigh about the same.
        let corners = match marker {
            Marker::Cross => return strokes(0.85, 0.85),
            Marker::Plus => return strokes(1.1, 0.0),
            Marker::Circle => {
                let inside = self.fill.map(|color| color.filled());
                let circles = inside.into_iter().chain([style]);
                return circles.map(|style| Circle::new(units(&at), r, style).into_dyn()).collect();
            }
            Marker::Square => form(&[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]]),
            Marker::Triangle => form(&[[0.0, -1.25], [1.1, 0.7], [-1.1, 0.7]]),
            Marker::Diamond => form(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
        };
        let inside = self.fill.map(|color| fill(std::slice::from_ref(&corners), color));
        inside.into_iter().chain([outline(&corners, style)]).collect()
    }
}
