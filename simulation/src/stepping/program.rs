//! One step as a list of equations on arrays, put in the order in which they can be solved.

use super::SteppingError;
use super::rounded::Rounded;

/// `coefficient · array[cell + offset]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Term {
    pub array: usize,
    pub offset: [i32; 3],
    pub coefficient: Rounded,
}

/// `Σ terms = 0` at every cell.
pub(super) type Equation = Vec<Term>;

/// Equations that are solved together, for as many arrays.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Block {
    pub targets: Vec<usize>,
    pub equations: Vec<Equation>,
}

/// What one step does with its arrays.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Program {
    /// How many arrays.
    pub arrays: usize,
    /// The history is in the first arrays; after the step, array `k` is replaced by array `next[k]`.
    pub next: Vec<usize>,
    /// In the order of solving.
    pub blocks: Vec<Block>,
}

impl Block {
    /// The only array it gives, with the term that holds it, where nothing has to be solved for.
    pub fn explicit(&self) -> Option<Term> {
        let ([target], [equation]) = (self.targets.as_slice(), self.equations.as_slice()) else {
            return None;
        };
        let mut own = equation.iter().filter(|term| term.array == *target);
        let first = own.next()?;
        own.next().is_none().then_some(*first)
    }
}

impl Program {
    /// Equations for the arrays behind the history, in blocks as small as they come: an equation waits for what it needs.
    ///
    /// `names` are those of the arrays, for messages.
    pub fn new(
        arrays: usize,
        next: Vec<usize>,
        equations: Vec<Equation>,
        names: &[String],
    ) -> Result<Self, SteppingError> {
        let history = next.len();
        let targets = arrays - history;
        let uses = |equation: &Equation, target: usize| {
            equation.iter().any(|term| term.array == history + target)
        };
        let wanted: Vec<Vec<bool>> =
            equations.iter().map(|e| (0..targets).map(|t| uses(e, t)).collect()).collect();
        let owner = perfect_matching(&wanted, targets).map_err(|target| {
            SteppingError::NotDetermined(names.get(history + target).cloned().unwrap_or_default())
        })?;
        // needs[a][b]: target a waits for target b, through any chain of equations.
        let mut needs: Vec<Vec<bool>> = owner.iter().map(|&e| wanted[e].clone()).collect();
        for through in 0..targets {
            let onward = needs[through].clone();
            for row in needs.iter_mut().filter(|row| row[through]) {
                row.iter_mut().zip(&onward).for_each(|(known, new)| *known |= new);
            }
        }
        let mut done = vec![false; targets];
        let mut blocks = Vec::new();
        while let Some(start) = {
            // What waits for nothing that is not done, but for those that wait for it in turn.
            let is_next = |&a: &usize| {
                !done[a] && (0..targets).all(|b| !needs[a][b] || done[b] || needs[b][a])
            };
            (0..targets).find(is_next)
        } {
            let together = |&b: &usize| b == start || (needs[start][b] && needs[b][start]);
            let members: Vec<usize> = (0..targets).filter(together).collect();
            members.iter().for_each(|&member| done[member] = true);
            blocks.push(Block {
                targets: members.iter().map(|member| history + member).collect(),
                equations: members.iter().map(|&m| equations[owner[m]].clone()).collect(),
            });
        }
        Ok(Self { arrays, next, blocks })
    }

    /// Arrays a step begins with.
    pub fn history(&self) -> usize {
        self.next.len()
    }
}

/// For each target an equation of its own that holds it; the target for which there is none.
fn perfect_matching(wanted: &[Vec<bool>], targets: usize) -> Result<Vec<usize>, usize> {
    fn assign(
        target: usize,
        wanted: &[Vec<bool>],
        seen: &mut [bool],
        owner_of: &mut [Option<usize>],
    ) -> bool {
        for equation in 0..wanted.len() {
            if wanted[equation][target] && !seen[equation] {
                seen[equation] = true;
                let free = match owner_of[equation] {
                    None => true,
                    Some(other) => assign(other, wanted, seen, owner_of),
                };
                if free {
                    owner_of[equation] = Some(target);
                    return true;
                }
            }
        }
        false
    }
    let mut target_of: Vec<Option<usize>> = vec![None; wanted.len()];
    for target in 0..targets {
        let mut seen = vec![false; wanted.len()];
        if !assign(target, wanted, &mut seen, &mut target_of) {
            return Err(target);
        }
    }
    let mut owner = vec![0; targets];
    for (equation, target) in target_of.iter().enumerate() {
        if let Some(target) = target {
            owner[*target] = equation;
        }
    }
    Ok(owner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn term(array: usize, offset: i32) -> Term {
        Term { array, offset: [offset, 0, 0], coefficient: Rounded::exact(1.0) }
    }

    fn names() -> Vec<String> {
        ["u", "a", "b", "c"].map(String::from).to_vec()
    }

    #[test]
    fn an_array_that_no_equation_gives_is_named() {
        let equations = vec![
            vec![term(1, 0), term(0, 0)],
            vec![term(1, 0), term(0, 1)],
            vec![term(1, 0), term(2, 0)],
        ];
        let problem = Program::new(4, vec![3], equations, &names()).unwrap_err();
        assert_eq!(problem, SteppingError::NotDetermined("c".into()));
    }
}
