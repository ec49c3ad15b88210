//! Finite differences of the running step against the dispersion relations.

use super::explicit;
use crate::particles::*;
use crate::riemann::isothermal::{Expansion, Isothermal};
use courant_analysis::kernel::Kernel;
use num_complex::Complex64;
use std::f64::consts::PI;

const C: f64 = 1.3;

/// `F` and `G` of `v̇ = F x + G v` from lattice sums, sharing only the kernel's shape with the
/// simulation: `F = −c²(2T − S²)`, `G = −c D` for GPH and `−α h c B` for viscous SPH.
struct Lattice {
    s: f64,
    t: f64,
    d: f64,
    b: f64,
}

impl Lattice {
    fn new(kernel: Kernel, h: f64, spacing: f64, phase: f64) -> Self {
        let neighbours = |sum: &mut dyn FnMut(f64, f64)| {
            for k in 1..=(kernel.support() * h / spacing + 1e-9) as i64 {
                sum(k as f64 * spacing, k as f64 * phase);
            }
        };
        let mut density = kernel.value(0.0) / h; // ρ0/M
        neighbours(&mut |x, _| density += 2.0 * kernel.value(x / h) / h);
        let (mut s, mut t, mut d, mut b) = (0.0, 0.0, 0.0, 0.0);
        neighbours(&mut |x, angle| {
            let slope = -kernel.slope(x / h) / (h * h);
            let curvature = kernel.curvature(x / h) / (h * h * h);
            s += 2.0 * angle.sin() * slope / density;
            t += 2.0 * (1.0 - angle.cos()) * curvature / density;
            d += 2.0 * (1.0 - angle.cos()) * slope / density;
            b += 2.0 * (1.0 - angle.cos()) * slope / x / density;
        });
        Self { s, t, d, b }
    }

    fn force(&self) -> f64 {
        -C * C * (2.0 * self.t - self.s * self.s)
    }
}

type Matrix = [[f64; 2]; 2];

/// Integrators whose step is written out below.
const WRITTEN_OUT: [&str; 13] = [
    "forward-euler",
    "symplectic-euler",
    "centred-euler",
    "leapfrog-kdk",
    "leapfrog-kdk-predicted",
    "leapfrog-dkd",
    "predictor-corrector",
    "rk2-midpoint",
    "rk2-heun",
    "rk3-ssp",
    "rk3-kutta",
    "rk4",
    "rk4-38",
];

/// One step of an integrator on `ẋ = v, v̇ = F x + G v`, written out.
fn predicted(integrator: &str, f: f64, g: f64, dt: f64) -> Matrix {
    let rates = |x: f64, v: f64| f * x + g * v;
    let step = |x: f64, v: f64| -> [f64; 2] {
        let a = rates(x, v);
        match integrator {
            "forward-euler" => [x + dt * v, v + dt * a],
            "symplectic-euler" => [x + dt * (v + dt * a), v + dt * a],
            "centred-euler" => [x + dt * v + 0.5 * dt * dt * a, v + dt * a],
            "leapfrog-kdk" | "leapfrog-kdk-predicted" => {
                let half = v + 0.5 * dt * a;
                let moved = x + dt * half;
                let seen = if integrator == "leapfrog-kdk" { half } else { v + dt * a };
                [moved, half + 0.5 * dt * rates(moved, seen)]
            }
            "leapfrog-dkd" => {
                let kicked = v + dt * rates(x + 0.5 * dt * v, v);
                [x + 0.5 * dt * (v + kicked), kicked]
            }
            // For a linear system every RK2 is I + Z + Z²/2, RK3 and RK4 have one and two terms more.
            "predictor-corrector" => {
                let (middle_x, middle_v) = (x + 0.5 * dt * v, v + 0.5 * dt * a);
                let kick = dt * rates(middle_x, middle_v);
                [x + dt * (v + 0.5 * kick), v + kick]
            }
            other => {
                let order = other[2..3].parse().expect("rk and its order");
                let (mut sum, mut term) = ([x, v], [x, v]);
                for k in 1..=order {
                    let scale = dt / f64::from(k);
                    term = [scale * term[1], scale * rates(term[0], term[1])];
                    sum = [sum[0] + term[0], sum[1] + term[1]];
                }
                sum
            }
        }
    };
    let (first, second) = (step(1.0, 0.0), step(0.0, 1.0));
    [[first[0], second[0]], [first[1], second[1]]]
}

fn check(force: &dyn PairLoops<1>, kernel: Kernel, g: impl Fn(&Lattice, f64) -> f64) {
    const N: usize = 24;
    let (spacing, ratio) = (0.05, 1.35);
    let h = ratio * spacing;
    let gas = IsothermalGas { sound_speed: C };
    let (mass, smoothing) = (0.7 * spacing, SmoothingKernel::new(kernel));
    let ring = Ring { particles: N, spacing, mass, gas, kernel: smoothing, smoothing: h };
    for integrator in WRITTEN_OUT {
        let table = explicit(integrator);
        for mode in [1, 2, 5, 9, 12] {
            let lattice = Lattice::new(kernel, h, spacing, 2.0 * PI * mode as f64 / N as f64);
            let dt = 0.2 * spacing / C;
            let expected = predicted(integrator, lattice.force(), g(&lattice, h), dt);
            let measured =
                ring.amplification(force, &table, dt, mode, 1e-5).expect("a smooth state");
            // In units of spacing and sound speed, so that all entries are of order one. The
            // differences are good to size² + 1e-16/size ≈ 1e-10 times curvature of the star state.
            let unit = spacing / C;
            let scale = [[1.0, 1.0 / unit], [unit, 1.0]];
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let error = (measured[row][column] - Complex64::from(expected[row][column]))
                    * scale[row][column];
                assert!(
                    error.norm() < 1e-7,
                    "{kernel} {integrator} mode {mode} ({row}, {column}): {:?} against {:?}",
                    measured[row][column],
                    expected[row][column]
                );
            }
        }
    }
}

/// The resolved relation `ω² + i c D ω − ω_SPH² = 0` of GPH, for cases 1–3 and both solvers.
#[test]
fn gph_step_has_the_resolved_dispersion_relation() {
    for kernel in Kernel::ALL {
        for expansion in [Expansion::Exact, Expansion::AsShock] {
            let solver = Isothermal { sound_speed: C, expansion };
            let damping = |lattice: &Lattice, _: f64| -C * lattice.d;
            check(&Godunov::new(SumOfSquares, solver), kernel, damping);
            check(&Godunov::new(Product, solver), kernel, damping);
            check(&Godunov::new(OwnKernels, solver), kernel, damping);
        }
    }
}

/// `ω² + i α h c B ω − ω_SPH² = 0`, with `r/(r² + 0.01h²)` in place of `1/r` undone by
/// comparing at zero viscosity and by the exact factor per neighbour.
#[test]
fn sph_step_has_its_dispersion_relation() {
    for kernel in Kernel::ALL {
        for form in [PressureForm::Sum, PressureForm::Geometric] {
            let viscosity =
                Viscosity { alpha: 0.0, beta: 0.0, acts_on: ActsOn::All, softening: 0.01 };
            check(&Smoothed { form, viscosity }, kernel, |_, _| 0.0);
        }
    }
}

/// The linear term of (8) damps like `−α h c B`, up to the softening of its denominator, which is at
/// most `0.01 (h/Δ)²` of it.
#[test]
fn viscosity_damps_like_the_lattice_sum() {
    const N: usize = 24;
    let (alpha, h) = (0.8, 1.2);
    let gas = IsothermalGas { sound_speed: C };
    let kernel = Kernel::CubicSpline;
    let smoothing = SmoothingKernel::new(kernel);
    let ring = Ring { particles: N, spacing: 1.0, mass: 1.0, gas, kernel: smoothing, smoothing: h };
    let viscosity = Viscosity { alpha, beta: 0.0, acts_on: ActsOn::All, softening: 0.01 };
    let force = Smoothed { form: PressureForm::Sum, viscosity };
    for mode in 1..=12 {
        let lattice = Lattice::new(kernel, h, 1.0, 2.0 * PI * f64::from(mode) / N as f64);
        let step = ring
            .amplification(&force, &explicit("forward-euler"), 0.1, mode as usize, 1e-5)
            .expect("a smooth state");
        let measured = (step[1][1].re - 1.0) / 0.1;
        let expected = -alpha * h * C * lattice.b;
        assert!(
            measured / expected < 1.0 && measured / expected > 1.0 / (1.0 + 0.01 * h * h) - 1e-8
        );
    }
}
