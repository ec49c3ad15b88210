//! The particle methods: dispersion relation against the running step.

use super::Arguments;
use crate::cli::names;
use crate::cli::numbers::{self, Names};
use crate::cli::output::{Format, print, print_json, table_text};
use crate::cli::waves::{self, MethodName};
use crate::cli::{Failure, Outcome};
use clap::Args;
use courant::analysis::exact::rational::{Rational, ratio, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::integrator::Integrator;
use courant::analysis::waves::dispersion::{Form, WaveMethod};
use courant::reports::advection_validation::FactorRecord;
use courant::reports::number::{finite, significant};
use courant::reports::particle_validation::{
    FollowedWave, ParticleCase, ParticleModeRow, ParticleValidationError, TOLERANCE, codes,
    follow_wave, gain, tolerance, validate_particles,
};
use courant::reports::table::{Align, Table};
use rayon::prelude::*;
use serde::Serialize;

/// A method by name.
pub fn method(text: &str) -> Result<MethodName, String> {
    MethodName::ALL
        .into_iter()
        .find(|method| method.name() == text)
        .ok_or_else(|| names::unknown("method", text, &MethodName::ALL.map(MethodName::name)))
}

/// Options that only particle methods have.
#[derive(Debug, Args)]
pub struct Options {
    /// Viscosity coefficient of sph-av, read exactly (default: 1).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::non_negative)]
    alpha: Option<Rational>,
    /// Relation of gph: resolved or published (default: resolved).
    #[arg(long, value_parser = |text: &str| text.parse::<Form>().map_err(|error| error.to_string()))]
    form: Option<Form>,
    /// Integrators of particle methods, separated by commas (default: all).
    #[arg(long, value_parser = |text: &str| numbers::names(text, waves::integrator))]
    integrator: Option<Names<Integrator>>,
}

impl Options {
    /// Complains about options that advection schemes do not have.
    pub fn reject(&self) -> Result<(), Failure> {
        let given = [
            ("--alpha", self.alpha.is_some()),
            ("--form", self.form.is_some()),
            ("--integrator", self.integrator.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Failure::Message(format!(
                "{option}: only particle methods have it; add --method sph, sph-av or gph"
            ))),
            None => Ok(()),
        }
    }

    fn wave_method(&self, name: MethodName) -> Result<WaveMethod, Failure> {
        if self.alpha.is_some() && name != MethodName::SphAv {
            return Err(Failure::Message("--alpha: only --method sph-av has a viscosity".into()));
        }
        if self.form.is_some() && name != MethodName::Gph {
            return Err(Failure::Message("--form: only --method gph has two relations".into()));
        }
        name.method(self.form, self.alpha.as_ref())
    }
}

/// A case and what came of it.
struct Compared {
    case: ParticleCase,
    rows: Vec<ParticleModeRow>,
    waves: Vec<FollowedWave>,
}

impl Compared {
    fn new(case: ParticleCase, steps: usize) -> Result<Self, ParticleValidationError> {
        let rows = validate_particles(&case)?;
        // Rounding in the fastest growing mode must stay below the wave that is followed.
        let fastest = largest(rows.iter().flat_map(|row| row.measured).map(|z| z.norm()));
        let steps = if fastest > 1.0 {
            ((10_f64.ln() / fastest.ln()) as usize).clamp(1, steps)
        } else {
            steps
        };
        let mut waves = Vec::new();
        for &code in codes(&case.method) {
            for row in rows.iter().filter(|row| row.code == code && 2 * row.mode < case.particles) {
                // What decays below rounding, or grows beyond the linear, shows no frequency.
                let gain = row.measured[0].norm().powf(steps as f64);
                if (1e-3..10.0).contains(&gain) {
                    waves.push(follow_wave(&case, code, row.mode, steps)?);
                }
            }
        }
        Ok(Self { case, rows, waves })
    }

    fn max_error(&self) -> f64 {
        largest(self.rows.iter().map(|row| row.error))
    }

    fn max_wave_error(&self) -> f64 {
        largest(self.waves.iter().map(FollowedWave::error))
    }

    /// What is allowed relative to the largest factor predicted.
    fn tolerance(&self) -> f64 {
        tolerance(largest(self.rows.iter().map(|row| gain(row.predicted))))
    }

    fn passed(&self) -> bool {
        self.rows.iter().all(|row| row.error <= tolerance(gain(row.predicted)))
            && self.max_wave_error() <= TOLERANCE
    }
}

/// The largest; what is not a number is larger than every number.
fn largest(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |most, error| if error.is_nan() { f64::INFINITY } else { most.max(error) })
}

pub fn run(arguments: &Arguments, name: MethodName) -> Result<Outcome, Failure> {
    if arguments.fault.is_some() {
        return Err(Failure::Message("--fault: only advection schemes have it".into()));
    }
    let method = arguments.particle.wave_method(name)?;
    let kernels = arguments.kernel.as_ref().map_or(&Kernel::ALL[..], |kernels| &kernels.0);
    let ratios = arguments.ratio.as_ref().map_or_else(|| vec![ratio(6, 5)], |list| list.0.clone());
    let integrators =
        arguments.particle.integrator.as_ref().map_or(&Integrator::ALL[..], |list| &list.0);
    let courant = arguments.cfl.as_ref().map_or(0.25, to_f64);
    let particles = arguments.particles.unwrap_or(32);
    let steps = arguments.steps.unwrap_or(200) as usize;
    let mut cases = Vec::new();
    for &kernel in kernels {
        for ratio in &ratios {
            for &integrator in integrators {
                let (method, ratio) = (method.clone(), ratio.clone());
                cases.push(ParticleCase { method, kernel, ratio, integrator, courant, particles });
            }
        }
    }
    let compared: Vec<Compared> = cases
        .into_par_iter()
        .map(|case| Compared::new(case, steps))
        .collect::<Result<_, _>>()
        .map_err(|error| {
            let option = match error {
                ParticleValidationError::Step(_) => "--cfl",
                ParticleValidationError::ShortRing { .. } => "--particles",
                _ => "--ratio",
            };
            Failure::Message(format!("{option}: {error}"))
        })?;
    let passed = compared.iter().all(Compared::passed);
    let table = match compared.as_slice() {
        [one] => mode_table(one),
        many => case_table(many),
    };
    match table_text(&table, arguments.format) {
        Some(mut text) => {
            if arguments.format == Format::Table {
                text.push_str(&conclusion(&compared, steps));
            }
            print(&text)?
        }
        None => print_json("validate", &Record::new(&compared, steps))?,
    };
    Ok(if passed { Outcome::Yes } else { Outcome::No })
}

fn case_table(compared: &[Compared]) -> Table {
    let mut table = Table::new(
        "Factors of one step, by the dispersion relation and measured on the running particles",
        &[
            ("method", Align::Left),
            ("kernel", Align::Left),
            ("h/Δ", Align::Right),
            ("integrator", Align::Left),
            ("codes", Align::Left),
            ("largest |z|", Align::Right),
            ("max error", Align::Right),
            ("allowed", Align::Right),
            ("waves followed", Align::Right),
            ("max error of ω", Align::Right),
            ("agrees", Align::Left),
        ],
    );
    for one in compared {
        let case = &one.case;
        let largest_factor =
            largest(one.rows.iter().flat_map(|row| row.predicted).map(|z| z.norm()));
        let names: Vec<&str> = codes(&case.method).iter().map(|code| code.name()).collect();
        table.push([
            case.method.title(),
            case.kernel.name().into(),
            to_text(&case.ratio),
            case.integrator.name().into(),
            names.join(", "),
            significant(largest_factor, 7),
            significant(one.max_error(), 2),
            significant(one.tolerance(), 2),
            one.waves.len().to_string(),
            significant(one.max_wave_error(), 2),
            if one.passed() { "yes" } else { "NO" }.into(),
        ]);
    }
    table
}

fn mode_table(one: &Compared) -> Table {
    let mut table = Table::new(
        format!("{}: factors of one step of each mode", one.case.title()),
        &[
            ("code", Align::Left),
            ("mode", Align::Right),
            ("φ", Align::Right),
            ("branch", Align::Left),
            ("predicted |z|", Align::Right),
            ("predicted arg z", Align::Right),
            ("measured |z|", Align::Right),
            ("measured arg z", Align::Right),
            ("error", Align::Right),
        ],
    );
    for row in &one.rows {
        for (index, branch) in ["forward", "backward"].into_iter().enumerate() {
            table.push([
                row.code.name().to_string(),
                row.mode.to_string(),
                significant(row.phase, 6),
                branch.into(),
                significant(row.predicted[index].norm(), 9),
                significant(row.predicted[index].arg(), 9),
                significant(row.measured[index].norm(), 9),
                significant(row.measured[index].arg(), 9),
                significant(row.error, 2),
            ]);
        }
    }
    table
}

fn conclusion(compared: &[Compared], steps: usize) -> String {
    let failed = compared.iter().filter(|one| !one.passed()).count();
    let modes: usize = compared.iter().map(|one| one.rows.len()).sum();
    let waves: usize = compared.iter().map(|one| one.waves.len()).sum();
    let verdict = match failed {
        0 => format!("all {modes} modes agree"),
        failed => {
            format!("{failed} of {} cases do not agree: relation and run differ", compared.len())
        }
    };
    format!(
        "\n{verdict}; max error {}, allowed {}; {waves} waves followed for up to {steps} steps, max error of ω {}\n",
        significant(largest(compared.iter().map(Compared::max_error)), 3),
        significant(largest(compared.iter().map(Compared::tolerance)), 3),
        significant(largest(compared.iter().map(Compared::max_wave_error)), 3),
    )
}

#[derive(Debug, Serialize)]
struct Row {
    method: &'static str,
    form: Option<&'static str>,
    kernel: &'static str,
    ratio: String,
    alpha: Option<f64>,
    integrator: &'static str,
    cfl: f64,
    code: &'static str,
    mode: usize,
    branch: &'static str,
    phase: f64,
    predicted: FactorRecord,
    measured: FactorRecord,
    error: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Wave {
    kernel: &'static str,
    ratio: String,
    integrator: &'static str,
    code: &'static str,
    mode: usize,
    phase: f64,
    steps: usize,
    predicted_omega: [Option<f64>; 2],
    measured_omega: [Option<f64>; 2],
    error: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Record {
    rows: Vec<Row>,
    waves: Vec<Wave>,
    max_error: Option<f64>,
    max_wave_error: Option<f64>,
    tolerance: f64,
    steps: usize,
    passed: bool,
}

impl Record {
    fn new(compared: &[Compared], steps: usize) -> Self {
        let mut record = Self {
            rows: Vec::new(),
            waves: Vec::new(),
            max_error: finite(largest(compared.iter().map(Compared::max_error))),
            max_wave_error: finite(largest(compared.iter().map(Compared::max_wave_error))),
            tolerance: largest(compared.iter().map(Compared::tolerance)),
            steps,
            passed: compared.iter().all(Compared::passed),
        };
        for Compared { case, rows, waves } in compared {
            for row in rows {
                for (index, branch) in ["forward", "backward"].into_iter().enumerate() {
                    record.rows.push(Row {
                        method: case.method.name(),
                        form: case.method.form().map(Form::name),
                        kernel: case.kernel.name(),
                        ratio: to_text(&case.ratio),
                        alpha: case.method.alpha().map(to_f64),
                        integrator: case.integrator.name(),
                        cfl: case.courant,
                        code: row.code.name(),
                        mode: row.mode,
                        branch,
                        phase: row.phase,
                        predicted: FactorRecord::new(row.predicted[index]),
                        measured: FactorRecord::new(row.measured[index]),
                        error: finite(row.error),
                    });
                }
            }
            record.waves.extend(waves.iter().map(|wave| Wave {
                kernel: case.kernel.name(),
                ratio: to_text(&case.ratio),
                integrator: case.integrator.name(),
                code: wave.code.name(),
                mode: wave.mode,
                phase: wave.phase,
                steps: wave.steps,
                predicted_omega: [wave.predicted.re, wave.predicted.im].map(finite),
                measured_omega: [wave.measured.re, wave.measured.im].map(finite),
                error: finite(wave.error()),
            }));
        }
        record
    }
}
