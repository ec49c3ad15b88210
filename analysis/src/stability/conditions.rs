//! When all roots of `χ(z)` lie in the closed unit disc, as real polynomials of the wave and the parameters that must not be
//! negative: Schur, Cohn and Jury.
//!
//! Roots on the circle or in pairs `z, 1/z̄` whatever the parameters are split off first, as the common divisor of `χ` and its
//! reversed conjugate; for these Cohn's theorem asks about the derivative.

use crate::exact::laurent::{Laurent, Variable, greatest_common_divisor};
use crate::exact::matrix::Matrix;
use crate::exact::rational::Rational;
use crate::interest::Interest;
use crate::scheme::Names;

/// What a condition says about the multipliers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Condition {
    /// No real multiplier passes +1: `χ(1) ≥ 0`.
    PlusOne,
    /// No real multiplier passes −1: `(−1)^n χ(−1) ≥ 0`.
    MinusOne,
    /// No complex pair leaves the circle: one of Jury's inner determinants of this size.
    Inner(usize),
    /// The Schur–Cohn minor of this size.
    Minor(usize),
}

impl Condition {
    /// The word used in files.
    pub fn name(self) -> String {
        match self {
            Self::PlusOne => "plus-one".into(),
            Self::MinusOne => "minus-one".into(),
            Self::Inner(_) => "oscillation".into(),
            Self::Minor(size) => format!("schur-cohn-minor-{size}"),
        }
    }
}

/// A real polynomial that must not be negative.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Requirement {
    /// What it says.
    pub condition: Condition,
    /// Whether it comes from multipliers that lie on the circle throughout: where it vanishes two of them meet.
    pub on_circle: bool,
    /// The polynomial, real on every wave.
    pub polynomial: Laurent,
    /// The square that it was divided by, up to a shift and a number.
    pub square: Laurent,
}

/// All conditions for `|z| ≤ 1`.
#[derive(Debug, Clone, Default)]
pub struct Conditions {
    /// Together they hold where all multipliers lie in the closed disc, but for a thin set of waves.
    pub requirements: Vec<Requirement>,
    /// The conditions contradict one another for every wave: a multiplier is always outside.
    pub nowhere: bool,
    /// A condition vanishes only because squares of square roots are numbers: what else has common roots then is not looked at.
    pub undecided: bool,
}

impl Conditions {
    /// Of `χ`, for `|z| ≤ 1 + growth`.
    ///
    /// ```
    /// use courant_analysis::exact::rational::integer;
    /// use courant_analysis::scheme::Step;
    /// use courant_analysis::stability::Conditions;
    /// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?;
    /// let conditions = Conditions::new(&leapfrog.characteristic()?, &integer(0), leapfrog.names());
    /// // Both multipliers on the circle: the derivative decides, 4 − |2C sin φ|² ≥ 0.
    /// assert!(conditions.requirements.iter().all(|one| one.on_circle));
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    pub fn new(characteristic: &Laurent, growth: &Rational, names: &Names) -> Self {
        Self::while_wanted(characteristic, growth, names, &Interest::default())
    }

    /// [`new`](Self::new), undecided once nobody wants them.
    pub(crate) fn while_wanted(
        characteristic: &Laurent,
        growth: &Rational,
        names: &Names,
        interest: &Interest,
    ) -> Self {
        let content = characteristic.content(Variable::TIME);
        let primitive = characteristic.divide_exactly(&content).expect("a content divides");
        let mut coefficients = primitive.coefficients(Variable::TIME);
        let degree = coefficients.len() - 1;
        let radius = growth + Rational::from_integer(1.into());
        for (power, coefficient) in coefficients.iter_mut().enumerate() {
            // z becomes (1 + ε) z, times the denominator of 1 + ε to the degree.
            let factor =
                radius.numer().pow(power as u32) * radius.denom().pow((degree - power) as u32);
            *coefficient = coefficient.scaled(&factor);
        }
        let mut conditions = Self::default();
        conditions.add(coefficients, false, names, interest);
        if interest.is_lost() {
            return Self { undecided: true, ..Self::default() };
        }
        for requirement in &mut conditions.requirements {
            let reduced = names.reduce(std::mem::take(&mut requirement.polynomial));
            conditions.undecided |= reduced.is_zero();
            requirement.polynomial = reduced;
        }
        conditions
    }

    /// Adds what `Σ_m a_m z^m` asks for.
    fn add(
        &mut self,
        coefficients: Vec<Laurent>,
        on_circle: bool,
        names: &Names,
        interest: &Interest,
    ) {
        if interest.is_lost() {
            return;
        }
        let coefficients = without_content(coefficients);
        let degree = coefficients.len() - 1;
        let reversed: Vec<Laurent> = coefficients.iter().rev().map(Laurent::conjugate).collect();
        let proportional = (0..=degree).all(|m| {
            let difference =
                &coefficients[degree] * &reversed[m] - &reversed[degree] * &coefficients[m];
            names.reduce(difference).is_zero()
        });
        if proportional {
            self.add_on_circle(coefficients, names, interest);
            return;
        }
        let whole = Laurent::from_coefficients(&coefficients, Variable::TIME);
        let mirrored = Laurent::from_coefficients(&reversed, Variable::TIME);
        let common = greatest_common_divisor(&whole, &mirrored);
        let rest = whole.divide_exactly(&common).expect("a divisor divides").primitive();
        self.add_on_circle(common.coefficients(Variable::TIME), names, interest);
        let rest = without_repetitions(rest).coefficients(Variable::TIME);
        self.add_inside(rest, on_circle, interest);
    }

    /// Cohn: all roots of a self-inversive polynomial lie on the circle if and only if those of its derivative lie in the disc.
    fn add_on_circle(&mut self, coefficients: Vec<Laurent>, names: &Names, interest: &Interest) {
        let whole = Laurent::from_coefficients(&coefficients, Variable::TIME);
        let whole = without_repetitions(whole);
        if whole.degree(Variable::TIME) > 0 {
            let derivative = whole.derivative(Variable::TIME).coefficients(Variable::TIME);
            self.add(derivative, true, names, interest);
        }
    }

    /// At least one root, and none in common with the reversed conjugate.
    fn add_inside(&mut self, coefficients: Vec<Laurent>, on_circle: bool, interest: &Interest) {
        let degree = coefficients.len() - 1;
        let requirements = match real(&coefficients).and_then(|real| jury(&real, interest)) {
            Some(requirements) => requirements,
            None => match schur_cohn(&coefficients, interest) {
                Some(requirements) => requirements,
                None => {
                    self.nowhere = true;
                    return;
                }
            },
        };
        for (condition, polynomial) in requirements {
            if interest.is_lost() {
                return;
            }
            // Squares out of the way: boxes do not decide where they touch zero.
            let odd = if degree > 1 { polynomial.odd_part() } else { polynomial.clone() };
            let square = polynomial.divide_exactly(&odd).expect("the odd part divides");
            self.requirements.push(Requirement { condition, on_circle, polynomial: odd, square });
        }
    }
}

fn without_content(coefficients: Vec<Laurent>) -> Vec<Laurent> {
    let whole = Laurent::from_coefficients(&coefficients, Variable::TIME).primitive();
    let content = whole.content(Variable::TIME);
    whole.divide_exactly(&content).expect("a content divides").coefficients(Variable::TIME)
}

/// With each of the roots once: their conditions are the same, and of smaller determinants.
fn without_repetitions(whole: Laurent) -> Laurent {
    let repeated = greatest_common_divisor(&whole, &whole.derivative(Variable::TIME));
    whole.divide_exactly(&repeated).expect("a divisor divides")
}

/// The coefficients shifted so that each is a real function of the wave, if one shift serves all.
fn real(coefficients: &[Laurent]) -> Option<Vec<Laurent>> {
    let leading = coefficients.last()?;
    let mut shifted = coefficients.to_vec();
    for axis in 0..3 {
        // Odd when added, no shift makes them real.
        let (low, high) = leading.range(Variable::axis(axis))?;
        for coefficient in &mut shifted {
            *coefficient = coefficient.shifted(Variable::axis(axis), -(low + high) / 2);
        }
    }
    shifted.iter().all(Laurent::is_real).then_some(shifted)
}

/// Jury's conditions for real coefficients `[a_0, …, a_n]`, each times a power of `a_n` so that its sign does not matter. `None`
/// when an inner determinant vanishes identically.
fn jury(a: &[Laurent], interest: &Interest) -> Option<Vec<(Condition, Laurent)>> {
    let degree = a.len() - 1;
    let leading = &a[degree];
    let constant = leading.as_constant();
    let signed = |polynomial: Laurent, odd: bool| match &constant {
        Some(value) if *value > 0.into() => polynomial,
        Some(_) if odd => -polynomial,
        Some(_) => polynomial,
        None if odd => &polynomial * leading,
        None => polynomial,
    };
    let at = |sign: i64| {
        (0..=degree).fold(Laurent::default(), |sum, power| {
            let factor = if power % 2 == 1 { sign } else { 1 };
            sum + &a[power] * &Laurent::integer(factor)
        })
    };
    let plus = signed(at(1), true);
    let minus = signed(at(-1) * Laurent::integer(if degree % 2 == 1 { -1 } else { 1 }), true);
    if degree == 1 && constant.is_none() {
        // The product of the two is shorter: the only minor.
        return None;
    }
    let mut conditions = vec![(Condition::PlusOne, plus), (Condition::MinusOne, minus)];
    if degree == 2 {
        // The other sign, a_2 + a_0, is the sum of χ(1) and χ(−1).
        conditions.push((Condition::Inner(1), signed(leading.clone() - a[0].clone(), true)));
    }
    if degree > 2 {
        for sign in [1, -1] {
            // X + sign Y: a_n, a_{n−1}, … above the diagonal, a_0, a_1, … below the other one.
            let size = degree - 1;
            let entry = |row: usize, column: usize| {
                let upper = if column >= row {
                    a[degree - (column - row)].clone()
                } else {
                    Laurent::default()
                };
                let lower = if row + column + 1 >= size {
                    a[row + column + 1 - size].clone()
                } else {
                    Laurent::default()
                };
                upper + lower * Laurent::integer(sign)
            };
            let mut margin = 0;
            while size > 2 * margin {
                let inner = (margin..size - margin)
                    .map(|row| (margin..size - margin).map(|column| entry(row, column)).collect());
                let determinant = Matrix::new(inner.collect()).determinant_while(interest);
                if determinant.is_zero() {
                    return None;
                }
                let order = size - 2 * margin;
                conditions.push((Condition::Inner(order), signed(determinant, order % 2 == 1)));
                margin += 1;
            }
        }
    }
    Some(conditions)
}

/// The Schur–Cohn minors of complex coefficients `[a_0, …, a_n]`; `None` when one vanishes identically and the last does not, so that
/// the form is nowhere definite.
fn schur_cohn(a: &[Laurent], interest: &Interest) -> Option<Vec<(Condition, Laurent)>> {
    let degree = a.len() - 1;
    // H_ij = Σ_k (a_{n−i+k} ā_{n−j+k} − ā_{i−k} a_{j−k}), k ≤ min(i, j), from 0.
    let entry = |i: usize, j: usize| {
        (0..=i.min(j)).fold(Laurent::default(), |sum, k| {
            let outer = &a[degree - i + k] * &a[degree - j + k].conjugate();
            sum + outer - &a[i - k].conjugate() * &a[j - k]
        })
    };
    (1..=degree)
        .map(|size| {
            let rows = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect());
            let minor = Matrix::new(rows.collect()).determinant_while(interest);
            (!minor.is_zero()).then_some((Condition::Minor(size), minor))
        })
        .collect()
}

#[cfg(test)]
mod tests;
