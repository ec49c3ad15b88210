//! The exact solver against roads that share nothing with it.

use super::{IdealGas, Solution, Star, State, Wave, solve};
use crate::bisection::root;
use proptest::prelude::*;

fn gas(gamma: f64) -> IdealGas {
    IdealGas::new(gamma).expect("the tests use gammas above 1")
}

fn state([density, velocity, pressure]: [f64; 3]) -> State {
    State::new(density, velocity, pressure).expect("the tests use physical states")
}

/// `f_K(p)` by the Rankine–Hugoniot jump of the specific volume and by the Riemann invariant: the
/// same function as the solver's by other formulas.
fn velocity_change(gamma: f64, s: [f64; 3], p: f64) -> f64 {
    let [rho, _, q] = s;
    if p > q {
        let weak = (gamma - 1.0) / (gamma + 1.0);
        // 1/ρ − 1/ρ* = (1 − weak)(p − q) / (ρ (p + weak q))
        ((p - q) * (1.0 - weak) * (p - q) / (rho * (p + weak * q))).sqrt()
    } else {
        let sound = (gamma * q / rho).sqrt();
        2.0 / (gamma - 1.0) * (sound * (p / q).powf((gamma - 1.0) / (2.0 * gamma)) - sound)
    }
}

/// `p*` by nothing but halving the logarithm of the pressure.
fn bisected(gamma: f64, l: [f64; 3], r: [f64; 3]) -> f64 {
    let closing =
        |p: f64| velocity_change(gamma, l, p) + velocity_change(gamma, r, p) + r[1] - l[1];
    root(-700.0, 700.0, |log| closing(log.exp())).exp()
}

/// How much the round-off of the terms of `f` moves its root, relatively.
fn conditioning(gamma: f64, l: [f64; 3], r: [f64; 3], p: f64) -> f64 {
    let magnitude: f64 = [l, r]
        .into_iter()
        .map(|s| {
            let escape = 2.0 / (gamma - 1.0) * (gamma * s[2] / s[0]).sqrt();
            velocity_change(gamma, s, p).abs() + if p < s[2] { escape } else { 0.0 } + s[1].abs()
        })
        .sum();
    let f = |p: f64| velocity_change(gamma, l, p) + velocity_change(gamma, r, p);
    let logarithmic_slope = (f(p * 1.0001) - f(p * 0.9999)) / 0.0002;
    magnitude / logarithmic_slope
}

/// Name, left and right `[ρ, v, p]`, and `[p*, v*, ρ*_L, ρ*_R]`.
type Reference = (&'static str, [f64; 3], [f64; 3], [f64; 4]);

/// Computed with 40 digits by bisection of the Hugoniot and isentrope in their textbook form.
const REFERENCE: [Reference; 9] = [
    (
        "Ferrari 1",
        [1.0, 0.75, 1.0],
        [0.125, 0.0, 0.1],
        [0.4662935668398556, 1.3609055190925576, 0.5798666874803241, 0.3397002349019074],
    ),
    (
        "Ferrari 2, Toro 2",
        [1.0, -2.0, 0.4],
        [1.0, 2.0, 0.4],
        [0.001893873420054763, 0.0, 0.02185211820681283, 0.02185211820681283],
    ),
    (
        "Ferrari 3, Toro 3",
        [1.0, 0.0, 1000.0],
        [1.0, 0.0, 0.01],
        [460.89378749138353, 19.59745138872305, 0.5750622984765554, 5.999240704796234],
    ),
    (
        "Ferrari 4, Toro 5",
        [5.99924, 19.5975, 460.894],
        [5.99242, -6.19633, 46.095],
        [1691.646955399126, 8.689774411632381, 14.282349951978402, 31.042601641619875],
    ),
    (
        "Sod",
        [1.0, 0.0, 1.0],
        [0.125, 0.0, 0.1],
        [0.30313017805064685, 0.9274526200489499, 0.4263194281784952, 0.2655737117053071],
    ),
    (
        "Toro 4",
        [1.0, 0.0, 0.01],
        [1.0, 0.0, 100.0],
        [46.095044248867964, -6.196328249787036, 5.992416863515225, 0.5751127897824123],
    ),
    (
        "Cha & Whitworth 5.3",
        [1.0, 0.0, 3000.0],
        [1.0, 0.0, 1e-7],
        [1382.6624768654235, 33.94434754919633, 0.575056688040894, 5.9999999974686515],
    ),
    (
        "ratio 1e12",
        [1.0, 0.0, 1e12],
        [1.0, 0.0, 1.0],
        [460887492268.1199, 619736.161783083, 0.5750566880227536, 5.99999999992406],
    ),
    (
        "tiny jump",
        [1.0, 0.0, 1.0],
        [1.0, 0.0, 1.000000000001],
        [1.0000000000005, -4.2257712736415263e-13, 1.000000000000357, 0.9999999999996428],
    ),
];

#[test]
fn star_states_agree_with_forty_digits() {
    for (name, l, r, [p, v, left, right]) in REFERENCE {
        let solution = solve(gas(1.4), &state(l), &state(r));
        let (rho_left, rho_right) = solution.densities();
        let speed = (1.4 * l[2] / l[0]).sqrt().max((1.4 * r[2] / r[0]).sqrt());
        for (what, value, wanted, scale) in [
            ("p*", solution.pressure(), p, p),
            ("v*", solution.velocity(), v, v.abs().max(speed)),
            ("left density", rho_left, left, left),
            ("right density", rho_right, right, right),
        ] {
            // 1e-12 is asked for; the round-off of f is amplified by 1/z (p_K/p)^z ≤ 400 at most.
            assert!((value - wanted).abs() <= 1e-12 * scale, "{name}: {what} {value} {wanted}");
        }
        assert!(solution.iterations() <= 12, "{name}: {} iterations", solution.iterations());
    }
}

#[test]
fn a_tiny_jump_keeps_its_own_digits() {
    // The velocity of a jump of 1e-12 is 4e-13: it must not drown in the round-off of 1 + 1e-12,
    // so what is wanted is the answer for the pressure that the literal really is.
    let right = 1.000000000001f64;
    let solution = solve(gas(1.4), &state([1.0, 0.0, 1.0]), &state([1.0, 0.0, right]));
    let wanted = -(right - 1.0) / (2.0 * 1.4f64.sqrt());
    // One unit in the last place of p* is worth 2e-16/ρc.
    assert!((solution.velocity() - wanted).abs() < 4e-16, "{}", solution.velocity());
}

#[test]
fn equal_states_are_returned_untouched() {
    let here = state([0.3, -7.25, 1.9]);
    let solution = solve(gas(5.0 / 3.0), &here, &here);
    assert_eq!(solution.iterations(), 0);
    assert_eq!((solution.pressure(), solution.velocity()), (1.9, -7.25));
    assert_eq!(solution.densities(), (0.3, 0.3));
    for ray in [-10.0, -7.25, 0.0, 10.0] {
        assert_eq!(solution.sample(ray), here);
    }
    assert_eq!((solution.left_wave(), solution.right_wave()), (Wave::Absent, Wave::Absent));
}

#[test]
fn vacuum_opens_exactly_at_the_escape_speed() {
    // γ = 2, ρ = 2, p = 1: c = 1 and the escape speed is 2, all exact in binary.
    let gas = gas(2.0);
    let at = |opening: f64| solve(gas, &state([2.0, 0.0, 1.0]), &state([2.0, opening, 1.0]));
    assert_eq!(at(4.0).star(), Star::Vacuum { left_front: 2.0, right_front: 2.0 });
    let below = at(4.0f64.next_down());
    assert!(matches!(below.star(), Star::Contact { pressure, .. } if pressure > 0.0));
    // p* = p (room/2c)^(1/z), 1/z = 4, room = (4 − opening)/2, 2c = 2.
    let room = (4.0 - 4.0f64.next_down()) / 4.0;
    assert!((below.pressure() / room.powi(4) - 1.0).abs() < 1e-12);
    let above = at(6.0);
    assert_eq!(above.star(), Star::Vacuum { left_front: 2.0, right_front: 4.0 });
    assert_eq!((above.pressure(), above.velocity()), (0.0, 3.0));
    assert!(above.sample(3.0).is_vacuum());
    assert_eq!(above.left_wave(), Wave::Rarefaction { head: -1.0, tail: 2.0 });
    assert_eq!(above.right_wave(), Wave::Rarefaction { head: 7.0, tail: 4.0 });
}

#[test]
fn vacuum_by_initial_data() {
    let nothing = state([0.0, 0.0, 0.0]);
    let here = state([2.0, 0.5, 1.0]);
    let solution = solve(gas(2.0), &here, &nothing);
    assert_eq!(solution.star(), Star::Vacuum { left_front: 2.5, right_front: f64::INFINITY });
    assert_eq!(solution.velocity(), 2.5);
    assert!(solution.sample(2.5).is_vacuum() && solution.sample(100.0).is_vacuum());
    assert_eq!(solution.sample(-0.5), here);
    let mirrored = solve(gas(2.0), &nothing, &state([2.0, -0.5, 1.0]));
    assert_eq!(mirrored.velocity(), -2.5);
    for ray in [-0.4, 0.0, 1.0, 2.4] {
        let (a, b) = (solution.sample(ray), mirrored.sample(-ray));
        assert_eq!(
            (a.density(), a.velocity(), a.pressure()),
            (b.density(), -b.velocity(), b.pressure())
        );
        // Inside the fan both invariants hold: v + 2c/(γ−1) is the front, v − c the ray.
        let sound = gas(2.0).sound_speed(a.density(), a.pressure());
        assert!((a.velocity() + 2.0 * sound - 2.5).abs() < 1e-14);
        assert!((a.velocity() - sound - ray).abs() < 1e-14);
    }
    let none = solve(gas(2.0), &nothing, &nothing);
    assert!(none.sample(0.3).is_vacuum());
    assert_eq!(none.pressure(), 0.0);
}

#[test]
fn cold_gases() {
    // Noh's problem: no pressure, both shocks infinitely strong; p* = (γ+1)/2 ρ v² by the jump
    // conditions with density ratio (γ+1)/(γ−1).
    let noh = solve(gas(5.0 / 3.0), &state([1.0, 1.0, 0.0]), &state([1.0, -1.0, 0.0]));
    assert!((noh.pressure() - 4.0 / 3.0).abs() < 1e-14);
    assert!((noh.densities().0 - 4.0).abs() < 1e-13);
    assert_eq!(noh.velocity(), 0.0);
    // A cold gas that parts leaves a vacuum at once; at rest it stays.
    let parting = solve(gas(1.4), &state([1.0, -1.0, 0.0]), &state([1.0, 1.0, 0.0]));
    assert_eq!(parting.star(), Star::Vacuum { left_front: -1.0, right_front: 1.0 });
    let rest = solve(gas(1.4), &state([1.0, 0.5, 0.0]), &state([3.0, 0.5, 0.0]));
    assert_eq!(rest.star(), Star::Contact { pressure: 0.0, velocity: 0.5 });
    // A hot gas drives a shock into a cold one.
    let hot = solve(gas(1.4), &state([1.0, 0.0, 1.0]), &state([1.0, 0.0, 0.0]));
    let wanted = bisected(1.4, [1.0, 0.0, 1.0], [1.0, 0.0, 1e-300]);
    assert!((hot.pressure() - wanted).abs() < 1e-12 * wanted);
}

#[test]
fn non_physical_input_is_an_error() {
    for (numbers, part) in [
        ([f64::NAN, 0.0, 1.0], "density = NaN"),
        ([-1.0, 0.0, 1.0], "density = -1"),
        ([1.0, f64::INFINITY, 1.0], "velocity = inf"),
        ([1.0, 0.0, -0.1], "pressure = -0.1"),
        ([0.0, 0.0, 1.0], "vacuum has no pressure"),
    ] {
        let error = State::new(numbers[0], numbers[1], numbers[2]).expect_err("not physical");
        assert!(error.to_string().contains(part), "{error}");
    }
    for gamma in [1.0, 0.5, f64::NAN, f64::INFINITY] {
        assert!(IdealGas::new(gamma).is_err());
    }
}

/// Mass, momentum and energy must balance across any pair of rays: `d/dt ∫ U dx` over `[a t, b t]`
/// equals `F − ray·U` at `a` minus the same at `b`. Sampled on a fine grid this checks the whole
/// self-similar solution without any formula of it.
#[test]
fn the_sampled_solution_satisfies_the_integral_laws() {
    for (name, l, r, _) in &REFERENCE[..6] {
        let solution = solve(gas(1.4), &state(*l), &state(*r));
        let reach = 1.1 * solution.max_wave_speed();
        let n = 400_000;
        let width = 2.0 * reach / f64::from(n);
        let mut integral = [0.0; 3];
        for i in 0..n {
            let u = conserved(&solution, -reach + (f64::from(i) + 0.5) * width);
            for (sum, part) in integral.iter_mut().zip(u) {
                *sum += part * width;
            }
        }
        let outer = |s: &[f64; 3], ray: f64| {
            let [rho, v, p] = *s;
            let energy = p / 0.4 + 0.5 * rho * v * v;
            let u = [rho, rho * v, energy];
            let f = [rho * v, rho * v * v + p, v * (energy + p)];
            [0, 1, 2].map(|k| f[k] - ray * u[k])
        };
        let (a, b) = (outer(l, -reach), outer(r, reach));
        for k in 0..3 {
            let scale = a[k].abs().max(b[k].abs());
            // The midpoint rule is off by at most half a cell times the jump at each discontinuity.
            assert!((integral[k] - (a[k] - b[k])).abs() < 3e-5 * scale, "{name} {k}");
        }
    }
}

fn conserved(solution: &Solution, ray: f64) -> [f64; 3] {
    let s = solution.sample(ray);
    let (rho, v) = (s.density(), s.velocity());
    [rho, rho * v, s.pressure() / 0.4 + 0.5 * rho * v * v]
}

fn wide_state() -> impl Strategy<Value = [f64; 3]> {
    // Densities over 8 decades, pressures over 12, speeds up to Mach 100 either way.
    (-4.0..4.0f64, -6.0..6.0f64, -2.0..2.0f64, any::<bool>(), any::<bool>()).prop_map(
        |(density, pressure, mach, forward, moving)| {
            let (rho, p) = (10f64.powf(density), 10f64.powf(pressure));
            let sign = if forward { 1.0 } else { -1.0 };
            let speed = if moving { sign * 10f64.powf(mach) * (p / rho).sqrt() } else { 0.0 };
            [rho, speed, p]
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100_000))]

    #[test]
    fn any_admissible_pair_has_its_star_state(
        l in wide_state(), r in wide_state(), gamma in 1.05..3.0f64,
    ) {
        let gas = gas(gamma);
        let solution = solve(gas, &state(l), &state(r));
        let escape = |s: [f64; 3]| 2.0 * gas.sound_speed(s[0], s[2]) / (gamma - 1.0);
        let opening = r[1] - l[1];
        match solution.star() {
            Star::Vacuum { left_front, right_front } => {
                prop_assert!(opening >= escape(l) + escape(r));
                prop_assert_eq!((left_front, right_front), (l[1] + escape(l), r[1] - escape(r)));
            }
            Star::Contact { pressure, velocity } => {
                prop_assert!(opening < escape(l) + escape(r));
                prop_assert!(solution.iterations() <= 30, "{} iterations", solution.iterations());
                let wanted = bisected(gamma, l, r);
                let amplification = conditioning(gamma, l, r, wanted);
                // The error of the bisection is the round-off of its own f, a dozen operations, amplified.
                let tolerance = 1e-12 + 16.0 * f64::EPSILON * amplification;
                prop_assert!(
                    (pressure / wanted - 1.0).abs() <= tolerance,
                    "{pressure} {wanted} {tolerance}"
                );
                let speed = l[1].abs().max(r[1].abs()).max(escape(l)).max(escape(r));
                let other = l[1] - velocity_change(gamma, l, pressure);
                prop_assert!((velocity - other).abs() <= 1e-12 * speed);
            }
        }
    }

    #[test]
    fn a_mirror_exchanges_left_and_right(l in wide_state(), r in wide_state(), ray in -3.0..3.0f64) {
        let flip = |s: [f64; 3]| state([s[0], -s[1], s[2]]);
        let solution = solve(gas(1.4), &state(l), &state(r));
        let mirrored = solve(gas(1.4), &flip(r), &flip(l));
        prop_assert_eq!(solution.pressure(), mirrored.pressure());
        let speed = l[1].abs().max(r[1].abs()).max(solution.max_wave_speed());
        prop_assert!((solution.velocity() + mirrored.velocity()).abs() <= 1e-14 * speed);
        let ray = ray * solution.max_wave_speed();
        let (a, b) = (solution.sample(ray), mirrored.sample(-ray));
        prop_assert!(a.density() >= 0.0 && a.pressure() >= 0.0 && a.velocity().is_finite());
        prop_assert!((a.density() - b.density()).abs() <= 1e-10 * a.density() || ray == 0.0);
    }

    #[test]
    fn tiny_jumps_are_acoustic(dp in -1e-7..1e-7f64, dv in -1e-7..1e-7f64, drho in -1e-7..1e-7f64) {
        let solution =
            solve(gas(1.4), &state([1.0, 0.0, 1.0]), &state([1.0 + drho, dv, 1.0 + dp]));
        let impedance = 1.4f64.sqrt();
        // Linear theory; its error is second order, 1e-14 times a constant of order one.
        prop_assert!((solution.pressure() - (1.0 + 0.5 * dp - 0.5 * impedance * dv)).abs() < 1e-13);
        prop_assert!((solution.velocity() - (0.5 * dv - 0.5 * dp / impedance)).abs() < 1e-13);
    }
}
