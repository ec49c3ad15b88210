//! The dispersion relations by a second road: a deliberately plain particle code on a periodic ring,
//! linearised by finite differences. It shares the kernel with the library and nothing else: no lattice
//! sums, no formulas, no integrators.

use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::kernel::{Density, LatticeSums};
use courant_analysis::scheme::catalogue::SchemeFile;
use courant_analysis::scheme::{Integrator, LatticeMethod, catalogue};
use courant_analysis::waves::dispersion::{stepped_frequencies, two_waves};
use num_complex::Complex64;

/// Particles on the ring; mass, spacing and sound speed are 1.
const N: usize = 64;

/// The force between two particles beyond what the kernel says.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Force {
    Pressure,
    Viscous {
        alpha: f64,
    },
    /// `−c v_r / ρ̄`: the viscosity that a signal velocity of `2c` gives.
    SignalVelocity,
    Riemann,
    /// The Riemann problem with the particle itself as the left state, wherever the other one is.
    RiemannAlwaysLeft,
}

struct Ring {
    kernel: Kernel,
    h: f64,
    force: Force,
    /// `P/(ρ0 c²)` at rest.
    pressure: f64,
}

type State = (Vec<f64>, Vec<f64>);

impl Ring {
    fn separation(x: &[f64], a: usize, b: usize) -> f64 {
        let raw = x[a] - x[b];
        raw - (raw / N as f64).round() * N as f64
    }

    fn densities(&self, x: &[f64]) -> Vec<f64> {
        let weight = |a, b| self.kernel.value(Self::separation(x, a, b).abs() / self.h) / self.h;
        (0..N).map(|a| (0..N).map(|b| weight(a, b)).sum()).collect()
    }

    fn accelerations(&self, x: &[f64], v: &[f64]) -> Vec<f64> {
        let density = self.densities(x);
        let at_rest: f64 = {
            let reach = (0..N).map(|k| k.min(N - k) as f64);
            reach.map(|distance| self.kernel.value(distance / self.h) / self.h).sum()
        };
        let pressure = |rho: f64| (rho - at_rest) + self.pressure * at_rest;
        (0..N)
            .map(|a| {
                let mut sum = 0.0;
                for b in (0..N).filter(|&b| b != a) {
                    let r = Self::separation(x, a, b);
                    let q = r.abs() / self.h;
                    if q > self.kernel.support() {
                        continue;
                    }
                    let slope = self.kernel.slope(q) / (self.h * self.h) * r.signum();
                    let (rho_a, rho_b) = (density[a], density[b]);
                    let inverse_squares = (rho_a * rho_a).recip() + (rho_b * rho_b).recip();
                    let plain =
                        pressure(rho_a) / (rho_a * rho_a) + pressure(rho_b) / (rho_b * rho_b);
                    let mean = 0.5 * (rho_a + rho_b);
                    let approach = (v[a] - v[b]) * r.signum();
                    sum -= slope
                        * match self.force {
                            Force::Pressure => plain,
                            Force::Viscous { alpha } => plain - alpha * approach / (q * mean),
                            Force::SignalVelocity => plain - approach / mean,
                            Force::Riemann if r > 0.0 => {
                                star_pressure((rho_b, v[b]), (rho_a, v[a])) * inverse_squares
                            }
                            Force::Riemann | Force::RiemannAlwaysLeft => {
                                star_pressure((rho_a, v[a]), (rho_b, v[b])) * inverse_squares
                            }
                        };
                }
                sum
            })
            .collect()
    }

    /// One step of an integrator, written out once more.
    fn step(&self, integrator: &str, (x, v): &State, dt: f64) -> State {
        let add = |p: &[f64], w: f64, q: &[f64]| -> Vec<f64> {
            p.iter().zip(q).map(|(p, q)| p + w * q).collect()
        };
        let force = |x: &[f64], v: &[f64]| self.accelerations(x, v);
        match integrator {
            "forward-euler" => (add(x, dt, v), add(v, dt, &force(x, v))),
            "symplectic-euler" => {
                let v = add(v, dt, &force(x, v));
                (add(x, dt, &v), v)
            }
            "centred-euler" => {
                let new = add(v, dt, &force(x, v));
                (add(&add(x, 0.5 * dt, v), 0.5 * dt, &new), new)
            }
            "leapfrog-kdk" | "leapfrog-kdk-predicted" => {
                let a = force(x, v);
                let half = add(v, 0.5 * dt, &a);
                let x = add(x, dt, &half);
                let seen = if integrator == "leapfrog-kdk" { half.clone() } else { add(v, dt, &a) };
                let a = force(&x, &seen);
                (x, add(&half, 0.5 * dt, &a))
            }
            "rk2-midpoint" => {
                let a = force(x, v);
                let (xm, vm) = (add(x, 0.5 * dt, v), add(v, 0.5 * dt, &a));
                (add(x, dt, &vm), add(v, dt, &force(&xm, &vm)))
            }
            "rk2-heun" => {
                let a = force(x, v);
                let (xe, ve) = (add(x, dt, v), add(v, dt, &a));
                let b = force(&xe, &ve);
                let x = add(&add(x, 0.5 * dt, v), 0.5 * dt, &ve);
                (x, add(&add(v, 0.5 * dt, &a), 0.5 * dt, &b))
            }
            "rk3-ssp" => {
                let euler = |x: &[f64], v: &[f64]| (add(x, dt, v), add(v, dt, &force(x, v)));
                let mix = |p: &[f64], w: f64, q: &[f64]| -> Vec<f64> {
                    p.iter().zip(q).map(|(p, q)| (1.0 - w) * p + w * q).collect()
                };
                let (x1, v1) = euler(x, v);
                let (x2, v2) = euler(&x1, &v1);
                let (x2, v2) = (mix(x, 0.25, &x2), mix(v, 0.25, &v2));
                let (x3, v3) = euler(&x2, &v2);
                (mix(x, 2.0 / 3.0, &x3), mix(v, 2.0 / 3.0, &v3))
            }
            "rk4" => {
                let a1 = force(x, v);
                let (x2, v2) = (add(x, 0.5 * dt, v), add(v, 0.5 * dt, &a1));
                let a2 = force(&x2, &v2);
                let (x3, v3) = (add(x, 0.5 * dt, &v2), add(v, 0.5 * dt, &a2));
                let a3 = force(&x3, &v3);
                let (x4, v4) = (add(x, dt, &v3), add(v, dt, &a3));
                let a4 = force(&x4, &v4);
                let sum = |p: &[f64], [k1, k2, k3, k4]: [&[f64]; 4]| -> Vec<f64> {
                    (0..N)
                        .map(|i| p[i] + dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
                        .collect()
                };
                (sum(x, [v, &v2, &v3, &v4]), sum(v, [&a1, &a2, &a3, &a4]))
            }
            "predictor-corrector" => {
                let (xp, vp) = (add(x, 0.5 * dt, v), add(v, 0.5 * dt, &force(x, v)));
                let vc = add(v, 0.5 * dt, &force(&xp, &vp));
                let xc = add(x, 0.5 * dt, &vc);
                let twice =
                    |c: &[f64], p: &[f64]| c.iter().zip(p).map(|(c, p)| 2.0 * c - p).collect();
                (twice(&xc, x), twice(&vc, v))
            }
            other => panic!("{other} is not written out"),
        }
    }

    fn at_rest() -> State {
        ((0..N).map(|i| i as f64).collect(), vec![0.0; N])
    }
}

/// `P*` of the isothermal Riemann problem, Cha & Whitworth 2003 (27), `c = 1`.
fn star_pressure((rho_l, v_l): (f64, f64), (rho_r, v_r): (f64, f64)) -> f64 {
    let (a, b) = (rho_l.sqrt(), rho_r.sqrt());
    let x = a * b / (a + b);
    let jump = x * (v_l - v_r);
    (0.5 * (jump + (jump * jump + 4.0 * x * (a + b)).sqrt())).powi(2)
}

/// The derivative of a vector function at 0 by central differences, extrapolated to step 0.
///
/// A lattice point on a knot of the kernel makes the third derivative jump there, so every power of the
/// step occurs in the error, not the even ones alone. Six steps from 0.04 leave an error of 1e-13 times
/// the seventh derivative, and rounding of 1e-16/1e-3 times a condition of about ten.
fn derivative(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let mut table: Vec<Vec<f64>> = (0..6)
        .map(|level| {
            let step = 0.04 * 0.5f64.powi(level);
            f(step).iter().zip(f(-step)).map(|(p, m)| (p - m) / (2.0 * step)).collect()
        })
        .collect();
    for order in 1..6 {
        let weight = 2f64.powi(order);
        table = table
            .windows(2)
            .map(|pair| {
                let fine = pair[1].iter().zip(&pair[0]);
                fine.map(|(fine, coarse)| (weight * fine - coarse) / (weight - 1.0)).collect()
            })
            .collect();
    }
    table.remove(0)
}

/// `Σ_m J_m e^{−iκm}`: a column of a circulant matrix on the harmonic of one mode.
fn harmonic(column: &[f64], kappa: f64) -> Complex64 {
    column.iter().enumerate().map(|(m, value)| value * Complex64::cis(-kappa * m as f64)).sum()
}

/// The roots of `z² + p z + q`.
fn roots(p: Complex64, q: Complex64) -> [Complex64; 2] {
    let root = (p * p - 4.0 * q).sqrt();
    [0.5 * (-p + root), 0.5 * (-p - root)]
}

/// Two pairs of roots agree: to 1e-6 each; where a pair nearly coincides, its square root magnifies the
/// errors of the differences (about 1e-12), and then their squares must agree.
fn assert_same_pair(found: [Complex64; 2], expected: [Complex64; 2], what: &str) {
    let distance =
        |pair: [Complex64; 2]| (found[0] - pair[0]).norm().max((found[1] - pair[1]).norm());
    let error = distance(expected).min(distance([expected[1], expected[0]]));
    let split = (expected[0] - expected[1]).norm();
    assert!(error < 1e-6 || error * error.max(split) < 1e-10, "{what}: {found:?} {expected:?}");
}

fn phases() -> impl Iterator<Item = f64> {
    (1..=N / 2).map(|j| std::f64::consts::TAU * j as f64 / N as f64)
}

/// `F` and `G` of the plain code for every phase.
fn relations(ring: &Ring) -> Vec<(f64, Complex64, Complex64)> {
    let displaced = derivative(|step| {
        let (mut x, v) = Ring::at_rest();
        x[0] += step;
        ring.accelerations(&x, &v)
    });
    let moving = derivative(|step| {
        let (x, mut v) = Ring::at_rest();
        v[0] += step;
        ring.accelerations(&x, &v)
    });
    phases().map(|phase| (phase, harmonic(&displaced, phase), harmonic(&moving, phase))).collect()
}

fn assert_frequencies(ring: &Ring, method: &LatticeMethod) {
    let waves = method.waves().unwrap().compile();
    for (phase, f, g) in relations(ring) {
        // −ω² = F − iωG.
        let found = roots(-Complex64::I * g, f);
        let expected = waves.mode(phase).frequencies();
        let what = format!("{} {:?} h {} κ {phase}", ring.kernel, ring.force, ring.h);
        assert_same_pair(found, [expected.forward, expected.backward], &what);
    }
}

/// Ratios whose lattice points lie on knots of the kernel or well away from them.
fn lattices() -> Vec<(Kernel, Rational)> {
    vec![
        (Kernel::CubicSpline, ratio(1, 1)),
        (Kernel::CubicSpline, ratio(6, 5)),
        (Kernel::CubicSpline, ratio(3, 2)),
        (Kernel::CubicSpline, ratio(2, 1)),
        (Kernel::QuarticSpline, ratio(6, 5)),
        (Kernel::QuinticSpline, ratio(3, 2)),
        (Kernel::Gaussian, ratio(11, 10)),
        (Kernel::WendlandC2, ratio(6, 5)),
        (Kernel::WendlandC4, ratio(8, 5)),
    ]
}

fn lattice(name: &str, kernel: Kernel, h: &Rational) -> LatticeMethod {
    let method = catalogue::method(name).expect("it is in the list");
    LatticeMethod::new(method, kernel, h).expect("the ratios here are in range")
}

#[test]
fn every_mode_of_every_method_has_the_frequency_of_the_plain_code() {
    for (kernel, h) in lattices() {
        for (force, name, alpha) in [
            (Force::Pressure, "sph", None),
            (Force::Viscous { alpha: 1.0 }, "sph-av", Some(1)),
            (Force::Viscous { alpha: 4.0 }, "sph-av", Some(4)),
            (Force::Riemann, "gph", None),
            // At linear order the resolved Riemann problem is a signal-velocity viscosity.
            (Force::SignalVelocity, "gph", None),
        ] {
            let ring = Ring { kernel, h: to_f64(&h), force, pressure: 1.0 };
            let mut method = lattice(name, kernel, &h);
            if let Some(alpha) = alpha {
                method = method.with("alpha", &integer(alpha));
            }
            assert_frequencies(&ring, &method);
        }
    }
}

/// The relation printed for Godunov particle hydrodynamics, `ω² + S ω − ω_SPH² = 0`, is that of a code nobody would write.
#[test]
fn the_printed_relation_takes_every_particle_as_its_own_left_state() {
    for (kernel, h) in lattices() {
        let force = Force::RiemannAlwaysLeft;
        let ring = Ring { kernel, h: to_f64(&h), force, pressure: 1.0 };
        let sums = LatticeSums::new(kernel, &h, Density::Summation).unwrap().compile();
        for (phase, f, g) in relations(&ring) {
            let at = sums.at(phase);
            let restoring = 2.0 * at.curvature - at.gradient.powi(2);
            let expected = roots(at.gradient.into(), (-restoring).into());
            let found = roots(-Complex64::I * g, f);
            assert_same_pair(found, expected, &format!("{kernel} h {h} κ {phase}"));
        }
    }
}

#[test]
fn other_pressures_and_tension() {
    for pressure in [ratio(5, 7), ratio(0, 1), ratio(-1, 2)] {
        for (force, name) in [(Force::Pressure, "sph"), (Force::Viscous { alpha: 1.0 }, "sph-av")] {
            let (h, kernel) = (ratio(6, 5), Kernel::CubicSpline);
            let ring = Ring { kernel, h: to_f64(&h), force, pressure: to_f64(&pressure) };
            assert_frequencies(&ring, &lattice(name, kernel, &h).with("P", &pressure));
        }
    }
}

/// As gph, with the difference of neighbours instead of the particle's own: what always taking the left side amounts to.
const ALWAYS_LEFT: &str = r#"
name = "always-left"
equations = """
x[j]' = u[j]
s[j] = sum(k, w[k]*(x[j+k] - x[j-k]))/rho
u[j]' = -(C*ratio)^2*(2*sum(k, v[k]*(2*x[j] - x[j+k] - x[j-k])) + sum(k, w[k]*(s[j+k] - s[j-k])))/rho       + C*ratio*sum(k, w[k]*(u[j+k] - u[j-k]))/rho
"""
"#;

#[test]
fn one_step_of_every_integrator_multiplies_every_mode_as_predicted() {
    let always_left: &SchemeFile = Box::leak(Box::new(SchemeFile::from_toml(ALWAYS_LEFT).unwrap()));
    let always_left = LatticeMethod::new(always_left, Kernel::WendlandC2, &ratio(6, 5)).unwrap();
    for (method, force) in [
        (lattice("gph", Kernel::CubicSpline, &ratio(6, 5)), Force::Riemann),
        (lattice("sph-av", Kernel::QuinticSpline, &ratio(3, 2)), Force::Viscous { alpha: 1.0 }),
        (lattice("sph", Kernel::CubicSpline, &ratio(1, 1)), Force::Pressure),
        (always_left, Force::RiemannAlwaysLeft),
    ] {
        let kernel = method.kernel();
        let ring = Ring { kernel, h: to_f64(method.ratio()), force, pressure: 1.0 };
        let dt = 0.4;
        for integrator in catalogue::PARTICLE_INTEGRATORS {
            let step = method.step(Integrator::named(integrator).unwrap()).unwrap();
            let step = step.compile().unwrap();
            let column = |perturb: &dyn Fn(&mut State, f64)| {
                derivative(|step| {
                    let mut state = Ring::at_rest();
                    perturb(&mut state, step);
                    let (x, v) = ring.step(integrator, &state, dt);
                    let rest = Ring::at_rest().0;
                    x.iter().zip(rest).map(|(x, rest)| x - rest).chain(v).collect()
                })
            };
            let displaced = column(&|state, step| state.0[0] += step);
            let moving = column(&|state, step| state.1[0] += step);
            for phase in phases() {
                let part = |column: &[f64], index: usize| {
                    harmonic(&column[index * N..(index + 1) * N], phase)
                };
                let [a, c] = [part(&displaced, 0), part(&displaced, 1)];
                let [b, d] = [part(&moving, 0), part(&moving, 1)];
                let found = roots(-(a + d), a * d - b * c);
                // c Δt/h
                let expected = step.multipliers(&[dt / ring.h], &[phase]);
                let what = format!("{kernel} {force:?} {integrator} κ {phase}");
                assert_same_pair(found, [expected[0], expected[1]], &what);
            }
        }
    }
}

#[test]
fn stepped_frequencies_converge_to_the_continuous_ones() {
    // A long way round both: ω = i ln z/Δt of small steps is the root of the relation.
    let method = lattice("gph", Kernel::CubicSpline, &ratio(6, 5));
    let waves = method.waves().unwrap().compile();
    for integrator in catalogue::integrators() {
        let time = 1e-5;
        let Ok(step) = method.step(integrator) else { panic!("{integrator}") };
        let step = step.compile().unwrap();
        for phase in phases().step_by(7) {
            let exact = waves.mode(phase).frequencies();
            let pair = two_waves(&step, &[time / 1.2], phase, &exact, time);
            let stepped = stepped_frequencies(pair, time);
            // First order at worst: the error is the step times the square of the frequency.
            assert!((stepped.forward - exact.forward).norm() < 2e-4, "{integrator} {phase}");
            assert!((stepped.backward - exact.backward).norm() < 2e-4, "{integrator} {phase}");
        }
    }
}
