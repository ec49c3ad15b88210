//! The method of lines completed: the matrix of stages from `M U' = L U` and the numbers of an integrator.

use super::super::IntegratorStatement;
use super::super::verify::{CertificateError, ensure};
use super::fraction::{Fraction, cleared};
use super::matrix::{Matrix, Whole, determinant_up_to_units, without_units};
use super::parser::value;
use super::polynomial::{Poly, Power};
use super::reader::Reader;
use crate::exact::rational::Rational;
use num_bigint::BigInt;
use std::collections::BTreeMap;

type Read<T> = Result<T, CertificateError>;

fn numbers(texts: &[String]) -> Read<Vec<Fraction>> {
    let mut reader = Reader::new(BTreeMap::new(), None, true);
    texts.iter().map(|text| reader.fraction(&value(text)?)).collect()
}

fn rational(poly: &Whole) -> Poly<Rational> {
    let values = poly.0.iter();
    Poly(values.map(|(power, value)| (power.clone(), Rational::from(value.clone()))).collect())
}

/// A row of a matrix that is being put together.
struct Row(Vec<Fraction>);

impl Row {
    fn new(columns: usize) -> Self {
        Self(vec![Fraction::whole(Poly::default()); columns])
    }

    fn add(&mut self, column: usize, entry: &Whole, factor: &Fraction) {
        self.0[column] = self.0[column].plus(&Fraction::whole(rational(entry)).times(factor));
    }

    fn clear(self) -> Vec<Whole> {
        cleared(&self.0)
    }
}

fn constant(value: i64) -> Whole {
    Poly::number(BigInt::from(value))
}

/// `z − 1`.
fn advance() -> Whole {
    Poly::monomial(1, [0; 3], 0).minus(&Poly::one())
}

/// From the matrix in which `z` counts derivatives.
pub fn complete(mut matrix: Matrix, integrator: &IntegratorStatement) -> Read<Matrix> {
    let unknowns = matrix.len();
    let has_derivative =
        |column: &usize| matrix.iter().any(|row| row[*column].0.keys().any(|power| power.z != 0));
    let (derived, auxiliary): (Vec<usize>, Vec<usize>) = (0..unknowns).partition(has_derivative);
    let kept = without_units(&mut matrix, &auxiliary);
    ensure(
        kept == derived && !derived.is_empty(),
        "an unknown without a derivative is not given by an equation",
    )?;
    let part = |power: usize, sign: i64| -> Matrix {
        let sign = BigInt::from(sign);
        let entry =
            |poly: &Whole| poly.by_z().get(power).map_or_else(Poly::default, |p| p.scaled(&sign));
        matrix.iter().map(|row| row.iter().map(entry).collect()).collect()
    };
    let (mass, rates) = (part(1, 1), part(0, -1));
    match integrator {
        IntegratorStatement::Multistep { alpha, beta } => multistep(&mass, &rates, alpha, beta),
        IntegratorStatement::RungeKutta { a, b } if mass.len() > 1 => stages(&mass, &rates, a, b),
        IntegratorStatement::RungeKutta { a, b } => {
            // One number λ = L/M enters, here in the place of C.
            let lambda = Poly::monomial(0, [0; 3], 1);
            let whole = stages(&vec![vec![Poly::one()]], &vec![vec![lambda]], a, b)?;
            let whole = determinant_up_to_units(whole)?;
            let degree = whole.0.keys().map(|power| power.c).max().unwrap_or(0);
            let mut sums: BTreeMap<i32, Whole> = BTreeMap::new();
            for (power, value) in whole.0 {
                let rest = Poly::term(Power { c: 0, ..power.clone() }, value);
                let sum = sums.entry(power.c).or_default();
                *sum = std::mem::take(sum).plus(&rest);
            }
            let mut total = Poly::default();
            for (c, sum) in sums {
                let powers =
                    rates[0][0].pow(c as usize).times(&mass[0][0].pow((degree - c) as usize));
                total = total.plus(&sum.times(&powers));
            }
            Ok(vec![vec![total]])
        }
        IntegratorStatement::Nystrom {
            c,
            position,
            velocity,
            position_weights,
            velocity_weights,
        } => {
            let weights = [position_weights, velocity_weights];
            nystrom(&mass, &rates, c, [position, velocity], weights)
        }
    }
}

fn multistep(mass: &Matrix, rates: &Matrix, alpha: &[String], beta: &[String]) -> Read<Matrix> {
    let (alpha, beta) = (numbers(alpha)?, numbers(beta)?);
    ensure(alpha.len() == beta.len() && alpha.len() >= 2, "as many alpha as beta")?;
    let rows = mass.iter().zip(rates).map(|(masses, rates)| {
        let mut row = Row::new(masses.len());
        for (column, (m, l)) in masses.iter().zip(rates).enumerate() {
            for (k, (a, b)) in (0..).zip(alpha.iter().zip(&beta)) {
                row.add(column, &m.moved(k, [0; 3]), a);
                row.add(column, &l.negated().moved(k, [0; 3]), b);
            }
        }
        row.clear()
    });
    Ok(rows.collect())
}

/// `z U = U + Σ b_i K_i`, `M K_i = L (U + Σ a_ij K_j)`.
fn stages(mass: &Matrix, rates: &Matrix, a: &[Vec<String>], b: &[String]) -> Read<Matrix> {
    let (size, count) = (mass.len(), b.len());
    let b = numbers(b)?;
    ensure(
        count > 0 && a.len() == count && a.iter().all(|row| row.len() <= count),
        "no Butcher table",
    )?;
    let mut rows = Vec::new();
    for unknown in 0..size {
        let mut row = Row::new(size * (count + 1));
        row.add(unknown, &advance(), &Fraction::one());
        for (i, weight) in b.iter().enumerate() {
            row.add(size * (i + 1) + unknown, &constant(-1), weight);
        }
        rows.push(row.clear());
    }
    for (i, entries) in a.iter().enumerate() {
        let entries = numbers(entries)?;
        for (masses, rates) in mass.iter().zip(rates) {
            let mut row = Row::new(size * (count + 1));
            for (unknown, (m, l)) in masses.iter().zip(rates).enumerate() {
                row.add(size * (i + 1) + unknown, m, &Fraction::one());
                row.add(unknown, &l.negated(), &Fraction::one());
                for (j, entry) in entries.iter().enumerate() {
                    row.add(size * (j + 1) + unknown, &l.negated(), entry);
                }
            }
            rows.push(row.clear());
        }
    }
    Ok(rows)
}

/// Positions and velocities, `x' = v` and `M v' = F x + D v`: the accelerations of the stages stand behind them.
fn nystrom(
    mass: &Matrix,
    rates: &Matrix,
    c: &[String],
    tables: [&Vec<Vec<String>>; 2],
    weights: [&Vec<String>; 2],
) -> Read<Matrix> {
    ensure(mass.len() == 2, "positions and velocities are two unknowns")?;
    let kinematic = |&(row, x): &(usize, usize)| {
        mass[row][1 - x].is_zero()
            && rates[row][x].is_zero()
            && mass[1 - row][x].is_zero()
            && mass[row][x] == rates[row][1 - x]
            && mass[row][x].0.len() == 1
    };
    let found = [(0, 0), (1, 1), (0, 1), (1, 0)].into_iter().find(kinematic);
    let Some((row, x)) = found else {
        return Err(CertificateError("no equation x' = v".into()));
    };
    let (v, dynamic) = (1 - x, 1 - row);
    let inertia = &mass[dynamic][v];
    let (force, drag) = (rates[dynamic][x].negated(), rates[dynamic][v].negated());
    let (drifts, count, one) = (numbers(c)?, c.len(), Fraction::one());
    ensure(
        tables.iter().all(|table| table.len() == count)
            && tables.iter().all(|table| table.iter().all(|row| row.len() <= count))
            && weights.iter().all(|row| row.len() == count),
        "as many rows and weights as stages",
    )?;
    let mut rows = Vec::new();
    for (unknown, weights) in [(x, weights[0]), (v, weights[1])] {
        let mut line = Row::new(2 + count);
        line.add(unknown, &advance(), &one);
        if unknown == x {
            line.add(v, &constant(-1), &one);
        }
        for (j, weight) in numbers(weights)?.iter().enumerate() {
            line.add(2 + j, &constant(-1), weight);
        }
        rows.push(line.clear());
    }
    for i in 0..count {
        let mut line = Row::new(2 + count);
        line.add(x, &force, &one);
        line.add(v, &force, &drifts[i]);
        line.add(v, &drag, &one);
        line.add(2 + i, inertia, &one);
        for (table, entry) in tables.into_iter().zip([&force, &drag]) {
            for (j, factor) in numbers(&table[i])?.iter().enumerate() {
                line.add(2 + j, entry, factor);
            }
        }
        rows.push(line.clear());
    }
    Ok(rows)
}
