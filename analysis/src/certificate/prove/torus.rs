//! Certificates in two and three dimensions: cuts of every cube of waves, and an exact wave at either end.

use super::super::derive::{Characteristic, Derived, Poly};
use super::super::verify::torus::Margin;
use super::super::{
    Certificate, CosineTerm, End, Exact, Interval, Proof, Subject, TorusCell, TorusInequality,
    TorusPiece, TorusPoint, TorusProof, TorusWave,
};
use super::ends::{BEYOND, above, zero};
use super::levels::{PARAMETER, from_laurent, text, to_laurent};
use super::{CertificationError, MAX_BOXES};
use crate::exact::laurent::{Exponents, Laurent, Variable};
use crate::exact::rational::{Rational, integer, square_root_enclosure, to_f64};
use crate::exact::real_roots::power_of_two;
use crate::exact::tensor::{CubeSign, Cut, Origin, Tensor, cuts_of_cube};
use crate::interest::Interest;
use crate::stability::{
    Cell, Condition as Kind, Edge, ExactSpot, ExactValue, Limit, Requirement, SearchPlan,
    StableInterval, StableSet, StableStretch, StretchEnd, TorusDemands, Turn, stretches_on_torus,
    whole_cells,
};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// Pieces that the interval of `t` of one cube may be cut into, and boxes that one coefficient may take.
const MAX_PIECES: usize = 200;
const BOXES_OF_A_PIECE: usize = 4000;

/// Limits found in two ways may differ by the widths of their enclosures.
const NEAR: f64 = 1e-6;

/// How near a square root is enclosed.
const ROOT_BITS: u32 = 80;

/// The certificates of all stable intervals.
pub(super) fn certificates(
    base: &Certificate,
    derived: &[Derived],
    chi: &Characteristic,
    set: &StableSet,
    plan: &SearchPlan,
) -> Result<Vec<Certificate>, CertificationError> {
    let conditions = derived.iter().map(|one| Condition::new(one, chi, &base.subject));
    let conditions = conditions.collect::<Result<Vec<_>, _>>()?;
    let requirement = |one: &Condition| Requirement {
        condition: Kind::Minor(1),
        on_circle: false,
        polynomial: one.margin.clone(),
        square: Laurent::integer(1),
    };
    let requirements: Vec<Requirement> = conditions.iter().map(requirement).collect();
    let demands =
        TorusDemands::new(&requirements, chi.dimension, Some(Variable(PARAMETER)), &plan.interest);
    let demands = demands.ok_or(CertificationError::NotWritten("a condition is not real"))?;
    let found = stretches_on_torus(&demands, plan);
    let as_found = |(own, known): (&StableStretch, &StableInterval)| {
        is_near(&own.from.upper, demands.stride, &known.from)
            && match &own.to {
                StretchEnd::Edge(edge, _) => is_near(&edge.upper, demands.stride, &known.to),
                StretchEnd::Range => !known.to.is_unbounded(),
                StretchEnd::Unbounded => known.to.is_unbounded(),
            }
    };
    let same = found.all.len() == set.intervals.len()
        && found.all.iter().zip(&set.intervals).all(as_found);
    if !found.decided || !same {
        return Err(CertificationError::NotWritten("the checker's conditions do not bear it out"));
    }
    let prover = Prover { base, conditions: &conditions, demands: &demands, plan };
    let mut all = Vec::new();
    if found.all.first().is_none_or(|first| first.from.upper.is_positive()) {
        let spot = found.unstable_at_once.ok_or(CertificationError::NoWitness)?;
        let upper = Rational::zero();
        let above = prover.above(&upper, &[spot])?;
        all.push(prover.certificate(zero(), None, Some(above), |_| Ok(Vec::new()))?);
    }
    for stretch in &found.all {
        all.extend(prover.interval(&stretch.from, &stretch.to)?);
    }
    Ok(all)
}

/// Whether a limit is the value of the parameter that belongs to a `t`.
fn is_near(t: &Rational, stride: usize, limit: &Limit) -> bool {
    let value = to_f64(t).powf(1.0 / stride as f64);
    limit.lower() * (1.0 - NEAR) <= value && value <= limit.upper() * (1.0 + NEAR)
}

/// A condition as `|Q|²` times its margin.
struct Condition {
    stated: TorusInequality,
    margin: Laurent,
}

impl Condition {
    fn new(
        derived: &Derived,
        chi: &Characteristic,
        subject: &Subject,
    ) -> Result<Self, CertificationError> {
        let not = |why| Err(CertificationError::NotWritten(why));
        if derived.polynomial.0.keys().any(|power| !power.letters.is_empty()) {
            return not("numbers in several dimensions are no fractions");
        }
        let whole = to_laurent(&derived.polynomial);
        if whole.is_zero() {
            return not("a condition vanishes identically");
        }
        let (root, _) = whole.square_part();
        let square = &root * &root.conjugate();
        let (root, margin) = match whole.divide_exactly(&square) {
            Some(rest) => (root, rest),
            None => (Laurent::integer(1), whole),
        };
        if !margin.is_real() {
            return not("a condition is not real");
        }
        let terms = margin.terms().iter().filter_map(|term| cosine(term, chi.dimension)).collect();
        let root: Vec<Poly<BigInt>> = vec![from_laurent(&root)];
        let stated = TorusInequality {
            level: derived.level,
            condition: derived.condition.clone(),
            square: text(&root, subject, chi.dimension),
            margin: terms,
            cells: Vec::new(),
        };
        Ok(Self { stated, margin })
    }
}

/// One of two terms that are each other's conjugates.
fn cosine((exponents, value): &(Exponents, BigInt), dimension: usize) -> Option<CosineTerm> {
    let k: Vec<i32> = exponents[1..=dimension].iter().map(|&e| i32::from(e)).collect();
    let first = k.iter().find(|k| **k != 0).copied().unwrap_or(0);
    let twice = BigInt::from(if first == 0 { 1 } else { 2 });
    let power = exponents[PARAMETER] as usize;
    (first >= 0).then(|| CosineTerm { power, k, value: (value * twice).into() })
}

struct Prover<'a> {
    base: &'a Certificate,
    conditions: &'a [Condition],
    demands: &'a TorusDemands,
    plan: &'a SearchPlan,
}

impl Prover<'_> {
    /// One stable stretch; `None` for a single value.
    fn interval(
        &self,
        from: &Edge,
        to: &StretchEnd,
    ) -> Result<Option<Certificate>, CertificationError> {
        let begin = &from.upper;
        let last = self.power(&self.plan.max);
        let (reached, lower, upper, above) = match to {
            StretchEnd::Edge(edge, wave) => {
                let spots: Vec<ExactSpot> =
                    std::iter::once(wave).chain(&edge.spot).cloned().collect();
                let above = self.above(&edge.upper, &spots)?;
                let ends = (self.end(&edge.lower), Some(self.end(&edge.upper)));
                (edge.lower.clone(), ends.0, ends.1, Some(above))
            }
            StretchEnd::Range => (last, End::Fraction(self.plan.max.clone()), None, None),
            StretchEnd::Unbounded => (last.max(begin * integer(2)), End::Infinity, None, None),
        };
        if reached <= *begin {
            return Ok(None);
        }
        let below = match begin.is_positive() {
            true => Some(self.below(from)?),
            false => None,
        };
        let without_end = lower == End::Infinity;
        let interval = Interval { begin: self.end(begin), lower, upper };
        let cells = |one: &Condition| self.cells(one, begin, &reached, without_end);
        self.certificate(interval, below, above, cells).map(Some)
    }

    fn certificate(
        &self,
        interval: Interval,
        below: Option<TorusWave>,
        above: Option<TorusWave>,
        cells: impl Fn(&Condition) -> Result<Vec<TorusCell>, CertificationError>,
    ) -> Result<Certificate, CertificationError> {
        let inequality =
            |one: &Condition| Ok(TorusInequality { cells: cells(one)?, ..one.stated.clone() });
        let inequalities =
            self.conditions.iter().map(inequality).collect::<Result<_, CertificationError>>()?;
        let stride = self.demands.stride;
        let proof = Proof::Torus(TorusProof { stride, inequalities, below, above });
        Ok(Certificate { interval, proof, ..self.base.clone() })
    }

    fn power(&self, value: &Rational) -> Rational {
        value.pow(self.demands.stride as i32)
    }

    /// The value of the parameter that belongs to a `t`.
    fn end(&self, t: &Rational) -> End {
        match (self.demands.stride, ExactValue::square_root(t.clone())) {
            (2, ExactValue::SquareRoot(square)) => End::Root(square),
            (2, ExactValue::Fraction(root)) => End::Fraction(root),
            _ => End::Fraction(t.clone()),
        }
    }

    /// The cubes of a condition with their cuts.
    fn cells(
        &self,
        condition: &Condition,
        begin: &Rational,
        reached: &Rational,
        without_end: bool,
    ) -> Result<Vec<TorusCell>, CertificationError> {
        let (parameter, stride) = (Some(Variable(PARAMETER)), self.demands.stride);
        let dimension = condition.stated.margin[0].k.len();
        let mut boxes = 0;
        let cells = whole_cells(&condition.margin, dimension, parameter, stride).map(|cell| {
            let mut pieces = Vec::new();
            let mut pending = vec![(begin.clone(), reached.clone())];
            while let Some((from, to)) = pending.pop() {
                match cuts(&cell.between(&from, &to), &mut boxes, &self.plan.interest) {
                    Some(cuts) => pieces.push(TorusPiece { end: End::Fraction(to), cuts }),
                    None if pieces.len() + pending.len() >= MAX_PIECES || boxes > MAX_BOXES => {
                        return Err(CertificationError::TooLarge);
                    }
                    None => {
                        let middle = (&from + &to) / integer(2);
                        pending.push((middle.clone(), to));
                        pending.push((from, middle));
                    }
                }
            }
            if without_end {
                let rows = cell.reversed().between(&Rational::zero(), &reached.recip());
                let cuts = cuts(&rows, &mut boxes, &self.plan.interest);
                let cuts = cuts.ok_or(CertificationError::TooLarge)?;
                pieces.push(TorusPiece { end: End::Infinity, cuts });
            }
            Ok(TorusCell { cube: cube(&cell), begin: begin.clone().into(), pieces })
        });
        cells.collect()
    }

    /// One of these waves, unstable from `t` to a little above it.
    fn above(&self, t: &Rational, spots: &[ExactSpot]) -> Result<TorusWave, CertificationError> {
        let near = match self.demands.stride {
            2 => square_root_enclosure(t, t, ROOT_BITS).1,
            _ => t.clone(),
        };
        let values: Vec<Rational> = above(&near, &self.plan.max).collect();
        let grows = |margin: &Margin, wave: &TorusWave| {
            margin.grows_between(wave, t, &self.power(&wave.value.0)).is_ok()
        };
        self.wave(spots, &values, grows)
    }

    /// The wave at the beginning of a stretch, unstable at a value a little below it.
    fn below(&self, from: &Edge) -> Result<TorusWave, CertificationError> {
        let near = match self.demands.stride {
            2 => square_root_enclosure(&from.lower, &from.lower, ROOT_BITS).0,
            _ => from.lower.clone(),
        };
        let values = BEYOND.map(|bits| &near * (integer(1) - power_of_two(-i64::from(bits))));
        let spots: Vec<ExactSpot> = from.spot.iter().cloned().collect();
        let grows = |margin: &Margin, wave: &TorusWave| {
            margin.grows_at(wave, &self.power(&wave.value.0)).is_ok()
        };
        self.wave(&spots, &values, grows)
    }

    /// The first wave and value that the checker agrees to: as a point of its cube, else in the chart where it was found.
    fn wave(
        &self,
        spots: &[ExactSpot],
        values: &[Rational],
        grows: impl Fn(&Margin, &TorusWave) -> bool,
    ) -> Result<TorusWave, CertificationError> {
        for spot in spots {
            let inequality = spot.inequality;
            let cell = &self.demands.inequalities[inequality].cells[spot.cell];
            let margin = Margin::new(&self.conditions[inequality].stated, self.demands.stride)?;
            let in_piece = (String::new(), cell.origin.in_whole(spot.point.clone()));
            for (way, point) in [in_piece, (way(&cell.origin), spot.point.clone())] {
                let point = point.into_iter().map(Exact).collect();
                let wave = TorusPoint { inequality, cube: cube(cell), way, point };
                for value in values {
                    let wave = TorusWave { wave: wave.clone(), value: value.clone().into() };
                    if grows(&margin, &wave) {
                        return Ok(wave);
                    }
                }
            }
        }
        Err(CertificationError::NoWitness)
    }
}

const AXES: [char; 3] = ['x', 'y', 'z'];

fn letters(axes: &[usize]) -> String {
    axes.iter().map(|&axis| AXES[axis]).collect()
}

/// The letter of each axis.
fn cube(cell: &Cell) -> String {
    let letter = |turn: &Turn| match turn {
        Turn::Half => 'h',
        Turn::Quarter(quarter) => char::from(b'0' + quarter),
    };
    cell.turns.iter().map(letter).collect()
}

/// From the whole cube to a chart.
fn way(origin: &Origin) -> String {
    let step = |of: &Origin, step: String| way(of) + &step;
    match origin {
        Origin::Whole => String::new(),
        Origin::Half { of, axis, upper } => {
            step(of, format!("{}{}", AXES[*axis], if *upper { '>' } else { '<' }))
        }
        Origin::Flipped { of, axis } => step(of, format!("~{}", AXES[*axis])),
        Origin::Chart { of, axes, leader } => {
            step(of, format!("{{{}}}{}", letters(axes), AXES[*leader]))
        }
    }
}

/// The cuts of all coefficients in `t`; `None` where one is not decided.
fn cuts(rows: &[Tensor], boxes: &mut usize, interest: &Interest) -> Option<Vec<String>> {
    let mut all = Vec::new();
    for row in rows {
        let (sign, cuts) = cuts_of_cube(row, BOXES_OF_A_PIECE, interest);
        *boxes += cuts.len();
        if sign != CubeSign::NowhereNegative {
            return None;
        }
        let text = |cut: &Cut| match cut {
            Cut::Leaf => ".".into(),
            Cut::Half(axis) => letters(&[*axis]),
            Cut::Charts { flipped, axes } => {
                let flips: String =
                    flipped.iter().map(|&axis| format!("~{}", AXES[axis])).collect();
                format!("{flips}{{{}}}", letters(axes))
            }
        };
        all.push(cuts.iter().map(text).collect());
    }
    Some(all)
}
