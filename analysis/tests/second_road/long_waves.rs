//! The exact series of every file of the catalogue that states its exact step: against the multipliers, and against the literature.

use courant_analysis::exact::rational::ratio;
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{Integrator, KernelLattice, Lines, Step, catalogue};

/// Everything free that the exact step names, and what else has no default.
fn open_step(file: &catalogue::SchemeFile, integrator: Option<&str>) -> Step {
    let lattice =
        file.needs_kernel().then(|| KernelLattice::new(Kernel::CubicSpline, &ratio(2, 1)).unwrap());
    let mut step = match integrator {
        None => Step::from_tree(&file.equations, lattice.as_ref()).unwrap(),
        Some(name) => {
            let lines = Lines::from_tree(&file.equations, lattice.as_ref()).unwrap();
            Step::lines(&lines, Integrator::named(name).unwrap()).unwrap()
        }
    };
    let exact = file.exact.as_deref().unwrap_or_default();
    for (name, value) in &file.parameters {
        if !exact.contains(name.as_str()) {
            step = step.with(name, value).unwrap();
        }
    }
    step
}

/// Values of the free parameters at which nothing vanishes.
fn values(step: &Step) -> Vec<(String, f64)> {
    step.free_parameters().into_iter().zip([0.23, 0.11, 0.07]).collect()
}

/// The series to this power leaves nothing that one sees at this phase.
fn agrees(step: &Step, exact: &str, power: usize, phase: f64, name: &str) {
    let series = step.long_waves(Some(exact), power);
    let series = series.unwrap_or_else(|error| panic!("{name}: {error}"));
    let values = values(step);
    let named: Vec<(&str, f64)> =
        values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let lambda = series.evaluate(&named, phase);
    let compiled = step.compile().unwrap();
    let ordered = |name: &String| values.iter().find(|(known, _)| known == name).unwrap().1;
    let numbers: Vec<f64> = compiled.parameters().iter().map(ordered).collect();
    let multipliers = compiled.multipliers(&numbers, &[phase]);
    let distances = multipliers.iter().map(|z| (z - lambda.exp()).norm());
    let nearest = distances.fold(f64::MAX, f64::min);
    assert!(nearest < 1e-12, "{name}: {nearest:e} from exp({lambda}) in {multipliers:?}");
    // The first error is seen: what stands before it is not enough.
    let parameter = step.free_parameters().first().cloned().unwrap_or_default();
    let first = step.accuracy(Some(exact), &parameter).unwrap().0.power.expect("it is not exact");
    let without = step.long_waves(Some(exact), first - 1).unwrap().evaluate(&named, phase);
    assert!((without - lambda).norm() > 2e-12, "{name}: {without} and {lambda}");
}

#[test]
fn series_of_schemes_are_their_multipliers() {
    for file in catalogue::schemes() {
        let Some(exact) = file.exact.as_deref() else { continue };
        let step = open_step(file, None);
        // Multipliers in f64 are those of one dimension.
        if step.dimension() == 1 {
            agrees(&step, exact, 24, 0.2, &file.name);
        }
    }
}

#[test]
fn series_of_spaces_with_integrators_are_their_multipliers() {
    for (file, integrator) in catalogue::spaces().iter().zip(
        ["rk4", "ab3", "bdf2", "crank-nicolson", "sdirk2", "rk3-ssp", "gauss-2"].iter().cycle(),
    ) {
        let Some(exact) = file.exact.as_deref() else { continue };
        let name = format!("{} with {integrator}", file.name);
        agrees(&open_step(file, Some(integrator)), exact, 24, 0.2, &name);
    }
}

#[test]
fn orders_of_the_literature_are_confirmed() {
    let mut confirmed = 0;
    for file in catalogue::schemes() {
        let Some(known) = &file.known.order else { continue };
        let parameter = file.parameter.as_deref().unwrap();
        let step = open_step(file, None);
        let (found, _) = step.accuracy(file.exact.as_deref(), parameter).unwrap();
        for (known, found) in
            [(known.space, found.space), (known.time, found.time), (known.overall, found.overall)]
        {
            assert!(known.is_none() || known == found, "{}: {found:?}, known {known:?}", file.name);
        }
        confirmed += 1;
    }
    assert!(confirmed >= 20);
}
