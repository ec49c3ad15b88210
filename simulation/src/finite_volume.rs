//! First-order finite volumes with the exact Riemann flux, in Eulerian coordinates: the reference
//! method of Ferrari et al. 2008 (Toro 1999, chapter 6).

use crate::boundary::Boundary;
use crate::march::Evolution;
use crate::riemann::{IdealGas, State, solve};
use crate::run::{Counters, Flowing, InvalidOptions, Lined, Profile, Reason, Totals, positive};
use crate::scene::{Scene, conserved_density};

/// What one chooses in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FiniteVolumeOptions {
    /// The Courant number: `Δt = cfl Δx / S` with `S` the fastest wave of any face.
    pub cfl: f64,
}

impl Default for FiniteVolumeOptions {
    /// Courant number 0.9, Toro's customary choice.
    fn default() -> Self {
        Self { cfl: 0.9 }
    }
}

impl FiniteVolumeOptions {
    /// Whether the options make sense; the least number of cells.
    pub(crate) fn check(&self) -> Result<usize, InvalidOptions> {
        positive("cfl", self.cfl)?;
        Ok(1)
    }
}

/// Godunov's method: `U_i += (Δt/Δx)(F_{i−1/2} − F_{i+1/2})` for `U = (ρ, ρv, ρE)`, the fluxes from
/// the exact Riemann solution on the ray `x/t = 0`.
///
/// The initial cells hold the means of the conserved quantities. The step follows the fastest wave of the
/// Riemann solutions of the step itself, so that no wave crosses a cell for `cfl ≤ 1`.
/// Work per step: `N + 1` fluxes.
pub(crate) struct Grid {
    gas: IdealGas,
    boundary: [Boundary; 2],
    cfl: f64,
    width: f64,
    x: Vec<f64>,
    conserved: Vec<[f64; 3]>,
    states: Vec<State>,
    /// Conserved quantities and states after the step.
    next: (Vec<[f64; 3]>, Vec<State>),
    /// The flux at the left face of each cell and at the last face.
    fluxes: Vec<[f64; 3]>,
    inflow: [f64; 3],
    counters: Counters,
}

impl Grid {
    /// The cells at the start, of a scene that the method covers.
    pub(crate) fn new(scene: &Scene, cells: usize, cfl: f64) -> Self {
        let gas = scene.material.ideal().expect("the scene is covered");
        let [from, to] = scene.domain;
        let width = (to - from) / cells as f64;
        let face = |i: usize| from + (to - from) * (i as f64 / cells as f64);
        let states: Vec<_> = (0..cells).map(|i| scene.average(gas, face(i), face(i + 1))).collect();
        Self {
            gas,
            boundary: scene.boundary,
            cfl,
            width,
            x: (0..cells).map(|i| 0.5 * (face(i) + face(i + 1))).collect(),
            conserved: states.iter().map(|state| conserved_density(gas, state)).collect(),
            next: Default::default(),
            states,
            fluxes: vec![[0.0; 3]; cells + 1],
            inflow: [0.0; 3],
            counters: Counters::default(),
        }
    }
}

impl Flowing for Grid {
    fn totals(&self) -> Totals {
        let mut sums = self.inflow.map(|inflow| -inflow);
        let mut motion = 0.0;
        for (cell, state) in self.conserved.iter().zip(&self.states) {
            for (sum, value) in sums.iter_mut().zip(cell) {
                *sum += value * self.width;
            }
            let sound = self.gas.sound_speed(state.density(), state.pressure());
            motion += state.density() * self.width * (state.velocity().abs() + sound);
        }
        let [mass, momentum, energy] = sums;
        Totals { mass, momentum: [momentum, 0.0, 0.0], motion, energy: Some(energy), volume: None }
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}

impl Lined for Grid {
    fn profile(&self) -> Profile {
        let column = |value: &dyn Fn(&State) -> f64| self.states.iter().map(value).collect();
        Profile {
            x: self.x.clone(),
            density: column(&State::density),
            velocity: column(&State::velocity),
            pressure: column(&State::pressure),
            energy: column(&|state| self.gas.internal_energy(state.density(), state.pressure())),
            ..Profile::default()
        }
    }
}

impl Evolution for Grid {
    /// Solves the Riemann problem of every face, for its flux and for its fastest wave.
    fn time_step(&mut self) -> Result<f64, Reason> {
        let last = self.states.len() - 1;
        let ghost = |end: Boundary, near: &State, far: &State| match end {
            Boundary::Transmissive => *near,
            Boundary::Periodic => *far,
            Boundary::Mirror => near.mirrored(),
            Boundary::Open => State::vacuum(0.0),
        };
        let (first, end) = (&self.states[0], &self.states[last]);
        let before = ghost(self.boundary[0], first, end);
        let behind = ghost(self.boundary[1], end, first);
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
            if cell == [0.0; 3] {
                conserved.push(cell);
                states.push(State::vacuum(0.0));
                continue;
            }
            let v = momentum / rho;
            let internal = energy / rho - 0.5 * v * v;
            Reason::of_particle(i, rho, internal, v)?;
            conserved.push(cell);
            states.push(State::trusted(rho, v, self.gas.pressure(rho, internal)));
        }
        std::mem::swap(&mut self.conserved, conserved);
        std::mem::swap(&mut self.states, states);
        self.counters.evaluations += 1;
        self.counters.interactions += self.fluxes.len() as u64;
        for c in 0..3 {
            self.inflow[c] += step * (self.fluxes[0][c] - self.fluxes[self.fluxes.len() - 1][c]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::comparison::Comparison;
    use crate::method::Method;
    use crate::run::Run;
    use crate::scene::Scene;

    fn run(scene: &Scene, cells: usize) -> Run {
        let method = Method::named("finite-volume").expect("it is in the list");
        method.run(scene, cells).expect("the defaults are valid")
    }

    #[test]
    fn a_contact_at_rest_on_a_face_stays() {
        let run = run(&Scene::named("toro6").expect("it is in the list"), 100);
        for i in 0..100 {
            assert_eq!(run.profile.density[i], if i < 50 { 1.4 } else { 1.0 });
            assert_eq!((run.profile.velocity[i], run.profile.pressure[i]), (0.0, 1.0));
        }
    }

    #[test]
    fn every_covered_scene_conserves_to_round_off() {
        for scene in Scene::all().filter(|scene| scene.material.ideal().is_some()) {
            let run = run(scene, 100);
            assert!(run.completed(), "{}: {:?}", scene.name, run.failure);
            assert_eq!(run.counters.interactions, 101 * run.steps as u64);
            assert_eq!(run.warnings, Vec::<String>::new(), "{}", scene.name);
        }
    }

    #[test]
    fn a_smooth_wave_converges_at_first_order() {
        let wave = Scene::named("simple-wave").expect("it is in the list");
        let error = |cells| Comparison::new(&wave, &run(&wave, cells)).expect("exact").l1.density;
        let order = (error(200) / error(400)).log2();
        assert!((0.85..1.15).contains(&order), "{order}");
    }
}
