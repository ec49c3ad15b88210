//! Every subject by two roads: multipliers of the characteristic polynomial against the equations as they run.

use courant_analysis::exact::rational::{Rational, ratio, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::{self, SchemeFile};
use courant_analysis::scheme::language::syntax::{Equations, Expression, Node};
use courant_analysis::scheme::{
    Coefficient, Integrator, IntegratorForm, KernelLattice, Nystrom, SchemeError,
};
use courant_simulation::stepping::{
    NoisePlan, RingScheme, SteppingError, Validation, ValidationPlan, bracket_limit, noise_run,
    validate,
};

/// What is run: equations, and what completes them.
#[derive(Clone)]
struct Subject {
    name: String,
    equations: Equations,
    lattice: Option<KernelLattice>,
    integrator: Option<Integrator>,
    values: Vec<(String, Rational)>,
}

impl Subject {
    /// A file with its defaults, and a value for the parameter whose limit is sought.
    fn new(file: &SchemeFile, sought: Rational) -> Self {
        let defaults = file.parameters.iter().map(|(n, v)| (n.clone(), v.clone()));
        let name = file.parameter.clone().unwrap_or_else(|| "C".into());
        Self {
            name: file.name.clone(),
            equations: file.equations.clone(),
            lattice: None,
            integrator: None,
            values: defaults.chain([(name, sought)]).collect(),
        }
    }

    fn with_kernel(mut self, kernel: Kernel, smoothing: Rational) -> Self {
        self.name += &format!(" {kernel}");
        self.lattice = Some(KernelLattice::new(kernel, &smoothing).unwrap());
        self
    }

    fn with_integrator(mut self, integrator: &Integrator) -> Self {
        self.name += &format!(" {integrator}");
        self.integrator = Some(integrator.clone());
        self
    }

    /// The predicted multipliers.
    fn predicted(&self) -> Result<impl Fn(f64) -> Vec<(num_complex::Complex64, f64)>, SchemeError> {
        let mut file = catalogue::schemes()[0].clone();
        file.equations = self.equations.clone();
        file.parameters.clear();
        let (lattice, integrator) = (self.lattice.as_ref(), self.integrator.as_ref());
        let compiled = file.step(lattice, integrator, &self.values, None)?.compile()?;
        Ok(move |phase: f64| compiled.multipliers_with_errors(&[], phase))
    }

    fn ring(&self) -> Result<RingScheme, SteppingError> {
        let numbers: Vec<_> = self.values.iter().map(|(n, v)| (n.clone(), to_f64(v))).collect();
        let (lattice, integrator) = (self.lattice.as_ref(), self.integrator.as_ref());
        RingScheme::new(&self.equations, lattice, integrator, &numbers)
    }

    fn validate(&self, plan: ValidationPlan) -> Validation {
        let predicted = self.predicted().unwrap_or_else(|e| panic!("{}: {e}", self.name));
        let ring = self.ring().unwrap_or_else(|e| panic!("{}: {e}", self.name));
        validate(&ring, predicted, plan).unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }
}

/// Passed, and with tolerances that say something: some of the rows within the billionth that must be seen.
fn agrees(subject: &Subject, plan: ValidationPlan) {
    let validation = subject.validate(plan);
    let reason = validation.failure.unwrap_or_default();
    assert!(validation.passed, "{}: {reason}", subject.name);
    assert!(validation.max_error <= validation.tolerance);
    let sharp = validation.rows.iter().filter(|row| row.tolerance < 1e-9).count();
    assert!(10 * sharp >= validation.rows.len(), "{}: {sharp} sharp rows", subject.name);
}

#[test]
fn every_scheme_of_the_catalogue_runs_as_predicted() {
    for file in catalogue::schemes() {
        // Below and above most limits.
        for sought in [ratio(2, 7), ratio(9, 8)] {
            let mut subject = Subject::new(file, sought);
            if file.needs_kernel() {
                subject = subject.with_kernel(Kernel::QuinticSpline, ratio(3, 2));
            }
            agrees(&subject, ValidationPlan::default());
        }
    }
}

#[test]
fn every_integrator_runs_every_space_as_predicted() {
    let plan = ValidationPlan { cells: 16, steps: 20 };
    for file in catalogue::spaces() {
        for integrator in catalogue::integrators() {
            let subject = Subject::new(file, ratio(3, 7)).with_integrator(integrator);
            match subject.predicted() {
                Ok(_) => agrees(&subject, plan),
                // Who is served is one answer by both roads.
                Err(SchemeError::Integrator(_)) => {
                    assert_eq!(subject.ring().err(), Some(SteppingError::NoPositions));
                }
                Err(other) => panic!("{}: {other}", subject.name),
            }
        }
    }
}

#[test]
fn particle_methods_run_as_predicted_with_every_integrator() {
    let plan = ValidationPlan { cells: 16, steps: 20 };
    for file in catalogue::methods() {
        for kernel in [Kernel::CubicSpline, Kernel::WendlandC4, Kernel::Gaussian] {
            for integrator in catalogue::integrators() {
                let subject = Subject::new(file, ratio(1, 3))
                    .with_kernel(kernel, ratio(6, 5))
                    .with_integrator(integrator);
                agrees(&subject, plan);
            }
        }
    }
}

/// The tree with the coefficient at one place, a number or the factor 1 of a value, made larger by a billionth; `None` behind the last.
fn perturbed(equations: &Equations, place: usize) -> Option<Equations> {
    fn visit(expression: &mut Expression, left: &mut Option<usize>) {
        let here = matches!(&expression.node, Node::Number(_) | Node::Unknown(_));
        if here {
            match left {
                Some(0) => {
                    let factor = Node::Number(ratio(1_000_000_001, 1_000_000_000));
                    let span = expression.span.clone();
                    let factor = Box::new(Expression { node: factor, span });
                    let value = Box::new(expression.clone());
                    expression.node = Node::Multiply(factor, value);
                    *left = None;
                    return;
                }
                Some(count) => *count -= 1,
                None => {}
            }
        }
        match &mut expression.node {
            Node::Add(a, b) | Node::Subtract(a, b) | Node::Multiply(a, b) | Node::Divide(a, b) => {
                visit(a, left);
                visit(b, left);
            }
            Node::SquareRoot(a) | Node::Negative(a) | Node::Power(a, _) => visit(a, left),
            Node::Sum { body, .. } => visit(body, left),
            Node::Number(_) | Node::Pi | Node::Name(_) | Node::Unknown(_) | Node::Weight { .. } => {
            }
        }
    }
    let (mut tree, mut left) = (equations.clone(), Some(place));
    for equation in &mut tree.equations {
        visit(&mut equation.left, &mut left);
        visit(&mut equation.right, &mut left);
    }
    left.is_none().then_some(tree)
}

fn quick() -> ValidationPlan {
    ValidationPlan { cells: 16, steps: 0 }
}

/// Each coefficient changed on the side of the run, then on the side of the prediction.
fn sees_every_change(subject: &Subject) -> usize {
    let (right, ring) = (subject.predicted().unwrap(), subject.ring().unwrap());
    let mut changes = 0;
    while let Some(equations) = perturbed(&subject.equations, changes) {
        let wrong = Subject { equations, ..subject.clone() };
        let of_run = wrong.ring().and_then(|ring| validate(&ring, &right, quick()));
        let of_prediction = wrong.predicted().map(|wrong| validate(&ring, wrong, quick()).unwrap());
        let missed = [of_run.is_ok_and(|v| v.passed), of_prediction.is_ok_and(|v| v.passed)];
        assert_eq!(missed, [false, false], "{}: change {changes}", subject.name);
        changes += 1;
    }
    changes
}

#[test]
fn a_billionth_of_any_coefficient_is_seen() {
    let mut changes = 0;
    for file in catalogue::schemes() {
        let mut subject = Subject::new(file, ratio(2, 7));
        if file.needs_kernel() {
            subject = subject.with_kernel(Kernel::CubicSpline, ratio(3, 2));
        }
        changes += sees_every_change(&subject);
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
        agrees(&subject, quick());
        for place in 0..coefficients(&mut integrator.clone()).len() {
            let mut wrong = integrator.clone();
            let mut all = coefficients(&mut wrong);
            if all[place].to_f64() == 0.0 {
                continue;
            }
            let text = format!("({})*1000000001/1000000000", all[place].text());
            *all[place] = Coefficient::parse(&text).unwrap();
            let wrong = Subject { integrator: Some(wrong), ..subject.clone() };
            let validation = validate(&wrong.ring().unwrap(), &predicted, quick()).unwrap();
            assert!(!validation.passed, "{}: coefficient {place}", subject.name);
            changes += 1;
        }
    }
    assert!(changes > 250, "{changes}");
}

/// An explicit or implicit scheme of the catalogue at a value of its parameter.
fn scheme_at(file: &SchemeFile, value: f64) -> Result<RingScheme, SteppingError> {
    let defaults = file.parameters.iter().map(|(n, v)| (n.clone(), to_f64(v)));
    let sought = file.parameter.clone().unwrap();
    // Known limits of kernel schemes are those of the cubic spline at ratio 2.
    let lattice =
        file.needs_kernel().then(|| KernelLattice::new(Kernel::CubicSpline, &ratio(2, 1)).unwrap());
    RingScheme::new(
        &file.equations,
        lattice.as_ref(),
        None,
        &defaults.chain([(sought, value)]).collect::<Vec<_>>(),
    )
}

#[test]
fn runs_from_noise_confirm_every_known_limit() {
    let mut limits = 0;
    for file in catalogue::schemes() {
        let known = file.known.stability.as_ref().and_then(|k| catalogue::approximate(&k.value));
        let Some(limit) = known.filter(|limit| *limit > 0.0) else { continue };
        let bracket =
            bracket_limit(|value| scheme_at(file, value), limit, NoisePlan::default()).unwrap();
        assert!(bracket.confirmed, "{}: {bracket:?}", file.name);
        let width = (bracket.above.value - bracket.below.value) / limit;
        assert!(width < 0.201 && bracket.below.value < limit && limit < bracket.above.value);
        limits += 1;
    }
    assert!(limits >= 40, "{limits}");
}

#[test]
fn a_wrong_limit_is_not_confirmed() {
    for name in ["upwind", "leapfrog", "wave-2", "staggered-acoustics-4", "heat-ftcs"] {
        let file = catalogue::scheme(name).unwrap();
        let known = &file.known.stability.as_ref().unwrap().value;
        let limit = catalogue::approximate(known).unwrap();
        let plan = NoisePlan { most_steps: 2000, ..NoisePlan::default() };
        let at = |limit| bracket_limit(|value| scheme_at(file, value), limit, plan).unwrap();
        let high = at(1.3 * limit);
        assert!(!high.confirmed && high.below.grew, "{name}: {high:?}");
        let low = at(0.8 * limit);
        assert!(!low.confirmed && !low.above.grew, "{name}: {low:?}");
    }
}

#[test]
fn always_and_never_stable_schemes_run_so() {
    let plan = NoisePlan { most_steps: 4000, ..NoisePlan::default() };
    let run = |name: &str, value| {
        let scheme = scheme_at(catalogue::scheme(name).unwrap(), value).unwrap();
        noise_run(&scheme.ring(plan.cells).unwrap(), value, plan)
    };
    for name in
        ["crank-nicolson", "box", "heat-crank-nicolson", "dufort-frankel", "implicit-upwind"]
    {
        assert!(!run(name, 7.3).grew, "{name}");
    }
    for name in ["downwind", "ftcs-advection", "richardson", "leapfrog-diffusion"] {
        assert!(run(name, 0.2).grew, "{name}");
    }
    // Far beyond every number.
    let burst = run("downwind", 1e200);
    assert!(burst.grew && burst.steps < 5);
}

#[test]
fn a_singular_implicit_step_is_an_answer() {
    let file = catalogue::scheme("implicit-downwind").unwrap();
    let scheme = scheme_at(file, 0.5).unwrap();
    assert_eq!(scheme.ring(32).err(), Some(SteppingError::Singular { cells: 32 }));
    // The shortest wave is not on an odd ring.
    agrees(&Subject::new(file, ratio(1, 2)), ValidationPlan { cells: 15, steps: 10 });
}

#[test]
fn runs_of_many_steps_are_part_of_the_answer() {
    let subject = Subject::new(catalogue::scheme("leapfrog").unwrap(), ratio(1, 2));
    let validation = subject.validate(ValidationPlan::default());
    assert_eq!(validation.rows.len(), 2 * 17);
    for row in &validation.rows {
        let run = row.run.unwrap();
        assert_eq!(run.steps, 100);
        assert!((run.measured - 1.0).abs() < 1e-12 && run.error < run.tolerance);
    }
    // Growth too.
    let subject = Subject::new(catalogue::scheme("downwind").unwrap(), ratio(1, 2));
    let validation = subject.validate(ValidationPlan::default());
    let run = validation.rows[16].run.unwrap();
    assert!((run.measured / 2f64.powi(100) - 1.0).abs() < 1e-12, "{run:?}");
    let json = serde_json::to_value(&validation).unwrap();
    assert_eq!(json["rows"][16]["predicted"]["gain"], 2.0);
    assert_eq!(json["passed"], true);
}
