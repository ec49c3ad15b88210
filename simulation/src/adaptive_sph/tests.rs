//! The rates against plain double sums, conservation, and the breakdown on test 3.

use super::{AdaptiveSphOptions, Fluid, run};
use crate::boundary::Boundary;
use crate::comparison::Comparison;
use crate::march::Evolution;
use crate::run::Reason;
use crate::scene::{Scene, ShockTube, SimpleWave, WaveData};

fn tube(name: &str) -> ShockTube {
    ShockTube::standard(name).expect("it is in the list")
}

fn wave() -> SimpleWave {
    SimpleWave::new(WaveData { amplitude: 0.1, gamma: 1.4, end_time: 0.4, particles: 100 })
        .expect("smooth")
}

/// Positions and owners of all particles and of far more images than any kernel reaches.
fn all_bodies(fluid: &Fluid) -> Vec<(f64, usize)> {
    let count = fluid.x.len();
    let mut bodies: Vec<_> = fluid.x.iter().copied().zip(0..count).collect();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| fluid.x[a].total_cmp(&fluid.x[b]));
    let (first, second) = (order[0], order[1]);
    let (last, before) = (order[count - 1], order[count - 2]);
    match fluid.boundary {
        Boundary::Transmissive | Boundary::Mirror | Boundary::Open => {
            for j in 1..=count {
                let far = j as f64;
                bodies.push((fluid.x[first] - far * (fluid.x[second] - fluid.x[first]), first));
                bodies.push((fluid.x[last] + far * (fluid.x[last] - fluid.x[before]), last));
            }
        }
        Boundary::Periodic => {
            for i in 0..count {
                bodies.extend([(fluid.x[i] - 1.0, i), (fluid.x[i] + 1.0, i)]);
            }
        }
    }
    bodies
}

fn close(found: &[f64], wanted: &[f64], what: &str) {
    let scale = wanted.iter().fold(f64::MIN_POSITIVE, |largest, value| largest.max(value.abs()));
    for (a, b) in found.iter().zip(wanted) {
        // A sum of some ten terms in another order.
        assert!((a - b).abs() < 1e-13 * scale, "{what}: {a} {b}");
    }
}

#[test]
fn the_rates_are_the_plain_double_sums() {
    let wave = wave();
    let sod = tube("sod");
    let scenes: [&dyn Scene; 2] = [&wave, &sod];
    for scene in scenes {
        let options = AdaptiveSphOptions::default();
        let mut fluid = Fluid::new(scene, 60, &options);
        for _ in 0..4 {
            let step = fluid.time_step().expect("sod stays physical");
            fluid.advance(step).expect("sod stays physical");
        }
        fluid.compute_rates();
        let (kernel, m, count) = (options.kernel, fluid.mass, fluid.x.len());
        let bodies = all_bodies(&fluid);
        let density_at = |x: f64, h: &dyn Fn(usize) -> f64| -> f64 {
            let term = |&(y, j): &(f64, usize)| m * kernel.value((x - y).abs() / h(j)) / h(j);
            bodies.iter().map(term).sum()
        };
        let h0 = fluid.pilot_length;
        let pilot: Vec<f64> = fluid.x.iter().map(|&x| density_at(x, &|_| h0)).collect();
        let g = (pilot.iter().map(|rho| rho.ln()).sum::<f64>() / count as f64).exp();
        let h: Vec<f64> = pilot.iter().map(|rho| 0.7 * (g / rho).sqrt() * h0).collect();
        close(&fluid.length, &h, "smoothing length");
        let rho: Vec<f64> =
            (0..count).map(|i| density_at(fluid.x[i], &|j| 0.5 * (h[i] + h[j]))).collect();
        close(&fluid.density, &rho, "density");
        let p: Vec<f64> = (0..count).map(|i| 0.4 * rho[i] * fluid.energy[i]).collect();
        let (mut a, mut e) = (vec![0.0; count], vec![0.0; count]);
        for i in 0..count {
            for &(y, j) in &bodies {
                let (r, hij) = (fluid.x[i] - y, 0.5 * (h[i] + h[j]));
                if r == 0.0 {
                    continue;
                }
                let dw = kernel.slope(r.abs() / hij) / (hij * hij) * r.signum();
                let dv = fluid.velocity[i] - fluid.velocity[j];
                let mut pi = 0.0;
                if dv * r < 0.0 {
                    let mu = hij * dv * r / (r * r + 0.01 * hij * hij);
                    let c = 0.5 * ((1.4 * p[i] / rho[i]).sqrt() + (1.4 * p[j] / rho[j]).sqrt());
                    pi = (-c * mu + 2.0 * mu * mu) / (0.5 * (rho[i] + rho[j]));
                }
                let stress = p[i] / rho[i].powi(2) + p[j] / rho[j].powi(2) + pi;
                a[i] -= m * stress * dw;
                e[i] += 0.5 * m * stress * dv * dw;
            }
        }
        close(&fluid.acceleration, &a, "acceleration");
        close(&fluid.heating, &e, "heating");
    }
}

#[test]
fn momentum_is_conserved_to_round_off_and_energy_to_second_order() {
    let tube = tube("sod");
    let drift = |cfl: f64| {
        let options = AdaptiveSphOptions { cfl, ..AdaptiveSphOptions::default() };
        let run = run(&tube, 100, &options).expect("valid");
        assert!(run.completed());
        assert!(run.conservation.momentum.abs() < 1e-14, "{:?}", run.conservation);
        run.conservation.energy.abs()
    };
    // The equations conserve energy, the midpoint rule does not: v·dv is taken at another
    // velocity than its mean, an error of the second order summed up.
    let ratio = drift(0.2) / drift(0.1);
    assert!((3.0..5.0).contains(&ratio), "{ratio}");
}

#[test]
fn test_3_breaks_down_with_100_points() {
    let tube = tube("ferrari3");
    for cfl in [0.3, 0.1, 0.01] {
        let options = AdaptiveSphOptions { cfl, ..AdaptiveSphOptions::default() };
        let run = run(&tube, 100, &options).expect("valid");
        let failure = run.failure.expect("it breaks down at any step");
        // The first cold particle: the hot neighbours it parts from do their work at its expense.
        assert!(
            matches!(failure.reason, Reason::InternalEnergy { particle: 50, value } if value < 0.0),
            "{failure}"
        );
        assert!(failure.time < 0.01 * tube.end_time());
    }
    // It depends on the smoothing: with less, the run ends, but particles pass each other.
    let options = AdaptiveSphOptions { pilot_ratio: 1.5, ..AdaptiveSphOptions::default() };
    let run = run(&tube, 100, &options).expect("valid");
    assert!(run.completed() && !run.profile.order_preserved());
}

#[test]
fn a_smooth_wave_converges_only_where_the_kernel_sums_to_one() {
    let wave = wave();
    let error = |particles, scale, sensitivity| {
        let options = AdaptiveSphOptions { scale, sensitivity, ..Default::default() };
        let run = run(&wave, particles, &options).expect("valid");
        assert!(run.completed());
        Comparison::inside(&wave, &run, [-1.0, 2.0]).l1.density
    };
    // h = 2Δ everywhere: the cubic spline sums to 1 there, and the viscosity is first order in h.
    let order = |scale, sensitivity| {
        (error(100, scale, sensitivity) / error(200, scale, sensitivity)).log2()
    };
    let consistent = order(1.0, 1.0);
    assert!((0.8..1.2).contains(&consistent), "{consistent}");
    // h = 1.4Δ on average, the default: the sum is off by 0.4 %, and no number of
    // particles mends that.
    let floor = order(0.7, 0.5);
    assert!(floor < 0.2, "{floor}");
}

#[test]
fn bad_options_are_errors() {
    let tube = tube("sod");
    let with = |options: AdaptiveSphOptions| run(&tube, 100, &options);
    assert!(with(AdaptiveSphOptions { alpha: -1.0, ..Default::default() }).is_err());
    assert!(with(AdaptiveSphOptions { cfl: f64::NAN, ..Default::default() }).is_err());
    assert!(with(AdaptiveSphOptions { scale: 0.0, ..Default::default() }).is_err());
    assert!(run(&tube, 3, &AdaptiveSphOptions::default()).is_err());
}
