//! Work against error of schemes, kernels, ratios and Courant numbers on sets of data.

mod pareto;
mod recommendation;

use self::pareto::pareto_front;
use super::plan::{ByDetail, Named, discretisation, letter};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::page::{Item, Section};
use crate::paper_text::{PaperText, csv};
use crate::report::Detail;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, integer, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_simulation::advection::{
    AdvectionRun, AdvectionScene, AdvectionScheme, Discretisation, Layout, RunPlan, run,
};
use rayon::prelude::*;
use serde::Deserialize;
use std::time::Instant;

/// What there is to choose from, and on which data.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// In the order in which they are drawn.
    schemes: Vec<SchemePlan>,
    kernels: ByDetail<Vec<Named<Kernel>>>,
    /// Whole smoothing ratios.
    ratios: Vec<i64>,
    /// The growth per step that a limit allows.
    growth: Named<Rational>,
    tests: Vec<TestPlan>,
    /// The scheme whose part of the best runs is told.
    told: Named<AdvectionScheme>,
    /// Particles of every choice, and of those that were worth it.
    sizes: ByDetail<[Vec<usize>; 2]>,
    /// Sets of ratios to choose among: the name and the smallest. At 1 the splines reach the nearest neighbours only:
    /// the classical schemes of the lattice, which particles that move apart cannot use.
    among: Vec<Neighbours>,
    /// Errors to recommend for.
    targets: Vec<f64>,
}

/// A scheme and its Courant numbers: shares of its limit, or the numbers themselves where it has none.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct SchemePlan {
    scheme: Named<AdvectionScheme>,
    #[serde(default)]
    shares: Vec<f64>,
    #[serde(default)]
    courant: Vec<f64>,
}

/// A set of data.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct TestPlan {
    scene: Named<AdvectionScene>,
    name: String,
    /// The figure of it.
    figure: String,
}

/// Which smoothing ratios are to choose from.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Neighbours {
    name: String,
    from: f64,
    /// What its panel shows.
    panel: String,
}

/// A choice: scheme, kernel, ratio, and the Courant number, as a share of the limit where there is one.
#[derive(Debug, Clone, PartialEq)]
struct Choice {
    of: Discretisation,
    courant_number: f64,
    share: Option<f64>,
}

/// One run of a choice.
struct Point {
    choice: usize,
    particles: usize,
    run: AdvectionRun,
    /// What it took on this machine.
    seconds: f64,
}

/// All runs on one set of data.
struct Test<'a> {
    plan: &'a Plan,
    data: &'a TestPlan,
    choices: &'a [Choice],
    points: Vec<Point>,
}

/// The colours of the schemes.
const COLORS: [Color; 3] = [Color::GREY, Color::BLUE, Color::VERMILION];

/// Every combination that moves: the Courant numbers are shares of the largest one at which no wave
/// grows by more than the plan allows.
fn choices(plan: &Plan, detail: Detail) -> Vec<Choice> {
    let mut choices = Vec::new();
    for SchemePlan { scheme, shares, courant } in &plan.schemes {
        for kernel in plan.kernels.at(detail) {
            for ratio in &plan.ratios {
                let discretisation = discretisation(scheme.0, kernel.0, &integer(*ratio));
                let limit = {
                    let plan = discretisation.plan().growing(plan.growth.0.clone());
                    discretisation.stable_set_by(&plan).limit().value()
                };
                let of_limit = shares.iter().map(|share| (share * limit, Some(*share)));
                for (courant_number, share) in of_limit.chain(courant.iter().map(|c| (*c, None))) {
                    if courant_number > 0.0 {
                        choices.push(Choice { of: discretisation.clone(), courant_number, share });
                    }
                }
            }
        }
    }
    choices
}

fn point(scene: &AdvectionScene, choices: &[Choice], (choice, particles): (usize, usize)) -> Point {
    let plan = RunPlan {
        scene: scene.clone(),
        discretisation: choices[choice].of.clone(),
        courant_number: choices[choice].courant_number,
        particles,
        layout: Layout::Lattice,
    };
    let start = Instant::now();
    let run = run(&plan).expect("the numbers of the plan are in range");
    Point { choice, particles, run, seconds: start.elapsed().as_secs_f64() }
}

/// Runs every choice on the small sizes, and on the large ones those that were worth it: the choices
/// with a point on a front.
fn measure<'a>(
    plan: &'a Plan,
    data: &'a TestPlan,
    choices: &'a [Choice],
    detail: Detail,
) -> Test<'a> {
    let [small, large] = plan.sizes.at(detail);
    let every = |sizes: &[usize], of: &[usize]| -> Vec<Point> {
        let plans: Vec<(usize, usize)> =
            sizes.iter().flat_map(|&size| of.iter().map(move |&choice| (choice, size))).collect();
        plans.into_par_iter().map(|plan| point(&data.scene.0, choices, plan)).collect()
    };
    let points = every(small, &(0..choices.len()).collect::<Vec<_>>());
    let mut test = Test { plan, data, choices, points };
    let fronts = plan.among.iter().flat_map(|among| test.front(among));
    let mut worthy: Vec<usize> = fronts.map(|index| test.points[index].choice).collect();
    worthy.sort_unstable();
    worthy.dedup();
    test.points.extend(every(large, &worthy));
    test
}

impl Test<'_> {
    /// `(interactions, error)` of every run, the error in the L1 norm; not a number where the choice has too few
    /// neighbours.
    fn costs(&self, among: &Neighbours) -> Vec<(f64, f64)> {
        let cost = |point: &Point| {
            if to_f64(self.choices[point.choice].of.ratio()) < among.from {
                return (f64::NAN, f64::NAN);
            }
            (point.run.run.counters.interactions as f64, point.run.comparison.l1)
        };
        self.points.iter().map(cost).collect()
    }

    /// The runs that no other beats in both, by interactions: which they are does not depend on the machine.
    fn front(&self, among: &Neighbours) -> Vec<usize> {
        pareto_front(&self.costs(among))
    }

    /// The scheme of a run.
    fn scheme(&self, point: &Point) -> AdvectionScheme {
        self.choices[point.choice].of.scheme()
    }

    /// Runs with larger errors than the data themselves, or with an error that is no number.
    fn outside(&self) -> usize {
        let inside = |point: &&Point| point.run.comparison.l1 <= 1.0;
        self.points.len() - self.points.iter().filter(inside).count()
    }
}

/// The section.
pub fn section(text: &PaperText, detail: Detail) -> Section {
    let plan: Plan = text.plan("speed");
    let choices = choices(&plan, detail);
    let tests: Vec<Test<'_>> =
        plan.tests.iter().map(|data| measure(&plan, data, &choices, detail)).collect();
    let [small, large] = plan.sizes.at(detail);
    let mut items = vec![introduction(text, &tests)];
    for test in &tests {
        let caption = text.text(
            "speed_caption",
            words![
                "test" = test.data.name,
                "equation" = test.data.scene.0.source.as_str(),
                "choices" = choices.len(),
                "least" = small[0],
                "small" = small[small.len() - 1],
                "large" = large[large.len() - 1],
                "outside" = test.outside(),
                "runs" = test.points.len(),
            ],
        );
        let name = &test.data.figure;
        let data = vec![(format!("{name}.csv"), data(test))];
        items.push(text.figure(name, words!["caption" = caption], figure(test), data));
    }
    items.push(recommendation::table(text, &tests));
    text.section("title_speed", items)
}

fn introduction(text: &PaperText, tests: &[Test<'_>]) -> Item {
    let fronts = tests.iter().map(|test| {
        let front = test.front(&test.plan.among[0]);
        let told = test.plan.told.0;
        let of_told = front.iter().filter(|&&index| test.scheme(&test.points[index]) == told);
        let (name, count) = (&test.data.name, of_told.count());
        format!("{name}: {count} of the {} runs on the front are {}", front.len(), told.title())
    });
    text.paragraph("speed_text", words!["fronts" = fronts.collect::<Vec<_>>().join("; ")])
}

/// What became of runs without an error that says something.
const OUTSIDE: &str = "error above 1, drawn at the top";

fn figure(test: &Test<'_>) -> Figure {
    let among = &test.plan.among;
    let mut figure = Figure::grid(1, among.len()).size(7.4, 4.2);
    // Runs with larger errors than the data themselves have no place in the picture.
    let errors = test.points.iter().map(|point| point.run.comparison.l1);
    let lowest = 0.5 * errors.fold(1.0, f64::min);
    for (index, among) in among.iter().enumerate() {
        let costs = test.costs(among);
        let mut panel =
            Panel::new(Axis::log("interactions"), Axis::log("L1 error").range(lowest, 2.0))
                .title(format!("{}{}, {}", letter(index), among.panel, test.data.name));
        // All runs faintly; over them what is best of each scheme, and where it beats the other schemes too.
        let best = test.front(among);
        for (SchemePlan { scheme, .. }, color) in test.plan.schemes.iter().zip(COLORS) {
            let scheme = scheme.0;
            let runs: Vec<(f64, f64)> = test
                .points
                .iter()
                .zip(&costs)
                .map(|(point, &cost)| match test.scheme(point) == scheme {
                    true => cost,
                    false => (f64::NAN, f64::NAN),
                })
                .collect();
            let inside = runs.iter().copied().filter(|run| run.1 <= 1.0);
            let outside = runs.iter().filter(|run| run.1 > 1.0).map(|run| (run.0, 1.4));
            let faint = color.mix(Color::WHITE, 0.6);
            let own: Vec<(f64, f64)> = pareto_front(&runs).into_iter().map(|k| runs[k]).collect();
            let wins = best.iter().map(|&k| runs[k]).filter(|run| run.0.is_finite());
            let wins: Vec<(f64, f64)> = wins.collect();
            let name = match wins.is_empty() {
                true => String::new(),
                false => format!("{}, cheapest of all", scheme.title()),
            };
            panel = panel
                .layer(Series::markers(inside, Marker::Circle).color(faint).size(1.5).width(0.2))
                .layer(
                    Series::markers(outside, Marker::Cross).color(faint).size(3.0).label(OUTSIDE),
                )
                .layer(Series::line(own).color(color).width(1.3).label(scheme.title()))
                .layer(Series::markers(wins, Marker::Circle).color(color).size(4.6).label(name));
        }
        figure = figure.panel(panel);
    }
    figure
}

fn data(test: &Test<'_>) -> Vec<u8> {
    let front = test.front(&test.plan.among[0]);
    let rows = test.points.iter().enumerate().map(|(index, point)| {
        let (Choice { of, share, .. }, run) = (&test.choices[point.choice], &point.run);
        let share = share.map_or_else(String::new, |share| share.to_string());
        let mut cells =
            cells![of.scheme(), of.kernel().name(), to_text(of.ratio()), share, run.courant_number];
        let seen = &run.comparison;
        cells.extend(cells![point.particles, run.run.steps, seen.l1, seen.l2, seen.l_infinity]);
        cells.extend(cells![run.run.counters.interactions, front.contains(&index), point.seconds]);
        cells
    });
    let header = "scheme,kernel,ratio,share_of_limit,cfl,particles,steps,l1,l2,l_infinity,\
                  interactions,front,seconds";
    csv(header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = r#"
        schemes = [{ scheme = "godunov-sph", shares = [0.5, 0.95] }, { scheme = "lax-wendroff-sph", shares = [0.5] }]
        kernels = { quick = ["cubic-spline"], standard = [], full = [] }
        ratios = [1, 2]
        growth = "1/1000000"
        tests = [{ scene = "advection-gaussian", name = "hump", figure = "none" }]
        told = "godunov-sph"
        sizes = { quick = [[50, 100], [200]], standard = [[], []], full = [[], []] }
        among = [{ name = "any", from = 0.0, panel = "all" }, { name = "2", from = 2.0, panel = "several" }]
        targets = [0.1]
    "#;

    #[test]
    fn large_sizes_are_run_for_choices_on_a_front_only() {
        let plan: Plan = toml::from_str(PLAN).unwrap();
        let choices = choices(&plan, Detail::Quick);
        let test = measure(&plan, &plan.tests[0], &choices, Detail::Quick);
        let at =
            |particles: usize| test.points.iter().filter(move |p| p.particles == particles).count();
        assert_eq!([50, 100].map(at), [choices.len(); 2]);
        assert!(at(200) > 0 && at(200) < choices.len());
        // The end of the front is the smallest error of all, whatever it costs.
        let [any, several] = [0, 1].map(|k| &plan.among[k]);
        let (costs, front) = (test.costs(any), test.front(any));
        let smallest = costs.iter().map(|cost| cost.1).fold(f64::INFINITY, f64::min);
        assert_eq!(costs[*front.last().unwrap()].1, smallest);
        // With several neighbours nothing of ratio 1 is left.
        let several = test.front(several);
        assert!(!several.is_empty());
        assert!(several.iter().all(|&i| *choices[test.points[i].choice].of.ratio() == integer(2)));
    }

    #[test]
    fn a_courant_number_is_a_share_of_the_limit() {
        let found = choices(&toml::from_str(PLAN).unwrap(), Detail::Quick);
        let godunov = found.iter().find(|choice| *choice.of.ratio() == integer(2));
        // Half of 15/8, and a little more for the growth allowed.
        let courant_number = godunov.unwrap().courant_number;
        assert!((0.9375..0.9385).contains(&courant_number), "{courant_number}");
    }
}
