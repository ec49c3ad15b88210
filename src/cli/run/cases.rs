//! Every combination of the lists that options hold: one run each.

use super::{Arguments, Entry, methods, scenes};
use crate::cli::Failure;
use crate::cli::numbers::Names;
use clap::ValueEnum;
use courant::analysis::exact::rational::to_text;
use courant::analysis::spelling::spells;

/// Runs of one command at most.
const MAX_CASES: usize = 1000;

/// The arguments with one value of every option.
#[derive(Debug, Clone)]
pub struct Case {
    /// One value of every option.
    pub arguments: Arguments,
    /// The options that have several values, with the one of this case.
    pub choices: Vec<(&'static str, String)>,
}

/// The values of an option that takes a list.
trait List {
    type Item;
    fn values(&self) -> Vec<Self::Item>;
    fn of(value: Self::Item) -> Self;
}

impl<T: Clone> List for Option<Names<T>> {
    type Item = T;

    fn values(&self) -> Vec<T> {
        self.iter().flat_map(|names| names.0.iter().cloned()).collect()
    }

    fn of(value: T) -> Self {
        Some(Names(vec![value]))
    }
}

impl<T: Clone + PartialEq> List for Vec<T> {
    type Item = T;

    /// What is named twice counts once.
    fn values(&self) -> Vec<T> {
        let mut values: Vec<T> = Vec::new();
        for value in self {
            if !values.contains(value) {
                values.push(value.clone());
            }
        }
        values
    }

    fn of(value: T) -> Self {
        vec![value]
    }
}

/// The cases so far, each once for every value of one more option.
struct Cases(Vec<Case>);

impl Cases {
    fn each<L: List>(
        self,
        option: &'static str,
        field: impl Fn(&mut Arguments) -> &mut L,
        text: impl Fn(&L::Item) -> String,
    ) -> Self {
        let apart = |mut case: Case| {
            let values = field(&mut case.arguments).values();
            if values.len() < 2 {
                return vec![case];
            }
            let one = |value| {
                let mut case = case.clone();
                case.choices.push((option, text(&value)));
                *field(&mut case.arguments) = L::of(value);
                case
            };
            values.into_iter().map(one).collect()
        };
        // One more than is accepted is enough to know that it is too many.
        Self(self.0.into_iter().flat_map(apart).take(MAX_CASES + 1).collect())
    }
}

/// A value by its name on the command line.
fn name<T: ValueEnum>(value: &T) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// The name that is spelt so, or the text itself: what is none is judged later.
fn canonical(text: &mut String, known: Vec<Entry>) {
    if let Some(entry) = known.iter().find(|entry| spells(text, entry.name)) {
        *text = entry.name.into();
    }
}

/// Every combination, the first option slowest.
pub fn all(arguments: &Arguments) -> Result<Vec<Case>, Failure> {
    let mut arguments = arguments.clone();
    arguments.scene.iter_mut().for_each(|name| canonical(name, scenes()));
    arguments.method.iter_mut().for_each(|name| canonical(name, methods()));
    let one = Case { arguments, choices: Vec::new() };
    let Cases(cases) = Cases(vec![one])
        .each("scene", |a| &mut a.scene, String::clone)
        .each("method", |a| &mut a.method, String::clone)
        .each("particles", |a| &mut a.particles, usize::to_string)
        .each("kernel", |a| &mut a.kernel, |kernel| kernel.name().into())
        .each("ratio", |a| &mut a.ratio, to_text)
        .each("cfl", |a| &mut a.cfl, to_text)
        .each("time", |a| &mut a.time, to_text)
        .each("alpha", |a| &mut a.choices.alpha, to_text)
        .each("beta", |a| &mut a.choices.beta, to_text)
        .each("riemann", |a| &mut a.choices.riemann, name)
        .each("integrator", |a| &mut a.choices.integrator, |one| one.name.clone())
        .each("work", |a| &mut a.choices.work, name)
        .each("pair-work", |a| &mut a.choices.pair_work, name)
        .each("roe-mean", |a| &mut a.choices.roe_mean, name)
        .each("contact", |a| &mut a.choices.contact, to_text)
        .each("contact-form", |a| &mut a.choices.contact_form, name)
        .each("periods", |a| &mut a.advection.periods, to_text)
        .each("layout", |a| &mut a.advection.layout, name)
        .each("disorder", |a| &mut a.advection.disorder, to_text)
        .each("seed", |a| &mut a.advection.seed, u64::to_string)
        .each("waves", |a| &mut a.advection.waves, usize::to_string)
        .each("lattice", |a| &mut a.boxes.lattice, String::clone)
        .each("switch", |a| &mut a.boxes.switch, name)
        .each("levels", |a| &mut a.boxes.levels, usize::to_string);
    if cases.len() > MAX_CASES {
        return Err(Failure::Message(format!(
            "the lists of SCENE and the options have more than {MAX_CASES} combinations; make them shorter"
        )));
    }
    Ok(cases)
}
