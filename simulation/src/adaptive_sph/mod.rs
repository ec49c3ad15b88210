//! Standard SPH with adaptive density kernel estimation (ADKE) and Monaghan's viscosity: the
//! second reference method of Ferrari et al. 2008, after Sigalotti et al. 2006.

mod bodies;
mod rates;

use crate::boundary::Boundary;
use crate::march::{Evolution, Limits, march};
use crate::riemann::IdealGas;
use crate::run::{
    Conservation, InvalidOptions, Profile, Reason, Run, Totals, not_negative, positive,
};
use crate::scene::{MassLattice, Scene};
use bodies::Bodies;
use courant_analysis::kernel::Kernel;
use std::ops::ControlFlow;

/// What one chooses in a run of [`run`]. Ferrari et al. do not give their own choices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdaptiveSphOptions {
    /// The kernel.
    pub kernel: Kernel,
    /// `h₀` of the pilot density over the largest distance between particles at the start.
    pub pilot_ratio: f64,
    /// `k` in `h_i = k (g/ρ̂_i)^ε h₀`.
    pub scale: f64,
    /// `ε`, between 0 (one smoothing length for all) and 1.
    pub sensitivity: f64,
    /// Monaghan's α.
    pub alpha: f64,
    /// Monaghan's β.
    pub beta: f64,
    /// The Courant number: `Δt = cfl · min(h/(c + 0.6 α c + 0.6 β max|μ|), √(h/|a|))`.
    pub cfl: f64,
    /// A run that is not done after so many steps fails.
    pub max_steps: usize,
}

impl Default for AdaptiveSphOptions {
    /// Cubic spline, `h₀` twice the largest spacing, `k = 0.7`, `ε = 1/2`, `α = 1`, `β = 2`, Courant
    /// number 0.3.
    fn default() -> Self {
        Self {
            kernel: Kernel::CubicSpline,
            pilot_ratio: 2.0,
            scale: 0.7,
            sensitivity: 0.5,
            alpha: 1.0,
            beta: 2.0,
            cfl: 0.3,
            max_steps: 200_000,
        }
    }
}

impl AdaptiveSphOptions {
    fn check(&self) -> Result<(), InvalidOptions> {
        positive("cfl", self.cfl)?;
        positive("pilot ratio", self.pilot_ratio)?;
        positive("scale", self.scale)?;
        not_negative("sensitivity", self.sensitivity)?;
        not_negative("alpha", self.alpha)?;
        not_negative("beta", self.beta)
    }
}

/// Runs the scene with `particles` particles of equal mass in its domain, each with the mean velocity and
/// energy of its mass and at the point that halves it. Beyond an end through which gas flows in
/// there are as many more as will enter until the end time.
///
/// Density by summation, `ρ_i = Σ m W(x_ij, h_ij)`; motion by
/// `dv_i/dt = −Σ m (p_i/ρ_i² + p_j/ρ_j² + Π_ij) ∂W/∂x_i` and heat by
/// `de_i/dt = ½ Σ m (p_i/ρ_i² + p_j/ρ_j² + Π_ij)(v_i − v_j) ∂W/∂x_i`, with `h_ij = (h_i + h_j)/2`,
/// `Π = (−α c̄ μ + β μ²)/ρ̄`, `μ = h_ij v_ij x_ij/(x_ij² + 0.01 h_ij²)` for approaching pairs.
/// The smoothing length follows from a pilot density: `ρ̂_i = Σ m W(x_ij, h₀)`,
/// `log g = mean of log ρ̂`, `h_i = k (g/ρ̂_i)^ε h₀`, anew at each stage of the midpoint rule in time.
///
/// At transmissive ends the outermost particle is repeated at the distance of its neighbour.
///
/// # Errors
/// [`InvalidOptions`], when an option does not make sense or there are fewer than 4 particles.
pub fn run(
    scene: &dyn Scene,
    particles: usize,
    options: &AdaptiveSphOptions,
) -> Result<Run, InvalidOptions> {
    options.check()?;
    if particles < 4 {
        return Err(InvalidOptions::Particles { particles, least: 4 });
    }
    let mut fluid = Fluid::new(scene, particles, options);
    let start = fluid.totals();
    let motion: f64 = (0..fluid.x.len())
        .map(|i| {
            let c = (fluid.gas.gamma() * (fluid.gas.gamma() - 1.0) * fluid.energy[i]).sqrt();
            fluid.mass * (fluid.velocity[i].abs() + c)
        })
        .sum();
    let scale = [start.0[0], motion, start.0[2]];
    let limits = Limits { steps: options.max_steps };
    let end = march(&mut fluid, scene.end_time(), limits, |_, _| ControlFlow::Continue(()));
    let [mass, momentum, energy] = fluid.totals().drift(start, fluid.inflow, scale);
    let conservation = Conservation { mass, momentum, energy, volume: None };
    let (pairs, waiting, particle_mass) = (fluid.pairs, fluid.waiting, Some(fluid.mass));
    Ok(Run {
        profile: fluid.into_profile(),
        steps: end.steps,
        rejected: end.rejected,
        time: end.time,
        failure: end.failure,
        conservation,
        pairs,
        waiting,
        particle_mass,
    })
}

/// The particles. Every column is in the order of the particles at the start.
struct Fluid {
    gas: IdealGas,
    boundary: Boundary,
    domain: [f64; 2],
    options: AdaptiveSphOptions,
    mass: f64,
    /// `h₀` of the pilot density.
    pilot_length: f64,
    x: Vec<f64>,
    waiting: [usize; 2],
    velocity: Vec<f64>,
    energy: Vec<f64>,
    density: Vec<f64>,
    pressure: Vec<f64>,
    sound: Vec<f64>,
    length: Vec<f64>,
    acceleration: Vec<f64>,
    heating: Vec<f64>,
    /// Largest `|μ|` of each particle with any other.
    approach: Vec<f64>,
    /// Momentum and energy per time that the ghosts beyond the ends give.
    supply: [f64; 2],
    bodies: Bodies,
    /// Whether the rates are those of the present state.
    current: bool,
    /// Position, velocity and energy at the start of a step.
    start: [Vec<f64>; 3],
    inflow: Totals,
    pairs: u64,
}

impl Fluid {
    fn new(scene: &dyn Scene, particles: usize, options: &AdaptiveSphOptions) -> Self {
        let gas = scene.gas();
        let MassLattice { spacing, states, x, waiting } = MassLattice::new(scene, particles);
        let widest = x.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let zeros = || vec![0.0; x.len()];
        Self {
            gas,
            boundary: scene.boundary(),
            domain: scene.domain(),
            options: *options,
            mass: spacing,
            pilot_length: options.pilot_ratio * widest,
            velocity: states.iter().map(|state| state.velocity()).collect(),
            energy: states
                .iter()
                .map(|state| gas.internal_energy(state.density(), state.pressure()))
                .collect(),
            density: states.iter().map(|state| state.density()).collect(),
            pressure: states.iter().map(|state| state.pressure()).collect(),
            sound: zeros(),
            length: zeros(),
            acceleration: zeros(),
            heating: zeros(),
            approach: zeros(),
            supply: [0.0; 2],
            bodies: Bodies::new(x.len()),
            current: false,
            start: [x.clone(), zeros(), zeros()],
            x,
            waiting,
            inflow: Totals::default(),
            pairs: 0,
        }
    }

    fn totals(&self) -> Totals {
        Totals::sum(
            self.velocity
                .iter()
                .zip(&self.energy)
                .map(|(v, e)| [self.mass, self.mass * v, self.mass * (e + 0.5 * v * v)]),
        )
    }

    fn into_profile(self) -> Profile {
        Profile {
            x: self.x,
            density: self.density,
            velocity: self.velocity,
            pressure: self.pressure,
            energy: self.energy,
        }
    }

    /// The first particle that is no longer physical.
    fn check(&self) -> Result<(), Reason> {
        (0..self.x.len()).try_for_each(|i| {
            Reason::of_particle(i, self.density[i], self.energy[i], self.velocity[i])
        })
    }

    /// To `start + step·rate`, the positions with the velocity of now.
    fn move_from_start(&mut self, step: f64) {
        let [x, velocity, energy] = &self.start;
        for i in 0..x.len() {
            self.x[i] = x[i] + step * self.velocity[i];
            self.velocity[i] = velocity[i] + step * self.acceleration[i];
            self.energy[i] = energy[i] + step * self.heating[i];
        }
    }
}

impl Fluid {
    fn move_by(&mut self, step: f64) -> Result<(), Reason> {
        self.move_from_start(0.5 * step);
        self.check()?;
        self.compute_rates();
        self.move_from_start(step);
        let supply = self.supply;
        self.compute_densities();
        self.check()?;
        self.inflow.0[1] += step * supply[0];
        self.inflow.0[2] += step * supply[1];
        Ok(())
    }
}

impl Evolution for Fluid {
    fn time_step(&mut self) -> Result<f64, Reason> {
        self.compute_rates();
        self.current = true;
        let options = self.options;
        let mut smallest = f64::INFINITY;
        for i in 0..self.x.len() {
            let signal = self.sound[i]
                + 0.6 * (options.alpha * self.sound[i] + options.beta * self.approach[i]);
            let h = self.length[i];
            smallest = smallest.min(h / signal).min((h / self.acceleration[i].abs()).sqrt());
        }
        Ok(options.cfl * smallest)
    }

    /// The midpoint rule.
    fn advance(&mut self, step: f64) -> Result<(), Reason> {
        if !self.current {
            self.compute_rates();
        }
        self.current = false;
        self.start[0].copy_from_slice(&self.x);
        self.start[1].copy_from_slice(&self.velocity);
        self.start[2].copy_from_slice(&self.energy);
        let result = self.move_by(step);
        if result.is_err() {
            self.x.copy_from_slice(&self.start[0]);
            self.velocity.copy_from_slice(&self.start[1]);
            self.energy.copy_from_slice(&self.start[2]);
            self.compute_densities();
        }
        result
    }
}

#[cfg(test)]
mod tests;
