//! What one step does to one wave, measured by running it.

use super::dense::Factors;
use super::eigenvalues::eigenvalues;
use super::lattice::PerAxis;
use super::rounded::largest;
use super::torus_scheme::{Rounding, Torus};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// A wave on every array of a state: cosine and sine, so that its amplitude is a complex number.
#[derive(Debug, Clone)]
pub(super) struct WaveState {
    cosine: Vec<Vec<f64>>,
    sine: Vec<Vec<f64>>,
}

/// One step restricted to one wave: a small matrix on the amplitudes of the history.
///
/// Its entries are measured: each array of the history is set to the wave `e^{iφ·j}`, the others to zero, and the amplitudes are read
/// after one step. Its eigenvalues are the multipliers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Propagator {
    /// Waves along each axis, negative where they run the other way.
    pub mode: PerAxis<i64>,
    /// `φ_a = 2π mode_a/N_a`.
    pub phase: PerAxis<f64>,
    /// By rows.
    pub matrix: Vec<Vec<Complex64>>,
    /// How far each entry may be off.
    pub errors: Vec<Vec<f64>>,
    /// The largest amplitude of any other wave after the step, against the bound for round-off: at most 1 where the step treats all
    /// cells alike.
    pub other_waves: f64,
}

impl Torus<'_> {
    /// The matrix of a wave, given by how many there are along each axis.
    pub(super) fn propagator(&self, mode: &[i64], rounding: &[Vec<Rounding>]) -> Propagator {
        let history = self.history();
        let mut matrix = vec![vec![Complex64::new(0.0, 0.0); history]; history];
        let mut errors = vec![vec![0.0; history]; history];
        let mut other_waves: f64 = 0.0;
        for one in 0..history {
            let mut amplitudes = vec![Complex64::new(0.0, 0.0); history];
            amplitudes[one] = Complex64::new(1.0, 0.0);
            let mut wave = WaveState::new(self, mode, &amplitudes);
            wave.step(self);
            for (row, (amplitude, rest)) in wave.amplitudes(self, mode).into_iter().enumerate() {
                matrix[row][one] = amplitude;
                let Rounding { size, error } = rounding[row][one];
                // The table of the wave and the sum over the cells leave a rounding each.
                errors[row][one] = (error + 3.0 * size) * f64::EPSILON;
                if rest > 0.0 {
                    other_waves = other_waves.max(rest / (2.0 * errors[row][one]));
                }
            }
        }
        let phase = self.lattice.phase(mode);
        Propagator { mode: PerAxis(mode.to_vec()), phase, matrix, errors, other_waves }
    }
}

impl WaveState {
    /// `a e^{iφ·j}` on every array.
    pub fn new(torus: &Torus<'_>, mode: &[i64], amplitudes: &[Complex64]) -> Self {
        let waves: Vec<Complex64> = torus.lattice.wave(mode).collect();
        let of = |part: fn(Complex64) -> f64| -> Vec<Vec<f64>> {
            let array = |a: &Complex64| waves.iter().map(|w| part(a * w)).collect();
            amplitudes.iter().map(array).collect()
        };
        Self { cosine: of(|value| value.re), sine: of(|value| value.im) }
    }

    /// One step: real and imaginary parts are run one after the other.
    pub fn step(&mut self, torus: &Torus<'_>) {
        torus.step(&mut self.cosine);
        torus.step(&mut self.sine);
    }

    /// The amplitude of the wave in each array, and how far the array is from that wave.
    pub fn amplitudes(&self, torus: &Torus<'_>, mode: &[i64]) -> Vec<(Complex64, f64)> {
        let waves: Vec<Complex64> = torus.lattice.wave(mode).collect();
        let both = self.cosine.iter().zip(&self.sine);
        both.map(|(cosine, sine)| {
            let cells = cosine.len();
            let values = || cosine.iter().zip(sine).map(|(&re, &im)| Complex64::new(re, im));
            let turned: Complex64 = values().zip(&waves).map(|(u, w)| u * w.conj()).sum();
            let amplitude = turned / cells as f64;
            let away = values().zip(&waves).map(|(u, w)| (u - amplitude * w).norm());
            (amplitude, largest(away))
        })
        .collect()
    }
}

impl Propagator {
    /// The multipliers: the eigenvalues of the matrix.
    pub fn multipliers(&self) -> Vec<Complex64> {
        eigenvalues(&self.matrix)
    }

    /// How far an eigenvalue may move when every entry changes by its error, and by what finding the eigenvalues of a matrix of this
    /// size costs: the radius of a circle about it on which no matrix within
    /// the errors has an eigenvalue, so that none can leave it (the bound is `ρ(|(A − w)⁻¹| E) < 1` at `w` on the circle, looked at in
    /// eight directions). Proportional to the errors where the eigenvalue is simple, to their root where two coincide.
    pub fn spread(&self, multiplier: Complex64) -> f64 {
        let size = self.matrix.len();
        let (norm, errors) = self.errors_with_elimination();
        let end = 2.0 * (size as f64 * norm + multiplier.norm() + 1.0);
        let mut radius = f64::EPSILON * (multiplier.norm() + f64::EPSILON * end);
        while radius < end {
            let directions =
                (0..8).map(|eighth| Complex64::from_polar(radius, TAU * f64::from(eighth) / 8.0));
            if directions
                .into_iter()
                .all(|direction| self.excludes(multiplier + direction, &errors))
            {
                return radius;
            }
            radius *= 2.0;
        }
        end
    }

    /// `det(w − A)`, and by how much of itself it may be off: `tr |(w − A)⁻¹| E`. `None` for an eigenvalue.
    pub(super) fn determinant(&self, point: Complex64) -> Option<(Complex64, f64)> {
        let size = self.matrix.len();
        let factors = self.shifted(point)?;
        let inverse = factors.inverse_columns();
        let (_, errors) = self.errors_with_elimination();
        let rest = f64::EPSILON * (size + 1) as f64;
        let places = (0..size).flat_map(|row| (0..size).map(move |column| (row, column)));
        let error: f64 = places
            .map(|(row, column)| {
                let shift = if row == column { f64::EPSILON * point.norm() } else { 0.0 };
                inverse[row][column].norm() * (errors[row][column] + 2.0 * shift)
            })
            .sum();
        let sign = if size.is_multiple_of(2) { 1.0 } else { -1.0 };
        Some((sign * factors.determinant(), error + 4.0 * rest))
    }

    /// The norm, and the errors of the entries with those of an elimination.
    fn errors_with_elimination(&self) -> (f64, Vec<Vec<f64>>) {
        let norm = self.matrix.iter().flatten().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let with = |row: &Vec<f64>| row.iter().map(|e| e + 2.0 * f64::EPSILON * norm).collect();
        (norm, self.errors.iter().map(with).collect())
    }

    /// Whether no matrix within twice the errors has this eigenvalue.
    fn excludes(&self, point: Complex64, errors: &[Vec<f64>]) -> bool {
        let size = self.matrix.len();
        let Some(factors) = self.shifted(point) else { return false };
        let inverse = factors.inverse_columns();
        // |(A − w)⁻¹| E by rows; a norm of it or of its powers bounds the spectral radius.
        let mut bound: Vec<Vec<f64>> = (0..size)
            .map(|row| {
                let entry = |column: usize| -> f64 {
                    (0..size).map(|k| inverse[k][row].norm() * errors[k][column]).sum()
                };
                (0..size).map(entry).collect()
            })
            .collect();
        for _ in 0..4 {
            let norm = bound.iter().map(|row| row.iter().sum()).fold(0.0, f64::max);
            if norm < 0.5 {
                return true;
            }
            if !norm.is_finite() {
                return false;
            }
            let square = |row: &Vec<f64>| -> Vec<f64> {
                (0..size).map(|c| (0..size).map(|k| row[k] * bound[k][c]).sum()).collect()
            };
            bound = bound.iter().map(square).collect();
        }
        false
    }

    /// `A − w`, factorised; `None` where it is singular.
    pub(super) fn shifted(&self, point: Complex64) -> Option<Factors<Complex64>> {
        let size = self.matrix.len();
        let entries = (0..size * size).map(|place| {
            let (row, column) = (place / size, place % size);
            let entry = self.matrix[row][column];
            if row == column { entry - point } else { entry }
        });
        Factors::new(size, entries.collect())
    }

    /// The history that a multiplier belongs to, of length 1: two steps of inverse iteration. `None` for no number and for zero.
    pub(super) fn branch(&self, multiplier: Complex64) -> Option<Vec<Complex64>> {
        if multiplier.norm() == 0.0 || !multiplier.is_finite() {
            return None;
        }
        // A little beside the eigenvalue the matrix can be factorised.
        let beside = |power: i32| multiplier * (1.0 + f64::EPSILON * 8f64.powi(power));
        let factors = (0..9).find_map(|power| self.shifted(beside(power)))?;
        let size = self.matrix.len();
        let mut vector: Vec<_> =
            (0..size).map(|k| Complex64::from_polar(1.0, 1.0 + (k * k) as f64)).collect();
        for _ in 0..3 {
            factors.solve(&mut vector);
            let length = vector.iter().map(|entry| entry.norm_sqr()).sum::<f64>().sqrt();
            vector.iter_mut().for_each(|entry| *entry /= length);
        }
        vector.iter().all(|entry| entry.is_finite()).then_some(vector)
    }

    /// `[‖A⁰‖, ‖A¹‖, …]`, as many as wanted.
    pub(super) fn norms_of_powers(&self, count: usize) -> Vec<f64> {
        let size = self.matrix.len();
        let entry = |same: bool| Complex64::new(f64::from(u8::from(same)), 0.0);
        let mut power: Vec<Vec<Complex64>> =
            (0..size).map(|row| (0..size).map(|column| entry(row == column)).collect()).collect();
        let mut norms = Vec::with_capacity(count);
        for _ in 0..count {
            norms.push(power.iter().flatten().map(|x| x.norm_sqr()).sum::<f64>().sqrt());
            let product = |row: &Vec<Complex64>, column: usize| -> Complex64 {
                row.iter().zip(&power).map(|(a, line)| a * line[column]).sum()
            };
            power = (self.matrix.iter())
                .map(|row| (0..size).map(|column| product(row, column)).collect())
                .collect();
        }
        norms
    }
}
