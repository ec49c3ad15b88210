//! Maps of the amplification factor over the (smoothing ratio, Courant number) plane.

use crate::figure::{
    Axis, Bands, Color, ColorBar, ColorMap, Contours, Dash, Figure, FigureError, Marker, Panel,
    Series,
};
use crate::level_set::{Field, FieldError};
use crate::npy;
use crate::number::{finite, push_shortest};
use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::stability::{Evidence, Limit};
use courant_analysis::waves::sweep::{GainMap, Progress, SweepError, with_progress};
use courant_simulation::advection::{AdvectionScheme, Discretisation};
use ndarray::Array2;
use rayon::prelude::*;

/// Relative width of the limits that are drawn and written, as a power of one half: some units in the last place of an `f64`, and roots
/// need no names.
const LIMIT_BITS: u32 = 48;

/// The growth budget whose limit is drawn beside the strict one: doubling takes 693 steps.
pub const DRAWN_GROWTH: (i64, i64) = (1, 1000);

/// Where something grows, but by less than the drawn budget.
const SLOW_GROWTH: Color = Color(255, 236, 150);

/// What is mapped.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPlan {
    /// The scheme.
    pub scheme: AdvectionScheme,
    /// The kernel.
    pub kernel: Kernel,
    /// The smoothing ratios, ascending.
    pub ratios: Vec<Rational>,
    /// The Courant numbers, ascending.
    pub courant_numbers: Vec<Rational>,
}

/// A limit curve point: the ratio and the Courant number.
pub type CurvePoint = (f64, f64);

/// A computed map with its limit curves.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityMap {
    /// What was mapped.
    pub plan: MapPlan,
    /// The extreme gains.
    pub gains: GainMap,
    /// How all limits are known: the weakest evidence among them.
    pub evidence: Evidence,
    /// The stability limit over the ratio.
    pub stability: Vec<CurvePoint>,
    /// The limit for a growth of 1e-3 per step.
    pub growth: Vec<CurvePoint>,
    /// The monotonicity limit over the ratio; empty when there is no positive one.
    pub monotonicity: Vec<CurvePoint>,
}

/// Computes a map: the gains on the grid and the limits at every ratio, which are proved and not read
/// off the grid.
///
/// # Errors
/// When a ratio is out of range or the callback stops the sweep.
pub fn stability_map(plan: MapPlan, progress: Progress<'_>) -> Result<StabilityMap, SweepError> {
    let courant_numbers: Vec<f64> = plan.courant_numbers.iter().map(to_f64).collect();
    let growths = [integer(0), ratio(DRAWN_GROWTH.0, DRAWN_GROWTH.1)];
    let mut gains = GainMap::new(plan.ratios.len(), courant_numbers.len());
    let items = plan.ratios.par_iter().zip(gains.rows_mut());
    let limits = with_progress(items, progress, |(l, mut row)| {
        let of = Discretisation::new(plan.scheme, plan.kernel, l.clone())?;
        let search = of.plan().to_bits(LIMIT_BITS);
        let mut limits = of.limits_by(&search, &growths);
        limits.push(of.monotone_set().limit());
        let curves: Vec<CurvePoint> =
            limits.iter().map(|limit| (to_f64(l), limit.value())).collect();
        let evidence = limits.iter().map(Limit::evidence).fold(Evidence::Proved, Evidence::weaker);
        row.set(&of.gain_extremes(&courant_numbers));
        Ok((evidence, curves))
    })?;
    let curve = |which: usize| -> Vec<CurvePoint> {
        limits.iter().map(|(_, curves)| curves[which]).collect()
    };
    let monotonicity = curve(2);
    let has_monotonicity = monotonicity.iter().any(|point| point.1 > 0.0);
    Ok(StabilityMap {
        plan,
        gains,
        evidence: limits
            .iter()
            .map(|(evidence, _)| *evidence)
            .fold(Evidence::Proved, Evidence::weaker),
        stability: curve(0),
        growth: curve(1),
        monotonicity: if has_monotonicity { monotonicity } else { Vec::new() },
    })
}

impl StabilityMap {
    /// The panel: each side of the limit in colours of its own, limit curves, and published points if there are any.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn panel(&self, title: &str, published: &[PublishedPoint]) -> Result<Panel, FigureError> {
        let ratios: Vec<f64> = self.plan.ratios.iter().map(to_f64).collect();
        let courant_numbers: Vec<f64> = self.plan.courant_numbers.iter().map(to_f64).collect();
        let axes = (ratios.as_slice(), courant_numbers.as_slice());
        // A single ratio that is stable between others that are not would be drawn as a spike.
        let strict: Vec<f64> = stretches(&self.stability)
            .flat_map(|part| part.iter().map(|point| if part.len() > 1 { point.1 } else { 0.0 }))
            .collect();
        let beyond = |limits: &[f64]| {
            // A limit beyond the axis is as good as one a little above it.
            let top = 2.0 * courant_numbers[courant_numbers.len() - 1];
            let shape = (limits.len(), courant_numbers.len());
            Array2::from_shape_fn(shape, |(i, j)| courant_numbers[j] - limits[i].min(top))
        };
        let budget: Vec<f64> = match self.differs_from_budget() {
            true => self.growth.iter().map(|point| point.1).collect(),
            false => strict.clone(),
        };
        let unstable = beyond(&strict);
        let mut panel = Panel::new(
            Axis::linear("smoothing ratio l/Δξ").spanning(&ratios),
            Axis::linear("Courant number C").spanning(&courant_numbers),
        )
        .title(title)
        .contours(damped_side(
            axes,
            &self.gains.lowest_gain,
            unstable.mapv(|beyond| -beyond),
        )?);
        // On C = 0 itself nothing happens.
        if self.differs_from_budget() {
            let slow = Field::new(ratios.clone(), courant_numbers.clone(), unstable)?;
            let slow = Contours::region(slow, 1e-12, SLOW_GROWTH);
            panel = panel.contours(slow.label("grows, by at most 10⁻³ per step"));
        }
        let largest = self.gains.growth.mapv(|growth| 1.0 + growth);
        panel = panel.contours(growing_side(axes, &largest, beyond(&budget))?);
        let highest = courant_numbers[courant_numbers.len() - 1];
        let lowest = courant_numbers[0];
        let reaches_in = |curve: &[CurvePoint]| {
            curve.windows(2).any(|ends| {
                let [one, other] = [ends[0].1, ends[1].1];
                one.max(other).is_finite() && one.max(other) > lowest && one.min(other) < highest
            })
        };
        if self.differs_from_budget() && reaches_in(&self.growth) {
            panel = panel.layer(
                Series::line(self.growth.iter().copied())
                    .color(Color::BLACK)
                    .width(1.1)
                    .dash(Dash::nth(1))
                    .label("limit for a growth of 10⁻³ per step"),
            );
        }
        let drawn = reaches_in(&self.stability).then_some(self.stability.as_slice());
        let stretches = drawn.into_iter().flat_map(stretches);
        for points in stretches.filter(|points| points.len() > 1 && points[0].1 > 0.0) {
            let limit = Series::line(points.iter().copied()).width(1.8);
            panel = panel.layer(limit.label("stability limit"));
        }
        if reaches_in(&self.monotonicity) {
            panel = panel.layer(
                Series::line(self.monotonicity.iter().copied())
                    .color(Color::YELLOW)
                    .width(1.6)
                    .dash(Dash::nth(2))
                    .label("monotonicity limit"),
            );
        }
        for (limit, marker, label) in [
            (PublishedLimit::Stability, Marker::Circle, "stability, as printed"),
            (PublishedLimit::Monotonicity, Marker::Square, "monotonicity, as printed"),
        ] {
            let points: Vec<CurvePoint> =
                published.iter().filter(|p| p.limit == limit).map(|p| p.point).collect();
            if !points.is_empty() {
                panel = panel.layer(
                    Series::markers(points, marker).fill(Color::WHITE).size(4.5).label(label),
                );
            }
        }
        Ok(panel)
    }

    /// The stretches of ratios without any strictly stable Courant number: first and last ratio of each on the grid.
    pub fn never_strictly_stable(&self) -> Vec<[f64; 2]> {
        stretches(&self.stability)
            .filter(|stretch| stretch[0].1 <= 0.0)
            .map(|stretch| [stretch[0].0, stretch[stretch.len() - 1].0])
            .collect()
    }

    /// The least and the largest growth per step at the largest Courant number of the grid up to `l/Δξ`, over the
    /// ratios without a strictly stable one; `None` when there are none.
    pub fn growth_without_limit(&self) -> Option<[f64; 2]> {
        let courant_numbers: Vec<f64> = self.plan.courant_numbers.iter().map(to_f64).collect();
        let growths = self.stability.iter().enumerate().filter(|(_, point)| point.1 <= 0.0).map(
            |(i, &(l, _))| {
                let up_to = courant_numbers.partition_point(|c| *c <= l);
                self.gains.growth[[i, up_to.saturating_sub(1)]]
            },
        );
        let ends = growths.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], growth| {
            [low.min(growth), high.max(growth)]
        });
        (ends[0] <= ends[1]).then_some(ends)
    }

    /// Whether the budget's limit is anywhere visibly above the strict one.
    fn differs_from_budget(&self) -> bool {
        self.stability.iter().zip(&self.growth).any(|(strict, budget)| budget.1 > strict.1 * 1.02)
    }

    /// The figure with one panel.
    ///
    /// # Errors
    /// When the axes have too few points to draw.
    pub fn figure(&self) -> Result<Figure, FigureError> {
        let title = format!(
            "{}, {}; limits {}",
            self.plan.scheme.title(),
            self.plan.kernel.title(),
            self.evidence.name()
        );
        let figure = Figure::single(self.panel(&title, &[])?).size(5.2, 4.3);
        Ok(figure.color_bar(damping_bar()).color_bar(growth_bar()))
    }

    /// The grid as comma-separated values, a row for each point.
    pub fn to_csv(&self) -> String {
        let text_of = |value: &Rational| to_f64(value).to_string();
        let courant_numbers: Vec<String> = self.plan.courant_numbers.iter().map(text_of).collect();
        let heading = "ratio,cfl,max_gain,max_gain_phase,min_gain,min_gain_phase\n";
        let part = |(first, ratios): (usize, &[Rational])| {
            let mut text = String::with_capacity(64 * courant_numbers.len() * ratios.len());
            if first == 0 {
                text.push_str(heading);
            }
            for (i, l) in (first..).zip(ratios) {
                let l = text_of(l);
                // A number is often that of the row before.
                let mut last: [(f64, String); 4] =
                    std::array::from_fn(|_| (f64::NAN, String::new()));
                for (j, c) in courant_numbers.iter().enumerate() {
                    let at = [i, j];
                    let gains = &self.gains;
                    text.push_str(&l);
                    text.push(',');
                    text.push_str(c);
                    let values = [
                        1.0 + gains.growth[at],
                        gains.growth_phase[at],
                        gains.lowest_gain[at],
                        gains.lowest_gain_phase[at],
                    ];
                    for (value, (known, decimal)) in values.into_iter().zip(&mut last) {
                        if value.to_bits() != known.to_bits() || decimal.is_empty() {
                            *known = value;
                            decimal.clear();
                            push_shortest(decimal, value);
                        }
                        text.push(',');
                        text.push_str(decimal);
                    }
                    text.push('\n');
                }
            }
            text
        };
        // A part for each thread: the first one takes up the others.
        let ratios = &self.plan.ratios;
        let size = ratios.len().div_ceil(rayon::current_num_threads()).max(1);
        let firsts = (0..ratios.len()).into_par_iter().step_by(size);
        let parts: Vec<String> = firsts.zip(ratios.par_chunks(size)).map(part).collect();
        let mut parts = parts.into_iter();
        let mut text = parts.next().unwrap_or_else(|| heading.into());
        parts.for_each(|part| text.push_str(&part));
        text
    }

    /// The limit curves as comma-separated values.
    pub fn limits_csv(&self) -> String {
        let mut text = String::from("ratio,ratio_exact,stability,growth_1e_3,monotonicity\n");
        for (index, l) in self.plan.ratios.iter().enumerate() {
            let curves = [&self.stability, &self.growth, &self.monotonicity];
            // Where a curve has no limit the cell is empty.
            let limits = curves.map(|curve| {
                let limit = curve.get(index).and_then(|point| finite(point.1));
                limit.map_or_else(String::new, |limit| limit.to_string())
            });
            text.push_str(&format!("{},{},{}\n", to_f64(l), to_text(l), limits.join(",")));
        }
        text
    }

    /// Every data file of the map: names that begin with `stem`, and contents.
    pub fn data_files(&self, stem: &str) -> Vec<(String, Vec<u8>)> {
        let floats = |values: &[Rational]| -> Vec<f64> { values.iter().map(to_f64).collect() };
        let axes = npy::axes(stem, &floats(&self.plan.ratios), &floats(&self.plan.courant_numbers));
        [
            (format!("{stem}.csv"), self.to_csv().into_bytes()),
            (format!("{stem}_limits.csv"), self.limits_csv().into_bytes()),
            (format!("{stem}_max_gain.npy"), npy::encode(&self.gains.growth.mapv(|g| 1.0 + g))),
            (format!("{stem}_min_gain.npy"), npy::encode(&self.gains.lowest_gain)),
        ]
        .into_iter()
        .chain(axes)
        .collect()
    }
}

/// The stretches of a limit curve: it is not joined where the limit jumps to zero or from there.
fn stretches(curve: &[CurvePoint]) -> impl Iterator<Item = &[CurvePoint]> {
    curve.chunk_by(|a, b| (a.1 > 0.0) == (b.1 > 0.0))
}

/// Axes of a map: values to the right and upwards.
type Axes<'a> = (&'a [f64], &'a [f64]);

/// The stable side of a map: bands and isolines of `|g|` of the most damped wave, where `border` is at least 0.
///
/// # Errors
/// When the axes have too few points to draw.
pub fn damped_side(
    (x, y): Axes<'_>,
    lowest: &Array2<f64>,
    border: Array2<f64>,
) -> Result<Contours, FieldError> {
    let field = Field::new(x.to_vec(), y.to_vec(), lowest.clone())?.within(border)?;
    Ok(Contours::new(field).bands(shades_of_damping(5)).isolines([0.2, 0.4, 0.6, 0.8]))
}

/// The unstable side: bands and isolines of `|g|` of the fastest growing wave, where `border` is at least 0.
///
/// # Errors
/// When the axes have too few points to draw.
pub fn growing_side(
    (x, y): Axes<'_>,
    largest: &Array2<f64>,
    border: Array2<f64>,
) -> Result<Contours, FieldError> {
    let field = Field::new(x.to_vec(), y.to_vec(), largest.clone())?.within(border)?;
    Ok(Contours::new(field).bands(shades_of_growth()).isolines([1.4, 2.0]))
}

/// Bands of equal width from 0 to 1, the darker the less is left of a wave.
pub fn shades_of_damping(count: u32) -> Bands {
    let edges = (0..=count).map(|k| f64::from(k) / f64::from(count)).collect();
    // The palest band is tinted, so that it differs from paper and from the palest of growth.
    Bands::new(edges, |t| ColorMap::Blues.at(1.0 - 0.88 * t))
}

/// Bands of a fifth from 1 to 2; what more than doubles in a step is darkest.
fn shades_of_growth() -> Bands {
    let edges = (5..=10).map(|fifths| f64::from(fifths) / 5.0).collect();
    let color = |t: f64| ColorMap::Reds.at(0.12 + 0.8 * t);
    // Below 1 is rounding.
    Bands::new(edges, color).extend_below(color(0.0)).extend_above(Color::DARK_RED)
}

/// The colour bar of the stable side.
pub fn damping_bar() -> ColorBar {
    ColorBar::new(shades_of_damping(5), "|g| of the most damped wave")
}

/// The colour bar of the unstable side.
pub fn growth_bar() -> ColorBar {
    let bands = shades_of_growth().needed_for([1.0, 3.0].into_iter());
    ColorBar::new(bands, "|g| of the fastest growing wave")
}

/// Which limit a published value claims.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PublishedLimit {
    /// `|g| ≤ 1`.
    Stability,
    /// Non-negative coefficients.
    Monotonicity,
}

/// A published value to set a map against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedPoint {
    /// What it claims.
    pub limit: PublishedLimit,
    /// The ratio and the Courant number.
    pub point: CurvePoint,
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::waves::sweep::no_progress;

    #[test]
    fn the_limit_curve_breaks_where_nothing_is_strictly_stable() {
        let curve = [(1.0, 1.1), (1.5, 1.5), (2.0, 0.0), (2.5, 2.4), (3.0, 0.0), (3.5, 0.0)];
        let lengths: Vec<usize> = stretches(&curve).map(<[_]>::len).collect();
        assert_eq!(lengths, [2, 1, 1, 2]);
        let plan = MapPlan {
            scheme: AdvectionScheme::LaxWendroffSph,
            kernel: Kernel::Gaussian,
            ratios: [2, 3].map(integer).to_vec(),
            courant_numbers: (0..4).map(integer).collect(),
        };
        let map = stability_map(plan, &no_progress).unwrap();
        assert_eq!(map.evidence, Evidence::Enclosed);
        assert_eq!(map.never_strictly_stable(), [[3.0, 3.0]]);
        // The growth at ratio 3 and C = 3, by the grid's own entry.
        let growth = map.gains.growth[[1, 3]];
        assert!(growth > 1e-6 && map.growth_without_limit() == Some([growth, growth]));
    }

    #[test]
    fn curves_outside_the_axes_are_not_in_the_legend() {
        let svg = |highest: i64| {
            let plan = MapPlan {
                scheme: AdvectionScheme::GodunovSph,
                kernel: Kernel::CubicSpline,
                ratios: vec![integer(1), integer(2), integer(3)],
                courant_numbers: (0..=8).map(|index| ratio(index * highest, 8)).collect(),
            };
            stability_map(plan, &no_progress).unwrap().figure().unwrap().svg().unwrap().0
        };
        // Both limits begin at C = 1 and rise: up to 1 they touch a corner and no more.
        let (low, high) = (svg(1), svg(4));
        for name in ["stability limit", "monotonicity limit"] {
            assert!(!low.contains(name) && high.contains(name), "{name}");
        }
    }
}
