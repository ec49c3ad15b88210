use super::*;
use crate::figure::{Axis, Bands, Contours, Marker, Series};
use crate::level_set::Field;
use ndarray::Array2;
use resvg::usvg::{Group, Node, Tree};
use std::io::Cursor;

fn map(n: usize, f: fn(f64, f64) -> f64, colors: &[Color]) -> (Contours, ColorBar) {
    let nodes: Vec<f64> = (0..n).map(|i| i as f64 / (n - 1) as f64).collect();
    let values = Array2::from_shape_fn((n, n), |(i, j)| f(nodes[i], nodes[j]));
    let last = (colors.len() - 1) as f64;
    let edges = (0..=colors.len()).map(|k| k as f64 / (last + 1.0)).collect();
    let bands = Bands::new(edges, |t| colors[(t * last).round() as usize]);
    let field = Field::new(nodes.clone(), nodes, values).unwrap();
    (Contours::new(field).bands(bands.clone()), ColorBar::new(bands, "value"))
}

/// A map with isolines.
fn labelled(n: usize, colors: &[Color]) -> (Panel, ColorBar) {
    let (contours, bar) = map(n, hills, colors);
    let panel = Panel::new(Axis::linear("x [m] <&\">"), Axis::linear("y [m]"));
    (panel.contours(contours.isolines([0.2, 0.5, 0.75])), bar)
}

fn hills(x: f64, y: f64) -> f64 {
    0.5 + 0.49 * (9.0 * x).sin() * (7.0 * y * y).cos()
}

/// One of everything.
fn rich() -> Figure {
    let lines = Panel::new(Axis::log("κ h"), Axis::log("|g| − 1"))
        .title("(b) lines")
        .layer(Series::line([(0.01, 1e-9), (0.1, f64::NAN), (1.0, 1.0)]).label("run"))
        .layers((0..6).map(|k| Series::markers([(0.1, 0.1)], Marker::nth(k)).label("run")))
        .layer(Series::vertical(0.5).label("limit"))
        .note(0.05, 1e-5, "φ = π");
    let four = [Color::BLUE, Color::SKY, Color::ORANGE, Color::VERMILION];
    let (panel, bar) = labelled(40, &four);
    Figure::grid(1, 2)
        .size(7.0, 3.2)
        .title("A title that is so long that it takes more than a single line where the page is narrow as here")
        .panel(panel.title("(a) map"))
        .panel(lines)
        .color_bar(bar.clone())
        .color_bar(bar)
}

#[test]
fn equal_figures_give_equal_bytes() {
    let [one, other] = [rich(), rich()].map(|figure| figure.svg().unwrap());
    assert_eq!(one, other);
    assert_eq!(one.png().unwrap(), other.png().unwrap());
}

#[test]
fn svg_states_its_size_and_keeps_the_text() {
    let svg = rich().svg().unwrap();
    assert!(svg.0.contains("x [m] &lt;&amp;&quot;&gt;"));
    assert!(svg.0.contains("width=\"7in\" height=\"3.2in\" viewBox=\"0 0 10080 4608\""));
    assert!(!svg.0.contains("NaN") && !svg.0.contains("inf"));
    let colors: Vec<Color> = (0..10).map(|k| Color(25 * k, 100, 200)).collect();
    let large = Figure::single(labelled(400, &colors).0).svg().unwrap();
    assert!(large.0.len() < 200_000, "{}", large.0.len());
}

/// The pixels of a figure of one map over the unit square, row by row.
fn pixels(f: fn(f64, f64) -> f64, colors: &[Color]) -> Vec<Vec<[u8; 3]>> {
    let panel = Panel::new(Axis::linear("x"), Axis::linear("y")).contours(map(50, f, colors).0);
    let bytes = Figure::single(panel).size(2.0, 2.0).svg().unwrap().png().unwrap();
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let colors: Vec<[u8; 3]> = pixels.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
    colors.chunks(600).map(<[_]>::to_vec).collect()
}

#[test]
fn bands_leave_no_seam_and_what_is_below_them_stays_blank() {
    // With all bands in one colour the plot is even.
    let rows = pixels(|x, y| (x * y).sqrt(), &[Color::GREEN; 12]);
    let green = |p: &[u8; 3]| *p == [0, 158, 115];
    let rows: Vec<_> =
        rows.iter().filter(|row| row.iter().filter(|p| green(p)).count() > 100).collect();
    assert!(rows.len() > 300);
    for row in rows {
        let ends = (row.iter().position(green), row.iter().rposition(green));
        let (first, last) = (ends.0.unwrap(), ends.1.unwrap());
        assert!(row[first..=last].iter().all(green));
    }
    // 3x - 1 is at least 0 on two thirds of the plot.
    let blue = |f| {
        let rows = pixels(f, &[Color::BLUE]);
        rows.iter().flatten().filter(|p| **p == [0, 114, 178]).count() as f64
    };
    assert!((blue(|x, _| 3.0 * x - 1.0) / blue(|x, _| x) - 2.0 / 3.0).abs() < 0.01);
}

/// The texts of a picture and the boxes of their letters, as resvg sets them.
fn boxes(group: &Group) -> Vec<(String, [f32; 4])> {
    let of_node = |node: &Node| match node {
        Node::Group(group) => boxes(group),
        Node::Text(text) => {
            let letters = text.chunks().iter().map(|chunk| chunk.text()).collect();
            // In the text's own directions: that of the letters on the page takes the turn twice.
            let own = text.flattened().bounding_box();
            let area = own.transform(text.abs_transform()).unwrap();
            vec![(letters, [area.left(), area.top(), area.right(), area.bottom()])]
        }
        _ => Vec::new(),
    };
    group.children().iter().flat_map(of_node).collect()
}

#[test]
fn all_text_is_on_the_page_and_does_not_touch() {
    let x = Axis::linear("").range(0.0, 1.0).ticks((0..6).map(|k| (0.2 * f64::from(k), "wide")));
    for figure in [
        rich(),
        rich().size(5.0, 3.0),
        Figure::single(labelled(10, &[Color::SKY; 3]).0).size(2.4, 2.0),
        Figure::single(Panel::new(x, Axis::linear(""))),
    ] {
        let picture =
            Tree::from_str(&figure.svg().unwrap().0, &super::super::raster::OPTIONS).unwrap();
        let [width, height] = [picture.size().width(), picture.size().height()];
        let boxes = boxes(picture.root());
        assert!(boxes.len() > 8);
        for (k, (text, a)) in boxes.iter().enumerate() {
            assert!(a[0] >= 0.0 && a[1] >= 0.0 && a[2] <= width && a[3] <= height, "{text} {a:?}");
            for (other, b) in &boxes[..k] {
                let apart = b[2] <= a[0] || a[2] <= b[0] || b[3] <= a[1] || a[3] <= b[1];
                assert!(apart, "{text} {a:?} touches {other} {b:?}");
            }
        }
    }
}

#[test]
fn impossible_figures_are_errors() {
    let panel = || Panel::new(Axis::linear("x"), Axis::linear("y"));
    assert!(matches!(Figure::grid(1, 1).svg(), Err(FigureError::PanelCount(0, 1, 1))));
    let two = Figure::grid(1, 1).panels([panel(), panel()]);
    assert!(matches!(two.svg(), Err(FigureError::PanelCount(2, 1, 1))));
    assert!(matches!(Figure::single(panel()).size(0.5, 0.5).svg(), Err(FigureError::TooSmall(..))));
    // No data at all is an empty panel, not an error, and so is a title that no XML can hold.
    let svg = Figure::single(panel().title("a\u{1}b\u{ffff}")).svg().unwrap();
    assert!(svg.0.contains("a\u{fffd}b\u{fffd}") && svg.png().is_ok());
}
