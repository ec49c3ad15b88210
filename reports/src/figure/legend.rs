//! Legends: the names of layers beside samples of their look.

use super::{
    area::Region,
    color::Color,
    curve::Markers,
    font,
    geometry::Rect,
    layer::Layer,
    plot,
    scene::{Pen, Scene, Text},
    typography::{FRAME_WIDTH, LEGEND_SIZE},
};

/// The corner of a panel in which its legend stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}

const ROW: f64 = 1.4 * LEGEND_SIZE;
const SAMPLE: f64 = 20.0;
const GAP: f64 = 4.0;
const PAD: f64 = 3.5;
/// From the frame of the panel to the legend.
const INSET: f64 = 5.0;

/// One line of a legend.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    label: String,
    line: Option<Pen>,
    markers: Option<Markers>,
    region: Option<Region>,
}

impl Entry {
    fn width(&self) -> f64 {
        SAMPLE + GAP + font::width(&self.label, LEGEND_SIZE)
    }
}

/// The entries of named layers; layers of the same name share one.
pub(super) fn entries<'a>(layers: impl IntoIterator<Item = &'a Layer>) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for layer in layers {
        let (label, line, markers, region) = match layer {
            Layer::Line(l) => (&l.label, Some((l.color, l.width, l.dash)), None, None),
            Layer::Rule(l) => (&l.label, Some((l.color, l.width, l.dash)), None, None),
            Layer::Isolines(l) => (&l.label, Some((l.color, l.width, l.dash)), None, None),
            Layer::Markers(m) => (&m.label, None, Some(m), None),
            Layer::Region(r) => (&r.label, None, None, Some(r)),
            Layer::ErrorBars(_) | Layer::FilledContours(_) | Layer::Note(_) => continue,
        };
        if label.is_empty() {
            continue;
        }
        let known = entries.iter().position(|e| e.label == *label).unwrap_or_else(|| {
            let label = label.clone();
            entries.push(Entry { label, line: None, markers: None, region: None });
            entries.len() - 1
        });
        let entry = &mut entries[known];
        if let Some((color, width, dash)) = line {
            entry.line.get_or_insert(Pen { color, width, dash: dash.lengths(width) });
        }
        if let Some(markers) = markers {
            entry.markers.get_or_insert(Markers { points: Vec::new(), ..markers.clone() });
        }
        if let Some(region) = region {
            entry.region.get_or_insert(Region { outline: Vec::new(), ..region.clone() });
        }
    }
    entries
}

/// Draws a legend with a white backing in a corner of the rectangle.
pub(super) fn draw_in_corner(scene: &mut Scene, rect: &Rect, corner: Corner, entries: &[Entry]) {
    if entries.is_empty() {
        return;
    }
    let width = entries.iter().map(Entry::width).fold(0.0, f64::max) + 2.0 * PAD;
    let height = entries.len() as f64 * ROW + 1.2 * PAD;
    let left = match corner {
        Corner::TopLeft | Corner::BottomLeft => rect.left + INSET,
        Corner::TopRight | Corner::BottomRight => rect.right - INSET - width,
    };
    let top = match corner {
        Corner::TopLeft | Corner::TopRight => rect.top + INSET,
        Corner::BottomLeft | Corner::BottomRight => rect.bottom - INSET - height,
    };
    let back = Rect { left, top, right: left + width, bottom: top + height };
    scene.fill(vec![back.corners()], Color::WHITE, 0.93);
    scene.outline(back.corners(), Pen::solid(Color::rgb(190, 190, 190), 0.6 * FRAME_WIDTH));
    for (k, entry) in entries.iter().enumerate() {
        draw_entry(scene, entry, left + PAD, top + 0.6 * PAD + (k as f64 + 0.5) * ROW);
    }
}

/// The entries as rows no wider than `width`.
fn rows(entries: &[Entry], width: f64) -> Vec<Vec<&Entry>> {
    let mut rows: Vec<(f64, Vec<&Entry>)> = Vec::new();
    for entry in entries {
        let needed = entry.width() + SAMPLE;
        match rows.last_mut() {
            Some((used, row)) if *used + needed <= width + SAMPLE => {
                *used += needed;
                row.push(entry);
            }
            _ => rows.push((needed, vec![entry])),
        }
    }
    rows.into_iter().map(|(_, row)| row).collect()
}

/// The height of a legend in rows of the given width.
pub(super) fn height_in_rows(entries: &[Entry], width: f64) -> f64 {
    rows(entries, width).len() as f64 * ROW
}

/// Draws a legend in centred rows.
pub(super) fn draw_in_rows(scene: &mut Scene, rect: &Rect, entries: &[Entry]) {
    for (k, row) in rows(entries, rect.width()).into_iter().enumerate() {
        let total: f64 = row.iter().map(|e| e.width() + SAMPLE).sum::<f64>() - SAMPLE;
        let mut x = rect.left + 0.5 * (rect.width() - total);
        for entry in row {
            draw_entry(scene, entry, x, rect.top + (k as f64 + 0.5) * ROW);
            x += entry.width() + SAMPLE;
        }
    }
}

fn draw_entry(scene: &mut Scene, entry: &Entry, x: f64, y: f64) {
    if let Some(region) = &entry.region {
        let half = 0.4 * LEGEND_SIZE;
        let patch = Rect { left: x, top: y - half, right: x + SAMPLE, bottom: y + half };
        plot::draw_patch(scene, patch.corners(), region);
        scene.outline(patch.corners(), Pen::solid(Color::GREY, 0.6 * FRAME_WIDTH));
    }
    if let Some(pen) = &entry.line {
        scene.stroke(vec![vec![[x, y], [x + SAMPLE, y]]], pen.clone());
    }
    if let Some(markers) = &entry.markers {
        plot::draw_marker(scene, [x + 0.5 * SAMPLE, y], markers);
    }
    let baseline = y + 0.5 * font::CAP_HEIGHT * LEGEND_SIZE;
    scene.text(Text::new(entry.label.clone(), [x + SAMPLE + GAP, baseline], LEGEND_SIZE));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Line, Marker, Rule};

    #[test]
    fn layers_of_one_name_share_an_entry() {
        let layers: [Layer; 4] = [
            Line::new([]).label("a").into(),
            Markers::new([], Marker::Circle).label("a").into(),
            Line::new([]).into(),
            Rule::vertical(1.0).label("b").into(),
        ];
        let entries = entries(&layers);
        assert_eq!(entries.len(), 2);
        assert!(entries[0].line.is_some() && entries[0].markers.is_some());
        // Each row holds at least one entry, however narrow the page.
        assert_eq!(rows(&entries, 1.0).len(), 2);
        assert_eq!(rows(&entries, 1000.0).len(), 1);
    }
}
