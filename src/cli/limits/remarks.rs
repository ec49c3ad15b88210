//! What the columns of limits cannot say.

use super::Answer;
use crate::cli::limit_text;
use crate::cli::subject::{Kind, assumptions};
use courant::analysis::exact::rational::{decimal_below, integer, ratio, to_text};
use courant::analysis::stability::{Evidence, Refinement};
use courant::reports::number::significant;

/// Names of rows in one remark at most.
const MOST_NAMES: usize = 6;

/// Remarks, each with the rows it is about; rows with the same remark share it.
#[derive(Default)]
pub(super) struct Remarks(Vec<(String, Vec<String>)>);

impl Remarks {
    fn add(&mut self, row: &str, text: String) {
        match self.0.iter_mut().find(|(known, _)| *known == text) {
            Some((_, rows)) if rows.last().is_none_or(|last| last != row) => rows.push(row.into()),
            Some(_) => {}
            None => self.0.push((text, vec![row.into()])),
        }
    }

    /// One line each.
    pub(super) fn lines(&self) -> Vec<String> {
        let line = |(text, rows): &(String, Vec<String>)| {
            let named: Vec<&str> = rows
                .iter()
                .filter(|row| !row.is_empty())
                .take(MOST_NAMES)
                .map(String::as_str)
                .collect();
            let more = rows.len().saturating_sub(MOST_NAMES);
            match (named.is_empty(), more) {
                (true, _) => text.clone(),
                (false, 0) => format!("{}: {text}", named.join("; ")),
                (false, more) => format!("{}; and {more} more: {text}", named.join("; ")),
            }
        };
        self.0.iter().map(line).collect()
    }
}

/// Stretches that touch are one.
fn joined(stretches: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut joined: Vec<(f64, f64)> = Vec::new();
    for &(from, to) in stretches {
        match joined.last_mut() {
            Some(last) if from <= last.1 => last.1 = last.1.max(to),
            _ => joined.push((from, to)),
        }
    }
    joined
}

/// All of them, with the equations that limits solve if wanted; `name` says which row an answer is, nothing where there is only one.
pub(super) fn remarks(
    answers: &[Answer],
    name: impl Fn(&Answer) -> String,
    with_equations: bool,
) -> Remarks {
    let mut remarks = Remarks::default();
    for answer in answers {
        let row = name(answer);
        let symbol = answer.subject.symbol(&answer.sought.parameter);
        let symbol = symbol.as_str();
        let limit = &answer.stability;
        let decided = limit.evidence() != Evidence::Undecided;
        let mut add = |text: String| remarks.add(&row, text);
        if let Some(text) = limit_text::exact_below(limit, &answer.sought.parameter)
            && with_equations
        {
            add(format!("the limit {text}"));
        }
        let monotone = answer.monotonicity.as_ref();
        if let Some(text) =
            monotone.and_then(|limit| limit_text::exact_below(limit, &answer.sought.parameter))
        {
            add(format!("the monotone limit {text}"));
        }
        if answers.len() == 1
            && let Some(reason) = limit_text::reason(limit)
        {
            add(reason);
        }
        if let (Some(binding), true) = (limit.binding(), limit.upper().is_finite()) {
            if binding.whatever_the_step
                && answers.len() == 1
                && answer.subject.kind != Kind::Method
            {
                // Said already.
            } else if binding.whatever_the_step {
                let force = match answer.subject.kind {
                    Kind::Method => ": its restoring force has the wrong sign",
                    _ => "",
                };
                add(format!("some wave is unstable whatever the step{force}"));
            } else if !limit.is_included() && limit.is_positive() && decided {
                // Named where there is one row to name it for.
                let wave = match limit.critical_wave() {
                    Some(wave) if wave.wavelength().is_finite() && answers.len() == 1 => {
                        format!("the wave of {}", limit_text::wave_words(wave))
                    }
                    _ => "the wave that binds".into(),
                };
                add(format!(
                    "at the limit itself two multipliers of {wave} meet on the unit circle: its amplitude may grow like the number of steps"
                ));
            }
        }
        if let Some(wave) = &answer.double_multiplier {
            let wave = limit_text::wave_words(wave);
            add(format!(
                "marginal at best: two multipliers of every wave but the longest are equal on the unit circle at every {symbol}, that of {wave} \
                 among them: its amplitude grows like the number of steps"
            ));
        }
        // Of many rows the table says enough.
        match answer.refinement.as_ref().filter(|_| answers.len() == 1) {
            Some(Refinement::OfLongWaves(rule)) => {
                let exponent = to_text(&rule.exponent);
                add(format!(
                    "on N cells the longest wave has the phase 2π/N, and none grows up to about {symbol} = {} (2π/N)^({exponent}): {} on 100 cells, \
                     {} on 1000. Where {symbol} ∝ Δt/Δx that is Δt ≤ const Δx^({})",
                    significant(rule.factor, 5),
                    significant(rule.at(100), 3),
                    significant(rule.at(1000), 3),
                    to_text(&(&rule.exponent + integer(1))),
                ));
            }
            Some(Refinement::OfAllWaves { power }) => add(format!(
                "waves of every length grow, |z|² − 1 ∝ {symbol}^{power}: bounded up to a given time where {symbol}^{power} ≤ const Δt. Where {symbol} ∝ Δt/Δx \
                 that is Δt ≤ const Δx^({})",
                to_text(&ratio(*power as i64, *power as i64 - 1)),
            )),
            None => {}
        }
        if limit.is_unbounded() {
            let evidence = match limit.evidence() {
                Evidence::Enclosed => "with enclosed coefficients",
                other => other.name(),
            };
            add(format!("stable without limit, {evidence}"));
        }
        if !answer.keeps_constants {
            add(match limit.evidence() {
                Evidence::Undecided => {
                    "that a constant is kept is not seen: the mean may drift".into()
                }
                _ => "a constant is not kept, the mean drifts".into(),
            });
        }
        for (growth, limit) in &answer.growth {
            if limit.evidence() == Evidence::Undecided {
                let budget = decimal_below(growth, 3);
                let lower = significant(limit.lower(), 8);
                add(format!(
                    "growth {budget} is proved up to {symbol} = {lower} and undecided above"
                ));
            }
        }
        let Some(set) = &answer.set else { continue };
        if set.neutral {
            add(format!("|z| = 1 for every wave at every {symbol}"));
        }
        if limit_text::has_gaps(set) {
            add(format!("stable set {}", limit_text::set(set)));
        }
        if let Some(set) = answer.monotone_set.as_ref().filter(|set| limit_text::has_gaps(set)) {
            let text = limit_text::set(set);
            if text != "without an interval" || answers.len() == 1 {
                add(format!("monotone set {text}"));
            }
        }
        for (from, to) in joined(&set.undecided) {
            let (from, to) = (significant(from, 8), significant(to, 8));
            add(format!("undecided for {symbol} in [{from}, {to}]"));
        }
        for singular in &answer.singular {
            let exact = singular.exact.as_ref().map_or(singular.value.to_string(), to_text);
            let wave = match &singular.wave {
                None => "any wave".into(),
                Some(wave) if wave.wavelength().is_infinite() => "the longest wave".into(),
                Some(wave) => format!("the wave of {}", limit_text::wave_words(wave)),
            };
            add(format!("singular at {symbol} = {exact}: the step cannot be solved for {wave}"));
        }
    }
    for text in assumptions(answers.iter().map(|answer| &answer.subject)) {
        remarks.add("", text);
    }
    remarks
}
