//! What a run leaves behind, whatever the method.

mod failure;
pub(crate) mod judgement;
mod options;
mod profile;

pub use failure::{Failure, Reason};
pub use judgement::Promise;
pub use options::InvalidOptions;
pub(crate) use options::{not_negative, positive};
pub use profile::Profile;

use crate::march::{Evolution, MOST_STEPS, March, march};
use std::ops::ControlFlow;

/// A gas that marches: what a run needs to see of it.
pub trait Flowing: Evolution {
    /// What is conserved, less what has come in through the ends.
    fn totals(&self) -> Totals;
    /// Work done so far.
    fn counters(&self) -> Counters;
    /// How well energy is promised to be conserved.
    fn promise(&self) -> Promise {
        Promise::RoundOff
    }
    /// Neighbours that stand in the wrong order: one has passed through the other.
    fn out_of_order(&self) -> usize {
        0
    }
    /// Steps within blocks so far; `None` where everybody shares one step.
    fn substeps(&self) -> Option<u64> {
        None
    }
}

/// A gas in one dimension that marches.
pub trait Lined: Flowing {
    /// The present state.
    fn profile(&self) -> Profile;
}

/// Totals of what is conserved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Mass.
    pub mass: f64,
    /// Momentum; 0 along the axes that are not there.
    pub momentum: [f64; 3],
    /// `Σ m (|v| + c)`: the momentum if everything moved one way.
    pub motion: f64,
    /// Total energy; `None` for a gas without an energy equation.
    pub energy: Option<f64>,
    /// Volume `Σ m V`, of methods that advance the specific volume.
    pub volume: Option<f64>,
}

/// The drift of the conserved quantities: the change since the start less the flow through
/// the ends, over a scale that does not vanish.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Conservation {
    /// Over the mass at the start. Zero by construction where particles carry their mass.
    pub mass: f64,
    /// Its length over `Σ m (|v| + c)` at the start.
    pub momentum: f64,
    /// Over the total energy at the start; `None` for a gas without an energy equation.
    pub energy: Option<f64>,
    /// Over the volume at the start, for methods that advance the specific volume.
    pub volume: Option<f64>,
}

impl Conservation {
    pub(crate) fn between(start: &Totals, end: &Totals) -> Self {
        let change = end.momentum.iter().zip(&start.momentum).map(|(b, a)| (b - a) * (b - a));
        let part = |(before, after): (f64, f64)| (after - before) / before;
        Self {
            mass: part((start.mass, end.mass)),
            momentum: change.sum::<f64>().sqrt() / start.motion,
            energy: start.energy.zip(end.energy).map(part),
            volume: start.volume.zip(end.volume).map(part),
        }
    }
}

/// Work done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Evaluations of the forces on all particles or on the active ones, or of all fluxes.
    pub evaluations: u64,
    /// Particles whose neighbours were searched.
    pub searches: u64,
    /// Particles whose density was summed, with the iteration for their smoothing length.
    pub densities: u64,
    /// Pairs for which a force or flux was computed, each once.
    pub interactions: u64,
    /// Iterations of the Riemann solver, after the first guesses.
    pub riemann_iterations: u64,
    /// Cells and particles summed over for gravity.
    pub attractions: u64,
    /// The most particles that have kept their smoothing length at once, because all gas was too little for any.
    pub kept_lengths: u64,
}

/// Neighbours that stand in the wrong order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Penetration {
    /// After the last step.
    pub at_end: usize,
    /// The most after any step.
    pub largest: usize,
}

/// The result of a run, with a profile `P`. A run that broke down is a result too: see [`failure`](Self::failure).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Run<P = Profile> {
    /// The state at [`time`](Self::time); no energies for an isothermal gas.
    pub profile: P,
    /// How many steps were taken; with block steps, substeps.
    pub steps: usize,
    /// How many broke and were repeated with half their length.
    pub rejected: usize,
    /// The time reached.
    pub time: f64,
    /// Why, when and where the run broke down; `None` if it reached the end.
    pub failure: Option<Failure>,
    /// Whether it was stopped from outside before the end.
    pub cancelled: bool,
    /// What was lost or gained beyond the flow through the ends.
    pub conservation: Conservation,
    /// Work.
    pub counters: Counters,
    /// Particles that have passed each other.
    pub penetration: Penetration,
    /// How many of the particles stood beyond the left and the right end of the domain at the
    /// start. They are the first and the last of the profile.
    pub waiting: [usize; 2],
    /// What the user should know before believing the numbers.
    pub warnings: Vec<String>,
}

impl<P> Run<P> {
    /// Whether the run reached its end time.
    pub fn completed(&self) -> bool {
        self.failure.is_none() && !self.cancelled
    }

    /// What a march leaves, judged by itself.
    pub(crate) fn after(
        march: &March,
        profile: P,
        conservation: Conservation,
        promise: Promise,
        counters: Counters,
        penetration: Penetration,
    ) -> Self {
        Self {
            profile,
            steps: march.steps,
            rejected: march.rejected,
            time: march.time,
            failure: march.failure,
            cancelled: march.cancelled,
            conservation,
            counters,
            penetration,
            waiting: [0; 2],
            warnings: judgement::warnings(
                &conservation,
                promise,
                march.steps,
                &penetration,
                &counters,
            ),
        }
    }

    /// Counts the steps within blocks.
    pub(crate) fn with_substeps(mut self, substeps: Option<u64>) -> Self {
        self.steps = substeps.map_or(self.steps, |steps| steps as usize);
        self
    }

    /// Marches to `end_time`; after every step `observe(state, time)` may end it. `profile` is taken of the end.
    pub(crate) fn of<E: Flowing + ?Sized>(
        evolution: &mut E,
        end_time: f64,
        mut observe: impl FnMut(&E, f64) -> ControlFlow<()>,
        profile: impl FnOnce(&E) -> P,
    ) -> Self {
        let start = evolution.totals();
        let mut penetration = Penetration::default();
        let march = march(evolution, end_time, MOST_STEPS, |state, time| {
            penetration.at_end = state.out_of_order();
            penetration.largest = penetration.largest.max(penetration.at_end);
            observe(state, time)
        });
        let conservation = Conservation::between(&start, &evolution.totals());
        let (profile, promise) = (profile(evolution), evolution.promise());
        let counters = evolution.counters();
        Self::after(&march, profile, conservation, promise, counters, penetration)
            .with_substeps(evolution.substeps())
    }
}
