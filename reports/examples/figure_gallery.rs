//! Draws a gallery of figures into a directory (default `target/gallery`): `cargo run --example figure_gallery [-- DIR]`.
//!
//! The data are analytic; the pictures show what the drawing layer can do.

use courant_reports::figure::{
    Anchor, Axis, Bands, Color, ColorBar, ColorMap, Corner, Dash, ErrorBars, Field, Figure,
    FigureError, FilledContours, Isolines, Line, Marker, Markers, Note, Panel, Region, Rule, Side,
};
use std::{error::Error, f64::consts::PI, fs, path::PathBuf, time::Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let directory = std::env::args().nth(1).map_or_else(|| "target/gallery".into(), PathBuf::from);
    fs::create_dir_all(&directory)?;
    for (name, figure) in [
        ("maps", maps()?),
        ("map_single", map_single()?),
        ("convergence", convergence()),
        ("profiles", profiles()),
    ] {
        let start = Instant::now();
        let png = figure.png()?;
        let middle = Instant::now();
        let svg = figure.svg()?;
        println!(
            "{name}: PNG {} kB in {:.0?}, SVG {} kB in {:.0?}",
            png.len() / 1000,
            middle - start,
            svg.len() / 1000,
            middle.elapsed()
        );
        fs::write(directory.join(format!("{name}.png")), png)?;
        fs::write(directory.join(format!("{name}.svg")), svg)?;
    }
    Ok(())
}

fn nodes(n: usize, low: f64, high: f64) -> Vec<f64> {
    (0..n).map(|i| low + (high - low) * i as f64 / (n - 1) as f64).collect()
}

/// |g| of Lax–Wendroff advection with a damping that depends on the panel: g = 1 − iC sin φ − C²(1 − cos φ) − d(1 − cos φ).
fn amplification(phase: f64, courant: f64, damping: f64) -> f64 {
    let s = 1.0 - phase.cos();
    (1.0 - (courant * courant + damping) * s).hypot(courant * phase.sin())
}

/// Four maps with limit curve, published points and one colour bar.
fn maps() -> Result<Figure, FigureError> {
    let edges = vec![0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0];
    let bands = Bands::two_sided(edges, 1.0)?.extend_above(Color::DARK_RED);
    let mut figure = Figure::grid(2, 2)
        .size(7.0, 5.8)
        .title("Amplification per step of a damped Lax–Wendroff scheme")
        .color_bar(ColorBar::new(bands.clone(), "|g|"), Side::Right);
    for (k, damping) in [0.0, 0.1, 0.25, 0.4].into_iter().enumerate() {
        let field = Field::from_fn(nodes(400, 0.0, PI), nodes(400, 0.0, 1.6), |phase, c| {
            amplification(phase, c, damping)
        })?;
        let limit = (1.0 - damping).sqrt();
        let letter = char::from(b'a' + k as u8);
        let panel = Panel::new(
            Axis::linear("phase φ = κΔx").range(0.0, PI).ticks([
                (0.0, "0"),
                (0.25 * PI, "π/4"),
                (0.5 * PI, "π/2"),
                (0.75 * PI, "3π/4"),
                (PI, "π"),
            ]),
            Axis::linear("Courant number C = cΔt/Δx").range(0.0, 1.6),
        )
        .title(format!("({letter}) d = {damping}"))
        .layer(FilledContours::new(field.clone(), bands.clone()))
        .layer(Isolines::new(field, [0.4, 0.8, 1.25]))
        .layer(Line::new([(0.0, limit), (PI, limit)]).width(1.8).label("proved limit"))
        .layer(
            Markers::new(
                (1..8).map(|i| (f64::from(i) * PI / 8.0, limit + 0.03 * f64::from(i % 3 - 1))),
                Marker::Circle,
            )
            .fill(Color::WHITE)
            .size(4.5)
            .label("published"),
        )
        .legend(Corner::TopLeft);
        figure = figure.panel(panel);
    }
    Ok(figure)
}

/// A sequential map on logarithmic axes with blank cells, a hatched region and its own colour bar.
fn map_single() -> Result<Figure, FigureError> {
    let log_nodes = |n: usize, low: f64, high: f64| -> Vec<f64> {
        nodes(n, low.log10(), high.log10()).into_iter().map(|p| 10f64.powf(p)).collect()
    };
    let (x, y) = (log_nodes(200, 1e-2, 1e2), log_nodes(200, 1e-3, 1e1));
    let field = Field::from_fn(x.clone(), y, |x, y| {
        if x * y > 200.0 {
            f64::NAN
        } else {
            (x / (1.0 + y * x)).log10() + 0.3 * (3.0 * x.ln()).sin()
        }
    })?;
    let edges: Vec<f64> = (-4..=4).map(|k| 0.5 * f64::from(k)).collect();
    let bands = Bands::sequential(edges, ColorMap::Viridis)?
        .extend_above(ColorMap::Viridis.at(1.0))
        .extend_below(ColorMap::Viridis.at(0.0));
    let lower: Vec<f64> = x.iter().map(|x| 2.0 / x.powf(0.6)).collect();
    let panel = Panel::new(Axis::log("drag parameter ξ"), Axis::log("Δt / t_stop"))
        .layer(FilledContours::new(field.clone(), bands.clone()))
        .layer(Isolines::new(field, [-1.0, 0.0, 1.0]).color(Color::WHITE))
        .layer(
            Region::polygon(
                x.iter()
                    .copied()
                    .zip(lower.iter().copied())
                    .chain([(1e2, f64::INFINITY), (1e-2, f64::INFINITY)]),
            )
            .hatch(Color::WHITE)
            .label("unstable"),
        )
        .layer(Line::xy(&x, &lower).color(Color::VERMILION).width(1.6))
        .layer(Note::new(1.0, 2.5e-3, "over-damped"))
        .color_bar(ColorBar::new(bands, "log₁₀ of the decay time"));
    Ok(Figure::single(panel).size(4.5, 3.4))
}

/// Errors against resolution, with guide lines and spread.
fn convergence() -> Figure {
    let h: Vec<f64> = (0..7).map(|k| 0.1 / f64::from(1 << k)).collect();
    let wobble = |k: usize| 1.0 + 0.12 * ((3 * k) as f64).sin();
    let mut panel =
        Panel::new(Axis::log("resolution h [m]"), Axis::log("L₁ error of the density [kg m⁻³]"))
            .title("Convergence of three schemes");
    for (i, (name, order, factor)) in
        [("first order", 1.0, 0.5), ("second order", 2.0, 1.5), ("fourth order", 4.0, 20.0)]
            .into_iter()
            .enumerate()
    {
        let error: Vec<f64> =
            h.iter().enumerate().map(|(k, h)| factor * h.powf(order) * wobble(k + i)).collect();
        let points: Vec<(f64, f64)> = h.iter().copied().zip(error).collect();
        let color = Color::qualitative(i);
        panel = panel
            .layer(Line::new(points.clone()).color(color).dash(Dash::nth(i)).label(name))
            .layer(ErrorBars::new(points.iter().map(|p| (p.0, 0.7 * p.1, 1.4 * p.1))).color(color))
            .layer(
                Markers::new(points, Marker::nth(i))
                    .color(color)
                    .fill(Color::WHITE)
                    .size(4.6)
                    .label(name),
            );
    }
    let guide = |order: i32| [(4e-3, 3.0 * 4e-3f64.powi(order)), (2e-2, 3.0 * 2e-2f64.powi(order))];
    let panel = panel
        .layer(Line::new(guide(2)).color(Color::GREY).width(0.7))
        .layer(Note::new(7e-3, 4e-4, "slope 2").color(Color::GREY).anchor(Anchor::End))
        .layer(Rule::horizontal(1e-9).label("round-off"))
        .legend(Corner::BottomRight);
    Figure::single(panel).size(4.5, 3.6)
}

/// Four profiles of a Riemann problem, as lines with particles on them.
fn profiles() -> Figure {
    let x = nodes(400, -0.5, 0.5);
    let step = |x: f64, values: [f64; 5]| -> f64 {
        match x {
            x if x < -0.24 => values[0],
            x if x < -0.02 => values[0] + (values[1] - values[0]) * (x + 0.24) / 0.22,
            x if x < 0.18 => values[1],
            x if x < 0.35 => values[2],
            _ => values[3],
        }
    };
    let quantities = [
        ("(a) density", "ρ [kg m⁻³]", [1.0, 0.426, 0.266, 0.125, 0.0]),
        ("(b) velocity", "v [m s⁻¹]", [0.0, 0.927, 0.927, 0.0, 0.0]),
        ("(c) pressure", "p [Pa]", [1.0, 0.303, 0.303, 0.1, 0.0]),
        ("(d) specific energy", "u [J kg⁻¹]", [2.5, 1.78, 2.85, 2.0, 0.0]),
    ];
    let mut figure = Figure::grid(2, 2).size(7.0, 5.0).legend_below();
    for (title, label, values) in quantities {
        let exact: Vec<f64> = x.iter().map(|&x| step(x, values)).collect();
        let particles = (0..80).map(|i| {
            let x = -0.49 + 0.0124 * f64::from(i);
            // Smoothed and ringing at the jumps.
            let smooth: f64 =
                (-5..=5).map(|k| step(x + 0.003 * f64::from(k), values)).sum::<f64>() / 11.0;
            (
                x,
                smooth
                    + 0.02
                        * (values[0] - values[3]).abs()
                        * (90.0 * x).sin()
                        * (-200.0 * (x - 0.17).powi(2)).exp(),
            )
        });
        let panel = Panel::new(Axis::linear("x [m]").range(-0.5, 0.5), Axis::linear(label))
            .title(title)
            .layer(Line::xy(&x, &exact).width(0.9).label("exact"))
            .layer(
                Markers::new(particles, Marker::Circle)
                    .color(Color::BLUE)
                    .open()
                    .size(2.8)
                    .width(0.6)
                    .label("particles"),
            );
        figure = figure.panel(panel);
    }
    figure
}
