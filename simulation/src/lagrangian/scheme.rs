//! The Godunov-type SPH scheme on the uniform mass lattice.

use super::flux::{ContactViscosity, Exact, Flux, LagrangianFlux, Rusanov};
use super::{LagrangianState, Lattice};
use crate::boundary::Boundary;
use crate::march::Evolution;
use crate::riemann::IdealGas;
use crate::run::{
    Counters, Flowing, InvalidOptions, Lined, Profile, Reason, Totals, not_negative, positive,
};
use crate::scene::{MassLattice, Scene};
use courant_analysis::kernel::Kernel;
use rayon::prelude::*;

/// Which state the time step follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepRule {
    /// The state at the start of each step: `Δt = cfl Δξ / max W`. `W = ρ(q + √(q² + c²))`, `q = (γ + 1)u/4`, is the mass flux
    /// through the shock that a piston of speed `u` drives (`C = ρc` without one), and `u` half the speed at which a particle and its
    /// neighbours close in, weighted by the kernel: cold streams have no `C` to speak of and would meet within one step.
    #[default]
    Current,
    /// The initial state, for the whole run: `Δt = cfl Δξ / max C` with `C² = γρp`. Where shocks raise `C` (4.4 times in test 4 of the
    /// paper) the real Courant number is larger by as much, and the run fails.
    Initial,
}

/// What one chooses in a run of [`LagrangianScheme`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LagrangianOptions {
    /// The kernel; the paper's is the cubic spline.
    pub kernel: Kernel,
    /// `l/Δξ`; the paper's is 2.
    pub ratio: f64,
    /// The flux.
    pub flux: Flux,
    /// The Courant number. The paper does not give its own.
    pub cfl: f64,
    /// Which state the step follows.
    pub step: StepRule,
}

impl LagrangianOptions {
    /// The paper's choices with a flux: cubic spline, `l/Δξ = 2`; Courant number 0.9.
    pub fn new(flux: Flux) -> Self {
        Self { kernel: Kernel::CubicSpline, ratio: 2.0, flux, cfl: 0.9, step: StepRule::Current }
    }

    /// Whether the options make sense; the least number of particles.
    pub(crate) fn check(&self) -> Result<usize, InvalidOptions> {
        let lattice = Lattice::new(self.kernel, self.ratio)?;
        positive("cfl", self.cfl)?;
        if let Flux::ModifiedRoe(roe) = self.flux {
            let (ContactViscosity::Printed(alpha) | ContactViscosity::MassFlux(alpha)) =
                roe.contact;
            not_negative("contact viscosity", alpha)?;
        }
        Ok(2 * lattice.reach() + 1)
    }
}

/// Below this many particles a loop is not worth sharing between threads.
const CHUNK: usize = 1024;

/// The scheme (3.9) of Ferrari et al. 2008, in the orientation that conserves:
///
/// `U_i += (Δt/Δξ) Σ_k 2 w_k (F(U_{i−k}, U_i) − F(U_i, U_{i+k}))`, `w_k = Δξ²|W'(kΔξ)|`.
///
/// There is one flux per pair, left and right by the mass coordinate; what it takes from one
/// particle it gives to the other. Positions follow (3.16), `x_i += Δt (v_i^n + v_i^{n+1})/2`.
///
/// At transmissive ends the last particle is repeated; on a periodic interval the other end
/// follows. A step allocates nothing. Its result does not depend on the number of threads:
/// fluxes are independent of each other and every particle adds its own in the order of the offsets.
///
/// Work per step: `Σ_k (N + k)` fluxes.
#[derive(Debug, Clone)]
pub struct LagrangianScheme {
    gas: IdealGas,
    boundary: [Boundary; 2],
    flux: Flux,
    lattice: Lattice,
    spacing: f64,
    cfl: f64,
    fixed_step: Option<f64>,
    /// The states, with `reach` ghosts before and behind.
    states: Vec<LagrangianState>,
    x: Vec<f64>,
    /// States and positions after the step.
    next: (Vec<LagrangianState>, Vec<f64>),
    waiting: [usize; 2],
    /// Rows of one flux per offset `k`: row `m` in `0..N + reach` holds those from particle `m − k` to
    /// `m`, for `m < N + k`.
    fluxes: Vec<[f64; 3]>,
    /// What came in through the ends, in units of the totals.
    inflow: [f64; 3],
    counters: Counters,
}

impl LagrangianScheme {
    /// The initial state of a scene, with `particles` particles of equal mass in its domain.
    ///
    /// Each holds the mean of the conserved quantities of its share of the mass, so that the totals and the place of a jump are exact;
    /// beyond an end through which gas flows in there are as many more as will enter until the end time.
    ///
    /// # Errors
    /// [`InvalidOptions`], when `options` has a ratio or Courant number that does not make
    /// sense or there are fewer particles than `2·reach + 1`.
    pub fn new(
        scene: &Scene,
        particles: usize,
        options: &LagrangianOptions,
    ) -> Result<Self, InvalidOptions> {
        let least = options.check()?;
        if particles < least {
            return Err(InvalidOptions::Particles { particles, least });
        }
        let gas = scene.material.ideal().expect("the scene is covered");
        let start = MassLattice::new(scene, gas, particles);
        Self::from_lattice(gas, scene.ends_of_gas(), start, options)
    }

    /// From the particles themselves.
    pub(super) fn from_lattice(
        gas: IdealGas,
        boundary: [Boundary; 2],
        start: MassLattice,
        options: &LagrangianOptions,
    ) -> Result<Self, InvalidOptions> {
        let lattice = Lattice::new(options.kernel, options.ratio)?;
        let reach = lattice.reach();
        let count = start.x.len();
        let state = |i: usize| LagrangianState::from_state(gas, &start.states[i]);
        let mut states = vec![state(0); count + 2 * reach];
        for (i, place) in states[reach..reach + count].iter_mut().enumerate() {
            *place = state(i);
        }
        let fluxes = vec![[0.0; 3]; (count + reach) * lattice.offsets().len()];
        let mut scheme = Self {
            gas,
            boundary,
            flux: options.flux,
            lattice,
            spacing: start.spacing,
            cfl: options.cfl,
            fixed_step: None,
            next: (states.clone(), start.x.clone()),
            states,
            x: start.x,
            waiting: start.waiting,
            fluxes,
            inflow: [0.0; 3],
            counters: Counters::default(),
        };
        if options.step == StepRule::Initial {
            scheme.fixed_step = Some(scheme.step_for(|state, _| state.sound));
        }
        Ok(scheme)
    }

    /// The particles, in the order of the mass coordinate.
    pub fn states(&self) -> &[LagrangianState] {
        let reach = self.lattice.reach();
        &self.states[reach..self.states.len() - reach]
    }

    /// The positions of the particles.
    pub fn positions(&self) -> &[f64] {
        &self.x
    }

    /// The mass Δξ of a particle.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// How many particles stand beyond the left and the right end of the domain at the start.
    pub fn waiting(&self) -> [usize; 2] {
        self.waiting
    }

    /// `cfl Δξ / max W` of the current state: see [`StepRule::Current`].
    pub fn courant_step(&self) -> f64 {
        let steepness = 0.25 * (self.gas.gamma() + 1.0);
        self.step_for(|state, i| {
            let q = 0.5 * steepness * self.closing_speed(i);
            if q == 0.0 {
                return state.sound;
            }
            let sound = state.sound * state.volume;
            (q + (q * q + sound * sound).sqrt()) * state.density
        })
    }

    /// The Courant step where `speed(state, i)` is the mass flux of the fastest wave at particle `i`.
    fn step_for(&self, speed: impl Fn(&LagrangianState, usize) -> f64 + Sync) -> f64 {
        // A maximum is the same in any order.
        let fastest = self
            .states()
            .par_iter()
            .enumerate()
            .with_min_len(CHUNK)
            .map(|(i, state)| speed(state, i))
            .reduce(|| 0.0, f64::max);
        self.cfl * self.spacing / fastest
    }

    /// How fast particle `i` and the neighbours on the side where they are faster close in: the mean over the
    /// offsets, weighted by the kernel.
    fn closing_speed(&self, i: usize) -> f64 {
        let states = self.states();
        let here = states[i].velocity;
        let (mut sum, mut weights) = (0.0, 0.0);
        for &(k, weight) in self.lattice.offsets() {
            let before = i.checked_sub(k).map_or(0.0, |j| states[j].velocity - here);
            let behind = states.get(i + k).map_or(0.0, |other| here - other.velocity);
            sum += weight * before.max(behind).max(0.0);
            weights += weight;
        }
        sum / weights
    }

    fn fill_ghosts(&mut self) {
        let (reach, total) = (self.lattice.reach(), self.states.len());
        for (end, boundary) in self.boundary.into_iter().enumerate() {
            for k in 0..reach {
                // The k-th ghost from the end, and the particle as far inside.
                let (ghost, inside, other) = match end {
                    0 => (reach - 1 - k, reach + k, total - reach - 1 - k),
                    _ => (total - reach + k, total - reach - 1 - k, reach + k),
                };
                let edge = if end == 0 { reach } else { total - reach - 1 };
                self.states[ghost] = match boundary {
                    Boundary::Transmissive | Boundary::Open => self.states[edge],
                    Boundary::Mirror => self.states[inside].mirrored(),
                    Boundary::Periodic => self.states[other],
                };
            }
        }
    }

    fn compute_fluxes(&mut self) {
        match self.flux {
            Flux::Exact => self.compute(&Exact),
            Flux::Rusanov => self.compute(&Rusanov),
            Flux::ModifiedRoe(roe) => self.compute(&roe),
        }
    }

    /// One instance of the loop per flux, so that the flux is inlined.
    fn compute(&mut self, flux: &impl LagrangianFlux) {
        let (reach, count) = (self.lattice.reach(), self.x.len());
        let (gas, states) = (self.gas, &self.states);
        let offsets = self.lattice.offsets();
        // Nothing presses on a free surface, and the gas goes on as it is.
        let open = self.boundary.map(|end| end == Boundary::Open);
        // All offsets of a particle at once, while its neighbours are near in the cache.
        self.fluxes.par_chunks_mut(offsets.len()).enumerate().with_min_len(CHUNK).for_each(
            |(m, row)| {
                for (place, &(k, _)) in row.iter_mut().zip(offsets) {
                    let (left, right) = (&states[reach + m - k], &states[reach + m]);
                    if m < k && open[0] {
                        *place = [-right.velocity, 0.0, 0.0];
                    } else if m >= count && m < count + k && open[1] {
                        *place = [-left.velocity, 0.0, 0.0];
                    } else if m < count + k {
                        *place = flux.flux(gas, left, right);
                    }
                }
            },
        );
        self.counters.evaluations += 1;
        self.counters.interactions += offsets.iter().map(|&(k, _)| (count + k) as u64).sum::<u64>();
    }

    fn gather(&mut self, step: f64) -> Result<(), Reason> {
        let (gas, reach, count) = (self.gas, self.lattice.reach(), self.x.len());
        let (offsets, fluxes) = (self.lattice.offsets(), &self.fluxes);
        let width = offsets.len();
        let factor = 2.0 * step / self.spacing;
        let (states, positions) = (&self.states[reach..reach + count], &self.x);
        let broken = self.next.0[reach..reach + count]
            .par_iter_mut()
            .zip(&mut self.next.1)
            .enumerate()
            .with_min_len(CHUNK)
            .filter_map(|(i, (state, x))| {
                let mut change = [0.0; 3];
                for (column, &(k, weight)) in offsets.iter().enumerate() {
                    let before = &fluxes[i * width + column];
                    let behind = &fluxes[(i + k) * width + column];
                    for c in 0..3 {
                        change[c] += weight * (before[c] - behind[c]);
                    }
                }
                let old = states[i].conserved();
                *state = LagrangianState::from_conserved(
                    gas,
                    [0, 1, 2].map(|c| old[c] + factor * change[c]),
                );
                *x = positions[i] + 0.5 * step * (old[1] + state.velocity);
                Reason::of_particle(i, state.density, state.internal_energy(), state.velocity).err()
            })
            .min_by_key(|reason| reason.particle());
        if let Some(reason) = broken {
            return Err(reason);
        }
        std::mem::swap(&mut self.states, &mut self.next.0);
        std::mem::swap(&mut self.x, &mut self.next.1);
        for (column, &(k, weight)) in offsets.iter().enumerate() {
            for m in 0..k {
                let entering = &fluxes[m * width + column];
                let leaving = &fluxes[(count + m) * width + column];
                for c in 0..3 {
                    self.inflow[c] += 2.0 * step * weight * (entering[c] - leaving[c]);
                }
            }
        }
        Ok(())
    }
}

impl Flowing for LagrangianScheme {
    fn totals(&self) -> Totals {
        let [mut volume, mut momentum, mut energy] = self.inflow.map(|inflow| -inflow);
        let (mut motion, spacing) = (0.0, self.spacing);
        for state in self.states() {
            volume += spacing * state.volume;
            momentum += spacing * state.velocity;
            energy += spacing * state.energy;
            motion += spacing * (state.velocity.abs() + state.sound * state.volume);
        }
        let mass = spacing * self.x.len() as f64;
        Totals {
            mass,
            momentum: [momentum, 0.0, 0.0],
            motion,
            energy: Some(energy),
            volume: Some(volume),
        }
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn out_of_order(&self) -> usize {
        self.x.windows(2).filter(|pair| pair[0] >= pair[1]).count()
    }
}

impl Lined for LagrangianScheme {
    fn profile(&self) -> Profile {
        let column = |value: fn(&LagrangianState) -> f64| self.states().iter().map(value).collect();
        Profile {
            x: self.x.clone(),
            density: column(|state| state.density),
            velocity: column(|state| state.velocity),
            pressure: column(|state| state.pressure),
            energy: column(LagrangianState::internal_energy),
            mass: vec![self.spacing; self.x.len()],
            ..Profile::default()
        }
    }
}

impl Evolution for LagrangianScheme {
    fn time_step(&mut self) -> Result<f64, Reason> {
        Ok(self.fixed_step.unwrap_or_else(|| self.courant_step()))
    }

    /// Advances all particles by `step`.
    ///
    /// # Errors
    /// The first particle that would no longer be physical; the state stays as it was.
    fn advance(&mut self, step: f64) -> Result<(), Reason> {
        self.fill_ghosts();
        self.compute_fluxes();
        self.gather(step)
    }

    fn divisible(&self) -> bool {
        self.fixed_step.is_none()
    }
}
