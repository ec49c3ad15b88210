//! The particle methods: dispersion relation against the running step.

use super::{Arguments, Measured, csv_table};
use crate::cli::names;
use crate::cli::output::{Format, paragraphs, print, print_json, table_text};
use crate::cli::subject::Subject;
use crate::cli::waves::{self, Form, MethodName, Relation};
use crate::cli::{Failure, Outcome};
use courant::analysis::exact::rational::{integer, to_f64, to_text};
use courant::analysis::kernel::Density;
use courant::reports::advection_validation::FactorRecord;
use courant::reports::number::{finite, significant};
use courant::reports::particle_validation::{
    FollowedWave, ParticleCase, ParticleModeRow, ParticleValidationError, TOLERANCE, codes,
    follow_wave, gain, tolerance, validate_particles,
};
use courant::reports::record::SubjectRecord;
use courant::reports::table::{Align, Table};
use num_complex::Complex64;
use rayon::prelude::*;
use serde::Serialize;

/// What a subject is to the running particles, `c Δt/h` and their number.
fn case(
    subject: &Subject,
    form: Option<Form>,
    courant: f64,
    particles: usize,
) -> Result<(Relation, ParticleCase), Failure> {
    let refused = |message: String| Failure::Message(message);
    let isothermal = subject.eos.as_ref().is_none_or(|eos| eos.pressure == integer(1));
    if !isothermal || subject.density == Some(Density::MassPerSpacing) {
        return Err(refused(
            "--eos, --density: the running particles are isothermal, their density by summation"
                .into(),
        ));
    }
    let name = &subject.file.name;
    let value = |wanted: &str| subject.values.iter().find(|(name, _)| name == wanted);
    let alpha = value("alpha").map(|(_, value)| value);
    let name = MethodName::ALL.into_iter().find(|known| known.name() == name).ok_or_else(|| {
        let all = MethodName::ALL.map(MethodName::name);
        refused(format!("--method {name}: {}", names::unknown("method", name, &all)))
    })?;
    let integrator = subject.integrator.as_ref().map_or("", |integrator| integrator.name.as_str());
    let integrator = waves::integrator(integrator)
        .map_err(|problem| refused(format!("--integrator {integrator}: {problem}")))?;
    let (kernel, ratio) = subject.kernel.as_ref().expect("particle methods have kernels");
    let relation = name.method(form, alpha)?;
    let method = relation.lattice(*kernel, ratio, Density::default())?;
    Ok((relation, ParticleCase { method, integrator, courant, particles }))
}

/// The waves of a mode.
const BRANCHES: [&str; 2] = ["forward", "backward"];

/// A case and what came of it.
struct Compared {
    subject: SubjectRecord,
    relation: Relation,
    case: ParticleCase,
    rows: Vec<ParticleModeRow>,
    waves: Vec<FollowedWave>,
}

impl Compared {
    fn new(
        subject: SubjectRecord,
        relation: Relation,
        case: ParticleCase,
        steps: usize,
    ) -> Result<Self, ParticleValidationError> {
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
        Ok(Self { subject, relation, case, rows, waves })
    }

    /// The rows for machines.
    fn measured(&self) -> impl Iterator<Item = Measured<'_>> {
        self.rows.iter().flat_map(|row| {
            BRANCHES.into_iter().enumerate().map(|(index, branch)| {
                let pair = |z: [Complex64; 2]| [z[index].norm(), z[index].arg()];
                Measured {
                    subject: &self.subject,
                    cfl: self.case.courant,
                    mode: row.mode.to_string(),
                    phase: row.phase.to_string(),
                    branch: branch.into(),
                    code: row.code.name(),
                    predicted: pair(row.predicted),
                    measured: pair(row.measured),
                    error: row.error,
                    tolerance: tolerance(gain(row.predicted)),
                }
            })
        })
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

pub fn run(arguments: &Arguments, subjects: &[Subject]) -> Result<Outcome, Failure> {
    if arguments.fault.is_some() {
        return Err(Failure::Message("--fault: only advection schemes have it".into()));
    }
    let particles = arguments.on_line()?.unwrap_or(32);
    let steps = arguments.steps.unwrap_or(200) as usize;
    let mut cases = Vec::new();
    for subject in subjects {
        let sought = subject.sought(true)?;
        let given = arguments.cfl.iter().flat_map(|values| &values.0).chain(&sought.value);
        let mut values: Vec<f64> = given.map(to_f64).collect();
        if values.is_empty() {
            values.push(0.25);
        }
        for courant in values {
            let (relation, case) = case(subject, arguments.subject.form(), courant, particles)?;
            let record = subject.record(&sought.step, Some(&sought.parameter));
            cases.push((record, relation, case));
        }
    }
    let compared: Vec<Compared> = cases
        .into_par_iter()
        .map(|(subject, relation, case)| Compared::new(subject, relation, case, steps))
        .collect::<Result<_, _>>()
        .map_err(|error| {
            let option = match error {
                ParticleValidationError::Step(_) => "--cfl",
                ParticleValidationError::ShortRing { .. } => "--particles",
                ParticleValidationError::Integrator(_) | ParticleValidationError::Scheme(_) => {
                    "--integrator"
                }
                _ => "--ratio",
            };
            Failure::Message(format!("{option}: {error}"))
        })?;
    let passed = compared.iter().all(Compared::passed);
    let table = match (compared.as_slice(), arguments.format) {
        (all, Format::Csv) => csv_table(all.iter().flat_map(Compared::measured)),
        ([one], _) => mode_table(one),
        (many, _) => case_table(many),
    };
    match table_text(&table, arguments.format) {
        Some(mut text) => {
            if arguments.format == Format::Table {
                text.push_str(&paragraphs(&[conclusion(&compared, steps)]));
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
            one.relation.title(),
            case.method.kernel().name().into(),
            to_text(case.method.ratio()),
            case.integrator.name.clone(),
            names.join(", "),
            significant(largest_factor, 7),
            significant(one.max_error(), 2),
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
        for (index, branch) in BRANCHES.into_iter().enumerate() {
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
        "{verdict}; max error {}, allowed {}; {waves} waves followed for up to {steps} steps, max error of ω {}",
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
        for Compared { relation, case, rows, waves, .. } in compared {
            for row in rows {
                for (index, branch) in BRANCHES.into_iter().enumerate() {
                    record.rows.push(Row {
                        method: relation.method.name(),
                        form: relation.form.map(Form::name),
                        kernel: case.method.kernel().name(),
                        ratio: to_text(case.method.ratio()),
                        alpha: relation.alpha(),
                        integrator: &case.integrator.name,
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
                kernel: case.method.kernel().name(),
                ratio: to_text(case.method.ratio()),
                integrator: &case.integrator.name,
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
