//! What is run and held against its prediction.

use courant_analysis::exact::rational::{Rational, ratio, to_f64};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::{self, SchemeFile};
use courant_analysis::scheme::language::parse;
use courant_analysis::scheme::language::syntax::{Equations, Expression, Node};
use courant_analysis::scheme::{Integrator, KernelLattice, SchemeError};
use courant_analysis::waves::WavePolynomial;
use courant_simulation::stepping::{
    SteppingError, TorusScheme, Validation, ValidationPlan, validate,
};

/// What is run: equations, and what completes them.
#[derive(Clone)]
pub struct Subject {
    pub name: String,
    pub equations: Equations,
    pub lattice: Option<KernelLattice>,
    pub integrator: Option<Integrator>,
    pub values: Vec<(String, Rational)>,
}

impl Subject {
    /// A file with its defaults, and a value for the parameter whose limit is sought.
    pub fn new(file: &SchemeFile, sought: Rational) -> Self {
        let defaults = file.parameters.iter().map(|(n, v)| (n.clone(), v.clone()));
        let name = file.parameter.clone().unwrap_or_else(|| "C".into());
        Self {
            name: file.name.clone(),
            equations: (*file.equations).clone(),
            lattice: None,
            integrator: None,
            values: defaults.chain([(name, sought)]).collect(),
        }
    }

    /// Equations of a text, and a value for each parameter.
    pub fn from_text(name: &str, text: &str, values: &[(&str, Rational)]) -> Self {
        Self {
            name: name.into(),
            equations: parse(text).unwrap(),
            lattice: None,
            integrator: None,
            values: values.iter().map(|(name, value)| (name.to_string(), value.clone())).collect(),
        }
    }

    pub fn with_kernel(mut self, kernel: Kernel, smoothing: Rational) -> Self {
        self.name += &format!(" {kernel}");
        self.lattice = Some(KernelLattice::new(kernel, &smoothing).unwrap());
        self
    }

    pub fn with_integrator(mut self, integrator: &Integrator) -> Self {
        self.name += &format!(" {integrator}");
        self.integrator = Some(integrator.clone());
        self
    }

    /// The predicted multipliers.
    pub fn predicted(&self) -> Result<impl Fn(&[f64]) -> WavePolynomial + use<>, SchemeError> {
        let mut file = catalogue::schemes()[0].clone();
        file.equations = self.equations.clone().into();
        file.parameters.clear();
        let (lattice, integrator) = (self.lattice.as_ref(), self.integrator.as_ref());
        let compiled = file.step(lattice, integrator, &self.values, None)?.compile()?;
        Ok(move |phase: &[f64]| compiled.polynomial(&[], phase))
    }

    pub fn running(&self) -> Result<TorusScheme, SteppingError> {
        let numbers: Vec<_> = self.values.iter().map(|(n, v)| (n.clone(), to_f64(v))).collect();
        let (lattice, integrator) = (self.lattice.as_ref(), self.integrator.as_ref());
        TorusScheme::new(&self.equations, lattice, integrator, &numbers)
    }

    pub fn validate(&self, plan: &ValidationPlan) -> Validation {
        let predicted = self.predicted().unwrap_or_else(|e| panic!("{}: {e}", self.name));
        let running = self.running().unwrap_or_else(|e| panic!("{}: {e}", self.name));
        validate(&running, predicted, plan).unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }
}

/// Passed, and with tolerances that say something: some of the rows within the billionth that must be seen.
pub fn agrees(subject: &Subject, plan: &ValidationPlan) {
    let validation = subject.validate(plan);
    let reason = validation.failure.unwrap_or_default();
    assert!(validation.passed, "{}: {reason}", subject.name);
    assert!(validation.max_error <= validation.tolerance);
    let sharp = validation.rows.iter().filter(|row| row.tolerance < 1e-9).count();
    assert!(10 * sharp >= validation.rows.len(), "{}: {sharp} sharp rows", subject.name);
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

/// Without runs.
pub fn quick(dimension: usize) -> ValidationPlan {
    let points = [vec![16], vec![6, 5], vec![4, 3, 5]];
    ValidationPlan { points: points[dimension - 1].clone(), steps: 0 }
}

/// Each coefficient changed on the side of the run, then on the side of the prediction.
pub fn sees_every_change(subject: &Subject) -> usize {
    let (right, running) = (subject.predicted().unwrap(), subject.running().unwrap());
    let plan = quick(running.dimension());
    let mut changes = 0;
    while let Some(equations) = perturbed(&subject.equations, changes) {
        let wrong = Subject { equations, ..subject.clone() };
        let of_run = wrong.running().and_then(|wrong| validate(&wrong, &right, &plan));
        let of_prediction =
            wrong.predicted().map(|wrong| validate(&running, wrong, &plan).unwrap());
        let missed = [of_run.is_ok_and(|v| v.passed), of_prediction.is_ok_and(|v| v.passed)];
        assert_eq!(missed, [false, false], "{}: change {changes}", subject.name);
        changes += 1;
    }
    changes
}
