//! The modes of a ring of equally spaced particles.

use num_complex::Complex64;
use std::f64::consts::TAU;

/// The discrete Fourier transform of real values on a ring of `N` equally spaced particles: modes
/// `m = 0, …, ⌊N/2⌋` with phase angles `φ_m = 2πm/N`.
///
/// A plain sum over a table of the `N` roots of unity: `O(N²)`, with an error of a few `√N ε`, and no
/// code in common with the amplification factor it helps to measure.
#[derive(Debug, Clone)]
pub struct RingModes {
    roots: Vec<Complex64>,
}

impl RingModes {
    /// For a ring of so many particles.
    ///
    /// # Panics
    /// When there are none.
    pub fn new(particles: usize) -> Self {
        assert!(particles > 0, "a ring without particles has no modes");
        let root = |k| Complex64::from_polar(1.0, TAU * k as f64 / particles as f64);
        Self { roots: (0..particles).map(root).collect() }
    }

    /// How many particles.
    pub fn particles(&self) -> usize {
        self.roots.len()
    }

    /// How many modes: `⌊N/2⌋ + 1`.
    pub fn count(&self) -> usize {
        self.particles() / 2 + 1
    }

    /// `φ_m = 2πm/N` in radians.
    pub fn phase(&self, mode: usize) -> f64 {
        TAU * mode as f64 / self.particles() as f64
    }

    /// Whether a real state holds the mode with a real amplitude only: the mean, and the shortest wave of
    /// an even ring.
    pub fn is_real(&self, mode: usize) -> bool {
        mode == 0 || 2 * mode == self.particles()
    }

    /// `a_m = (1/N) Σ_j u_j e^{−iφ_m j}`.
    ///
    /// # Panics
    /// When there are not as many values as particles.
    pub fn amplitude(&self, mode: usize, values: &[f64]) -> Complex64 {
        let count = self.particles();
        assert_eq!(values.len(), count, "one value per particle");
        let mut index = 0;
        let mut sum = Complex64::new(0.0, 0.0);
        for value in values {
            sum += self.roots[index].conj() * value;
            index += mode;
            if index >= count {
                index -= count;
            }
        }
        sum / count as f64
    }

    /// The real state `u_j = Σ_m a_m e^{iφ_m j} + c.c.` (real modes once).
    pub fn state(&self, amplitudes: &[Complex64]) -> Vec<f64> {
        let count = self.particles();
        let mut values = vec![0.0; count];
        for (mode, amplitude) in amplitudes.iter().enumerate() {
            let weight = if self.is_real(mode) { 1.0 } else { 2.0 };
            let mut index = 0;
            for value in &mut values {
                *value += weight * (amplitude * self.roots[index]).re;
                index += mode;
                if index >= count {
                    index -= count;
                }
            }
        }
        values
    }
}
