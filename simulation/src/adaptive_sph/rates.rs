//! Smoothing lengths, densities, accelerations and heating of the particles as they stand.

use super::Fluid;
use crate::boundary::Boundary;

impl Fluid {
    /// Smoothing lengths from the pilot density, densities by summation, pressures.
    pub(super) fn compute_densities(&mut self) {
        let kernel = self.options.kernel;
        let (mass, pilot) = (self.mass, self.pilot_length);
        let reach = kernel.support() * pilot;
        self.bodies.arrange(&self.x, self.boundary, self.domain, reach);
        let density = &mut self.density;
        density.fill(0.0);
        self.bodies.for_each_pair(
            |_| reach,
            |i, _, distance| density[i] += mass * kernel.value(distance.abs() / pilot) / pilot,
        );
        let mean_log = density.iter().map(|rho| rho.ln()).sum::<f64>() / density.len() as f64;
        for (h, rho) in self.length.iter_mut().zip(density.iter()) {
            let excess = mean_log - rho.ln();
            *h = self.options.scale * pilot * (self.options.sensitivity * excess).exp();
        }
        let length = &self.length;
        let longest = length.iter().copied().fold(0.0, f64::max);
        let reach = |i: usize| kernel.support() * 0.5 * (length[i] + longest);
        self.bodies.arrange(&self.x, self.boundary, self.domain, kernel.support() * longest);
        density.fill(0.0);
        self.bodies.for_each_pair(reach, |i, other, distance| {
            let h = 0.5 * (length[i] + length[other.owner]);
            density[i] += mass * kernel.value(distance.abs() / h) / h;
        });
        for (i, &rho) in density.iter().enumerate() {
            self.pressure[i] = self.gas.pressure(rho, self.energy[i]);
            self.sound[i] = self.gas.sound_speed(rho, self.pressure[i]);
        }
    }

    /// Accelerations and heating, and all that they need.
    pub(super) fn compute_rates(&mut self) {
        self.compute_densities();
        let (options, mass) = (self.options, self.mass);
        let kernel = options.kernel;
        let (length, density, velocity) = (&self.length, &self.density, &self.velocity);
        let (pressure, sound) = (&self.pressure, &self.sound);
        let (acceleration, heating) = (&mut self.acceleration, &mut self.heating);
        let (approach, supply, pairs) = (&mut self.approach, &mut self.supply, &mut self.pairs);
        acceleration.fill(0.0);
        heating.fill(0.0);
        approach.fill(0.0);
        *supply = [0.0; 2];
        let from_outside = self.boundary != Boundary::Periodic;
        let longest = length.iter().copied().fold(0.0, f64::max);
        let reach = |i: usize| kernel.support() * 0.5 * (length[i] + longest);
        self.bodies.for_each_pair(reach, |i, other, distance| {
            let j = other.owner;
            let h = 0.5 * (length[i] + length[j]);
            let slope = kernel.slope(distance.abs() / h);
            if slope == 0.0 {
                return;
            }
            *pairs += 1;
            let gradient = slope * distance.signum() / (h * h);
            let closing = velocity[i] - velocity[j];
            let mut stress =
                pressure[i] / (density[i] * density[i]) + pressure[j] / (density[j] * density[j]);
            if closing * distance < 0.0 {
                let mu = h * closing * distance / (distance * distance + 0.01 * h * h);
                let mean_sound = 0.5 * (sound[i] + sound[j]);
                let mean_density = 0.5 * (density[i] + density[j]);
                stress += (options.beta * mu - options.alpha * mean_sound) * mu / mean_density;
                approach[i] = approach[i].max(-mu);
            }
            let push = -mass * stress * gradient;
            let heat = 0.5 * mass * stress * closing * gradient;
            acceleration[i] += push;
            heating[i] += heat;
            if other.ghost && from_outside {
                supply[0] += mass * push;
                supply[1] += mass * (velocity[i] * push + heat);
            }
        });
    }
}
