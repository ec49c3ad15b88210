//! A system of particles as something that marches in time.

use super::block_steps::BlockStepper;
use super::body_force::BodyForce;
use super::gas::Gas;
use super::integrator::{Nystrom, Stepper, Work};
use super::method::{MethodOptions, StepSharing};
use super::pair_loops::PairLoops;
use super::system::{ParticleSystem, Particles};
use super::vector::Vector;
use crate::march::Evolution;
use crate::run::Reason;

/// Who shares a time step.
#[derive(Debug, Clone)]
pub enum Stepping<const D: usize, T> {
    /// Everybody, by an integrator.
    Global(Stepper<D, T>),
    /// Blocks of steps.
    Blocks(BlockStepper<D, T>),
}

/// Particles of a gas under a pair force, in any dimension; with a body force `B`, or none.
///
/// The body force gives half of its impulse where a particle's step begins and half where it ends, whoever shares that step.
///
/// ```
/// use courant_analysis::kernel::Kernel;
/// use courant_simulation::boundary::Boundary;
/// use courant_simulation::march::march;
/// use courant_simulation::particles::*;
/// use std::ops::ControlFlow;
/// let force = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };
/// let particles = Particles {
///     position: (0..16).map(|k| [f64::from(k % 4), f64::from(k / 4)]).collect(),
///     velocity: vec![[0.1, 0.0]; 16],
///     mass: vec![1.0; 16],
///     thermal: vec![(); 16],
///     smoothing: vec![1.2; 16],
/// };
/// let system = ParticleSystem::new(
///     IsothermalGas { sound_speed: 1.0 },
///     particles,
///     Domain::new([0.0; 2], [4.0; 2], Boundary::Periodic),
///     SmoothingKernel::new(Kernel::CubicSpline),
///     Smoothing::adaptive(1.2),
///     &force,
/// );
/// let heun = Integrator::named("rk2-heun").unwrap().nystrom().unwrap();
/// let mut evolution = ParticleEvolution::global(system, Box::new(force), &heun, 0.3);
/// let end = march(&mut evolution, 1.0, 1000, |_, _| ControlFlow::Continue(()));
/// assert!(end.failure.is_none() && end.time == 1.0);
/// // A uniform flow is carried along.
/// assert!((evolution.system().particles.position[0][0] - 0.1).abs() < 1e-12);
/// ```
#[derive(Debug)]
pub struct ParticleEvolution<const D: usize, G: Gas, B = ()> {
    system: ParticleSystem<D, G>,
    force: Box<dyn PairLoops<D>>,
    body: B,
    courant: f64,
    stepping: Stepping<D, G::Thermal>,
    /// Whether the fields of the system are those of its state.
    current: bool,
    /// The step from here, once it is known.
    wanted: Option<f64>,
    /// The state before the step.
    before: Particles<D, G::Thermal>,
}

impl<const D: usize, G: Gas> ParticleEvolution<D, G> {
    /// With one step for everybody, of `courant` crossing times.
    pub fn global(
        system: ParticleSystem<D, G>,
        force: Box<dyn PairLoops<D>>,
        table: &Nystrom<f64>,
        courant: f64,
    ) -> Self {
        Self::new(system, force, courant, Stepping::Global(Stepper::new(table.clone())))
    }

    /// With blocks of steps that are halved at most `levels` times.
    pub fn blocks(
        system: ParticleSystem<D, G>,
        force: Box<dyn PairLoops<D>>,
        levels: u32,
        courant: f64,
    ) -> Self {
        let stepper = BlockStepper::new(levels, courant);
        Self::new(system, force, courant, Stepping::Blocks(stepper))
    }

    /// With the steps and the work of the options; `table` is that of their integrator.
    pub fn stepped(
        system: ParticleSystem<D, G>,
        force: Box<dyn PairLoops<D>>,
        options: &MethodOptions,
        table: &Nystrom<f64>,
    ) -> Self {
        let evolution = match options.sharing {
            StepSharing::Global => Self::global(system, force, table, options.courant),
            StepSharing::Block { levels } => Self::blocks(system, force, levels, options.courant),
        };
        evolution.with_work(options.work)
    }

    fn new(
        system: ParticleSystem<D, G>,
        force: Box<dyn PairLoops<D>>,
        courant: f64,
        stepping: Stepping<D, G::Thermal>,
    ) -> Self {
        let before = system.particles.clone();
        Self { system, force, body: (), courant, stepping, current: false, wanted: None, before }
    }

    /// The same under a body force.
    pub fn under<B: BodyForce<D>>(self, body: B) -> ParticleEvolution<D, G, B> {
        let Self { system, force, courant, stepping, before, .. } = self;
        let (current, wanted) = (false, None);
        ParticleEvolution { system, force, body, courant, stepping, current, wanted, before }
    }
}

impl<const D: usize, G: Gas, B: BodyForce<D>> ParticleEvolution<D, G, B> {
    /// With the heating by another velocity than the time-centred one.
    #[must_use]
    pub fn with_work(mut self, work: Work) -> Self {
        match &mut self.stepping {
            Stepping::Global(stepper) => stepper.work = work,
            Stepping::Blocks(stepper) => stepper.work = work,
        }
        self
    }

    /// Which velocity the heating uses.
    pub fn work(&self) -> Work {
        match &self.stepping {
            Stepping::Global(stepper) => stepper.work,
            Stepping::Blocks(stepper) => stepper.work,
        }
    }

    /// The particles; after a step that was taken, with the fields of their state.
    pub fn system(&self) -> &ParticleSystem<D, G> {
        &self.system
    }

    /// The body force.
    pub fn body(&self) -> &B {
        &self.body
    }

    /// Momentum that the walls have given so far.
    pub fn wall_impulse(&self) -> Vector<D> {
        match &self.stepping {
            Stepping::Global(stepper) => stepper.wall_impulse,
            Stepping::Blocks(stepper) => stepper.wall_impulse,
        }
    }

    fn set_wall_impulse(&mut self, impulse: Vector<D>) {
        match &mut self.stepping {
            Stepping::Global(stepper) => stepper.wall_impulse = impulse,
            Stepping::Blocks(stepper) => stepper.wall_impulse = impulse,
        }
    }

    /// Steps within blocks so far; `None` where everybody shares one step.
    pub fn substeps(&self) -> Option<u64> {
        match &self.stepping {
            Stepping::Global(_) => None,
            Stepping::Blocks(stepper) => Some(stepper.substeps),
        }
    }

    fn step(&mut self, step: f64) -> Result<(), Reason> {
        let Self { system, force, body, .. } = self;
        match &mut self.stepping {
            Stepping::Global(stepper) => stepper.step(system, &**force, body, step)?,
            Stepping::Blocks(stepper) => stepper.block(system, &**force, body, step)?,
        }
        body.settle(system);
        system.update_fields()
    }
}

impl<const D: usize, G: Gas, B: BodyForce<D>> Evolution for ParticleEvolution<D, G, B> {
    fn time_step(&mut self) -> Result<f64, Reason> {
        if let Some(wanted) = self.wanted {
            return Ok(wanted);
        }
        if !self.current {
            self.system.update_fields()?;
            self.body.update(&self.system.particles, &|_| true);
            self.current = true;
        }
        let Self { system, force, body, courant, .. } = self;
        let wanted = match &mut self.stepping {
            Stepping::Global(stepper) => {
                stepper.begin(system, &**force);
                let smoothing = system.particles.smoothing.iter().enumerate();
                smoothing
                    .map(|(i, &h)| body.longest_step(i, *courant, h))
                    .fold(*courant * stepper.crossing_time(system), f64::min)
            }
            Stepping::Blocks(stepper) => stepper.begin(system, body),
        };
        self.wanted = Some(wanted);
        Ok(wanted)
    }

    fn advance(&mut self, step: f64) -> Result<(), Reason> {
        let (before, now) = (&mut self.before, &self.system.particles);
        before.position.clone_from(&now.position);
        before.velocity.clone_from(&now.velocity);
        before.mass.clone_from(&now.mass);
        before.thermal.clone_from(&now.thermal);
        before.smoothing.clone_from(&now.smoothing);
        self.body.keep();
        let impulse = self.wall_impulse();
        self.wanted = None;
        self.step(step).inspect_err(|_| {
            self.system.exchange(&mut self.before);
            self.set_wall_impulse(impulse);
            self.body.restore();
            // They were physical before the step.
            self.current = self.system.update_fields().is_ok();
            self.body.update(&self.system.particles, &|_| true);
        })
    }
}
