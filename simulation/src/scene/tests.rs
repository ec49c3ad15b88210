//! Scenes against independent sums and the equations of motion.

use super::{
    InvalidTube, InvalidWave, STANDARD_TUBES, Scene, ShockTube, SimpleWave, TubeData, WaveData,
};
use crate::scene::{MassLattice, conserved_density};

fn wave() -> SimpleWave {
    SimpleWave::new(WaveData { amplitude: 0.1, gamma: 1.4, end_time: 0.5, particles: 100 })
        .expect("a smooth wave")
}

fn data() -> TubeData {
    ShockTube::standard("sod").expect("it is in the list").data().clone()
}

#[test]
fn every_standard_tube_exists_under_its_name() {
    for name in STANDARD_TUBES {
        assert_eq!(ShockTube::standard(name).expect("it is in the list").name(), name);
    }
    assert_eq!(ShockTube::standard("toro99"), None);
}

#[test]
fn bad_numbers_are_named() {
    let bad = |change: &dyn Fn(&mut TubeData)| {
        let mut data = data();
        change(&mut data);
        ShockTube::new(data).expect_err("a number is bad")
    };
    assert!(matches!(bad(&|d| d.gamma = 1.0), InvalidTube::Gas(_)));
    assert!(matches!(bad(&|d| d.left[2] = -1.0), InvalidTube::Left(_)));
    assert!(matches!(bad(&|d| d.right[0] = f64::NAN), InvalidTube::Right(_)));
    assert!(matches!(bad(&|d| d.right = [0.0; 3]), InvalidTube::Empty { side: "right" }));
    assert!(matches!(bad(&|d| d.domain = [1.0, 0.0]), InvalidTube::Domain { .. }));
    assert!(matches!(bad(&|d| d.diaphragm = 1.0), InvalidTube::Diaphragm { .. }));
    assert!(matches!(bad(&|d| d.end_time = 0.0), InvalidTube::EndTime(_)));
    assert!(matches!(bad(&|d| d.particles = 3), InvalidTube::Particles(3)));
    let broken = WaveData { amplitude: 0.1, gamma: 1.4, end_time: 5.0, particles: 100 };
    assert!(matches!(SimpleWave::new(broken), Err(InvalidWave::EndTime { .. })));
}

#[test]
fn the_lattice_holds_the_totals_of_the_scene() {
    // Midpoint sums over a fine grid that puts the diaphragms of the tubes on a face.
    let fine = 100_000;
    let tubes = ["ferrari1", "ferrari2", "ferrari4", "sod"];
    let mut scenes: Vec<Box<dyn Scene>> = vec![Box::new(wave())];
    scenes.extend(tubes.map(|name| {
        Box::new(ShockTube::standard(name).expect("it is in the list")) as Box<dyn Scene>
    }));
    for scene in scenes {
        let lattice = MassLattice::new(scene.as_ref(), 100);
        let gas = scene.gas();
        let [left, right] = lattice.waiting;
        let inside = left..lattice.x.len() - right;
        assert_eq!(inside.len(), 100);
        let (mut found, mut wanted) = ([0.0; 4], [0.0; 4]);
        for state in &lattice.states[inside] {
            let volume = lattice.spacing / state.density();
            let densities = conserved_density(gas, state);
            for (sum, part) in found.iter_mut().zip([1.0, densities[0], densities[1], densities[2]])
            {
                *sum += part * volume;
            }
        }
        for i in 0..fine {
            let x = (f64::from(i) + 0.5) / f64::from(fine);
            let densities = conserved_density(gas, &scene.exact(x, 0.0));
            for (sum, part) in
                wanted.iter_mut().zip([1.0, densities[0], densities[1], densities[2]])
            {
                *sum += part / f64::from(fine);
            }
        }
        for k in 0..4 {
            // The midpoint rule of a periodic function or of constants is exact but for round-off
            // of 1e5 additions.
            let scale = wanted[k].abs().max(1.0);
            assert!((found[k] - wanted[k]).abs() < 1e-11 * scale, "{} {k}", scene.name());
        }
    }
}

#[test]
fn positions_halve_the_mass_of_each_particle() {
    let tube = ShockTube::standard("ferrari1").expect("it is in the list");
    let lattice = MassLattice::new(&tube, 100);
    // 0.15 of length 1 of gas of density 1 will enter; Δξ = 0.003875.
    assert_eq!(lattice.waiting, [39, 0]);
    assert!(lattice.x[38] < 0.0 && lattice.x[39] > 0.0);
    // Particle 77 straddles the diaphragm: the mass left of it is 77.42 Δξ.
    let mixed = &lattice.states[39 + 77];
    assert!(mixed.density() < 1.0 && mixed.density() > 0.125);
    assert_eq!(lattice.states[39 + 76].density(), 1.0);
    assert_eq!(lattice.states[39 + 78].density(), 0.125);
    let part = 0.3 / 0.003875 - 77.0;
    assert!((mixed.velocity() - 0.75 * part).abs() < 1e-12);
}

/// `U_t + F_x = 0` by differences of the sampled solution: no formula of the wave enters.
#[test]
fn the_simple_wave_solves_the_equations() {
    let wave = wave();
    let gas = wave.gas();
    let conserved = |x: f64, t: f64| conserved_density(gas, &wave.exact(x, t));
    let flux = |x: f64, t: f64| {
        let state = wave.exact(x, t);
        let [rho, momentum, energy] = conserved_density(gas, &state);
        let (v, p) = (state.velocity(), state.pressure());
        [rho * v, momentum * v + p, v * (energy + p)]
    };
    let d = 1e-4;
    for i in 0..20 {
        let (x, t) = (f64::from(i) * 0.05 + 0.01, 0.3);
        for k in 0..3 {
            let time = (conserved(x, t + d)[k] - conserved(x, t - d)[k]) / (2.0 * d);
            let space = (flux(x + d, t)[k] - flux(x - d, t)[k]) / (2.0 * d);
            // Second-order differences: d² times a third derivative of order (2π)³·0.1·steepening.
            assert!((time + space).abs() < 2e-5, "{x} {k}: {time} {space}");
        }
    }
}
