//! `courant dispersion`.

use super::numbers::{self, Numbers};
use super::output::{Format, print, print_json, table_text};
use super::waves::{self, DensityName, Form, MethodName, Relation};
use super::{Failure, Outcome, names};
use clap::{Args, ValueEnum};
use courant::analysis::exact::rational::{Rational, integer, to_f64, to_text};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::Integrator;
use courant::analysis::waves::dispersion::{
    AmplitudeTime, Branch, Frequencies, amplitude, phase_error, stepped_frequencies, two_waves,
};
use courant::reports::cha_whitworth2003::published::PublishedWaves;
use courant::reports::number::{finite, significant};
use courant::reports::table::{Align, Table};
use num_traits::Signed;
use rayon::prelude::*;
use serde::Serialize;

/// Rows of one answer at most.
const MAX_ROWS: usize = 1_000_000;

/// Which relations of Godunov particle hydrodynamics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FormChoice {
    /// What the scheme does: left and right by position.
    Resolved,
    /// As printed.
    Published,
    /// One after the other.
    Both,
}

#[derive(Debug, Args)]
pub struct Arguments {
    /// Method.
    #[arg(long, value_enum)]
    method: MethodName,
    /// Kernel: see `courant list kernels`.
    #[arg(long, value_parser = names::kernel, default_value = "cubic-spline")]
    kernel: Kernel,
    /// Smoothing ratios h/Δ: 1.2 or 1,3/2 or 1:2:0.1, read exactly.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list)]
    ratio: Numbers,
    /// Wave numbers κΔ in radians per spacing, from 0 to 2π: 0.1:3.1:0.1. The shortest wave is π.
    #[arg(long, allow_hyphen_values = true, value_parser = kappa_list)]
    kappa: Numbers,
    /// Coefficient of viscosity of sph-av (default: 1).
    #[arg(long, allow_hyphen_values = true, value_parser = waves::alpha)]
    alpha: Option<Rational>,
    /// Relation of gph (default: both).
    #[arg(long, value_enum)]
    form: Option<FormChoice>,
    /// The wave as this integrator steps it (default: exact in time); needs --cfl.
    #[arg(long, value_parser = waves::integrator, requires = "cfl")]
    integrator: Option<&'static Integrator>,
    /// Time step c Δt/h of the integrator.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_number, requires = "integrator")]
    cfl: Option<Rational>,
    /// Density ρ0 of the undisturbed lattice.
    #[arg(long, value_enum, default_value = "summation")]
    density: DensityName,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// Wave numbers in radians per spacing.
pub fn kappa_list(text: &str) -> Result<Numbers, String> {
    let numbers = numbers::list(text)?;
    match numbers.0.iter().find(|k| k.is_negative() || to_f64(k) > 2.0 * std::f64::consts::PI) {
        Some(kappa) => Err(format!(
            "{} is out of range: from 0 to 2π radians per spacing",
            numbers::brief(kappa)
        )),
        None => Ok(numbers),
    }
}

/// One wave. Frequencies are in units of `c/Δ`.
#[derive(Debug, Clone, Serialize)]
struct Row {
    method: &'static str,
    /// Only for Godunov particle hydrodynamics.
    form: Option<&'static str>,
    kernel: &'static str,
    ratio: String,
    /// Only for a method with a coefficient of viscosity.
    alpha: Option<f64>,
    kappa: f64,
    branch: &'static str,
    omega_re: Option<f64>,
    omega_im: Option<f64>,
    phase_error: Option<f64>,
    amplitude: Option<f64>,
    regime: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    integrator: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cfl: Option<f64>,
    /// Why a number is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

#[derive(Debug, Serialize)]
struct Rows {
    /// What the numbers are measured in.
    units: &'static str,
    density: &'static str,
    rows: Vec<Row>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let methods = methods(arguments)?;
    let count = 2 * methods.len() * arguments.ratio.0.len() * arguments.kappa.0.len();
    if count > MAX_ROWS {
        return Err(Failure::Message(format!(
            "--ratio and --kappa: the answer would have {count} rows; at most {MAX_ROWS} are accepted"
        )));
    }
    let cases: Vec<(&Relation, &Rational)> = methods
        .iter()
        .flat_map(|method| arguments.ratio.0.iter().map(move |ratio| (method, ratio)))
        .collect();
    let rows: Result<Vec<Vec<Row>>, Failure> =
        cases.into_par_iter().map(|(method, ratio)| waves_of(arguments, method, ratio)).collect();
    let rows: Vec<Row> = rows?.into_iter().flatten().collect();
    match table_text(&table(arguments, &rows), arguments.format) {
        Some(text) => print(&text),
        None => {
            let units = "kappa in radians per spacing Δ, omega in c/Δ, amplitude at t = Δ/c";
            let density = courant::analysis::kernel::Density::from(arguments.density).formula();
            print_json("dispersion", &Rows { units, density, rows })
        }
    }
}

fn methods(arguments: &Arguments) -> Result<Vec<Relation>, Failure> {
    let forms = match (arguments.method, arguments.form) {
        (MethodName::Gph, None | Some(FormChoice::Both)) => {
            vec![Some(Form::Published), Some(Form::Resolved)]
        }
        (_, Some(FormChoice::Published)) => vec![Some(Form::Published)],
        (_, Some(FormChoice::Resolved | FormChoice::Both)) => vec![Some(Form::Resolved)],
        (_, None) => vec![None],
    };
    forms.into_iter().map(|form| arguments.method.method(form, arguments.alpha.as_ref())).collect()
}

fn waves_of(
    arguments: &Arguments,
    relation: &Relation,
    ratio: &Rational,
) -> Result<Vec<Row>, Failure> {
    let lattice = relation.lattice(arguments.kernel, ratio, arguments.density.into())?;
    let exact: Box<dyn Fn(f64) -> Frequencies> = if relation.is_published() {
        let waves = PublishedWaves::of(&lattice)
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
        Box::new(move |kappa| waves.frequencies(kappa))
    } else {
        let waves = lattice.waves()?.compile();
        Box::new(move |kappa| waves.mode(kappa).frequencies())
    };
    let stepped = match (arguments.integrator, &arguments.cfl) {
        (Some(integrator), Some(cfl)) => {
            Some((lattice.step(integrator)?.compile()?, to_f64(cfl), to_f64(&(cfl * ratio))))
        }
        _ => None,
    };
    let mut rows = Vec::new();
    for kappa in arguments.kappa.0.iter().map(to_f64) {
        let exact = exact(kappa);
        let found = match &stepped {
            Some((step, cfl, time)) => {
                stepped_frequencies(two_waves(step, &[*cfl], kappa, &exact, *time), *time)
            }
            None => exact,
        };
        for branch in Branch::ALL {
            let omega = found.branch(branch);
            // Seen from its own direction of travel the backward wave is a forward one.
            let seen = match branch {
                Branch::Forward => omega,
                Branch::Backward => -omega,
            };
            let error = phase_error(seen, kappa);
            let left = amplitude(omega, kappa, AmplitudeTime::Unit);
            let reason = if kappa == 0.0 {
                Some("a wave without end has no phase speed: no phase error at kappa = 0")
            } else if !(omega.re.is_finite() && omega.im.is_finite() && left.is_finite()) {
                Some("one step takes the whole wave away, or it grows beyond every number")
            } else {
                None
            };
            rows.push(Row {
                method: relation.method.name(),
                form: relation.form.map(Form::name),
                kernel: arguments.kernel.name(),
                ratio: to_text(ratio),
                alpha: relation.alpha(),
                kappa,
                branch: branch.name(),
                omega_re: finite(omega.re + 0.0),
                omega_im: finite(omega.im + 0.0),
                phase_error: finite(error),
                amplitude: finite(left),
                regime: found.regime_of(branch).name(),
                integrator: arguments.integrator.map(|integrator| integrator.name.as_str()),
                cfl: arguments.cfl.as_ref().map(to_f64),
                reason,
            });
        }
    }
    Ok(rows)
}

fn table(arguments: &Arguments, rows: &[Row]) -> Table {
    let stepped = match (arguments.integrator, &arguments.cfl) {
        (Some(integrator), Some(cfl)) => {
            format!(", stepped by {} with c Δt/h = {}", integrator.title, to_text(cfl))
        }
        _ => ", exact in time".into(),
    };
    let alpha = arguments.alpha.clone().unwrap_or_else(|| integer(1));
    let method = match arguments.method {
        MethodName::Sph => "SPH".into(),
        MethodName::SphAv => format!("SPH with viscosity, α = {}", to_text(&alpha)),
        MethodName::Gph => "GPH".to_owned(),
    };
    let caption = format!(
        "Waves of {method}, {}, {}{stepped}; κ in radians per spacing, ω in c/Δ, amplitude at t = Δ/c",
        arguments.kernel.title(),
        courant::analysis::kernel::Density::from(arguments.density).formula(),
    );
    let mut table = Table::new(
        caption,
        &[
            ("form", Align::Left),
            ("h/Δ", Align::Right),
            ("κ", Align::Right),
            ("branch", Align::Left),
            ("Re ω", Align::Right),
            ("Im ω", Align::Right),
            ("phase error", Align::Right),
            ("amplitude", Align::Right),
            ("regime", Align::Left),
        ],
    );
    let number = |value: Option<f64>| match (value, arguments.format) {
        (None, _) => "–".into(),
        (Some(value), Format::Csv) => value.to_string(),
        (Some(value), _) => significant(value, 7),
    };
    for row in rows {
        table.push([
            row.form.unwrap_or("–").to_owned(),
            row.ratio.clone(),
            number(Some(row.kappa)),
            row.branch.into(),
            number(row.omega_re),
            number(row.omega_im),
            number(row.phase_error),
            number(row.amplitude),
            row.regime.into(),
        ]);
    }
    table
}
