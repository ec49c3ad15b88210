//! Speed against error: every scheme, kernel, ratio and Courant number on two sets of data.

mod recommendation;

use super::{discretisation, kernels};
use crate::ferrari2008::{COMMAND, Detail, ReportError};
use crate::figure::{Axis, Color, Figure, Line, Marker, Markers, Panel};
use crate::page::{Item, Section};
use courant_analysis::exact::rational::{integer, ratio};
use courant_simulation::advection::{
    AdvectionScheme, CostMeasure, CostRow, Layout, Method, RunPlan, Scene, measure_cost,
    pareto_front,
};
use std::fmt::Write;

/// Samples of each time.
const SAMPLES: usize = 3;

/// A choice: scheme, kernel, ratio, and the Courant number, as a share of the limit where there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choice {
    method: Method,
    share: Option<f64>,
}

/// Which smoothing ratios are to choose from. At 1 the splines reach the nearest neighbours only: the
/// classical schemes of the lattice, which particles that move apart cannot use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Neighbours {
    /// All.
    Any,
    /// From 2 on, as particles need.
    Several,
}

impl Neighbours {
    const ALL: [Self; 2] = [Self::Any, Self::Several];

    fn smallest_ratio(self) -> f64 {
        match self {
            Self::Any => 0.0,
            Self::Several => 2.0,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Any => "any",
            Self::Several => "2 or 3",
        }
    }
}

/// One measured run of a choice.
struct Point {
    choice: usize,
    cost: CostRow,
}

/// All runs on one set of data.
struct Test {
    scene: Scene,
    points: Vec<Point>,
}

/// The schemes in the order in which they are drawn.
const SCHEMES: [(AdvectionScheme, Color); 3] = [
    (AdvectionScheme::EulerSph, Color::GREY),
    (AdvectionScheme::GodunovSph, Color::BLUE),
    (AdvectionScheme::LaxWendroffSph, Color::VERMILION),
];

/// Euler-SPH has no limit to take a share of; with small steps it lasts a period.
const EULER_COURANT_NUMBERS: [f64; 2] = [0.1, 0.4];

/// Every combination that moves: the Courant numbers are shares of the largest one at which no wave
/// grows by more than a millionth per step.
fn choices(detail: Detail) -> Vec<Choice> {
    let budget = ratio(1, 1_000_000);
    let mut choices = Vec::new();
    for (scheme, _) in SCHEMES {
        for &kernel in kernels(detail) {
            for ratio in [1, 2, 3] {
                let discretisation = discretisation(scheme, kernel, integer(ratio));
                let limit = {
                    let plan = discretisation.plan().growing(budget.clone());
                    discretisation.stable_set_by(&plan).limit().value()
                };
                let courant_numbers = match scheme {
                    AdvectionScheme::EulerSph => EULER_COURANT_NUMBERS.map(|c| (c, None)),
                    _ => [0.5, 0.95].map(|share| (share * limit, Some(share))),
                };
                for (courant_number, share) in courant_numbers {
                    if courant_number > 0.0 {
                        let method = Method::of(&discretisation, courant_number);
                        choices.push(Choice { method, share });
                    }
                }
            }
        }
    }
    choices
}

fn sizes(detail: Detail) -> (&'static [usize], &'static [usize]) {
    match detail {
        Detail::Full => (&[50, 100, 200, 400, 800], &[1600, 3200, 6400]),
        Detail::Quick => (&[50, 100, 200, 400], &[800]),
    }
}

fn plan(scene: &Scene, method: Method, particles: usize) -> RunPlan {
    RunPlan { scene: scene.clone(), method, particles, periods: 1.0, layout: Layout::Lattice }
}

/// Runs every choice on the small sizes, and on the large ones those that were worth it: the choices
/// with a point on either front. Times are taken one after the other.
fn measure(scene: Scene, choices: &[Choice], detail: Detail) -> Test {
    let (small, large) = sizes(detail);
    let mut points = Vec::new();
    let mut add = |choice: usize, particles: usize| {
        let plan = plan(&scene, choices[choice].method, particles);
        let cost = measure_cost(&plan, SAMPLES).expect("the numbers of the plan are in range");
        points.push(Point { choice, cost });
    };
    for &particles in small {
        (0..choices.len()).for_each(|choice| add(choice, particles));
    }
    let mut test = Test { scene, points };
    // By interactions alone, so that which runs are done does not depend on the machine.
    let mut worthy: Vec<usize> = Neighbours::ALL
        .into_iter()
        .flat_map(|neighbours| test.front_among(CostMeasure::Interactions, neighbours, choices))
        .map(|index| test.points[index].choice)
        .collect();
    worthy.sort_unstable();
    worthy.dedup();
    for &particles in large {
        for &choice in &worthy {
            let plan = plan(&test.scene, choices[choice].method, particles);
            let cost = measure_cost(&plan, SAMPLES).expect("the numbers of the plan are in range");
            test.points.push(Point { choice, cost });
        }
    }
    test
}

impl Test {
    /// `(cost, error)` of every run; the error is the L1 norm.
    fn costs(&self, measure: CostMeasure) -> Vec<(f64, f64)> {
        self.points
            .iter()
            .map(|point| (measure.of(&point.cost), point.cost.comparison.l1))
            .collect()
    }

    fn front(&self, measure: CostMeasure) -> Vec<usize> {
        pareto_front(&self.costs(measure))
    }

    /// `(cost, error)` of every run, not a number where the choice has too few neighbours.
    fn costs_among(
        &self,
        measure: CostMeasure,
        neighbours: Neighbours,
        choices: &[Choice],
    ) -> Vec<(f64, f64)> {
        let mut costs = self.costs(measure);
        for (cost, point) in costs.iter_mut().zip(&self.points) {
            if choices[point.choice].method.ratio < neighbours.smallest_ratio() {
                *cost = (f64::NAN, f64::NAN);
            }
        }
        costs
    }

    fn front_among(
        &self,
        measure: CostMeasure,
        neighbours: Neighbours,
        choices: &[Choice],
    ) -> Vec<usize> {
        pareto_front(&self.costs_among(measure, neighbours, choices))
    }

    fn name(&self) -> &'static str {
        if self.scene == Scene::Step { "step" } else { "smooth hump" }
    }
}

pub(super) fn section(detail: Detail) -> Result<Section, ReportError> {
    let choices = choices(detail);
    let tests = [Scene::Gaussian, Scene::Step].map(|scene| measure(scene, &choices, detail));
    let (small, large) = sizes(detail);
    let setting = format!(
        "{} choices of scheme, kernel, l/Δξ in {{1, 2, 3}} and C (half and 0.95 of the largest C at which no wave \
         grows by more than 1e-6 per step; 0.1 and 0.4 for Euler-SPH, which has no such C); N = {} to {}, and up to {} for choices on the front. One period, \
         stencil path. Time is the median of {SAMPLES} samples after a warm-up, one thread; the \
         spread of the samples is in the data file; interactions count terms with another particle's value",
        choices.len(),
        small[0],
        small[small.len() - 1],
        large[large.len() - 1],
    );
    let mut items = vec![Item::Paragraph(introduction(&tests))];
    for (test, name) in tests.iter().zip(["figure_speed_smooth", "figure_speed_jump"]) {
        items.push(Item::Figure {
            name: name.into(),
            figure: Box::new(figure(test, &choices)),
            caption: format!(
                "L1 error against cost, {} ({}): wall-clock time on this machine (left) and interactions \
                 (right). The Pareto front joins the runs that no other beats in both. {setting}. Errors that \
                 do not fall with N belong to kernels and ratios whose lattice sums are not consistent: waves \
                 travel at a wrong speed, or the mean drifts. {} of {} runs, with errors above 1, lie outside.",
                test.name(),
                test.scene.source(),
                // An error that is no number is outside too.
                test.points.len()
                    - test.points.iter().filter(|point| point.cost.comparison.l1 <= 1.0).count(),
                test.points.len(),
            ),
            data: vec![(format!("{name}.csv"), data(test, &choices))],
            command: COMMAND.into(),
        });
    }
    items.push(Item::Table {
        name: "speed_recommendation".into(),
        table: recommendation::table(&tests, &choices),
        command: COMMAND.into(),
    });
    Ok(Section { title: "Speed against error".into(), items })
}

fn introduction(tests: &[Test]) -> String {
    let share = |test: &Test| {
        let front = test.front(CostMeasure::Interactions);
        let lax_wendroff = front
            .iter()
            .filter(|&&index| {
                test.points[index].cost.plan.method.scheme == AdvectionScheme::LaxWendroffSph
            })
            .count();
        format!(
            "{}: {lax_wendroff} of the {} runs on the front are Lax–Wendroff SPH",
            test.name(),
            front.len()
        )
    };
    let shares: Vec<String> = tests.iter().map(share).collect();
    format!(
        "Which choice reaches an error with the least work? A smaller smoothing ratio means fewer neighbours, \
         a larger one a larger step; a higher order pays on smooth data and less on jumps. By interactions, {}. \
         At l/Δξ = 1 the cubic spline reaches the nearest neighbours only: Godunov SPH is then the upwind scheme \
         and Lax–Wendroff SPH the classical one, and with C near 1 both come close to the exact shift. That \
         serves a lattice; particles that move apart need more neighbours, so the table also recommends among \
         the ratios 2 and 3.",
        shares.join("; ")
    )
}

fn figure(test: &Test, choices: &[Choice]) -> Figure {
    let measures = [
        (CostMeasure::Seconds, "time [s]", "(a) by time"),
        (CostMeasure::Interactions, "interactions", "(b) by interactions"),
    ];
    let mut figure = Figure::grid(1, 2).size(7.4, 4.2).legend_below();
    // Runs with larger errors than the data themselves have no place in the picture.
    let errors = test.points.iter().map(|point| point.cost.comparison.l1);
    let lowest = 0.5 * errors.fold(1.0, f64::min);
    for (measure, axis, title) in measures {
        let costs = test.costs(measure);
        let mut panel = Panel::new(Axis::log(axis), Axis::log("L1 error").range(lowest, 1.0))
            .title(format!("{title}, {}", test.name()));
        for (scheme, color) in SCHEMES {
            for (part, ratio) in [1.0, 2.0, 3.0].into_iter().enumerate() {
                let chosen = test.points.iter().zip(&costs).filter(|(point, _)| {
                    let method = choices[point.choice].method;
                    method.scheme == scheme && method.ratio == ratio
                });
                panel = panel.layer(
                    Markers::new(
                        chosen.map(|(_, &cost)| cost),
                        [Marker::Circle, Marker::Square, Marker::Triangle][part],
                    )
                    .color(color.mix(Color::WHITE, 0.25))
                    .open()
                    .size(2.8)
                    .width(0.6)
                    .label(format!("{}, l/Δξ = {ratio}", scheme.title())),
                );
            }
        }
        let front = test.front(measure);
        panel = panel.layer(
            Line::new(front.iter().map(|&index| costs[index])).width(1.2).label("Pareto front"),
        );
        panel = panel.layer(
            Markers::new(front.iter().map(|&index| costs[index]), Marker::Circle)
                .size(2.6)
                .label("Pareto front"),
        );
        figure = figure.panel(panel);
    }
    figure
}

fn data(test: &Test, choices: &[Choice]) -> Vec<u8> {
    let mut text = String::from(
        "scheme,kernel,ratio,share_of_limit,cfl,particles,steps,l1,l2,l_infinity,interactions,\
         seconds,seconds_lowest,seconds_highest,front_by_seconds,front_by_interactions\n",
    );
    let fronts =
        [CostMeasure::Seconds, CostMeasure::Interactions].map(|measure| test.front(measure));
    for (index, point) in test.points.iter().enumerate() {
        let (choice, cost) = (&choices[point.choice], &point.cost);
        let seen = &cost.comparison;
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
            choice.method.scheme,
            choice.method.kernel.name(),
            choice.method.ratio,
            choice.share.map_or_else(String::new, |share| share.to_string()),
            cost.courant_number,
            cost.plan.particles,
            cost.steps,
            seen.l1,
            seen.l2,
            seen.l_infinity,
            cost.interactions,
            cost.seconds.median,
            cost.seconds.lowest,
            cost.seconds.highest,
            fronts[0].contains(&index),
            fronts[1].contains(&index)
        )
        .expect("writing to a string succeeds");
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::kernel::Kernel;

    #[test]
    fn large_sizes_are_run_for_choices_on_a_front_only() {
        let choices: Vec<Choice> =
            choices(Detail::Quick).into_iter().filter(|choice| choice.method.ratio < 2.5).collect();
        let test = measure(Scene::Gaussian, &choices, Detail::Quick);
        let (small, large) = sizes(Detail::Quick);
        let at = |particles: usize| {
            test.points.iter().filter(move |p| p.cost.plan.particles == particles).count()
        };
        assert!(small.iter().all(|&particles| at(particles) == choices.len()));
        assert!(at(large[0]) > 0 && at(large[0]) < choices.len());
        // The end of the front is the smallest error of all, whatever it costs.
        let costs = test.costs(CostMeasure::Interactions);
        let front = test.front(CostMeasure::Interactions);
        let smallest = costs.iter().map(|cost| cost.1).fold(f64::INFINITY, f64::min);
        assert_eq!(costs[*front.last().unwrap()].1, smallest);
        // With several neighbours nothing of ratio 1 is left.
        let several = test.front_among(CostMeasure::Interactions, Neighbours::Several, &choices);
        assert!(!several.is_empty());
        assert!(several.iter().all(|&i| choices[test.points[i].choice].method.ratio == 2.0));
    }

    #[test]
    fn a_courant_number_is_a_share_of_the_limit() {
        let found = choices(Detail::Quick);
        let godunov = found.iter().find(|choice| {
            let Method { scheme, kernel, ratio, .. } = choice.method;
            (scheme, kernel, ratio) == (AdvectionScheme::GodunovSph, Kernel::CubicSpline, 2.0)
        });
        // Half of 15/8, and a little more for the growth allowed.
        let courant_number = godunov.unwrap().method.courant_number;
        assert!((0.9375..0.9385).contains(&courant_number), "{courant_number}");
    }
}
