//! Figures: panels in a grid, with what they share.

use super::{
    bitmap,
    color_bar::{ColorBar, Side},
    error::FigureError,
    font,
    geometry::Rect,
    legend,
    panel::{Margins, Panel, Resolved},
    scene::{Anchor, Scene, Text},
    svg,
    typography::*,
};

/// Dots per inch of the PNG.
const DPI: f64 = 300.0;
/// Points per inch.
const POINTS: f64 = 72.0;

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
        let height = 0.6 + rows as f64 * width / columns.max(1) as f64 * 0.72;
        Figure {
            rows,
            columns,
            width,
            height,
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
        bitmap::png(&self.scene()?, DPI)
    }

    /// The picture as SVG; letters are outlines, so that it looks the same everywhere.
    ///
    /// # Errors
    /// As [`Figure::png`].
    pub fn svg(&self) -> Result<String, FigureError> {
        Ok(svg::svg(&self.scene()?))
    }

    /// [PNG](Self::png) and [SVG](Self::svg) of one layout, drawn at the same time.
    ///
    /// # Errors
    /// As [`Figure::png`].
    pub fn pictures(&self) -> Result<(Vec<u8>, String), FigureError> {
        let scene = self.scene()?;
        let (png, svg) = rayon::join(|| bitmap::png(&scene, DPI), || svg::svg(&scene));
        Ok((png?, svg))
    }

    fn scene(&self) -> Result<Scene, FigureError> {
        let (rows, columns) = (self.rows, self.columns);
        if self.panels.len() > rows * columns || self.panels.is_empty() {
            return Err(FigureError::PanelCount { panels: self.panels.len(), rows, columns });
        }
        let panels: Vec<Resolved> =
            self.panels.iter().map(Panel::resolve).collect::<Result<_, _>>()?;
        let mut scene = Scene::new(self.width * POINTS, self.height * POINTS);
        let page = Rect { left: 0.0, top: 0.0, right: scene.width, bottom: scene.height };
        let mut area = page.grown(-PAGE_MARGIN);
        if !self.title.is_empty() {
            let at = [0.5 * page.right, area.top + font::CAP_HEIGHT * FIGURE_TITLE_SIZE];
            scene.text(Text {
                anchor: Anchor::Middle,
                ..Text::new(self.title.clone(), at, FIGURE_TITLE_SIZE)
            });
            area.top += 1.5 * FIGURE_TITLE_SIZE;
        }
        if self.legend_below {
            let entries = legend::entries(self.panels.iter().flat_map(Panel::all_layers));
            let height = legend::height_in_rows(&entries, area.width());
            let rect = Rect { top: area.bottom - height, ..area };
            legend::draw_in_rows(&mut scene, &rect, &entries);
            area.bottom -= height + LABEL_GAP;
        }
        // An upright label is centred on the plots, which are shorter than the area by titles and axes.
        let color_bar = self.color_bar.as_ref().map(|(bar, side)| match side {
            Side::Right => (bar.wrapped(0.85 * area.height()), *side),
            Side::Below => (bar.clone(), *side),
        });
        match &color_bar {
            Some((bar, Side::Right)) => area.right -= bar.breadth_right() + BAR_GAP,
            Some((bar, Side::Below)) => area.bottom -= bar.breadth_below() + BAR_GAP,
            None => {}
        }
        let grid = Grid::fit(&panels, rows, columns, &area)?;
        for (k, panel) in panels.iter().enumerate() {
            let (row, column) = (k / columns, k % columns);
            panel.draw(&mut scene, grid.plot(row, column), grid.columns[column].1.left);
        }
        if let Some((bar, side)) = &color_bar {
            let (first, last) = (grid.plot(0, 0), grid.plot(rows - 1, columns - 1));
            let plots = Rect { right: last.right, bottom: last.bottom, ..first };
            let at = match side {
                Side::Right => area.right + BAR_GAP,
                Side::Below => area.bottom + BAR_GAP,
            };
            bar.draw(&mut scene, *side, &plots, at);
        }
        Ok(scene)
    }
}

/// The plots of all panels, aligned in rows and columns.
struct Grid {
    /// Left side of the plots and margins of each column.
    columns: Vec<(f64, Margins)>,
    /// Upper side of the plots of each row.
    rows: Vec<f64>,
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
            if !(width >= 30.0 && height >= 30.0) {
                return Err(FigureError::TooSmall { width, height });
            }
            let mut x = area.left;
            grid.columns = across
                .into_iter()
                .map(|m| {
                    let left = x + m.left;
                    x = left + width + m.right + PANEL_GAP;
                    (left, m)
                })
                .collect();
            let mut y = area.top;
            grid.rows = down
                .into_iter()
                .map(|m| {
                    let top = y + m.top;
                    y = top + height + m.bottom + PANEL_GAP;
                    top
                })
                .collect();
            (grid.width, grid.height) = (width, height);
        }
        Ok(grid)
    }

    fn plot(&self, row: usize, column: usize) -> Rect {
        let (left, top) = (self.columns[column].0, self.rows[row]);
        Rect { left, top, right: left + self.width, bottom: top + self.height }
    }
}

#[cfg(test)]
mod tests;
