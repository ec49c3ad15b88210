//! What is left when nearly all particles are gone.

use super::pairs::{air, disordered};
use crate::boundary::Boundary;
use crate::march::{Evolution, March};
use crate::particles::*;
use crate::riemann::IdealGas;
use crate::run::{Conservation, Penetration, Promise, Reason, Run};
use courant_analysis::kernel::Kernel;

const FORCE: Smoothed = Smoothed { form: PressureForm::Sum, viscosity: Viscosity::STANDARD };

fn gas(count: usize, boundary: Boundary) -> ParticleSystem<3, IdealGas> {
    disordered::<3>(air(), boundary, count, 5, &FORCE, Kernel::CubicSpline)
}

#[test]
fn so_few_that_no_length_satisfies_them_keep_theirs() {
    // η³ = 1.728 times the own mass, seen with W(0, 1) = 1/π at most: below π η³ = 5.4 of them no h is short enough.
    let mut few = gas(3, Boundary::Open);
    let before = few.particles.smoothing.clone();
    few.update_fields().expect("a length for everybody");
    assert_eq!(few.particles.smoothing, before);
    assert!(few.density().iter().all(|density| *density > 0.0));
    assert_eq!(few.counters.kept_lengths, 3);
    // Whatever has such counters says so.
    let march = March { time: 1.0, steps: 1, rejected: 0, failure: None, cancelled: false };
    let (drift, penetration) = (Conservation::default(), Penetration::default());
    let run = Run::after(&march, (), drift, Promise::RoundOff, few.counters, penetration);
    assert!(run.warnings[0].ends_with("the last 3 particles kept theirs"), "{:?}", run.warnings);
    // Periodic images are without end, and a crowd is no few.
    for (count, boundary) in [(3, Boundary::Periodic), (60, Boundary::Open)] {
        let mut many = gas(count, boundary);
        many.update_fields().expect("a length for everybody");
        assert_eq!(many.counters.kept_lengths, 0);
        for (i, h) in many.particles.smoothing.iter().enumerate() {
            let asked = 1.2 * (many.particles.mass[i] / many.density()[i]).cbrt();
            assert!((h / asked - 1.0).abs() < 1e-3, "{count} {boundary:?}: {h} for {asked}");
        }
    }
}

/// Takes all but one particle between steps, and spoils that one, as long as it is hungry.
struct Devours {
    hungry: bool,
}

impl BodyForce<3> for Devours {
    fn settle<G: Gas>(&mut self, system: &mut ParticleSystem<3, G>) {
        if self.hungry {
            system.retain(|particle| particle == 7);
            system.particles.velocity[0][0] = f64::NAN;
        }
    }

    fn restore(&mut self) {
        self.hungry = false;
    }
}

#[test]
fn a_step_that_breaks_when_particles_are_gone_is_taken_back_with_them() {
    let system = gas(40, Boundary::Open);
    let position = system.particles.position.clone();
    let mut evolution =
        ParticleEvolution::blocks(system, Box::new(FORCE), 3, 0.2).under(Devours { hungry: true });
    let longest = evolution.time_step().expect("a physical state");
    let step = 0.01 * longest;
    assert_eq!(evolution.advance(step), Err(Reason::NotFinite { particle: 0 }));
    assert_eq!(evolution.system().particles.position, position);
    assert_eq!(evolution.system().density().len(), 40);
    assert_eq!(evolution.time_step(), Ok(longest));
    evolution.advance(step).expect("nobody is hungry now");
}
