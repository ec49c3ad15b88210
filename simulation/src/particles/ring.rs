//! One step of the real scheme on a periodic ring, for linearisation by finite differences.

use super::density::Smoothing;
use super::dispatch::pair_force;
use super::domain::Domain;
use super::gas::IsothermalGas;
use super::integrator::{Nystrom, Stepper};
use super::method::MethodOptions;
use super::pair_loops::PairLoops;
use super::smoothing_kernel::SmoothingKernel;
use super::system::{ParticleSystem, Particles};
use crate::boundary::Boundary;
use crate::linearisation::linearisation;
use crate::run::Reason;
use crate::scene::Material;
use num_complex::Complex64;

/// `N` particles of equal mass on a periodic line of length `N·spacing`, isothermal, with a constant
/// smoothing length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// `N`.
    pub particles: usize,
    /// Distance of neighbours on the undisturbed lattice.
    pub spacing: f64,
    /// Mass of a particle.
    pub mass: f64,
    /// The gas.
    pub gas: IsothermalGas,
    /// The kernel.
    pub kernel: SmoothingKernel<1>,
    /// `h`.
    pub smoothing: f64,
}

/// What one step does to a mode `x_j = jΔ + X e^{iφj}`, `v_j = V e^{iφj}`: the complex matrix that
/// takes `(X, V)` to `(X', V')`, rows first.
pub type Amplification = [[Complex64; 2]; 2];

impl Ring {
    /// The undisturbed positions `jΔ`.
    pub fn lattice(&self) -> Vec<f64> {
        (0..self.particles).map(|j| j as f64 * self.spacing).collect()
    }

    /// The pair force of a method for its gas.
    pub fn force(&self, options: &MethodOptions) -> Box<dyn PairLoops<1>> {
        pair_force(Material::Isothermal(self.gas), options)
    }

    /// Positions and velocities after one step from any state, positions not wrapped.
    ///
    /// # Errors
    /// [`Reason`] if the state or a stage of the step is not one of a gas.
    ///
    /// # Panics
    /// Unless there is one position and one velocity for each particle.
    pub fn step(
        &self,
        force: &dyn PairLoops<1>,
        table: &Nystrom<f64>,
        dt: f64,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<(Vec<f64>, Vec<f64>), Reason> {
        assert_eq!((positions.len(), velocities.len()), (self.particles, self.particles));
        let particles = Particles {
            position: positions.iter().map(|&x| [x]).collect(),
            velocity: velocities.iter().map(|&v| [v]).collect(),
            mass: vec![self.mass; self.particles],
            thermal: vec![(); self.particles],
            smoothing: vec![self.smoothing; self.particles],
        };
        let length = self.particles as f64 * self.spacing;
        let mut system = ParticleSystem::new(
            self.gas,
            particles,
            Domain::new([0.0], [length], Boundary::Periodic),
            self.kernel,
            Smoothing::Constant,
            force,
        );
        Stepper::new(table.clone()).step(&mut system, force, &mut (), dt)?;
        let flat = |vectors: Vec<[f64; 1]>| vectors.into_iter().map(|[x]| x).collect();
        Ok((flat(system.particles.position), flat(system.particles.velocity)))
    }

    /// The amplification matrix of mode `mode` (phase angle `φ = 2π mode/N` per particle), by central
    /// differences of [`step`](Self::step) with amplitude `size` spacings (and `size` sound speeds).
    ///
    /// The response is that of the scheme as it runs; it is linear to `O(size²)`, with round-off of the
    /// order of `1e-16/size`. Forces with a switch (viscosity on approaching pairs only) are not linear.
    ///
    /// ```
    /// use courant_analysis::kernel::Kernel;
    /// use courant_simulation::particles::*;
    /// use courant_simulation::riemann::isothermal::{Expansion, Isothermal};
    /// let gas = IsothermalGas { sound_speed: 1.0 };
    /// let kernel = SmoothingKernel::new(Kernel::CubicSpline);
    /// let ring = Ring { particles: 16, spacing: 1.0, mass: 1.0, gas, kernel, smoothing: 1.0 };
    /// let solver = Isothermal { sound_speed: 1.0, expansion: Expansion::Exact };
    /// let gph1 = Godunov { weight: SumOfSquares, solver, work: PairWork::Mean };
    /// let euler = Integrator::named("euler").unwrap().nystrom().unwrap();
    /// let step = ring.amplification(&gph1, &euler, 0.1, 3, 1e-5)?;
    /// assert!((step[0][1].re - 0.1).abs() < 1e-10); // x' = x + dt v
    /// assert!(step[1][1].re < 1.0); // the Riemann problem damps
    /// # Ok::<(), courant_simulation::run::Reason>(())
    /// ```
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn amplification(
        &self,
        force: &dyn PairLoops<1>,
        table: &Nystrom<f64>,
        dt: f64,
        mode: usize,
        size: f64,
    ) -> Result<Amplification, Reason> {
        let sizes = [size * self.spacing, size * self.gas.sound_speed];
        linearisation(self.particles, mode, sizes, |disturbances| {
            let lattice = self.lattice().into_iter().zip(disturbances);
            let positions: Vec<f64> = lattice.map(|(x, [shift, _])| x + shift).collect();
            let velocities: Vec<f64> = disturbances.iter().map(|[_, v]| *v).collect();
            let (x, v) = self.step(force, table, dt, &positions, &velocities)?;
            Ok(x.into_iter().zip(v).map(|(x, v)| [x, v]).collect())
        })
    }
}
