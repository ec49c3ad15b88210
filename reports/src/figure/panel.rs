//! One panel: two axes and what is drawn between them.

use super::{
    axis::{Axis, AxisRange},
    color::Color,
    color_bar::{ColorBar, Side, widest},
    error::FigureError,
    geometry::{Point, Rect},
    layer::Layer,
    legend::{self, Corner},
    paint::{self, Frame},
    picture::{Pen, Picture},
    text::{self, POINT},
};
use plotters::{
    chart::{ChartBuilder, SeriesLabelPosition},
    coord::Shift,
    drawing::{DrawingArea, DrawingAreaErrorKind},
    element::PathElement,
    style::text_anchor::{HPos, VPos},
};
use plotters_backend::DrawingBackend;
use std::sync::OnceLock;

/// What is drawn on, in units of a twentieth of a point.
pub(super) type Canvas<DB> = DrawingArea<DB, Shift>;
/// Whether the backend could draw.
pub(super) type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

// Sizes of text and widths of lines in points, lengths in units.
pub(super) const TICK_SIZE: f64 = 8.0;
pub(super) const LABEL_SIZE: f64 = 9.0;
pub(super) const TITLE_SIZE: f64 = 9.0;
pub(super) const FRAME_WIDTH: f64 = 0.7;
/// Length of a tick; the number stands as far from its end.
pub(super) const TICK: f64 = 2.7 * POINT;
/// From numbers to label.
pub(super) const LABEL_GAP: f64 = 3.5 * POINT;
/// From plot to colour bar.
pub(super) const BAR_GAP: f64 = 9.0 * POINT;

/// One plot of a figure.
///
/// Layers are drawn in the order in which they were added, over a light grid and under frame and legend.
#[derive(Debug, Clone)]
pub struct Panel {
    title: String,
    x: Axis,
    y: Axis,
    layers: Vec<Layer>,
    legend: Option<Corner>,
    color_bar: Option<ColorBar>,
    equal_units: bool,
}

impl Panel {
    /// An empty panel.
    pub fn new(x: Axis, y: Axis) -> Panel {
        Panel {
            title: String::new(),
            x,
            y,
            layers: Vec::new(),
            legend: None,
            color_bar: None,
            equal_units: false,
        }
    }

    /// Sets the title.
    pub fn title(mut self, title: impl Into<String>) -> Panel {
        self.title = title.into();
        self
    }

    /// Adds a layer on top.
    pub fn layer(mut self, layer: impl Into<Layer>) -> Panel {
        self.layers.push(layer.into());
        self
    }

    /// Adds layers on top, in order.
    pub fn layers<L: Into<Layer>>(mut self, layers: impl IntoIterator<Item = L>) -> Panel {
        self.layers.extend(layers.into_iter().map(Into::into));
        self
    }

    /// Shows the names of the layers in a corner.
    pub fn legend(mut self, corner: Corner) -> Panel {
        self.legend = Some(corner);
        self
    }

    /// Shows a colour bar at the right of this panel; for one that serves all panels see [`super::Figure::color_bar`].
    pub fn color_bar(mut self, bar: ColorBar) -> Panel {
        self.color_bar = Some(bar);
        self
    }

    /// Makes a unit as long upwards as to the right, so that circles are round: one of two linear axes shows more than its range.
    pub fn equal_units(mut self) -> Panel {
        self.equal_units = true;
        self
    }

    pub(super) fn all_layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The panel with definite ranges of its axes.
    pub(super) fn resolve(&self) -> Result<Resolved<'_>, FigureError> {
        // What lies over a map does not widen it.
        let is_map = self.layers.iter().any(Layer::is_map);
        let pad = if is_map { 0.0 } else { 0.04 };
        let shown = self.layers.iter().filter(|layer| layer.is_map() || !is_map);
        let points: Vec<Point> = shown.flat_map(Layer::extent).collect();
        Ok(Resolved {
            panel: self,
            x: self.x.resolve(points.iter().map(|p| p[0]), pad)?,
            y: self.y.resolve(points.iter().map(|p| p[1]), pad)?,
        })
    }
}

/// Room around the plot of a panel, in units.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Margins {
    pub(super) fn max(self, other: Margins) -> Margins {
        Margins {
            left: self.left.max(other.left),
            right: self.right.max(other.right),
            top: self.top.max(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// A panel with definite ranges.
pub(super) struct Resolved<'a> {
    panel: &'a Panel,
    x: AxisRange,
    y: AxisRange,
}

impl Resolved<'_> {
    /// The x axis with as many labels as fit beside each other with some room between them.
    fn x_axis(&self, width: f64) -> AxisRange {
        let fits = |axis: &AxisRange| {
            let half = |label: &str| 0.5 * text::width(label, TICK_SIZE * POINT);
            axis.ticks.windows(2).all(|w| {
                let apart = (axis.fraction(w[1].0) - axis.fraction(w[0].0)) * width;
                apart >= half(&w[0].1) + half(&w[1].1) + 0.8 * TICK_SIZE * POINT
            })
        };
        let axis = |most: usize| self.x.clone().with_ticks(most);
        (3..=8).rev().map(axis).find(fits).unwrap_or_else(|| axis(2))
    }

    fn y_axis(&self, height: f64) -> AxisRange {
        let most = (height / (2.4 * TICK_SIZE * POINT)).floor().clamp(2.0, 8.0) as usize;
        self.y.clone().with_ticks(most)
    }

    /// The room that titles and labels need around a plot of the given size.
    pub(super) fn margins(&self, width: f64, height: f64) -> Margins {
        let panel = self.panel;
        let label = |axis: &Axis| match axis.label.is_empty() {
            true => 0.0,
            false => LABEL_GAP + LABEL_SIZE * POINT,
        };
        let (x, y) = (self.x_axis(width), self.y_axis(height));
        let names: Vec<&str> = y.ticks.iter().map(|tick| tick.1.as_str()).collect();
        // The numbers at the outermost ticks stick out by up to half.
        let overhang = |from_border: fn(f64) -> f64| {
            let out = |(value, label): &(f64, String)| {
                let inside = from_border(x.fraction(*value)) * width;
                0.5 * text::width(label, TICK_SIZE * POINT) - inside
            };
            x.ticks.iter().map(out).fold(0.0, f64::max)
        };
        let bar = panel.color_bar.as_ref();
        let bar = bar.map_or(0.0, |bar| BAR_GAP + bar.breadth(Side::Right, height));
        Margins {
            left: (2.0 * TICK + widest(&names) + label(&panel.y)).max(overhang(|f| f)),
            right: overhang(|f| 1.0 - f).max(4.0 * POINT).max(bar),
            top: POINT * if panel.title.is_empty() { 0.5 * TICK_SIZE } else { 1.6 * TITLE_SIZE },
            bottom: 2.0 * TICK
                + TICK_SIZE * POINT
                + label(&panel.x)
                + text::DESCENT * LABEL_SIZE * POINT,
        }
    }

    /// With axes in the units that a plot of this size asks for.
    fn fitted(&self, plot: &Rect) -> Self {
        let (mut x, mut y) = (self.x.clone(), self.y.clone());
        if self.panel.equal_units {
            let wanted = y.length() * plot.width() / plot.height();
            match wanted > x.length() {
                true => x = x.lengthened(wanted / self.x.length()),
                false => y = y.lengthened(x.length() / wanted),
            }
        }
        Resolved { panel: self.panel, x, y }
    }

    /// Draws the panel with its plot in the rectangle; titles and labels stand around it. The shapes of the layers are made where they
    /// are not there yet.
    pub(super) fn draw<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        plot: Rect,
        margins: Margins,
        layers: &OnceLock<Picture>,
    ) -> Drawn<DB> {
        let fitted = self.fitted(&plot);
        let units = |v: f64| v.round() as i32;
        let size = (
            units(margins.left + plot.width() + margins.right),
            units(margins.top + plot.height() + margins.bottom),
        );
        let corner = (units(plot.left - margins.left), units(plot.top - margins.top));
        let cell = canvas.clone().shrink(corner, size);
        let mut chart = ChartBuilder::on(&cell)
            .margin_top(units(margins.top))
            .margin_right(units(margins.right))
            .x_label_area_size(units(margins.bottom))
            .y_label_area_size(units(margins.left))
            .build_cartesian_2d(fitted.x_axis(plot.width()), fitted.y_axis(plot.height()))?;
        let text = |size| text::style(size, Color::BLACK, HPos::Center, VPos::Bottom);
        chart
            .configure_mesh()
            .axis_style(Pen::solid(Color::BLACK, FRAME_WIDTH).style())
            .bold_line_style(Pen::solid(Color::rgb(222, 222, 222), 0.4).style())
            .light_line_style(Pen::solid(Color::rgb(240, 240, 240), 0.3).style())
            .label_style(text(TICK_SIZE))
            .axis_desc_style(text(LABEL_SIZE))
            .x_desc(self.panel.x.label.as_str())
            .y_desc(self.panel.y.label.as_str())
            .set_all_tick_mark_size(units(TICK))
            .draw()?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        let [left, right, top, bottom] =
            [across.start, across.end - 1, down.start, down.end - 1].map(f64::from);
        let rect = Rect { left, top, right, bottom };
        let coordinates = chart.as_coord_spec();
        let (x, y) = (coordinates.x_spec().clone(), coordinates.y_spec().clone());
        let frame = Frame { rect, x, y };
        canvas.draw(layers.get_or_init(|| paint::layers(&frame, &self.panel.layers)))?;
        let mut border = Picture::default();
        border.outline(&rect.corners(), Pen::solid(Color::BLACK, FRAME_WIDTH));
        // Plotters marks only what has a number.
        let mut mark =
            |from: Point, to: Point| border.stroke(&[from, to], Pen::solid(Color::BLACK, 0.5));
        for x in frame.x.minor.iter().map(|&v| frame.x_at(v)) {
            mark([x, bottom], [x, bottom + 0.6 * TICK]);
        }
        for y in frame.y.minor.iter().map(|&v| frame.y_at(v)) {
            mark([left, y], [left - 0.6 * TICK, y]);
        }
        canvas.draw(&border)?;
        let above = (units(0.5 * (left + right)), units(top - 0.3 * TITLE_SIZE * POINT));
        canvas.draw_text(&self.panel.title, &text(TITLE_SIZE), above)?;
        if let Some(bar) = &self.panel.color_bar {
            bar.draw(canvas, Side::Right, &rect, right + BAR_GAP)?;
        }
        let entries = legend::entries(&self.panel.layers);
        let Some(corner) = self.panel.legend.filter(|_| !entries.is_empty()) else {
            return Ok(());
        };
        // Plotters measures text without its font: place and backing are set from ours.
        const PAD: f64 = 3.5 * POINT;
        const INSET: f64 = 5.0 * POINT;
        let em = legend::SIZE * POINT;
        let wide = entries.iter().map(legend::Entry::width).fold(0.0, f64::max) + 2.0 * PAD;
        let high = (entries.len() - 1) as f64 * legend::ROW + em + 1.6 * PAD;
        let x = match corner {
            Corner::TopLeft | Corner::BottomLeft => INSET,
            Corner::TopRight | Corner::BottomRight => rect.width() - INSET - wide,
        };
        let y = match corner {
            Corner::TopLeft | Corner::TopRight => INSET,
            Corner::BottomLeft | Corner::BottomRight => rect.height() - INSET - high,
        };
        let (l, t) = (rect.left + x, rect.top + y);
        let back = Rect { left: l, top: t, right: l + wide, bottom: t + high }.corners();
        let mut backing = Picture::default();
        backing.fill(std::slice::from_ref(&back), Color::WHITE, 0.93);
        backing.outline(&back, Pen::solid(Color::rgb(190, 190, 190), 0.4));
        canvas.draw(&backing)?;
        for entry in entries {
            let sample = entry.sample();
            // From the middle of the line to that of its capitals.
            let raised = units(0.1 * em);
            chart
                .draw_series(std::iter::empty::<PathElement<(f64, f64)>>())?
                .label(entry.label)
                .legend(move |(x, y)| sample.moved((x, y - raised)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::Coordinate(units(x), units(y)))
            .legend_area_size(units(legend::SAMPLE + legend::GAP))
            .margin(units(PAD))
            .label_font(text::style(legend::SIZE, Color::BLACK, HPos::Left, VPos::Top))
            .draw()
    }
}
