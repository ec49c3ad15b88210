//! Equations with time levels as one step: which level of which unknown each equation gives.

use super::SteppingError;
use super::linear_form::LinearForms;
use super::program::{Equation, Program, Term};

/// Sets of unknowns are counted through.
const MOST_EQUATIONS: usize = 16;

/// Finds for every equation by how many levels it is moved and for every unknown the level that a step gives, so that the equations
/// together give the newest values: the assignment of largest total level and its smallest potentials (Pryce 2001, BIT 41, for
/// differential–algebraic equations; levels take the place of derivatives).
pub(super) fn program(forms: &LinearForms) -> Result<Program, SteppingError> {
    let unknowns = forms.unknowns.len();
    if forms.equations.len() != unknowns {
        return Err(SteppingError::NotSquare { equations: forms.equations.len(), unknowns });
    }
    if unknowns > MOST_EQUATIONS {
        return Err(SteppingError::TooManyEquations { equations: unknowns, most: MOST_EQUATIONS });
    }
    let level = |equation: usize, unknown: usize, pick: fn(i32, i32) -> i32| -> Option<i32> {
        let places = forms.equations[equation].keys().filter(|place| place.unknown == unknown);
        places.map(|place| place.level).reduce(pick)
    };
    let newest: Vec<Vec<Option<i32>>> = (0..unknowns)
        .map(|equation| (0..unknowns).map(|u| level(equation, u, i32::max)).collect())
        .collect();
    let (moved, given) = potentials(&newest).ok_or_else(|| {
        let absent = |&u: &usize| newest.iter().all(|row| row[u].is_none());
        let name = (0..unknowns)
            .find(absent)
            .map_or_else(|| forms.unknowns.join(", "), |unknown| forms.unknowns[unknown].clone());
        SteppingError::NotDetermined(name)
    })?;
    // The oldest value of each unknown that any equation uses.
    let oldest: Vec<i32> = (0..unknowns)
        .map(|unknown| {
            let used = (0..unknowns)
                .filter_map(|e| level(e, unknown, i32::min).map(|oldest| oldest + moved[e]));
            used.min().unwrap_or(given[unknown])
        })
        .collect();
    let mut history = Vec::new();
    for unknown in 0..unknowns {
        history.extend((oldest[unknown]..given[unknown]).map(|level| (unknown, level)));
    }
    if history.is_empty() {
        return Err(SteppingError::NoStep);
    }
    let array = |unknown: usize, level: i32| -> usize {
        if level == given[unknown] {
            return history.len() + unknown;
        }
        let known = history.iter().position(|&slot| slot == (unknown, level));
        known.expect("every level between the oldest and the newest has its array")
    };
    let next = history.iter().map(|&(unknown, level)| array(unknown, level + 1)).collect();
    let equations = forms.equations.iter().zip(&moved).map(|(form, moved)| -> Equation {
        let terms = form.iter().map(|(place, coefficient)| Term {
            array: array(place.unknown, place.level + moved),
            offset: place.offset,
            coefficient: *coefficient,
        });
        terms.collect()
    });
    let names: Vec<String> = history
        .iter()
        .copied()
        .chain((0..unknowns).map(|unknown| (unknown, given[unknown])))
        .map(|(unknown, _)| forms.unknowns[unknown].clone())
        .collect();
    Program::new(names.len(), next, equations.collect(), &names)
}

/// `(c, d)` with `d_j − c_i ≥ σ_ij`, equal on an assignment of largest total `σ`; `None` where there is no assignment.
fn potentials(newest: &[Vec<Option<i32>>]) -> Option<(Vec<i32>, Vec<i32>)> {
    let assigned = best_assignment(newest)?;
    let size = newest.len();
    let mut moved = vec![0; size];
    loop {
        let given: Vec<i32> = (0..size)
            .map(|j| (0..size).filter_map(|i| newest[i][j].map(|s| s + moved[i])).max())
            .collect::<Option<_>>()?;
        let again: Vec<i32> = (0..size)
            .map(|i| newest[i][assigned[i]].map(|s| given[assigned[i]] - s))
            .collect::<Option<_>>()?;
        if again == moved {
            return Some((moved, given));
        }
        moved = again;
    }
}

/// An unknown for each equation, all different, with the largest total level.
fn best_assignment(newest: &[Vec<Option<i32>>]) -> Option<Vec<usize>> {
    let size = newest.len();
    // The best total with the first equations served, by the set of unknowns they took.
    let mut best: Vec<Option<(i32, usize)>> = vec![None; 1 << size];
    best[0] = Some((0, 0));
    for taken in 0..1usize << size {
        let Some((total, _)) = best[taken] else { continue };
        let equation = taken.count_ones() as usize;
        if equation == size {
            break;
        }
        for unknown in (0..size).filter(|unknown| taken >> unknown & 1 == 0) {
            let Some(level) = newest[equation][unknown] else { continue };
            let slot = &mut best[taken | 1 << unknown];
            if slot.is_none_or(|(known, _)| known < total + level) {
                *slot = Some((total + level, unknown));
            }
        }
    }
    let mut taken = (1usize << size) - 1;
    let mut assigned = vec![0; size];
    for equation in (0..size).rev() {
        let (_, unknown) = best[taken]?;
        assigned[equation] = unknown;
        taken &= !(1 << unknown);
    }
    Some(assigned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::scheme::language::parse;

    fn history(text: &str) -> Result<(usize, Vec<usize>), SteppingError> {
        let forms = LinearForms::new(&parse(text).unwrap(), None, &[("C".into(), 0.3)])?;
        let program = program(&forms)?;
        Ok((program.history(), program.blocks.iter().map(|block| block.targets.len()).collect()))
    }

    #[test]
    fn a_step_looks_back_as_far_as_the_equations_do() {
        assert_eq!(history("u[n+1,j] = u[n,j-1]").unwrap(), (1, vec![1]));
        assert_eq!(history("u[n+2,j] = u[n-1,j] + C*u[n,j]").unwrap(), (3, vec![1]));
        assert_eq!(history("u[n,j] = u[n-1,j] + C*u[n,j+1]").unwrap(), (1, vec![1]));
    }

    #[test]
    fn auxiliaries_of_the_present_and_of_the_next_level_are_given_once() {
        // s is wanted at both levels, so that its equation is moved to the later one.
        let text = "u[n+1,j] = u[n,j] - C*(s[n,j] + s[n+1,j]); s[n,j] = u[n,j+1] - u[n,j-1]";
        assert_eq!(history(text).unwrap(), (2, vec![2]));
        let filtered =
            "u[n+1,j] = f[n-1,j] - C*(u[n,j+1] - u[n,j-1]); f[n,j] = u[n,j] + C*u[n+1,j]";
        assert_eq!(history(filtered).unwrap(), (2, vec![1, 1]));
    }

    #[test]
    fn what_gives_no_step_is_refused() {
        assert_eq!(history("u[n,j] = u[n,j-1]"), Err(SteppingError::NoStep));
        let twice = "u[n+1,j] = u[n,j] + C*v[n,j]; u[n+1,j] = u[n,j-1] - C*v[n,j]";
        assert!(history(twice).is_ok(), "v follows from both");
        let never = "u[n+1,j] = u[n,j]; u[n+1,j] = u[n,j-1] + 0*v[n,j]";
        assert_eq!(history(never), Err(SteppingError::NotDetermined("v".into())));
    }
}
