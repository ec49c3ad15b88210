//! Exact decisions about stretches of `t = C^stride`, all waves at once.

use super::TorusInequality;
use super::cell::rounded;
use super::guess::{Critical, Guesses, Spot};
use crate::exact::bernstein::{Work, is_negative_integer_polynomial};
use crate::exact::polynomial::Polynomial;
use crate::exact::rational::{Rational, from_f64, integer, simplest_between, to_f64};
use crate::exact::real_roots::{RealRoot, power_of_two, real_roots};
use crate::exact::tensor::{CubeSign, cuts_of_cube};
use crate::interest::Interest;
use crate::stability::stable_set::fraction_or_root;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use std::collections::VecDeque;

/// Boxes of one decision, and of all together, of polynomials of moderate length; fewer of longer ones. Where growth by ε is permitted, waves along
/// a diagonal come within ε of the bound, and boxes about it have a breadth of `√ε`.
const MOST_BOXES: usize = 40_000;
const MOST_BOXES_IN_ALL: usize = 60_000;

/// What is moderate: so many coefficients.
const MODERATE: usize = 1000;

/// Boxes for an exact limit.
const EASY: usize = 40_000;

/// What may be spent more on the last resort.
const RESERVE: usize = 10_000;

/// Pieces a stretch of `t` may be cut into.
const MOST_PIECES: usize = 400;

/// Coordinates of a wave are taken as a fraction with so small a denominator, where one is this near.
const SIMPLE: i64 = 16;
const NEAR_SIMPLE: f64 = 1e-5;

/// Bits of the coordinates of other waves: a wave next to the binding one binds later by the square of its distance.
const WAVE_BITS: u32 = 60;

/// A wave as an exact point of a cell.
#[derive(Debug, Clone)]
pub(crate) struct ExactSpot {
    pub(crate) inequality: usize,
    pub(crate) cell: usize,
    pub(crate) point: Vec<Rational>,
}

/// Where instability begins or ends: nothing is claimed strictly between the two values of `t`.
#[derive(Debug, Clone)]
pub(crate) struct Edge {
    pub(crate) lower: Rational,
    pub(crate) upper: Rational,
    pub(crate) spot: Option<ExactSpot>,
}

/// What stands against the stability of a stretch.
pub(super) enum Objection {
    /// This wave is unstable at this `t`.
    Wave(ExactSpot, Rational),
    /// The work that is allowed does not suffice.
    Budget,
}

pub(super) struct Search<'a> {
    pub(super) inequalities: &'a [TorusInequality],
    pub(super) guesses: Guesses,
    pub(super) end: Rational,
    /// The relative width of enclosures, as a power of one half.
    pub(super) bits: u32,
    budget: usize,
    /// Boxes looked at, long ones counted more often; and how many may be.
    spent: usize,
    most: usize,
    interest: Interest,
    pub(super) work: Work,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        inequalities: &'a [TorusInequality],
        end: Rational,
        bits: u32,
        budget: usize,
    ) -> Self {
        let guesses = Guesses::new(inequalities, to_f64(&end));
        let (spent, most) = (0, MOST_BOXES_IN_ALL.min(budget));
        let bits = bits.max(8);
        let (interest, work) = (Interest::default(), Work::default());
        Self { inequalities, guesses, end, bits, budget, spent, most, interest, work }
    }

    /// Without any more boxes once nobody wants the answer.
    pub(super) fn while_wanted(self, interest: &Interest) -> Self {
        Self { interest: interest.clone(), ..self }
    }

    /// For decisions alone, with no idea where stability may end.
    pub(super) fn without_guesses(
        inequalities: &'a [TorusInequality],
        end: Rational,
        budget: usize,
    ) -> Self {
        Self { inequalities, ..Self::new(&[], end, 0, budget) }
    }

    /// [`is_stable`](Self::is_stable) with few boxes: at an exact limit whose wave is no corner of a cube they would be halved without end.
    pub(super) fn is_easily_stable(&mut self, from: &Rational, to: &Rational) -> bool {
        let most = self.most;
        self.most = most.min(self.spent + EASY);
        let stable = self.is_stable(from, to).is_ok();
        self.most = most;
        stable
    }

    /// Some boxes more, for what can be proved at all.
    pub(super) fn allow_more(&mut self) {
        self.most = (self.spent + RESERVE).min(self.budget);
    }

    /// Whether all conditions hold for all waves and all `t` of a stretch, ends included: proved.
    pub(super) fn is_stable(&mut self, from: &Rational, to: &Rational) -> Result<(), Objection> {
        let all = self.inequalities.iter().enumerate();
        let all = all.flat_map(|(i, one)| (0..one.cells.len()).map(move |cell| (i, cell)));
        let task = |(inequality, cell)| (inequality, cell, from.clone(), to.clone());
        let mut pending: VecDeque<_> = all.map(task).collect();
        let mut pieces = MOST_PIECES.min(self.budget);
        while let Some((inequality, cell, lower, upper)) = pending.pop_front() {
            if self.interest.is_lost() {
                return Err(Objection::Budget);
            }
            match self.sign(inequality, cell, &lower, &upper)? {
                true => {}
                false if pieces == 0 || lower == upper => return Err(Objection::Budget),
                false => {
                    pieces -= 1;
                    let middle = (&lower + &upper) / integer(2);
                    pending.push_back((inequality, cell, lower, middle.clone()));
                    pending.push_back((inequality, cell, middle, upper));
                }
            }
        }
        Ok(())
    }

    /// Whether a condition holds on a cell for a whole stretch; `false` where a shorter stretch may say more.
    fn sign(
        &mut self,
        inequality: usize,
        cell: usize,
        from: &Rational,
        to: &Rational,
    ) -> Result<bool, Objection> {
        let rows = if from == to {
            vec![self.inequalities[inequality].cells[cell].at_parameter(from)]
        } else {
            self.inequalities[inequality].cells[cell].between(from, to)
        };
        let last = rows.len() - 1;
        let mut holds = true;
        // The ends first: there a negative value is a counterexample.
        let order = [0, last].into_iter().chain(1..last);
        for index in order.take(rows.len()) {
            if !holds && index != last {
                break;
            }
            if self.spent >= self.most {
                return Err(Objection::Budget);
            }
            let weight = 1 + rows[index].values().len() / MODERATE;
            let allowed = (MOST_BOXES.min(self.budget) / weight).max(1);
            let (sign, cuts) = cuts_of_cube(&rows[index], allowed, &self.interest);
            self.work.boxes += cuts.len();
            self.spent += cuts.len() * weight;
            match sign {
                CubeSign::NowhereNegative => {}
                CubeSign::NegativeAt(point) if index == 0 || index == last => {
                    let spot = ExactSpot { inequality, cell, point };
                    let t = if index == 0 { from } else { to };
                    return Err(Objection::Wave(spot, t.clone()));
                }
                _ => holds = false,
            }
        }
        Ok(holds)
    }

    /// Whether the stretch from the end of the range to infinity is stable.
    pub(super) fn is_stable_beyond(&mut self) -> bool {
        if self.end.is_zero() {
            return false;
        }
        let reversed = |one: &TorusInequality| TorusInequality {
            cells: one.cells.iter().map(|cell| cell.reversed()).collect(),
            ..one.clone()
        };
        let inequalities: Vec<TorusInequality> = self.inequalities.iter().map(reversed).collect();
        let mirrored = Search::without_guesses(&inequalities, self.end.recip(), self.budget);
        let mut mirrored = mirrored.while_wanted(&self.interest);
        let end = mirrored.end.clone();
        let stable = mirrored.is_stable(&Rational::zero(), &end).is_ok();
        self.work += mirrored.work;
        stable
    }

    /// The condition at a wave, as a polynomial in `t`.
    pub(super) fn at_spot(&mut self, spot: &ExactSpot) -> Vec<BigInt> {
        self.work.evaluations += 1;
        self.inequalities[spot.inequality].cells[spot.cell].at_point(&spot.point)
    }

    /// A sample as an exact wave: a simple one if it is next to one.
    pub(super) fn exact_spots(&self, spot: &Spot) -> Vec<ExactSpot> {
        let at = |point: Vec<Rational>| ExactSpot {
            inequality: spot.inequality,
            cell: spot.cell,
            point,
        };
        let simple = |x: &f64| -> Option<Rational> {
            if *x <= NEAR_SIMPLE {
                return Some(integer(0));
            }
            let nearest = simplest_between(
                &from_f64(x - NEAR_SIMPLE)?,
                &from_f64((x + NEAR_SIMPLE).min(1.0))?,
            );
            (*nearest.denom() <= SIMPLE.into()).then_some(nearest)
        };
        let near: Vec<Rational> = spot
            .point
            .iter()
            .map(|x| simple(x).unwrap_or_else(|| rounded(*x, WAVE_BITS)))
            .collect();
        let plain: Vec<Rational> = spot.point.iter().map(|x| rounded(*x, WAVE_BITS)).collect();
        if near == plain { vec![at(near)] } else { vec![at(near), at(plain)] }
    }

    /// The `t` at which the wave of a guess becomes unstable (or stable again), exactly or enclosed.
    pub(super) fn edge(&mut self, guess: &Critical) -> Option<Edge> {
        if guess.parameter <= 0.0 {
            return None;
        }
        let from = from_f64(guess.parameter * (1.0 - 1e-6))?;
        let to = from_f64(guess.parameter * (1.0 + 1e-6))?;
        for spot in self.exact_spots(&guess.spot) {
            let coefficients = self.at_spot(&spot);
            let root = fraction_or_root(coefficients, guess.parameter, &from, &to, self.bits + 20);
            let near = |root: &RealRoot| (to_f64(&root.lower) / guess.parameter - 1.0).abs() < 1e-8;
            if let Some(root) = root.filter(near) {
                return Some(Edge { lower: root.lower, upper: root.upper, spot: Some(spot) });
            }
        }
        None
    }

    /// Whether a wave is unstable for every `t` strictly between two.
    pub(super) fn is_unstable_between(
        &mut self,
        from: &Rational,
        to: &Rational,
        spot: &ExactSpot,
    ) -> bool {
        is_negative_integer_polynomial(&self.at_spot(spot), from, to) == Some(true)
    }

    /// Up to which `t` a wave is unstable, from just above another one on; `None` when it is not.
    pub(super) fn unstable_until(&mut self, from: &Rational, spot: &ExactSpot) -> Option<Rational> {
        let coefficients = self.at_spot(spot);
        let polynomial =
            Polynomial::new(coefficients.iter().cloned().map(Rational::from).collect());
        let tiny = power_of_two(-60);
        let start = if from.is_zero() { &self.end * &tiny } else { from * (integer(1) + tiny) };
        let negative_at = |t: &Rational| polynomial.evaluate(t).is_negative();
        if is_negative_integer_polynomial(&coefficients, from, &start) != Some(true)
            || !negative_at(&start)
        {
            return None;
        }
        let roots = real_roots(&polynomial, &start, &self.end, 40);
        let mut before = start;
        for (index, root) in roots.iter().enumerate() {
            // Between this root and the next the sign is one: a root that is only touched leaves it as it is.
            let next = roots.get(index + 1).map_or(&self.end, |next| &next.lower);
            let between = (&root.upper + next) / integer(2);
            if !negative_at(&between) {
                // Strictly below it, where the sign is still negative.
                let below = (&before + &root.lower) / integer(2);
                let near = &root.lower * (integer(1) - power_of_two(-50));
                let exact = root.exact().is_some();
                return Some(if exact { below.max(near) } else { root.lower.clone() });
            }
            before = between;
        }
        Some(self.end.clone())
    }
}
