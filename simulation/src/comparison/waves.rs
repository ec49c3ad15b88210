//! The waves of a Riemann problem in a profile.

use super::Columns;
use crate::bisection::root;
use crate::riemann::{Solution, Wave};
use crate::scene::Scene;

/// Which wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WaveKind {
    /// A shock.
    Shock,
    /// A rarefaction.
    Rarefaction,
    /// A contact.
    Contact,
}

/// Where a wave is, measured by the point at which the pressure (at a contact the density) is
/// midway between its values on the two sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WavePosition {
    /// Which wave.
    pub kind: WaveKind,
    /// Where it is in the exact solution.
    pub exact: f64,
    /// Where it is in the run (of several points the nearest); `None` if it is not found in
    /// the window.
    pub found: Option<f64>,
}

impl WavePosition {
    /// Found less exact.
    pub fn error(&self) -> Option<f64> {
        self.found.map(|found| found - self.exact)
    }
}

/// Jumps below this part of the larger value are no waves.
const FAINT: f64 = 1e-9;

/// The points where the polyline through `(x, u)` takes the value `level`.
fn crossings<'a>(x: &'a [f64], u: &'a [f64], level: f64) -> impl Iterator<Item = f64> + 'a {
    x.windows(2).zip(u.windows(2)).filter_map(move |(x, u)| {
        let (before, behind) = (u[0] - level, u[1] - level);
        (before != behind && before * behind <= 0.0)
            .then(|| x[0] + (x[1] - x[0]) * before / (before - behind))
    })
}

fn nearest(points: impl Iterator<Item = f64>, to: f64) -> Option<f64> {
    points.min_by(|a, b| (a - to).abs().total_cmp(&(b - to).abs()))
}

pub(super) fn positions(
    scene: &Scene,
    time: f64,
    x: &[f64],
    found: &Columns<Vec<f64>>,
) -> Vec<WavePosition> {
    let Some((solution, origin)) = scene.riemann() else { return Vec::new() };
    let far = |x: f64| scene.exact(x, time).map_or(0.0, |state| state.pressure());
    let star = solution.pressure();
    let mut waves = Vec::new();
    let mut acoustic = |wave: Wave, outer: f64| {
        let level = 0.5 * (outer + star);
        if (outer - star).abs() <= FAINT * outer.max(star) {
            return;
        }
        let (kind, ray) = match wave {
            Wave::Absent => return,
            Wave::Shock { speed } => (WaveKind::Shock, speed),
            Wave::Rarefaction { head, tail } => {
                (WaveKind::Rarefaction, ray_of_pressure(&solution, level, head, tail))
            }
        };
        let exact = origin + ray * time;
        let found = nearest(crossings(x, &found.pressure, level), exact);
        waves.push(WavePosition { kind, exact, found });
    };
    acoustic(solution.left_wave(), far(f64::NEG_INFINITY));
    acoustic(solution.right_wave(), far(f64::INFINITY));
    let (left, right) = solution.densities();
    if (left - right).abs() > FAINT * left.max(right) {
        let exact = origin + solution.velocity() * time;
        let found = nearest(crossings(x, &found.density, 0.5 * (left + right)), exact);
        waves.push(WavePosition { kind: WaveKind::Contact, exact, found });
    }
    waves
}

/// The ray of a rarefaction with a given pressure: the pressure is monotone along it.
fn ray_of_pressure(solution: &Solution, level: f64, head: f64, tail: f64) -> f64 {
    // It falls from the head to the tail.
    root(head.min(tail), head.max(tail), |ray| {
        (solution.sample(ray).pressure() - level) * (head - tail).signum()
    })
}

pub(super) fn contact_width(scene: &Scene, time: f64, x: &[f64], density: &[f64]) -> Option<f64> {
    let (solution, origin) = scene.riemann()?;
    let (left, right) = solution.densities();
    if (left - right).abs() <= FAINT * left.max(right) {
        return None;
    }
    let place = origin + solution.velocity() * time;
    let at = |part: f64| nearest(crossings(x, density, left + part * (right - left)), place);
    Some((at(0.9)? - at(0.1)?).abs())
}

/// Pairs of neighbours count that are both inside the middle 80 % of a rarefaction.
pub(super) fn glitch(scene: &Scene, time: f64, x: &[f64], velocity: &[f64]) -> Option<f64> {
    let (solution, origin) = scene.riemann()?;
    let mut largest = None;
    for wave in [solution.left_wave(), solution.right_wave()] {
        let Wave::Rarefaction { head, tail } = wave else { continue };
        let exact = |x: f64| solution.sample((x - origin) / time).velocity();
        let (a, b) = (origin + head * time, origin + tail * time);
        let whole = (exact(b) - exact(a)).abs();
        let (from, to) = (a.min(b) + 0.1 * (a - b).abs(), a.max(b) - 0.1 * (a - b).abs());
        for (x, v) in x.windows(2).zip(velocity.windows(2)) {
            if x[0] >= from && x[1] <= to && whole > 0.0 {
                let error = ((v[1] - v[0]) - (exact(x[1]) - exact(x[0]))).abs() / whole;
                largest = Some(f64::max(largest.unwrap_or(0.0), error));
            }
        }
    }
    largest
}
