//! Kernel sums: weights on the lattice, and their sums over the running index as letters.

use super::value::{Scalar, Value, minus, plus, push, times};
use super::{Place, Reader};
use crate::exact::enclosed_series::EnclosedSeries;
use crate::exact::rational::Rational;
use crate::scheme::kernel_function::{KernelFunction, KernelLattice};
use crate::scheme::language::LanguageError;
use crate::scheme::language::syntax::{Offset, Span, Weight};
use crate::scheme::names::{Fraction, LetterKind};
use num_traits::{One, Zero};

impl<'a> Reader<'a> {
    pub(super) fn lattice(&self, span: &Span) -> Result<&'a KernelLattice, LanguageError> {
        let missing = "kernel sums need a kernel and its ratio: give --kernel and --ratio";
        self.lattice.ok_or_else(|| self.error(missing, span))
    }

    pub(super) fn weight(
        &mut self,
        weight: Weight,
        offset: Offset,
        index: Option<&str>,
        span: &Span,
    ) -> Result<Value, LanguageError> {
        let lattice = self.lattice(span)?;
        let unknown = "this kernel is given by its derivatives only: W is not known";
        if offset.halves % 2 != 0 {
            return Err(self.error("a lattice weight has a whole offset", span));
        }
        match (offset.index, index) {
            (0, _) => {
                let place = (offset.halves / 2).unsigned_abs() as usize;
                let (value, radius) =
                    lattice.weight(weight, place).ok_or_else(|| self.error(unknown, span))?;
                let kind = match weight {
                    Weight::Value => "W",
                    Weight::Slope => "w",
                    Weight::Curvature => "v",
                };
                self.enclosed(value, radius, &format!("{kind}{place}"), span)
            }
            (1, Some(_)) if offset.halves == 0 => {
                let function = KernelFunction::weight(lattice, weight)
                    .ok_or_else(|| self.error(unknown, span))?;
                Ok(Value::Scalar(vec![(Fraction::number(&Rational::one()), Some(function))]))
            }
            _ => Err(self.error("inside a sum over k a weight is written w[k]", span)),
        }
    }

    /// `Σ_k f(k)`: a letter, unless it is exact.
    pub(super) fn total(
        &mut self,
        function: &KernelFunction,
        span: &Span,
    ) -> Result<Scalar, LanguageError> {
        let (sum, radius) = function.sum();
        if radius.is_zero() {
            return Ok(vec![(Fraction::number(&sum), None)]);
        }
        let series = EnclosedSeries::new(&[sum], radius);
        let of = Some(function.clone());
        let variable = self.letter(LetterKind::Constant, series, of, "s", span)?;
        Ok(vec![(Fraction::variable(variable), None)])
    }

    /// Adds up over the running index: `E^{±k} = Σ… = Σ f − s V ± (E − 1/E)/2 S`.
    pub(super) fn sum(&mut self, value: Value, span: &Span) -> Result<Value, LanguageError> {
        let lattice = self.lattice(span)?;
        let reach = lattice.reach();
        let terms = match value {
            Value::Scalar(scalar) => {
                let mut total: Scalar = Vec::new();
                for (fraction, function) in scalar {
                    let function = function.unwrap_or_else(|| KernelFunction::one(reach));
                    let sum = self.total(&function, span)?;
                    total = plus(total, times(&vec![(fraction, None)], &sum));
                }
                return Ok(Value::Scalar(total));
            }
            Value::Linear(terms) => terms,
        };
        // What belongs together, as in 2 x[j] - x[j+k] - x[j-k], is added up before letters are made: what cancels needs none.
        let mut shares: Vec<(Place, [Scalar; 3])> = Vec::new();
        for (place, scalar) in terms {
            let multiple = place.space[0].index;
            let mut base = place;
            base.space.iter_mut().for_each(|offset| offset.index = 0);
            let in_time = place.time.is_some_and(|time| time.index != 0);
            if multiple.abs() > 1 || place.space[1..].iter().any(|o| o.index != 0) || in_time {
                return Err(self.error("inside a sum over k an unknown stands at j+k or j-k", span));
            }
            let number = match shares.iter().position(|(known, _)| *known == base) {
                Some(number) => number,
                None => {
                    shares.push((base, Default::default()));
                    shares.len() - 1
                }
            };
            let [sums, versines, sines] = &mut shares[number].1;
            let times_index = |scalar: Scalar| if multiple < 0 { minus(scalar) } else { scalar };
            *sums = plus(std::mem::take(sums), scalar.clone());
            if multiple != 0 {
                *versines = plus(std::mem::take(versines), scalar.clone());
                *sines = plus(std::mem::take(sines), times_index(scalar));
            }
        }
        let mut result: Vec<(Place, Scalar)> = Vec::new();
        for (base, [sums, versines, sines]) in shares {
            let occurring = |scalar: Scalar| {
                let function = |function: Option<KernelFunction>| {
                    function.unwrap_or_else(|| KernelFunction::one(reach))
                };
                let kept = scalar.into_iter().filter(|(fraction, _)| !fraction.is_zero());
                kept.map(|(fraction, f)| (fraction, function(f))).collect::<Vec<_>>()
            };
            for (fraction, function) in occurring(sums) {
                let sum = self.total(&function, span)?;
                push(&mut result, base, times(&vec![(fraction, None)], &sum));
            }
            let versines = occurring(versines).into_iter().map(|(fraction, f)| {
                let shares = [(-1, (1, 4)), (0, (-1, 2)), (1, (1, 4))];
                (fraction, f.versines(), f, LetterKind::Versines, shares)
            });
            let sines = occurring(sines).into_iter().map(|(fraction, f)| {
                let shares = [(-1, (-1, 2)), (0, (0, 1)), (1, (1, 2))];
                (fraction, f.sines(), f, LetterKind::Sines, shares)
            });
            for (fraction, series, function, kind, shares) in versines.chain(sines) {
                if series.is_zero() {
                    continue;
                }
                let name = if kind == LetterKind::Versines { "V" } else { "S" };
                let variable = self.letter(kind, series, Some(function), name, span)?;
                let letter = fraction.times(&Fraction::variable(variable));
                for (step, (numerator, denominator)) in shares {
                    let share =
                        Fraction::number(&crate::exact::rational::ratio(numerator, denominator));
                    let mut moved = base;
                    moved.space[0].halves += 2 * step;
                    push(&mut result, moved, vec![(letter.times(&share), None)]);
                }
            }
        }
        result.retain(|(_, scalar)| scalar.iter().any(|(fraction, _)| !fraction.is_zero()));
        Ok(Value::Linear(result))
    }
}
