//! One panel: two axes and what is drawn between them.

use super::canvas::{Canvas, Done, outline, pen};
use super::frame::Frame;
use super::geometry::{Point, Rect};
use super::isoline_label::IsolineLabels;
use super::{Axis, Color, Contours, FigureError, POINT, Series, text};
use plotters::chart::ChartBuilder;

// Sizes of text and widths of lines in points, lengths in units.
pub(super) const TICK_SIZE: f64 = 8.0;
pub(super) const LABEL_SIZE: f64 = 9.0;
const TITLE_SIZE: f64 = 9.0;
const NOTE_SIZE: f64 = 7.5;
pub(super) const FRAME_WIDTH: f64 = 0.7;
/// Length of a tick; the number stands as far from its end.
pub(super) const TICK: f64 = 2.7 * POINT;
/// From numbers to label.
pub(super) const LABEL_GAP: f64 = 3.5 * POINT;

/// One plot of a figure.
///
/// Contours, then series, then notes are drawn in the order in which they were added, over a light grid and under the
/// frame.
#[derive(Debug, Clone)]
pub struct Panel {
    title: String,
    x: Axis,
    y: Axis,
    equal_units: bool,
    pub(super) contours: Vec<Contours>,
    pub(super) series: Vec<Series>,
    notes: Vec<(Point, String)>,
}

impl Panel {
    /// An empty panel.
    pub fn new(x: Axis, y: Axis) -> Panel {
        let (contours, series, notes) = (Vec::new(), Vec::new(), Vec::new());
        Panel { title: String::new(), x, y, equal_units: false, contours, series, notes }
    }

    /// Sets the title.
    pub fn title(self, title: impl Into<String>) -> Panel {
        Panel { title: title.into(), ..self }
    }

    /// Adds contours below all series.
    pub fn contours(mut self, contours: Contours) -> Panel {
        self.contours.push(contours);
        self
    }

    /// Adds a series on top.
    pub fn layer(self, series: Series) -> Panel {
        self.layers([series])
    }

    /// Adds series on top, in order.
    pub fn layers(mut self, series: impl IntoIterator<Item = Series>) -> Panel {
        self.series.extend(series);
        self
    }

    /// Adds a short text centred on a point of the data, in black with a white border that keeps it readable.
    pub fn note(mut self, x: f64, y: f64, text: impl Into<String>) -> Panel {
        self.notes.push(([x, y], text.into()));
        self
    }

    /// Makes a unit as long upwards as to the right, so that circles are round: one of two linear axes shows more than
    /// its range.
    pub fn equal_units(self) -> Panel {
        Panel { equal_units: true, ..self }
    }

    /// The panel with definite ranges of its axes.
    pub(super) fn plot(&self) -> Result<Plot<'_>, FigureError> {
        // What lies over a map does not widen it.
        let (points, pad): (Vec<Point>, f64) = match self.contours.is_empty() {
            true => (self.series.iter().flat_map(Series::extent).copied().collect(), 0.04),
            false => (self.contours.iter().flat_map(|c| c.field.extent()).collect(), 0.0),
        };
        let x = self.x.resolve(points.iter().map(|p| p[0]), pad)?;
        let y = self.y.resolve(points.iter().map(|p| p[1]), pad)?;
        Ok(Plot { panel: self, x, y })
    }
}

/// A panel whose axes have definite ranges.
pub(super) struct Plot<'a> {
    panel: &'a Panel,
    x: Axis,
    y: Axis,
}

impl Plot<'_> {
    /// The axes of a plot of this size with as many ticks as have room.
    fn axes(&self, width: f64, height: f64) -> (Axis, Axis) {
        let (mut x, mut y) = (self.x.clone(), self.y.clone());
        if self.panel.equal_units {
            let ((a, b), (c, d)) = (x.ends(), y.ends());
            // Half of what each axis must be longer by.
            let more = 0.5 * ((d - c) * width / height - (b - a));
            match more > 0.0 {
                true => x = x.range(a - more, b + more),
                false => y = y.range(c + more * height / width, d - more * height / width),
            }
        }
        let most = |room: f64| room.floor().clamp(2.0, 8.0) as usize;
        let wide = widest(x.clone().with_ticks(8).labels()) + 0.8 * TICK_SIZE * POINT;
        let high = 2.4 * TICK_SIZE * POINT;
        (x.with_ticks(most(width / wide)), y.with_ticks(most(height / high)))
    }

    fn title_lines(&self, width: f64) -> Vec<String> {
        text::wrapped(&self.panel.title, TITLE_SIZE, 1.1 * width)
    }

    /// The room that titles and labels need around a plot of the given size: left, right, above and below.
    pub(super) fn margins(&self, width: f64, height: f64) -> [f64; 4] {
        let label = |axis: &Axis| match axis.label.is_empty() {
            true => 0.0,
            false => LABEL_GAP + LABEL_SIZE * POINT,
        };
        let (x, y) = self.axes(width, height);
        // The numbers at the outermost ticks stick out by up to half.
        let half = 0.5 * widest(x.labels());
        [
            (2.0 * TICK + widest(y.labels()) + label(&y)).max(half),
            half.max(4.0 * POINT),
            POINT * (4.0 + 1.2 * TITLE_SIZE * self.title_lines(width).len() as f64),
            2.0 * TICK + (TICK_SIZE + text::DESCENT * LABEL_SIZE) * POINT + label(&x),
        ]
    }

    /// Draws the panel with its plot in the rectangle; titles and labels stand around it.
    pub(super) fn draw(&self, canvas: &Canvas, plot: Rect, margins: [f64; 4]) -> Done {
        let units = |v: f64| v.round() as i32;
        let [left, right, top, bottom] = margins;
        let corner = (units(plot.left - left), units(plot.top - top));
        let size = (units(left + plot.width() + right), units(top + plot.height() + bottom));
        let (x, y) = self.axes(plot.width(), plot.height());
        let mut chart = ChartBuilder::on(&canvas.0.clone().shrink(corner, size))
            .margin_top(units(top))
            .margin_right(units(right))
            .x_label_area_size(units(bottom))
            .y_label_area_size(units(left))
            .build_cartesian_2d(x.clone(), y.clone())?;
        let border = pen(Color::BLACK, FRAME_WIDTH);
        chart
            .configure_mesh()
            .axis_style(border)
            .bold_line_style(pen(Color(222, 222, 222), 0.4))
            .light_line_style(pen(Color(238, 238, 238), 0.3))
            .label_style(text::above(TICK_SIZE))
            .axis_desc_style(text::above(LABEL_SIZE))
            .x_desc(x.label.as_str())
            .y_desc(y.label.as_str())
            .set_all_tick_mark_size(units(TICK))
            .draw()?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        let [left, right, top, bottom] =
            [across.start, across.end - 1, down.start, down.end - 1].map(f64::from);
        let rect = Rect { left, top, right, bottom };
        self.draw_data(canvas, &Frame { rect, x: &x, y: &y })?;
        canvas.draw([outline(&rect.corners(), border)])?;
        for (k, line) in self.title_lines(plot.width()).iter().rev().enumerate() {
            let above = top - (0.3 + 1.2 * k as f64) * TITLE_SIZE * POINT;
            canvas.write(line, &text::above(TITLE_SIZE), [0.5 * (left + right), above])?;
        }
        Ok(())
    }

    fn draw_data(&self, canvas: &Canvas, frame: &Frame) -> Done {
        let Panel { contours, series, notes, .. } = self.panel;
        let mut labels = IsolineLabels::new(frame.rect);
        for contours in contours {
            contours.draw(canvas, frame, &mut labels)?;
        }
        for series in series {
            for line in series.on_page(frame) {
                canvas.draw(series.elements(&line))?;
                labels.keep_off(&line);
            }
        }
        for (at, note) in notes {
            canvas.letters(note, NOTE_SIZE, frame.at(*at), 0.0)?;
            labels.keep_off(&[frame.at(*at); 2]);
        }
        labels.draw(canvas)
    }
}

/// The width of the widest number at a tick.
pub(super) fn widest(numbers: impl IntoIterator<Item = impl AsRef<str>>) -> f64 {
    numbers.into_iter().map(|n| text::width(n.as_ref(), TICK_SIZE)).fold(0.0, f64::max)
}
