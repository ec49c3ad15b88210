//! Linear theory of the Lagrangian scheme, and the running scheme held against it.

use super::table_2::sound_growth;
use super::{runs, text};
use crate::number::significant;
use crate::page::Item;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, from_f64, integer};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{COURANT, KernelLattice, Step, catalogue};
use courant_analysis::stability::{Limit, SearchPlan};
use courant_simulation::lagrangian::LagrangianOptions;
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, ModifiedRoe};
use courant_simulation::lagrangian::linear::{PlaneWave, UniformFlow};
use courant_simulation::scene::Scene;
use std::f64::consts::TAU;

/// Particles of a period in the checks.
const PARTICLES: usize = 48;
/// Steps over which growth is measured, at most.
const STEPS: u32 = 100;
/// The limit of the acoustic waves with the cubic spline at l/Δξ = 2.
const SOUND_LIMIT: f64 = 15.0 / 8.0;
/// Limits are looked for up to this Courant number.
const RANGE: i64 = 100;

/// The flow of the checks: the left state of test 1, which moves, so that λ₂ of (3.15) is not 0.
fn flow() -> UniformFlow {
    let tube = runs::tube(1);
    UniformFlow { gas: tube.gas(), state: *tube.left(), particles: PARTICLES }
}

/// The fluxes with λ₂/C in the flow of the checks.
fn fluxes() -> Vec<(String, Flux, f64)> {
    let sound = flow().sound();
    let speed = flow().state.velocity().abs();
    let mut fluxes =
        vec![("exact".to_string(), Flux::Exact, 0.0), ("Rusanov".into(), Flux::Rusanov, 1.0)];
    for alpha in [0.1, 1.0] {
        let contact = ContactViscosity::Printed(alpha);
        let flux = Flux::ModifiedRoe(ModifiedRoe { contact, ..ModifiedRoe::default() });
        fluxes.push((format!("Roe, α̃ = {alpha}"), flux, alpha * speed / sound));
    }
    fluxes
}

/// The two parts of the linearised system.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Wave {
    /// Sound, which travels both ways.
    Acoustic,
    /// What stays with the particles, with its viscosity over the sound speed.
    Contact(f64),
}

impl Wave {
    fn name(self) -> &'static str {
        match self {
            Self::Acoustic => "acoustic",
            Self::Contact(_) => "contact",
        }
    }

    /// The eigenvalue that its characteristic variable belongs to.
    fn family(self) -> usize {
        match self {
            Self::Acoustic => 2,
            Self::Contact(_) => 1,
        }
    }

    fn step(self) -> Step {
        match self {
            Self::Acoustic => scheme("lagrangian-sound", &[]),
            Self::Contact(_) => self.characteristic(),
        }
    }

    /// What its characteristic variable alone obeys.
    fn characteristic(self) -> Step {
        match self {
            Self::Acoustic => scheme("godunov-sph", &[]),
            Self::Contact(viscosity) => {
                let exact = from_f64(viscosity).expect("a finite number");
                scheme("lagrangian-contact", &[("viscosity".into(), exact)])
            }
        }
    }
}

/// A scheme of the catalogue with the cubic spline at `l/Δξ = 2`.
fn scheme(name: &str, values: &[(String, Rational)]) -> Step {
    let lattice = KernelLattice::new(Kernel::CubicSpline, &integer(2)).expect("it is in range");
    let scheme = catalogue::scheme(name).expect("it is in the catalogue");
    scheme.step(Some(&lattice), None, values, Some(COURANT)).expect("it is a scheme")
}

fn describe(limit: &Limit) -> String {
    if limit.value().is_infinite() {
        return "none".into();
    }
    let exact = limit.exact().map(ToString::to_string).filter(|text| text.len() <= 8);
    exact.unwrap_or_else(|| significant(limit.value(), 6))
}

/// Text and table.
pub fn items() -> Vec<Item> {
    let cases = fluxes().into_iter().flat_map(|(name, flux, viscosity)| {
        [Wave::Acoustic, Wave::Contact(viscosity)].map(|wave| (name.clone(), flux, wave))
    });
    let rows = cases.flat_map(|(name, flux, wave)| rows(&name, flux, wave));
    vec![explanation(), text().table("section_3_linear", &[], rows)]
}

fn rows(name: &str, flux: Flux, wave: Wave) -> Vec<Vec<String>> {
    let plan = SearchPlan::default().up_to(integer(RANGE));
    let one = wave.characteristic();
    let stable = wave.step().stable_set(COURANT, &plan).expect("one parameter is free").limit();
    let monotone = one.monotone_set(COURANT, &plan).expect("one parameter is free");
    let monotone = monotone.expect("one unknown, explicit").limit();
    let compiled = one.compile().expect("one dimension");
    let amplification = |courant: f64, phase: f64| compiled.multipliers(&[courant], &[phase])[0];
    let family = wave.family();
    let own = match wave {
        Wave::Acoustic => 1.0,
        Wave::Contact(viscosity) => viscosity,
    };
    let options = LagrangianOptions::new(flux);
    let worst = (0..=PARTICLES / 2)
        .map(|mode| {
            let phase = TAU * mode as f64 / PARTICLES as f64;
            let matrix = flow().amplification(&options, 0.9, mode).expect("a stable step");
            (0..3)
                .map(|row| {
                    let wanted =
                        if row == family { amplification(0.9, phase) } else { Default::default() };
                    (matrix[row][family] - wanted).norm()
                })
                .fold(0.0, f64::max)
        })
        .fold(0.0, f64::max);
    // The mode next to the wave that binds; long waves are bound by the longest there is.
    let mode = stable
        .critical_phase()
        .map_or(1, |phase| ((phase * PARTICLES as f64 / TAU).round() as usize).max(1));
    let phase = TAU * mode as f64 / PARTICLES as f64;
    // Far above the limit of sound, round-off alone grows until the run breaks.
    let tried = if stable.value() < 1.3 * SOUND_LIMIT {
        vec![0.99 * stable.value(), 1.01 * stable.value()]
    } else {
        vec![0.9]
    };
    let check = |courant: f64| {
        let started = PlaneWave { family, mode, amplitude: 1e-7 };
        let predicted = amplification(courant, phase).norm();
        // Until a thousandth is left: what follows would be the round-off of 1 beside 1e-7.
        let steps = (1e-3f64.ln() / predicted.min(1.0).ln()).abs().clamp(1.0, f64::from(STEPS));
        let measured = flow().growth_per_step(&options, started, courant, steps as u32);
        let measured = match measured {
            Ok(growth) => format!("{growth:.7}"),
            Err(reason) => reason.to_string(),
        };
        cells![
            name,
            wave.name(),
            significant(own, 3),
            describe(&stable),
            describe(&monotone),
            significant(worst, 1),
            significant(phase, 3),
            significant(courant, 4),
            format!("{predicted:.7}"),
            measured,
        ]
    };
    tried.into_iter().map(check).collect()
}

fn explanation() -> Item {
    let growth = sound_growth(4);
    text().paragraph(
        "section_3_linear_text",
        words![
            "growth" = significant(growth, 3),
            "usual" = significant(0.9 * growth, 3),
            "stable" = significant(SOUND_LIMIT / growth, 3),
        ],
    )
}
