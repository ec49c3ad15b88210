//! Waves that grow like a power of the number of steps: multiple multipliers on the unit circle with too few eigenvectors.

use super::StableSet;
use super::at_value::zeros_of;
use super::inequality::symmetric;
use super::wave::Wave;
use crate::exact::float::{ComplexFloat, Float};
use crate::exact::laurent::{Laurent, Variable, greatest_common_divisor};
use crate::exact::matrix::Matrix;
use crate::exact::rational::{Rational, from_f64, integer, ratio};
use crate::scheme::{Letter, SchemeError, Step};
use crate::waves::precise::{Place, PreciseStep};
use crate::waves::torus_growth::place;
use crate::waves::wave_terms::{difference_terms, primitive_characteristic};
use num_bigint::BigInt;
use num_complex::Complex64;
use num_traits::Zero;

mod ends;

/// Bits of the arithmetic in which multipliers and ranks are looked at: 150 digits.
const BITS: u32 = 512;

/// Bits to which waves are enclosed whose multipliers meet.
const WAVE_BITS: u32 = 192;

/// Where the wave is enclosed so narrowly, multipliers that meet there are apart by the root of it.
const EXACT: Tolerance = Tolerance { close: -40, nothing: -60 };

/// Powers of two.
#[derive(Debug, Clone, Copy)]
struct Tolerance {
    /// Multipliers nearer than this are one.
    close: i64,
    /// What is below this is zero.
    nothing: i64,
}

/// The discriminant of a polynomial in `z` of higher degree is not expanded.
const MOST_DEGREE: usize = 4;

/// A multiplier on the unit circle that is multiple, and has fewer eigenvectors than that.
#[derive(Debug, Clone, PartialEq)]
pub struct MultipleMultiplier {
    /// The wave.
    pub wave: Wave,
    /// The multiplier.
    pub multiplier: Complex64,
    /// How often it is a root.
    pub multiplicity: usize,
    /// How many independent eigenvectors it has.
    pub eigenvectors: usize,
    /// Whether the waves looked at are all whose multipliers meet: the zeros of a discriminant, isolated exactly. Multiplicity and
    /// eigenvectors are always counted in arithmetic of 150 digits.
    pub all_waves: bool,
}

/// The waves with such multipliers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Multiplicity {
    /// One whose amplitude grows like a power of the number of steps.
    pub growing: Option<MultipleMultiplier>,
    /// One with the multiplier 1, shorter than the longest, where the longest wave has such a multiplier too: a displacement that nothing
    /// pulls back and that drifts. The drift of the longest wave is that of the differential equation, and not named; where the longest
    /// wave does not drift, a shorter one that does is growing.
    pub drift: Option<MultipleMultiplier>,
}

/// Looks for multiple multipliers of a step whose parameters all have values.
///
/// ```
/// use courant_analysis::{exact::rational::integer, scheme::Step, stability::multiplicity_at};
/// let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?;
/// let found = multiplicity_at(&leapfrog.with("C", &integer(1))?)?.growing.unwrap();
/// assert_eq!((found.multiplicity, found.eigenvectors), (2, 1));
/// // −i at a quarter of the circle.
/// assert!((found.wave.phases()[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-15 && (found.multiplier.im + 1.0).abs() < 1e-15);
/// # Ok::<(), courant_analysis::scheme::SchemeError>(())
/// ```
///
/// # Errors
/// When a parameter has no value.
pub fn multiplicity_at(step: &Step) -> Result<Multiplicity, SchemeError> {
    multiplicity_among(step, None)
}

/// [`multiplicity_at`], with one more wave that is looked at in two and three dimensions, where the waves whose multipliers meet are not
/// isolated: phases that are multiples of π/2 are looked at there, and this one.
pub(crate) fn multiplicity_among(
    step: &Step,
    wave: Option<&Wave>,
) -> Result<Multiplicity, SchemeError> {
    let open = step.free_parameters();
    if !open.is_empty() {
        return Err(SchemeError::NotSet(open));
    }
    let chi = primitive_characteristic(step)?;
    let terms = difference_terms(&chi);
    let chi = chi.coefficients(Variable::TIME);
    if chi.len() < 3 {
        return Ok(Multiplicity::default());
    }
    let precise = PreciseStep::new(step, &terms, BITS);
    let (places, all_waves) = match step.dimension() {
        1 => {
            let (waves, all) = meeting_waves(step, &chi);
            (waves.iter().map(|s| precise.place(s, &Rational::zero(), 0.0)).collect(), all)
        }
        dimension => (places_on_torus(&precise, dimension, wave), false),
    };
    let matrix = step.reduced();
    let (mut result, mut longest_drifts) = (Multiplicity::default(), false);
    for place in places {
        let longest = place.0.iter().all(|axis| axis.s.is_zero());
        for found in multiple_at(step, &matrix, &precise, &place, EXACT) {
            let found = MultipleMultiplier { all_waves, ..found };
            let is_one = (found.multiplier - 1.0).norm() < 1e-15;
            match (is_one, longest) {
                (false, _) => _ = result.growing.get_or_insert(found),
                (true, false) => _ = result.drift.get_or_insert(found),
                (true, true) => longest_drifts = true,
            }
        }
    }
    if !longest_drifts {
        result.growing = result.growing.or(result.drift.take());
    }
    Ok(result)
}

impl Step {
    /// A multiplier on the unit circle that is multiple and lacks eigenvectors for every wave at every value of a parameter, where all
    /// others have values: then no value of `set` is more than marginally stable. The wave that it is returned for is the shortest, where
    /// that is one of them.
    ///
    /// ```
    /// use courant_analysis::scheme::Step;
    /// // v is driven by what does not change: v grows by the same amount in each step.
    /// let driven = Step::from_text("u[n+1,j] = u[n,j]; v[n+1,j] = v[n,j] + C*(u[n,j] - u[n,j-1])")?;
    /// let set = driven.stable_set("C", &Default::default())?;
    /// let found = driven.multiple_on_every_wave("C", &set)?.unwrap();
    /// assert_eq!((found.wave.phase(), found.multiplicity, found.eigenvectors), (Some(std::f64::consts::PI), 2, 1));
    /// # Ok::<(), courant_analysis::scheme::SchemeError>(())
    /// ```
    ///
    /// # Errors
    /// When the parameter does not occur or another has no value.
    pub fn multiple_on_every_wave(
        &self,
        parameter: &str,
        set: &StableSet,
    ) -> Result<Option<MultipleMultiplier>, SchemeError> {
        let chi = primitive_characteristic(self)?;
        let Some(interval) = set.intervals.first().filter(|_| chi.degree(Variable::TIME) > 1)
        else {
            return Ok(None);
        };
        // Looked at for one wave at one value first, which costs little.
        let from = from_f64(interval.from.upper()).unwrap_or_default();
        let to = from_f64(interval.to.lower()).unwrap_or_else(|| &from + integer(1));
        let step = self.with(parameter, &(&from + (to - &from) * ratio(5, 13)))?;
        let step = step.expanded();
        let precise =
            PreciseStep::new(&step, &difference_terms(&primitive_characteristic(&step)?), BITS);
        let place = any_place(&precise, step.dimension());
        if multiple_at(&step, &step.reduced(), &precise, &place, EXACT).is_empty() {
            return Ok(None);
        }
        // A factor that is repeated as the equations stand is so for every wave and value.
        let repeated = greatest_common_divisor(&chi, &chi.derivative(Variable::TIME));
        match repeated.contains(Variable::TIME) {
            true => Ok(multiplicity_at(&step)?.growing),
            false => Ok(None),
        }
    }
}

/// No particular wave.
fn any_place(precise: &PreciseStep, dimension: usize) -> Place {
    let phase = |axis: usize| (ratio(1, 3 + 2 * axis as i64), false);
    precise.place_on_torus(&(0..dimension).map(phase).collect::<Vec<_>>())
}

/// Waves whose phases are multiples of π/2, one of no particular phases, and one more.
fn places_on_torus(precise: &PreciseStep, dimension: usize, wave: Option<&Wave>) -> Vec<Place> {
    let phase = |quarter: usize| (ratio([0, 1, 2, 1][quarter], 2), quarter == 3);
    let at = |number: usize| -> Vec<(Rational, bool)> {
        (0..dimension).map(|axis| phase(number >> (2 * axis) & 3)).collect()
    };
    let quarters = (0..1usize << (2 * dimension)).map(|number| precise.place_on_torus(&at(number)));
    let given = wave.map(|wave| place(precise, wave.phases()));
    quarters.chain([any_place(precise, dimension)]).chain(given).collect()
}

/// The waves for which two multipliers may be equal, and whether these are all.
fn meeting_waves(step: &Step, chi: &[Laurent]) -> (Vec<Rational>, bool) {
    let ends = vec![integer(0), integer(1)];
    let whole = Laurent::from_coefficients(chi, Variable::TIME);
    let repeated = greatest_common_divisor(&whole, &whole.derivative(Variable::TIME));
    let (mut waves, mut simple) = (ends, chi.to_vec());
    if repeated.contains(Variable::TIME)
        && let Some(rest) = whole.divide_exactly(&repeated)
    {
        // Equal for every wave: any will do.
        waves.push(ratio(1, 3));
        simple = rest.coefficients(Variable::TIME);
    }
    if simple.len() > MOST_DEGREE + 1 {
        return (waves, false);
    }
    let discriminant = step.names.reduce(discriminant(&simple));
    let real = symmetric(discriminant.clone())
        .unwrap_or_else(|| step.names.reduce(&discriminant * &discriminant.conjugate()));
    if real.is_zero() {
        waves.push(ratio(1, 3));
    }
    let inexact = |(variable, letter): (Variable, &Letter)| {
        real.contains(variable) && !letter.value.is_exact()
    };
    let all_waves = !step.names.letters().any(inexact);
    waves.extend(zeros_of(&real, &step.names, WAVE_BITS));
    (waves, all_waves)
}

fn derivative(a: &[Laurent]) -> Vec<Laurent> {
    (1..).zip(&a[1..]).map(|(power, value)| value.scaled(&BigInt::from(power))).collect()
}

/// The resultant of a polynomial `[a_0, a_1, …]` and its derivative: the determinant of Sylvester's matrix.
fn discriminant(a: &[Laurent]) -> Laurent {
    let degree = a.len() - 1;
    let derivative = derivative(a);
    let size = 2 * degree - 1;
    let row = |polynomial: &[Laurent], shift: usize| {
        let mut row = vec![Laurent::default(); size];
        row[shift..shift + polynomial.len()].clone_from_slice(polynomial);
        row
    };
    let upper = (0..degree - 1).map(|shift| row(a, shift));
    let lower = (0..degree).map(|shift| row(&derivative, shift));
    Matrix::new(upper.chain(lower).collect()).determinant()
}

/// The multiple multipliers on the circle of one wave that lack eigenvectors.
fn multiple_at(
    step: &Step,
    matrix: &Matrix,
    precise: &PreciseStep,
    place: &Place,
    tolerance: Tolerance,
) -> Vec<MultipleMultiplier> {
    let mut rest = precise.differences(&precise.coefficients(place));
    let mut found = Vec::new();
    while let Some(first) = rest.pop() {
        let near = |y: &ComplexFloat| is_below(&(y - &first), tolerance.close);
        let (mut cluster, others): (Vec<_>, Vec<_>) = rest.into_iter().partition(near);
        rest = others;
        cluster.push(first);
        let multiplicity = cluster.len();
        if multiplicity < 2 {
            continue;
        }
        let zero = ComplexFloat::real(Float::zero(BITS));
        let sum = cluster.iter().fold(zero, |sum, y| &sum + y);
        let count = ComplexFloat::real(Float::integer(&multiplicity.into(), BITS));
        let mean = &sum / &count;
        let excess = ComplexFloat::real(&mean.re.clone().scaled(1) + &mean.norm_sqr());
        if !is_below(&excess, tolerance.nothing) {
            continue;
        }
        let z = &mean + &ComplexFloat::real(Float::integer(&1.into(), BITS));
        let eigenvectors = nullity(step, matrix, precise, place, &z, tolerance.nothing);
        if eigenvectors < multiplicity {
            found.push(MultipleMultiplier {
                wave: Wave::new(place.phases()),
                multiplier: z.to_c64(),
                multiplicity,
                eigenvectors,
                all_waves: true,
            });
        }
    }
    found
}

fn is_below(value: &ComplexFloat, exponent: i64) -> bool {
    value.magnitude().is_none_or(|magnitude| magnitude < exponent)
}

/// The dimension of the null space of `P(z, E)`, by elimination with full pivoting, rows in units of their largest term.
fn nullity(
    step: &Step,
    matrix: &Matrix,
    precise: &PreciseStep,
    place: &Place,
    z: &ComplexFloat,
    nothing: i64,
) -> usize {
    if matrix.size() == 1 {
        return 1;
    }
    let mut rows: Vec<Vec<ComplexFloat>> = matrix
        .rows()
        .iter()
        .map(|row| {
            let entries: Vec<_> =
                row.iter().map(|entry| precise.value(entry, step, place, z)).collect();
            let unit = entries.iter().filter_map(|entry| entry.1).max().unwrap_or(0);
            entries.into_iter().map(|entry| entry.0.scaled(-unit)).collect()
        })
        .collect();
    let size = rows.len();
    for rank in 0..size {
        let places = (rank..size).flat_map(|i| (rank..size).map(move |j| (i, j)));
        let largest = places.max_by_key(|&(i, j)| rows[i][j].magnitude().unwrap_or(i64::MIN));
        let Some((row, column)) = largest.filter(|&(i, j)| !is_below(&rows[i][j], nothing)) else {
            return size - rank;
        };
        rows.swap(rank, row);
        rows.iter_mut().for_each(|row| row.swap(rank, column));
        let (pivots, below) = rows.split_at_mut(rank + 1);
        let pivot = &pivots[rank];
        for row in below {
            let factor = &row[rank] / &pivot[rank];
            for j in rank..size {
                row[j] = &row[j] - &(&factor * &pivot[j]);
            }
        }
    }
    0
}

#[cfg(test)]
mod tests;
