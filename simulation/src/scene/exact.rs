//! The exact solutions of scenes, and until when the ends leave them alone.

use super::{Flow, Layer, Material, Quantity, Scene};
use crate::boundary::Boundary;
use crate::riemann::isothermal::{Expansion, Isothermal};
use crate::riemann::{Solution, State, solve};

/// Which solution a scene has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExactSolution {
    /// Two states: a Riemann problem.
    Riemann,
    /// A weak pulse of velocity in a gas at rest: linear acoustics, d'Alembert.
    Acoustics,
    /// A simple wave, before it breaks.
    SimpleWave,
    /// None.
    None,
}

/// A pulse above this part of the sound speed is not weak.
const WEAK: f64 = 0.05;

impl Scene {
    /// Which solution the scene has.
    pub fn exact_solution(&self) -> ExactSolution {
        match &self.flow {
            Flow::SimpleWave { .. } => ExactSolution::SimpleWave,
            Flow::Layers(_) if self.two_states().is_some() => ExactSolution::Riemann,
            Flow::Layers(_) if self.weak_pulse().is_some() => ExactSolution::Acoustics,
            Flow::Layers(_) => ExactSolution::None,
        }
    }

    /// The two states of a Riemann problem, and where they meet.
    pub fn two_states(&self) -> Option<(State, State, f64)> {
        let [left, right] = self.layers() else { return None };
        // The initial state knows a vacuum, and the pressure of an isothermal gas.
        left.state().and(right.state())?;
        let [from, to] = self.domain;
        Some((self.initial(from), self.initial(to), left.to))
    }

    /// The gas at rest, and height, centre and width of its pulse.
    fn weak_pulse(&self) -> Option<(State, f64, f64, f64)> {
        let [Layer { density, velocity, pressure, .. }] = self.layers() else { return None };
        let Quantity::Pulse { mean, amplitude, centre, width } = velocity else { return None };
        density.constant().and(pressure.constant())?;
        let rest = self.initial(self.domain[0]);
        let rest = State::trusted(rest.density(), *mean, rest.pressure());
        let weak = amplitude.abs() <= WEAK * self.material.sound_speed(&rest) && *mean == 0.0;
        weak.then_some((rest, *amplitude, *centre, *width))
    }

    /// The Riemann solution of an ideal gas and its origin.
    pub fn riemann(&self) -> Option<(Solution, f64)> {
        let (left, right, origin) = self.two_states()?;
        Some((solve(self.material.ideal()?, &left, &right), origin))
    }

    /// The exact solution at `x` and `time`, as if there were no ends; `None` where none is known.
    pub fn exact(&self, x: f64, time: f64) -> Option<State> {
        if time <= 0.0 {
            return Some(self.initial(x));
        }
        match (&self.flow, self.material) {
            (Flow::SimpleWave { amplitude }, _) => {
                Some(self.simple_wave_later(*amplitude, x, time))
            }
            (Flow::Layers(_), Material::Ideal(gas)) => match self.two_states() {
                Some((left, right, origin)) => {
                    Some(solve(gas, &left, &right).sample((x - origin) / time))
                }
                None => self.acoustics(x, time),
            },
            (Flow::Layers(_), Material::Isothermal(_)) => {
                self.isothermal(x, time).or_else(|| self.acoustics(x, time))
            }
        }
    }

    fn isothermal(&self, x: f64, time: f64) -> Option<State> {
        let Material::Isothermal(gas) = self.material else { return None };
        let (left, right, origin) = self.two_states()?;
        if left.is_vacuum() || right.is_vacuum() {
            return None;
        }
        let solver = Isothermal { sound_speed: gas.sound_speed, expansion: Expansion::Exact };
        Some(solver.sample(&left, &right, (x - origin) / time))
    }

    /// D'Alembert's two halves of the pulse, reflected by mirrors.
    fn acoustics(&self, x: f64, time: f64) -> Option<State> {
        let (rest, amplitude, centre, width) = self.weak_pulse()?;
        let c = self.material.sound_speed(&rest);
        let [from, to] = self.domain;
        let pulse = |x: f64| {
            let scaled = (x - centre) / width;
            amplitude * (-scaled * scaled).exp()
        };
        // The velocity continued beyond the ends: odd about a mirror, periodic, or the bare pulse.
        let start = |x: f64| match self.boundary {
            [Boundary::Mirror, Boundary::Mirror] => {
                let length = to - from;
                let place = (x - from).rem_euclid(2.0 * length);
                if place <= length {
                    pulse(from + place)
                } else {
                    -pulse(from + 2.0 * length - place)
                }
            }
            [Boundary::Periodic, _] => pulse(from + (x - from).rem_euclid(to - from)),
            [left, right] => {
                let image = |end: Boundary, wall: f64| {
                    if end == Boundary::Mirror { -pulse(2.0 * wall - x) } else { 0.0 }
                };
                pulse(x) + image(left, from) + image(right, to)
            }
        };
        let (right, left) = (0.5 * start(x - c * time), 0.5 * start(x + c * time));
        let density = rest.density() * (1.0 + (right - left) / c);
        Some(State::trusted(
            density,
            right + left,
            rest.pressure() + c * c * (density - rest.density()),
        ))
    }

    /// States of the flow before the ends act: what is there at the start, and the middle of every Riemann problem
    /// between layers.
    pub(super) fn sampled_states(&self) -> Vec<State> {
        let [from, to] = self.domain;
        let mut states: Vec<State> = (0..=SAMPLES)
            .map(|i| self.initial(from + (to - from) * (f64::from(i) / f64::from(SAMPLES))))
            .collect();
        let edges: Vec<f64> = self.layers().iter().map(|layer| layer.to).collect();
        for &edge in edges.iter().filter(|edge| **edge < to) {
            let near = 1e-9 * (to - from);
            let (left, right) = (self.initial(edge - near), self.initial(edge + near));
            match self.material {
                Material::Ideal(gas) => {
                    let solution = solve(gas, &left, &right);
                    let (pressure, velocity) = (solution.pressure(), solution.velocity());
                    let (before, behind) = solution.densities();
                    states.extend(
                        [before, behind].map(|rho| State::trusted(rho, velocity, pressure)),
                    );
                    let fastest = solution.max_wave_speed();
                    states.extend([-fastest, fastest].map(|v| State::trusted(0.0, v, 0.0)));
                }
                Material::Isothermal(gas) if !left.is_vacuum() && !right.is_vacuum() => {
                    let solver =
                        Isothermal { sound_speed: gas.sound_speed, expansion: Expansion::Exact };
                    let closing = (left.velocity() - right.velocity()).max(0.0);
                    states.push(solver.sample(&left, &right, 0.0));
                    // A shock of the whole closing speed is faster than any that is there.
                    states.extend([-closing, closing].map(|v| State::trusted(1.0, v, 0.0)));
                }
                Material::Isothermal(_) => {}
            }
        }
        states
    }

    /// Until when the exact solution holds in the window: a pulse is followed through every reflection, a simple wave
    /// until it may break, a Riemann problem until a signal from an end can be inside.
    pub fn holds_until(&self) -> f64 {
        match (&self.flow, self.exact_solution()) {
            (Flow::SimpleWave { amplitude }, _) => self.breaking_time(*amplitude),
            (_, ExactSolution::Riemann) => {
                (0..2).map(|end| self.quiet(end)).fold(f64::INFINITY, f64::min)
            }
            (_, ExactSolution::Acoustics) => f64::INFINITY,
            (_, _) => 0.0,
        }
    }

    /// Until when an end is not felt in the window.
    fn quiet(&self, end: usize) -> f64 {
        let Some((left, right, origin)) = self.two_states() else { return 0.0 };
        if self.boundary[end] == Boundary::Transmissive {
            return f64::INFINITY;
        }
        let sign = if end == 0 { 1.0 } else { -1.0 };
        let state = if end == 0 { left } else { right };
        let gap = (sign * (self.window[end] - self.domain[end])).max(0.0);
        let speed =
            |state: &State, sign: f64| sign * state.velocity() + self.material.sound_speed(state);
        // A wall in a moving gas is a piston of that speed, an open end a rarefaction, the other end of a
        // period another gas.
        let (inward, sound) = (sign * state.velocity(), self.material.sound_speed(&state));
        let gamma = self.material.ideal().map_or(1.0, |gas| gas.gamma());
        let first = match self.boundary[end] {
            Boundary::Mirror if inward == 0.0 => f64::INFINITY,
            Boundary::Mirror => {
                let q = 0.25 * (gamma + 1.0) * (-inward).max(0.0);
                let shock = inward + q + (q * q + sound * sound).sqrt();
                if shock > 0.0 { gap / shock } else { f64::INFINITY }
            }
            Boundary::Periodic => {
                let fastest =
                    [left, right].map(|state| speed(&state, sign)).into_iter().fold(0.0, f64::max);
                gap / (2.0 * fastest)
            }
            Boundary::Open | Boundary::Transmissive if state.is_vacuum() => f64::INFINITY,
            Boundary::Open | Boundary::Transmissive => {
                let head = inward + sound;
                if head > 0.0 { gap / head } else { f64::INFINITY }
            }
        };
        // The waves of the middle come back from the end, no faster than twice what is there.
        let states = self.sampled_states();
        let outward = states.iter().map(|state| speed(state, -sign)).fold(0.0, f64::max);
        let back = states.iter().map(|state| speed(state, sign)).fold(0.0, f64::max);
        let way = (origin - self.domain[end]).abs();
        first.min(way / outward + gap / (2.0 * back.max(outward)))
    }
}

/// Where initial states are looked at.
const SAMPLES: u32 = 64;
