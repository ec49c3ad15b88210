//! Speed against error: every scheme, kernel, ratio and Courant number on two sets of data.

mod recommendation;

use super::{Detail, discretisation, kernels, text};
use crate::figure::{Axis, Color, Figure, Marker, Panel, Series};
use crate::page::{Item, Section};
use crate::paper_text::csv;
use crate::{cells, words};
use courant_analysis::exact::rational::{integer, ratio};
use courant_simulation::advection::{
    AdvectionRun, AdvectionScheme, Layout, Method, RunPlan, Scene, pareto_front, run,
};
use rayon::prelude::*;
use std::time::Instant;

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

/// One run of a choice.
struct Point {
    choice: usize,
    particles: usize,
    run: AdvectionRun,
    /// What it took on this machine.
    seconds: f64,
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
        Detail::Quick => (&[50, 100, 200], &[400]),
        Detail::Standard => (&[50, 100, 200, 400, 800], &[1600]),
        Detail::Full => (&[50, 100, 200, 400, 800], &[1600, 3200, 6400]),
    }
}

fn point(scene: &Scene, choices: &[Choice], (choice, particles): (usize, usize)) -> Point {
    let (scene, method) = (scene.clone(), choices[choice].method);
    let plan = RunPlan { scene, method, particles, periods: 1.0, layout: Layout::Lattice };
    let start = Instant::now();
    let run = run(&plan).expect("the numbers of the plan are in range");
    Point { choice, particles, run, seconds: start.elapsed().as_secs_f64() }
}

/// Runs every choice on the small sizes, and on the large ones those that were worth it: the choices
/// with a point on either front.
fn measure(scene: Scene, choices: &[Choice], detail: Detail) -> Test {
    let (small, large) = sizes(detail);
    let every = |sizes: &[usize], of: &[usize]| -> Vec<Point> {
        let plans: Vec<(usize, usize)> =
            sizes.iter().flat_map(|&size| of.iter().map(move |&choice| (choice, size))).collect();
        plans.into_par_iter().map(|plan| point(&scene, choices, plan)).collect()
    };
    let points = every(small, &(0..choices.len()).collect::<Vec<_>>());
    let mut test = Test { scene: scene.clone(), points };
    let fronts = Neighbours::ALL.into_iter().flat_map(|among| test.front(among, choices));
    let mut worthy: Vec<usize> = fronts.map(|index| test.points[index].choice).collect();
    worthy.sort_unstable();
    worthy.dedup();
    test.points.extend(every(large, &worthy));
    test
}

impl Test {
    /// `(interactions, error)` of every run, the error in the L1 norm; not a number where the choice has too few
    /// neighbours.
    fn costs(&self, among: Neighbours, choices: &[Choice]) -> Vec<(f64, f64)> {
        let cost = |point: &Point| {
            if choices[point.choice].method.ratio < among.smallest_ratio() {
                return (f64::NAN, f64::NAN);
            }
            (point.run.interactions as f64, point.run.comparison.l1)
        };
        self.points.iter().map(cost).collect()
    }

    /// The runs that no other beats in both, by interactions: which they are does not depend on the machine.
    fn front(&self, among: Neighbours, choices: &[Choice]) -> Vec<usize> {
        pareto_front(&self.costs(among, choices))
    }

    fn name(&self) -> &'static str {
        if self.scene == Scene::Step { "step" } else { "smooth hump" }
    }

    /// Runs with larger errors than the data themselves, or with an error that is no number.
    fn outside(&self) -> usize {
        let inside = |point: &&Point| point.run.comparison.l1 <= 1.0;
        self.points.len() - self.points.iter().filter(inside).count()
    }
}

pub(super) fn section(detail: Detail) -> Section {
    let choices = choices(detail);
    let tests = [Scene::Gaussian, Scene::Step].map(|scene| measure(scene, &choices, detail));
    let (small, large) = sizes(detail);
    let mut items = vec![introduction(&tests, &choices)];
    for (test, name) in tests.iter().zip(["figure_speed_smooth", "figure_speed_jump"]) {
        let caption = text().text(
            "speed_caption",
            words![
                "test" = test.name(),
                "equation" = test.scene.source(),
                "choices" = choices.len(),
                "least" = small[0],
                "small" = small[small.len() - 1],
                "large" = large[large.len() - 1],
                "outside" = test.outside(),
                "runs" = test.points.len(),
            ],
        );
        let data = vec![(format!("{name}.csv"), data(test, &choices))];
        items.push(text().figure(name, words!["caption" = caption], figure(test, &choices), data));
    }
    items.push(recommendation::table(&tests, &choices));
    text().section("title_speed", items)
}

fn introduction(tests: &[Test], choices: &[Choice]) -> Item {
    let fronts = tests.iter().map(|test| {
        let front = test.front(Neighbours::Any, choices);
        let lax_wendroff = front.iter().filter(|&&index| {
            choices[test.points[index].choice].method.scheme == AdvectionScheme::LaxWendroffSph
        });
        let (name, count) = (test.name(), lax_wendroff.count());
        format!("{name}: {count} of the {} runs on the front are Lax–Wendroff SPH", front.len())
    });
    text().paragraph("speed_text", words!["fronts" = fronts.collect::<Vec<_>>().join("; ")])
}

/// What became of runs without an error that says something.
const OUTSIDE: &str = "error above 1, drawn at the top";

fn figure(test: &Test, choices: &[Choice]) -> Figure {
    let panels =
        [(Neighbours::Any, "(a) all runs"), (Neighbours::Several, "(b) several neighbours")];
    let mut figure = Figure::grid(1, 2).size(7.4, 4.2);
    // Runs with larger errors than the data themselves have no place in the picture.
    let errors = test.points.iter().map(|point| point.run.comparison.l1);
    let lowest = 0.5 * errors.fold(1.0, f64::min);
    for (among, title) in panels {
        let costs = test.costs(among, choices);
        let mut panel =
            Panel::new(Axis::log("interactions"), Axis::log("L1 error").range(lowest, 2.0))
                .title(format!("{title}, {}", test.name()));
        // All runs faintly; over them what is best of each scheme, and where it beats the other schemes too.
        let best = test.front(among, choices);
        for (scheme, color) in SCHEMES {
            let runs: Vec<(f64, f64)> = test
                .points
                .iter()
                .zip(&costs)
                .map(|(point, &cost)| match choices[point.choice].method.scheme == scheme {
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

fn data(test: &Test, choices: &[Choice]) -> Vec<u8> {
    let front = test.front(Neighbours::Any, choices);
    let rows = test.points.iter().enumerate().map(|(index, point)| {
        let (Choice { method, share }, run) = (&choices[point.choice], &point.run);
        let share = share.map_or_else(String::new, |share| share.to_string());
        let mut cells =
            cells![method.scheme, method.kernel.name(), method.ratio, share, run.courant_number];
        let seen = &run.comparison;
        cells.extend(cells![point.particles, run.steps, seen.l1, seen.l2, seen.l_infinity]);
        cells.extend(cells![run.interactions, front.contains(&index), point.seconds]);
        cells
    });
    let header = "scheme,kernel,ratio,share_of_limit,cfl,particles,steps,l1,l2,l_infinity,\
                  interactions,front,seconds";
    csv(header, rows)
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
        let at =
            |particles: usize| test.points.iter().filter(move |p| p.particles == particles).count();
        assert!(small.iter().all(|&particles| at(particles) == choices.len()));
        assert!(at(large[0]) > 0 && at(large[0]) < choices.len());
        // The end of the front is the smallest error of all, whatever it costs.
        let costs = test.costs(Neighbours::Any, &choices);
        let front = test.front(Neighbours::Any, &choices);
        let smallest = costs.iter().map(|cost| cost.1).fold(f64::INFINITY, f64::min);
        assert_eq!(costs[*front.last().unwrap()].1, smallest);
        // With several neighbours nothing of ratio 1 is left.
        let several = test.front(Neighbours::Several, &choices);
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
