//! Shu's expansion-wave solution: the collapse of the singular isothermal sphere from the inside out.

use super::runge_kutta::runge_kutta;
use crate::bisection::root;
use std::sync::LazyLock;

/// A point of the similarity solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    /// `α = 4πG ρ t²`.
    pub density: f64,
    /// `v = u/c`, negative for infall.
    pub velocity: f64,
    /// `m = G M/(c³ t)` inside `x`.
    pub mass: f64,
}

/// The solution of Shu (1977), section II, for `A → 2⁺`: with `x = r/(c t)`,
///
/// `[(x − v)² − 1] v' = [α (x − v) − 2/x] (x − v)`,
/// `[(x − v)² − 1] α'/α = [α − 2/x (x − v)] (x − v)`, `m = x² α (x − v)`.
///
/// At `x ≥ 1` the sphere still stands: `α = 2/x²`, `v = 0`. The point `x = 1` is degenerate (two solutions leave it, and an
/// integration inward slides onto the one that stands), so the solution is found as the limit of those that
/// start far out, as `α = A/x² − A(A − 2)/(2x⁴)`, `v = −(A − 2)/x`, and are regular everywhere: `A = 2 + 10⁻⁹`, which moves the core
/// mass by two or three times that.
///
/// ```
/// use courant_simulation::gravity::ExpansionWave;
/// let wave = ExpansionWave::solution();
/// assert!((wave.core_mass() - 0.9755).abs() < 5e-5);
/// assert_eq!(wave.at(2.0).density, 0.5); // nothing has happened there
/// assert!(wave.at(0.5).velocity < 0.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ExpansionWave {
    /// `ln x`, falling.
    abscissa: Vec<f64>,
    /// `[ln α, v]` and their slopes by `ln x` there.
    values: Vec<[f64; 2]>,
    slopes: Vec<[f64; 2]>,
    core_mass: f64,
}

/// `A − 2`.
const EXCESS: f64 = 1e-9;
/// Where the integration begins; the series leaves out terms of relative size `x⁻⁴`.
const FAR: f64 = 1e3;
/// Where it ends: from there on, free fall.
const NEAR: f64 = 1e-5;

/// `d(ln α, v)/d ln x`.
fn slope(log: f64, [log_density, v]: [f64; 2]) -> [f64; 2] {
    let (x, density) = (log.exp(), log_density.exp());
    let w = x - v;
    let common = x * w / (w * w - 1.0);
    [common * (density - 2.0 / x * w), common * (density * w - 2.0 / x)]
}

impl ExpansionWave {
    /// The solution, computed once.
    pub fn solution() -> &'static Self {
        static SOLUTION: LazyLock<ExpansionWave> =
            LazyLock::new(|| ExpansionWave::from_excess(EXCESS));
        &SOLUTION
    }

    /// The solution for `A = 2 + excess`, `excess > 0`: Shu's table 1.
    fn from_excess(excess: f64) -> Self {
        const TOLERANCE: f64 = 1e-13;
        let a = 2.0 + excess;
        let density = a / (FAR * FAR) * (1.0 - 0.5 * excess / (FAR * FAR));
        let mut solution =
            Self { abscissa: Vec::new(), values: Vec::new(), slopes: Vec::new(), core_mass: 0.0 };
        let (mut log, mut y) = (FAR.ln(), [density.ln(), -excess / FAR]);
        let mut h = -0.01;
        let end = NEAR.ln();
        while log > end {
            solution.abscissa.push(log);
            solution.values.push(y);
            solution.slopes.push(slope(log, y));
            loop {
                let whole = runge_kutta(slope, log, y, h);
                let middle = runge_kutta(slope, log, y, 0.5 * h);
                let half = runge_kutta(slope, log + 0.5 * h, middle, 0.5 * h);
                let error = (0..2).map(|i| (half[i] - whole[i]).abs() / 15.0).fold(0.0, f64::max);
                let scale = (TOLERANCE / error.max(1e-300)).powf(0.2).clamp(0.2, 2.0);
                if error <= TOLERANCE * (1.0 + half[1].abs()) {
                    log += h;
                    y = half;
                    h = (h * scale).clamp(-0.01, -1e-12);
                    break;
                }
                h *= 0.9 * scale.min(0.9);
            }
        }
        let x = log.exp();
        // The last term of the mass inside x: what has not fallen in yet, Shu (1977) (22).
        solution.core_mass = x * x * y[0].exp() * (x - y[1]) - shell(x, y[0].exp());
        solution
    }

    /// `m0 = G Ṁ/c³`, the mass of the core over `c³t/G`.
    pub fn core_mass(&self) -> f64 {
        self.core_mass
    }

    /// The solution at `x = r/(c t) > 0`.
    pub fn at(&self, x: f64) -> Similarity {
        if x >= 1.0 {
            return Similarity { density: 2.0 / (x * x), velocity: 0.0, mass: 2.0 * x };
        }
        let log = x.ln();
        let next = self.abscissa.partition_point(|&one| one > log);
        let (density, velocity) = if next == self.abscissa.len() {
            ((0.5 * self.core_mass / x.powi(3)).sqrt(), -(2.0 * self.core_mass / x).sqrt())
        } else {
            let [log_density, velocity] = self.between(next, log);
            (log_density.exp(), velocity)
        };
        Similarity { density, velocity, mass: x * x * density * (x - velocity) }
    }

    /// The `x` where the infall has reached a speed, in sound speeds.
    pub fn infall(&self, speed: f64) -> f64 {
        root(0.0, 1.0, |x| self.at(x).velocity + speed)
    }

    /// Hermite's cubic between two steps.
    fn between(&self, next: usize, log: f64) -> [f64; 2] {
        let (from, to) = (self.abscissa[next - 1], self.abscissa[next]);
        let h = to - from;
        let s = (log - from) / h;
        std::array::from_fn(|i| {
            let [left, right] = [self.values[next - 1][i], self.values[next][i]];
            let [m, n] = [h * self.slopes[next - 1][i], h * self.slopes[next][i]];
            let rise = right - left;
            left + s * (m + s * (3.0 * rise - 2.0 * m - n + s * (m + n - 2.0 * rise)))
        })
    }

    /// `ρ`, `u` and `M(<r)` at radius `r` and time `t ≥ 0`, for `c = G = 1`.
    ///
    /// ```
    /// use courant_simulation::gravity::ExpansionWave;
    /// let state = ExpansionWave::solution().state(0.5, 0.0);
    /// assert_eq!((state.velocity, state.mass), (0.0, 1.0));
    /// ```
    pub fn state(&self, r: f64, t: f64) -> Similarity {
        use std::f64::consts::PI;
        if t <= r {
            // The same as at x ≥ 1, without dividing by a time that may be zero.
            return Similarity { density: 0.5 / (PI * r * r), velocity: 0.0, mass: 2.0 * r };
        }
        let similar = self.at(r / t);
        Similarity {
            density: similar.density / (4.0 * PI * t * t),
            mass: similar.mass * t,
            ..similar
        }
    }
}

/// `∫₀ˣ α x² dx` in free fall, `α ∝ x^(−3/2)`.
fn shell(x: f64, density: f64) -> f64 {
    density * x.powi(3) / 1.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn core_mass_has_its_digits_and_is_the_limit() {
        let limit = ExpansionWave::solution().core_mass();
        for (excess, error) in [(1e-7, 1e-6), (1e-8, 1e-7)] {
            let near = ExpansionWave::from_excess(excess).core_mass();
            assert!(near > limit && near - limit < error, "{near} {limit}");
        }
        // Shu (1977) prints 0.975.
        assert!((limit - 0.975_469).abs() < 1e-6, "{limit}");
        // His table 1: A and m0 of the solutions without a static part.
        for (a, published) in [(2.2, 1.45), (2.4, 1.88)] {
            let core = ExpansionWave::from_excess(a - 2.0).core_mass();
            assert!((core - published).abs() < 0.006, "A = {a}: {core}");
        }
    }

    #[test]
    fn another_road_inward_and_the_published_table() {
        // Inside, the branch that falls leaves x = 1 along v = ln x, α = 2/x, up to the third order. From there the
        // equations as printed, by Heun's method in x.
        let rhs = |x: f64, [density, v]: [f64; 2]| {
            let w = x - v;
            let under = w * w - 1.0;
            [density * (density - 2.0 / x * w) * w / under, (density * w - 2.0 / x) * w / under]
        };
        let start: f64 = 0.99;
        let mut state = [2.0 / start, start.ln()];
        let (mut x, mut between) = (start, 0.0);
        while x > 2e-3 {
            let h = -1e-5 * x.min(0.5);
            let first = rhs(x, state);
            let second = rhs(x + h, std::array::from_fn(|i| state[i] + h * first[i]));
            let old = state[0] * x * x;
            state = std::array::from_fn(|i| state[i] + 0.5 * h * (first[i] + second[i]));
            x += h;
            between -= 0.5 * h * (old + state[0] * x * x);
            let found = ExpansionWave::solution().at(x);
            assert!((found.density / state[0] - 1.0).abs() < 2e-4, "{x}");
            assert!((found.velocity - state[1]).abs() < 2e-4 * (1.0 + found.velocity.abs()), "{x}");
        }
        // m is the integral of α x², which the solution never used.
        let wave = ExpansionWave::solution();
        let difference = wave.at(start).mass - wave.at(x).mass;
        assert!((difference / between - 1.0).abs() < 1e-4, "{difference} {between}");
        // Shu (1977), table 2.
        let near = wave.at(0.05);
        assert!((near.density - 71.5).abs() < 0.05 && (near.velocity + 5.44).abs() < 0.005);
        assert!((near.mass - 0.981).abs() < 5e-4);
        // It is continuous where its three pieces meet.
        for (x, gap) in [(1.0, 1e-7), (NEAR, 1e-6)] {
            let [inside, outside] = [wave.at(x * (1.0 - gap)), wave.at(x * (1.0 + gap))];
            assert!(
                (inside.density / outside.density - 1.0).abs() < 1e-4,
                "{inside:?} {outside:?}"
            );
            assert!((inside.mass / outside.mass - 1.0).abs() < 1e-4, "{inside:?} {outside:?}");
        }
    }
}
