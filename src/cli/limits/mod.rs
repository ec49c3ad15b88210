//! `courant limits`.

mod csv;
mod remarks;
mod tables;

use super::numbers::Numbers;
use super::output::{Format, print, print_json};
use super::subject::{Defaults, Sought, Subject, SubjectOptions};
use super::{Failure, Outcome, numbers};
use clap::Args;
use courant::analysis::certificate::Certificate;
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::stability::{
    DEFAULT_BITS, Limit, Refinement, SearchPlan, SingularStep, StableSet, Wave,
    sampled_stability_limit,
};
use courant::reports::certificate_file;
use courant::reports::number::finite;
use courant::reports::record::{
    GrowthRecord, IntervalRecord, LimitRecord, LimitsRow, Phases, SingularRecord, intervals,
    undecided,
};
use num_traits::Zero;
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    #[command(flatten)]
    search: SearchOptions,
    /// Also the limits for |z| ≤ 1 + growth per step: 1e-9,1e-6,1e-3.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative_list)]
    growth: Option<Numbers>,
    /// Look at N equally spaced phases instead of proving; for explicit one-step schemes in one dimension.
    #[arg(long, value_name = "N", value_parser = numbers::phases, conflicts_with = "method")]
    samples: Option<usize>,
    /// Significant digits of the limits, cut off and not rounded (at most 300); more than 15 need a closed form, an equation, or a
    /// narrower enclosure, which takes longer.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = numbers::digits)]
    digits: Option<usize>,
    /// Also write a certificate of every limit to this file; `courant verify` checks it.
    #[arg(long, value_name = "FILE.json", conflicts_with = "samples")]
    certificate: Option<PathBuf>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// How far and how hard to look.
#[derive(Debug, Args)]
pub struct SearchOptions {
    /// Look for stable values up to this one (default: 100; schemes with kernels 10 + 4 l/Δξ; c Δt/h of particle methods 10).
    #[arg(long, alias = "max-cfl", value_name = "VALUE", allow_hyphen_values = true, value_parser = numbers::courant_number)]
    max: Option<Rational>,
    /// Boxes that one decision may look at, in two and three dimensions all decisions of a search together, where boxes of long polynomials count
    /// more; when they are spent the answer is `undecided` (default: no bound of yours).
    #[arg(long, value_name = "BOXES", value_parser = numbers::budget)]
    budget: Option<usize>,
}

impl SearchOptions {
    /// The plan for a subject.
    pub fn plan(&self, subject: &Subject) -> SearchPlan {
        let plan = SearchPlan::default().up_to(subject.range(self.max.as_ref()));
        SearchPlan { budget: self.budget.unwrap_or(plan.budget), ..plan }
    }
}

/// Everything about one subject.
struct Answer {
    subject: Subject,
    sought: Sought,
    stability: Limit,
    /// Absent when only samples were looked at.
    set: Option<StableSet>,
    /// Absent where the question is not asked.
    monotonicity: Option<Limit>,
    monotone_set: Option<StableSet>,
    growth: Vec<(Rational, Limit)>,
    singular: Vec<SingularStep>,
    /// The phase of a wave that grows like the number of steps, as all do at every value.
    double_multiplier: Option<Wave>,
    keeps_constants: bool,
    /// How the parameter must fall under refinement, where no value is stable.
    refinement: Option<Refinement>,
}

#[derive(Debug, Serialize)]
struct Rows {
    rows: Vec<LimitsRow>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let subjects = arguments.subject.subjects(&Defaults::default())?;
    let answers: Vec<Answer> = subjects
        .into_par_iter()
        .map(|subject| answer(arguments, subject))
        .collect::<Result<_, _>>()?;
    if let Some(file) = &arguments.certificate {
        write_certificates(arguments, file, &answers)?;
    }
    match arguments.format {
        Format::Json => {
            let rows = answers.iter().map(|answer| row(arguments, answer)).collect();
            print_json("limits", &Rows { rows })
        }
        Format::Csv => print(&csv::table(arguments, &answers).to_csv()),
        format => print(&tables::text(arguments, &answers, format)),
    }
}

/// The growth budgets asked for.
fn budgets(arguments: &Arguments) -> &[Rational] {
    arguments.growth.as_ref().map_or(&[], |numbers| &numbers.0)
}

/// Bits of an enclosure that settle the digits asked for.
fn bits(arguments: &Arguments) -> u32 {
    let digits = arguments.digits.unwrap_or(super::limit_text::DEFAULT_DIGITS) as f64;
    ((digits * std::f64::consts::LOG2_10).ceil() as u32 + 4).max(DEFAULT_BITS)
}

fn answer(arguments: &Arguments, subject: Subject) -> Result<Answer, Failure> {
    let sought = subject.sought(false)?;
    let plan = arguments.search.plan(&subject).to_bits(bits(arguments));
    let failed = |error| subject.failure(error);
    let (step, parameter) = (&sought.step, &sought.parameter);
    let (stability, set) = match arguments.samples {
        Some(samples) => (sampled(&subject, samples, &plan.max)?, None),
        None => {
            let set = step.stable_set(parameter, &plan).map_err(failed)?;
            (set.limit(), Some(set))
        }
    };
    let double = set.as_ref().map(|set| step.multiple_on_every_wave(parameter, set));
    let double = double.transpose().map_err(failed)?.flatten();
    let unstable = set.is_some() && stability.upper() == 0.0;
    let refinement = match unstable {
        true => step.refinement_rule(parameter).map_err(failed)?,
        false => None,
    };
    let growth = budgets(arguments).iter().map(|budget| {
        let plan = plan.clone().growing(budget.clone());
        let found = step.stable_set(parameter, &plan).map_err(failed)?;
        Ok((budget.clone(), found.limit()))
    });
    let monotone_set = step.monotone_set(parameter, &plan).map_err(failed)?;
    Ok(Answer {
        stability,
        set,
        monotonicity: monotone_set.as_ref().map(StableSet::limit),
        monotone_set,
        growth: growth.collect::<Result<_, Failure>>()?,
        double_multiplier: double.map(|found| found.wave),
        singular: step.singular_steps(parameter, &plan).map_err(failed)?,
        refinement,
        keeps_constants: step.keeps_constants().map_err(failed)?,
        sought,
        subject,
    })
}

fn sampled(subject: &Subject, samples: usize, max: &Rational) -> Result<Limit, Failure> {
    let cells = (samples - 1) as f64;
    let phases: Vec<f64> = (0..samples).map(|i| i as f64 / cells * std::f64::consts::PI).collect();
    let sought = subject.sought(false)?;
    if sought.step.dimension() > 1 {
        let name = &subject.file.name;
        return Err(Failure::Message(format!(
            "--samples: {name} has {} space dimensions; samples are taken along one axis only",
            sought.step.dimension()
        )));
    }
    let margin = sought.step.gain_margin(&sought.parameter, &Rational::zero()).ok().flatten();
    let margin = margin.ok_or_else(|| {
        Failure::Message(format!("--samples: {} is no explicit one-step scheme", subject.file.name))
    })?;
    Ok(sampled_stability_limit(&margin, &phases, max))
}

/// Certificates of every limit shown: stability, growth budgets, monotonicity.
fn write_certificates(
    arguments: &Arguments,
    file: &Path,
    answers: &[Answer],
) -> Result<(), Failure> {
    let certified: Result<Vec<Vec<Certificate>>, Failure> = answers
        .par_iter()
        .map(|answer| {
            let subject = &answer.subject;
            let plan = arguments.search.plan(subject);
            let budgets = budgets(arguments);
            certificate_file::certificates(subject, &answer.sought, &plan, budgets).map_err(|why| {
                Failure::Message(format!("--certificate: {}: {why}", subject.file.name))
            })
        })
        .collect();
    let certificates: Vec<Certificate> = certified?.into_iter().flatten().collect();
    certificate_file::write(file, &certificates)
        .map_err(|error| Failure::Message(format!("--certificate: {error}")))
}

fn row(arguments: &Arguments, answer: &Answer) -> LimitsRow {
    let symbol = &answer.subject.symbol(&answer.sought.parameter);
    let record = |limit: &Limit| LimitRecord::new(limit, symbol, arguments.digits);
    let limit = &answer.stability;
    let units = answer.subject.other_units(limit.value());
    LimitsRow {
        subject: answer.subject.record(&answer.sought.step, Some(&answer.sought.parameter)),
        stability: record(limit),
        stable_set: match &answer.set {
            Some(set) => intervals(set, symbol),
            None => vec![IntervalRecord::up_to(limit)],
        },
        undecided: answer.set.as_ref().map(undecided).unwrap_or_default(),
        per_spacing: units.and_then(|(spacing, _)| finite(spacing)),
        per_standard_deviation: units.and_then(|(_, deviation)| finite(deviation)),
        binding: limit.binding().map(|binding| binding.name()),
        limit_included: limit.is_included(),
        double_multiplier_phase: answer.double_multiplier.as_ref().map(Phases::of),
        monotonicity: answer.monotonicity.as_ref().map(record),
        monotone_set: answer.monotone_set.as_ref().map(|set| intervals(set, symbol)),
        monotonicity_reason: match answer.monotonicity {
            Some(_) => None,
            None => Some(answer.subject.without_monotonicity()),
        },
        singular: answer
            .singular
            .iter()
            .map(|one| SingularRecord {
                value: one.value,
                exact: one.exact.as_ref().map(to_text),
                phase: one.wave.as_ref().map(Phases::of),
                reason: one.wave.is_none().then_some("no wave can be stepped"),
            })
            .collect(),
        growth_limits: answer
            .growth
            .iter()
            .map(|(growth, limit)| GrowthRecord {
                growth: to_f64(growth),
                value: finite(limit.value()),
                limit: record(limit),
            })
            .collect(),
        keeps_constants: answer.keeps_constants,
    }
}
