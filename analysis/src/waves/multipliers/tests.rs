use super::*;
use crate::exact::float::Float;
use crate::exact::laurent::Laurent;
use crate::exact::rational::{Rational, ratio, to_f64};
use crate::kernel::Kernel;
use crate::scheme::{Integrator, KernelLattice, LatticeMethod, catalogue};
use crate::waves::precise::{AxisPlace, Place, PreciseStep};
use num_traits::Signed;
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
        near(upwind.multipliers(&[courant], &[phase])[0], 1.0 - courant * (1.0 - shift));
        let half = Complex64::new(0.0, 0.5 * courant * phase.sin());
        near(crank_nicolson.multipliers(&[courant], &[phase])[0], (1.0 - half) / (1.0 + half));
        let sine = courant * phase.sin();
        let root = Complex64::from(1.0 - sine * sine).sqrt();
        let found = leapfrog.multipliers(&[courant], &[phase]);
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
    let found = diffusion.differences(&[0.25], &[phase])[0].re;
    assert!((found / (-0.25 * phase * phase) - 1.0).abs() < 1e-14);
}

#[test]
fn long_waves_keep_their_digits_along_every_direction() {
    // (δx² + 3 δy²)²: all terms are of fourth order in the phases together, none of them divides the others.
    let text = "w[n,i,j] = u[n,i+1,j] - 2*u[n,i,j] + u[n,i-1,j] + 3*(u[n,i,j+1] - 2*u[n,i,j] + u[n,i,j-1])\n\
                u[n+1,i,j] = u[n,i,j] - (w[n,i+1,j] - 2*w[n,i,j] + w[n,i-1,j])/64 - 3/64*(w[n,i,j+1] - 2*w[n,i,j] + w[n,i,j-1])";
    let step = compiled(text);
    for [x, y] in [[1e-9_f64, 2e-9], [-3e-8, 1e-12], [0.0, 1e-7], [1e-5, 1e-5]] {
        let exact = -(x * x + 3.0 * y * y).powi(2) / 64.0;
        let found = step.differences(&[], &[x, y])[0].re;
        assert!((found / exact - 1.0).abs() < 1e-9, "{x} {y}: {found:e} {exact:e}");
    }
}

#[test]
fn closed_forms_in_two_and_three_dimensions() {
    let near = |z: Complex64, w: Complex64| assert!((z - w).norm() < 1e-14, "{z} and {w}");
    let lax_wendroff = compiled(
        "u[n+1,i,j] = u[n,i,j] - A/2*(u[n,i+1,j] - u[n,i-1,j]) - B/2*(u[n,i,j+1] - u[n,i,j-1]) \
         + A^2/2*(u[n,i+1,j] - 2*u[n,i,j] + u[n,i-1,j]) + B^2/2*(u[n,i,j+1] - 2*u[n,i,j] + u[n,i,j-1]) \
         + A*B/4*(u[n,i+1,j+1] - u[n,i+1,j-1] - u[n,i-1,j+1] + u[n,i-1,j-1])",
    );
    let yee = compiled(
        "X[n+1/2,i,j+1/2,k+1/2] = X[n-1/2,i,j+1/2,k+1/2] + A*(V[n,i,j+1/2,k+1] - V[n,i,j+1/2,k]) - A*(W[n,i,j+1,k+1/2] - W[n,i,j,k+1/2])\n\
         Y[n+1/2,i+1/2,j,k+1/2] = Y[n-1/2,i+1/2,j,k+1/2] + A*(W[n,i+1,j,k+1/2] - W[n,i,j,k+1/2]) - A*(U[n,i+1/2,j,k+1] - U[n,i+1/2,j,k])\n\
         Z[n+1/2,i+1/2,j+1/2,k] = Z[n-1/2,i+1/2,j+1/2,k] + A*(U[n,i+1/2,j+1,k] - U[n,i+1/2,j,k]) - A*(V[n,i+1,j+1/2,k] - V[n,i,j+1/2,k])\n\
         U[n+1,i+1/2,j,k] = U[n,i+1/2,j,k] + A*(Z[n+1/2,i+1/2,j+1/2,k] - Z[n+1/2,i+1/2,j-1/2,k]) - A*(Y[n+1/2,i+1/2,j,k+1/2] - Y[n+1/2,i+1/2,j,k-1/2])\n\
         V[n+1,i,j+1/2,k] = V[n,i,j+1/2,k] + A*(X[n+1/2,i,j+1/2,k+1/2] - X[n+1/2,i,j+1/2,k-1/2]) - A*(Z[n+1/2,i+1/2,j+1/2,k] - Z[n+1/2,i-1/2,j+1/2,k])\n\
         W[n+1,i,j,k+1/2] = W[n,i,j,k+1/2] + A*(Y[n+1/2,i+1/2,j,k+1/2] - Y[n+1/2,i-1/2,j,k+1/2]) - A*(X[n+1/2,i,j+1/2,k+1/2] - X[n+1/2,i,j-1/2,k+1/2])",
    );
    assert_eq!((lax_wendroff.dimension(), yee.dimension(), yee.degree()), (2, 3, 6));
    for [x, y, t] in [[0.3, -1.1, 2.0], [PI, 0.7, -PI], [-2.9, -0.1, 1.6], [PI, PI, PI]] {
        // g = 1 − i(A sin x + B sin y) − A²(1 − cos x) − B²(1 − cos y) − AB sin x sin y
        let (a, b) = (0.3, 0.4);
        let re =
            1.0 - a * a * (1.0 - x.cos()) - b * b * (1.0 - y.cos()) - a * b * x.sin() * y.sin();
        let expected = Complex64::new(re, -(a * x.sin() + b * y.sin()));
        near(lax_wendroff.multipliers(&[a, b], &[x, y])[0], expected);
        // z − 2 + 1/z = −4 A² (s_x + s_y + s_z) for two pairs; the two of the divergences stand still.
        let courant = 0.5;
        let s: f64 = [x, y, t].map(|phase: f64| (0.5 * phase).sin().powi(2)).iter().sum();
        let half = (courant * s.sqrt()).asin();
        let found = yee.multipliers(&[courant], &[x, y, t]);
        let wave = Complex64::from_polar(1.0, -2.0 * half);
        for z in found {
            let distance = [wave, wave.conj(), Complex64::ONE].map(|w| (z - w).norm());
            // Every multiplier is double: the root of a rounding.
            assert!(distance.iter().any(|d| *d < 1e-6), "{z} {wave}");
        }
    }
}

#[test]
#[should_panic(expected = "one phase for each axis")]
fn a_wave_has_a_phase_for_each_axis() {
    compiled("u[n+1,i,j] = u[n,i-1,j]").multipliers(&[], &[1.0]);
}

/// A phase by the tangent `t` of its quarter: `sin(φ/2) = 2t/(1 + t²)`, `cos(φ/2) = (1 − t²)/(1 + t²)`.
fn axis_place(t: &Rational, bits: u32) -> AxisPlace {
    let s = (ratio(2, 1) * t / (ratio(1, 1) + t * t)).pow(2);
    let complement = ratio(1, 1) - &s;
    let float = |value: &Rational| Float::fraction(value, bits);
    AxisPlace { s: float(&s), complement: float(&complement), backward: t.is_negative() }
}

#[test]
fn a_singular_implicit_step_has_an_infinite_multiplier() {
    // (1 + C(E − 1)) z = 1 at C = 1/2, φ = π.
    let downwind = compiled("u[n+1,j] + C*(u[n+1,j+1] - u[n+1,j]) = u[n,j]");
    assert!(downwind.multipliers(&[0.5], &[PI])[0].re.is_infinite());
    assert!((downwind.multipliers(&[1.0], &[PI])[0] + 1.0).norm() < 1e-15);
}

#[test]
fn forward_waves_come_first() {
    let wave = compiled("u[n+1,j] = 2*u[n,j] - u[n-1,j] + C^2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])");
    for index in 1..64 {
        let z = wave.multipliers(&[0.9], &[f64::from(index) * PI / 64.0]);
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
                    let found = step.multipliers(&[0.7], &[phase]);
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
        if step.dimension() > 1 {
            continue;
        }
        let step = step.with(&step.free_parameters()[0].clone(), &ratio(3, 7)).unwrap();
        let waves = step.compile().unwrap();
        for phase in [0.3, 1.1, 2.0, 2.9] {
            let found = waves.multipliers(&[], &[phase]);
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
    /// In three dimensions with two levels, against the same in 40 digits and against the shifts term by term.
    #[test]
    fn random_steps_in_three_dimensions(
        weights in prop::collection::vec(([-2i16..3, -1i16..2, -1i16..2], -9i64..10), 2..7),
        tangents in [-50i64..51, -50i64..51, -50i64..51],
    ) {
        prop_assume!(weights.iter().any(|(_, weight)| *weight != 0));
        let sum = weights.iter().map(|([i, j, k], weight)| {
            format!("+ ({weight})/16*u[n,i{i:+},j{j:+},k{k:+}]")
        }).collect::<String>();
        let text = format!("u[n+1,i,j,k] + u[n+1,i,j,k-1]/3 = u[n-1,i,j,k]/4 {sum}");
        let step = Step::from_text(&text).unwrap();
        let tangents = tangents.map(|t| ratio(t, 50));
        let place = Place(tangents.iter().map(|t| axis_place(t, 140)).collect());
        let phases: Vec<f64> = place.0.iter().map(AxisPlace::phase).collect();
        let terms = difference_terms(&primitive_characteristic(&step).unwrap());
        let precise = PreciseStep::new(&step, &terms, 140);
        let exact: Vec<Complex64> =
            precise.differences(&precise.coefficients(&place)).iter().map(|y| y.to_c64() + 1.0).collect();
        let shift = |[i, j, k]: [i16; 3]| {
            let phase: f64 = [i, j, k].iter().zip(&phases).map(|(&k, phase)| f64::from(k) * phase).sum();
            Complex64::from_polar(1.0, phase)
        };
        let b: Complex64 = weights.iter().map(|(k, weight)| shift(*k) * (*weight as f64 / 16.0)).sum();
        let found = step.compile().unwrap().polynomial(&[], &phases).multipliers();
        prop_assert_eq!(found.len(), 2);
        for (z, error) in found {
            prop_assert!(exact.iter().any(|w| (z - w).norm() <= error), "{z} {exact:?} {error}");
            // (1 + E_z⁻¹/3) z² = 1/4 + b z
            let value = z * z * (1.0 + shift([0, 0, -1]) / 3.0) - b * z - 0.25;
            prop_assert!(value.norm() < 1e-13 * (1.0 + b.norm()).powi(2));
        }
    }

    #[test]
    fn an_explicit_step_multiplies_a_wave_by_its_multiplier(
        weights in prop::collection::vec(-9i64..9, 3..6), phase in -3.1f64..3.1, size in 1i64..50
    ) {
        // Σ_k c_k e^{ikφ}, summed here term by term.
        let text = weights.iter().zip(-2i64..).map(|(weight, offset)| {
            format!("+ ({weight})/{size}*u[n,j{offset:+}]")
        }).collect::<String>();
        prop_assume!(weights.iter().any(|&w| w != 0));
        let found = compiled(&format!("u[n+1,j] = {text}")).multipliers(&[], &[phase])[0];
        let expected: Complex64 = weights.iter().zip(-2i32..).map(|(&weight, offset)| {
            Complex64::from_polar(weight as f64 / size as f64, f64::from(offset) * phase)
        }).sum();
        prop_assert!((found - expected).norm() < 1e-12 * (1.0 + expected.norm()));
    }
}
