//! The method of lines: equations in space completed by a time integrator.

use crate::exact::laurent::{Laurent, NAMES, Variable};
use crate::exact::matrix::{MOST_ROWS, Matrix};
use crate::exact::rational::Rational;
use crate::scheme::integrator::{Coefficient, Integrator, IntegratorForm, Nystrom};
use crate::scheme::kernel_function::KernelLattice;
use crate::scheme::language::syntax::Equations;
use crate::scheme::language::{LanguageError, parse};
use crate::scheme::linear::{LinearEquations, Place, constant};
use crate::scheme::names::{Fraction, Names, TooManyNames};
use crate::scheme::step::{Rows, SchemeError, Step, denominators_at, row_at};
use num_traits::Zero;

/// `M U' = L U` on the lattice, with matrices of Laurent polynomials in the shifts; time counts steps.
///
/// ```
/// use courant_analysis::scheme::{Integrator, Lines, Step};
/// let central = Lines::from_text("u[j]' = -C*(u[j+1] - u[j-1])/2")?;
/// let rk4 = Step::lines(&central, &Integrator::named("rk4").unwrap())?;
/// assert_eq!(rk4.limit("C")?.exact().unwrap().to_string(), "sqrt(8)");
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lines {
    mass: Matrix,
    rates: Matrix,
    unknowns: Vec<String>,
    dimension: usize,
    names: Names,
    denominators: Vec<Laurent>,
    set: Vec<(String, Rational)>,
}

/// `x' = v, M v' = F x + G v` on every wave: what the columns of [`Lines`] are.
pub(crate) struct Motion<'a> {
    pub(crate) position: usize,
    pub(crate) velocity: usize,
    /// `M`.
    pub(crate) inertia: &'a Laurent,
    /// `F`.
    pub(crate) restoring: &'a Laurent,
    /// `G`.
    pub(crate) damping: &'a Laurent,
}

impl Lines {
    /// From equations for `u[j]'`; equations without a derivative give auxiliaries, which are substituted.
    ///
    /// # Errors
    /// With the place in the text.
    pub fn from_text(text: &str) -> Result<Self, SchemeError> {
        Self::from_tree(&parse(text)?, None)
    }

    /// The same with a kernel for `sum(k, …)`.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn with_kernel(text: &str, lattice: &KernelLattice) -> Result<Self, SchemeError> {
        Self::from_tree(&parse(text)?, Some(lattice))
    }

    /// From a text that was read before.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn from_tree(
        tree: &Equations,
        lattice: Option<&KernelLattice>,
    ) -> Result<Self, SchemeError> {
        let linear = LinearEquations::new(tree, lattice)?;
        let places = || linear.equations.iter().flat_map(|e| &e.terms).map(|(place, _)| place);
        if !places().all(Place::is_of_lines) {
            let message = "an integrator completes equations with u[j]', not with time levels";
            return Err(linear.error(message, 0).into());
        }
        if !places().any(|place| place.derivative) {
            let message = "no derivative: write u[j]' = … ";
            return Err(linear.error(message, usize::MAX).into());
        }
        let rows = Rows::new(&linear)?;
        // z stands for d/dt while auxiliaries are substituted.
        let with_derivative = |row: usize, column: usize| {
            let mass = rows.mass.rows()[row][column].shifted(Variable::TIME, 1);
            mass + rows.matrix.rows()[row][column].clone()
        };
        let size = linear.unknowns.len();
        let mut operator = Matrix::new(
            (0..size).map(|i| (0..size).map(|j| with_derivative(i, j)).collect()).collect(),
        );
        let auxiliary = |&column: &usize| rows.mass.rows().iter().all(|row| row[column].is_zero());
        let auxiliaries: Vec<usize> = (0..size).filter(auxiliary).collect();
        let kept = operator.substitute(&auxiliaries);
        if let Some(&left) = kept.iter().find(|column| auxiliaries.contains(column)) {
            return Err(Self::unsolved(&linear, left).into());
        }
        let part = |power: usize, sign: i64| {
            operator.map(|entry| {
                let coefficient = entry.coefficients(Variable::TIME).into_iter().nth(power);
                coefficient.unwrap_or_default() * Laurent::integer(sign)
            })
        };
        Ok(Self {
            mass: part(1, 1),
            rates: part(0, -1),
            unknowns: kept.iter().map(|&column| linear.unknowns[column].clone()).collect(),
            dimension: linear.dimension,
            names: linear.names,
            denominators: rows.denominators,
            set: Vec::new(),
        })
    }

    /// With a value for a parameter.
    ///
    /// # Errors
    /// When there is no such parameter, or a denominator vanishes.
    pub fn with(&self, name: &str, value: &Rational) -> Result<Self, SchemeError> {
        let variable = self.names.known_parameter(name)?;
        let size = self.unknowns.len();
        let rows: Vec<Vec<Laurent>> = (0..size)
            .map(|row| {
                let (mass, rates) = (&self.mass.rows()[row], &self.rates.rows()[row]);
                row_at(mass.iter().chain(rates), variable, value)
            })
            .collect();
        let part = |from: usize| {
            Matrix::new(rows.iter().map(|row| row[from..from + size].to_vec()).collect())
        };
        let mut set = self.set.clone();
        set.push((name.to_string(), value.clone()));
        Ok(Self {
            mass: part(0),
            rates: part(size),
            denominators: denominators_at(&self.denominators, variable, name, value)?,
            set,
            ..self.clone()
        })
    }

    /// As positions and velocities, if they are.
    pub(crate) fn motion(&self) -> Option<Motion<'_>> {
        if self.unknowns.len() != 2 {
            return None;
        }
        let (mass, rates) = (self.mass.rows(), self.rates.rows());
        let is_position = |row: usize, x: usize| {
            let v = 1 - x;
            mass[row][v].is_zero()
                && rates[row][x].is_zero()
                && mass[row][x] == rates[row][v]
                && mass[1 - row][x].is_zero()
                && mass[row][x].as_monomial().is_some()
        };
        let (row, x) =
            [(0, 0), (1, 1), (0, 1), (1, 0)].into_iter().find(|&(row, x)| is_position(row, x))?;
        let (dynamic, v) = (1 - row, 1 - x);
        Some(Motion {
            position: x,
            velocity: v,
            inertia: &mass[dynamic][v],
            restoring: &rates[dynamic][x],
            damping: &rates[dynamic][v],
        })
    }

    fn unsolved(linear: &LinearEquations, unknown: usize) -> LanguageError {
        let name = &linear.unknowns[unknown];
        let message = format!(
            "`{name}` has no derivative and no equation `{name}[j] = …` that gives it alone"
        );
        linear.error(message, usize::MAX)
    }

    /// The unknowns with a derivative.
    pub fn unknowns(&self) -> &[String] {
        &self.unknowns
    }

    /// `M`.
    pub fn mass(&self) -> &Matrix {
        &self.mass
    }

    /// `L`.
    pub fn rates(&self) -> &Matrix {
        &self.rates
    }

    /// The names in both.
    pub fn names(&self) -> &Names {
        &self.names
    }
}

impl Step {
    /// The method of lines completed: equations in space and an integrator.
    ///
    /// # Errors
    /// When the integrator does not serve the equations: a table for `x'' = a(x, x')` needs two unknowns, `x[j]' = v[j]` and one for `v[j]'`.
    pub fn lines(space: &Lines, integrator: &Integrator) -> Result<Self, SchemeError> {
        let mut names = space.names.clone();
        let matrix = match &integrator.form {
            IntegratorForm::Nystrom(table) => nystrom(space, table, &mut names)?,
            form if space.unknowns.len() == 1 => {
                // A scalar operator enters through the stability function, as one number λ = L/M.
                if names.all().len() == NAMES {
                    return Err(TooManyNames.into());
                }
                let lambda = Variable::name(NAMES - 1);
                let one = Matrix::new(vec![vec![Laurent::integer(1)]]);
                let operator = Matrix::new(vec![vec![Laurent::variable(lambda)]]);
                let mut whole = complete(&one, &operator, form, &mut names)?;
                let all: Vec<usize> = (1..whole.size()).collect();
                whole.substitute(&all);
                if whole.size() > MOST_ROWS {
                    return Err(SchemeError::TooManyUnknowns(whole.size()));
                }
                let stability = names.reduce(whole.determinant());
                if names.all().len() == NAMES {
                    return Err(TooManyNames.into());
                }
                let (rates, mass) = (&space.rates.rows()[0][0], &space.mass.rows()[0][0]);
                Matrix::new(vec![vec![stability.substitute(lambda, rates, mass)]])
            }
            form => complete(&space.mass, &space.rates, form, &mut names)?,
        };
        let stages = matrix.size() / space.unknowns.len().max(1);
        let unknowns = (0..matrix.size()).map(|column| {
            let (stage, unknown) = (column / space.unknowns.len(), column % space.unknowns.len());
            let name = &space.unknowns[unknown];
            if stages == 1 || stage == 0 { name.clone() } else { format!("{name}, stage {stage}") }
        });
        Ok(Self {
            unknowns: unknowns.collect(),
            matrix,
            dimension: space.dimension,
            names,
            denominators: space.denominators.clone(),
            set: space.set.clone(),
            measured: false,
        })
    }
}

/// One equation of the completed system: polynomials with exact factors, by column.
struct Row(Vec<(usize, Fraction)>);

impl Row {
    fn add(&mut self, column: usize, entry: &Laurent, factor: &Fraction) {
        if !entry.is_zero() && !factor.is_zero() {
            let numerator = entry * &factor.numerator;
            self.0.push((column, Fraction { numerator, denominator: factor.denominator.clone() }));
        }
    }

    /// Over one denominator, which is left out.
    fn cleared(self, columns: usize) -> Vec<Laurent> {
        let mut common = Laurent::integer(1);
        for (_, fraction) in &self.0 {
            if common.divide_exactly(&fraction.denominator).is_none() {
                use num_integer::Integer;
                // Denominators of tableaus are integers.
                let (a, b) = (common.integer_content(), fraction.denominator.integer_content());
                common = Laurent::constant(a.lcm(&b));
            }
        }
        let mut row = vec![Laurent::default(); columns];
        for (column, fraction) in self.0 {
            let factor = common.divide_exactly(&fraction.denominator).expect("a multiple of each");
            row[column] = std::mem::take(&mut row[column]) + &factor * &fraction.numerator;
        }
        row
    }
}

fn exact(coefficients: &[Coefficient], names: &mut Names) -> Result<Vec<Fraction>, LanguageError> {
    coefficients.iter().map(|c| constant(c.expression(), c.text(), names)).collect()
}

fn one() -> Fraction {
    Fraction { numerator: Laurent::integer(1), denominator: Laurent::integer(1) }
}

/// Stages as unknowns behind those of the equations.
fn complete(
    mass: &Matrix,
    rates: &Matrix,
    form: &IntegratorForm,
    names: &mut Names,
) -> Result<Matrix, SchemeError> {
    let size = mass.size();
    match form {
        IntegratorForm::RungeKutta { a, b } => {
            let stages = b.len();
            let columns = size * (stages + 1);
            let stage = |i: usize, unknown: usize| size * (i + 1) + unknown;
            let mut rows = Vec::with_capacity(columns);
            // z U = U + Σ b_i K_i.
            let weights = exact(b, names)?;
            for unknown in 0..size {
                let mut row = Row(Vec::new());
                let advance = Laurent::variable(Variable::TIME) - Laurent::integer(1);
                row.add(unknown, &advance, &one());
                for (i, weight) in weights.iter().enumerate() {
                    row.add(stage(i, unknown), &Laurent::integer(-1), weight);
                }
                rows.push(row.cleared(columns));
            }
            // M K_i = L (U + Σ a_ij K_j).
            for (i, entries) in a.iter().enumerate() {
                let entries = exact(entries, names)?;
                for equation in 0..size {
                    let mut row = Row(Vec::new());
                    for unknown in 0..size {
                        let operator = -rates.rows()[equation][unknown].clone();
                        row.add(stage(i, unknown), &mass.rows()[equation][unknown], &one());
                        row.add(unknown, &operator, &one());
                        for (j, entry) in entries.iter().enumerate() {
                            row.add(stage(j, unknown), &operator, entry);
                        }
                    }
                    rows.push(row.cleared(columns));
                }
            }
            Ok(Matrix::new(rows))
        }
        IntegratorForm::Multistep { alpha, beta } => {
            let (alpha, beta) = (exact(alpha, names)?, exact(beta, names)?);
            let rows = (0..size).map(|equation| {
                let mut row = Row(Vec::new());
                for unknown in 0..size {
                    let (m, l) =
                        (&mass.rows()[equation][unknown], &rates.rows()[equation][unknown]);
                    for (power, (a, b)) in (0..).zip(alpha.iter().zip(&beta)) {
                        row.add(unknown, &m.shifted(Variable::TIME, power), a);
                        row.add(unknown, &-l.shifted(Variable::TIME, power), b);
                    }
                }
                row.cleared(size)
            });
            Ok(Matrix::new(rows.collect()))
        }
        IntegratorForm::Nystrom(_) => {
            Err(SchemeError::Integrator("this integrator is for positions and velocities".into()))
        }
    }
}

/// Positions and velocities with the accelerations of the stages behind them.
fn nystrom(
    space: &Lines,
    table: &Nystrom<Coefficient>,
    names: &mut Names,
) -> Result<Matrix, SchemeError> {
    let motion = space.motion().ok_or_else(|| {
        SchemeError::Integrator(
            "this integrator is for positions and velocities: it needs two equations, x[j]' = v[j] and one for v[j]'".into(),
        )
    })?;
    let Motion { position: x, velocity: v, inertia, restoring, damping } = motion;
    let stages = table.c.len();
    let columns = 2 + stages;
    let advance = Laurent::variable(Variable::TIME) - Laurent::integer(1);
    let minus = Laurent::integer(-1);
    let mut rows = Vec::with_capacity(columns);
    let mut position = Row(Vec::new());
    position.add(x, &advance, &one());
    position.add(v, &minus, &one());
    for (j, weight) in exact(&table.position_weights, names)?.iter().enumerate() {
        position.add(2 + j, &minus, weight);
    }
    rows.push(position.cleared(columns));
    let mut velocity = Row(Vec::new());
    velocity.add(v, &advance, &one());
    for (j, weight) in exact(&table.velocity_weights, names)?.iter().enumerate() {
        velocity.add(2 + j, &minus, weight);
    }
    rows.push(velocity.cleared(columns));
    let drifts = exact(&table.c, names)?;
    for (i, drift) in drifts.iter().enumerate() {
        let (p, q) = (exact(&table.position[i], names)?, exact(&table.velocity[i], names)?);
        let mut row = Row(Vec::new());
        row.add(2 + i, inertia, &one());
        let (force, drag) = (-restoring.clone(), -damping.clone());
        row.add(x, &force, &one());
        row.add(v, &force, drift);
        row.add(v, &drag, &one());
        for j in 0..stages {
            let nothing = Fraction::number(&num_rational::Ratio::zero());
            row.add(2 + j, &force, p.get(j).unwrap_or(&nothing));
            row.add(2 + j, &drag, q.get(j).unwrap_or(&nothing));
        }
        rows.push(row.cleared(columns));
    }
    Ok(Matrix::new(rows))
}
