//! Speed against error: every scheme, kernel, ratio and Courant number on two sets of data.

use super::super::{COMMAND, Detail, ReportError};
use super::discretisation;
use crate::figure::{Axis, Color, Figure, Line, Marker, Markers, Panel};
use crate::number::significant;
use crate::page::{Item, Section};
use crate::table::{Align, Table};
use courant_analysis::kernel::Kernel;
use courant_analysis::limit::growth_limit;
use courant_analysis::rational::{integer, ratio};
use courant_analysis::scheme::{AdvectionScheme, Scheme};
use courant_simulation::advection::{
    CostMeasure, CostRow, Layout, Method, RunPlan, Scene, measure_cost, pareto_front, recommend,
    run,
};
use std::fmt::Write;

/// Samples of each time.
const SAMPLES: usize = 3;

/// A choice: scheme, kernel, ratio, and the Courant number as a share of the limit.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choice {
    method: Method,
    share: f64,
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

const SCHEMES: [AdvectionScheme; 2] =
    [AdvectionScheme::GodunovSph, AdvectionScheme::LaxWendroffSph];

/// Every combination that moves: the Courant numbers are shares of the largest one at which no wave
/// grows by more than a millionth per step.
fn choices(detail: Detail) -> Vec<Choice> {
    let kernels: &[Kernel] = match detail {
        Detail::Full => &Kernel::ALL,
        Detail::Quick => &[Kernel::CubicSpline, Kernel::Gaussian],
    };
    let budget = ratio(1, 1_000_000);
    let mut choices = Vec::new();
    for scheme in SCHEMES {
        for &kernel in kernels {
            for ratio in [1, 2, 3] {
                let discretisation = discretisation(scheme, kernel, integer(ratio));
                let limit = growth_limit(&discretisation.symbol(), &budget, &integer(20)).value();
                if limit == 0.0 {
                    continue;
                }
                for share in [0.5, 0.95] {
                    let method = Method::of(&discretisation, share * limit);
                    choices.push(Choice { method, share });
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
    let mut worthy: Vec<usize> = test
        .front(CostMeasure::Interactions)
        .into_iter()
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
         grows by more than 1e-6 per step); N = {} to {}, and up to {} for choices on the front. One period, \
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
                 (right). The line joins the choices that no other beats in both. {setting}.",
                test.name(),
                test.scene.source(),
            ),
            data: vec![(format!("{name}.csv"), data(test, &choices))],
            command: COMMAND.into(),
        });
    }
    items.push(Item::Table {
        name: "speed_recommendation".into(),
        table: recommendation(&tests, &choices),
        command: COMMAND.into(),
    });
    items.push(Item::Paragraph(euler()));
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
         a larger one a larger step; a higher order pays on smooth data and less on jumps. By interactions, {}.",
        shares.join("; ")
    )
}

/// Euler-SPH is no choice; its error says so.
fn euler() -> String {
    let method = Method {
        scheme: AdvectionScheme::EulerSph,
        kernel: Kernel::CubicSpline,
        ratio: 2.0,
        courant_number: 0.1,
    };
    let result = run(&plan(&Scene::Gaussian, method, 400)).expect("the numbers are in range");
    format!(
        "Euler-SPH is left out: it is unstable at every Courant number. Even at C = 0.1, with 400 particles, its \
         L1 error on the smooth hump after one period is {}.",
        significant(result.comparison.l1, 2)
    )
}

fn figure(test: &Test, choices: &[Choice]) -> Figure {
    let measures = [
        (CostMeasure::Seconds, "time [s]", "(a) by time"),
        (CostMeasure::Interactions, "interactions", "(b) by interactions"),
    ];
    let mut figure = Figure::grid(1, 2).size(7.4, 4.2).legend_below();
    for (measure, axis, title) in measures {
        let costs = test.costs(measure);
        let mut panel = Panel::new(Axis::log(axis), Axis::log("L1 error"))
            .title(format!("{title}, {}", test.name()));
        for (k, scheme) in SCHEMES.into_iter().enumerate() {
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
                    .color([Color::BLUE, Color::VERMILION][k].mix(Color::WHITE, 0.25))
                    .open()
                    .size(2.8)
                    .width(0.6)
                    .label(format!("{}, l/Δξ = {ratio}", scheme.title())),
                );
            }
        }
        let front = test.front(measure);
        panel = panel.layer(
            Line::new(front.iter().map(|&index| costs[index]))
                .width(1.4)
                .label("not beaten by any other"),
        );
        figure = figure.panel(panel);
    }
    figure
}

fn describe(choice: &Choice) -> String {
    let Method { scheme, kernel, ratio, courant_number } = choice.method;
    format!(
        "{}, {}, l/Δξ = {ratio}, C = {}",
        scheme.title(),
        kernel.title(),
        significant(courant_number, 3)
    )
}

fn recommendation(tests: &[Test], choices: &[Choice]) -> Table {
    let mut table = Table::new(
        "The cheapest choice for an error after one period, by interactions and by time",
        &[
            ("test", Align::Left),
            ("L1 error wanted", Align::Right),
            ("cheapest by interactions", Align::Left),
            ("N", Align::Right),
            ("interactions", Align::Right),
            ("error", Align::Right),
            ("cheapest by time on this machine", Align::Left),
            ("N", Align::Right),
            ("ms (median, range)", Align::Right),
        ],
    );
    for test in tests {
        let targets = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4];
        let by_work = recommend(&test.costs(CostMeasure::Interactions), &targets);
        let by_time = recommend(&test.costs(CostMeasure::Seconds), &targets);
        for (work, time) in by_work.into_iter().zip(by_time) {
            let mut cells = vec![test.name().to_string(), significant(work.target, 1)];
            match work.choice.map(|index| &test.points[index]) {
                Some(point) => cells.extend([
                    describe(&choices[point.choice]),
                    point.cost.plan.particles.to_string(),
                    significant(point.cost.interactions as f64, 3),
                    significant(point.cost.comparison.l1, 3),
                ]),
                None => {
                    cells.extend(["none of these runs".into(), "–".into(), "–".into(), "–".into()])
                }
            }
            match time.choice.map(|index| &test.points[index]) {
                Some(point) => cells.extend([
                    describe(&choices[point.choice]),
                    point.cost.plan.particles.to_string(),
                    format!(
                        "{} ({} to {})",
                        significant(1e3 * point.cost.seconds.median, 2),
                        significant(1e3 * point.cost.seconds.lowest, 2),
                        significant(1e3 * point.cost.seconds.highest, 2)
                    ),
                ]),
                None => cells.extend(["none of these runs".into(), "–".into(), "–".into()]),
            }
            table.push(cells);
        }
    }
    table
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
            choice.share,
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
