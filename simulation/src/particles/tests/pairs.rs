//! Symmetry, conservation, and independence of numbering and threads.

use super::{at_rest, explicit, scatter};
use crate::boundary::Boundary;
use crate::particles::*;
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{ExactIdeal, IdealGas, Stopping, VanLeer};
use courant_analysis::kernel::Kernel;
use proptest::prelude::*;

/// A disordered gas with large differences of state.
pub(super) fn disordered<const D: usize>(
    gas: IdealGas,
    boundary: Boundary,
    count: usize,
    seed: u64,
    force: &dyn PairForce,
    kernel: Kernel,
) -> ParticleSystem<D, IdealGas> {
    let numbers = scatter(count * (2 * D + 2), seed);
    let mut number = numbers.into_iter();
    let mut next = || number.next().expect("enough numbers");
    let spacing = (1.0 / count as f64).powf(1.0 / D as f64);
    let particles = Particles {
        position: (0..count).map(|_| std::array::from_fn(|_| next())).collect(),
        velocity: (0..count).map(|_| std::array::from_fn(|_| 4.0 * next() - 2.0)).collect(),
        mass: (0..count).map(|_| (0.5 + next()) / count as f64).collect(),
        thermal: (0..count).map(|_| 10f64.powf(4.0 * next() - 2.0)).collect(),
        smoothing: vec![1.2 * spacing; count],
    };
    let domain = Domain::new([0.0; D], [1.0; D], boundary);
    let kernel = SmoothingKernel::new(kernel);
    ParticleSystem::new(gas, particles, domain, kernel, Smoothing::adaptive(1.2), force)
}

pub(super) fn air() -> IdealGas {
    IdealGas::new(1.4).expect("gamma > 1")
}

/// One of two particles of air on their line.
fn end(density: f64, pressure: f64, velocity: f64, smoothing: f64, volume_slope: f64) -> PairEnd {
    let sound_speed = air().sound_speed(density, pressure);
    PairEnd { density, pressure, sound_speed, velocity, smoothing, volume_slope, compression: 1.0 }
}

/// Runs a closure-like body for every pair force of the paper.
macro_rules! for_each_force {
    ($force:ident, $kernel:ident, $body:block) => {{
        let solver = VanLeer { gas: air(), stopping: Stopping::Published };
        let exact = ExactIdeal(air());
        let viscosity = Viscosity::STANDARD;
        for_each_force!(@ $force $kernel $body Kernel::CubicSpline,
            Godunov { weight: SumOfSquares, solver, work: PairWork::Mean },
            Godunov { weight: Product, solver, work: PairWork::Mean },
            Godunov { weight: OwnKernels, solver, work: PairWork::Star },
            Godunov { weight: OwnKernels, solver: exact, work: PairWork::Star },
            Smoothed { form: PressureForm::Sum, viscosity },
            Smoothed { form: PressureForm::Geometric, viscosity });
        for_each_force!(@ $force $kernel $body Kernel::Gaussian,
            Godunov { weight: Convolution, solver, work: PairWork::Star });
    }};
    (@ $force:ident $kernel:ident $body:block $which:expr, $($value:expr),*) => {
        $({ let ($force, $kernel) = ($value, $which); $body })*
    };
}

fn check_momentum<const D: usize>(boundary: Boundary) {
    for_each_force!(force, kernel, { check_momentum_of::<D>(boundary, &force, kernel) });
}

fn check_momentum_of<const D: usize>(boundary: Boundary, force: &dyn PairLoops<D>, kernel: Kernel) {
    let mut system = disordered::<D>(air(), boundary, 300, 5, force, kernel);
    let mut rates = Rates::default();
    system.rates(force, &mut rates).expect("a physical state");
    let state = &system.particles;
    for axis in 0..D {
        let forces = state.mass.iter().zip(&rates.acceleration).map(|(m, a)| m * a[axis]);
        let total: f64 = forces.clone().sum::<f64>() - rates.wall_force[axis];
        let scale: f64 = forces.map(f64::abs).sum();
        assert!(total.abs() < 1e-13 * scale, "{D} {boundary:?} {force:?}: {total:e} of {scale:e}");
    }
    // Total energy: walls are at rest and do no work.
    let powers = state.mass.iter().zip(&rates.energy).map(|(m, e)| m * e);
    let (total, scale) = (powers.clone().sum::<f64>(), powers.map(f64::abs).sum::<f64>());
    assert!(total.abs() < 1e-12 * scale, "{D} {boundary:?} {force:?}: {total:e} of {scale:e}");
}

#[test]
fn forces_are_antisymmetric_in_one_and_two_dimensions() {
    for boundary in [Boundary::Open, Boundary::Periodic] {
        check_momentum::<1>(boundary);
        check_momentum::<2>(boundary);
    }
    // A mirror image moves against its particle, so the pair's power is that of a wall at rest only
    // where the contact is: momentum is checked in both, energy by the symmetry of the Riemann problem.
    check_momentum::<1>(Boundary::Mirror);
    check_momentum::<2>(Boundary::Mirror);
}

#[test]
fn pair_in_a_mirror_is_the_mirrored_pair() {
    let a = end(1.0, 1.0, 0.4, 0.1, -0.3);
    let b = end(0.3, 0.1, -0.2, 0.13, -0.1);
    for_each_force!(force, kernel, {
        let kernel = SmoothingKernel::<2>::new(kernel);
        let here = force.exchange(&a, &b, 0.09, &kernel).expect("near enough");
        let there =
            force.exchange(&b.mirrored(), &a.mirrored(), 0.09, &kernel).expect("near enough");
        assert!((here.force - there.force).abs() < 1e-12 * here.force.abs());
        assert!((here.velocity + there.velocity).abs() < 1e-12);
    });
}

/// (14) and (16) as printed would cool two particles that approach.
#[test]
fn approaching_pair_heats_and_receding_pair_cools() {
    for closing in [-0.1, 0.1] {
        for_each_force!(force, kernel, {
            let at = |velocity| end(1.0, 1.0, velocity, 0.1, 0.0);
            let (left, right) = (at(0.5 * closing), at(-0.5 * closing));
            let kernel = SmoothingKernel::<1>::new(kernel);
            let exchange = force.exchange(&left, &right, 0.1, &kernel).expect("near enough");
            let heat_left = exchange.force * (exchange.velocity - left.velocity);
            let heat_right = -exchange.force * (exchange.velocity - right.velocity);
            assert!(exchange.force < 0.0);
            assert!(heat_left * closing > 0.0 && heat_right * closing > 0.0, "{force:?}");
        });
    }
}

/// A lattice whose spacing is a power of two: differences of positions are exact, and so is the cancellation.
#[test]
fn uniform_state_stays_uniform_bit_for_bit() {
    for_each_force!(force, kernel, { check_uniform(&force, kernel) });
}

fn check_uniform(force: &dyn PairLoops<1>, kernel: Kernel) {
    let (count, spacing) = (64, 1.0 / 64.0);
    let x: Vec<f64> = (0..count).map(|i| f64::from(i) * spacing).collect();
    let mut particles = at_rest(&x, spacing, 1.7, 1.3 * spacing);
    particles.velocity.fill([0.25]);
    let domain = Domain::new([0.0], [1.0], Boundary::Periodic);
    let mut system = ParticleSystem::new(
        air(),
        particles,
        domain,
        SmoothingKernel::new(kernel),
        Smoothing::adaptive(1.3),
        force,
    );
    let mut stepper = Stepper::new(explicit("centred-euler"));
    for _ in 0..20 {
        // Dyadic too, so that x + dt v is exact.
        stepper.step(&mut system, force, &mut (), 1.0 / 512.0).expect("a physical state");
    }
    let state = &system.particles;
    for i in 0..state.len() {
        assert_eq!(state.velocity[i], [0.25]);
        assert_eq!(state.thermal[i], 1.7);
        assert_eq!(state.position[i], [i as f64 * spacing + 20.0 * 0.25 / 512.0]);
        assert_eq!(system.density()[i], system.density()[0]);
    }
}

fn evolved<const D: usize>(order: &[usize], force: &dyn PairLoops<D>) -> Vec<Vector<D>> {
    let mut system =
        disordered::<D>(air(), Boundary::Mirror, order.len(), 11, force, Kernel::CubicSpline);
    let state = system.particles.clone();
    system.particles = Particles {
        position: order.iter().map(|&i| state.position[i]).collect(),
        velocity: order.iter().map(|&i| state.velocity[i]).collect(),
        mass: order.iter().map(|&i| state.mass[i]).collect(),
        thermal: order.iter().map(|&i| state.thermal[i]).collect(),
        smoothing: order.iter().map(|&i| state.smoothing[i]).collect(),
    };
    let mut stepper = Stepper::new(explicit("rk2-heun"));
    for _ in 0..3 {
        system.update_fields().expect("a physical state");
        stepper.begin(&mut system, force);
        let dt = 0.02 * stepper.crossing_time(&system);
        stepper.step(&mut system, force, &mut (), dt).expect("a physical state");
    }
    let mut result = vec![[0.0; D]; order.len()];
    for (place, &i) in order.iter().enumerate() {
        result[i] = system.particles.velocity[place];
    }
    result
}

#[test]
fn results_depend_neither_on_numbering_nor_on_threads() {
    let force = Godunov { weight: OwnKernels, solver: ExactIdeal(air()), work: PairWork::Star };
    let count = 3000;
    let natural: Vec<usize> = (0..count).collect();
    let mut shuffled = natural.clone();
    let keys = scatter(count, 77);
    shuffled.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
    let pool = |threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool")
    };
    let one = pool(1).install(|| evolved::<1>(&natural, &force));
    assert_eq!(one, pool(4).install(|| evolved::<1>(&natural, &force)));
    assert_eq!(one, evolved::<1>(&shuffled, &force));
    let plane = pool(1).install(|| evolved::<2>(&natural, &force));
    assert_eq!(plane, pool(4).install(|| evolved::<2>(&natural, &force)));
}

/// One dimension inside two: particles on a line of a narrow strip interact as on the line, and transverse
/// components stay out of it.
#[test]
fn pair_forces_act_along_the_line_of_centres() {
    let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::Exact };
    let force = Godunov { weight: OwnKernels, solver, work: PairWork::Star };
    let particles = Particles {
        position: vec![[0.0, 0.0], [0.06, 0.08]],
        velocity: vec![[0.3, 0.4], [-0.3, -0.4]],
        mass: vec![1.0, 2.0],
        thermal: vec![(); 2],
        smoothing: vec![0.1, 0.12],
    };
    let domain = Domain::new([0.0; 2], [1.0; 2], Boundary::Open);
    let kernel = SmoothingKernel::new(Kernel::CubicSpline);
    let gas = IsothermalGas { sound_speed: 1.0 };
    let mut system =
        ParticleSystem::new(gas, particles, domain, kernel, Smoothing::Constant, &force);
    let mut rates = Rates::default();
    system.rates(&force, &mut rates).expect("a physical state");
    let [a, b] = [rates.acceleration[0], rates.acceleration[1]];
    assert!(a[0] < 0.0 && (a[1] / a[0] - 4.0 / 3.0).abs() < 1e-14);
    assert_eq!([a[0], a[1]], [-2.0 * b[0], -2.0 * b[1]]);
    let density = |i: usize, h: f64| {
        let masses = [1.0, 2.0];
        masses[i] * kernel.value(0.0, h) + masses[1 - i] * kernel.value(0.1, h)
    };
    assert!((system.density()[0] / density(0, 0.1) - 1.0).abs() < 1e-14);
    assert!((system.density()[1] / density(1, 0.12) - 1.0).abs() < 1e-14);
}

/// What the ends of a pair get, against the work of each by its own expansion.
#[test]
fn ends_share_the_heat_of_a_pair_as_they_say() {
    let kernel = SmoothingKernel::<1>::new(Kernel::CubicSpline);
    let heats = |work, [p, q]: [f64; 2], [v, w]: [f64; 2]| {
        let force = Godunov { weight: OwnKernels, solver: ExactIdeal(air()), work };
        let (left, right) = (end(1.0, p, v, 0.1, 0.0), end(1.0, q, w, 0.1, 0.0));
        let both = force.exchange(&left, &right, 0.1, &kernel).expect("they touch");
        let [left, right] = [both.force * (both.velocity - v), both.force * (w - both.velocity)];
        assert!((left + right - both.force * (w - v)).abs() < 1e-14);
        [left, right]
    };
    // At rest the higher pressure heats the other end, or nobody does.
    let [left, right] = heats(PairWork::Star, [2.0, 1.0], [0.0; 2]);
    assert!(left < -0.1 && (left + right).abs() < 1e-14, "{left} {right}");
    for work in [PairWork::Mean, PairWork::Shared] {
        assert_eq!(heats(work, [2.0, 1.0], [0.0; 2]), [0.0; 2]);
        let [left, right] = heats(work, [2.0, 1.0], [0.3, -0.1]);
        assert!(left > 0.0 && (left / right - 1.0).abs() < 1e-12);
    }
    // Parting: in proportion to the pressures, and neither gives more than it would by the pressure it has.
    for pressures in [[2.0, 1.0], [1.0, 1e-6], [1e-6, 1.0]] {
        let heats = heats(PairWork::Shared, pressures, [-0.1, 0.2]);
        assert!((heats[0] * pressures[1] / (heats[1] * pressures[0]) - 1.0).abs() < 1e-9);
        let slope = 2.0 * kernel.slope(0.1, 0.1);
        for (heat, pressure) in heats.iter().zip(pressures) {
            assert!(*heat < 0.0 && *heat > slope * pressure * 0.3, "{heat} {pressure}");
        }
    }
}

/// (15) by quadrature along the line, for the uncut Gaussian, against the closed form.
#[test]
fn convolution_is_the_integral_it_stands_for() {
    for (r, h) in [(0.05, 0.1), (0.13, 0.1), (0.2, 0.09)] {
        let (left, right) = (end(1.0, 1.0, 0.0, h, 1.5), end(0.7, 1.0, 0.0, h, 3.0));
        let volume = |s: f64| {
            // Hermite's cubic on [−r/2, r/2] in its usual basis.
            let t = s / r + 0.5;
            let (t2, t3) = (t * t, t * t * t);
            (2.0 * t3 - 3.0 * t2 + 1.0) / left.density
                + (t3 - 2.0 * t2 + t) * r * left.volume_slope
                + (3.0 * t2 - 2.0 * t3) / right.density
                + (t3 - t2) * r * right.volume_slope
        };
        let gauss = |x: f64| (-x * x / (h * h)).exp() / (h * std::f64::consts::PI.sqrt());
        let slope = |x: f64| -2.0 * x / (h * h) * gauss(x);
        let (n, width) = (4000, 12.0 * h);
        let mut integral = 0.0;
        for k in 0..n {
            let s = (f64::from(k) + 0.5) * width / f64::from(n) - 0.5 * width;
            let (a, b) = (s + 0.5 * r, s - 0.5 * r);
            // (∂_left − ∂_right) of W(s − x_left) W(s − x_right).
            integral += volume(s).powi(2) * (gauss(a) * slope(b) - slope(a) * gauss(b));
        }
        integral *= width / f64::from(n);
        let kernel = SmoothingKernel::<1>::new(Kernel::Gaussian);
        let closed = Convolution.weight(&left, &right, r, &kernel);
        // The force on the left particle is minus the integral.
        assert!((closed / -integral - 1.0).abs() < 1e-10, "{closed} {integral}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    /// `h = η (m/ρ)^(1/D)` and `ρ = Σ m W(h)` hold together, by the brute-force sum.
    #[test]
    fn smoothing_length_and_density_agree(seed in 1..10_000_u64) {
        let force = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };
        let mut system = disordered::<1>(air(), Boundary::Open, 60, seed, &force, Kernel::QuinticSpline);
        system.update_fields().expect("a physical state");
        let state = &system.particles;
        let kernel = SmoothingKernel::<1>::new(Kernel::QuinticSpline);
        for i in 0..state.len() {
            let h = state.smoothing[i];
            let density: f64 = (0..state.len())
                .map(|j| state.mass[j] * kernel.value((state.position[j][0] - state.position[i][0]).abs(), h))
                .sum();
            prop_assert!((system.density()[i] / density - 1.0).abs() < 1e-13);
            // The tolerance of the iteration, 1e-8, over the slope that Newton divides by.
            prop_assert!((h / (1.2 * state.mass[i] / density) - 1.0).abs() < 1e-7);
        }
    }
}
