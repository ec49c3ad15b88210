//! Every subject by two roads: multipliers of the characteristic polynomial against the equations as they run.

mod noise;
mod subject;
mod torus;

use courant_analysis::exact::rational::{ratio, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::{self, SchemeFile};
use courant_analysis::scheme::{
    Coefficient, Integrator, IntegratorForm, KernelLattice, Nystrom, SchemeError,
};
use courant_simulation::stepping::{PerAxis, SteppingError, TorusScheme, ValidationPlan, validate};
use noise::grows;
use subject::{Subject, agrees, quick, sees_every_change};

#[test]
fn every_scheme_of_the_catalogue_runs_as_predicted() {
    for file in catalogue::schemes() {
        // Below and above most limits.
        for sought in [ratio(2, 7), ratio(9, 8)] {
            let mut subject = Subject::new(file, sought);
            if file.needs_kernel() {
                subject = subject.with_kernel(Kernel::QuinticSpline, ratio(3, 2));
            }
            let dimension = subject.running().unwrap().dimension();
            agrees(
                &subject,
                &ValidationPlan { steps: 40, ..ValidationPlan::in_dimension(dimension) },
            );
        }
    }
}

#[test]
fn every_integrator_runs_every_space_as_predicted() {
    let plan = ValidationPlan { points: vec![16], steps: 20 };
    for file in catalogue::spaces() {
        for integrator in catalogue::integrators() {
            let subject = Subject::new(file, ratio(3, 7)).with_integrator(integrator);
            match subject.predicted() {
                Ok(_) => agrees(&subject, &plan),
                // Who is served is one answer by both roads.
                Err(SchemeError::Integrator(_)) => {
                    assert_eq!(subject.running().err(), Some(SteppingError::NoPositions));
                }
                Err(other) => panic!("{}: {other}", subject.name),
            }
        }
    }
}

#[test]
fn particle_methods_run_as_predicted_with_every_integrator() {
    let plan = ValidationPlan { points: vec![16], steps: 20 };
    for file in catalogue::methods() {
        let agrees_with = |kernel, integrator| {
            let subject = Subject::new(file, ratio(1, 3)).with_kernel(kernel, ratio(6, 5));
            agrees(&subject.with_integrator(integrator), &plan);
        };
        for integrator in catalogue::integrators() {
            agrees_with(Kernel::CubicSpline, integrator);
        }
        // An integrator meets the kernel only in the forces.
        for kernel in [Kernel::WendlandC4, Kernel::Gaussian] {
            agrees_with(kernel, Integrator::named("rk4").unwrap());
        }
    }
}

#[test]
fn a_billionth_of_any_coefficient_is_seen() {
    let mut changes = 0;
    for file in catalogue::schemes() {
        let mut subject = Subject::new(file, ratio(2, 7));
        if file.needs_kernel() {
            subject = subject.with_kernel(Kernel::CubicSpline, ratio(3, 2));
        }
        // Of several dimensions those of `torus.rs`: in three, double multipliers hide some changes.
        if subject.running().unwrap().dimension() == 1 {
            changes += sees_every_change(&subject);
        }
    }
    let named = |name: &str| Integrator::named(name).unwrap();
    for (space, integrator) in [
        ("upwind-3", "rk3-ssp"),
        ("upwind-9", "rk8"),
        ("compact-6", "rk4"),
        ("central-4", "ab3"),
        ("diffusion-2", "bdf2"),
        ("dg-1", "gauss-2"),
        ("dg-2", "tr-bdf2"),
        ("acoustics-staggered-2", "rk4"),
    ] {
        let file = catalogue::space(space).unwrap();
        let subject = Subject::new(file, ratio(2, 7)).with_integrator(named(integrator));
        changes += sees_every_change(&subject);
    }
    for method in catalogue::methods() {
        for integrator in ["leapfrog-kdk", "predictor-corrector", "rk4"] {
            let subject = Subject::new(method, ratio(2, 7))
                .with_kernel(Kernel::CubicSpline, ratio(3, 2))
                .with_integrator(named(integrator));
            changes += sees_every_change(&subject);
        }
    }
    assert!(changes > 900, "{changes}");
}

/// All coefficients of an integrator.
fn coefficients(integrator: &mut Integrator) -> Vec<&mut Coefficient> {
    match &mut integrator.form {
        IntegratorForm::RungeKutta { a, b } => a.iter_mut().flatten().chain(b).collect(),
        IntegratorForm::Multistep { alpha, beta } => alpha.iter_mut().chain(beta).collect(),
        IntegratorForm::Nystrom(table) => {
            let Nystrom { c, position, velocity, position_weights, velocity_weights } = table;
            let tables = position.iter_mut().chain(velocity).flatten();
            tables.chain(c).chain(position_weights).chain(velocity_weights).collect()
        }
    }
}

#[test]
fn a_billionth_of_any_coefficient_of_an_integrator_is_seen() {
    // Far from small steps, where late stages hardly count.
    let space = Subject::new(catalogue::space("upwind-3").unwrap(), ratio(9, 4));
    let waves = Subject::new(catalogue::method("sph-av").unwrap(), ratio(2, 7))
        .with_kernel(Kernel::CubicSpline, ratio(6, 5));
    let mut changes = 0;
    for integrator in catalogue::integrators() {
        let for_waves = matches!(integrator.form, IntegratorForm::Nystrom(_));
        let subject = if for_waves { &waves } else { &space }.clone().with_integrator(integrator);
        let predicted = subject.predicted().unwrap();
        agrees(&subject, &quick(1));
        for place in 0..coefficients(&mut integrator.clone()).len() {
            let mut wrong = integrator.clone();
            let mut all = coefficients(&mut wrong);
            if all[place].to_f64() == 0.0 {
                continue;
            }
            let text = format!("({})*1000000001/1000000000", all[place].text());
            *all[place] = Coefficient::parse(&text).unwrap();
            let wrong = Subject { integrator: Some(wrong), ..subject.clone() };
            let validation = validate(&wrong.running().unwrap(), &predicted, &quick(1)).unwrap();
            assert!(!validation.passed, "{}: coefficient {place}", subject.name);
            changes += 1;
        }
    }
    assert!(changes > 250, "{changes}");
}

/// An explicit or implicit scheme of the catalogue at a value of its parameter.
fn scheme_at(file: &SchemeFile, value: f64) -> Result<TorusScheme, SteppingError> {
    let defaults = file.parameters.iter().map(|(n, v)| (n.clone(), to_f64(v)));
    let sought = file.parameter.clone().unwrap();
    // Known limits of kernel schemes are those of the cubic spline at ratio 2.
    let lattice =
        file.needs_kernel().then(|| KernelLattice::new(Kernel::CubicSpline, &ratio(2, 1)).unwrap());
    TorusScheme::new(
        &file.equations,
        lattice.as_ref(),
        None,
        &defaults.chain([(sought, value)]).collect::<Vec<_>>(),
    )
}

/// The limit of the literature, if it is a number above 0.
fn known_limit(file: &SchemeFile) -> Option<f64> {
    let known = file.known.stability.as_ref()?;
    catalogue::approximate(&known.value).filter(|limit| *limit > 0.0)
}

#[test]
fn runs_from_noise_confirm_every_known_limit() {
    let mut limits = 0;
    for file in catalogue::schemes() {
        let Some(limit) = known_limit(file) else { continue };
        if scheme_at(file, limit).unwrap().dimension() > 1 {
            // Some are run in `torus.rs`: runs of several dimensions are long.
            continue;
        }
        let grew = |part: f64| grows(&scheme_at(file, part * limit).unwrap(), &[64], 16_384);
        assert_eq!([0.9, 0.9999, 1.1].map(grew), [false, false, true], "{}", file.name);
        limits += 1;
    }
    assert!(limits >= 40, "{limits}");
}

#[test]
fn always_and_never_stable_schemes_run_so() {
    let grew = |name: &str, value| {
        grows(&scheme_at(catalogue::scheme(name).unwrap(), value).unwrap(), &[64], 4000)
    };
    for name in
        ["crank-nicolson", "box", "heat-crank-nicolson", "dufort-frankel", "implicit-upwind"]
    {
        assert!(!grew(name, 7.3), "{name}");
    }
    for name in ["downwind", "ftcs-advection", "richardson", "leapfrog-diffusion"] {
        assert!(grew(name, 0.2), "{name}");
    }
    // Far beyond every number.
    assert!(grew("downwind", 1e200));
}

#[test]
fn a_singular_implicit_step_is_an_answer() {
    let file = catalogue::scheme("implicit-downwind").unwrap();
    let scheme = scheme_at(file, 0.5).unwrap();
    let singular = SteppingError::Singular { points: PerAxis(vec![32]) };
    assert_eq!(scheme.torus(&[32]).err(), Some(singular));
    // The shortest wave is not on an odd ring.
    let plan = ValidationPlan { points: vec![15], steps: 10 };
    agrees(&Subject::new(file, ratio(1, 2)), &plan);
}

#[test]
fn runs_of_many_steps_are_part_of_the_answer() {
    let subject = Subject::new(catalogue::scheme("leapfrog").unwrap(), ratio(1, 2));
    let validation = subject.validate(&ValidationPlan::in_dimension(1));
    assert_eq!(validation.rows.len(), 2 * 17);
    for row in &validation.rows {
        let run = row.run.unwrap();
        assert_eq!(run.steps, 100);
        assert!((run.measured - 1.0).abs() < 1e-12 && run.error < run.tolerance);
    }
    // Growth too.
    let subject = Subject::new(catalogue::scheme("downwind").unwrap(), ratio(1, 2));
    let validation = subject.validate(&ValidationPlan::in_dimension(1));
    let run = validation.rows[16].run.unwrap();
    assert!((run.measured / 2f64.powi(100) - 1.0).abs() < 1e-12, "{run:?}");
    let json = serde_json::to_value(&validation).unwrap();
    assert_eq!(json["rows"][16]["predicted"]["gain"], 2.0);
    assert_eq!(json["passed"], true);
}
