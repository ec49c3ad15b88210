//! Spheres of gas: how their mass is distributed, and particles placed so.

use super::runge_kutta::runge_kutta;
use crate::particles::{Gas, PairLoops, ParticleSystem, Rates, Vector, dot, plus_scaled};
use crate::run::Reason;

/// How the mass of a sphere is distributed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// `ρ ∝ r^(−n)`: 0 is uniform, 1 is Evrard's, 2 the singular isothermal sphere.
    PowerLaw(f64),
    /// The isothermal sphere with a finite centre (Bonnor 1956, Ebert 1955), cut at a dimensionless radius
    /// `ξ = R √(4πGρ_c)/c`: stable below 6.451.
    BonnorEbert(f64),
}

/// `(ξ, ξ²ψ')`, by which mass grows, in steps outward.
type Growth = Vec<[f64; 2]>;

/// Steps from the centre of an isothermal sphere to its edge.
const STEPS: usize = 2000;

/// `ψ'' + 2ψ'/ξ = e^(−ψ)`, the equilibrium of `ρ = ρ_c e^(−ψ)`, as `(ψ, ξ²ψ')`.
fn lane_emden(extent: f64) -> (Growth, f64) {
    let h = extent / STEPS as f64;
    let slope = |x: f64, [psi, growth]: [f64; 2]| {
        [if x == 0.0 { 0.0 } else { growth / (x * x) }, x * x * (-psi).exp()]
    };
    let mut y = [0.0; 2];
    let mut table = vec![[0.0, 0.0]];
    for step in 0..STEPS {
        let x = step as f64 * h;
        y = runge_kutta(slope, x, y, h);
        table.push([x + h, y[1]]);
    }
    (table, y[0])
}

impl Distribution {
    /// The radius that holds a part of the mass, over that of the sphere, for many parts at once.
    fn radii(self, parts: impl Iterator<Item = f64>) -> Vec<f64> {
        match self {
            Self::PowerLaw(n) => parts.map(|part| part.powf(1.0 / (3.0 - n))).collect(),
            Self::BonnorEbert(extent) => {
                let (growth, _) = lane_emden(extent);
                let whole = growth[STEPS][1];
                let radius = |part: f64| {
                    let next = growth.partition_point(|g| g[1] < part * whole).clamp(1, STEPS);
                    let ([x, m], [y, n]) = (growth[next - 1], growth[next]);
                    // The mass goes with the cube where it is small.
                    let cube = x.powi(3) + (y.powi(3) - x.powi(3)) * (part * whole - m) / (n - m);
                    cube.cbrt() / extent
                };
                parts.map(radius).collect()
            }
        }
    }

    /// The radius that holds a part of the mass, over that of the sphere.
    pub fn radius_of(self, part: f64) -> f64 {
        self.radii(std::iter::once(part))[0]
    }

    /// The part of the mass inside a part of the radius.
    pub fn mass_inside(self, radius: f64) -> f64 {
        match self {
            Self::PowerLaw(n) => radius.powf(3.0 - n),
            Self::BonnorEbert(extent) => {
                let (growth, _) = lane_emden(extent);
                let at = radius * STEPS as f64;
                let step = (at as usize).min(STEPS - 1);
                let [from, to] = [growth[step][1], growth[step + 1][1]];
                (from + (at - step as f64) * (to - from)) / growth[STEPS][1]
            }
        }
    }

    /// `G M/(R c²)` of an isothermal sphere that is in equilibrium so; `None` where there is none.
    pub fn balance(self) -> Option<f64> {
        match self {
            Self::PowerLaw(n) => (n == 2.0).then_some(2.0),
            Self::BonnorEbert(extent) => Some(lane_emden(extent).0[STEPS][1] / extent),
        }
    }

    /// Density at the edge over the mean density.
    pub fn edge_density(self) -> f64 {
        match self {
            Self::PowerLaw(n) => (3.0 - n) / 3.0,
            Self::BonnorEbert(extent) => {
                let (growth, psi) = lane_emden(extent);
                (-psi).exp() * extent.powi(3) / (3.0 * growth[STEPS][1])
            }
        }
    }
}

/// `count` places in the ball of radius 1, each for the same part of the mass, in the order of their radii.
///
/// The directions and the order are those of a face-centred cubic lattice about a point of no symmetry; the `k`-th radius
/// holds `(k + ½)/count` of the mass, so a uniform ball is that lattice and all others are it, stretched.
///
/// ```
/// use courant_simulation::gravity::{Distribution, ball};
/// let places = ball(Distribution::PowerLaw(2.0), 1000);
/// let radius = |x: &[f64; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
/// // M(r) ∝ r: a tenth of the particles are inside a tenth of the radius.
/// assert_eq!(places.iter().filter(|x| radius(x) < 0.1).count(), 100);
/// ```
pub fn ball(distribution: Distribution, count: usize) -> Vec<Vector<3>> {
    // Four points in each cube; one shell of cubes more than the ball needs.
    let cubes = ((3.0 * count as f64 / (16.0 * std::f64::consts::PI)).cbrt() + 2.0) as i32;
    let centre = [0.137, 0.291, 0.413];
    let mut points = Vec::new();
    for x in -cubes..=cubes {
        for y in -cubes..=cubes {
            for z in -cubes..=cubes {
                for corner in [[0.0; 3], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]] {
                    let cube = [f64::from(x), f64::from(y), f64::from(z)];
                    let point: Vector<3> = std::array::from_fn(|i| cube[i] + corner[i] - centre[i]);
                    points.push((dot(&point, &point).sqrt(), point));
                }
            }
        }
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.truncate(count);
    let parts = (0..count).map(|k| (k as f64 + 0.5) / count as f64);
    let radii = distribution.radii(parts);
    let scaled = |((r, point), radius): (&(f64, Vector<3>), f64)| point.map(|x| x * radius / r);
    points.iter().zip(radii).map(scaled).collect()
}

/// Moves particles down the slope of the pair force, `steps` times and without their gaining speed; after each, the particle that is `k`-th from the
/// origin returns to the radius that the `k`-th had.
///
/// The mass inside every radius stays what it is, and the arrangement becomes alike in all directions. A lattice that was
/// stretched is not: its spacings differ by three for `ρ ∝ r⁻²`, the stress of its pairs is not a pressure, and the sphere
/// would not stand.
///
/// # Errors
/// [`Reason`] if the particles leave the states of a gas.
pub fn relax<G: Gas>(
    system: &mut ParticleSystem<3, G>,
    force: &dyn PairLoops<3>,
    steps: usize,
) -> Result<(), Reason> {
    let size = |x: &Vector<3>| dot(x, x).sqrt();
    let mut radii: Vec<f64> = system.particles.position.iter().map(size).collect();
    radii.sort_by(f64::total_cmp);
    let mut rates = Rates::default();
    for _ in 0..steps {
        system.rates(force, &mut rates)?;
        let sound = system.sound_speed().to_vec();
        let state = &mut system.particles;
        for (i, sound) in sound.iter().enumerate() {
            let push = &rates.acceleration[i];
            let h = state.smoothing[i];
            // A wave as short as the spacing has ω h/c of about 3: a step below 2/9 (h/c)² damps it.
            let step = (RELAXATION * (h / sound).powi(2)).min(0.1 * h / size(push));
            state.position[i] = plus_scaled(&state.position[i], step, push);
        }
        let mut order: Vec<(f64, usize)> =
            state.position.iter().enumerate().map(|(i, x)| (size(x), i)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (&(r, i), radius) in order.iter().zip(&radii) {
            state.position[i] = state.position[i].map(|component| component * radius / r);
        }
    }
    Ok(())
}

/// See [`relax`], in `(h/c)²`.
const RELAXATION: f64 = 0.1;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonnor_and_ebert_s_sphere_has_its_critical_numbers() {
        // Critical: ξ = 6.451, density contrast 14.04, m = 1.18 (Bonnor 1956; Spitzer 1968).
        let (growth, psi) = lane_emden(6.451);
        assert!((psi.exp() - 14.04).abs() < 0.01, "{}", psi.exp());
        let mass = growth[STEPS][1] * (4.0 * std::f64::consts::PI * psi.exp()).sqrt().recip();
        assert!((mass - 1.18).abs() < 0.005, "{mass}");
        // Near the centre ξ²ψ' = ξ³/3 − ξ⁵/30 + ….
        let [x, m] = growth[50];
        assert!((m / (x.powi(3) / 3.0 * (1.0 - x * x / 10.0)) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn parts_of_the_mass_and_radii_are_inverse() {
        for one in [
            Distribution::PowerLaw(0.0),
            Distribution::PowerLaw(1.0),
            Distribution::BonnorEbert(4.0),
        ] {
            let parts = [1e-3, 0.02, 0.3, 0.9, 1.0];
            for (part, radius) in parts.iter().zip(one.radii(parts.iter().copied())) {
                assert!((one.mass_inside(radius) / part - 1.0).abs() < 1e-4, "{one:?} {part}");
            }
            // dM/dr at the edge is 3 ρ_edge/ρ_mean.
            let slope = (1.0 - one.mass_inside(0.999)) / 0.001;
            assert!((slope / (3.0 * one.edge_density()) - 1.0).abs() < 2e-3, "{one:?}");
        }
    }
}
