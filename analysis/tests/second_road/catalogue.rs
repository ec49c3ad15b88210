//! Every file of the catalogue is read and decided, and what the literature says of it is confirmed.

use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{KernelLattice, Step, catalogue};
use courant_analysis::stability::{Evidence, Limit, SearchPlan, StableSet};
use num_complex::Complex64;

fn stable_set(scheme: &catalogue::SchemeFile) -> StableSet {
    let two = Rational::from_integer(2.into());
    let lattice =
        scheme.needs_kernel().then(|| KernelLattice::new(Kernel::CubicSpline, &two).unwrap());
    let parameter = scheme.parameter.as_deref().expect("a scheme says whose limit is sought");
    let step = scheme.step(lattice.as_ref(), None, &[], Some(parameter));
    let step = step.unwrap_or_else(|error| panic!("{}: {error}", scheme.name));
    step.stable_set(parameter, &SearchPlan::default())
        .unwrap_or_else(|error| panic!("{}: {error}", scheme.name))
}

/// A value of the literature: exact, or with the digits that stand there.
fn agrees(limit: &Limit, known: &str) -> bool {
    if known == "unbounded" {
        return limit.is_unbounded();
    }
    if let Some(exact) = catalogue::exact_number(known) {
        let digits = known.split('.').nth(1).map_or(0, str::len);
        if digits < 5 {
            let value = to_f64(&exact);
            return limit.lower() <= value
                && value <= limit.upper()
                && limit.exact().is_none_or(|e| e.as_fraction() == Some(&exact));
        }
        return (limit.value() - to_f64(&exact)).abs() <= 10f64.powi(-(digits as i32));
    }
    let value = catalogue::approximate(known).expect("a value or an expression");
    limit.lower() <= value * (1.0 + 1e-15) && value * (1.0 - 1e-15) <= limit.upper()
}

#[test]
fn the_literature_is_confirmed() {
    let mut wrong = Vec::new();
    for scheme in catalogue::schemes() {
        let set = stable_set(scheme);
        let limit = set.limit();
        if set.evidence != Evidence::Proved || !set.undecided.is_empty() {
            wrong.push(format!(
                "{}: {:?}, undecided {:?}",
                scheme.name, set.evidence, set.undecided
            ));
        }
        if let Some(known) = &scheme.known.stability
            && !agrees(&limit, &known.value)
        {
            let (value, known) = (limit.value(), &known.value);
            wrong.push(format!("{}: {value}, known {known}", scheme.name));
        }
        if let Some(known) = &scheme.known.stable_set {
            let as_known = known.intervals.len() == set.intervals.len()
                && known.intervals.iter().zip(&set.intervals).all(|([from, to], found)| {
                    let to_end = if to == "inf" { "unbounded" } else { to.as_str() };
                    agrees(&found.from, from) && agrees(&found.to, to_end)
                });
            if !as_known {
                wrong.push(format!("{}: {:?}", scheme.name, set.intervals));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_stable_at_the_limit_itself() {
    let included = |name: &str| stable_set(catalogue::scheme(name).unwrap()).limit().is_included();
    // Two multipliers meet on the circle with one eigenvector: linear growth.
    for name in ["leapfrog", "wave-2", "staggered-acoustics-2", "forward-backward"] {
        assert!(!included(name), "{name}");
    }
    for name in ["upwind", "lax-wendroff", "heat-ftcs", "acoustics-godunov"] {
        assert!(included(name), "{name}");
    }
}

#[test]
fn a_work_budget_spent_is_said() {
    // With one box nothing but a limit of zero can be decided, and nothing may be called stable.
    let plan = SearchPlan { budget: 1, ..SearchPlan::default() };
    let mut undecided = 0;
    for scheme in catalogue::schemes() {
        let two = Rational::from_integer(2.into());
        let lattice =
            scheme.needs_kernel().then(|| KernelLattice::new(Kernel::CubicSpline, &two).unwrap());
        let parameter = scheme.parameter.as_deref().unwrap();
        let step = scheme.step(lattice.as_ref(), None, &[], Some(parameter)).unwrap();
        let full = step.stable_set(parameter, &SearchPlan::default()).unwrap();
        let limit = step.stable_set(parameter, &plan).unwrap().limit();
        let proved = full.limit();
        assert!(
            limit.lower() <= proved.lower() || limit.is_unbounded() == proved.is_unbounded(),
            "{}",
            scheme.name
        );
        undecided += usize::from(limit.evidence() == Evidence::Undecided);
        let same = limit.evidence() == proved.evidence() && limit.upper() == proved.upper();
        assert!(same || limit.evidence() == Evidence::Undecided, "{}: {limit:?}", scheme.name);
    }
    assert!(undecided > 5, "{undecided}: the budget has no effect");
}

#[test]
fn the_lagrangian_system_falls_apart_into_sounds_of_either_direction() {
    for (kernel, ratio) in [(Kernel::CubicSpline, (2, 1)), (Kernel::Gaussian, (3, 2))] {
        let ratio = Rational::new(ratio.0.into(), ratio.1.into());
        let of = |name: &str| catalogue::scheme(name).unwrap().with_kernel(kernel, &ratio).unwrap();
        let one_step = of("godunov-sph").one_step("C").unwrap();
        let system = of("lagrangian-sound").compile().unwrap();
        for (index, courant) in (1..=24).flat_map(|index| [(index, 0.4), (index, 1.7)]) {
            let phase = std::f64::consts::TAU * f64::from(index) / 48.0;
            let found = system.multipliers(&[courant], &[phase]);
            let g = one_step.gain(courant, phase);
            let apart =
                |a: Complex64, b: Complex64| (found[0] - a).norm().max((found[1] - b).norm());
            assert_eq!(found.len(), 2);
            // A dozen terms below 2; where both meet, the root of their roundings.
            let bound = 1e-14 / g.im.abs().max(1e-8) + 1e-13;
            let nearest = apart(g, g.conj()).min(apart(g.conj(), g));
            assert!(nearest < bound, "{kernel} {courant} {phase}: {found:?} {g}");
        }
    }
}

#[test]
fn a_contact_viscosity_above_the_sound_speed_takes_over() {
    use courant_analysis::exact::rational::{parse, ratio};
    let lattice = KernelLattice::new(Kernel::CubicSpline, &ratio(2, 1)).unwrap();
    let of = |viscosity: &str| {
        let values = [("viscosity".to_string(), parse(viscosity).unwrap())];
        let contact = catalogue::scheme("lagrangian-contact").unwrap();
        contact.step(Some(&lattice), None, &values, Some("C")).unwrap()
    };
    for (viscosity, stable) in [("1/2", false), ("1", false), ("2", true)] {
        // Sound is stable up to 15/8.
        assert_eq!(of(viscosity).limit("C").unwrap().upper() < 1.875, stable, "{viscosity}");
    }
    // Positive while 2 C viscosity Σ w ≤ 1, with 2 Σ w = 5/8.
    let monotone = of("2").monotone_set("C", &SearchPlan::default()).unwrap();
    assert_eq!(monotone.unwrap().limit().exact().unwrap().to_string(), "4/5");
    // Without viscosity the contact is kept at any step.
    assert!(of("0").free_parameters().is_empty());
}

#[test]
fn zero_is_a_stable_value_only_where_the_scheme_is_stable_there() {
    let set = |text: &str| {
        Step::from_text(text).unwrap().stable_set("C", &SearchPlan::default()).unwrap()
    };
    // At C = 0 the factor is 2 - e^(-i phi) or more: |g| = 4 for the shortest wave.
    let grows = set("u[n+1,j] = (C - 2)*(u[n,j] - u[n,j-1])");
    assert!(!grows.at_zero && grows.intervals[0].from.value() == 1.5, "{grows:?}");
    // Nothing can be solved there.
    assert!(!set("C*u[n+1,j] = u[n,j]").at_zero);
    // The identity is stable, and the only stable value.
    let downwind = set("u[n+1,j] = u[n,j] - C*(u[n,j+1] - u[n,j])");
    assert!(downwind.at_zero && downwind.intervals.is_empty());
}
