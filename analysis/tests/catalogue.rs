//! Every file of the catalogue is read and decided, and what the literature says of it is confirmed.

use courant_analysis::exact::rational::{Rational, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{KernelLattice, catalogue};
use courant_analysis::stability::{Limit, SearchPlan, StableSet};

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
        let start = std::time::Instant::now();
        let set = stable_set(scheme);
        let limit = set.limit();
        let elapsed = start.elapsed();
        let exact = limit
            .exact()
            .map(ToString::to_string)
            .or_else(|| limit.equation().map(|e| e.equation("C")));
        println!(
            "{:28} {:14} {:10} {:?} {} {:?} included {} {} ms",
            scheme.name,
            limit.value(),
            limit.evidence().name(),
            exact,
            set.intervals.len(),
            limit.binding().map(|b| b.name()),
            limit.is_included(),
            elapsed.as_millis()
        );
        if let Some(known) = &scheme.known.stability
            && !agrees(&limit, &known.value)
        {
            wrong.push(format!(
                "{}: {} ({}), known {}",
                scheme.name,
                limit.value(),
                limit.lower(),
                known.value
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
