//! Where the mass of a scene is, and where its particles stand at the start.

use super::{Flow, Scene};
use crate::bisection::root;
use crate::boundary::Boundary;

impl Scene {
    /// Layers of gas with their left edges; the whole domain where it has none.
    fn pieces(&self) -> Vec<(f64, f64)> {
        let mut from = self.domain[0];
        let mut pieces = Vec::new();
        for layer in self.layers() {
            if !layer.is_vacuum() {
                pieces.push((from, layer.to));
            }
            from = layer.to;
        }
        if pieces.is_empty() { vec![(self.domain[0], self.domain[1])] } else { pieces }
    }

    /// The mass between two places of one piece.
    fn mass_between(&self, from: f64, to: f64) -> f64 {
        match (&self.flow, self.layer(0.5 * (from + to))) {
            (Flow::SimpleWave { amplitude }, _) => Self::simple_wave_mass(*amplitude, from, to),
            (_, Some(layer)) => layer.density.integral(from, to),
            (_, None) => 0.0,
        }
    }

    /// The mass in the domain at the start.
    pub fn mass(&self) -> f64 {
        self.pieces().iter().map(|&(from, to)| self.mass_between(from, to)).sum()
    }

    /// The mass of each layer of gas.
    pub fn layer_masses(&self) -> Vec<f64> {
        self.pieces().iter().map(|&(from, to)| self.mass_between(from, to)).collect()
    }

    /// The place in a piece with a given mass between it and the left end of the piece.
    fn place_of_mass(&self, (from, to): (f64, f64), mass: f64) -> f64 {
        match self.layer(0.5 * (from + to)).and_then(|layer| layer.density.constant()) {
            Some(density) => from + mass / density,
            None => root(from, to, |x| self.mass_between(from, x) - mass),
        }
    }

    /// The point with the mass `mass` between it and the left end, at the start; beyond the ends the gas goes on.
    pub fn position_at_mass(&self, mass: f64) -> f64 {
        let pieces = self.pieces();
        let mut before = 0.0;
        for (index, &(from, to)) in pieces.iter().enumerate() {
            let own = self.mass_between(from, to);
            let last = index + 1 == pieces.len();
            if mass <= before + own || last {
                return match self.boundary {
                    // Beyond the end of a period comes its start.
                    [Boundary::Periodic, _] => self.place_of_mass((from, to), mass - before),
                    _ if mass < 0.0 => from + mass / self.initial(from).density(),
                    _ if mass > before + own => {
                        to + (mass - before - own) / self.initial(to).density()
                    }
                    _ => self.place_of_mass((from, to), mass - before),
                };
            }
            before += own;
        }
        self.domain[1]
    }

    /// The mass that flows in through each end until the end time. The gas beyond a transmissive end is like that at the end.
    pub fn inflow(&self) -> [f64; 2] {
        let entering = |end: usize, sign: f64| {
            let state = self.initial(self.domain[end]);
            let open = self.boundary[end] == Boundary::Transmissive;
            let speed = if open { (sign * state.velocity()).max(0.0) } else { 0.0 };
            state.density() * speed * self.end_time
        };
        [entering(0, 1.0), entering(1, -1.0)]
    }

    /// Positions and masses of about `count` particles in the domain, and how many more stand beyond its left and right end.
    ///
    /// Each layer is filled with a whole number of equal masses, so that no particle straddles an edge. A vacuum
    /// has none. Beyond a transmissive end there is as much gas as can make itself felt until the end time.
    pub fn place(&self, count: usize) -> (Vec<(f64, f64)>, [usize; 2]) {
        let pieces = self.pieces();
        let total = self.mass();
        let share = |mass: f64| (count as f64 * mass / total).round() as usize;
        let (mut placed, mut before) = (Vec::with_capacity(count), 0.0);
        for &(from, to) in &pieces {
            let mass = self.mass_between(from, to);
            let number = (share(before + mass) - share(before)).max(1);
            let own = mass / number as f64;
            placed.extend(
                (0..number).map(|k| (self.place_of_mass((from, to), (k as f64 + 0.5) * own), own)),
            );
            before += mass;
        }
        let mut beyond = [0, 0];
        for (end, beyond) in beyond.iter_mut().enumerate() {
            let (x, mass) = if end == 0 { placed[0] } else { placed[placed.len() - 1] };
            let state = self.initial(self.domain[end]);
            if self.boundary[end] != Boundary::Transmissive || state.is_vacuum() {
                continue;
            }
            let spacing = mass / state.density();
            *beyond = (self.reach_of_end(end) / spacing).ceil() as usize;
            let sign = if end == 0 { -1.0 } else { 1.0 };
            let more = (1..=*beyond).map(|k| (x + sign * k as f64 * spacing, mass));
            if end == 0 {
                placed.splice(0..0, more.rev());
            } else {
                placed.extend(more);
            }
        }
        (placed, beyond)
    }

    /// How many particles [`place`](Self::place) makes, those beyond the ends included.
    pub(crate) fn particles_with_ends(&self, count: usize) -> f64 {
        let beyond = |end: usize| match self.boundary[end] {
            Boundary::Transmissive => {
                self.initial(self.domain[end]).density() * self.reach_of_end(end)
            }
            _ => 0.0,
        };
        count as f64 * (1.0 + (beyond(0) + beyond(1)) / self.mass())
    }

    /// Whether a vacuum lies between two gases.
    pub(crate) fn has_gap(&self) -> bool {
        self.pieces().windows(2).any(|pair| pair[0].1 < pair[1].0)
    }

    /// What the gas meets at its ends: nothing, where a vacuum lies between it and the end.
    pub(crate) fn ends_of_gas(&self) -> [Boundary; 2] {
        [0, 1].map(|end| match self.initial(self.domain[end]).is_vacuum() {
            true => Boundary::Open,
            false => self.boundary[end],
        })
    }

    /// How far beyond an end the gas matters: the way of the fastest signal until the end time.
    fn reach_of_end(&self, end: usize) -> f64 {
        let inward = if end == 0 { 1.0 } else { -1.0 };
        let speed = self
            .sampled_states()
            .iter()
            .map(|state| inward * state.velocity() + self.material.sound_speed(state))
            .fold(0.0, f64::max);
        speed * self.end_time
    }
}
