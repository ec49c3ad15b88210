//! Linear theory of the Lagrangian gas dynamics, and the running scheme held against it.

use super::plan::Named;
use super::riemann_run::{gas, sound_growth, states};
use super::tubes::{Tubes, tube};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::PaperText;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, from_f64, integer};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::{COURANT, KernelLattice, Step, catalogue};
use courant_analysis::stability::{Limit, SearchPlan};
use courant_simulation::lagrangian::LagrangianOptions;
use courant_simulation::lagrangian::flux::{ContactViscosity, Flux, ModifiedRoe};
use courant_simulation::lagrangian::linear::{PlaneWave, UniformFlow};
use serde::Deserialize;
use std::f64::consts::TAU;

/// Particles of a period in the checks.
const PARTICLES: usize = 48;
/// Steps over which growth is measured, at most.
const STEPS: u32 = 100;
/// The Courant number of runs and of what is stable whatever the flux.
const USUAL: f64 = 0.9;
/// Limits are looked for up to this Courant number.
const RANGE: i64 = 100;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    /// The tube whose left state is the flow: one that moves, so that the contact has a viscosity.
    flow: String,
    /// The tube whose sound speed grows most.
    steepest: String,
    /// Factors of the contact's viscosity in the Roe flux.
    contacts: Vec<f64>,
    kernel: Named<Kernel>,
    ratio: Named<Rational>,
}

/// A scheme of the catalogue with a kernel.
fn scheme(name: &str, lattice: &KernelLattice, values: &[(String, Rational)]) -> Step {
    let scheme = catalogue::scheme(name).expect("it is in the catalogue");
    scheme.step(Some(lattice), None, values, Some(COURANT)).expect("it is a scheme")
}

/// Up to which Courant number sound on particles is stable, and its characteristic variables monotone.
pub(super) fn limits_of_sound(kernel: Kernel, ratio: &Rational) -> [Limit; 2] {
    let search = SearchPlan::default().up_to(integer(RANGE));
    let lattice = KernelLattice::new(kernel, ratio).expect("it is in range");
    let sound = scheme("lagrangian-sound", &lattice, &[]);
    let stable = sound.stable_set(COURANT, &search).expect("one parameter is free");
    let one = scheme("godunov-sph", &lattice, &[]);
    let monotone = one.monotone_set(COURANT, &search).expect("one parameter is free");
    [stable.limit(), monotone.expect("one unknown, explicit").limit()]
}

impl Plan {
    fn flow(&self) -> UniformFlow {
        let tube = tube(&self.flow);
        UniformFlow { gas: gas(&tube), state: states(&tube)[0], particles: PARTICLES }
    }

    /// The fluxes with λ₂/C in the flow.
    fn fluxes(&self) -> Vec<(String, Flux, f64)> {
        let flow = self.flow();
        let (sound, speed) = (flow.sound(), flow.state.velocity().abs());
        let mut fluxes =
            vec![("exact".to_string(), Flux::Exact, 0.0), ("Rusanov".into(), Flux::Rusanov, 1.0)];
        for alpha in &self.contacts {
            let contact = ContactViscosity::Printed(*alpha);
            let flux = Flux::ModifiedRoe(ModifiedRoe { contact, ..ModifiedRoe::default() });
            fluxes.push((format!("Roe, α̃ = {alpha}"), flux, alpha * speed / sound));
        }
        fluxes
    }

    /// A scheme of the catalogue.
    fn scheme(&self, name: &str, values: &[(String, Rational)]) -> Step {
        let lattice = KernelLattice::new(self.kernel.0, &self.ratio.0).expect("it is in range");
        scheme(name, &lattice, values)
    }
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

    fn step(self, plan: &Plan) -> Step {
        match self {
            Self::Acoustic => plan.scheme("lagrangian-sound", &[]),
            Self::Contact(_) => self.characteristic(plan),
        }
    }

    /// What its characteristic variable alone obeys.
    fn characteristic(self, plan: &Plan) -> Step {
        match self {
            Self::Acoustic => plan.scheme("godunov-sph", &[]),
            Self::Contact(viscosity) => {
                let exact = from_f64(viscosity).expect("a finite number");
                plan.scheme("lagrangian-contact", &[("viscosity".into(), exact)])
            }
        }
    }
}

pub(super) fn describe(limit: &Limit) -> String {
    if limit.value().is_infinite() {
        return "none".into();
    }
    let exact = limit.exact().map(ToString::to_string).filter(|text| text.len() <= 8);
    exact.unwrap_or_else(|| significant(limit.value(), 6))
}

/// Text and table.
pub fn items(text: &PaperText, tubes: &Tubes) -> Vec<Item> {
    let plan: Plan = text.plan("linear");
    let cases = plan.fluxes().into_iter().flat_map(|(name, flux, viscosity)| {
        [Wave::Acoustic, Wave::Contact(viscosity)].map(|wave| (name.clone(), flux, wave))
    });
    let rows = cases.flat_map(|(name, flux, wave)| rows(&plan, &name, flux, wave));
    let growth = sound_growth(&tube(&plan.steepest));
    let [stable, _] = limits_of_sound(plan.kernel.0, &plan.ratio.0);
    let words = words![
        "growth" = significant(growth, 3),
        "usual" = significant(USUAL * growth, 3),
        "stable" = significant(stable.value() / growth, 3),
    ];
    let name = tubes.item("linear");
    vec![text.paragraph(&format!("{name}_text"), words), text.table(&name, &[], rows)]
}

fn rows(plan: &Plan, name: &str, flux: Flux, wave: Wave) -> Vec<Vec<String>> {
    let search = SearchPlan::default().up_to(integer(RANGE));
    let one = wave.characteristic(plan);
    let stable =
        wave.step(plan).stable_set(COURANT, &search).expect("one parameter is free").limit();
    let monotone = one.monotone_set(COURANT, &search).expect("one parameter is free");
    let monotone = monotone.expect("one unknown, explicit").limit();
    let compiled = one.compile().expect("one dimension");
    let amplification = |courant: f64, phase: f64| compiled.multipliers(&[courant], &[phase])[0];
    let family = wave.family();
    let own = match wave {
        Wave::Acoustic => 1.0,
        Wave::Contact(viscosity) => viscosity,
    };
    let (flow, options) = (plan.flow(), LagrangianOptions::new(flux));
    let worst = (0..=PARTICLES / 2)
        .map(|mode| {
            let phase = TAU * mode as f64 / PARTICLES as f64;
            let matrix = flow.amplification(&options, USUAL, mode).expect("a stable step");
            (0..3)
                .map(|row| {
                    let wanted = if row == family {
                        amplification(USUAL, phase)
                    } else {
                        Default::default()
                    };
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
    let [sound, _] = limits_of_sound(plan.kernel.0, &plan.ratio.0);
    let tried = if stable.value() < 1.3 * sound.value() {
        vec![0.99 * stable.value(), 1.01 * stable.value()]
    } else {
        vec![USUAL]
    };
    let check = |courant: f64| {
        let started = PlaneWave { family, mode, amplitude: 1e-7 };
        let predicted = amplification(courant, phase).norm();
        // Until a thousandth is left: what follows would be the round-off of 1 beside 1e-7.
        let steps = (1e-3f64.ln() / predicted.min(1.0).ln()).abs().clamp(1.0, f64::from(STEPS));
        let measured = flow.growth_per_step(&options, started, courant, steps as u32);
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
