//! The method of lines as one step: stages, histories, kicks and drifts of an integrator, as running codes make them.

use super::SteppingError;
use super::linear_form::{LinearForms, Place};
use super::program::{Equation, Program, Term};
use super::rounded::Rounded;
use courant_analysis::scheme::{Coefficient, Integrator, IntegratorForm, Nystrom};
use std::collections::BTreeMap;

/// The step of an integrator.
pub(super) fn program(
    forms: &LinearForms,
    integrator: &Integrator,
) -> Result<Program, SteppingError> {
    let unknowns = forms.unknowns.len();
    if forms.equations.len() != unknowns {
        return Err(SteppingError::NotSquare { equations: forms.equations.len(), unknowns });
    }
    let moving: Vec<usize> = (0..unknowns)
        .filter(|&u| places(forms).any(|place| place.unknown == u && place.derivative))
        .collect();
    let lines = Lines { forms, moving };
    match &integrator.form {
        IntegratorForm::RungeKutta { a, b } => lines.runge_kutta(a, b),
        IntegratorForm::Multistep { alpha, beta } => lines.multistep(alpha, beta),
        IntegratorForm::Nystrom(table) => lines.nystrom(table),
    }
}

fn places(forms: &LinearForms) -> impl Iterator<Item = &Place> {
    forms.equations.iter().flat_map(|equation| equation.keys())
}

fn number(coefficient: &Coefficient) -> Rounded {
    Rounded::nearest(coefficient.to_f64())
}

fn numbers(row: &[Coefficient]) -> Vec<Rounded> {
    row.iter().map(number).collect()
}

/// Rows of tables may be short.
fn entry(row: &[Coefficient], place: usize) -> Rounded {
    row.get(place).map_or(Rounded::default(), number)
}

/// Equations of lines, and the unknowns with a derivative.
struct Lines<'a> {
    forms: &'a LinearForms,
    moving: Vec<usize>,
}

/// Arrays and equations of a step being written down.
#[derive(Default)]
struct Draft {
    names: Vec<String>,
    equations: Vec<Equation>,
}

impl Draft {
    fn array(&mut self, name: String) -> usize {
        self.names.push(name);
        self.names.len() - 1
    }

    /// `target = Σ factor · array`.
    fn sum(&mut self, target: usize, terms: impl IntoIterator<Item = (usize, Rounded)>) {
        let terms = terms.into_iter().filter(|(_, factor)| factor.value != 0.0);
        let own = (target, Rounded::exact(-1.0));
        let term = |(array, coefficient)| Term { array, offset: [0; 3], coefficient };
        self.equations.push(terms.chain([own]).map(term).collect());
    }

    fn finish(self, next: Vec<usize>) -> Result<Program, SteppingError> {
        Program::new(self.names.len(), next, self.equations, &self.names)
    }
}

impl Lines<'_> {
    /// One evaluation of the equations: rates and auxiliaries of given values, by unknown. Equations in `left_out` are not asked.
    fn evaluate(
        &self,
        draft: &mut Draft,
        values: &BTreeMap<usize, usize>,
        rates: &BTreeMap<usize, usize>,
        left_out: Option<usize>,
    ) {
        let mut auxiliaries = BTreeMap::new();
        for (unknown, name) in self.forms.unknowns.iter().enumerate() {
            if !self.moving.contains(&unknown) {
                auxiliaries.insert(unknown, draft.array(name.clone()));
            }
        }
        for (number, form) in self.forms.equations.iter().enumerate() {
            if Some(number) == left_out {
                continue;
            }
            let terms = form.iter().map(|(place, coefficient)| {
                let arrays = if place.derivative { rates } else { values };
                let array = arrays.get(&place.unknown).or(auxiliaries.get(&place.unknown));
                let array = *array.expect("every unknown has its array");
                Term { array, offset: place.offset, coefficient: *coefficient }
            });
            draft.equations.push(terms.collect());
        }
    }

    /// One array for each unknown with a derivative.
    fn arrays(&self, draft: &mut Draft) -> BTreeMap<usize, usize> {
        let name = |unknown: usize| self.forms.unknowns[unknown].clone();
        self.moving.iter().map(|&unknown| (unknown, draft.array(name(unknown)))).collect()
    }

    fn runge_kutta(
        &self,
        a: &[Vec<Coefficient>],
        b: &[Coefficient],
    ) -> Result<Program, SteppingError> {
        let mut draft = Draft::default();
        let start = self.arrays(&mut draft);
        let one = Rounded::exact(1.0);
        let rates: Vec<_> = b.iter().map(|_| self.arrays(&mut draft)).collect();
        for (row, own) in a.iter().zip(&rates) {
            let stage = self.arrays(&mut draft);
            for unknown in &self.moving {
                let kicks = rates.iter().zip(numbers(row)).map(|(k, a)| (k[unknown], a));
                draft.sum(stage[unknown], [(start[unknown], one)].into_iter().chain(kicks));
            }
            self.evaluate(&mut draft, &stage, own, None);
        }
        let end = self.arrays(&mut draft);
        for unknown in &self.moving {
            let kicks = rates.iter().zip(numbers(b)).map(|(k, b)| (k[unknown], b));
            draft.sum(end[unknown], [(start[unknown], one)].into_iter().chain(kicks));
        }
        draft.finish(end.values().copied().collect())
    }

    /// The right-hand side is linear, so that it is evaluated once, of `Σ β_k U^{n+k}`.
    fn multistep(
        &self,
        alpha: &[Coefficient],
        beta: &[Coefficient],
    ) -> Result<Program, SteppingError> {
        let mut draft = Draft::default();
        let levels: Vec<_> = alpha.iter().map(|_| self.arrays(&mut draft)).collect();
        let (values, rates) = (self.arrays(&mut draft), self.arrays(&mut draft));
        for unknown in &self.moving {
            let with = |row: &[Coefficient]| -> Vec<_> {
                levels.iter().zip(numbers(row)).map(|(level, c)| (level[unknown], c)).collect()
            };
            draft.sum(values[unknown], with(beta));
            draft.sum(rates[unknown], with(alpha));
        }
        self.evaluate(&mut draft, &values, &rates, None);
        draft.finish(levels.iter().skip(1).flat_map(|level| level.values().copied()).collect())
    }

    fn nystrom(&self, table: &Nystrom<Coefficient>) -> Result<Program, SteppingError> {
        let (drift, x, v) = self.positions().ok_or(SteppingError::NoPositions)?;
        let mut draft = Draft::default();
        let [x_start, v_start] = ["x", "v"].map(|name| draft.array(name.into()));
        let stages = table.c.len();
        let one = Rounded::exact(1.0);
        let kicks: Vec<usize> = (0..stages).map(|_| draft.array("acceleration".into())).collect();
        // x + the way gone with some velocities.
        let moved = |draft: &mut Draft, velocities: Vec<(usize, Rounded)>| {
            let position = draft.array("x".into());
            draft.sum(position, [(x_start, one)].into_iter().chain(velocities));
            position
        };
        for stage in 0..stages {
            let drifted = |factor: Rounded, row: &[Coefficient]| -> Vec<_> {
                let kicked = kicks.iter().enumerate().map(|(j, &kick)| (kick, entry(row, j)));
                [(v_start, factor)].into_iter().chain(kicked).collect()
            };
            let velocities = drifted(number(&table.c[stage]), &table.position[stage]);
            let position = moved(&mut draft, velocities);
            let velocity = draft.array("v".into());
            draft.sum(velocity, drifted(one, &table.velocity[stage]));
            let values = [(x, position), (v, velocity)].into();
            self.evaluate(&mut draft, &values, &[(v, kicks[stage])].into(), Some(drift));
        }
        let weighted = |weights: &[Coefficient]| -> Vec<_> {
            let kicked = kicks.iter().zip(numbers(weights)).map(|(&kick, weight)| (kick, weight));
            [(v_start, one)].into_iter().chain(kicked).collect()
        };
        let x_end = moved(&mut draft, weighted(&table.position_weights));
        let v_end = draft.array("v".into());
        draft.sum(v_end, weighted(&table.velocity_weights));
        draft.finish(vec![x_end, v_end])
    }

    /// The equation `x[j]' = v[j]`, times any number, with its two unknowns; `x'` stands in no other.
    fn positions(&self) -> Option<(usize, usize, usize)> {
        let &[first, second] = self.moving.as_slice() else { return None };
        let is_rate = |place: &Place, x: usize| place.derivative && place.unknown == x;
        [(first, second), (second, first)].into_iter().find_map(|(x, v)| {
            let drifts = |form: &BTreeMap<Place, Rounded>| {
                let mut terms: Vec<_> = form.iter().collect();
                terms.sort_by_key(|(place, _)| !is_rate(place, x));
                let [(rate, a), (value, b)] = terms[..] else { return false };
                let velocity = Place { unknown: v, derivative: false, ..*rate };
                is_rate(rate, x) && *value == velocity && (*a + *b).vanishes()
            };
            let number = self.forms.equations.iter().position(drifts)?;
            let mut others = self.forms.equations.iter().enumerate().filter(|(n, _)| *n != number);
            let alone = !others.any(|(_, form)| form.keys().any(|place| is_rate(place, x)));
            alone.then_some((number, x, v))
        })
    }
}
