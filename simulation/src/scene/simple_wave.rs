//! A smooth periodic sound wave of finite amplitude, before it breaks: Courant & Friedrichs 1948.

use super::Scene;
use crate::bisection::root;
use crate::riemann::State;
use std::f64::consts::{PI, TAU};

impl Scene {
    fn wave_gamma(&self) -> f64 {
        self.material.ideal().map_or(f64::NAN, |gas| gas.gamma())
    }

    /// `ρ = 1 + A sin 2πx`, `c = ρ^((γ−1)/2)`, `v = 2(c − 1)/(γ − 1)`, `p = ρ^γ/γ`: nothing runs to the left.
    pub(super) fn simple_wave(&self, amplitude: f64, x: f64) -> State {
        let gamma = self.wave_gamma();
        let density = 1.0 + amplitude * (TAU * x).sin();
        let sound = density.powf(0.5 * (gamma - 1.0));
        State::trusted(density, 2.0 / (gamma - 1.0) * (sound - 1.0), density.powf(gamma) / gamma)
    }

    /// `∫ρ`: the cosine's change as a product.
    pub(super) fn simple_wave_mass(amplitude: f64, from: f64, to: f64) -> f64 {
        (to - from) + amplitude * (PI * (from + to)).sin() * (PI * (to - from)).sin() / PI
    }

    /// A time before which the wave surely does not break: `−d(v + c)/dx = (γ+1)/2 c |ρ'|/ρ` with each factor at
    /// its worst.
    pub(super) fn breaking_time(&self, amplitude: f64) -> f64 {
        let gamma = self.wave_gamma();
        let crest = (1.0 + amplitude).powf(0.5 * (gamma - 1.0));
        (0.5 * (gamma + 1.0) * crest * TAU * amplitude / (1.0 - amplitude)).recip()
    }

    /// Every value travels with its own `v + c`.
    pub(super) fn simple_wave_later(&self, amplitude: f64, x: f64, time: f64) -> State {
        let speed = |from: f64| {
            let state = self.simple_wave(amplitude, from);
            state.velocity() + self.material.sound_speed(&state)
        };
        // All speeds are within 1 ± 3 for amplitudes below 1 and γ < 3; a wider bracket costs nothing.
        let reach = 1.0 + 100.0 * time;
        self.simple_wave(
            amplitude,
            root(x - reach, x + reach, |from| from + time * speed(from) - x),
        )
    }
}
