//! One wave of a run alone: a norm over the whole domain is mostly that of the widest wave.

use super::riemann_run::{RiemannRun, exact, gas, solution};
use courant_simulation::comparison::Columns;
use courant_simulation::riemann::Wave;

/// Points of a window at which errors are taken.
const SAMPLES: usize = 2000;

/// A variable of the gas.
#[derive(Debug, Clone, Copy)]
pub(super) enum Variable {
    Density,
    Velocity,
    Pressure,
    Energy,
}

impl Variable {
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "density" => Self::Density,
            "velocity" => Self::Velocity,
            "pressure" => Self::Pressure,
            "energy" => Self::Energy,
            _ => return None,
        })
    }

    pub(super) fn column(self, columns: &Columns<f64>) -> f64 {
        match self {
            Self::Density => columns.density,
            Self::Velocity => columns.velocity,
            Self::Pressure => columns.pressure,
            Self::Energy => columns.energy,
        }
    }

    fn of(self, run: &RiemannRun) -> &[f64] {
        let profile = &run.run.profile;
        match self {
            Self::Density => &profile.density,
            Self::Velocity => &profile.velocity,
            Self::Pressure => &profile.pressure,
            Self::Energy => &profile.energy,
        }
    }

    fn exact(self, run: &RiemannRun, x: f64) -> f64 {
        let state = exact(&run.tube, x, run.run.time);
        match self {
            Self::Density => state.density(),
            Self::Velocity => state.velocity(),
            Self::Pressure => state.pressure(),
            Self::Energy => gas(&run.tube).internal_energy(state.density(), state.pressure()),
        }
    }
}

/// The exact places of the waves of a run at its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    domain: [f64; 2],
    /// The left wave: its outer and its inner edge.
    left: [f64; 2],
    contact: f64,
    /// The inner edge of the right wave.
    right: f64,
}

impl Places {
    pub(super) fn of(run: &RiemannRun) -> Self {
        let (solution, origin) = solution(&run.tube);
        let at = |speed: f64| origin + speed * run.run.time;
        let contact = at(solution.velocity());
        let edges = |wave: Wave| match wave {
            Wave::Absent => [contact; 2],
            Wave::Shock { speed } => [at(speed); 2],
            Wave::Rarefaction { head, tail } => [at(head), at(tail)],
        };
        let [_, right] = edges(solution.right_wave());
        Self { domain: run.tube.domain, left: edges(solution.left_wave()), contact, right }
    }

    /// The window of one wave by name. Pressure and velocity do not jump at the contact.
    pub(super) fn window(&self, name: &str) -> Option<[f64; 2]> {
        let Self { domain, left: [outer, inner], contact, right } = *self;
        Some(match name {
            "left-wave" => [outer, inner],
            // About the inner edge of the left wave: from its middle half way to the contact.
            "left-tail" => [0.5 * (outer + inner), 0.5 * (inner + contact)],
            // Half way to the waves beside it.
            "contact" => [0.5 * (inner + contact), 0.5 * (contact + right)],
            "left-of-contact" => [domain[0], contact],
            "right-of-contact" => [contact, domain[1]],
            _ => return None,
        })
    }
}

/// `∫|u − exact| dx` over a window, the profile joined by straight lines: the same measure for particles and cells,
/// which a mean over points is not, since particles crowd where the gas is dense.
pub(super) fn error(run: &RiemannRun, variable: Variable, [from, to]: [f64; 2]) -> f64 {
    let mut points: Vec<(f64, f64)> =
        run.run.profile.x.iter().copied().zip(variable.of(run).iter().copied()).collect();
    // Particles may have passed each other.
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let step = (to - from) / SAMPLES as f64;
    let sum: f64 = (0..SAMPLES)
        .map(|i| {
            let x = from + (i as f64 + 0.5) * step;
            (joined(&points, x) - variable.exact(run, x)).abs()
        })
        .sum();
    sum * step
}

/// The polyline through points in order; beyond its ends the value there.
fn joined(points: &[(f64, f64)], x: f64) -> f64 {
    let next = points.partition_point(|point| point.0 < x);
    match (next.checked_sub(1).map(|before| points[before]), points.get(next)) {
        (Some((a, u)), Some(&(b, v))) if b > a => u + (v - u) * (x - a) / (b - a),
        (Some((_, u)), _) => u,
        (None, Some(&(_, v))) => v,
        (None, None) => f64::NAN,
    }
}

/// The values of the points inside a window, in the order of their places.
fn inside(run: &RiemannRun, variable: Variable, window: [f64; 2]) -> Vec<f64> {
    let profile = &run.run.profile;
    let mut points = profile.inside(window);
    points.sort_by(|&i, &j| profile.x[i].total_cmp(&profile.x[j]));
    points.into_iter().map(|i| variable.of(run)[i]).collect()
}

/// The difference of the largest and smallest exact values in the domain.
pub(super) fn range(run: &RiemannRun, variable: Variable) -> f64 {
    let [from, to] = run.tube.domain;
    let values =
        (0..=SAMPLES).map(|i| variable.exact(run, from + (to - from) * i as f64 / SAMPLES as f64));
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    high - low
}

/// How far values in a window exceed all exact ones there, over the range of the exact solution in the domain.
pub(super) fn overshoot(run: &RiemannRun, variable: Variable, window: [f64; 2]) -> f64 {
    let [from, to] = window;
    let highest = (0..=SAMPLES)
        .map(|i| variable.exact(run, from + (to - from) * i as f64 / SAMPLES as f64))
        .fold(f64::NEG_INFINITY, f64::max);
    let beyond = inside(run, variable, window).into_iter().map(|value| value - highest);
    beyond.fold(0.0, f64::max) / range(run, variable)
}

/// How much more than from end to end the values in a window go up and down, over the range of the exact solution in
/// the domain: zero for a monotone profile.
pub(super) fn oscillation(run: &RiemannRun, variable: Variable, window: [f64; 2]) -> f64 {
    let values = inside(run, variable, window);
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return f64::NAN };
    let whole: f64 = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    // Sums of a monotone profile may differ by their rounding.
    (whole - (last - first).abs()).max(0.0) / range(run, variable)
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_simulation::method::Method;
    use courant_simulation::scene::Scene;

    #[test]
    fn a_fault_counts_in_its_window_only() {
        let tube = Scene::named("toro3").unwrap();
        let method = Method::named("finite-volume").unwrap();
        let mut run = RiemannRun::new("", tube, method, 100);
        let profile = &mut run.run.profile;
        let (x, time) = (profile.x.clone(), run.run.time);
        for (i, &x) in x.iter().enumerate() {
            let state = exact(&run.tube, x, time);
            profile.density[i] = state.density();
            profile.velocity[i] = state.velocity();
            profile.pressure[i] = state.pressure();
            profile.energy[i] = gas(&run.tube).internal_energy(state.density(), state.pressure());
        }
        let places = Places::of(&run);
        let window = |name| places.window(name).unwrap();
        // A shift of the pressure in the rarefaction is no error of the shock.
        let before = error(&run, Variable::Pressure, window("right-of-contact"));
        let [from, to] = window("left-wave");
        let wave: Vec<usize> = run.run.profile.inside([from, to]);
        for &i in &wave {
            run.run.profile.pressure[i] += 100.0;
        }
        assert_eq!(error(&run, Variable::Pressure, window("right-of-contact")), before);
        let inside = error(&run, Variable::Pressure, window("left-wave"));
        assert!((inside / (100.0 * (to - from)) - 1.0).abs() < 0.1, "{inside}");
        // One cell too high at the contact, by a tenth of the range.
        assert_eq!(oscillation(&run, Variable::Pressure, window("contact")), 0.0);
        let cells = run.run.profile.inside(window("contact"));
        let spike = 0.1 * range(&run, Variable::Pressure);
        run.run.profile.pressure[cells[1]] += spike;
        assert!((overshoot(&run, Variable::Pressure, window("contact")) - 0.1).abs() < 1e-9);
        assert!((oscillation(&run, Variable::Pressure, window("contact")) - 0.2).abs() < 1e-9);
    }
}
