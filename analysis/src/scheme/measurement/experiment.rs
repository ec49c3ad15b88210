//! What a step does to impulses, and whether that is all it does.

use super::from_stencil::Place;
use super::layout::StateLayout;
use rayon::prelude::*;
use thiserror::Error;

/// Sums of measured numbers may differ by this many times what one of them may be wrong by.
const OF_SUMS: f64 = 1000.0;

/// The amplitude of differences about a state of order 1: truncation `h²` and round-off `2^−53/h` are both near `1e-10`.
const AMPLITUDE: f64 = 1.0 / 131_072.0;

/// Differences forward and about a state agree to its amplitude times half the curvature; about a kink they do not, which differences about
/// it do not see.
const OF_A_KINK: f64 = 1e-3;

/// A relative deviation up to this looks like arithmetic of single precision.
const SINGLE_PRECISION: f64 = 1e-5;

/// The state about which a step is measured.
#[derive(Debug, Clone, PartialEq)]
pub enum Base {
    /// A linear step: `S(v) − S(0)`.
    Zero,
    /// Any smooth step, linearised: `(S(b + hv) − S(b − hv))/2h`.
    About(Vec<f64>),
}

impl Base {
    /// How far a measured number may usually be wrong: by 64 units of the last place, as sums over a long row are; of differences about a
    /// state by 1e-9, where truncation and round-off are equal.
    pub fn usual_tolerance(&self) -> f64 {
        match self {
            Self::Zero => 64.0 * f64::EPSILON,
            Self::About(_) => 1e-9,
        }
    }
}

/// How a step is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// What a state is.
    pub layout: StateLayout,
    /// About which state.
    pub base: Base,
    /// How far a measured number may be wrong, as a share of the largest answer.
    pub tolerance: f64,
}

/// What one step does to the values around: `new_p(j) = Σ g · old_q(j + k)`.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredStencil {
    /// The coefficients that are not zero to the tolerance.
    pub coefficients: Vec<(Place, f64)>,
    /// How far each may be wrong.
    pub tolerance: f64,
    /// The largest of what the step adds to a state that is zero.
    pub source: f64,
}

/// Why a step has no stencil.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Objection<E> {
    /// The step could not be taken.
    #[error("{0}")]
    Step(E),
    /// Answers are not proportional to states.
    #[error(
        "the step is not linear: {times} times the state does not give {times} times the answer, it is off by {off:.1e} of it{}; linearise it about a state", hint(*off)
    )]
    NotProportional {
        /// The factor.
        times: f64,
        /// The relative deviation.
        off: f64,
    },
    /// Derivatives of two amplitudes, or to two sides, differ.
    #[error(
        "the step has no derivative at this state: differences over two amplitudes, or to two sides, differ by {off:.1e}{}", hint(*off)
    )]
    NotSmooth {
        /// The relative deviation.
        off: f64,
    },
    /// A moved state does not give a moved answer.
    #[error(
        "the step is not the same everywhere: a state moved round the lattice gives an answer that is not the one moved, off by {off:.1e} of it{}; walls, coefficients that vary and a state that varies have no waves", hint(*off)
    )]
    NotInvariant {
        /// The relative deviation.
        off: f64,
    },
    /// Impulses do not add up.
    #[error(
        "the step is not linear: the answers to single impulses do not add up to the answer to a random state, off by {off:.1e} of it{}; a limiter does this", hint(*off)
    )]
    NotAdditive {
        /// The relative deviation.
        off: f64,
    },
    /// The stencil reaches round the lattice.
    #[error(
        "the stencil is too wide for the lattice: an impulse reaches {reach} cells along axis {axis} of {size}; take a larger size (an implicit step reaches all cells)"
    )]
    TooWide {
        /// The axis, from 0.
        axis: usize,
        /// Cells along it.
        size: usize,
        /// The longest offset.
        reach: usize,
    },
}

fn hint(off: f64) -> &'static str {
    if off < SINGLE_PRECISION { " (single precision? then a tolerance of 1e-6)" } else { "" }
}

impl Experiment {
    /// Measures a step: impulses in each unknown, a random state at two amplitudes and at two places. The step takes a state and gives
    /// the new level; it is called from several threads.
    ///
    /// ```
    /// use courant_analysis::scheme::measurement::{Base, Experiment, StateLayout};
    /// let layout = StateLayout { levels: 1, unknowns: 1, size: vec![12] };
    /// let experiment = Experiment { layout, base: Base::Zero, tolerance: 1e-14 };
    /// let upwind = |u: &[f64]| (0..12).map(|j| u[j] - 0.5 * (u[j] - u[(j + 11) % 12])).collect();
    /// let found = experiment.measure(|u| Ok::<Vec<f64>, String>(upwind(u))).unwrap();
    /// assert_eq!(found.coefficients.iter().map(|(_, g)| *g).collect::<Vec<_>>(), [0.5, 0.5]);
    /// assert_eq!(found.coefficients[0].0.offset, [-1]);
    /// ```
    ///
    /// # Errors
    /// When a step fails, is not linear (or not smooth), not the same everywhere, or reaches round the lattice.
    pub fn measure<E: Send>(
        &self,
        step: impl Fn(&[f64]) -> Result<Vec<f64>, E> + Sync,
    ) -> Result<MeasuredStencil, Objection<E>> {
        let layout = &self.layout;
        let at_base = match &self.base {
            Base::Zero => step(&vec![0.0; layout.values()]).map_err(Objection::Step)?,
            Base::About(base) => step(base).map_err(Objection::Step)?,
        };
        let random = layout.random();
        // Odd along the first axis, so that red and black cells change places, and another number along each of the others.
        let by: Vec<i64> = (0..layout.size.len() as i64).map(|axis| 1 + axis).collect();
        let unit = self.unit();
        let second = if self.base == Base::Zero { -2.0 } else { 2.0 };
        let blocks = layout.levels * layout.unknowns;
        let mut asked: Vec<(Vec<f64>, f64)> =
            (0..blocks).map(|block| (layout.impulse(block), unit)).collect();
        asked.extend([
            (random.clone(), unit),
            (random.clone(), second * unit),
            (layout.shifted(&random, &by), unit),
        ]);
        let mut answers = asked
            .par_iter()
            .map(|(direction, amplitude)| self.derivative(&step, &at_base, direction, *amplitude))
            .collect::<Result<Vec<_>, E>>()
            .map_err(Objection::Step)?;
        let shifted = answers.pop().expect("four kinds of states were asked for");
        let amplified = answers.pop().expect("four kinds of states were asked for");
        let plain = answers.pop().expect("four kinds of states were asked for");
        let largest = answers.iter().flatten().fold(1.0, |most: f64, g| most.max(g.abs()));
        let tolerance = self.tolerance * largest;
        let off = |a: &[f64], b: &[f64]| {
            let scale = a.iter().chain(b).fold(largest, |most, value| most.max(value.abs()));
            let deviation = a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            Some(deviation / scale).filter(|off| *off > OF_SUMS * self.tolerance)
        };
        if let Some(off) = off(&plain, &amplified) {
            return Err(match self.base {
                Base::Zero => Objection::NotProportional { times: second, off },
                Base::About(_) => Objection::NotSmooth { off },
            });
        }
        if let Base::About(base) = &self.base {
            let forward: Vec<f64> = base.iter().zip(&random).map(|(b, v)| b + unit * v).collect();
            let forward = step(&forward).map_err(Objection::Step)?;
            let forward = off(&plain, &quotient(&forward, &at_base, unit));
            if let Some(off) = forward.filter(|off| *off > OF_A_KINK) {
                return Err(Objection::NotSmooth { off });
            }
        }
        if let Some(off) = off(&layout.shifted(&plain, &by), &shifted) {
            return Err(Objection::NotInvariant { off });
        }
        let coefficients = self.coefficients(&answers, tolerance);
        if let Some(off) = off(&plain, &self.superposed(&coefficients, &random)) {
            return Err(Objection::NotAdditive { off });
        }
        self.reaches_round(&coefficients)?;
        let source = match self.base {
            Base::Zero => at_base.iter().fold(0.0, |most: f64, value| most.max(value.abs())),
            Base::About(_) => 0.0,
        };
        Ok(MeasuredStencil { coefficients, tolerance, source })
    }

    /// How many steps a measurement takes.
    pub fn runs(&self) -> usize {
        let directions = self.layout.levels * self.layout.unknowns + 3;
        match self.base {
            Base::Zero => 1 + directions,
            Base::About(_) => 2 + 2 * directions,
        }
    }

    /// The amplitude that counts as 1.
    fn unit(&self) -> f64 {
        match &self.base {
            Base::Zero => 1.0,
            Base::About(base) => {
                AMPLITUDE * base.iter().fold(1.0, |most: f64, value| most.max(value.abs()))
            }
        }
    }

    /// How the answer changes along a direction.
    fn derivative<E>(
        &self,
        step: impl Fn(&[f64]) -> Result<Vec<f64>, E>,
        at_base: &[f64],
        direction: &[f64],
        amplitude: f64,
    ) -> Result<Vec<f64>, E> {
        let moved = |by: f64| match &self.base {
            Base::Zero => step(&direction.iter().map(|v| by * v).collect::<Vec<_>>()),
            Base::About(base) => {
                step(&base.iter().zip(direction).map(|(b, v)| b + by * v).collect::<Vec<_>>())
            }
        };
        let forward = moved(amplitude)?;
        Ok(match self.base {
            Base::Zero => quotient(&forward, at_base, amplitude),
            Base::About(_) => quotient(&forward, &moved(-amplitude)?, 2.0 * amplitude),
        })
    }

    /// What is not zero of the answers to impulses.
    fn coefficients(&self, answers: &[Vec<f64>], tolerance: f64) -> Vec<(Place, f64)> {
        let layout = &self.layout;
        let cells = layout.cells();
        let middle = layout.indices(layout.middle());
        let mut found = Vec::new();
        for (block, answer) in answers.iter().enumerate() {
            for (place, &value) in answer.iter().enumerate().filter(|(_, g)| g.abs() > tolerance) {
                let at = layout.indices(place % cells);
                let offset = middle.iter().zip(&at).zip(&layout.size);
                let offset = offset.map(|((from, to), &size)| nearest(from - to, size as i64));
                let place = Place {
                    row: place / cells,
                    column: block % layout.unknowns,
                    level: block / layout.unknowns,
                    offset: offset.collect(),
                };
                found.push((place, value));
            }
        }
        found.sort_by(|(a, _), (b, _)| a.cmp(b));
        found
    }

    /// The answer to a state that the coefficients give.
    fn superposed(&self, coefficients: &[(Place, f64)], state: &[f64]) -> Vec<f64> {
        let layout = &self.layout;
        let cells = layout.cells();
        let mut answer = vec![0.0; layout.unknowns * cells];
        for (place, value) in coefficients {
            let block = place.level * layout.unknowns + place.column;
            for cell in 0..cells {
                let indices = layout.indices(cell);
                let from: Vec<i64> =
                    indices.iter().zip(&place.offset).map(|(j, k)| j + k).collect();
                answer[place.row * cells + cell] +=
                    value * state[block * cells + layout.cell(&from)];
            }
        }
        answer
    }

    /// Where an offset comes near half the lattice, it cannot be told from one that goes the other way.
    fn reaches_round<E>(&self, coefficients: &[(Place, f64)]) -> Result<(), Objection<E>> {
        for (axis, &size) in self.layout.size.iter().enumerate() {
            let reaches = coefficients.iter().map(|(place, _)| place.offset[axis].unsigned_abs());
            let reach = reaches.max().unwrap_or(0) as usize;
            if 2 * (reach + 1) >= size {
                return Err(Objection::TooWide { axis, size, reach });
            }
        }
        Ok(())
    }
}

fn quotient(a: &[f64], b: &[f64], by: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| (a - b) / by).collect()
}

/// The shortest offset on a ring.
fn nearest(offset: i64, size: i64) -> i64 {
    let offset = offset.rem_euclid(size);
    if 2 * offset > size { offset - size } else { offset }
}

#[cfg(test)]
mod tests;
