//! What is on a page, independent of the file format: shapes in points (1/72 inch) from the upper left corner.

use super::{
    color::Color,
    font,
    geometry::{Point, Rect},
};

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

/// A piece of text; its position is on the baseline.
#[derive(Debug, Clone)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) position: Point,
    /// Counterclockwise, in degrees.
    pub(super) angle: f64,
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    pub(super) color: Color,
    /// Colour of a border around the letters that sets them off from what is below.
    pub(super) halo: Option<Color>,
}

impl Text {
    pub(super) fn new(text: impl Into<String>, position: Point, size: f64) -> Text {
        Text {
            text: text.into(),
            position,
            angle: 0.0,
            size,
            anchor: Anchor::Start,
            color: Color::BLACK,
            halo: None,
        }
    }

    /// The position of the first letter.
    pub(super) fn origin(&self) -> Point {
        let back = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5,
            Anchor::End => 1.0,
        } * font::width(&self.text, self.size);
        let (sin, cos) = self.angle.to_radians().sin_cos();
        [self.position[0] - back * cos, self.position[1] + back * sin]
    }

    /// Width of the border drawn around letters with a halo, in points.
    pub(super) fn halo_width(&self) -> f64 {
        0.3 * self.size
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pen {
    pub(super) color: Color,
    pub(super) width: f64,
    /// On and off lengths in turn; empty for a solid line.
    pub(super) dash: Vec<f64>,
}

impl Pen {
    pub(super) fn solid(color: Color, width: f64) -> Pen {
        Pen { color, width, dash: Vec::new() }
    }
}

/// A shape.
#[derive(Debug, Clone)]
pub(super) enum Shape {
    /// Closed rings filled where their winding number is not zero.
    Fill { rings: Vec<Vec<Point>>, color: Color, opacity: f64 },
    /// Polylines with round joins and butt ends.
    Stroke { lines: Vec<Vec<Point>>, closed: bool, pen: Pen },
    /// A circle, filled and then outlined.
    Circle { centre: Point, radius: f64, fill: Option<Color>, pen: Pen },
    /// A text.
    Text(Text),
}

/// A page: shapes in the order of drawing, each with the rectangle it is cut to.
#[derive(Debug)]
pub(super) struct Scene {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) items: Vec<(Option<Rect>, Shape)>,
    /// Applied to shapes added from now on.
    pub(super) clip: Option<Rect>,
}

impl Scene {
    pub(super) fn new(width: f64, height: f64) -> Scene {
        Scene { width, height, items: Vec::new(), clip: None }
    }

    pub(super) fn add(&mut self, shape: Shape) {
        self.items.push((self.clip, shape));
    }

    pub(super) fn fill(&mut self, rings: Vec<Vec<Point>>, color: Color, opacity: f64) {
        if !rings.is_empty() {
            self.add(Shape::Fill { rings, color, opacity });
        }
    }

    pub(super) fn stroke(&mut self, lines: Vec<Vec<Point>>, pen: Pen) {
        if !lines.is_empty() {
            self.add(Shape::Stroke { lines, closed: false, pen });
        }
    }

    pub(super) fn outline(&mut self, ring: Vec<Point>, pen: Pen) {
        self.add(Shape::Stroke { lines: vec![ring], closed: true, pen });
    }

    pub(super) fn text(&mut self, text: Text) {
        if !text.text.is_empty() {
            self.add(Shape::Text(text));
        }
    }
}
