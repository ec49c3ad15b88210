use super::*;
use crate::exact::rational::ratio;
use crate::kernel::Kernel;
use crate::stability::verdict::Verdict;
use crate::waves::dispersion::method::{Form, WaveMethod};

fn scheme(method: WaveMethod, kernel: Kernel, h: Rational) -> WaveScheme {
    WaveScheme::new(method, kernel, &h).unwrap()
}

fn viscous() -> WaveMethod {
    WaveMethod::SphAv { alpha: integer(1) }
}

fn gph() -> WaveMethod {
    WaveMethod::Gph { form: Form::Resolved }
}

/// The largest `|z| − 1` on a grid of phases, from the matrix of the step and the quadratic formula of
/// school: shares nothing with the proof but the mode and the step.
fn plain_growth(scheme: &WaveScheme, integrator: Integrator, step: f64, cells: u32) -> f64 {
    let waves = scheme.compile();
    let dt = step * waves.ratio();
    (1..=cells)
        .map(|index| {
            let mode = waves.mode(f64::from(index) * std::f64::consts::PI / f64::from(cells));
            let [[a, b], [c, d]] =
                integrator.matrix(&(-mode.restoring * dt * dt), &(-mode.damping * dt));
            let (half, determinant) = (0.5 * (a + d), a * d - b * c);
            let square = half * half - determinant;
            if square < 0.0 { determinant.sqrt() } else { half.abs() + square.sqrt() }
        })
        .fold(0.0, f64::max)
        - 1.0
}

#[test]
fn limits_separate_stable_from_unstable_steps() {
    for kernel in [Kernel::CubicSpline, Kernel::WendlandC2, Kernel::Gaussian] {
        for (method, h) in [(viscous(), ratio(6, 5)), (gph(), ratio(1, 1))] {
            let scheme = scheme(method, kernel, h);
            for integrator in [
                Integrator::ForwardEuler,
                Integrator::SymplecticEuler,
                Integrator::LeapfrogKdkPredicted,
                Integrator::Rk2Heun,
                Integrator::Rk3Ssp,
            ] {
                let step = stable_step(&scheme, integrator, &integer(8)).unwrap();
                let limit = step.limit();
                assert!(step.undecided().is_empty() && limit.is_positive());
                let exact = kernel != Kernel::Gaussian;
                let evidence = if exact { Evidence::Proved } else { Evidence::Enclosed };
                assert_eq!(limit.evidence(), evidence);
                assert!(limit.upper() - limit.lower() <= 1e-6 * limit.upper(), "{limit:?}");
                // A multiplier at most one: rounding of a few operations on numbers of size ten.
                let below = plain_growth(&scheme, integrator, limit.lower() * (1.0 - 1e-9), 1000);
                assert!(below < 1e-13, "{kernel} {integrator} {below}");
                let above = plain_growth(&scheme, integrator, limit.upper() * 1.001, 1000);
                assert!(above > 1e-7, "{kernel} {integrator} {above}");
            }
        }
    }
}

#[test]
fn closed_forms_at_one_neighbour() {
    // Cubic spline, h = Δ: ω0² = 8s − 4s(1 − s), b = 2s; the shortest wave, ω0² = 8 and b = 2, binds.
    let expect = |method: WaveMethod, integrator, text: &str| {
        let scheme = scheme(method, Kernel::CubicSpline, integer(1));
        let step = stable_step(&scheme, integrator, &integer(8)).unwrap();
        assert_eq!(step.limit().exact().unwrap().to_string(), text, "{integrator}");
        assert_eq!(step.limit().evidence(), Evidence::Proved);
        assert_eq!(step.limit().critical_phase(), Some(std::f64::consts::PI));
        step
    };
    use Integrator::{ForwardEuler, LeapfrogKdk, PredictorCorrector, Rk3Ssp, Rk4, SymplecticEuler};
    // ωΔt ≤ 2, √3 and 2√2.
    for integrator in [SymplecticEuler, LeapfrogKdk, PredictorCorrector] {
        let step = expect(WaveMethod::Sph, integrator, "sqrt(1/2)");
        assert_eq!(
            (step.binding(), step.end()),
            (Some(Binding::MinusOne), StepEnd::DoubleMultiplier)
        );
    }
    let rk3 = expect(WaveMethod::Sph, Rk3Ssp, "sqrt(3/8)");
    assert_eq!((rk3.binding(), rk3.end()), (Some(Binding::Oscillation), StepEnd::Included));
    expect(WaveMethod::Sph, Rk4, "1");
    // |z|² = 1 − bΔt + ω0²Δt².
    expect(gph(), ForwardEuler, "1/4");
    // ω0²Δt² + 2bΔt ≤ 4: 8t² + 4t = 4.
    let euler = expect(gph(), SymplecticEuler, "1/2");
    assert_eq!((euler.binding(), euler.end()), (Some(Binding::MinusOne), StepEnd::Included));
    assert_eq!(euler.per_spacing(), 0.5);
    let deviation = Kernel::CubicSpline.standard_deviation();
    assert!((euler.per_standard_deviation() - 0.5 / deviation).abs() < 1e-15);
}

#[test]
fn the_shortest_wave_of_the_cubic_spline_is_free_between_three_and_five_halves() {
    // W''(1/h) + W''(3/h) = 0 as long as 1/h and 3/h lie on the inner and the outer piece.
    for (a, b, free) in [
        (149, 100, false),
        (3, 2, true),
        (17, 10, true),
        (2, 1, true),
        (9, 4, true),
        (5, 2, true),
        (251, 100, false),
    ] {
        let scheme = scheme(WaveMethod::Sph, Kernel::CubicSpline, ratio(a, b));
        let mode = scheme.compile().mode(std::f64::consts::PI);
        assert_eq!(mode.restoring == 0.0, free, "{a}/{b}");
        assert_eq!(scheme.restoring().center().at_pi().is_zero(), free);
        if free {
            // Two multipliers 1, one eigenvector: it drifts, and nothing else is unstable.
            let multipliers = mode.multipliers(Integrator::LeapfrogKdk, 0.3);
            assert!(multipliers.is_double_on_circle());
            let step = stable_step(&scheme, Integrator::LeapfrogKdk, &integer(8)).unwrap();
            assert!(step.limit().lower() > 0.5);
            let growth = worst_growth(&scheme.compile(), Integrator::LeapfrogKdk, 0.3);
            assert_eq!(growth.verdict(), Verdict::Stable);
        }
    }
}

#[test]
fn tension_is_unstable_at_every_step() {
    for method in [WaveMethod::Sph, viscous(), gph()] {
        let scheme = scheme(method, Kernel::CubicSpline, ratio(6, 5)).with_pressure(ratio(-1, 2));
        let step = stable_step(&scheme, Integrator::LeapfrogKdk, &integer(8)).unwrap();
        assert_eq!((step.limit().value(), step.binding()), (0.0, Some(Binding::Lattice)));
        let phase = step.limit().critical_phase().unwrap();
        assert!(scheme.compile().mode(phase).frequencies().growth_rate() > 0.1);
        // Slow enough growth is still a question with an answer: t ≈ growth / rate.
        let budget =
            stable_step_within(&scheme, Integrator::LeapfrogKdk, &ratio(1, 1000), &integer(8));
        let limit = budget.unwrap().limit().clone();
        let growth = worst_growth(&scheme.compile(), Integrator::LeapfrogKdk, limit.value());
        assert!((growth.per_step - 1e-3).abs() < 1e-9, "{growth:?}");
    }
}

#[test]
fn weak_instabilities_have_a_rate_and_a_budget() {
    let scheme = scheme(WaveMethod::Sph, Kernel::CubicSpline, integer(1));
    let waves = scheme.compile();
    for integrator in [Integrator::Rk2Midpoint, Integrator::Rk2Heun, Integrator::ForwardEuler] {
        let strict = stable_step(&scheme, integrator, &integer(8)).unwrap();
        assert_eq!((strict.limit().value(), strict.binding()), (0.0, Some(Binding::Oscillation)));
        // The shortest wave has the largest frequency here.
        assert_eq!(strict.limit().critical_phase(), Some(std::f64::consts::PI));
        for exponent in [9, 6, 5] {
            let growth = ratio(1, 10i64.pow(exponent));
            let within = stable_step_within(&scheme, integrator, &growth, &integer(8)).unwrap();
            let (y, r) = (1.0 + to_f64(&growth), within.limit().value() * 8f64.sqrt());
            // |z|² = 1 + (ωΔt)⁴/4, or 1 + (ωΔt)² for Euler.
            let expected = match integrator {
                Integrator::ForwardEuler => (y * y - 1.0).sqrt(),
                _ => (4.0 * (y * y - 1.0)).powf(0.25),
            };
            assert!((r / expected - 1.0).abs() < 1e-6, "{integrator} {exponent}");
            let worst = worst_growth(&waves, integrator, within.limit().value());
            assert!((worst.per_step / to_f64(&growth) - 1.0).abs() < 1e-6);
            assert_eq!(worst.verdict(), Verdict::WeaklyUnstable);
            let doubling = worst.steps_to_double().unwrap();
            assert!((doubling * to_f64(&growth) / 2f64.ln() - 1.0).abs() < 1e-2);
        }
    }
}

#[test]
fn verdicts_at_and_around_a_limit() {
    let waves = scheme(WaveMethod::Sph, Kernel::CubicSpline, integer(1)).compile();
    let verdict = |t: f64| worst_growth(&waves, Integrator::LeapfrogKdk, t).verdict();
    assert_eq!(verdict(0.7), Verdict::Stable);
    assert_eq!(verdict(0.5f64.sqrt()), Verdict::Marginal);
    assert_eq!(verdict(0.71), Verdict::Unstable);
    let published =
        scheme(WaveMethod::Gph { form: Form::Published }, Kernel::CubicSpline, integer(1));
    let refused = stable_step(&published, Integrator::Rk4, &integer(8));
    assert_eq!(refused.unwrap_err(), NoSchemeRuns);
}

#[test]
fn no_neighbours_no_limit() {
    let alone = scheme(WaveMethod::Sph, Kernel::CubicSpline, ratio(1, 4));
    let step = stable_step(&alone, Integrator::Rk4, &integer(8)).unwrap();
    assert!(step.limit().value().is_infinite() && step.binding().is_none());
}

#[test]
fn some_lattices_are_unstable_without_any_tension() {
    // The paper calls SPH stable because ω_SPH² is positive for all κ and h. That is so for the kernel
    // it uses. The transform of the quartic spline, an odd power of the sine cardinal, takes negative
    // values, and the cut of the Gaussian makes its second derivative a poor one.
    let is_stable = |kernel, l: Rational| {
        let scheme = scheme(WaveMethod::Sph, kernel, l);
        match lattice_sign(&scheme.restoring()) {
            Sign::NowhereNegative => true,
            Sign::SomewhereNegative { .. } => false,
            Sign::Undecided => panic!("{kernel} is undecided"),
        }
    };
    for l in [ratio(1, 1), ratio(6, 5), ratio(3, 2), ratio(2, 1), ratio(27, 10), ratio(4, 1)] {
        for kernel in [Kernel::CubicSpline, Kernel::QuinticSpline, Kernel::WendlandC2] {
            assert!(is_stable(kernel, l.clone()), "{kernel} {l}");
        }
        for kernel in [Kernel::QuarticSpline, Kernel::Gaussian] {
            assert_eq!(is_stable(kernel, l.clone()), l <= integer(2), "{kernel} {l}");
        }
    }
    let quartic = scheme(WaveMethod::Sph, Kernel::QuarticSpline, integer(3));
    let step = stable_step(&quartic, Integrator::Rk4, &integer(8)).unwrap();
    assert_eq!((step.limit().value(), step.binding()), (0.0, Some(Binding::Lattice)));
    let growth = worst_growth(&quartic.compile(), Integrator::Rk4, 1e-4);
    assert_eq!(growth.verdict(), Verdict::WeaklyUnstable);
}

#[test]
fn proofs_take_few_boxes() {
    // Counts, not seconds: at most 190 boxes today. A search that loses its way takes thousands.
    for h in [ratio(1, 1), ratio(6, 5), ratio(2, 1)] {
        let scheme = scheme(gph(), Kernel::CubicSpline, h);
        for integrator in Integrator::ALL {
            let work = stable_step(&scheme, integrator, &integer(8)).unwrap().work();
            assert!(work.boxes <= 300 && work.evaluations <= 20, "{integrator} {work:?}");
        }
    }
}
