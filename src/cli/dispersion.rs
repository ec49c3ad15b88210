//! `courant dispersion`.

use super::columns::{self, number};
use super::numbers::{self, Names, Numbers};
use super::output::{Format, WIDTH, print, print_json, table_text};
use super::subject::{brief, density_name};
use super::waves::{self, Form, MethodName, Relation};
use super::{Failure, Outcome, names};
use clap::{Args, ValueEnum};
use courant::analysis::exact::rational::{Rational, to_f64, to_text};
use courant::analysis::kernel::{Density, Kernel};
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

#[derive(Debug, Args)]
pub struct Arguments {
    /// Methods: sph, sph-av, gph.
    #[arg(long, value_name = "NAMES", value_parser = |text: &str| numbers::names(text, waves::method))]
    method: Names<MethodName>,
    /// Kernels: see `courant list kernels`.
    #[arg(long, value_name = "NAMES", value_parser = |text: &str| numbers::names(text, names::kernel), default_value = "cubic-spline")]
    kernel: Names<Kernel>,
    /// Smoothing ratios h/Δ: 1.2 or 1,3/2 or 1:2:0.1, read exactly.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list)]
    ratio: Numbers,
    /// Wave numbers κΔ in radians per spacing, from 0 to 2π: 0.1:3.1:0.1 or pi/8:pi:pi/8. The shortest wave is π.
    #[arg(long, allow_hyphen_values = true, value_parser = kappa_list)]
    kappa: Numbers,
    /// Coefficients of viscosity of sph-av (default: 1).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::alphas)]
    alpha: Option<Numbers>,
    /// Relations of gph: resolved, which is what the scheme does, published, which is what was printed (default: both).
    #[arg(long, value_name = "NAMES", value_parser = forms)]
    form: Option<Names<Form>>,
    /// The waves as these integrators step them (default: exact in time); needs --cfl.
    #[arg(long, value_name = "NAMES", value_parser = |text: &str| numbers::names(text, waves::integrator), requires = "cfl")]
    integrator: Option<Names<&'static Integrator>>,
    /// Time steps c Δt/h of the integrator.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::courant_numbers, requires = "integrator")]
    cfl: Option<Numbers>,
    /// Densities ρ0 of the undisturbed lattice: summation, continuity.
    #[arg(long, value_name = "NAMES", value_parser = |text: &str| numbers::names(text, names::density), default_value = "summation")]
    density: Names<Density>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// Wave numbers in radians per spacing.
pub fn kappa_list(text: &str) -> Result<Numbers, String> {
    let numbers = numbers::angles(text)?;
    match numbers.0.iter().find(|k| k.is_negative() || to_f64(k) > 2.0 * std::f64::consts::PI) {
        Some(kappa) => {
            Err(format!("{} is out of range: from 0 to 2π radians per spacing", brief(kappa)))
        }
        None => Ok(numbers),
    }
}

/// Relations of gph; `both` is a list of them.
fn forms(text: &str) -> Result<Names<Form>, String> {
    match text {
        "both" => Ok(Names(vec![Form::Resolved, Form::Published])),
        _ => numbers::names(text, |name| {
            Form::from_str(name, true).map_err(|_| "accepted: resolved, published, both".into())
        }),
    }
}

/// What has one relation between wave number and frequency.
struct Case {
    relation: Relation,
    kernel: Kernel,
    ratio: Rational,
    density: Density,
    /// With its time step `c Δt/h`.
    stepped: Option<(&'static Integrator, Rational)>,
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
    density: &'static str,
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
    density: String,
    rows: Vec<Row>,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let cases = cases(arguments)?;
    let count = 2usize.saturating_mul(cases.len()).saturating_mul(arguments.kappa.0.len());
    if count > MAX_ROWS {
        return Err(Failure::Message(format!(
            "--ratio, --kappa: with the other lists the answer would have {count} rows; at most {MAX_ROWS} are accepted"
        )));
    }
    let rows: Result<Vec<Vec<Row>>, Failure> =
        cases.par_iter().map(|case| waves_of(case, &arguments.kappa)).collect();
    let rows: Vec<Row> = rows?.into_iter().flatten().collect();
    match arguments.format {
        Format::Json => {
            let units = "kappa in radians per spacing Δ, omega in c/Δ, amplitude at t = Δ/c";
            let density = formulas(&cases).join("; ");
            print_json("dispersion", &Rows { units, density, rows })
        }
        Format::Csv => print(&csv_table(&rows).to_csv()),
        format => print(&tables(arguments, &cases, &rows, format)),
    }
}

/// Every combination of the lists.
fn cases(arguments: &Arguments) -> Result<Vec<Case>, Failure> {
    let steps: Vec<Option<(&'static Integrator, Rational)>> =
        match (&arguments.integrator, &arguments.cfl) {
            (Some(integrators), Some(cfl)) => integrators
                .0
                .iter()
                .flat_map(|one| cfl.0.iter().map(|step| Some((*one, step.clone()))))
                .collect(),
            _ => vec![None],
        };
    let relations = relations(arguments)?;
    let mut cases = Vec::new();
    for relation in &relations {
        for &kernel in &arguments.kernel.0 {
            for &density in &arguments.density.0 {
                for stepped in &steps {
                    cases.extend(arguments.ratio.0.iter().map(|ratio| Case {
                        relation: relation.clone(),
                        kernel,
                        ratio: ratio.clone(),
                        density,
                        stepped: stepped.clone(),
                    }));
                }
            }
        }
    }
    Ok(cases)
}

/// The methods with the forms and viscosities that they have; what none of them has is refused.
fn relations(arguments: &Arguments) -> Result<Vec<Relation>, Failure> {
    let methods = &arguments.method.0;
    let both = [Form::Resolved, Form::Published];
    let mut relations = Vec::new();
    for &method in methods {
        let takes_form = method == MethodName::Gph || !methods.contains(&MethodName::Gph);
        let takes_alpha = method == MethodName::SphAv || !methods.contains(&MethodName::SphAv);
        let given = arguments.form.as_ref().filter(|_| takes_form);
        let forms: Vec<Option<Form>> = match given {
            Some(forms) => forms.0.iter().copied().map(Some).collect(),
            None if method == MethodName::Gph => both.map(Some).to_vec(),
            None => vec![None],
        };
        let alphas: Vec<Option<&Rational>> = match &arguments.alpha {
            Some(alphas) if takes_alpha => alphas.0.iter().map(Some).collect(),
            _ => vec![None],
        };
        for form in forms {
            for alpha in &alphas {
                relations.push(method.method(form, *alpha)?);
            }
        }
    }
    Ok(relations)
}

/// The densities of the cases.
fn formulas(cases: &[Case]) -> Vec<&'static str> {
    distinct(cases.iter().map(|case| case.density.formula()))
}

/// What there is, each once.
fn distinct<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut seen = Vec::new();
    for one in all {
        if !seen.contains(&one) {
            seen.push(one);
        }
    }
    seen
}

fn waves_of(case: &Case, kappas: &Numbers) -> Result<Vec<Row>, Failure> {
    let Case { relation, kernel, ratio, density, stepped } = case;
    let lattice = relation.lattice(*kernel, ratio, *density)?;
    let exact: Box<dyn Fn(f64) -> Frequencies> = if relation.is_published() {
        let waves = PublishedWaves::of(&lattice)
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
        Box::new(move |kappa| waves.frequencies(kappa))
    } else {
        let waves = lattice.waves()?.compile();
        Box::new(move |kappa| waves.mode(kappa).frequencies())
    };
    let compiled = match stepped {
        Some((integrator, cfl)) => {
            Some((lattice.step(integrator)?.compile()?, to_f64(cfl), to_f64(&(cfl * ratio))))
        }
        None => None,
    };
    let mut rows = Vec::new();
    for kappa in kappas.0.iter().map(to_f64) {
        let exact = exact(kappa);
        let found = match &compiled {
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
                kernel: kernel.name(),
                ratio: to_text(ratio),
                alpha: relation.alpha(),
                kappa,
                branch: branch.name(),
                omega_re: finite(omega.re + 0.0),
                omega_im: finite(omega.im + 0.0),
                phase_error: finite(error),
                amplitude: finite(left),
                regime: found.regime_of(branch).name(),
                density: density_name(*density),
                integrator: stepped.as_ref().map(|(integrator, _)| integrator.name.as_str()),
                cfl: stepped.as_ref().map(|(_, cfl)| to_f64(cfl)),
                reason,
            });
        }
    }
    Ok(rows)
}

/// A row a wave for machines: the names are those of the JSON.
fn csv_table(rows: &[Row]) -> Table {
    let columns = [
        "method",
        "form",
        "integrator",
        "kernel",
        "ratio",
        "alpha",
        "density",
        "cfl",
        "kappa",
        "branch",
        "omega_re",
        "omega_im",
        "phase_error",
        "amplitude",
        "regime",
        "reason",
    ];
    let mut table = columns::empty(&columns.map(String::from));
    for row in rows {
        table.push([
            row.method.to_string(),
            row.form.unwrap_or_default().into(),
            row.integrator.unwrap_or_default().into(),
            row.kernel.into(),
            row.ratio.clone(),
            number(row.alpha),
            row.density.into(),
            number(row.cfl),
            row.kappa.to_string(),
            row.branch.into(),
            number(row.omega_re),
            number(row.omega_im),
            number(row.phase_error),
            number(row.amplitude),
            row.regime.into(),
            row.reason.unwrap_or_default().into(),
        ]);
    }
    table
}

/// One table, or where it does not fit one for every list but that of the ratios.
fn tables(arguments: &Arguments, cases: &[Case], rows: &[Row], format: Format) -> String {
    let shown = |table: &Table| table_text(table, format).unwrap_or_default();
    let whole = table(cases, rows);
    if format != Format::Table || whole.width() <= WIDTH {
        return shown(&whole);
    }
    let ratios = arguments.ratio.0.len();
    let groups = cases.chunks(ratios).zip(rows.chunks(rows.len() / cases.len() * ratios));
    groups.map(|(cases, rows)| shown(&table(cases, rows))).collect::<Vec<_>>().join("\n")
}

/// A row a wave for people: what all waves share is in the caption.
fn table(cases: &[Case], rows: &[Row]) -> Table {
    let titles = distinct(cases.iter().map(|case| match case.relation.method {
        MethodName::Gph => "GPH".into(),
        _ => case.relation.title(),
    }));
    let kernels = distinct(cases.iter().map(|case| case.kernel.title()));
    let steps = distinct(cases.iter().map(|case| match &case.stepped {
        Some((integrator, cfl)) => {
            format!("stepped by {} with c Δt/h = {}", integrator.title, to_text(cfl))
        }
        None => "exact in time".into(),
    }));
    let densities = formulas(cases);
    let one = |all: &[String], otherwise: &str| match all {
        [one] => one.clone(),
        _ => otherwise.into(),
    };
    let texts = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
    let shared = [
        one(&titles, "particle methods"),
        one(&texts(&kernels), ""),
        one(&texts(&densities), ""),
        one(&steps, ""),
    ]
    .into_iter()
    .filter(|text| !text.is_empty());
    let caption = format!(
        "Waves of {}; κ in radians per spacing, ω in c/Δ, amplitude at t = Δ/c",
        shared.collect::<Vec<_>>().join(", ")
    );
    let dash = |text: Option<&str>| text.unwrap_or("–").to_string();
    let digits =
        |value: Option<f64>| value.map_or_else(|| "–".to_string(), |value| significant(value, 7));
    type Cell<'a> = &'a dyn Fn(&Row) -> String;
    let columns: [(&str, Align, bool, Cell<'_>); 14] = [
        ("method", Align::Left, titles.len() > 1, &|row| row.method.into()),
        ("form", Align::Left, rows.iter().any(|row| row.form.is_some()), &|row| dash(row.form)),
        (
            "α",
            Align::Right,
            titles.len() > 1 && rows.iter().any(|row| row.alpha.is_some()),
            &|row| digits(row.alpha),
        ),
        ("kernel", Align::Left, kernels.len() > 1, &|row| row.kernel.into()),
        ("density", Align::Left, densities.len() > 1, &|row| row.density.into()),
        ("integrator", Align::Left, steps.len() > 1, &|row| dash(row.integrator)),
        ("c Δt/h", Align::Right, steps.len() > 1, &|row| digits(row.cfl)),
        ("h/Δ", Align::Right, true, &|row| row.ratio.clone()),
        ("κ", Align::Right, true, &|row| digits(Some(row.kappa))),
        ("branch", Align::Left, true, &|row| row.branch.into()),
        ("Re ω", Align::Right, true, &|row| digits(row.omega_re)),
        ("Im ω", Align::Right, true, &|row| digits(row.omega_im)),
        ("phase error", Align::Right, true, &|row| digits(row.phase_error)),
        ("amplitude", Align::Right, true, &|row| digits(row.amplitude)),
    ];
    let shown: Vec<_> = columns.iter().filter(|(_, _, when, _)| *when).collect();
    let mut heads: Vec<(&str, Align)> =
        shown.iter().map(|(name, align, ..)| (*name, *align)).collect();
    heads.push(("regime", Align::Left));
    let mut table = Table::new(caption, &heads);
    for row in rows {
        let cells = shown.iter().map(|(.., cell)| cell(row));
        table.push(cells.chain([row.regime.to_string()]));
    }
    table
}
