use super::*;
use crate::exact::laurent::Laurent;
use crate::exact::rational::{Rational, ratio, to_f64};
use crate::kernel::Kernel;
use crate::scheme::{Integrator, KernelLattice, LatticeMethod, catalogue};
use proptest::prelude::*;

fn compiled(text: &str) -> CompiledStep {
    Step::from_text(text).unwrap().compile().unwrap()
}

#[test]
fn closed_forms() {
    let upwind = compiled("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])");
    let crank_nicolson =
        compiled("u[n+1,j] + C/4*(u[n+1,j+1] - u[n+1,j-1]) = u[n,j] - C/4*(u[n,j+1] - u[n,j-1])");
    let leapfrog = compiled("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])");
    assert_eq!(leapfrog.parameters(), ["C"]);
    let near = |z: Complex64, w: Complex64| assert!((z - w).norm() < 4e-15, "{z} and {w}");
    for index in 0..=64 {
        let (phase, courant) = (f64::from(index) * PI / 64.0, 0.1 + 0.03 * f64::from(index));
        let shift = Complex64::from_polar(1.0, -phase);
        near(upwind.multipliers(&[courant], phase)[0], 1.0 - courant * (1.0 - shift));
        let half = Complex64::new(0.0, 0.5 * courant * phase.sin());
        near(crank_nicolson.multipliers(&[courant], phase)[0], (1.0 - half) / (1.0 + half));
        let sine = courant * phase.sin();
        let root = Complex64::from(1.0 - sine * sine).sqrt();
        let found = leapfrog.multipliers(&[courant], phase);
        // Near C sin φ = 1 both are worth the root of a rounding only.
        if (1.0 - sine * sine).abs() > 1e-3 {
            let expected = [root, -root].map(|root| root - Complex64::new(0.0, sine));
            assert_eq!(found.len(), 2);
            for z in expected {
                assert!(found.iter().any(|w| (z - w).norm() < 1e-13), "{z} {found:?}");
            }
        }
    }
}

#[test]
fn long_waves_keep_their_digits() {
    let diffusion = compiled("u[n+1,j] = u[n,j] + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])");
    let phase = 1e-9;
    let found = diffusion.differences(&[0.25], phase)[0].re;
    assert!((found / (-0.25 * phase * phase) - 1.0).abs() < 1e-14);
}

#[test]
fn a_singular_implicit_step_has_an_infinite_multiplier() {
    // (1 + C(E − 1)) z = 1 at C = 1/2, φ = π.
    let downwind = compiled("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]");
    assert!(downwind.multipliers(&[0.5], PI)[0].re.is_infinite());
    assert!((downwind.multipliers(&[1.0], PI)[0] + 1.0).norm() < 1e-15);
}

#[test]
fn forward_waves_come_first() {
    let wave = compiled("u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])");
    for index in 1..64 {
        let z = wave.multipliers(&[0.9], f64::from(index) * PI / 64.0);
        assert!(z[0].im < 0.0 && z[0] == z[1].conj());
    }
}

/// Particle methods: a Runge–Kutta method of as many stages as its order multiplies a wave by `Σ_k (−iωΔt)^k/k!`.
#[test]
fn particles_agree_with_the_stability_functions_of_their_frequencies() {
    for name in ["sph", "sph-av", "gph"] {
        for h in [ratio(6, 5), ratio(5, 2)] {
            let method = catalogue::method(name).unwrap();
            let lattice = LatticeMethod::new(method, Kernel::CubicSpline, &h).unwrap();
            let waves = lattice.waves().unwrap().compile();
            for (order, integrator) in (1..).zip(["euler", "heun", "rk3-ssp", "rk4"]) {
                let step = lattice.step(Integrator::named(integrator).unwrap()).unwrap();
                let step = step.compile().unwrap();
                for index in 1..=40 {
                    let phase = f64::from(index) * PI / 40.0;
                    let (exact, time) = (waves.mode(phase).frequencies(), 0.7 * to_f64(&h));
                    let expected = [exact.forward, exact.backward].map(|omega| {
                        let lambda = Complex64::new(omega.im, -omega.re) * time;
                        (1..=order).rev().fold(Complex64::ONE, |sum, k| {
                            Complex64::ONE + lambda * sum / f64::from(k)
                        })
                    });
                    let found = step.multipliers(&[0.7], phase);
                    let apart = |i: usize, j: usize| {
                        (found[i] - expected[0]).norm() + (found[j] - expected[1]).norm()
                    };
                    let size = expected[0].norm() + expected[1].norm();
                    let gap = (expected[0] - expected[1]).norm();
                    let tolerance = 1e-12 * size * (1.0 + size / gap.max(1e-6));
                    assert!(
                        apart(0, 1).min(apart(1, 0)) < tolerance,
                        "{name} {integrator} {h} {phase}: {found:?} {expected:?}"
                    );
                }
            }
        }
    }
}

/// An entry at numbers, and the sum of the moduli of its terms.
fn value(entry: &Laurent, step: &Step, z: Complex64, phase: f64) -> (Complex64, f64) {
    let shift = Complex64::from_polar(1.0, phase);
    let (mut sum, mut size) = (Complex64::ZERO, 0.0);
    for (exponents, coefficient) in entry.terms() {
        let mut term = Complex64::from(to_f64(&Rational::from(coefficient.clone())))
            * z.powi(i32::from(exponents[0]))
            * shift.powi(i32::from(exponents[1]));
        for (variable, letter) in step.names().letters() {
            let number = letter.value.compile().at_cosine(phase.cos());
            term *= number.powi(i32::from(exponents[variable.0]));
        }
        sum += term;
        size += term.norm();
    }
    (sum, size)
}

/// The determinant by elimination with pivots, over the product of the sizes of the rows.
fn relative_determinant(rows: Vec<Vec<(Complex64, f64)>>) -> f64 {
    let size = rows.len();
    let mut determinant = Complex64::ONE;
    let scaled = |row: Vec<(Complex64, f64)>| -> Vec<Complex64> {
        let largest = row.iter().map(|entry| entry.1).fold(0.0, f64::max);
        row.into_iter().map(|entry| entry.0 / largest).collect()
    };
    let mut rows: Vec<Vec<Complex64>> = rows.into_iter().map(scaled).collect();
    for column in 0..size {
        let pivot = (column..size)
            .max_by(|&i, &j| rows[i][column].norm().total_cmp(&rows[j][column].norm()))
            .unwrap();
        rows.swap(column, pivot);
        let lead = rows[column].clone();
        determinant *= lead[column];
        if lead[column] == Complex64::ZERO {
            return 0.0;
        }
        for row in &mut rows[column + 1..] {
            let factor = row[column] / lead[column];
            for (entry, value) in row.iter_mut().zip(&lead) {
                *entry -= factor * value;
            }
        }
    }
    determinant.norm()
}

#[test]
fn the_equations_of_every_scheme_have_a_solution_at_its_multipliers() {
    let two = ratio(2, 1);
    let lattice = KernelLattice::new(Kernel::CubicSpline, &two).unwrap();
    let all = catalogue::schemes().iter().map(|scheme| (scheme, None));
    let stepped = [("dg-2", "rk3-ssp"), ("compact-6", "ab3"), ("acoustics-staggered-2", "bdf3")];
    let stepped = stepped.map(|(space, integrator)| {
        (catalogue::space(space).unwrap(), Some(Integrator::named(integrator).unwrap()))
    });
    for (scheme, integrator) in all.chain(stepped) {
        let lattice = scheme.needs_kernel().then_some(&lattice);
        let step = scheme.step(lattice, integrator, &[], scheme.parameter.as_deref()).unwrap();
        let step = step.with(&step.free_parameters()[0].clone(), &ratio(3, 7)).unwrap();
        let waves = step.compile().unwrap();
        for phase in [0.3, 1.1, 2.0, 2.9] {
            let found = waves.multipliers(&[], phase);
            assert_eq!(found.len(), waves.degree());
            for z in found {
                let entry = |entry: &Laurent| value(entry, &step, z, phase);
                let rows = step.matrix().rows().iter();
                let relative =
                    relative_determinant(rows.map(|row| row.iter().map(entry).collect()).collect());
                assert!(relative < 1e-9, "{} at {phase}: z = {z}, {relative:e}", scheme.name);
            }
        }
    }
}

proptest! {
    #[test]
    fn an_explicit_step_multiplies_a_wave_by_its_multiplier(
        weights in prop::collection::vec(-9i64..9, 3..6), phase in -3.1f64..3.1, size in 1i64..50
    ) {
        // Σ_k c_k e^{ikφ}, summed here term by term.
        let text = weights.iter().zip(-2i64..).map(|(weight, offset)| {
            format!("+ ({weight})/{size}*u[n,j{offset:+}]")
        }).collect::<String>();
        prop_assume!(weights.iter().any(|&w| w != 0));
        let found = compiled(&format!("u[n+1,j] = {text}")).multipliers(&[], phase)[0];
        let expected: Complex64 = weights.iter().zip(-2i32..).map(|(&weight, offset)| {
            Complex64::from_polar(weight as f64 / size as f64, f64::from(offset) * phase)
        }).sum();
        prop_assert!((found - expected).norm() < 1e-12 * (1.0 + expected.norm()));
    }
}
