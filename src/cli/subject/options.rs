//! The options that name what is judged, and every combination of their lists.

use super::{EquationOfState, Kind, PRESSURE, Subject, option};
use crate::cli::numbers::{self, Names, Numbers};
use crate::cli::waves::Form;
use crate::cli::{Failure, names};
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::{Density, Kernel};
use courant::analysis::scheme::Integrator;
use courant::analysis::scheme::catalogue::{self, SchemeFile};
use courant::analysis::spelling::spells;
use std::str::FromStr;
use std::sync::Arc;

/// Combinations of one answer at most.
const MAX_SUBJECTS: usize = 1_000_000;

/// `--equation`, `--scheme`, `--space` with `--integrator`, or `--method` with `--integrator`; lists everywhere.
#[derive(Debug, Clone, Args)]
#[group(skip)]
#[command(group(clap::ArgGroup::new("subject").args(["equation", "scheme", "space", "method"])))]
pub struct SubjectOptions {
    /// Equations of a scheme, such as 'u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])', separated by `;`.
    #[arg(long, value_name = "TEXT", help_heading = "Subject")]
    equation: Vec<String>,
    /// Schemes: upwind, leapfrog, crank-nicolson, euler-sph, lax-wendroff-sph, godunov-sph, … (courant list schemes), or
    /// FILE.toml.
    #[arg(long, value_name = "NAMES|FILE.toml", help_heading = "Subject")]
    scheme: Option<String>,
    /// Spaces for the method of lines: upwind-3, central-4, … (courant list spaces), a FILE.toml, or 'u[j]' = …'; needs
    /// --integrator.
    #[arg(long, value_name = "NAMES|TEXT", help_heading = "Subject")]
    space: Option<String>,
    /// Particle methods: sph, sph-av, gph; limits are on c Δt/h. Needs --integrator.
    #[arg(long, value_name = "NAMES", help_heading = "Subject")]
    method: Option<String>,
    /// Time integrators: rk4, leapfrog, … (courant list integrators), or FILE.toml.
    #[arg(long, value_name = "NAMES|FILE.toml", help_heading = "Subject")]
    integrator: Option<String>,
    /// Kernels of schemes with kernel sums: see `courant list kernels` (default: cubic-spline).
    #[arg(long, value_parser = |text: &str| numbers::names(text, names::kernel), help_heading = "Subject")]
    kernel: Option<Names<Kernel>>,
    /// Smoothing ratios l/Δξ = h/Δ: 1,2,3 or 1:10:0.5 or 3/2, read exactly.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio_list, help_heading = "Subject")]
    ratio: Option<Numbers>,
    /// Coefficients of viscosity, for schemes with a parameter alpha (sph-av: 1).
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::alphas, help_heading = "Subject")]
    alpha: Option<Numbers>,
    /// Equations of state of a particle method: isothermal, ideal:GAMMA or tait:P0, with P0 in units of ρ c² (default:
    /// isothermal).
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| numbers::names(text, EquationOfState::from_str), help_heading = "Subject")]
    eos: Option<Names<EquationOfState>>,
    /// Densities of a particle method: summation or continuity, which is the mass per spacing (default: summation).
    #[arg(long, value_parser = |text: &str| numbers::names(text, names::density), help_heading = "Subject")]
    density: Option<Names<Density>>,
    /// Space dimensions of a particle method: 1.
    #[arg(long, value_parser = one_dimension, help_heading = "Subject")]
    dimension: Option<usize>,
    /// Relation of gph: resolved; `published` is no scheme that runs, and only `validate` (and `dispersion`) take it.
    #[arg(long, value_enum, help_heading = "Subject")]
    form: Option<Form>,
    /// Values of a parameter, for each parameter once: r=1/4 or r=0:1:0.1.
    #[arg(long, value_name = "NAME=VALUES", allow_hyphen_values = true, value_parser = setting, help_heading = "Subject")]
    set: Vec<(String, Numbers)>,
    /// The parameter whose limit is sought (default: the file's, C, or the only one without a value).
    #[arg(long, value_name = "NAME", help_heading = "Subject")]
    parameter: Option<String>,
}

/// What a command takes where nothing is said.
#[derive(Debug, Clone, Default)]
pub struct Defaults {
    /// The kernels; nothing is the cubic spline.
    pub kernels: Vec<Kernel>,
    /// The ratios; nothing must be said.
    pub ratios: Vec<Rational>,
    /// The schemes, where no subject is named.
    pub schemes: Option<String>,
    /// The integrators.
    pub integrators: Option<String>,
    /// Whether the relation printed for gph is accepted.
    pub published: bool,
    /// Whether equations in space may stand without an integrator: exact in time.
    pub exact_in_time: bool,
}

fn refuse(message: impl Into<String>) -> Failure {
    Failure::Message(message.into())
}

/// `NAME=VALUES`.
pub fn setting(text: &str) -> Result<(String, Numbers), String> {
    let (name, values) =
        text.split_once('=').ok_or("write NAME=VALUES, for example r=1/4 or r=0:1:0.1")?;
    let name = name.trim();
    let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
    if !first || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Err(format!("`{name}` is no name of a parameter; write NAME=VALUES"));
    }
    Ok((name.into(), numbers::list(values)?))
}

fn one_dimension(text: &str) -> Result<usize, String> {
    if text == "1" { Ok(1) } else { Err("only waves along a line are decided; accepted: 1".into()) }
}

impl SubjectOptions {
    /// The relation of gph that was named.
    pub fn form(&self) -> Option<Form> {
        self.form
    }

    /// Whether any of them was given.
    pub fn is_named(&self) -> bool {
        !self.equation.is_empty()
            || self.scheme.is_some()
            || self.space.is_some()
            || self.method.is_some()
    }

    /// The lists that are axes of maps: ratios, coefficients of viscosity.
    pub fn axes(&self) -> (Option<&Numbers>, Option<&Numbers>) {
        (self.ratio.as_ref(), self.alpha.as_ref())
    }

    /// The same options without those lists.
    pub fn without_axes(&self) -> Self {
        Self { ratio: None, alpha: None, ..self.clone() }
    }

    /// Whether an integrator was named.
    pub fn has_integrator(&self) -> bool {
        self.integrator.is_some()
    }

    /// Whether it is a particle method.
    pub fn is_method(&self) -> bool {
        self.method.is_some()
    }

    /// Every combination of the lists.
    pub fn subjects(&self, defaults: &Defaults) -> Result<Vec<Subject>, Failure> {
        let (kind, files) = self.files(defaults)?;
        let method = kind == Kind::Method;
        self.refuse_foreign(kind, &files, defaults.published)?;
        let integrators = self.integrators(method, defaults)?;
        let nothing = || vec![None];
        let listed =
            |list: Option<Vec<_>>| list.map_or_else(nothing, |l| l.into_iter().map(Some).collect());
        let states = match (&self.eos, method) {
            (_, false) => vec![None],
            (Some(names), true) => names.0.iter().cloned().map(Some).collect(),
            (None, true) => vec!["isothermal".parse().ok()],
        };
        let densities = match (&self.density, method) {
            (_, false) => vec![None],
            (Some(names), true) => names.0.iter().copied().map(Some).collect(),
            (None, true) => vec![Some(Density::Summation)],
        };
        let settings = self.settings()?;
        let kernels: Vec<Kernel> = match &self.kernel {
            Some(names) => names.0.clone(),
            None if defaults.kernels.is_empty() => vec![Kernel::CubicSpline],
            None => defaults.kernels.clone(),
        };
        let ratios = self.ratio.as_ref().map_or(&defaults.ratios, |numbers| &numbers.0);
        let integrators = listed(integrators);
        let mut subjects = Vec::new();
        for file in &files {
            let lattices: Vec<Option<(Kernel, Rational)>> = if file.needs_kernel() {
                if ratios.is_empty() {
                    return Err(refuse(format!(
                        "--ratio is required: {} has a kernel; write --ratio 2 or --ratio 1:10:0.5",
                        file.name
                    )));
                }
                let pairs = kernels
                    .iter()
                    .flat_map(|kernel| ratios.iter().map(move |r| (*kernel, r.clone())));
                pairs.map(Some).collect()
            } else {
                vec![None]
            };
            let completed = if file.is_of_lines() {
                if integrators == [None] && !defaults.exact_in_time {
                    return Err(refuse(format!(
                        "--integrator is required: {} gives rates of change only; see courant list integrators",
                        file.name
                    )));
                }
                integrators.clone()
            } else {
                vec![None]
            };
            let count =
                completed.len() * states.len() * densities.len() * settings.len() * lattices.len();
            if subjects.len() + count > MAX_SUBJECTS {
                return Err(refuse(format!(
                    "the lists have more than {MAX_SUBJECTS} combinations; make them shorter"
                )));
            }
            for integrator in &completed {
                for eos in &states {
                    for density in &densities {
                        for values in &settings {
                            for kernel in &lattices {
                                let pressure =
                                    eos.iter().map(|eos| (PRESSURE.into(), eos.pressure.clone()));
                                subjects.push(Subject {
                                    kind,
                                    file: file.clone(),
                                    integrator: integrator.clone(),
                                    eos: eos.clone(),
                                    density: *density,
                                    kernel: kernel.clone(),
                                    values: values.iter().cloned().chain(pressure).collect(),
                                    parameter: self.parameter.clone(),
                                });
                            }
                        }
                    }
                }
            }
        }
        Ok(subjects)
    }

    /// What `--equation`, `--scheme`, `--space` or `--method` name.
    fn files(&self, defaults: &Defaults) -> Result<(Kind, Vec<Arc<SchemeFile>>), Failure> {
        let of_catalogue = |kind: Kind, list: &str| {
            let all = match kind {
                Kind::Scheme => catalogue::schemes(),
                Kind::Space => catalogue::spaces(),
                _ => catalogue::methods(),
            };
            numbers::names(list, |name| scheme_file(kind, name, all))
                .map(|files| (kind, files.0))
                .map_err(|problem| refuse(format!("{} {list}: {problem}", option(kind))))
        };
        match (&self.scheme, &self.space, &self.method) {
            (Some(list), ..) => of_catalogue(Kind::Scheme, list),
            (_, Some(text), _) if text.contains('[') => {
                Ok((Kind::Space, vec![typed(Kind::Space, text)?]))
            }
            (_, Some(list), _) => of_catalogue(Kind::Space, list),
            (.., Some(list)) => of_catalogue(Kind::Method, list),
            _ if self.equation.is_empty() && defaults.schemes.is_some() => {
                of_catalogue(Kind::Scheme, defaults.schemes.as_deref().unwrap_or_default())
            }
            _ if self.equation.is_empty() => Err(refuse(
                "one of --equation, --scheme, --space and --method is required; see --help",
            )),
            _ => {
                let typed = self.equation.iter().map(|text| typed(Kind::Equation, text));
                Ok((Kind::Equation, typed.collect::<Result<_, _>>()?))
            }
        }
    }

    /// Complains about options that none of the files has a use for.
    fn refuse_foreign(
        &self,
        kind: Kind,
        files: &[Arc<SchemeFile>],
        published: bool,
    ) -> Result<(), Failure> {
        let method = kind == Kind::Method;
        let kernel = files.iter().any(|file| file.needs_kernel());
        let lines = files.iter().any(|file| file.is_of_lines());
        let names = files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>().join(", ");
        let foreign = [
            (
                "--eos",
                self.eos.is_some() && !method,
                "only a particle method (--method) has an equation of state",
            ),
            (
                "--density",
                self.density.is_some() && !method,
                "only a particle method (--method) has a density",
            ),
            (
                "--dimension",
                self.dimension.is_some() && !method,
                "equations say by themselves how many there are",
            ),
            ("--form", self.form.is_some() && names != "gph", "only gph takes it"),
            (
                "--form published",
                self.form == Some(Form::Published) && !published,
                "the printed relation is no scheme that runs; accepted: resolved",
            ),
            (
                "--kernel",
                self.kernel.is_some() && !kernel,
                "there are no kernel sums in these equations",
            ),
            (
                "--ratio",
                self.ratio.is_some() && !kernel,
                "there are no kernel sums in these equations",
            ),
            (
                "--integrator",
                self.integrator.is_some() && !lines,
                "these equations step by themselves",
            ),
        ];
        match foreign.iter().find(|(_, given, _)| *given) {
            Some((option, _, why)) => Err(refuse(format!("{option}: {names}: {why}"))),
            None => Ok(()),
        }
    }

    fn integrators(
        &self,
        particles: bool,
        defaults: &Defaults,
    ) -> Result<Option<Vec<Arc<Integrator>>>, Failure> {
        let Some(list) = self.integrator.as_ref().or(defaults.integrators.as_ref()) else {
            return Ok(None);
        };
        numbers::names(list, |name| names::integrator(name, particles))
            .map(|found| Some(found.0))
            .map_err(|problem| refuse(format!("--integrator {list}: {problem}")))
    }

    /// Every combination of the values that were set.
    fn settings(&self) -> Result<Vec<Vec<(String, Rational)>>, Failure> {
        let alpha = self.alpha.iter().map(|values| ("alpha".to_string(), values.clone()));
        let mut combinations: Vec<Vec<(String, Rational)>> = vec![Vec::new()];
        let mut known: Vec<String> = Vec::new();
        for (name, values) in alpha.chain(self.set.iter().cloned()) {
            if known.contains(&name) {
                return Err(refuse(format!("--set {name}: it is given twice; write a list")));
            }
            if name == PRESSURE && self.method.is_some() {
                return Err(refuse(format!(
                    "--set {name}: the equation of state sets it; use --eos"
                )));
            }
            if combinations.len().saturating_mul(values.0.len()) > MAX_SUBJECTS {
                return Err(refuse(format!(
                    "--set {name}: the lists have more than {MAX_SUBJECTS} combinations; make them shorter"
                )));
            }
            let with = |value: &Rational| {
                let (name, value) = (name.clone(), value.clone());
                move |mut set: Vec<(String, Rational)>| {
                    set.push((name.clone(), value.clone()));
                    set
                }
            };
            combinations = combinations
                .into_iter()
                .flat_map(|set| {
                    values.0.iter().map(move |value| with(value)(set.clone())).collect::<Vec<_>>()
                })
                .collect();
            known.push(name);
        }
        Ok(combinations)
    }
}

/// A file of one's own, or one of the catalogue.
fn scheme_file(kind: Kind, name: &str, all: &[SchemeFile]) -> Result<Arc<SchemeFile>, String> {
    if name.ends_with(".toml") {
        let text = std::fs::read_to_string(name).map_err(|error| names::unreadable(&error))?;
        return SchemeFile::from_toml(&text)
            .map(Arc::new)
            .map_err(|error| names::misspelt_key(&error.to_string()));
    }
    let found = all.iter().find(|file| spells(name, &file.name));
    found.map(|file| Arc::new(file.clone())).ok_or_else(|| {
        let (what, topic) = match kind {
            Kind::Space => ("space", "spaces"),
            Kind::Method => ("method", "methods"),
            _ => ("scheme", "schemes"),
        };
        let entries = all.iter().map(|file| (file.name.as_str(), file.name.as_str()));
        if let Some(elsewhere) = names::elsewhere(name, Some(kind)) {
            return format!("{elsewhere}; see courant list {topic}");
        }
        names::unknown_among(what, name, entries, topic)
    })
}

/// Equations from the command line.
fn typed(kind: Kind, text: &str) -> Result<Arc<SchemeFile>, Failure> {
    let file =
        SchemeFile::typed(text).map_err(|error| refuse(format!("{}: {error}", option(kind))));
    file.map(Arc::new)
}
