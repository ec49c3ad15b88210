//! Limits for people: a row each, or spaces against integrators.

use super::remarks::remarks;
use super::{Answer, Arguments, budgets};
use crate::cli::limit_text::{DEFAULT_DIGITS, digits, exact, wave};
use crate::cli::output::{Format, WIDTH, paragraphs, table_text};
use crate::cli::subject::{Kind, Label, row_name, varying};
use courant::analysis::exact::rational::{Rational, decimal_below, to_f64};
use courant::analysis::stability::Limit;
use courant::reports::number::significant;
use courant::reports::table::{Align, Cell, Table};
use num_traits::Signed;

/// Digits of a cell where two lists meet, and of growth budgets.
const FEW_DIGITS: usize = 6;

/// The table or tables in the format asked for, with the remarks below.
pub(super) fn text(arguments: &Arguments, answers: &[Answer], format: Format) -> String {
    let labels: Vec<Vec<Label>> = answers.iter().map(|answer| answer.subject.labels()).collect();
    let varying = varying(&labels);
    let two_way = two_way(arguments, answers, &labels, &varying, format);
    let is_two_way = two_way.is_some();
    let tables =
        two_way.unwrap_or_else(|| vec![fitting(arguments, answers, &labels, &varying, format)]);
    let shown = |table: &Table| table_text(table, format).unwrap_or_default();
    let mut text = tables.iter().map(shown).collect::<Vec<_>>().join("\n");
    if format == Format::Table {
        let name = |answer: &Answer| row_name(&answer.subject.labels(), &varying);
        let mut lines = if is_two_way { exact_forms(answers, name) } else { Vec::new() };
        lines.extend(remarks(answers, name, !is_two_way).lines());
        text.push_str(&paragraphs(&lines));
    }
    text
}

/// The closed forms that cells have no room for.
fn exact_forms(answers: &[Answer], name: impl Fn(&Answer) -> String) -> Vec<String> {
    let mut forms = Vec::new();
    let mut equations = 0;
    for answer in answers {
        let limit = &answer.stability;
        match limit.closed_form() {
            Some(form) if form.contains(['(', '/']) && form.len() <= 24 => {
                forms.push(format!("{} {form}", name(answer)));
            }
            None if limit.equation().is_some() => equations += 1,
            _ => {}
        }
    }
    let mut lines = Vec::new();
    if !forms.is_empty() {
        lines.push(format!("exactly: {}", forms.join("; ")));
    }
    if equations > 0 {
        lines.push(format!("{equations} more are roots of known polynomials: see --format json"));
    }
    lines
}

/// What all rows share.
fn caption(answers: &[Answer], labels: &[Vec<Label>], varying: &[String]) -> String {
    let first = &answers[0];
    let same = answers.iter().all(|answer| answer.sought.parameter == first.sought.parameter);
    let symbol = if same {
        first.subject.symbol(&first.sought.parameter)
    } else {
        "the parameter sought".into()
    };
    let shared = labels[0].iter().filter(|label| !varying.contains(&label.heading));
    let shared: Vec<String> = shared.map(|label| label.caption.clone()).collect();
    let evidence = first.stability.evidence().name();
    let all = match answers.iter().all(|answer| answer.stability.evidence().name() == evidence) {
        true => format!("; all {evidence}"),
        false => String::new(),
    };
    let all = if answers.len() == 1 { format!("; {evidence}") } else { all };
    [vec![format!("Limits of {symbol}")], shared].concat().join(", ") + &all
}

/// How much is left out so that a table fits.
const LEVELS: usize = 5;

/// The fullest table that fits.
fn fitting(
    arguments: &Arguments,
    answers: &[Answer],
    labels: &[Vec<Label>],
    varying: &[String],
    format: Format,
) -> Table {
    let mut level = 0;
    loop {
        let table = rows(arguments, answers, labels, varying, level);
        if format != Format::Table || level == LEVELS || table.width() <= WIDTH {
            return table;
        }
        level += 1;
    }
}

/// A row an answer.
fn rows(
    arguments: &Arguments,
    answers: &[Answer],
    labels: &[Vec<Label>],
    varying: &[String],
    level: usize,
) -> Table {
    let headings: Vec<String> = varying.to_vec();
    let evidence = answers[0].stability.evidence().name();
    let mixed = answers.iter().any(|answer| answer.stability.evidence().name() != evidence);
    let monotone = answers.iter().any(|answer| answer.monotonicity.is_some());
    let method = answers.iter().all(|answer| answer.subject.kind == Kind::Method);
    // A closed form has a column where there is one, and goes below when there is no room.
    let has_exact = |limit: &Limit| limit.exact().is_some() || limit.equation().is_some();
    let exact_column = level < 4 && answers.iter().any(|answer| has_exact(&answer.stability));
    let exact_monotone =
        level < 1 && answers.iter().any(|a| a.monotonicity.as_ref().is_some_and(has_exact));
    let mut columns: Vec<(String, Align)> = headings
        .iter()
        .map(|heading| {
            let label = labels.iter().flatten().find(|label| label.heading == *heading);
            (heading.clone(), Label::align(label))
        })
        .collect();
    let mut add = |name: &str, align: Align, when: bool| {
        if when {
            columns.push((name.into(), align));
        }
    };
    add("stable up to", Align::Right, true);
    add("exactly", Align::Right, exact_column);
    add("c Δt/Δ", Align::Right, method);
    add("c Δt/σ", Align::Right, method && level < 3);
    add("evidence", Align::Left, mixed);
    add("binding wave", Align::Left, true);
    add("how it ends", Align::Left, method && level < 2);
    add("monotone up to", Align::Right, monotone);
    add("exactly", Align::Right, monotone && exact_monotone);
    for growth in budgets(arguments) {
        columns.push((budget_name(growth), Align::Right));
    }
    let columns: Vec<(&str, Align)> =
        columns.iter().map(|(name, align)| (name.as_str(), *align)).collect();
    let mut table = Table::new(caption(answers, labels, varying), &columns);
    for (answer, labels) in answers.iter().zip(labels) {
        let limit = &answer.stability;
        let mut cells: Vec<Cell> = Vec::new();
        for heading in &headings {
            let label = labels.iter().find(|label| label.heading == *heading);
            cells.push(label.map_or("–", |label| label.cell.as_str()).into());
        }
        let mut add = |cell: Cell, when: bool| {
            if when {
                cells.push(cell);
            }
        };
        let units = answer.subject.other_units(limit.value()).unwrap_or((f64::NAN, f64::NAN));
        add(digits(limit, arguments.digits, DEFAULT_DIGITS).into(), true);
        add(exact(limit), exact_column);
        add(significant(units.0, 6).into(), method);
        add(significant(units.1, 6).into(), method && level < 3);
        add(limit.evidence().name().into(), mixed);
        add(wave(limit).into(), true);
        let end = limit.binding().map_or_else(|| "–".into(), |binding| binding.name());
        add(end.into(), method && level < 2);
        let monotonicity = answer.monotonicity.as_ref();
        let text =
            monotonicity.map_or("–".into(), |m| digits(m, arguments.digits, DEFAULT_DIGITS));
        add(text.into(), monotone);
        add(monotonicity.map_or("–".into(), exact), monotone && exact_monotone);
        let few = if level > 0 { FEW_DIGITS } else { DEFAULT_DIGITS };
        cells.extend(
            answer.growth.iter().map(|(_, limit)| digits(limit, arguments.digits, few).into()),
        );
        table.push(cells);
    }
    table
}

/// A budget may be smaller than any f64.
fn budget_name(growth: &Rational) -> String {
    let text = match to_f64(growth) {
        0.0 if growth.is_positive() => decimal_below(growth, 3),
        rounded => significant(rounded, 3),
    };
    format!("growth {text}")
}

/// Where exactly a list of schemes and one of integrators were given: schemes down, integrators across.
fn two_way(
    arguments: &Arguments,
    answers: &[Answer],
    labels: &[Vec<Label>],
    varying: &[String],
    format: Format,
) -> Option<Vec<Table>> {
    let [down, across] = varying else { return None };
    if across != "integrator" || down == "kernel" || !budgets(arguments).is_empty() {
        return None;
    }
    let cell = |labels: &[Label], heading: &str| {
        let found = labels.iter().find(|label| label.heading == heading);
        found.map_or_else(|| "–".to_string(), |label| label.cell.clone())
    };
    let mut names: [Vec<String>; 2] = [Vec::new(), Vec::new()];
    for labels in labels {
        for (list, heading) in names.iter_mut().zip([down, across]) {
            let name = cell(labels, heading);
            if !list.contains(&name) {
                list.push(name);
            }
        }
    }
    let [rows, columns] = &names;
    let caption = caption(answers, labels, varying);
    let table = |columns: &[String], caption: String| {
        let heads: Vec<(&str, Align)> = std::iter::once((down.as_str(), Align::Left))
            .chain(columns.iter().map(|name| (name.as_str(), Align::Right)))
            .collect();
        let mut table = Table::new(caption, &heads);
        for row in rows {
            let cells = columns.iter().map(|column| {
                let is_it = |labels: &Vec<Label>| {
                    cell(labels, down) == *row && cell(labels, across) == *column
                };
                let found = labels.iter().position(is_it).map(|index| &answers[index].stability);
                found.map_or("–".into(), |limit| digits(limit, arguments.digits, FEW_DIGITS))
            });
            table.push([row.clone()].into_iter().chain(cells));
        }
        table
    };
    // As many columns beside one another as fit.
    let mut tables = Vec::new();
    let mut rest = columns.as_slice();
    while !rest.is_empty() {
        let fits = |count: &usize| {
            format != Format::Table || table(&rest[..*count], String::new()).width() <= WIDTH
        };
        let count = (1..=rest.len()).rev().find(fits).unwrap_or(1);
        let caption = if tables.is_empty() { caption.clone() } else { "…".into() };
        tables.push(table(&rest[..count], caption));
        rest = &rest[count..];
    }
    Some(tables)
}
