//! A scheme as it is run: arrays on a periodic lattice.

use super::SteppingError;
use super::dense::Factors;
use super::lattice::{Lattice, PerAxis};
use super::linear_form::LinearForms;
use super::program::{Block, Program, Term};
use super::{levels, stages};
use courant_analysis::scheme::language::syntax::Equations;
use courant_analysis::scheme::{Integrator, KernelLattice};

/// The typed equations of a scheme, ready to be run on a torus: arrays of numbers and nothing else. In one dimension the torus is a ring.
///
/// ```
/// use courant_analysis::scheme::language::parse;
/// use courant_simulation::stepping::TorusScheme;
/// let upwind = parse("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// let scheme = TorusScheme::new(&upwind, None, None, &[("C".into(), 0.5)])?;
/// let ring = scheme.torus(&[4])?;
/// let mut state = vec![vec![0.0, 1.0, 0.0, 0.0]];
/// ring.step(&mut state);
/// assert_eq!(state, [vec![0.0, 0.5, 0.5, 0.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TorusScheme {
    dimension: usize,
    program: Program,
}

/// A scheme on a torus of so many cells, with what it has to solve factorised. The arrays of its state have one value for each cell, those
/// along the last axis next to each other.
#[derive(Debug, Clone)]
pub struct Torus<'a> {
    program: &'a Program,
    pub(super) lattice: Lattice,
    /// For each block that is not explicit.
    factors: Vec<Option<Factors<f64>>>,
}

impl TorusScheme {
    /// Compiles equations: with time levels, or with `u[j]'` and an integrator. Every parameter needs a value.
    ///
    /// # Errors
    /// When the equations are no linear scheme, or the integrator does not serve them.
    pub fn new(
        tree: &Equations,
        lattice: Option<&KernelLattice>,
        integrator: Option<&Integrator>,
        parameters: &[(String, f64)],
    ) -> Result<Self, SteppingError> {
        let forms = LinearForms::new(tree, lattice, parameters)?;
        let program = match (forms.of_lines, integrator) {
            (false, None) => levels::program(&forms)?,
            (true, Some(integrator)) => stages::program(&forms, integrator)?,
            (true, None) => return Err(SteppingError::NeedsIntegrator),
            (false, Some(_)) => return Err(SteppingError::TakesNoIntegrator),
        };
        Ok(Self { dimension: forms.dimension, program })
    }

    /// The number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The scheme on a torus with so many cells along each axis.
    ///
    /// # Errors
    /// When there are not as many axes as dimensions, or what it solves is singular there.
    pub fn torus(&self, points: &[usize]) -> Result<Torus<'_>, SteppingError> {
        if points.len() != self.dimension {
            return Err(SteppingError::Dimension { dimension: self.dimension, axes: points.len() });
        }
        let lattice = Lattice::new(points)?;
        let factorise = |block: &Block| match block.explicit() {
            Some(_) => Ok(None),
            None => {
                let size = block.targets.len() * lattice.cells();
                let factors = Factors::new(size, matrix(block, &lattice));
                let singular = || SteppingError::Singular { points: lattice.points().clone() };
                factors.map(Some).ok_or_else(singular)
            }
        };
        let factors = self.program.blocks.iter().map(factorise).collect::<Result<_, _>>()?;
        Ok(Torus { program: &self.program, lattice, factors })
    }
}

/// The coefficients of a block, row by row: one row for each equation and cell.
fn matrix(block: &Block, lattice: &Lattice) -> Vec<f64> {
    let cells = lattice.cells();
    let size = block.targets.len() * cells;
    let mut entries = vec![0.0; size * size];
    for (number, equation) in block.equations.iter().enumerate() {
        for term in equation {
            let Some(target) = block.targets.iter().position(|t| *t == term.array) else {
                continue;
            };
            for cell in 0..cells {
                let column = target * cells + lattice.neighbour(cell, term.offset);
                entries[(number * cells + cell) * size + column] += term.coefficient.value;
            }
        }
    }
    entries
}

impl Torus<'_> {
    /// How many cells along each axis.
    pub fn points(&self) -> &PerAxis<usize> {
        self.lattice.points()
    }

    /// How many cells.
    pub fn cells(&self) -> usize {
        self.lattice.cells()
    }

    /// How many arrays a state has.
    pub fn history(&self) -> usize {
        self.program.history()
    }

    /// One step: the arrays of the history are replaced by those one level later.
    ///
    /// # Panics
    /// When the state has not [`history`](Self::history) arrays of [`cells`](Self::cells) values.
    pub fn step(&self, state: &mut [Vec<f64>]) {
        assert_eq!(state.len(), self.history(), "one array for each level of each unknown");
        assert!(state.iter().all(|array| array.len() == self.cells()), "one value for each cell");
        let mut arrays: Vec<Vec<f64>> = state.to_vec();
        arrays.resize(self.program.arrays, Vec::new());
        for (block, factors) in self.program.blocks.iter().zip(&self.factors) {
            match (block.explicit(), factors) {
                (Some(own), _) => {
                    let others = block.equations[0].iter().filter(|t| t.array != own.array);
                    let sum = self.weighted_sum(others, &arrays);
                    let target = &mut arrays[own.array];
                    *target = vec![0.0; self.cells()];
                    for (cell, value) in sum.iter().enumerate() {
                        let place = self.lattice.neighbour(cell, own.offset);
                        target[place] = -value / own.coefficient.value;
                    }
                }
                (None, Some(factors)) => {
                    let mut right = Vec::with_capacity(block.targets.len() * self.cells());
                    for equation in &block.equations {
                        let known = equation.iter().filter(|t| !block.targets.contains(&t.array));
                        right.extend(self.weighted_sum(known, &arrays).iter().map(|sum| -sum));
                    }
                    factors.solve(&mut right);
                    for (&target, values) in block.targets.iter().zip(right.chunks(self.cells())) {
                        arrays[target] = values.to_vec();
                    }
                }
                (None, None) => unreachable!("every block that is not explicit has its factors"),
            }
        }
        for (array, &next) in state.iter_mut().zip(&self.program.next) {
            // A level may be both kept and replaced, so that it is copied.
            array.copy_from_slice(&arrays[next]);
        }
    }

    fn weighted_sum<'t>(
        &self,
        terms: impl Iterator<Item = &'t Term>,
        arrays: &[Vec<f64>],
    ) -> Vec<f64> {
        let mut sum = vec![0.0; self.cells()];
        for term in terms {
            let (values, coefficient) = (&arrays[term.array], term.coefficient.value);
            self.lattice.add_neighbours(&mut sum, coefficient, values, term.offset);
        }
        sum
    }

    /// For each array after the step (first index) and each before it: what products of absolute values add up to in it, where
    /// the one array is 1 everywhere and the others vanish; and the error of one step there in units of `f64::EPSILON`.
    pub(super) fn rounding(&self) -> Vec<Vec<Rounding>> {
        let inverses: Vec<Option<Vec<Vec<f64>>>> =
            self.factors.iter().map(|f| f.as_ref().map(|f| self.block_sums(f))).collect();
        let columns: Vec<Vec<Rounding>> = (0..self.history())
            .map(|one| {
                let mut arrays = vec![Rounding::default(); self.program.arrays];
                arrays[one].size = 1.0;
                for (block, inverse) in self.program.blocks.iter().zip(&inverses) {
                    bound_block(block, inverse.as_deref(), &mut arrays);
                }
                self.program.next.iter().map(|&next| arrays[next]).collect()
            })
            .collect();
        (0..self.history()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
    }

    /// The absolute inverse of a block, added up over cells: for each target, each equation.
    fn block_sums(&self, factors: &Factors<f64>) -> Vec<Vec<f64>> {
        let columns = factors.inverse_columns();
        let count = columns.len() / self.cells();
        let mut sums = vec![vec![0.0; count]; count];
        for (target, row) in sums.iter_mut().enumerate() {
            for (equation, sum) in row.iter_mut().enumerate() {
                // All cells are alike: the first one of the target stands for them.
                let of_equation = &columns[equation * self.cells()..][..self.cells()];
                *sum = of_equation.iter().map(|column| column[target * self.cells()].abs()).sum();
            }
        }
        sums
    }
}

/// Running error analysis of one array.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Rounding {
    /// A bound on its values.
    pub size: f64,
    /// A bound on their errors, in units of `f64::EPSILON`.
    pub error: f64,
}

fn bound_block(block: &Block, inverse: Option<&[Vec<f64>]>, arrays: &mut [Rounding]) {
    let own = |array: usize| block.targets.iter().position(|target| *target == array);
    // Half a rounding for every product and every sum behind a term.
    let count = |equation: &[Term]| equation.len() as f64 / 2.0 + 1.0;
    let weight = |term: &Term, roundings: f64| {
        term.coefficient.value.abs() * roundings + term.coefficient.error / f64::EPSILON
    };
    let known: Vec<Rounding> = block
        .equations
        .iter()
        .map(|equation| {
            let mut sum = Rounding::default();
            for term in equation.iter().filter(|term| own(term.array).is_none()) {
                let array = arrays[term.array];
                sum.size += term.coefficient.value.abs() * array.size;
                sum.error += term.coefficient.value.abs() * array.error;
                sum.error += weight(term, count(equation)) * array.size;
            }
            sum
        })
        .collect();
    match (block.explicit(), inverse) {
        (Some(term), _) => {
            let divisor = term.coefficient.value.abs();
            let size = known[0].size / divisor;
            let error = (known[0].error + weight(&term, 1.0) * size) / divisor;
            arrays[term.array] = Rounding { size, error };
        }
        (None, Some(inverse)) => {
            let sizes: Vec<f64> = inverse
                .iter()
                .map(|row| row.iter().zip(&known).map(|(w, known)| w * known.size).sum())
                .collect();
            let errors: Vec<f64> = block
                .equations
                .iter()
                .zip(&known)
                .map(|(equation, known)| {
                    let solved = equation.iter().filter_map(|term| {
                        own(term.array).map(|t| weight(term, count(equation) + 2.0) * sizes[t])
                    });
                    known.error + solved.sum::<f64>()
                })
                .collect();
            for ((&target, row), &size) in block.targets.iter().zip(inverse).zip(&sizes) {
                let error = row.iter().zip(&errors).map(|(w, error)| w * error).sum();
                arrays[target] = Rounding { size, error };
            }
        }
        (None, None) => unreachable!("every block that is not explicit has its inverse"),
    }
}
