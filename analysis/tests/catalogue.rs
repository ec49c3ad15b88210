//! Every file of the catalogue is read and decided, and what the literature says of it is confirmed.

use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{KernelLattice, catalogue};
use courant_analysis::stability::{Evidence, Limit, SearchPlan, StableSet};

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
