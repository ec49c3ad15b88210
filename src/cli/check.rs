//! `courant check`.

use super::columns::{
    empty, limit_cells, limit_columns, number, phases, subject_cells, subject_columns,
};
use super::limit_text::{describe, wave_and_phase, wave_words};
use super::limits::SearchOptions;
use super::numbers::Numbers;
use super::output::{Format, print, print_json, table_text};
use super::subject::{
    Defaults, Label, Sought, Subject, SubjectOptions, assumptions, shown, varying,
};
use super::{Failure, Outcome, numbers};
use clap::Args;
use courant::analysis::exact::rational::{Rational, to_f64};
use courant::analysis::scheme::SchemeError;
use courant::analysis::stability::verdict::{Check, Verdict, check};
use courant::analysis::stability::{PointVerdict, decide_step_at};
use courant::reports::number::significant;
use courant::reports::record::CheckRecord;
use courant::reports::table::{Align, Table};
use rayon::prelude::*;
use serde::Serialize;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    #[command(flatten)]
    search: SearchOptions,
    /// Values of the parameter whose limit is sought, read exactly: the Courant number of a scheme, c Δt/h of a particle method.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_numbers_from_zero)]
    cfl: Option<Numbers>,
    /// Accept growth up to this much per step: the answer is then whether |z| ≤ 1 + growth.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative)]
    growth: Option<Rational>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// One subject at one value.
struct Answer {
    subject: Subject,
    sought: Sought,
    value: Rational,
    found: Check,
    /// Whether the growth is within what is accepted; nothing where that is not decided.
    within: Option<Option<bool>>,
}

impl Answer {
    /// Whether the answer is yes: proved, not only not refuted.
    fn is_accepted(&self) -> bool {
        match self.within {
            Some(within) => within == Some(true),
            None => self.found.verdict.is_stable(),
        }
    }

    fn symbol(&self) -> String {
        self.subject.symbol(&self.sought.parameter)
    }
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let subjects = arguments.subject.subjects(&Defaults::default())?;
    let cases: Vec<(Subject, Option<Rational>)> = match &arguments.cfl {
        None => subjects.into_iter().map(|subject| (subject, None)).collect(),
        Some(values) => subjects
            .into_iter()
            .flat_map(|subject| values.0.iter().map(move |v| (subject.clone(), Some(v.clone()))))
            .collect(),
    };
    let answers: Vec<Answer> = cases
        .into_par_iter()
        .map(|(subject, cfl)| answer(arguments, subject, cfl))
        .collect::<Result<_, _>>()?;
    show(arguments, &answers)?;
    let accepted = answers.iter().all(Answer::is_accepted);
    Ok(if accepted { Outcome::Yes } else { Outcome::No })
}

fn answer(
    arguments: &Arguments,
    subject: Subject,
    cfl: Option<Rational>,
) -> Result<Answer, Failure> {
    let sought = subject.sought(true)?;
    let name = &sought.parameter;
    let value = match (cfl, &sought.value) {
        (Some(_), Some(_)) => {
            return Err(Failure::Message(format!("--cfl: --set {name} gives it a value already")));
        }
        (Some(value), None) => value,
        (None, Some(value)) => numbers::from_zero(value.clone())
            .map_err(|problem| Failure::Message(format!("--set {name}: {problem}")))?,
        (None, None) => {
            return Err(Failure::Message(format!(
                "--cfl is required: the value of {name} to be judged, or --set {name}=…"
            )));
        }
    };
    let given = if arguments.cfl.is_some() { "--cfl" } else { "--set" };
    let failed = |error| match error {
        SchemeError::Singular { .. } => Failure::Message(format!("{given}: {error}")),
        _ => subject.failure(error).into(),
    };
    let plan = arguments.search.plan(&subject);
    let found = check(&sought.step, name, &value, &plan).map_err(failed)?;
    let within = match &arguments.growth {
        None => None,
        Some(growth) => {
            let at_value = sought.step.with(name, &value).map_err(failed)?;
            Some(match decide_step_at(&at_value, growth).map_err(failed)? {
                PointVerdict::Stable => Some(true),
                PointVerdict::Unstable(_) => Some(false),
                PointVerdict::Undecided => None,
            })
        }
    };
    Ok(Answer { subject, sought, value, found, within })
}

fn record(answer: &Answer) -> CheckRecord {
    CheckRecord::new(&answer.subject, &answer.sought, &answer.value, &answer.found, answer.within)
}

#[derive(Debug, Serialize)]
struct Rows {
    rows: Vec<CheckRecord>,
}

fn show(arguments: &Arguments, answers: &[Answer]) -> Result<Outcome, Failure> {
    let table = match (answers, arguments.format) {
        // One answer is the object, several are rows.
        ([one], Format::Json) => return print_json("check", &record(one)),
        (several, Format::Json) => {
            return print_json("check", &Rows { rows: several.iter().map(record).collect() });
        }
        (all, Format::Csv) => csv_table(all),
        ([one], _) => table(arguments, one),
        (several, _) => rows_table(several),
    };
    let mut text = table_text(&table, arguments.format).unwrap_or_default();
    if arguments.format == Format::Table {
        let subjects = answers.iter().map(|answer| &answer.subject);
        text.push_str(&super::output::paragraphs(&assumptions(subjects)));
    }
    print(&text)
}

/// One row an answer, for machines.
fn csv_table(answers: &[Answer]) -> Table {
    let own = [
        "cfl",
        "verdict",
        "monotone",
        "max_gain",
        "growth_per_step",
        "growth_phase",
        "steps_to_double",
        "double_multiplier_phase",
        "within_growth",
    ];
    let columns: Vec<String> = subject_columns()
        .chain(own.map(String::from))
        .chain(limit_columns(""))
        .chain(limit_columns("monotonicity_"))
        .collect();
    let mut table = empty(&columns);
    for answer in answers {
        let record = record(answer);
        let mut cells = subject_cells(&record.subject);
        cells.extend([
            record.cfl.to_string(),
            record.verdict.into(),
            record.monotone.map_or_else(String::new, |monotone| monotone.to_string()),
            number(record.max_gain),
            number(record.growth_per_step),
            phases(record.critical_phase.as_ref()),
            number(record.steps_to_double),
            phases(record.double_multiplier_phase.as_ref()),
            record.within_growth.unwrap_or_default().into(),
        ]);
        cells.extend(limit_cells(Some(&record.stability)));
        cells.extend(limit_cells(record.monotonicity.as_ref()));
        table.push(cells);
    }
    table
}

/// One row an answer, for people.
fn rows_table(answers: &[Answer]) -> Table {
    let labels: Vec<Vec<Label>> = answers
        .iter()
        .map(|answer| {
            let value = shown(&answer.value);
            let caption = format!("{} = {value}", answer.symbol());
            let own = Label { heading: answer.symbol(), cell: value, caption };
            let mut labels = answer.subject.labels();
            labels.retain(|label| label.heading != answer.sought.parameter);
            labels.push(own);
            labels
        })
        .collect();
    let varying = varying(&labels);
    let shared = labels[0].iter().filter(|label| !varying.contains(&label.heading));
    let caption = shared.map(|label| label.caption.clone()).collect::<Vec<_>>().join(", ");
    let mut columns: Vec<(&str, Align)> = varying
        .iter()
        .map(|heading| {
            let label = labels.iter().flatten().find(|label| label.heading == *heading);
            (heading.as_str(), Label::align(label))
        })
        .collect();
    columns.extend([
        ("verdict", Align::Left),
        ("monotone", Align::Left),
        ("of the limit", Align::Right),
        ("growth per step", Align::Right),
        ("steps to double", Align::Right),
        ("wave", Align::Right),
    ]);
    let mut table = Table::new(caption, &columns);
    for (answer, labels) in answers.iter().zip(&labels) {
        let found = &answer.found;
        let cell = |heading: &String| {
            let label = labels.iter().find(|label| label.heading == *heading);
            label.map_or_else(|| "–".to_string(), |label| label.cell.clone())
        };
        let mut cells: Vec<String> = varying.iter().map(cell).collect();
        let limit = found.stable_set.limit();
        let of_limit = match limit.is_positive() && limit.value().is_finite() {
            true => significant(to_f64(&answer.value) / limit.value(), 5),
            false => "–".into(),
        };
        let wave = found.critical_wave().as_ref().map_or_else(|| "–".into(), wave_words);
        cells.extend([
            found.verdict.name().into(),
            monotone_word(found.monotone).into(),
            of_limit,
            significant(found.growth.per_step, 4),
            found.steps_to_double.map_or_else(|| "–".into(), |steps| significant(steps, 4)),
            wave,
        ]);
        table.push(cells);
    }
    table
}

fn monotone_word(monotone: Option<bool>) -> &'static str {
    match monotone {
        Some(true) => "yes",
        Some(false) => "no",
        None => "–",
    }
}

/// One answer line by line.
fn table(arguments: &Arguments, answer: &Answer) -> Table {
    let found = &answer.found;
    let symbol = answer.symbol();
    let symbol = symbol.as_str();
    let labels = answer.subject.labels();
    let captions: Vec<String> = labels
        .iter()
        .filter(|label| label.heading != answer.sought.parameter)
        .map(|label| label.caption.clone())
        .chain([format!("{symbol} = {}", shown(&answer.value))])
        .collect();
    let caption = format!("{}: {}", captions.join(", "), headline(found));
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Left)]);
    let limit = found.stable_set.limit();
    let value = to_f64(&answer.value);
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    add("verdict", found.verdict.name().into());
    if let Some(monotone) = found.monotone {
        add("monotone", if monotone { "yes" } else { "no" }.into());
    }
    add("stability limit", describe(&limit, symbol, None));
    if super::limit_text::has_gaps(&found.stable_set) {
        add("stable set", super::limit_text::set(&found.stable_set));
    }
    if limit.is_positive() && limit.value().is_finite() {
        if let Some((spacing, deviation)) = answer.subject.other_units(limit.value()) {
            add("the same per spacing, c Δt/Δ", significant(spacing, 8));
            add("per kernel deviation, c Δt/σ", significant(deviation, 8));
        }
        add(&format!("{symbol} / limit"), significant(value / limit.value(), 8));
    }
    if let Some(reason) = super::limit_text::reason(&limit) {
        add("why", reason);
    }
    if let Some(set) = &found.monotone_set {
        add("monotonicity limit", describe(&set.limit(), symbol, None));
    }
    add("largest |z|", significant(1.0 + found.growth.per_step, 12));
    let sampled = if found.growth.sampled { " (of sampled waves)" } else { "" };
    add("growth per step", format!("{}{sampled}", significant(found.growth.per_step, 6)));
    if let Some(steps) = found.steps_to_double {
        add("steps to double", significant(steps, 4));
        let wave = &found.growth.wave;
        let wave = match wave.phases().iter().all(|phase| *phase == 0.0) {
            true => "the mean itself (φ = 0)".into(),
            false => wave_and_phase(wave),
        };
        add("fastest growing wave", wave);
    }
    if let Some(wave) = &found.double_multiplier {
        let wave = wave_and_phase(wave);
        add("double multiplier", format!("{wave}: its amplitude grows like the number of steps"));
    }
    if let Some(wave) = &found.drift {
        let wave = wave_and_phase(wave);
        add(
            "nothing pulls back",
            format!("{wave}: a disturbance drifts, at least in proportion to the steps"),
        );
    }
    if let (Some(within), Some(growth)) = (answer.within, &arguments.growth) {
        let name = format!("growth within {}", significant(to_f64(growth), 3));
        let word = match within {
            Some(true) => "yes",
            Some(false) => "no",
            None => "undecided",
        };
        add(&name, word.into());
    }
    table
}

fn headline(found: &Check) -> String {
    let verdict = words(found.verdict);
    match (found.verdict.is_stable(), found.monotone) {
        (true, Some(true)) => format!("{verdict}, monotone"),
        (true, Some(false)) => format!("{verdict}, not monotone"),
        _ => verdict.into(),
    }
}

/// The verdict as people say it.
fn words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stable",
        Verdict::Marginal => "marginally stable",
        Verdict::WeaklyUnstable => "weakly unstable",
        Verdict::Unstable => "unstable",
        Verdict::Undecided => "undecided",
    }
}
