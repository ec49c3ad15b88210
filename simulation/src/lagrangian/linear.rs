//! The running scheme near a uniform state: its amplification measured, to be held against
//! `lagrangian-sound` and `lagrangian-contact` of the catalogue.

use super::{LagrangianOptions, LagrangianScheme, LagrangianState};
use crate::boundary::Boundary;
use crate::linearisation::linearisation;
use crate::march::Evolution;
use crate::riemann::{IdealGas, State};
use crate::run::{InvalidOptions, Reason};
use crate::scene::MassLattice;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Why there is no measurement.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoMeasurement {
    /// The scheme cannot start.
    #[error(transparent)]
    Options(#[from] InvalidOptions),
    /// The wave grew until a particle was no longer physical.
    #[error("the wave broke down: {0}")]
    Breakdown(Reason),
}

/// A uniform flow on a periodic lattice of equal masses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformFlow {
    /// The gas.
    pub gas: IdealGas,
    /// Density, velocity and pressure; the first and the last above 0.
    pub state: State,
    /// The number of particles in one period.
    pub particles: usize,
}

/// The characteristic variables of (3.7) about a uniform state: the strengths `(a₋, a₀, a₊)` of the
/// eigenvectors `(1, C, Cv − p)`, `(1, 0, p/(γ − 1))`, `(1, −C, −Cv − p)` for the eigenvalues `−C, 0, C`.
///
/// With the change of pressure `δp = ((γ − 1)(δE − v δv) − p δV)/V`:
/// `a∓ = (−δp/C² ± δv/C)/2`, `a₀ = δV + δp/C²`.
#[derive(Debug, Clone, Copy)]
struct Characteristics {
    gamma: f64,
    base: LagrangianState,
}

impl Characteristics {
    fn strengths(&self, change: [f64; 3]) -> [f64; 3] {
        let LagrangianState { volume, velocity, pressure, sound, .. } = self.base;
        let [d_volume, dv, de] = change;
        let dp = ((self.gamma - 1.0) * (de - velocity * dv) - pressure * d_volume) / volume;
        let (even, odd) = (-dp / (sound * sound), dv / sound);
        [0.5 * (even + odd), d_volume - even, 0.5 * (even - odd)]
    }

    fn change(&self, [left, contact, right]: [f64; 3]) -> [f64; 3] {
        let LagrangianState { velocity, pressure, sound, .. } = self.base;
        [
            left + contact + right,
            sound * (left - right),
            (sound * velocity - pressure) * left + pressure / (self.gamma - 1.0) * contact
                - (sound * velocity + pressure) * right,
        ]
    }
}

/// The disturbance of the particles in units of its specific volume whose response is measured. The fluxes
/// have terms like `ε|ε|` (the larger of two speeds), so that a central difference is off by about ε, and
/// the round-off of a step counts as 1e-16/ε.
const DISTURBANCE: f64 = 1e-7;

impl UniformFlow {
    fn characteristics(&self) -> Characteristics {
        let base = LagrangianState::from_state(self.gas, &self.state);
        Characteristics { gamma: self.gas.gamma(), base }
    }

    /// The Lagrangian sound speed `C = √(γρp)`.
    pub fn sound(&self) -> f64 {
        self.characteristics().base.sound
    }

    fn scheme(
        &self,
        options: &LagrangianOptions,
        strengths: impl Fn(usize) -> [f64; 3],
    ) -> Result<LagrangianScheme, InvalidOptions> {
        let characteristics = self.characteristics();
        let base = characteristics.base;
        let spacing = self.state.density() / self.particles as f64;
        let states = (0..self.particles).map(|i| {
            let change = characteristics.change(strengths(i).map(|a| a * base.volume));
            let conserved = [0, 1, 2].map(|c| base.conserved()[c] + change[c]);
            let state = LagrangianState::from_conserved(self.gas, conserved);
            State::trusted(state.density, state.velocity, state.pressure)
        });
        let x = (0..self.particles).map(|i| (i as f64 + 0.5) / self.particles as f64);
        let lattice =
            MassLattice { spacing, states: states.collect(), x: x.collect(), waiting: [0; 2] };
        let boundary = [Boundary::Periodic; 2];
        LagrangianScheme::from_lattice(self.gas, boundary, lattice, options)
    }

    /// The characteristic variables of all particles in units of the specific volume.
    fn strengths(&self, scheme: &LagrangianScheme) -> Vec<[f64; 3]> {
        let characteristics = self.characteristics();
        let base = characteristics.base;
        let strength = |state: &LagrangianState| {
            let (here, there) = (state.conserved(), base.conserved());
            characteristics
                .strengths([0, 1, 2].map(|c| here[c] - there[c]))
                .map(|a| a / base.volume)
        };
        scheme.states().iter().map(strength).collect()
    }

    /// What one step of the running scheme at Courant number `courant` does to the mode
    /// `φ = 2π mode/N`, by central differences: the 3×3 matrix in the characteristic variables of
    /// `−C, 0, C`. Linear theory says that it is diagonal, with `conj g, g₀, g`.
    ///
    /// # Errors
    /// [`NoMeasurement`], when the scheme cannot start or the step is so long that the disturbance of
    /// 1e-7 makes a particle unphysical.
    pub fn amplification(
        &self,
        options: &LagrangianOptions,
        courant: f64,
        mode: usize,
    ) -> Result<[[Complex64; 3]; 3], NoMeasurement> {
        linearisation(self.particles, mode, [DISTURBANCE; 3], |strengths| {
            let mut scheme = self.scheme(options, |i| strengths[i])?;
            let step = courant * scheme.spacing() / self.sound();
            scheme.advance(step).map_err(NoMeasurement::Breakdown)?;
            Ok(self.strengths(&scheme))
        })
    }

    /// Runs `steps` steps at Courant number `courant` from a wave `a e^{iφj}` of one family (0, 1, 2 for
    /// `−C, 0, C`), `φ = 2π mode/N`, and returns by which factor its amplitude grew *per step*.
    ///
    /// # Errors
    /// [`NoMeasurement`], when the scheme cannot start or the wave breaks down.
    pub fn growth_per_step(
        &self,
        options: &LagrangianOptions,
        wave: PlaneWave,
        courant: f64,
        steps: u32,
    ) -> Result<f64, NoMeasurement> {
        let phase = TAU * wave.mode as f64 / self.particles as f64;
        let mut scheme = self.scheme(options, |i| {
            let mut strengths = [0.0; 3];
            strengths[wave.family] = wave.amplitude * (phase * i as f64).cos();
            strengths
        })?;
        let start = self.mode(&scheme, wave.family, phase);
        let step = courant * scheme.spacing() / self.sound();
        for _ in 0..steps {
            scheme.advance(step).map_err(NoMeasurement::Breakdown)?;
        }
        let end = self.mode(&scheme, wave.family, phase);
        Ok((end / start).powf(f64::from(steps).recip()))
    }

    /// The amplitude of the mode in one family.
    fn mode(&self, scheme: &LagrangianScheme, family: usize, phase: f64) -> f64 {
        let turned = self.strengths(scheme).into_iter().enumerate();
        turned
            .map(|(i, strengths)| Complex64::from_polar(strengths[family], -phase * i as f64))
            .sum::<Complex64>()
            .norm()
    }
}

/// A wave of small amplitude in one family.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneWave {
    /// 0, 1, 2 for the eigenvalues `−C, 0, C`.
    pub family: usize,
    /// How many wavelengths there are in the period.
    pub mode: usize,
    /// The amplitude of the specific volume over that volume.
    pub amplitude: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lagrangian::flux::{ContactViscosity, Flux, ModifiedRoe, RoeMean};
    use courant_analysis::exact::rational::{Rational, from_f64, ratio};
    use courant_analysis::kernel::Kernel;
    use courant_analysis::scheme::{KernelLattice, Step, catalogue};

    fn flow() -> UniformFlow {
        // A uniform state with nothing equal to 1 or 0.
        let gas = IdealGas::new(1.4).expect("above 1");
        let state = State::new(2.0, 0.75, 3.0).expect("physical");
        UniformFlow { gas, state, particles: 24 }
    }

    /// The fluxes with their λ₂/C in that flow.
    fn fluxes() -> [(Flux, f64); 4] {
        let sound = flow().sound();
        let roe = |mean, contact| Flux::ModifiedRoe(ModifiedRoe { mean, contact });
        [
            (Flux::Exact, 0.0),
            (Flux::Rusanov, 1.0),
            (roe(RoeMean::Density, ContactViscosity::Printed(0.5)), 0.5 * 0.75 / sound),
            (roe(RoeMean::Volume, ContactViscosity::MassFlux(0.5)), 0.5 * 2.0 * 0.75 / sound),
        ]
    }

    fn step(name: &str, kernel: Kernel, l: &Rational, values: &[(String, Rational)]) -> Step {
        let lattice = KernelLattice::new(kernel, l).expect("in range");
        let scheme = catalogue::scheme(name).expect("it is in the catalogue");
        scheme.step(Some(&lattice), None, values, Some("C")).expect("it is a scheme")
    }

    #[test]
    fn the_running_step_is_the_symbol_in_characteristic_variables() {
        let lattices: [(Kernel, Rational); 3] = [
            (Kernel::CubicSpline, ratio(2, 1)),
            (Kernel::QuinticSpline, ratio(13, 10)),
            (Kernel::Gaussian, ratio(3, 2)),
        ];
        for (kernel, l) in lattices {
            for (flux, viscosity) in fluxes() {
                let options = LagrangianOptions {
                    kernel,
                    ratio: courant_analysis::exact::rational::to_f64(&l),
                    ..LagrangianOptions::new(flux)
                };
                let exact = from_f64(viscosity).expect("finite");
                let viscosity = [("viscosity".to_string(), exact)];
                let [sound, contact] = [
                    step("godunov-sph", kernel, &l, &[]),
                    step("lagrangian-contact", kernel, &l, &viscosity),
                ]
                .map(|step| step.compile().expect("one dimension"));
                for courant in [0.4, 1.7] {
                    for mode in [0, 1, 5, 12] {
                        let phase = TAU * mode as f64 / 24.0;
                        let found = flow().amplification(&options, courant, mode).expect("valid");
                        let g = sound.multipliers(&[courant], &[phase])[0];
                        let wanted = [g.conj(), contact.multipliers(&[courant], &[phase])[0], g];
                        for (row, line) in found.iter().enumerate() {
                            for (column, value) in line.iter().enumerate() {
                                let target =
                                    if row == column { wanted[row] } else { Complex64::default() };
                                // See DISTURBANCE: each response is off by a few of it.
                                assert!(
                                    (value - target).norm() < 30.0 * DISTURBANCE,
                                    "{kernel} {flux:?} C = {courant} mode {mode} [{row}][{column}]"
                                );
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn small_waves_grow_above_the_limit_and_only_there() {
        let flow = UniformFlow { particles: 48, ..flow() };
        for (flux, _) in fluxes() {
            let options = LagrangianOptions::new(flux);
            let wave = PlaneWave { family: 2, mode: 1, amplitude: 1e-7 };
            let at = |courant: f64| {
                flow.growth_per_step(&options, wave, courant, 100).expect("it stays small")
            };
            // The limit is 15/8.
            assert!(at(1.85) < 1.0 && at(1.90) > 1.0, "{flux:?}");
        }
    }
}
