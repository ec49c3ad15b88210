//! `courant symbol`.

use super::columns::{empty, subject_cells, subject_columns};
use super::output::{Format, paragraphs, print, print_json, table_text};
use super::subject::{Defaults, Kind, Subject, SubjectOptions, assumptions};
use super::{Failure, Outcome};
use clap::Args;
use courant::analysis::exact::laurent::{Laurent, Variable};
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::scheme::{LetterKind, OneStep, Step};
use courant::analysis::waves::consistency::{Consistency, consistency};
use courant::reports::number::significant;
use courant::reports::record::{CoefficientRecord, OrderRecord, SymbolRecord};
use courant::reports::table::{Align, Table};
use rayon::prelude::*;
use serde::Serialize;

/// The longest polynomial that is shown to people.
const LONGEST: usize = 1500;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    subject: SubjectOptions,
    /// Also the matrix P of P U = 0, by rows, in JSON.
    #[arg(long)]
    matrix: bool,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// Everything about one subject.
struct Answer {
    subject: Subject,
    step: Step,
    parameter: Option<String>,
    one_step: Option<OneStep>,
    consistency: Option<Consistency>,
    /// `χ` by powers of z, ascending.
    characteristic: Vec<Laurent>,
    keeps_constants: bool,
}

#[derive(Debug, Serialize)]
struct Rows {
    rows: Vec<SymbolRecord>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let subjects = arguments.subject.subjects(&Defaults::default())?;
    let answers: Vec<Answer> =
        subjects.into_par_iter().map(answer).collect::<Result<_, Failure>>()?;
    let records = || answers.iter().map(|answer| record(arguments, answer));
    match (arguments.format, answers.as_slice()) {
        (Format::Json, [one]) => print_json("symbol", &record(arguments, one)),
        (Format::Json, _) => print_json("symbol", &Rows { rows: records().collect() }),
        (Format::Latex, _) => {
            let lines: Vec<String> = records().map(|record| record.latex).collect();
            print(&format!("{}\n", lines.join("\n")))
        }
        (Format::Csv, _) => {
            print(&csv_table(&answers.iter().zip(records()).collect::<Vec<_>>()).to_csv())
        }
        (format, _) => {
            let texts: Vec<String> = answers.iter().map(|answer| text(answer, format)).collect();
            print(&texts.join("\n"))
        }
    }
}

fn answer(subject: Subject) -> Result<Answer, Failure> {
    // Parameters may stay open here: there is nothing to be decided.
    let (step, parameter) = match subject.sought(true) {
        Ok(sought) => {
            let step = match &sought.value {
                Some(value) => sought.step.with(&sought.parameter, value),
                None => Ok(sought.step),
            };
            (step.map_err(|error| subject.failure(&error))?, Some(sought.parameter))
        }
        Err(failure) => match subject.with_values() {
            Ok(step) => (step, None),
            Err(_) => return Err(failure),
        },
    };
    let failed = |error| subject.failure(&error);
    let chi = step.characteristic().map_err(failed)?;
    // The newest level without shifts, where that is possible.
    let leading = chi.coefficients(Variable::TIME).pop().unwrap_or_default();
    let shifted = (0..step.dimension())
        .map(Variable::axis)
        .fold(chi, |chi, axis| chi.shifted(axis, -leading.range(axis).map_or(0, |(low, _)| low)));
    let characteristic = shifted.coefficients(Variable::TIME);
    let one_step = parameter.as_ref().and_then(|name| step.one_step(name));
    // Orders are compared with one exact step, which the catalogue states: here that of advection.
    let exact = subject.file.exact.as_deref();
    let advected = parameter.as_ref().filter(|name| exact == Some(&format!("-I*{name}*phi")));
    let consistency = advected.and_then(|name| consistency(&step, name));
    let keeps_constants = step.keeps_constants().map_err(failed)?;
    Ok(Answer { subject, step, parameter, one_step, consistency, characteristic, keeps_constants })
}

fn record(arguments: &Arguments, answer: &Answer) -> SymbolRecord {
    let step = &answer.step;
    let matrix = || {
        let row = |row: &Vec<Laurent>| row.iter().map(|entry| step.text(entry)).collect();
        step.matrix().rows().iter().map(row).collect()
    };
    let characteristic = characteristic_latex(answer);
    let one = answer.one_step.as_ref();
    SymbolRecord {
        subject: answer.subject.record(step, answer.parameter.as_deref()),
        equations: answer.subject.file.equations.text.trim().into(),
        coefficients: one.map(coefficients),
        exact: one.map(OneStep::is_exact),
        text: one.map_or_else(|| characteristic_text(answer), OneStep::to_text),
        latex: one.map_or_else(|| characteristic.clone(), OneStep::to_latex),
        characteristic,
        characteristic_text: characteristic_text(answer),
        degree: answer.characteristic.len() - 1,
        unknowns: step.unknowns().to_vec(),
        matrix: arguments.matrix.then(matrix),
        keeps_constants: answer.keeps_constants,
        order: answer.consistency.as_ref().map(|found| OrderRecord {
            space: None,
            time: None,
            overall: found.order,
        }),
        long_wave_speed: answer.consistency.as_ref().map(|found| to_f64(&found.speed_ratio)),
    }
}

/// The stencil: every neighbour from the first to the last.
fn coefficients(one: &OneStep) -> Vec<CoefficientRecord> {
    let offsets = || one.coefficients.iter().map(|(offset, ..)| *offset);
    let (low, high) = (offsets().min().unwrap_or(0), offsets().max().unwrap_or(0));
    let shown =
        |value: &Rational| if one.is_exact() { to_text(value) } else { to_f64(value).to_string() };
    let record = |offset| {
        let polynomial = one.coefficient(offset);
        let polynomial = polynomial.coefficients().iter().map(shown).collect();
        CoefficientRecord { offset, polynomial }
    };
    (low..=high).map(record).collect()
}

/// `χ(z) = 0` in powers of z, the highest first; `write` sets a coefficient, `power` a power of z.
fn in_powers(
    answer: &Answer,
    write: impl Fn(&Laurent) -> String,
    power: impl Fn(usize) -> String,
) -> String {
    let terms: Vec<String> = answer
        .characteristic
        .iter()
        .enumerate()
        .rev()
        .filter(|(_, coefficient)| !coefficient.is_zero())
        .map(|(exponent, coefficient)| {
            let text = write(coefficient);
            let text = match (coefficient.as_monomial().is_some(), exponent) {
                (true, 1..) if text == "1" => String::new(),
                (true, _) => text,
                (false, _) => format!("({text})"),
            };
            match exponent {
                0 => text,
                _ if text.is_empty() => power(exponent),
                _ => format!("{text} {}", power(exponent)),
            }
        })
        .collect();
    format!("{} = 0", terms.join(" + ").replace("+ -", "- "))
}

fn characteristic_text(answer: &Answer) -> String {
    let power = |exponent| if exponent == 1 { "z".into() } else { format!("z^{exponent}") };
    in_powers(answer, |coefficient| answer.step.text(coefficient), power)
}

/// The same in LaTeX.
fn characteristic_latex(answer: &Answer) -> String {
    let write = |coefficient: &Laurent| latex(&answer.step.text(coefficient));
    in_powers(answer, write, |exponent| format!("z^{{{exponent}}}").replace("^{1}", ""))
}

/// A polynomial as it is printed, in LaTeX: exponents in braces, Greek letters by their commands.
fn latex(text: &str) -> String {
    let word = |word: &str| {
        let (base, exponent) = word.split_once('^').unwrap_or((word, ""));
        let base = match base {
            "alpha" | "beta" | "gamma" | "delta" | "epsilon" | "eta" | "theta" | "kappa"
            | "lambda" | "mu" | "nu" | "omega" | "pi" | "rho" | "sigma" | "tau" => {
                format!("\\{base}")
            }
            _ if base.len() > 1 && base.chars().all(|c| c.is_ascii_alphabetic()) => {
                format!("\\mathrm{{{base}}}")
            }
            _ => base.into(),
        };
        if exponent.is_empty() { base } else { format!("{base}^{{{exponent}}}") }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// One row a neighbour, or one a scheme that has no stencil of one step.
fn csv_table(answers: &[(&Answer, SymbolRecord)]) -> Table {
    let own = ["offset", "power", "coefficient", "keeps_constants", "order", "characteristic"];
    let columns: Vec<String> = subject_columns().chain(own.map(String::from)).collect();
    let mut table = empty(&columns);
    for (_, record) in answers {
        let order = record.order.as_ref().and_then(|order| order.overall);
        let mut push = |offset: String, power: String, coefficient: String| {
            let mut cells = subject_cells(&record.subject);
            cells.extend([offset, power, coefficient, record.keeps_constants.to_string()]);
            cells.push(order.map_or_else(String::new, |order| order.to_string()));
            cells.push(record.characteristic_text.clone());
            table.push(cells);
        };
        match &record.coefficients {
            None => push(String::new(), String::new(), String::new()),
            Some(all) => {
                for coefficient in all {
                    for (power, value) in coefficient.polynomial.iter().enumerate() {
                        push(coefficient.offset.to_string(), power.to_string(), value.clone());
                    }
                }
            }
        }
    }
    table
}

/// The stencil as a table.
fn stencil_table(answer: &Answer, one: &OneStep) -> Table {
    let rows = coefficients(one);
    let powers = rows.iter().map(|row| row.polynomial.len()).max().unwrap_or(0);
    let parameter = &one.parameter;
    let names: Vec<String> = (0..powers)
        .map(|power| match power {
            0 => "1".into(),
            1 => parameter.clone(),
            _ => format!("{parameter}^{power}"),
        })
        .collect();
    let mut columns = vec![("offset", Align::Right)];
    columns.extend(names.iter().map(|name| (name.as_str(), Align::Right)));
    let caption =
        format!("{}: coefficients of the neighbours in powers of {parameter}", title(answer));
    let mut table = Table::new(caption, &columns);
    for row in rows {
        let value = |power: usize| row.polynomial.get(power).cloned().unwrap_or_else(|| "0".into());
        table.push([row.offset.to_string()].into_iter().chain((0..powers).map(value)));
    }
    table
}

fn title(answer: &Answer) -> String {
    let labels = answer.subject.labels();
    labels.iter().map(|label| label.caption.clone()).collect::<Vec<_>>().join(", ")
}

fn text(answer: &Answer, format: Format) -> String {
    let mut text = match &answer.one_step {
        Some(one) => table_text(&stencil_table(answer, one), format).unwrap_or_default(),
        None => format!("{}\n", title(answer)),
    };
    if format != Format::Table {
        return text;
    }
    let characteristic = characteristic_text(answer);
    let shown = match characteristic.len() <= LONGEST {
        true => format!("χ(z) = {}", characteristic.trim_end_matches(" = 0")),
        false => "χ(z) is long: see --format json".into(),
    };
    let mut lines: Vec<String> = Vec::new();
    lines.extend(answer.one_step.as_ref().map(OneStep::to_text));
    if answer.one_step.is_none() || answer.subject.kernel.is_none() {
        let shifts: Vec<&str> = match answer.step.dimension() {
            1 => vec!["E = e^(iφ)"],
            several => ["E_1 = e^(iφ_x)", "E_2 = e^(iφ_y)", "E_3 = e^(iφ_z)"][..several].to_vec(),
        };
        lines.push(format!("{shown}, {}", shifts.join(", ")));
    }
    for (_, letter) in answer.step.names().letters().filter(|_| answer.one_step.is_none()) {
        let what = match &letter.kind {
            LetterKind::Versines => "Σ_k c_k (1 - cos kφ)/s, s = (1 - cos φ)/2",
            LetterKind::Sines => "Σ_k c_k sin kφ/sin φ",
            LetterKind::Constant => "a number within a radius",
            LetterKind::SquareRoot(_) => continue,
        };
        lines.push(format!("{} stands for {what}", letter.name));
    }
    text.push_str(&paragraphs(&lines));
    let mut facts: Vec<(&str, String)> = Vec::new();
    let equations = answer.subject.file.equations.text.trim();
    facts.push(("equations", equations.lines().map(str::trim).collect::<Vec<_>>().join("; ")));
    if !answer.subject.file.source.is_empty() {
        facts.push(("source", answer.subject.file.source.clone()));
    }
    facts.push(("time levels", (answer.characteristic.len()).to_string()));
    facts.push(("keeps constants", if answer.keeps_constants { "yes" } else { "no" }.into()));
    if let Some(found) = &answer.consistency {
        let order = match found.order {
            Some(0) => format!(
                "0: long waves travel at {} times the true speed",
                significant(to_f64(&found.speed_ratio), 8)
            ),
            Some(order) => order.to_string(),
            None => "none: a constant is not kept, the mean drifts".into(),
        };
        facts.push(("order (advection)", order));
    }
    let facts: Vec<String> =
        facts.into_iter().map(|(name, value)| format!("{name:<18} {value}")).collect();
    text.push_str(&paragraphs(&facts));
    if answer.subject.kind == Kind::Method {
        text.push_str(&paragraphs(&assumptions(std::iter::once(&answer.subject))));
    }
    text
}
