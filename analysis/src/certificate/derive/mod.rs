//! The polynomials of a scheme from its text, by code of the checker's own: it shares fractions with the rest of the program, and
//! nothing else. The certificates are written about these polynomials; where they do not bear out what was found, none can be written.

mod conditions;
mod fraction;
mod integrator;
mod kernel;
mod letters;
mod matrix;
mod parser;
mod polynomial;
mod reader;

use super::verify::{CertificateError, ensure};
use super::{Level, Subject};
use crate::exact::rational::Rational;
pub(super) use conditions::{centring, derivative, proportional, reversed_conjugate};
use kernel::Lattice;
pub(super) use letters::{BITS, Letters, Series};
use matrix::{Whole, determinant_up_to_units, reduce};
use num_bigint::BigInt;
use polynomial::Shifts;
pub(super) use polynomial::{Letter, Poly, Power};
use reader::Reader;
use std::collections::BTreeMap;

/// A polynomial that must not be negative.
#[derive(Debug, Clone)]
pub(super) struct Derived {
    pub(super) level: usize,
    pub(super) condition: String,
    pub(super) polynomial: Poly<BigInt>,
}

/// `χ(z)` of a scheme and the values of its letters.
#[derive(Debug)]
pub(super) struct Characteristic {
    pub(super) coefficients: Vec<Poly<BigInt>>,
    pub(super) letters: Letters,
    /// The axes.
    pub(super) dimension: usize,
}

fn of_the_parameter(subject: &Subject) -> BTreeMap<String, Poly<Rational>> {
    [(subject.parameter.clone(), Poly::monomial(0, [0; 3], 1))].into()
}

/// `E` in one dimension, `E_1, E_2, E_3` in more.
pub(super) fn shift_name(axis: usize, dimension: usize) -> String {
    if dimension == 1 { "E".into() } else { format!("E_{}", axis + 1) }
}

impl Characteristic {
    /// `wave`: whether sums of enclosed weights become functions of the wave, as the conditions of stability want it, or one letter
    /// for each weight, as those of monotonicity do.
    pub(super) fn new(subject: &Subject, wave: bool) -> Result<Self, CertificateError> {
        let lattice = subject.kernel.as_ref().map(Lattice::new).transpose()?;
        let mut names = of_the_parameter(subject);
        for (name, value) in &subject.values {
            let twice = names.insert(name.clone(), Poly::number(value.0.clone()));
            ensure(twice.is_none(), "the sought parameter has a value")?;
        }
        let mut reader = Reader::new(names, lattice.as_ref(), wave);
        let rows = reader.rows(&subject.equations)?;
        let size = reader.unknowns.len();
        let mut parities: Vec<Option<(i32, Shifts)>> = vec![None; size];
        let mut matrix = vec![vec![Poly::default(); size]; size];
        for (row, target) in rows.iter().zip(&mut matrix) {
            for (place, poly) in row {
                ensure(
                    place.time.is_none() == subject.integrator.is_some(),
                    "an integrator completes the method of lines, and nothing else",
                )?;
                let parity = place.space.map(|halves| halves.rem_euclid(2));
                let own = (place.time.unwrap_or(0).rem_euclid(2), parity);
                let known = parities[place.unknown].get_or_insert(own);
                ensure(*known == own, "an unknown stands at whole and at half indices")?;
                let z = place.time.map_or(i32::from(place.derivative), |time| time.div_euclid(2));
                let entry = &mut target[place.unknown];
                *entry = std::mem::take(entry)
                    .plus(&poly.moved(z, place.space.map(|halves| halves.div_euclid(2))));
            }
        }
        if let Some(integrator) = &subject.integrator {
            matrix = integrator::complete(matrix, integrator)?;
        }
        let chi = determinant_up_to_units(matrix)?;
        let lowest = chi.0.keys().map(|power| power.z).min();
        let lowest = lowest.ok_or_else(|| CertificateError("the determinant vanishes".into()))?;
        let mut coefficients: Vec<Whole> = chi.moved(-lowest, [0; 3]).by_z();
        reduce(&mut coefficients);
        ensure(coefficients.len() > 1, "nothing is advanced in time")?;
        let dimension = reader.dimension.unwrap_or(1);
        Ok(Self { coefficients, letters: reader.letters, dimension })
    }

    /// The conditions of stability.
    pub(super) fn conditions(
        &self,
        subject: &Subject,
        growth: &Rational,
        levels: &[Level],
    ) -> Result<Vec<Derived>, CertificateError> {
        conditions::conditions(self.with_growth(growth), subject, self.dimension, levels)
    }

    pub(super) fn with_growth(&self, growth: &Rational) -> Vec<Poly<BigInt>> {
        conditions::with_growth(&self.coefficients, growth)
    }

    /// A polynomial in the shifts and the sought parameter as text.
    pub(super) fn polynomial(
        &self,
        text: &str,
        subject: &Subject,
    ) -> Result<Poly<BigInt>, CertificateError> {
        let mut powers = conditions::polynomial_in_z(text, subject, self.dimension)?;
        ensure(powers.len() == 1, "a factor depends on z")?;
        Ok(powers.remove(0))
    }

    /// The conditions of monotonicity.
    pub(super) fn monotonicity(&self) -> Result<Vec<Derived>, CertificateError> {
        conditions::coefficients(&self.coefficients, self.dimension)
    }
}
