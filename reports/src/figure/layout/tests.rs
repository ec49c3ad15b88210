use super::*;
use crate::figure::{
    Axis, Bands, Color, Corner, ErrorBars, Field, FilledContours, Isolines, Line, Marker, Markers,
    Note, Region, Rule, geometry::Point, scene::Shape,
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
            Region::between(&x, &x, &[f64::INFINITY; 3])
                .fill(Color::SKY, 0.3)
                .hatch(Color::BLUE)
                .label("unstable"),
        )
        .layer(Line::xy(&x, &[1e-9, f64::NAN, 1.0]).label("run"))
        .layers((0..6).map(|k| Markers::new([(0.1, 0.1)], Marker::nth(k)).label("run")))
        .layer(ErrorBars::new([(0.1, 1e-3, 1e-2)]))
        .layer(Rule::vertical(0.5))
        .layer(Note::new(0.05, 1e-5, "φ = π").angle(30.0))
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
        assert!(rest[..start].trim().is_empty(), "text between elements: {}", &rest[..start]);
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
    assert!(svg.contains("aria-label=\"x [m] &lt;&amp;&quot;&gt;\""));
    assert!(svg.contains("width=\"7in\" height=\"3.2in\" viewBox=\"0 0 50400 23040\""));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn large_maps_stay_small_as_svg() {
    let ten = bands((0..10).map(|k| Color::rgb(25 * k, 100, 200)).collect());
    let svg = Figure::single(map(400, ten)).svg().unwrap();
    assert!(svg.len() < 200_000, "{}", svg.len());
}

#[test]
fn neighbouring_bands_leave_no_seam() {
    // With all bands in one colour the plot must be even, in every pixel within the frame.
    let panel = |c| {
        let field = Field::from_fn(nodes(50), nodes(50), |x, y| (x * y).sqrt()).unwrap();
        Panel::new(Axis::linear(""), Axis::linear(""))
            .layer(FilledContours::new(field, bands(vec![c; 12])))
    };
    let figure = Figure::single(panel(Color::GREEN)).size(2.0, 2.0);
    let mut frame = None;
    for (clip, _) in figure.scene().unwrap().items {
        frame = frame.or(clip);
    }
    let frame = frame.expect("layers are cut to the frame").grown(-FRAME_WIDTH);
    let bytes = figure.png().unwrap();
    let mut reader = png::Decoder::new(bytes.as_slice()).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size()];
    reader.next_frame(&mut pixels).unwrap();
    let scale = DPI / POINTS;
    let range =
        |low: f64, high: f64| (low * scale).ceil() as usize..(high * scale).floor() as usize;
    for row in range(frame.top, frame.bottom) {
        for column in range(frame.left, frame.right) {
            let at = 3 * (row * 600 + column);
            assert_eq!(pixels[at..at + 3], [0, 158, 115], "({column}, {row})");
        }
    }
}

#[test]
fn values_outside_the_bands_stay_blank() {
    let field = Field::from_fn(nodes(20), nodes(20), |x, _| 3.0 * x - 1.0).unwrap();
    let bands = Bands::new(vec![0.0, 1.0], vec![Color::BLUE]).unwrap();
    let panel =
        Panel::new(Axis::linear(""), Axis::linear("")).layer(FilledContours::new(field, bands));
    let scene = Figure::single(panel).scene().unwrap();
    let frame = scene.items.iter().find_map(|(clip, _)| *clip).unwrap();
    let rings = scene
        .items
        .iter()
        .find_map(|(_, shape)| match shape {
            Shape::Fill { rings, color: Color::BLUE, .. } => Some(rings),
            _ => None,
        })
        .unwrap();
    let signed = |r: &Vec<Point>| -> f64 {
        (0..r.len())
            .map(|k| (r[k], r[(k + 1) % r.len()]))
            .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
            .sum()
    };
    // f = 3x - 1 lies in 0..=1 on a third of the plot; simplified rings keep to within 0.01 point.
    let painted = rings.iter().map(signed).sum::<f64>().abs();
    assert!((painted / (frame.width() * frame.height()) - 1.0 / 3.0).abs() < 1e-4);
}

#[test]
fn all_text_is_on_the_page_and_tick_labels_do_not_touch() {
    // Without labels of its own the y axis leaves little room for the first label of the x axis.
    let x = Axis::linear("").range(0.0, 1.0).ticks((0..12).map(|k| (0.1 * f64::from(k), "wide")));
    let bare = Panel::new(x, Axis::linear("").without_tick_labels());
    for figure in [
        rich(),
        rich().size(5.0, 3.0),
        Figure::single(map(10, bands(vec![Color::SKY; 3]))).size(2.4, 2.0),
        Figure::single(bare),
    ] {
        let scene = figure.scene().unwrap();
        let page = Rect { left: 0.0, top: 0.0, right: scene.width, bottom: scene.height };
        let mut boxes: Vec<Rect> = Vec::new();
        for (clip, shape) in &scene.items {
            let Shape::Text(text) = shape else { continue };
            let [x, y] = text.origin();
            let (w, h) = (font::width(&text.text, text.size), font::CAP_HEIGHT * text.size);
            let rect = match text.angle {
                90.0 => Rect { left: x - h, top: y - w, right: x, bottom: y },
                _ => Rect { left: x, top: y - h, right: x + w, bottom: y },
            };
            assert!(
                page.contains([rect.left, rect.top]) && page.contains([rect.right, rect.bottom]),
                "{text:?}"
            );
            if clip.is_none() {
                let apart = |b: &Rect| {
                    b.right <= rect.left
                        || rect.right <= b.left
                        || b.bottom <= rect.top
                        || rect.bottom <= b.top
                };
                assert!(boxes.iter().all(apart), "{text:?}");
                boxes.push(rect);
            }
        }
        assert!(boxes.len() > 10);
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
