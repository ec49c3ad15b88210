//! The legend below all panels: names of layers beside samples of their look. Plotters' own has but one column in a
//! corner of one plot, and measures its text without the font.

use super::{
    color::Color,
    geometry::Rect,
    ink::{Drawn, Ink, Pen},
    layer::Layer,
    text::{self, POINT},
};
use plotters::style::{
    FontTransform,
    text_anchor::{HPos, VPos},
};

/// Size of the names, in points.
const SIZE: f64 = 7.8;
/// From line to line.
pub(super) const ROW: f64 = 1.55 * SIZE * POINT;
/// Length of a sample, and of the room between entries.
const SAMPLE: f64 = 20.0 * POINT;
/// From sample to name.
const GAP: f64 = 4.0 * POINT;

/// A name and the layers that bear it.
pub(super) type Entry<'a> = (&'a str, Vec<&'a Layer>);

/// The entries of named layers as rows no wider than `room`; layers of the same name share one.
pub(super) fn rows<'a>(
    layers: impl IntoIterator<Item = &'a Layer>,
    room: f64,
) -> Vec<Vec<Entry<'a>>> {
    let mut entries: Vec<Entry> = Vec::new();
    for layer in layers {
        let label = match layer {
            Layer::Line(l) => &l.label,
            Layer::Markers(l) => &l.label,
            Layer::FilledContours(l) => &l.label,
            Layer::Isolines(l) => &l.label,
            Layer::Note(_) => continue,
        };
        match entries.iter_mut().find(|entry| entry.0 == label) {
            _ if label.is_empty() => {}
            Some(entry) => entry.1.push(layer),
            None => entries.push((label, vec![layer])),
        }
    }
    let mut rows: Vec<Vec<Entry>> = Vec::new();
    for entry in entries {
        match rows.last_mut() {
            Some(row) if width(row) + width(std::slice::from_ref(&entry)) <= room + SAMPLE => {
                row.push(entry)
            }
            _ => rows.push(vec![entry]),
        }
    }
    rows
}

/// What entries need, each with the room before the next.
fn width(row: &[Entry]) -> f64 {
    row.iter().map(|entry| 2.0 * SAMPLE + GAP + text::width(entry.0, SIZE * POINT)).sum()
}

/// Draws rows from `top` down, each centred on `middle`.
pub(super) fn draw(canvas: &impl Ink, rows: &[Vec<Entry>], middle: f64, top: f64) -> Drawn {
    let to = (HPos::Left, VPos::Center, FontTransform::None);
    for (k, row) in rows.iter().enumerate() {
        let y = top + (k as f64 + 0.5) * ROW;
        for (n, (label, layers)) in row.iter().enumerate() {
            let x = middle - 0.5 * (width(row) - SAMPLE) + width(&row[..n]);
            for layer in layers {
                sample(canvas, layer, [x, y])?;
            }
            canvas.write(label, SIZE, [x + SAMPLE + GAP, y], to.clone())?;
        }
    }
    Ok(())
}

/// The look of a layer, to the right of a place.
fn sample(canvas: &impl Ink, layer: &Layer, [x, y]: [f64; 2]) -> Drawn {
    let line = [[x, y], [x + SAMPLE, y]];
    match layer {
        Layer::Line(l) => {
            canvas.stroke(&line, Pen { color: l.color, width: l.width, dash: l.dash })
        }
        Layer::Isolines(l) => canvas.stroke(&line, Pen::solid(l.color, l.width)),
        Layer::Markers(m) => canvas.marker([x + 0.5 * SAMPLE, y], m),
        Layer::FilledContours(l) => {
            let half = 0.4 * SIZE * POINT;
            let patch = Rect { left: x, top: y - half, right: x + SAMPLE, bottom: y + half };
            canvas.fill(&[patch.corners()], l.bands.colors[0])?;
            canvas.outline(&patch.corners(), Pen::solid(Color::GREY, 0.4))
        }
        Layer::Note(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Line, Marker, Markers};

    #[test]
    fn layers_of_one_name_share_an_entry() {
        let layers: [Layer; 4] = [
            Line::new([]).label("a").into(),
            Markers::new([], Marker::Circle).label("a").into(),
            Line::new([]).into(),
            Line::vertical(1.0).label("b").into(),
        ];
        let rows = |room: f64| -> Vec<Vec<usize>> {
            let rows = rows(&layers, room).into_iter();
            rows.map(|row| row.iter().map(|entry| entry.1.len()).collect()).collect()
        };
        // Each row holds at least one entry, however narrow the page.
        assert_eq!((rows(1.0), rows(1e6)), (vec![vec![2], vec![1]], vec![vec![2, 1]]));
    }
}
