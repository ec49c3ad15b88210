use super::*;
use crate::figure::{Axis, Bands, Field, FilledContours, Isolines, Marker, Note, Series};
use ndarray::Array2;

fn map(n: usize, f: fn(f64, f64) -> f64, colors: Vec<Color>) -> (Panel, ColorBar) {
    let nodes: Vec<f64> = (0..n).map(|i| i as f64 / (n - 1) as f64).collect();
    let values = Array2::from_shape_fn((n, n), |(i, j)| f(nodes[i], nodes[j]));
    let field = Field::new(nodes.clone(), nodes, values).unwrap();
    let count = colors.len() as f64;
    let bands = Bands::new((0..=colors.len()).map(|k| k as f64 / count).collect(), colors).unwrap();
    let panel = Panel::new(Axis::linear("x [m] <&\">"), Axis::linear("y [m]"))
        .layer(FilledContours::new(field.clone(), bands.clone()))
        .layer(Isolines::new(field, [0.2, 0.5, 0.75]));
    (panel, ColorBar::new(bands, "value"))
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
        .layer(Note::new(0.05, 1e-5, "φ = π"));
    let four = vec![Color::BLUE, Color::SKY, Color::ORANGE, Color::VERMILION];
    let (panel, bar) = map(40, hills, four);
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
    assert_eq!(rich().png().unwrap(), rich().png().unwrap());
    assert_eq!(rich().svg().unwrap(), rich().svg().unwrap());
}

#[test]
fn svg_states_its_size_and_keeps_the_text() {
    let svg = rich().svg().unwrap();
    assert!(svg.contains("x [m] &lt;&amp;&quot;&gt;"));
    assert!(svg.contains("width=\"7in\" height=\"3.2in\" viewBox=\"0 0 10080 4608\""));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    let colors = (0..10).map(|k| Color(25 * k, 100, 200)).collect();
    let large = Figure::single(map(400, hills, colors).0).svg().unwrap();
    assert!(large.len() < 200_000, "{}", large.len());
}

/// The pixels of a figure of one map over the unit square, row by row.
fn pixels(f: fn(f64, f64) -> f64, colors: Vec<Color>) -> Vec<Vec<[u8; 3]>> {
    let (mut panel, _) = map(50, f, colors);
    panel.layers.truncate(1);
    let bytes = Figure::single(panel).size(2.0, 2.0).png().unwrap();
    let mut reader = png::Decoder::new(bytes.as_slice()).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size()];
    reader.next_frame(&mut pixels).unwrap();
    let colors: Vec<[u8; 3]> = pixels.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
    colors.chunks(600).map(<[_]>::to_vec).collect()
}

#[test]
fn bands_leave_no_seam_and_what_is_below_them_stays_blank() {
    // With all bands in one colour the plot is even.
    let rows = pixels(|x, y| (x * y).sqrt(), vec![Color::GREEN; 12]);
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
        let rows = pixels(f, vec![Color::BLUE]);
        rows.iter().flatten().filter(|p| **p == [0, 114, 178]).count() as f64
    };
    assert!((blue(|x, _| 3.0 * x - 1.0) / blue(|x, _| x) - 2.0 / 3.0).abs() < 0.01);
}

/// The boxes of the texts of an SVG, as the font sets them.
fn boxes(svg: &str) -> Vec<(String, Rect)> {
    let text = |element: &str| {
        let (attributes, letters) = element.split_once('>')?;
        let value = |name: &str| {
            let from = attributes.split_once(&format!(" {name}=\"")).expect("it is there").1;
            from.split_once('"').expect("it ends").0
        };
        let number = |name: &str| value(name).parse::<f64>().expect("a number");
        let (x, y, size) = (number("x"), number("y"), number("font-size"));
        let letters = letters.trim();
        let (wide, high) = (text::width(letters, size / POINT), text::CAP_HEIGHT * size);
        let back = match value("text-anchor") {
            "start" => 0.0,
            "middle" => 0.5 * wide,
            _ => wide,
        };
        let drop = match value("dy") {
            "0.76em" => 0.76 * size,
            "0.5ex" => 0.5 * 0.547 * size,
            _ => -0.5 * 0.547 * size,
        };
        let rect = match attributes.contains("rotate(270") {
            false => [x - back, y + drop - high, x - back + wide, y + drop],
            true => [x + drop - high, y + back - wide, x + drop, y + back],
        };
        let [left, top, right, bottom] = rect;
        (wide > 0.0).then(|| (letters.to_string(), Rect { left, top, right, bottom }))
    };
    svg.split("<text").skip(1).filter_map(|e| text(e.split("</text>").next()?)).collect()
}

#[test]
fn all_text_is_on_the_page_and_does_not_touch() {
    let x = Axis::linear("").range(0.0, 1.0).ticks((0..6).map(|k| (0.2 * f64::from(k), "wide")));
    for figure in [
        rich(),
        rich().size(5.0, 3.0),
        Figure::single(map(10, hills, vec![Color::SKY; 3]).0).size(2.4, 2.0),
        Figure::single(Panel::new(x, Axis::linear(""))),
    ] {
        let (width, height) = figure.units();
        let page = Rect { left: 0.0, top: 0.0, right: width.into(), bottom: height.into() };
        let boxes = boxes(&figure.svg().unwrap());
        assert!(boxes.len() > 8);
        for (k, (text, a)) in boxes.iter().enumerate() {
            assert!(page.contains([a.left, a.top]) && page.contains([a.right, a.bottom]), "{text}");
            for (other, b) in &boxes[..k] {
                let beside = b.right <= a.left || a.right <= b.left;
                let apart = beside || b.bottom <= a.top || a.bottom <= b.top;
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
    assert!(matches!(Figure::single(panel()).size(0.5, 0.5).png(), Err(FigureError::TooSmall(..))));
    // No data at all is an empty panel, not an error.
    assert!(Figure::single(panel()).png().is_ok());
}
