//! The tree against the sum over all pairs.

use super::*;
use crate::advection::SplitMix64;
use crate::particles::{BodyForce, Particles, Vector, dot, plus_scaled};

/// Numbers in (0, 1) that look random and are the same everywhere.
fn scatter(count: usize, seed: u64) -> Vec<f64> {
    let mut random = SplitMix64::new(seed);
    (0..count).map(|_| random.unit()).collect()
}

/// A ball with `M(r) ∝ r`, and smoothing lengths as they come with 50 neighbours.
struct Sphere {
    position: Vec<Vector<3>>,
    mass: Vec<f64>,
    smoothing: Vec<f64>,
}

impl Sphere {
    fn new(count: usize) -> Self {
        let numbers = scatter(3 * count, 7);
        let (mut position, mut smoothing) = (Vec::new(), Vec::new());
        for one in numbers.chunks_exact(3) {
            let (r, z, angle) = (one[0], 2.0 * one[1] - 1.0, 2.0 * std::f64::consts::PI * one[2]);
            let across = r * (1.0 - z * z).sqrt();
            position.push([across * angle.cos(), across * angle.sin(), r * z]);
            smoothing.push(1.15 * (4.0 * std::f64::consts::PI * r * r / count as f64).cbrt());
        }
        Self { position, mass: vec![2.0 / count as f64; count], smoothing }
    }

    fn bodies(&self) -> Bodies<'_> {
        Bodies { position: &self.position, mass: &self.mass, smoothing: &self.smoothing }
    }
}

/// `Σ_j` over everybody: acceleration and potential.
fn direct(bodies: &Bodies<'_>, i: usize) -> (Vector<3>, f64) {
    let (mut sum, mut depth) = ([0.0; 3], 0.0);
    for j in (0..bodies.mass.len()).filter(|&j| j != i) {
        let d = plus_scaled(&bodies.position[j], -1.0, &bodies.position[i]);
        let r = dot(&d, &d).sqrt();
        let mean = |f: fn(f64, f64) -> f64| {
            0.5 * bodies.mass[j] * (f(r, bodies.smoothing[i]) + f(r, bodies.smoothing[j]))
        };
        sum = plus_scaled(&sum, mean(attraction), &d);
        depth += mean(potential);
    }
    (sum, depth)
}

fn size(a: &Vector<3>) -> f64 {
    dot(a, a).sqrt()
}

/// Particles at rest at the bodies' places.
fn particles(sphere: Sphere) -> Particles<3, ()> {
    let count = sphere.mass.len();
    Particles {
        position: sphere.position,
        velocity: vec![[0.0; 3]; count],
        mass: sphere.mass,
        thermal: vec![(); count],
        smoothing: sphere.smoothing,
    }
}

#[test]
fn forces_agree_with_the_sum_over_all_pairs() {
    let sphere = Sphere::new(4000);
    let some: Vec<usize> = (0..4000).step_by(10).collect();
    let exact: Vec<_> = some.iter().map(|&i| direct(&sphere.bodies(), i)).collect();
    let particles = particles(sphere);
    let mut gravity = SelfGravity::new(1.0, None);
    gravity.update(&particles, &|_| true);
    let mut errors: Vec<f64> = some
        .iter()
        .zip(&exact)
        .map(|(&i, (exact, _))| {
            size(&plus_scaled(&gravity.acceleration(i), -1.0, exact)) / size(exact)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    assert!(errors[some.len() / 2] < 7e-4, "median {}", errors[some.len() / 2]);
    assert!(errors[some.len() * 99 / 100] < 2e-3, "99 of 100 {}", errors[some.len() * 99 / 100]);
    assert!(errors[some.len() - 1] < 1e-2);
    let net = gravity.net_force(&particles.mass);
    assert!(net > 0.0 && net < 1e-4, "momentum drifts by {net}");
    // Without cells that stand for their particles the sum is exact, and so is Newton's third law.
    let mut pairs = SelfGravity::new(1.0, None);
    pairs.tolerance = 0.0;
    pairs.update(&particles, &|_| true);
    pairs.update(&particles, &|_| true);
    for (&i, (exact, _)) in some.iter().zip(&exact) {
        assert!(size(&plus_scaled(&pairs.acceleration(i), -1.0, exact)) < 1e-12 * size(exact));
    }
    assert!(pairs.net_force(&particles.mass) < 1e-14);
    assert!(pairs.interactions > 10 * gravity.interactions / 2);
    // ½ Σ m φ of the tree against the pairs': on average they agree far better than each.
    let bodies = Bodies {
        position: &particles.position,
        mass: &particles.mass,
        smoothing: &particles.smoothing,
    };
    let depth: f64 = (0..4000).map(|i| 0.5 * particles.mass[i] * direct(&bodies, i).1).sum();
    let energy = gravity.energy(&particles);
    assert!((energy / depth - 1.0).abs() < 1e-4, "{energy} {depth}");
    // −∫ G M dM/r of M = 2r is −4; softening takes some of it away.
    assert!(energy > -4.0 && energy < -3.8, "{energy}");
}

#[test]
fn a_cell_far_away_attracts_by_its_quadrupole() {
    // A bar, seen from far: the error falls by the octupole, r⁻⁵, and that vanishes by symmetry: r⁻⁶.
    let position: Vec<Vector<3>> = (0..10).map(|k| [f64::from(k) - 4.5, 0.0, 0.0]).collect();
    let (mass, smoothing) = (vec![0.1; 10], vec![0.01; 10]);
    let bodies = Bodies { position: &position, mass: &mass, smoothing: &smoothing };
    let mut tree = Octree::default();
    tree.build(&bodies);
    let miss = |r: f64| {
        let x = [0.6 * r, 0.8 * r, 0.0];
        let walk = |opening| tree.attraction(&bodies, &x, 0.01, opening);
        let [cell, pairs] = [walk(Opening::Geometric(0.9)), walk(Opening::Geometric(0.0))];
        assert_eq!((cell.interactions, pairs.interactions), (1, 10));
        let potential = |opening| tree.potential(&bodies, &x, 0.01, opening);
        let [depth, exact] =
            [potential(Opening::Geometric(0.9)), potential(Opening::Geometric(0.0))];
        [size(&plus_scaled(&cell.acceleration, -1.0, &pairs.acceleration)), (depth - exact).abs()]
    };
    let ([near, near_depth], [far, far_depth]) = (miss(20.0), miss(40.0));
    assert!((near / far).log2() > 5.8 && near < 1e-5, "{near} {far}");
    assert!((near_depth / far_depth).log2() > 4.8, "{near_depth} {far_depth}");
}

#[test]
fn work_grows_like_n_log_n_and_threads_change_nothing() {
    let work = |count: usize| {
        let particles = particles(Sphere::new(count));
        let mut gravity = SelfGravity::new(1.0, None);
        gravity.update(&particles, &|_| true);
        let first = gravity.interactions;
        gravity.update(&particles, &|_| true);
        (gravity.interactions - first) as f64 / count as f64
    };
    let each = [2000, 4000, 8000, 16000, 32000].map(work);
    // What a doubling adds for each particle does not grow, and it is little.
    for pair in each.windows(2) {
        assert!(pair[1] - pair[0] < 60.0, "{each:?}");
    }
    assert!(each[4] < 700.0, "{each:?}");
    let particles = particles(Sphere::new(3000));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut gravity = SelfGravity::new(1.0, Some(Sink::new([0.0; 3], 0.5, 0.1)));
            gravity.update(&particles, &|_| true);
            gravity.update(&particles, &|i| i % 3 == 0);
            (0..3000).map(|i| gravity.acceleration(i).map(f64::to_bits)).collect::<Vec<_>>()
        })
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn a_tree_of_coincident_or_single_bodies_stands() {
    for count in [0, 1, 2, 100] {
        let position = vec![[0.3; 3]; count];
        let (mass, smoothing) = (vec![1.0; count], vec![0.1; count]);
        let bodies = Bodies { position: &position, mass: &mass, smoothing: &smoothing };
        let mut tree = Octree::default();
        tree.build(&bodies);
        let found = tree.attraction(&bodies, &[0.3; 3], 0.1, Opening::Geometric(0.5));
        assert_eq!(found.acceleration, [0.0; 3]);
        let found = tree.attraction(&bodies, &[2.3, 0.3, 0.3], 0.1, Opening::Geometric(0.5));
        assert!((found.acceleration[0] + count as f64 / 4.0).abs() <= 1e-12 * count as f64);
    }
}
