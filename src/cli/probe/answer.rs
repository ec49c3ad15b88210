//! What was found about the user's program.

use super::{Arguments, Plan};
use crate::cli::limit_text::{describe, direction, exact_below, has_gaps, set, wavelength};
use crate::cli::output::{Format, paragraphs, print, print_json, print_record, table_text};
use crate::cli::subject::shown;
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{to_f64, to_text};
use courant::analysis::scheme::measurement::{Base, Probed};
use courant::analysis::stability::Evidence;
use courant::reports::number::significant;
use courant::reports::record::ProbeRecord;
use courant::reports::table::{Align, Table};

/// The longest equation that is shown.
const LONGEST_EQUATION: usize = 600;

/// Why nothing is known of a program, or it is no scheme, in one line.
pub struct Refusal(pub String);

fn record(arguments: &Arguments, plan: &Plan, answer: Result<&Probed, &Refusal>) -> ProbeRecord {
    ProbeRecord {
        command: arguments.command.clone(),
        parameters: plan.fixed.iter().map(|(name, value)| (name.clone(), to_text(value))).collect(),
        ..ProbeRecord::new(&plan.probe, answer.map_err(|refusal| refusal.0.as_str()))
    }
}

/// The answer no, with its reason.
pub fn refuse(arguments: &Arguments, plan: &Plan, refusal: &Refusal) -> Result<Outcome, Failure> {
    match arguments.format {
        Format::Table => print(&format!("no: {}\n", refusal.0))?,
        format => {
            let mut table = Table::new("No", &[("reason", Align::Left)]);
            table.push([refusal.0.as_str()]);
            print_record("probe", &record(arguments, plan, Err(refusal)), &table, format)?
        }
    };
    Ok(Outcome::No)
}

pub fn show(arguments: &Arguments, plan: &Plan, answer: &Probed) -> Result<Outcome, Failure> {
    match arguments.format {
        Format::Json => print_json("probe", &record(arguments, plan, Ok(answer)))?,
        format @ (Format::Table | Format::Markdown | Format::Latex) => {
            let mut text = table_text(&table(arguments, plan, answer), format).unwrap_or_default();
            if format == Format::Table {
                text.push_str(&paragraphs(&remarks(plan, answer)));
            }
            print(&text)?
        }
        format => {
            let table = table(arguments, plan, answer);
            print_record("probe", &record(arguments, plan, Ok(answer)), &table, format)?
        }
    };
    let accepted = answer.judgements.iter().all(|(_, found)| found.verdict.is_stable());
    Ok(if accepted { Outcome::Yes } else { Outcome::No })
}

fn table(arguments: &Arguments, plan: &Plan, answer: &Probed) -> Table {
    let measured = &answer.measured;
    let size: Vec<String> =
        plan.probe.experiment.layout.size.iter().map(usize::to_string).collect();
    let settings = plan.fixed.iter().map(|(name, value)| format!(", {name} = {}", shown(value)));
    let caption = format!(
        "{}, measured on {} cells{}",
        arguments.command.join(" "),
        size.join(" × "),
        settings.collect::<String>()
    );
    let mut table = Table::new(caption, &[("", Align::Left), ("", Align::Left)]);
    let mut add = |name: &str, value: String| table.push([name.to_string(), value]);
    let linear = match plan.probe.experiment.base {
        Base::Zero if answer.source > 0.0 => "linear, with a source that is left out",
        Base::Zero => "linear",
        Base::About(_) => "linearised about the state given",
    };
    let count = measured.terms.len();
    let plural = if count == 1 { "" } else { "s" };
    add("step", format!("{linear}, the same everywhere, {count} coefficient{plural}"));
    let symbol = measured.parameter.as_deref().unwrap_or_default();
    if let Some(stable) = &answer.stable_set {
        let limit = stable.limit();
        add("stability limit", describe(&limit, symbol, None));
        if has_gaps(stable) {
            add("stable set", set(stable));
        }
    }
    if let Some(monotone) = &answer.monotone_set {
        add("monotonicity limit", describe(&monotone.limit(), symbol, None));
    }
    for (value, found) in &answer.judgements {
        let name = match value {
            Some(value) => format!("{symbol} = {}", shown(value)),
            None => "verdict".into(),
        };
        let wave = match direction(&found.wave) {
            // Of waves that do not grow the largest is named by rounding.
            _ if found.verdict.is_stable() => String::new(),
            _ if found.wave.phases().iter().all(|phase| *phase == 0.0) => " (the mean)".into(),
            Some(direction) => format!(" ({} Δ {direction})", wavelength(&found.wave)),
            None => format!(" ({} Δ)", wavelength(&found.wave)),
        };
        let largest = significant(found.largest, 8);
        add(&name, format!("{}, largest |z| {largest}{wave}", found.verdict.name()));
    }
    table
}

fn remarks(plan: &Plan, answer: &Probed) -> Vec<String> {
    let measured = &answer.measured;
    let mut remarks = Vec::new();
    for (equation, unknown) in measured.equations().into_iter().zip(measured.step.unknowns()) {
        remarks.push(if equation.len() > LONGEST_EQUATION {
            format!("The equation of {unknown} is long: see --format json.")
        } else {
            equation
        });
    }
    let share = significant(plan.probe.experiment.tolerance, 2);
    let of = match &measured.parameter {
        Some(name) => {
            let verified = measured.verifications;
            format!(
                "Coefficients measured at {} values of {name} and fitted as polynomials with {verified} or more of them left to verify",
                answer.values.len()
            )
        }
        None => "Coefficients measured once".into(),
    };
    remarks.push(if measured.recognised {
        format!(
            "{of}; recognised as fractions to {share} of the largest. What is said of the fractions is exact, that they are the program's is measured."
        )
    } else {
        format!(
            "{of}; not all are recognised as fractions to {share} of the largest. They are taken as decimals, and growth up to {} per step counts as none.",
            significant(to_f64(&measured.growth), 2)
        )
    });
    if let (Some(name), None) = (&plan.probe.sought, &measured.parameter) {
        remarks.push(format!("The step does not depend on {name}."));
    }
    if let Some(set) = &answer.stable_set {
        let symbol = measured.parameter.as_deref().unwrap_or_default();
        let limit = set.limit();
        let exact = exact_below(&limit, symbol).filter(|_| measured.recognised);
        remarks.extend(exact.map(|text| format!("The limit: {text}")));
        if !limit.is_included() && limit.is_positive() && limit.evidence() != Evidence::Undecided {
            remarks.push(
                "At the limit itself two multipliers meet on the unit circle: an amplitude may grow like the number of steps.".into(),
            );
        }
        for (from, to) in &set.undecided {
            let (from, to) = (significant(*from, 8), significant(*to, 8));
            remarks.push(format!("Undecided for {symbol} in [{from}, {to}]."));
        }
    }
    if answer.source > 0.0 {
        let source = significant(answer.source, 4);
        remarks.push(format!("A state of zeros becomes up to {source}: this source is left out."));
    }
    remarks
}
