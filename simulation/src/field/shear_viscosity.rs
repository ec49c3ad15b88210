//! What the pair forces of a scheme do to a transverse wave of small amplitude on a lattice.

use super::scene::{FieldFlow, FieldScene};
use crate::particles::{ActsOn, MethodOptions, ParticleMethod, RadialKernel, SmoothingKernel};
use crate::scene::Material;
use num_complex::Complex64;
use std::f64::consts::{PI, SQRT_2};

/// The response to `v = (0, v₀ sin κx)` on the undisturbed lattice, over `κ² v₀`: in units of a viscosity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearResponse {
    /// `ν`: the sine decays like `exp(−ν κ² t)`.
    pub viscosity: f64,
    /// The rms acceleration *across* the flow. A viscosity has none; a force that acts on approaching pairs only has, because
    /// of each pair and its mirror image in the direction of the flow only one acts.
    pub crossing: f64,
    /// `ω²/κ²` of the transverse oscillation about the lattice, which resists shear like an elastic body; where it is
    /// negative, shear grows. It acts as long as the particles stay at their places: a sine of amplitude `v₀` has
    /// left them after a time `Δ/v₀`.
    pub stiffness: f64,
}

impl ShearResponse {
    /// What is left of the amplitude of a small sine after a time: `v̈ + νκ² v̇ + ω² v = 0` from `v = 1`, `v̇ = −νκ²`.
    pub fn amplitude_left(&self, wave_number: f64, time: f64) -> f64 {
        let square = wave_number * wave_number;
        let (half, stiffness) = (0.5 * self.viscosity * square, self.stiffness * square);
        let discriminant = Complex64::from(half * half - stiffness).sqrt() * time;
        let ratio = if discriminant.norm() < 1e-12 {
            Complex64::ONE
        } else {
            discriminant.sinh() / discriminant
        };
        ((discriminant.cosh() - ratio * half * time) * (-half * time).exp()).re
    }
}

/// The response of a method to the shear of a scene in a plane, by sums over the lattice.
///
/// On a lattice at rest with uniform density the linear part of every pair force is `m K(r) (v_ji·e) e` on particle `i`, `e` the unit
/// vector and `v_ji = v_j − v_i`. Of a Riemann problem between equal states the star pressure is `P + ρc (v_L − v_R)/2`, and the
/// factor of all cases is `2|W'|/ρ²`: `K = (c/ρ)|W'(r, h)|` (case 4: at `√2 h`). Artificial viscosity (8) has
/// `K = α c̄ h r/(r² + η h²) |W'(r, h)|/ρ` on approaching pairs. Balsara's factor vanishes in a shear, and so does `K`.
/// Then `dv_y/dt = −Γ v_y` with `Γ = Σ m K (e_y)² (1 − cos κ d_x)`, half of it where half of the pairs act: `ν = Γ/κ²`.
///
/// The pressures give `ω² = (2P m/ρ²) Σ (1 − cos κ d_x) (W'' e_y² + (W'/r) e_x²)`, case 4 with `√2 h`: neither density nor smoothing
/// lengths change in a transverse wave.
///
/// `None` for other scenes.
pub fn shear_response(
    scene: &FieldScene,
    particles: usize,
    options: &MethodOptions,
) -> Option<ShearResponse> {
    let FieldFlow::Shear { density, pressure, .. } = scene.flow else { return None };
    let (lower, filling) = scene.fill::<2>(particles)?;
    let edge = [filling.upper[0] - lower[0], filling.upper[1] - lower[1]];
    let wave = 2.0 * PI / edge[0];
    let mass = density * edge[0] * edge[1] / filling.positions.len() as f64;
    let kernel = SmoothingKernel::<2>::new(options.kernel);
    let reference = filling.positions[0];
    let displacements: Vec<[f64; 2]> = filling.positions[1..]
        .iter()
        .map(|x| {
            std::array::from_fn(|axis| {
                let d = x[axis] - reference[axis];
                d - (d / edge[axis]).round() * edge[axis]
            })
        })
        .collect();
    let length = |d: &[f64; 2]| d[0].hypot(d[1]);
    // h = η √(m/ρ(h)), by iteration: the sum depends weakly on h.
    let mut h = options.eta * (mass / density).sqrt();
    let mut rho = density;
    for _ in 0..200 {
        let sum: f64 = displacements.iter().map(|d| kernel.value(length(d), h)).sum();
        rho = mass * (kernel.value(0.0, h) + sum);
        h = 0.5 * (h + options.eta * (mass / rho).sqrt());
    }
    let (sound, gamma) = match scene.gas {
        Material::Isothermal(gas) => (gas.sound_speed, 1.0),
        Material::Ideal(gas) => (gas.sound_speed(density, pressure), gas.gamma()),
    };
    let viscosity = &options.viscosity;
    let strength = |r: f64| match options.method {
        ParticleMethod::Gph1 | ParticleMethod::Gph2 | ParticleMethod::Gph3 => {
            -sound / rho * kernel.slope(r, h)
        }
        ParticleMethod::Gph4 => -sound / rho * kernel.slope(r, SQRT_2 * h),
        ParticleMethod::Sph1 | ParticleMethod::Sph2 | ParticleMethod::Adke => {
            match viscosity.acts_on {
                ActsOn::Compressing => 0.0,
                ActsOn::Approaching | ActsOn::All => {
                    let softened = h * r / (r * r + viscosity.softening * h * h);
                    -viscosity.alpha * sound / rho * softened * kernel.slope(r, h)
                }
            }
        }
    };
    let all = options.method.is_godunov() || viscosity.acts_on == ActsOn::All;
    // Acceleration at x: the sum over the pairs that act.
    let acceleration = |x: f64| {
        displacements.iter().fold([0.0; 2], |sum, d| {
            let r = length(d);
            let apart = ((wave * (x + d[0])).sin() - (wave * x).sin()) * d[1] / r;
            if !all && apart >= 0.0 {
                return sum;
            }
            let force = mass * strength(r) * apart / r;
            [sum[0] + force * d[0], sum[1] + force * d[1]]
        })
    };
    const SAMPLES: i32 = 256;
    let (mut damping, mut crossing) = (0.0, 0.0);
    for k in 0..SAMPLES {
        let x = edge[0] * (f64::from(k) + 0.5) / f64::from(SAMPLES);
        let [across, along] = acceleration(x);
        damping -= 2.0 * along * (wave * x).sin() / f64::from(SAMPLES);
        crossing += across * across / f64::from(SAMPLES);
    }
    let width = if options.method == ParticleMethod::Gph4 { SQRT_2 * h } else { h };
    let norm = kernel.value(0.0, width) / options.kernel.value(0.0) / (width * width);
    let stiffness: f64 = displacements
        .iter()
        .map(|d| {
            let r = length(d);
            let curvature = norm * options.kernel.curvature(r / width) * d[1] * d[1];
            let slope = kernel.slope(r, width) / r * d[0] * d[0];
            (1.0 - (wave * d[0]).cos()) * (curvature + slope) / (r * r)
        })
        .sum();
    let stiffness = 2.0 * sound * sound / gamma * mass / rho * stiffness;
    let unit = wave * wave;
    let [viscosity, crossing] = [damping, crossing.sqrt()].map(|rate| rate / unit);
    Some(ShearResponse { viscosity, crossing, stiffness: stiffness / unit })
}
