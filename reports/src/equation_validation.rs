//! The multipliers of a subject against its equations, stepped as they were typed.

use crate::subject::{Sought, Subject, SubjectError};
use courant_analysis::exact::rational::to_f64;
use courant_analysis::interest::Interest;
use courant_analysis::scheme::KernelLattice;
use courant_analysis::stability::SearchPlan;
use courant_analysis::waves::CompiledStep;
use courant_simulation::stepping::{
    SteppingError, TorusScheme, Validation, ValidationPlan, validate,
};

/// A subject whose equations can be run beside its multipliers.
pub struct RunningSubject<'a> {
    /// The step, with one parameter in question.
    pub sought: Sought,
    subject: &'a Subject,
    lattice: Option<KernelLattice>,
    compiled: CompiledStep,
}

impl<'a> RunningSubject<'a> {
    /// With values for all parameters but the one in question.
    ///
    /// # Errors
    /// When another has none, or there is no multiplier.
    pub fn new(subject: &'a Subject) -> Result<Self, SubjectError> {
        let sought = subject.sought(true)?;
        let compiled = sought.step.compile().map_err(|error| subject.failure(error))?;
        Ok(Self { lattice: subject.lattice()?, sought, subject, compiled })
    }

    /// Half the limit, the limit, and half as much again; one half where there is no positive limit.
    ///
    /// # Errors
    /// When the limit cannot be asked for.
    pub fn about_the_limit(&self, interest: Interest) -> Result<Vec<f64>, SubjectError> {
        let plan = SearchPlan::default().up_to(self.subject.range(None)).while_wanted(interest);
        let set = self.sought.step.stable_set(&self.sought.parameter, &plan);
        let limit = set.map_err(|error| self.subject.failure(error))?.limit().value();
        let is_positive = limit.is_finite() && limit > 0.0;
        Ok(if is_positive { vec![0.5 * limit, limit, 1.5 * limit] } else { vec![0.5] })
    }

    /// Runs the equations at a value of the parameter in question.
    ///
    /// # Errors
    /// When the step is singular there, or has no such lattice.
    pub fn validate(&self, value: f64, plan: &ValidationPlan) -> Result<Validation, SteppingError> {
        let set = self.sought.step.set_parameters().iter();
        let mut values: Vec<(String, f64)> =
            set.map(|(name, value)| (name.clone(), to_f64(value))).collect();
        values.push((self.sought.parameter.clone(), value));
        let running = TorusScheme::new(
            &self.subject.file.equations,
            self.lattice.as_ref(),
            self.subject.integrator.as_deref(),
            &values,
        )?;
        let values: Vec<f64> = self.compiled.parameters().iter().map(|_| value).collect();
        validate(&running, |phase| self.compiled.polynomial(&values, phase), plan)
    }
}
