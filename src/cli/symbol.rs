//! `courant symbol`.

use super::columns::{empty, subject_cells, subject_columns};
use super::output::{Format, paragraphs, print, print_json, table_text};
use super::subject::{Defaults, Kind, SubjectOptions, assumptions};
use super::{Failure, Outcome};
use clap::Args;
use courant::analysis::scheme::{LetterKind, OneStep};
use courant::reports::record::{DerivativeRecord, SymbolRecord};
use courant::reports::symbol::{Order, Symbol, coefficients};
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
    /// How many terms of the modified equation; without it those that show the first errors in amplitude and in speed.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=30))]
    terms: Option<u8>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

#[derive(Debug, Serialize)]
struct Rows {
    rows: Vec<SymbolRecord>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let subjects = arguments.subject.subjects(&Defaults::default())?;
    let answers: Vec<Symbol> = subjects
        .into_par_iter()
        .map(|subject| Ok(Symbol::new(subject, arguments.terms.map(usize::from))?))
        .collect::<Result<_, Failure>>()?;
    let records = || answers.iter().map(|answer| answer.record(arguments.matrix));
    match (arguments.format, answers.as_slice()) {
        (Format::Json, [one]) => print_json("symbol", &one.record(arguments.matrix)),
        (Format::Json, _) => print_json("symbol", &Rows { rows: records().collect() }),
        (Format::Latex, _) => {
            let equation = |answer: &Symbol| {
                let order = answer.order.as_ref().ok()?;
                Some(order.series.equation_latex(order.terms.as_ref()?))
            };
            let lines: Vec<String> = answers
                .iter()
                .zip(records())
                .flat_map(|(answer, record)| std::iter::once(record.latex).chain(equation(answer)))
                .collect();
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

/// One row a neighbour, or one a scheme that has no stencil of one step.
fn csv_table(answers: &[(&Symbol, SymbolRecord)]) -> Table {
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
fn stencil_table(answer: &Symbol, one: &OneStep) -> Table {
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

fn title(answer: &Symbol) -> String {
    let labels = answer.subject.labels();
    labels.iter().map(|label| label.caption.clone()).collect::<Vec<_>>().join(", ")
}

fn text(answer: &Symbol, format: Format) -> String {
    let mut text = match &answer.one_step {
        Some(one) => table_text(&stencil_table(answer, one), format).unwrap_or_default(),
        None => format!("{}\n", title(answer)),
    };
    if format != Format::Table {
        return text;
    }
    let characteristic = answer.characteristic_text();
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
            LetterKind::Constant | LetterKind::Quotient => "a number within a radius",
            LetterKind::SquareRoot(_) => continue,
        };
        lines.push(format!("{} stands for {what}", letter.name));
    }
    text.push_str(&paragraphs(&lines));
    let mut facts: Vec<(&str, String)> = Vec::new();
    let equations = answer.subject.file.equations.text.trim();
    facts.push(("equations", super::list::in_a_line(equations)));
    if !answer.subject.file.source.is_empty() {
        facts.push(("source", answer.subject.file.source.clone()));
    }
    facts.push(("time levels", (answer.characteristic.len()).to_string()));
    facts.push(("keeps constants", if answer.keeps_constants { "yes" } else { "no" }.into()));
    match &answer.order {
        Err(reason) => facts.push(("order", format!("none: {reason}"))),
        Ok(order) => facts.extend(accuracy_facts(answer, order)),
    }
    let facts: Vec<String> =
        facts.into_iter().map(|(name, value)| format!("{name:<18} {value}")).collect();
    text.push_str(&paragraphs(&facts));
    if answer.subject.kind == Kind::Method {
        text.push_str(&paragraphs(&assumptions(std::iter::once(&answer.subject))));
    }
    text
}

/// What is told of the order.
fn accuracy_facts(answer: &Symbol, order: &Order) -> Vec<(&'static str, String)> {
    let against = match &answer.subject.file.exact {
        Some(exact) => format!("one exact step, exp({exact})"),
        None => "its own leading term, as no exact step is stated".into(),
    };
    let mut facts = vec![("order", order.text()), ("compared with", against)];
    for (name, error) in [("dissipation", order.dissipation()), ("dispersion", order.dispersion())]
    {
        let DerivativeRecord::Line(power) = (match &error {
            Some(error) => error.derivative.clone(),
            None => continue,
        }) else {
            continue;
        };
        let coefficient = error.map_or_else(String::new, |error| error.coefficient);
        facts.push((name, format!("from {coefficient} Δx^{power} ∂x^{power} u on")));
    }
    facts.extend(order.special_text().map(|text| ("error vanishes at", text)));
    match (&order.terms, order.equation_reason()) {
        (Some(terms), _) => facts.push(("modified equation", order.series.equation_text(terms))),
        (None, Some(reason)) => facts.push(("modified equation", format!("none: {reason}"))),
        _ => {}
    }
    facts
}
