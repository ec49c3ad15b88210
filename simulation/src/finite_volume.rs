//! First-order finite volumes with the exact Riemann flux, in Eulerian coordinates: the reference
//! method of Ferrari et al. 2008 (Toro 1999, chapter 6).

use crate::boundary::Boundary;
use crate::march::{Evolution, Limits, march};
use crate::riemann::{IdealGas, State, solve};
use crate::run::{Conservation, InvalidOptions, Profile, Reason, Run, Totals, positive};
use crate::scene::{Scene, conserved_density};
use std::ops::ControlFlow;

/// What one chooses in a run of [`run`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FiniteVolumeOptions {
    /// The Courant number: `Δt = cfl Δx / S` with `S` the fastest wave of any face.
    pub cfl: f64,
    /// A run that is not done after so many steps fails.
    pub max_steps: usize,
}

impl Default for FiniteVolumeOptions {
    /// Courant number 0.9, Toro's customary choice.
    fn default() -> Self {
        Self { cfl: 0.9, max_steps: 1_000_000 }
    }
}

/// Godunov's method: `U_i += (Δt/Δx)(F_{i−1/2} − F_{i+1/2})` for `U = (ρ, ρv, ρE)`, the fluxes from
/// the exact Riemann solution on the ray `x/t = 0`.
///
/// The initial cells hold the means of the conserved quantities. The step follows the fastest wave of the
/// Riemann solutions of the step itself, so that no wave crosses a cell for `cfl ≤ 1`.
/// Work per step: `N + 1` fluxes.
///
/// # Errors
/// [`InvalidOptions`], when the Courant number is not a positive number or there are no cells.
pub fn run(
    scene: &dyn Scene,
    cells: usize,
    options: &FiniteVolumeOptions,
) -> Result<Run, InvalidOptions> {
    positive("cfl", options.cfl)?;
    if cells == 0 {
        return Err(InvalidOptions::Particles { particles: 0, least: 1 });
    }
    let mut grid = Grid::new(scene, cells, options.cfl);
    let start = grid.totals();
    let motion: f64 = grid
        .states
        .iter()
        .map(|state| {
            let sound = grid.gas.sound_speed(state.density(), state.pressure());
            state.density() * grid.width * (state.velocity().abs() + sound)
        })
        .sum();
    let scale = [start.0[0], motion, start.0[2]];
    let limits = Limits { steps: options.max_steps };
    let end = march(&mut grid, scene.end_time(), limits, |_, _| ControlFlow::Continue(()));
    let [mass, momentum, energy] = grid.totals().drift(start, grid.inflow, scale);
    let conservation = Conservation { mass, momentum, energy, volume: None };
    Ok(Run {
        profile: grid.profile(),
        steps: end.steps,
        rejected: end.rejected,
        time: end.time,
        failure: end.failure,
        conservation,
        pairs: grid.pairs,
        waiting: [0; 2],
        particle_mass: None,
    })
}

struct Grid {
    gas: IdealGas,
    boundary: Boundary,
    cfl: f64,
    width: f64,
    x: Vec<f64>,
    conserved: Vec<[f64; 3]>,
    states: Vec<State>,
    /// Conserved quantities and states after the step.
    next: (Vec<[f64; 3]>, Vec<State>),
    /// The flux at the left face of each cell and at the last face.
    fluxes: Vec<[f64; 3]>,
    inflow: Totals,
    pairs: u64,
}

impl Grid {
    fn new(scene: &dyn Scene, cells: usize, cfl: f64) -> Self {
        let gas = scene.gas();
        let [from, to] = scene.domain();
        let width = (to - from) / cells as f64;
        let face = |i: usize| from + (to - from) * (i as f64 / cells as f64);
        let states: Vec<_> = (0..cells).map(|i| scene.average(face(i), face(i + 1))).collect();
        Self {
            gas,
            boundary: scene.boundary(),
            cfl,
            width,
            x: (0..cells).map(|i| 0.5 * (face(i) + face(i + 1))).collect(),
            conserved: states.iter().map(|state| conserved_density(gas, state)).collect(),
            next: Default::default(),
            states,
            fluxes: vec![[0.0; 3]; cells + 1],
            inflow: Totals::default(),
            pairs: 0,
        }
    }

    fn totals(&self) -> Totals {
        Totals::sum(self.conserved.iter().map(|cell| cell.map(|u| u * self.width)))
    }

    fn profile(&self) -> Profile {
        let column = |value: &dyn Fn(&State) -> f64| self.states.iter().map(value).collect();
        Profile {
            x: self.x.clone(),
            density: column(&State::density),
            velocity: column(&State::velocity),
            pressure: column(&State::pressure),
            energy: column(&|state| self.gas.internal_energy(state.density(), state.pressure())),
        }
    }
}

impl Evolution for Grid {
    /// Solves the Riemann problem of every face, for its flux and for its fastest wave.
    fn time_step(&mut self) -> Result<f64, Reason> {
        let last = self.states.len() - 1;
        let (before, behind) = match self.boundary {
            Boundary::Transmissive => (self.states[0], self.states[last]),
            Boundary::Periodic => (self.states[last], self.states[0]),
            Boundary::Mirror => (self.states[0].mirrored(), self.states[last].mirrored()),
            Boundary::Open => (State::vacuum(0.0), State::vacuum(0.0)),
        };
        let mut fastest = 0.0f64;
        for (face, flux) in self.fluxes.iter_mut().enumerate() {
            let left = if face == 0 { &before } else { &self.states[face - 1] };
            let right = if face > last { &behind } else { &self.states[face] };
            let solution = solve(self.gas, left, right);
            let state = solution.sample(0.0);
            let [rho, momentum, energy] = conserved_density(self.gas, &state);
            let (v, p) = (state.velocity(), state.pressure());
            *flux = [rho * v, momentum * v + p, v * (energy + p)];
            // Equal states have no waves, but a disturbance of them would.
            let sound = self.gas.sound_speed(left.density(), left.pressure());
            fastest = fastest.max(solution.max_wave_speed()).max(left.velocity().abs() + sound);
        }
        self.pairs += self.fluxes.len() as u64;
        Ok(self.cfl * self.width / fastest)
    }

    fn advance(&mut self, step: f64) -> Result<(), Reason> {
        let factor = step / self.width;
        let (conserved, states) = (&mut self.next.0, &mut self.next.1);
        conserved.clear();
        states.clear();
        for (i, cell) in self.conserved.iter().enumerate() {
            let (entering, leaving) = (&self.fluxes[i], &self.fluxes[i + 1]);
            let cell = [0, 1, 2].map(|c| cell[c] + factor * (entering[c] - leaving[c]));
            let [rho, momentum, energy] = cell;
            let v = momentum / rho;
            let internal = energy / rho - 0.5 * v * v;
            Reason::of_particle(i, rho, internal, v)?;
            conserved.push(cell);
            states.push(State::trusted(rho, v, self.gas.pressure(rho, internal)));
        }
        std::mem::swap(&mut self.conserved, conserved);
        std::mem::swap(&mut self.states, states);
        for c in 0..3 {
            self.inflow.0[c] += step * (self.fluxes[0][c] - self.fluxes[self.fluxes.len() - 1][c]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{FiniteVolumeOptions, run};
    use crate::comparison::Comparison;
    use crate::run::{InvalidOptions, Run};
    use crate::scene::{STANDARD_TUBES, Scene, ShockTube, SimpleWave, WaveData};

    fn tube(name: &str) -> ShockTube {
        ShockTube::standard(name).expect("it is in the list")
    }

    fn run_default(scene: &dyn Scene, cells: usize) -> Run {
        run(scene, cells, &FiniteVolumeOptions::default()).expect("the defaults are valid")
    }

    #[test]
    fn a_contact_at_rest_on_a_face_stays() {
        let run = run_default(&tube("toro6"), 100);
        for i in 0..100 {
            assert_eq!(run.profile.density[i], if i < 50 { 1.4 } else { 1.0 });
            assert_eq!((run.profile.velocity[i], run.profile.pressure[i]), (0.0, 1.0));
        }
    }

    #[test]
    fn all_tubes_conserve_to_round_off() {
        for name in STANDARD_TUBES {
            let run = run_default(&tube(name), 100);
            assert!(run.completed(), "{name}");
            assert_eq!(run.pairs, 101 * run.steps as u64);
            let bound = f64::EPSILON * (run.steps as f64 + 30.0);
            let drift = run.conservation;
            assert!(drift.mass.abs() < bound && drift.energy.abs() < bound, "{name} {drift:?}");
            assert!(drift.momentum.abs() < bound, "{name} {drift:?}");
        }
    }

    #[test]
    fn a_smooth_wave_converges_at_first_order() {
        let data = WaveData { amplitude: 0.1, gamma: 1.4, end_time: 0.5, particles: 100 };
        let wave = SimpleWave::new(data).expect("smooth");
        let error = |cells| Comparison::new(&wave, &run_default(&wave, cells)).l1.density;
        let order = (error(200) / error(400)).log2();
        assert!((0.85..1.15).contains(&order), "{order}");
    }

    #[test]
    fn bad_options_are_errors() {
        let tube = tube("sod");
        let bad = FiniteVolumeOptions { cfl: -1.0, ..FiniteVolumeOptions::default() };
        assert_eq!(
            run(&tube, 100, &bad),
            Err(InvalidOptions::NotPositive { name: "cfl", value: -1.0 })
        );
        assert!(run(&tube, 0, &FiniteVolumeOptions::default()).is_err());
    }
}
