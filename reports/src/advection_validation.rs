//! Predicted against measured for the advection schemes: which cases to run, and the answer as JSON.

use crate::number::finite;
use courant_analysis::exact::rational::{Rational, from_f64, integer, to_f64, to_text};
use courant_simulation::advection::{
    Discretisation, Fault, Layout, ModeRow, Validation, ValidationPlan, validate,
};
use courant_simulation::run::InvalidOptions;
use num_complex::Complex64;
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Where a Courant number lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// In the stable set.
    Stable,
    /// At the stability limit, where the wave that binds neither grows nor decays.
    Neutral,
    /// Outside the stable set.
    Unstable,
}

impl Regime {
    /// The name used in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Neutral => "neutral",
            Self::Unstable => "unstable",
        }
    }
}

/// How the runs are done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Particles on the ring.
    pub particles: usize,
    /// Steps of each run.
    pub steps: u64,
    /// A deliberate error.
    pub fault: Option<Fault>,
}

impl Default for Settings {
    /// 200 particles, 100 steps, neighbours found among the particles.
    fn default() -> Self {
        Self { particles: 200, steps: 100, fault: None }
    }
}

/// One Courant number of one discretisation.
#[derive(Debug, Clone, PartialEq)]
pub struct ValidationCase {
    /// What is run.
    pub plan: ValidationPlan,
    /// Where its Courant number lies.
    pub regime: Regime,
}

impl ValidationCase {
    /// A case at a Courant number asked for.
    pub fn at(discretisation: Discretisation, courant: &Rational, settings: Settings) -> Self {
        let plan = discretisation.plan();
        let range = plan.max.clone().max(courant * integer(2));
        let set = discretisation.stable_set_by(&plan.up_to(range));
        let regime = if set.limit().value() == to_f64(courant) {
            Regime::Neutral
        } else if set.contains(courant) {
            Regime::Stable
        } else {
            Regime::Unstable
        };
        Self::new(discretisation, to_f64(courant), regime, settings)
    }

    /// Three cases: at half the stability limit, at the limit, and at one and a half times the limit.
    /// Where there is no stable Courant number, all three (at 1/2, 1 and 3/2) are unstable.
    pub fn about_the_limit(discretisation: &Discretisation, settings: Settings) -> Vec<Self> {
        let limit = discretisation.stable_set().limit().value();
        // No neighbour counts where there is no end to the stable numbers: every number is neutral.
        let (limit, regimes) = if limit == 0.0 {
            (1.0, [Regime::Unstable; 3])
        } else if limit.is_finite() {
            (limit, [Regime::Stable, Regime::Neutral, Regime::Unstable])
        } else {
            (1.0, [Regime::Neutral; 3])
        };
        let cases = [0.5, 1.0, 1.5].into_iter().zip(regimes);
        cases
            .map(|(share, regime)| {
                Self::new(discretisation.clone(), share * limit, regime, settings)
            })
            .collect()
    }

    fn new(
        discretisation: Discretisation,
        courant_number: f64,
        regime: Regime,
        settings: Settings,
    ) -> Self {
        let Settings { particles, steps, fault } = settings;
        let layout = Layout::Uniform;
        let plan =
            ValidationPlan { discretisation, courant_number, particles, steps, layout, fault };
        Self { plan, regime }
    }

    /// The Courant number as a number for people: exact where it was exact.
    pub fn courant_text(&self) -> String {
        let courant = self.plan.courant_number;
        from_f64(courant)
            .map(|exact| to_text(&exact))
            .filter(|text| text.len() <= 8)
            .unwrap_or_else(|| crate::number::significant(courant, 8))
    }
}

/// A case and what came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ValidatedCase {
    /// What was run.
    pub case: ValidationCase,
    /// What was found.
    pub validation: Validation,
}

impl ValidatedCase {
    /// The largest predicted gain of a mode of the ring.
    pub fn largest_gain(&self) -> f64 {
        self.validation.rows.iter().map(|row| row.predicted.norm()).fold(0.0, f64::max)
    }
}

/// Runs the cases side by side; the answers do not depend on the number of threads. `observe(done, all)`
/// is called after each.
///
/// # Errors
/// When a number of a plan is out of range.
pub fn run_cases(
    cases: Vec<ValidationCase>,
    observe: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<ValidatedCase>, InvalidOptions> {
    let (all, done) = (cases.len(), AtomicUsize::new(0));
    let run = |case: ValidationCase| {
        let validation = validate(&case.plan);
        observe(done.fetch_add(1, Ordering::Relaxed) + 1, all);
        validation.map(|validation| ValidatedCase { case, validation })
    };
    cases.into_par_iter().map(run).collect()
}

/// A factor per step as JSON.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FactorRecord {
    /// `|g|`; `null` when it is not finite.
    pub gain: Option<f64>,
    /// `arg g` in radians.
    pub phase: Option<f64>,
}

impl FactorRecord {
    /// The record of a factor.
    pub fn new(factor: Complex64) -> Self {
        Self { gain: finite(factor.norm()), phase: finite(factor.arg()) }
    }
}

/// One mode of one case as JSON.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeRecord {
    /// The scheme's name.
    pub scheme: &'static str,
    /// The kernel's name.
    pub kernel: &'static str,
    /// The smoothing ratio, exactly.
    pub ratio: String,
    /// The Courant number.
    pub cfl: f64,
    /// Waves on the ring.
    pub mode: usize,
    /// `2π mode/N` in radians.
    pub phase: f64,
    /// By the symbol.
    pub predicted: FactorRecord,
    /// By the run.
    pub measured: FactorRecord,
    /// `|measured − predicted|`; `null` when it is not finite.
    pub error: Option<f64>,
}

/// One case as JSON.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseRecord {
    /// The scheme's name.
    pub scheme: &'static str,
    /// The kernel's name.
    pub kernel: &'static str,
    /// The smoothing ratio, exactly.
    pub ratio: String,
    /// The Courant number.
    pub cfl: f64,
    /// `stable`, `neutral` or `unstable`.
    pub regime: &'static str,
    /// The largest predicted `|g|` of a mode.
    pub largest_gain: f64,
    /// The largest error of a mode; `null` when it is not finite.
    pub max_error: Option<f64>,
    /// What is allowed.
    pub tolerance: f64,
    /// Whether every mode agrees.
    pub passed: bool,
}

/// The answer as JSON: `courant.validate/1`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValidationRecord {
    /// Particles on the ring.
    pub particles: usize,
    /// Steps of each run.
    pub steps: u64,
    /// Every mode of every case.
    pub rows: Vec<ModeRecord>,
    /// Case by case.
    pub cases: Vec<CaseRecord>,
    /// The largest error of all; `null` when one is not finite.
    pub max_error: Option<f64>,
    /// The largest tolerance of a case.
    pub tolerance: f64,
    /// Whether every case is within its own tolerance.
    pub passed: bool,
}

impl ValidationRecord {
    /// The record of some cases.
    pub fn new(settings: Settings, cases: &[ValidatedCase]) -> Self {
        let records: Vec<CaseRecord> = cases
            .iter()
            .map(|case| {
                let (scheme, kernel, ratio, cfl) = names(case);
                CaseRecord {
                    scheme,
                    kernel,
                    ratio,
                    cfl,
                    regime: case.case.regime.name(),
                    largest_gain: case.largest_gain(),
                    max_error: finite(case.validation.max_error),
                    tolerance: case.validation.tolerance,
                    passed: case.validation.passed(),
                }
            })
            .collect();
        Self {
            particles: settings.particles,
            steps: settings.steps,
            rows: cases
                .iter()
                .flat_map(|case| case.validation.rows.iter().map(|row| mode_record(case, row)))
                .collect(),
            max_error: records
                .iter()
                .map(|case| case.max_error)
                .try_fold(0.0, |worst: f64, error| error.map(|error| worst.max(error))),
            tolerance: records.iter().map(|case| case.tolerance).fold(0.0, f64::max),
            passed: records.iter().all(|case| case.passed),
            cases: records,
        }
    }
}

fn names(case: &ValidatedCase) -> (&'static str, &'static str, String, f64) {
    let plan = &case.case.plan;
    let discretisation = &plan.discretisation;
    (
        discretisation.scheme().name(),
        discretisation.kernel().name(),
        to_text(discretisation.ratio()),
        plan.courant_number,
    )
}

fn mode_record(case: &ValidatedCase, row: &ModeRow) -> ModeRecord {
    let (scheme, kernel, ratio, cfl) = names(case);
    ModeRecord {
        scheme,
        kernel,
        ratio,
        cfl,
        mode: row.mode,
        phase: row.phase,
        predicted: FactorRecord::new(row.predicted),
        measured: FactorRecord::new(row.measured),
        error: finite(row.error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::exact::rational::ratio;
    use courant_analysis::kernel::Kernel;
    use courant_simulation::advection::AdvectionScheme;

    fn discretisation(scheme: AdvectionScheme) -> Discretisation {
        Discretisation::new(scheme, Kernel::CubicSpline, integer(2)).unwrap()
    }

    #[test]
    fn the_regimes_are_what_the_gains_say() {
        let settings = Settings { particles: 32, steps: 3, ..Settings::default() };
        for scheme in AdvectionScheme::ALL {
            let cases = ValidationCase::about_the_limit(&discretisation(scheme), settings);
            for case in run_cases(cases, &|_, _| ()).unwrap() {
                let gain = case.largest_gain();
                match case.case.regime {
                    Regime::Unstable => assert!(gain > 1.01, "{scheme} {gain}"),
                    Regime::Stable | Regime::Neutral => {
                        assert!(gain < 1.0 + 1e-12, "{scheme} {gain}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_number_asked_for_is_placed() {
        let regime = |courant: &Rational| {
            let discretisation = discretisation(AdvectionScheme::GodunovSph);
            ValidationCase::at(discretisation, courant, Settings::default()).regime
        };
        assert_eq!(regime(&ratio(18, 10)), Regime::Stable);
        assert_eq!(regime(&ratio(15, 8)), Regime::Neutral);
        assert_eq!(regime(&ratio(19, 10)), Regime::Unstable);
        assert_eq!(regime(&integer(100)), Regime::Unstable);
    }

    #[test]
    fn one_bad_case_fails_the_record() {
        let discretisation = discretisation(AdvectionScheme::GodunovSph);
        let sound = Settings { particles: 16, steps: 2, ..Settings::default() };
        let faulty = Settings { fault: Some(Fault { offset: -1, by: 1e-9 }), ..sound };
        let mut cases = vec![ValidationCase::at(discretisation.clone(), &integer(1), sound)];
        let record = |cases: &[ValidationCase]| {
            ValidationRecord::new(sound, &run_cases(cases.to_vec(), &|_, _| ()).unwrap())
        };
        assert!(record(&cases).passed);
        cases.push(ValidationCase::at(discretisation, &integer(1), faulty));
        let record = record(&cases);
        assert!(!record.passed && record.max_error.unwrap() > record.tolerance);
        assert_eq!((record.rows.len(), record.cases.len()), (18, 2));
    }
}
