//! What a numerical wave gets wrong: speed and amplitude.

use num_complex::Complex64;
use std::f64::consts::TAU;

/// `(Re ω − cκ)/(cκ)`: Cha & Whitworth 2003 (57) with its sign: above 0 the wave leads, below it lags, and −1 does not
/// travel. `frequency` in units of `c/Δ`, `phase = κΔ > 0`.
///
/// Of the backward branch give `−ω`.
pub fn phase_error(frequency: Complex64, phase: f64) -> f64 {
    (frequency.re - phase) / phase
}

/// When the amplitude is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AmplitudeTime {
    /// `t = Δ/c`: the time 1 of the paper's Figure 4, which has `M = Δ = c = 1`.
    #[default]
    Unit,
    /// After one period `2π/(cκ)` of the exact wave.
    Period,
}

/// `E_R = exp(Im ω t)`: Cha & Whitworth 2003 (56); 1 is no error.
pub fn amplitude(frequency: Complex64, phase: f64, time: AmplitudeTime) -> f64 {
    match time {
        AmplitudeTime::Unit => frequency.im.exp(),
        AmplitudeTime::Period => (frequency.im * TAU / phase).exp(),
    }
}

/// The damping per wavelength of the exact wave, `−2π Im ω/(cκ)`: the logarithm lost over one period.
pub fn damping_per_wavelength(frequency: Complex64, phase: f64) -> f64 {
    -frequency.im * TAU / phase
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_errors_of_a_known_wave() {
        let frequency = Complex64::new(0.45, -0.1);
        // It lags by a tenth.
        assert!((phase_error(frequency, 0.5) + 0.1).abs() < 1e-15);
        assert_eq!(amplitude(frequency, 0.5, AmplitudeTime::Unit), (-0.1f64).exp());
        let period = amplitude(frequency, 0.5, AmplitudeTime::Period);
        assert!((period.ln() + damping_per_wavelength(frequency, 0.5)).abs() < 1e-15);
    }
}
