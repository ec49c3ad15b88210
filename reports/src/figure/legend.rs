//! Legends: the names of layers beside samples of their look.

use super::{
    color::Color,
    geometry::Rect,
    layer::{Layer, Markers, Region},
    paint,
    picture::{Pen, Picture},
    text::{self, POINT},
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

/// Size of the names, in points.
pub(super) const SIZE: f64 = 7.8;
/// From line to line.
pub(super) const ROW: f64 = 1.55 * SIZE * POINT;
/// Length of a sample.
pub(super) const SAMPLE: f64 = 20.0 * POINT;
/// From sample to name.
pub(super) const GAP: f64 = 4.0 * POINT;

/// One line of a legend.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) label: String,
    line: Option<Pen>,
    markers: Option<Markers>,
    region: Option<Region>,
}

impl Entry {
    pub(super) fn width(&self) -> f64 {
        SAMPLE + GAP + text::width(&self.label, SIZE * POINT)
    }

    /// The look of the layers, in the middle of whose left side the picture has its place.
    pub(super) fn sample(&self) -> Picture {
        let mut picture = Picture::default();
        if let Some(region) = &self.region {
            let half = 0.4 * SIZE * POINT;
            let patch = Rect { left: 0.0, top: -half, right: SAMPLE, bottom: half };
            paint::patch(&mut picture, patch.corners(), region);
            picture.outline(&patch.corners(), Pen::solid(Color::GREY, 0.4));
        }
        if let Some(pen) = self.line {
            picture.stroke(&[[0.0, 0.0], [SAMPLE, 0.0]], pen);
        }
        if let Some(markers) = &self.markers {
            paint::marker(&mut picture, [0.5 * SAMPLE, 0.0], markers);
        }
        picture
    }
}

/// The entries of named layers; layers of the same name share one.
pub(super) fn entries<'a>(layers: impl IntoIterator<Item = &'a Layer>) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for layer in layers {
        let pen = |color, width, dash| Some(Pen { color, width, dash });
        let (label, line, markers, region) = match layer {
            Layer::Line(l) => (&l.label, pen(l.color, l.width, l.dash), None, None),
            Layer::Rule(l) => (&l.label, pen(l.color, l.width, l.dash), None, None),
            Layer::Markers(m) => (&m.label, None, Some(m), None),
            Layer::Region(r) => (&r.label, None, None, Some(r)),
            _ => continue,
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
        entry.line = entry.line.or(line);
        entry.markers = entry.markers.take().or(markers.cloned());
        entry.region = entry.region.take().or(region.cloned());
    }
    entries
}

/// The entries as rows no wider than `width`, and what each needs with the room before the next.
pub(super) fn rows(entries: &[Entry], width: f64) -> Vec<(f64, Vec<&Entry>)> {
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
    rows
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
        assert_eq!(rows(&entries, 1e6).len(), 1);
    }
}
