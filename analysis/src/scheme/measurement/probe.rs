//! A step that is run and judged: measured at values of its parameter, fitted, and asked what every scheme is asked.

use super::{Experiment, MeasuredStencil, MeasuredStep, NoFit, Objection};
use crate::exact::rational::Rational;
use crate::scheme::SchemeError;
use crate::stability::{Judgement, SearchPlan, StableSet, judge};
use rayon::prelude::*;

/// What is asked of a step that is only known by running it.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// How it is measured.
    pub experiment: Experiment,
    /// The names of the unknowns.
    pub unknowns: Vec<String>,
    /// The parameter whose limit is sought; where there is none the one step there is is judged.
    pub sought: Option<String>,
    /// Values of that parameter through which coefficients are fitted as polynomials.
    pub fit: Vec<Rational>,
    /// Values to be judged.
    pub judged: Vec<Rational>,
}

/// A measurement that came to nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Refused<E> {
    /// The value of the parameter, where one is sought.
    pub value: Option<Rational>,
    /// Why.
    pub objection: Objection<E>,
}

/// What is known of a step that was run.
#[derive(Debug, Clone)]
pub struct Probed {
    /// The step as a scheme.
    pub measured: MeasuredStep,
    /// Where it was run.
    pub values: Vec<Rational>,
    /// The largest of what a step adds to zero.
    pub source: f64,
    /// The stable values of the parameter, where it occurs.
    pub stable_set: Option<StableSet>,
    /// Where all coefficients are positive; nothing where they are decimals, whose signs about 0 say nothing.
    pub monotone_set: Option<StableSet>,
    /// Of the only step there is, or of values of the parameter.
    pub judgements: Vec<(Option<Rational>, Judgement)>,
}

impl Probe {
    /// Where the step is run: what is judged as well, as polynomials through other values say nothing of it. One value without a meaning
    /// where no parameter is sought.
    pub fn values(&self) -> Vec<Rational> {
        let mut values = match &self.sought {
            Some(_) => self.fit.clone(),
            None => vec![Rational::default()],
        };
        for value in &self.judged {
            if !values.contains(value) {
                values.push(value.clone());
            }
        }
        values
    }

    /// How many steps are taken.
    pub fn runs(&self) -> usize {
        self.values().len() * self.experiment.runs()
    }

    /// Runs the step: from a value of the parameter and a state to the new level. It is called from several threads.
    ///
    /// # Errors
    /// What is wrong with the step, or its own error.
    pub fn measure<E: Send>(
        &self,
        step: impl Fn(&Rational, &[f64]) -> Result<Vec<f64>, E> + Sync,
    ) -> Result<Vec<(Rational, MeasuredStencil)>, Refused<E>> {
        let values = self.values();
        let at = |value: &Rational| match self.experiment.measure(|state| step(value, state)) {
            Ok(stencil) => Ok((value.clone(), stencil)),
            Err(objection) => {
                Err(Refused { value: self.sought.as_ref().map(|_| value.clone()), objection })
            }
        };
        // What is wrong with a step shows at the first value; the others run side by side.
        let first = at(&values[0])?;
        let rest: Vec<_> = values[1..].par_iter().map(at).collect();
        std::iter::once(Ok(first)).chain(rest).collect()
    }

    /// Makes a scheme of what was measured, and asks for its stable values up to the end of the plan.
    ///
    /// ```
    /// use courant_analysis::exact::rational::ratio;
    /// use courant_analysis::scheme::measurement::{Base, Experiment, Probe, StateLayout};
    /// use courant_analysis::stability::{SearchPlan, verdict::Verdict};
    /// let layout = StateLayout { levels: 1, unknowns: 1, size: vec![12] };
    /// let probe = Probe {
    ///     experiment: Experiment { layout, base: Base::Zero, tolerance: 1e-14 },
    ///     unknowns: vec!["u".into()],
    ///     sought: Some("C".into()),
    ///     fit: (1..=8).map(|i| ratio(i, 8)).collect(),
    ///     judged: vec![ratio(3, 2)],
    /// };
    /// let upwind = |c: &_, u: &[f64]| {
    ///     let c = courant_analysis::exact::rational::to_f64(c);
    ///     Ok::<_, String>((0..12).map(|j| u[j] - c * (u[j] - u[(j + 11) % 12])).collect())
    /// };
    /// let found = probe.analyse(probe.measure(upwind).unwrap(), &SearchPlan::default())?;
    /// assert_eq!(found.stable_set.unwrap().limit().value(), 1.0);
    /// assert_eq!(found.judgements[0].1.verdict, Verdict::Unstable);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When a coefficient is no polynomial in the parameter, or the scheme that comes out is none.
    pub fn analyse(
        &self,
        stencils: Vec<(Rational, MeasuredStencil)>,
        plan: &SearchPlan,
    ) -> Result<Probed, NoFit> {
        let sought = self.sought.as_deref();
        let layout = &self.experiment.layout;
        let measured = MeasuredStep::fit(layout, &self.unknowns, sought, &stencils)?;
        let source = stencils.iter().map(|(_, one)| one.source).fold(0.0, f64::max);
        let plan = plan.clone().growing(measured.growth.clone());
        let (mut stable_set, mut monotone_set) = (None, None);
        if let Some(parameter) = &measured.parameter {
            stable_set = Some(measured.step.stable_set(parameter, &plan)?);
            if measured.recognised {
                monotone_set = measured.step.monotone_set(parameter, &plan)?;
            }
        }
        let judgements = match &measured.parameter {
            None => vec![(None, judge(&measured.step, &measured.growth)?)],
            Some(name) => self
                .judged
                .par_iter()
                .map(|value| {
                    let at = measured.step.with(name, value)?;
                    Ok((Some(value.clone()), judge(&at, &measured.growth)?))
                })
                .collect::<Result<_, SchemeError>>()?,
        };
        let values = stencils.into_iter().map(|(value, _)| value).collect();
        Ok(Probed { measured, values, source, stable_set, monotone_set, judgements })
    }
}
