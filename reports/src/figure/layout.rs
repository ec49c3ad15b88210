//! Figures: panels in a grid, with what they share.

use super::{
    color::Color,
    color_bar::{ColorBar, Side},
    error::FigureError,
    geometry::Rect,
    legend,
    panel::{BAR_GAP, Canvas, Drawn, LABEL_GAP, Margins, Panel, Resolved},
    picture::Picture,
    raster::{self, Raster},
    text::{self, POINT},
    vector::{self, Vector},
};
use plotters::{
    backend::SVGBackend,
    drawing::IntoDrawingArea,
    style::{
        WHITE,
        text_anchor::{HPos, VPos},
    },
};
use plotters_backend::DrawingBackend;
use std::sync::OnceLock;
use tiny_skia::Pixmap;

const FIGURE_TITLE_SIZE: f64 = 10.5;
/// Between neighbouring panels, beside their labels.
const PANEL_GAP: f64 = 7.0 * POINT;
/// Around everything.
const PAGE_MARGIN: f64 = 4.0 * POINT;

/// Panels in a grid, with title, legend and colour bar in common.
///
/// The picture is made in memory as PNG or SVG; both show the same, and equal figures give equal bytes.
#[derive(Debug, Clone)]
pub struct Figure {
    rows: usize,
    columns: usize,
    width: f64,
    height: f64,
    title: String,
    panels: Vec<Panel>,
    color_bar: Option<(ColorBar, Side)>,
    legend_below: bool,
}

impl Figure {
    /// A figure for `rows` x `columns` panels, 7 inches wide (the text width of most journals), or 4.5 for a single
    /// column of panels.
    pub fn grid(rows: usize, columns: usize) -> Figure {
        let width = if columns > 1 { 7.0 } else { 4.5 };
        Figure {
            rows,
            columns,
            width,
            height: 0.6 + rows as f64 * width / columns.max(1) as f64 * 0.72,
            title: String::new(),
            panels: Vec::new(),
            color_bar: None,
            legend_below: false,
        }
    }

    /// A figure of one panel.
    pub fn single(panel: Panel) -> Figure {
        Figure::grid(1, 1).panel(panel)
    }

    /// Sets the size in inches.
    pub fn size(mut self, width: f64, height: f64) -> Figure {
        self.width = width;
        self.height = height;
        self
    }

    /// Sets the title above all panels.
    pub fn title(mut self, title: impl Into<String>) -> Figure {
        self.title = title.into();
        self
    }

    /// Adds the next panel; panels fill the grid row by row.
    pub fn panel(mut self, panel: Panel) -> Figure {
        self.panels.push(panel);
        self
    }

    /// Adds panels in order.
    pub fn panels(mut self, panels: impl IntoIterator<Item = Panel>) -> Figure {
        self.panels.extend(panels);
        self
    }

    /// Shows one colour bar for all panels.
    pub fn color_bar(mut self, bar: ColorBar, side: Side) -> Figure {
        self.color_bar = Some((bar, side));
        self
    }

    /// Shows one legend below all panels, with the names of all layers.
    pub fn legend_below(mut self) -> Figure {
        self.legend_below = true;
        self
    }

    /// The picture as PNG at 300 dots per inch, with its size recorded in the file.
    ///
    /// # Errors
    /// If an axis has an impossible range, or the panels do not fit.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        raster::png(&self.pixels(&self.no_layers())?)
    }

    fn pixels(&self, layers: &[OnceLock<Picture>]) -> Result<Pixmap, FigureError> {
        let mut pixels = raster::pixels(self.units())?;
        self.draw_on(Raster::new(self.units(), &mut pixels), layers)?;
        Ok(pixels)
    }

    /// The picture as SVG. Axes, titles and legends are text.
    ///
    /// # Errors
    /// As [`Figure::png`].
    pub fn svg(&self) -> Result<String, FigureError> {
        self.svg_with(&self.no_layers())
    }

    fn svg_with(&self, layers: &[OnceLock<Picture>]) -> Result<String, FigureError> {
        let mut document = String::new();
        self.draw_on(Vector(SVGBackend::with_string(&mut document, self.units())), layers)?;
        Ok(vector::sized(&document, self.units()))
    }

    /// [PNG](Self::png) and [SVG](Self::svg) of the same shapes, which are made once.
    ///
    /// # Errors
    /// As [`Figure::png`].
    pub fn pictures(&self) -> Result<(Vec<u8>, String), FigureError> {
        let layers = self.no_layers();
        let pixels = self.pixels(&layers)?;
        let (png, svg) = rayon::join(|| raster::png(&pixels), || self.svg_with(&layers));
        Ok((png?, svg?))
    }

    /// Room for the shapes of every panel's layers, which do not depend on the format.
    fn no_layers(&self) -> Vec<OnceLock<Picture>> {
        self.panels.iter().map(|_| OnceLock::new()).collect()
    }

    /// The size of the canvas.
    fn units(&self) -> (u32, u32) {
        let units = |inches: f64| (inches * 72.0 * POINT).round() as u32;
        (units(self.width), units(self.height))
    }

    /// Draws; the shapes of the layers are made where they are not there yet.
    fn draw_on<DB: DrawingBackend>(
        &self,
        backend: DB,
        layers: &[OnceLock<Picture>],
    ) -> Result<(), FigureError> {
        let (rows, columns) = (self.rows, self.columns);
        if self.panels.len() > rows * columns || self.panels.is_empty() {
            return Err(FigureError::PanelCount { panels: self.panels.len(), rows, columns });
        }
        let panels: Vec<Resolved> =
            self.panels.iter().map(Panel::resolve).collect::<Result<_, _>>()?;
        let (width, height) = self.units();
        let page = Rect { left: 0.0, top: 0.0, right: width.into(), bottom: height.into() };
        let mut area = page.grown(-PAGE_MARGIN);
        if !self.title.is_empty() {
            area.top += 1.5 * FIGURE_TITLE_SIZE * POINT;
        }
        let entries = match self.legend_below {
            true => legend::entries(self.panels.iter().flat_map(Panel::all_layers)),
            false => Vec::new(),
        };
        let legend_rows = legend::rows(&entries, area.width());
        if !entries.is_empty() {
            area.bottom -= legend_rows.len() as f64 * legend::ROW + LABEL_GAP;
        }
        let legend_top = area.bottom + LABEL_GAP;
        // The label of an upright bar is centred on the plots, which are shorter than the area by titles and axes.
        if let Some((bar, side)) = &self.color_bar {
            match side {
                Side::Right => area.right -= bar.breadth(*side, 0.85 * area.height()) + BAR_GAP,
                Side::Below => area.bottom -= bar.breadth(*side, area.width()) + BAR_GAP,
            }
        }
        let grid = Grid::fit(&panels, rows, columns, &area)?;
        let canvas = backend.into_drawing_area();
        let draw = || -> Drawn<DB> {
            canvas.fill(&WHITE)?;
            let style = text::style(FIGURE_TITLE_SIZE, Color::BLACK, HPos::Center, VPos::Top);
            canvas.draw_text(&self.title, &style, (width as i32 / 2, PAGE_MARGIN as i32))?;
            for (k, panel) in panels.iter().enumerate() {
                let (row, column) = (k / columns, k % columns);
                let (plot, margins) = (grid.plot(row, column), grid.margins(row, column));
                panel.draw(&canvas, plot, margins, &layers[k])?;
            }
            if let Some((bar, side)) = &self.color_bar {
                let (first, last) = (grid.plot(0, 0), grid.plot(rows - 1, columns - 1));
                let plots = Rect { right: last.right, bottom: last.bottom, ..first };
                let at = match side {
                    Side::Right => area.right + BAR_GAP,
                    Side::Below => area.bottom + BAR_GAP,
                };
                bar.draw(&canvas, *side, &plots, at)?;
            }
            draw_legend(&canvas, &legend_rows, 0.5 * page.right, legend_top)?;
            canvas.present()
        };
        draw().map_err(|error| FigureError::Drawing(error.to_string()))
    }
}

/// Draws the rows of a legend, each centred.
fn draw_legend<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    rows: &[(f64, Vec<&legend::Entry>)],
    middle: f64,
    top: f64,
) -> Drawn<DB> {
    let style = text::style(legend::SIZE, Color::BLACK, HPos::Left, VPos::Center);
    for (k, (wide, row)) in rows.iter().enumerate() {
        let mut x = middle - 0.5 * (wide - legend::SAMPLE);
        let y = (top + (k as f64 + 0.5) * legend::ROW).round() as i32;
        for entry in row {
            canvas.draw(&entry.sample().moved((x as i32, y)))?;
            let at = x + legend::SAMPLE + legend::GAP;
            canvas.draw_text(&entry.label, &style, (at as i32, y))?;
            x += entry.width() + legend::SAMPLE;
        }
    }
    Ok(())
}

/// The plots of all panels, aligned in rows and columns.
struct Grid {
    /// Where the plots of each column begin, with the margins.
    columns: Vec<(f64, Margins)>,
    rows: Vec<(f64, Margins)>,
    width: f64,
    height: f64,
}

impl Grid {
    fn fit(
        panels: &[Resolved],
        rows: usize,
        columns: usize,
        area: &Rect,
    ) -> Result<Grid, FigureError> {
        let (mut width, mut height) =
            (0.8 * area.width() / columns as f64, 0.8 * area.height() / rows as f64);
        let mut grid = Grid { columns: Vec::new(), rows: Vec::new(), width, height };
        // Margins depend on the ticks and these on the size: three rounds settle it.
        for _ in 0..3 {
            let mut across = vec![Margins::default(); columns];
            let mut down = vec![Margins::default(); rows];
            for (k, panel) in panels.iter().enumerate() {
                let margins = panel.margins(width, height);
                across[k % columns] = across[k % columns].max(margins);
                down[k / columns] = down[k / columns].max(margins);
            }
            let sides: f64 = across.iter().map(|m| m.left + m.right).sum();
            let ends: f64 = down.iter().map(|m| m.top + m.bottom).sum();
            width = (area.width() - sides - PANEL_GAP * (columns - 1) as f64) / columns as f64;
            height = (area.height() - ends - PANEL_GAP * (rows - 1) as f64) / rows as f64;
            if !(width >= 30.0 * POINT && height >= 30.0 * POINT) {
                let (width, height) = (width / POINT, height / POINT);
                return Err(FigureError::TooSmall { width, height });
            }
            // Each begins where the last one and its margins end.
            let placed =
                |margins: Vec<Margins>, start: f64, step: f64, ends: fn(&Margins) -> [f64; 2]| {
                    let mut next = start;
                    let place = |m: Margins| {
                        let first = next + ends(&m)[0];
                        next = first + step + ends(&m)[1] + PANEL_GAP;
                        (first, m)
                    };
                    margins.into_iter().map(place).collect()
                };
            grid = Grid {
                columns: placed(across, area.left, width, |m| [m.left, m.right]),
                rows: placed(down, area.top, height, |m| [m.top, m.bottom]),
                width,
                height,
            };
        }
        Ok(grid)
    }

    fn plot(&self, row: usize, column: usize) -> Rect {
        let (left, top) = (self.columns[column].0, self.rows[row].0);
        Rect { left, top, right: left + self.width, bottom: top + self.height }
    }

    fn margins(&self, row: usize, column: usize) -> Margins {
        let (beside, around) = (self.columns[column].1, self.rows[row].1);
        Margins { top: around.top, bottom: around.bottom, ..beside }
    }
}

#[cfg(test)]
mod tests;
