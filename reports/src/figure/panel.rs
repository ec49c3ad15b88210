//! One panel: two axes and what is drawn between them.

use super::{
    axis::{Axis, ResolvedAxis},
    color::Color,
    color_bar::ColorBar,
    error::FigureError,
    font,
    geometry::{Point, Rect},
    layer::Layer,
    legend::{self, Corner},
    plot,
    scene::{Anchor, Pen, Scene, Text},
    ticks::Tick,
    typography::*,
};

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
    grid: bool,
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
            grid: true,
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

    /// Leaves out the grid.
    pub fn without_grid(mut self) -> Panel {
        self.grid = false;
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

    /// The ranges of the axes.
    pub(super) fn resolve(&self) -> Result<Resolved<'_>, FigureError> {
        let has_field =
            self.layers.iter().any(|l| matches!(l, Layer::FilledContours(_) | Layer::Isolines(_)));
        let pad = if has_field { 0.0 } else { 0.04 };
        // What lies over a map does not widen it.
        let is_shown =
            |l: &&Layer| !has_field || matches!(l, Layer::FilledContours(_) | Layer::Isolines(_));
        let points: Vec<Point> =
            self.layers.iter().filter(is_shown).flat_map(Layer::extent).collect();
        Ok(Resolved {
            panel: self,
            x: self.x.resolve(points.iter().map(|p| p[0]), pad)?,
            y: self.y.resolve(points.iter().map(|p| p[1]), pad)?,
        })
    }
}

/// Room around the plot of a panel, in points.
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
    pub(super) panel: &'a Panel,
    x: ResolvedAxis,
    y: ResolvedAxis,
}

/// Where data lie on the page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) rect: Rect,
    pub(super) x: ResolvedAxis,
    pub(super) y: ResolvedAxis,
}

impl Frame {
    pub(super) fn x_at(&self, x: f64) -> f64 {
        self.rect.left + self.x.fraction(x) * self.rect.width()
    }

    pub(super) fn y_at(&self, y: f64) -> f64 {
        self.rect.bottom - self.y.fraction(y) * self.rect.height()
    }

    pub(super) fn at(&self, p: Point) -> Point {
        [self.x_at(p[0]), self.y_at(p[1])]
    }
}

impl Resolved<'_> {
    fn x_ticks(&self, width: f64) -> Vec<Tick> {
        // As many labels as fit beside each other with some room between them.
        let mut most = 8;
        loop {
            let ticks = self.panel.x.ticks_for(&self.x, most);
            let ends: Vec<(f64, f64)> = ticks
                .iter()
                .filter(|t| !t.label.is_empty())
                .map(|t| {
                    let (at, half) =
                        (self.x.fraction(t.value) * width, 0.5 * font::width(&t.label, TICK_SIZE));
                    (at - half, at + half)
                })
                .collect();
            if most <= 2 || ends.windows(2).all(|w| w[1].0 - w[0].1 >= 0.8 * TICK_SIZE) {
                return ticks;
            }
            most -= 1;
        }
    }

    fn y_ticks(&self, height: f64) -> Vec<Tick> {
        let most = (height / (2.4 * TICK_SIZE)).floor().clamp(2.0, 8.0) as usize;
        self.panel.y.ticks_for(&self.y, most)
    }

    /// The room that titles and labels need around a plot of the given size.
    pub(super) fn margins(&self, width: f64, height: f64) -> Margins {
        let panel = self.panel;
        let y_ticks = self.y_ticks(height);
        let widest = y_ticks.iter().map(|t| font::width(&t.label, TICK_SIZE)).fold(0.0, f64::max);
        let label = |axis: &Axis| match axis.label.is_empty() {
            true => 0.0,
            false => LABEL_GAP + LABEL_SIZE,
        };
        let x_ticks = self.x_ticks(width);
        // The labels of the outermost ticks stick out by up to half.
        let overhang = |from_border: &dyn Fn(f64) -> f64| {
            x_ticks
                .iter()
                .map(|t| {
                    let inside = from_border(self.x.fraction(t.value)) * width;
                    0.5 * font::width(&t.label, TICK_SIZE) - inside
                })
                .fold(0.0, f64::max)
        };
        let numbers = if panel.x.show_tick_labels { TICK_GAP + TICK_SIZE } else { 0.0 };
        Margins {
            left: (TICK_LENGTH + TICK_GAP + widest + label(&panel.y)).max(overhang(&|f| f)),
            right: overhang(&|f| 1.0 - f)
                .max(4.0)
                .max(panel.color_bar.as_ref().map_or(0.0, |b| BAR_GAP + b.breadth_right())),
            top: if panel.title.is_empty() { 0.5 * TICK_SIZE } else { 1.6 * TITLE_SIZE },
            bottom: TICK_LENGTH + numbers + label(&panel.x) + font::DESCENT * LABEL_SIZE,
        }
    }

    /// With axes in the units that a plot of this size asks for.
    fn fitted(&self, rect: &Rect) -> Self {
        let (mut x, mut y) = (self.x, self.y);
        if self.panel.equal_units {
            let wanted = y.length() * rect.width() / rect.height();
            match wanted > x.length() {
                true => x = x.lengthened(wanted / x.length()),
                false => y = y.lengthened(x.length() / wanted),
            }
        }
        Resolved { panel: self.panel, x, y }
    }

    /// Draws the panel with its plot in the rectangle; the title and labels stand around it.
    pub(super) fn draw(&self, scene: &mut Scene, rect: Rect, left: f64) {
        self.fitted(&rect).draw_fitted(scene, rect, left);
    }

    fn draw_fitted(&self, scene: &mut Scene, rect: Rect, left: f64) {
        let panel = self.panel;
        let frame = Frame { rect, x: self.x, y: self.y };
        let (x_ticks, y_ticks) = (self.x_ticks(rect.width()), self.y_ticks(rect.height()));
        scene.clip = Some(rect);
        if panel.grid {
            self.draw_grid(scene, &frame, &x_ticks, &y_ticks);
        }
        plot::draw_layers(scene, &frame, &panel.layers);
        scene.clip = None;
        let axis = Pen::solid(Color::BLACK, FRAME_WIDTH);
        scene.outline(rect.corners(), axis.clone());
        let marks = |major: bool| -> Vec<Vec<Point>> {
            let length = if major { TICK_LENGTH } else { MINOR_TICK_LENGTH };
            let wanted = |t: &&Tick| t.label.is_empty() != major;
            let below = x_ticks.iter().filter(wanted).map(|t| {
                let x = frame.x_at(t.value);
                vec![[x, rect.bottom], [x, rect.bottom + length]]
            });
            let beside = y_ticks.iter().filter(wanted).map(|t| {
                let y = frame.y_at(t.value);
                vec![[rect.left, y], [rect.left - length, y]]
            });
            below.chain(beside).collect()
        };
        scene.stroke(marks(true), axis.clone());
        scene.stroke(marks(false), Pen::solid(Color::BLACK, 0.7 * FRAME_WIDTH));
        self.draw_labels(scene, &frame, &x_ticks, &y_ticks, left);
        if let Some(corner) = panel.legend {
            legend::draw_in_corner(scene, &rect, corner, &legend::entries(&panel.layers));
        }
        if let Some(bar) = &panel.color_bar {
            bar.draw_right(scene, rect.right + BAR_GAP, rect.top, rect.bottom);
        }
    }

    fn draw_grid(&self, scene: &mut Scene, frame: &Frame, x_ticks: &[Tick], y_ticks: &[Tick]) {
        let r = frame.rect;
        let vertical = x_ticks.iter().filter(|t| !t.label.is_empty()).map(|t| {
            let x = frame.x_at(t.value);
            vec![[x, r.top], [x, r.bottom]]
        });
        let level = y_ticks.iter().filter(|t| !t.label.is_empty()).map(|t| {
            let y = frame.y_at(t.value);
            vec![[r.left, y], [r.right, y]]
        });
        scene.stroke(vertical.chain(level).collect(), Pen::solid(GRID_COLOR, GRID_WIDTH));
    }

    fn draw_labels(
        &self,
        scene: &mut Scene,
        frame: &Frame,
        x_ticks: &[Tick],
        y_ticks: &[Tick],
        left: f64,
    ) {
        let (panel, rect) = (self.panel, frame.rect);
        let text = |text: &str, at: Point, size: f64, anchor: Anchor| Text {
            anchor,
            ..Text::new(text.trim(), at, size)
        };
        let baseline = rect.bottom + TICK_LENGTH + TICK_GAP + font::CAP_HEIGHT * TICK_SIZE;
        for t in x_ticks {
            let at = [frame.x_at(t.value), baseline];
            scene.text(text(&t.label, at, TICK_SIZE, Anchor::Middle));
        }
        for t in y_ticks {
            let at = [
                rect.left - TICK_LENGTH - TICK_GAP,
                frame.y_at(t.value) + 0.5 * font::CAP_HEIGHT * TICK_SIZE,
            ];
            scene.text(text(&t.label, at, TICK_SIZE, Anchor::End));
        }
        let middle = [0.5 * (rect.left + rect.right), 0.5 * (rect.top + rect.bottom)];
        let numbers = if panel.x.show_tick_labels { TICK_GAP + TICK_SIZE } else { 0.0 };
        let below = rect.bottom + TICK_LENGTH + numbers + LABEL_GAP + font::CAP_HEIGHT * LABEL_SIZE;
        scene.text(text(&panel.x.label, [middle[0], below], LABEL_SIZE, Anchor::Middle));
        // All panels of a column align their labels at the left end of the common margin.
        let beside = rect.left - left + font::CAP_HEIGHT * LABEL_SIZE;
        scene.text(Text {
            angle: 90.0,
            ..text(&panel.y.label, [beside, middle[1]], LABEL_SIZE, Anchor::Middle)
        });
        let above = rect.top - 0.5 * TITLE_SIZE;
        scene.text(text(&panel.title, [middle[0], above], TITLE_SIZE, Anchor::Middle));
    }
}
