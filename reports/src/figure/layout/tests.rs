use super::*;
use crate::figure::{
    Axis, Bands, Color, Corner, ErrorBars, Field, FilledContours, Isolines, Line, Marker, Markers,
    Note, Region, Rule,
};

fn nodes(n: usize) -> Vec<f64> {
    (0..n).map(|i| i as f64 / (n - 1) as f64).collect()
}

fn bands(colors: Vec<Color>) -> Bands {
    let n = colors.len();
    Bands::new((0..=n).map(|k| k as f64 / n as f64).collect(), colors).unwrap()
}

fn map(n: usize, bands: Bands) -> Panel {
    let field = Field::from_fn(nodes(n), nodes(n), |x, y| {
        0.5 + 0.49 * (9.0 * x).sin() * (7.0 * y * y).cos()
    });
    let field = field.unwrap();
    Panel::new(Axis::linear("x [m] <&\">"), Axis::linear("y [m]"))
        .layer(FilledContours::new(field.clone(), bands))
        .layer(Isolines::new(field, [0.2, 0.5, 0.75]))
}

/// One of everything.
fn rich() -> Figure {
    let x = [0.01, 0.1, 1.0];
    let lines = Panel::new(Axis::log("κ h"), Axis::log("|g| − 1"))
        .title("(b) lines")
        .layer(
            Region::polygon([
                (0.01, 0.01),
                (1.0, 1.0),
                (1.0, f64::INFINITY),
                (0.01, f64::INFINITY),
            ])
            .fill(Color::SKY, 0.3)
            .hatch(Color::BLUE)
            .label("unstable"),
        )
        .layer(Line::xy(&x, &[1e-9, f64::NAN, 1.0]).label("run"))
        .layers((0..6).map(|k| Markers::new([(0.1, 0.1)], Marker::nth(k)).label("run")))
        .layer(ErrorBars::new([(0.1, 1e-3, 1e-2)]))
        .layer(Rule::vertical(0.5))
        .layer(Note::new(0.05, 1e-5, "φ = π"))
        .legend(Corner::BottomRight);
    let four = bands(vec![Color::BLUE, Color::SKY, Color::ORANGE, Color::VERMILION]);
    Figure::grid(1, 2)
        .size(7.0, 3.2)
        .title("A title")
        .panel(map(40, four.clone()).title("(a) map"))
        .panel(lines)
        .legend_below()
        .color_bar(ColorBar::new(four, "value"), Side::Below)
}

/// The elements of a document must close in the order in which they opened, with quoted attributes and no bare `&` or `<`.
fn assert_well_formed(svg: &str) {
    let mut open = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        let within = open.last().is_some_and(|name| *name == "text");
        assert!(
            within || rest[..start].trim().is_empty(),
            "text between elements: {}",
            &rest[..start]
        );
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
            continue;
        }
        let (body, closed) = tag.strip_suffix('/').map_or((tag, false), |body| (body, true));
        let (name, attributes) = body.split_once(' ').unwrap_or((body, ""));
        let parts: Vec<&str> = attributes.split('"').collect();
        assert_eq!(parts.len() % 2, 1, "quotes: {tag}");
        for pair in parts.chunks_exact(2) {
            assert!(pair[0].trim().ends_with('='), "{tag}");
            assert!(!pair[1].contains('<'), "{tag}");
            for (at, _) in pair[1].match_indices('&') {
                let entity = pair[1][at + 1..].split(';').next().unwrap();
                assert!(["amp", "lt", "gt", "quot"].contains(&entity), "{tag}");
            }
        }
        if !closed {
            open.push(name);
        }
    }
    assert!(open.is_empty() && rest.trim().is_empty(), "{open:?} {rest}");
}

#[test]
fn equal_figures_give_equal_bytes() {
    assert_eq!(rich().png().unwrap(), rich().png().unwrap());
    assert_eq!(rich().svg().unwrap(), rich().svg().unwrap());
}

#[test]
fn svg_is_well_formed_and_keeps_the_text() {
    let svg = rich().svg().unwrap();
    assert_well_formed(&svg);
    assert!(svg.contains("x [m] &lt;&amp;&quot;&gt;"));
    assert!(svg.contains("width=\"7in\" height=\"3.2in\" viewBox=\"0 0 10080 4608\""));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn large_maps_stay_small_as_svg() {
    let ten = bands((0..10).map(|k| Color::rgb(25 * k, 100, 200)).collect());
    let svg = Figure::single(map(400, ten)).svg().unwrap();
    assert!(svg.len() < 200_000, "{}", svg.len());
}

/// The pixels of a figure of one map of `f` over the unit square in blue bands, row by row.
fn pixels(f: fn(f64, f64) -> f64, bands: Bands) -> Vec<Vec<[u8; 3]>> {
    let field = Field::from_fn(nodes(50), nodes(50), f).unwrap();
    let panel =
        Panel::new(Axis::linear(""), Axis::linear("")).layer(FilledContours::new(field, bands));
    let bytes = Figure::single(panel).size(2.0, 2.0).png().unwrap();
    let mut reader = png::Decoder::new(bytes.as_slice()).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size()];
    reader.next_frame(&mut pixels).unwrap();
    let colors: Vec<[u8; 3]> = pixels.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
    colors.chunks(600).map(<[_]>::to_vec).collect()
}

#[test]
fn neighbouring_bands_leave_no_seam() {
    // With all bands in one colour the plot is even.
    let rows = pixels(|x, y| (x * y).sqrt(), bands(vec![Color::GREEN; 12]));
    let green = [0, 158, 115];
    let inside = |row: &&Vec<[u8; 3]>| row.iter().filter(|p| **p == green).count() > 100;
    let rows: Vec<_> = rows.iter().filter(inside).collect();
    assert!(rows.len() > 400);
    for row in rows {
        let [first, last] =
            [row.iter().position(|p| *p == green), row.iter().rposition(|p| *p == green)]
                .map(|p| p.expect("there are some"));
        assert!(row[first..=last].iter().all(|p| *p == green));
    }
}

#[test]
fn values_outside_the_bands_stay_blank() {
    // f = 3x - 1 lies in 0..=1 on a third of the plot.
    let all = pixels(|x, _| x, bands(vec![Color::BLUE]));
    let third = pixels(|x, _| 3.0 * x - 1.0, bands(vec![Color::BLUE]));
    let blue = |rows: &[Vec<[u8; 3]>]| {
        rows.iter().flatten().filter(|p| **p == [0, 114, 178]).count() as f64
    };
    assert!((blue(&third) / blue(&all) - 1.0 / 3.0).abs() < 0.01);
}

/// The boxes of the texts of an SVG.
fn boxes(svg: &str) -> Vec<(String, Rect)> {
    let text = |element: &str| {
        let value = |name: &str| {
            let start = element.find(name).expect("the attribute is there") + name.len();
            &element[start..start + element[start..].find('"').expect("it ends")]
        };
        let number = |name: &str| value(name).parse::<f64>().expect("a number");
        let letters = element[element.find('>')? + 1..].trim().to_string();
        let (x, y, size) = (number(" x=\""), number(" y=\""), number("font-size=\""));
        let wide = text::width(&letters, size);
        let back = wide
            * match value("text-anchor=\"") {
                "start" => 0.0,
                "middle" => 0.5,
                _ => 1.0,
            };
        let drop = match value("dy=\"") {
            "0.76em" => 0.76 * size,
            "0.5ex" => 0.5 * 0.547 * size,
            _ => -0.5 * 0.547 * size,
        };
        let high = text::CAP_HEIGHT * size;
        let rect = match element.contains("rotate(270") {
            false => Rect {
                left: x - back,
                top: y + drop - high,
                right: x - back + wide,
                bottom: y + drop,
            },
            true => Rect {
                left: x + drop - high,
                top: y + back - wide,
                right: x + drop,
                bottom: y + back,
            },
        };
        (wide > 0.0).then_some((letters, rect))
    };
    svg.split("<text").skip(1).filter_map(|e| text(e.split("</text>").next()?)).collect()
}

#[test]
fn all_text_is_on_the_page_and_does_not_touch() {
    let x = Axis::linear("").range(0.0, 1.0).ticks((0..6).map(|k| (0.2 * f64::from(k), "wide")));
    for figure in [
        rich(),
        rich().size(5.0, 3.0),
        Figure::single(map(10, bands(vec![Color::SKY; 3]))).size(2.4, 2.0),
        Figure::single(Panel::new(x, Axis::linear(""))),
    ] {
        let (width, height) = figure.units();
        let page = Rect { left: 0.0, top: 0.0, right: width.into(), bottom: height.into() };
        let boxes = boxes(&figure.svg().unwrap());
        assert!(boxes.len() > 8);
        for (k, (text, a)) in boxes.iter().enumerate() {
            assert!(page.contains([a.left, a.top]) && page.contains([a.right, a.bottom]), "{text}");
            for (other, b) in &boxes[..k] {
                let apart = b.right <= a.left
                    || a.right <= b.left
                    || b.bottom <= a.top
                    || a.bottom <= b.top;
                assert!(apart, "{text} {a:?} touches {other} {b:?}");
            }
        }
    }
}

#[test]
fn impossible_figures_are_errors() {
    let panel = || Panel::new(Axis::linear("x"), Axis::linear("y"));
    assert!(matches!(Figure::grid(1, 1).svg(), Err(FigureError::PanelCount { panels: 0, .. })));
    let two = Figure::grid(1, 1).panels([panel(), panel()]);
    assert!(matches!(two.svg(), Err(FigureError::PanelCount { panels: 2, .. })));
    assert!(matches!(
        Figure::single(panel()).size(0.5, 0.5).png(),
        Err(FigureError::TooSmall { .. })
    ));
    let bad = Panel::new(Axis::log("x").range(-1.0, 1.0), Axis::linear("y"));
    assert!(matches!(Figure::single(bad).png(), Err(FigureError::AxisRange { .. })));
    // No data at all is an empty panel, not an error.
    assert!(Figure::single(panel()).png().is_ok());
}
