//! What is judged.

use crate::error::{bad, of_file, of_scheme, of_subject, of_text};
use crate::exact::number;
use courant_analysis::exact::rational::{Rational, to_text};
use courant_analysis::kernel::{Density, Kernel};
use courant_analysis::scheme::Integrator;
use courant_analysis::scheme::catalogue::{self, SchemeFile};
use courant_analysis::stability::SearchPlan;
use courant_reports::subject::{Kind, PRESSURE, Sought, Subject};
use pyo3::prelude::*;
use std::sync::Arc;

/// A subject with everything that completes it.
#[pyclass(frozen, name = "Subject", module = "courant_stability._native")]
pub struct NativeSubject(pub Subject);

/// A file of the catalogue, a file's text, or equations: a text with a line `name = …` is a file, one with `[` equations.
fn file(kind: Kind, source: &str) -> PyResult<SchemeFile> {
    let is_file = |line: &str| line.split_once('=').is_some_and(|(key, _)| key.trim() == "name");
    if source.lines().any(is_file) {
        return SchemeFile::from_toml(source).map_err(|error| of_file(&error));
    }
    if kind == Kind::Equation || source.contains('[') {
        return SchemeFile::typed(source).map_err(|error| of_text(&error));
    }
    let found = match kind {
        Kind::Space => catalogue::space(source),
        Kind::Method => catalogue::method(source),
        _ => catalogue::scheme(source),
    };
    found.cloned().ok_or_else(|| bad(format!("there is no {} `{source}`", kind.name())))
}

fn integrator(text: &str, particles: bool) -> PyResult<Integrator> {
    if text.contains('=') {
        return Integrator::from_toml(text).map_err(bad);
    }
    let find = if particles { Integrator::for_particles } else { Integrator::named };
    find(text).cloned().ok_or_else(|| bad(format!("there is no integrator `{text}`")))
}

#[pymethods]
impl NativeSubject {
    #[new]
    #[pyo3(signature = (kind, source, integrator, kernel, ratio, density, eos, values, parameter))]
    #[expect(clippy::too_many_arguments, reason = "they are Python's keyword arguments")]
    fn new(
        kind: &str,
        source: &str,
        integrator: Option<&str>,
        kernel: Option<&str>,
        ratio: Option<&str>,
        density: Option<&str>,
        eos: Option<&str>,
        values: Vec<(String, String)>,
        parameter: Option<String>,
    ) -> PyResult<Self> {
        let kind = [Kind::Equation, Kind::Scheme, Kind::Space, Kind::Method]
            .into_iter()
            .find(|one| one.name() == kind)
            .ok_or_else(|| bad(format!("there is no kind `{kind}`")))?;
        let file = file(kind, source)?;
        let is_method = kind == Kind::Method;
        let name = &file.name;
        let integrator = match (integrator, file.is_of_lines()) {
            (Some(text), true) => Some(Arc::new(self::integrator(text, is_method)?)),
            (None, true) => {
                return Err(bad(format!(
                    "{name} gives rates of change only: it needs an integrator"
                )));
            }
            (Some(_), false) => {
                return Err(bad(format!("{name} steps by itself: it takes no integrator")));
            }
            (None, false) => None,
        };
        let kernel = match (kernel, ratio, file.needs_kernel()) {
            (None, None, false) => None,
            (_, _, false) => {
                return Err(bad(format!(
                    "{name} has no kernel sums: it takes no kernel and no ratio"
                )));
            }
            (_, None, true) => return Err(bad(format!("{name} has a kernel: it needs a ratio"))),
            (kernel, Some(ratio), true) => {
                let kernel: Kernel = kernel.unwrap_or("cubic-spline").parse().map_err(bad)?;
                Some((kernel, number("ratio", ratio)?))
            }
        };
        if !is_method && (eos.is_some() || density.is_some()) {
            return Err(bad(format!("{name}: only a particle method has an eos and a density")));
        }
        let eos = is_method.then(|| eos.unwrap_or("isothermal").parse()).transpose();
        let eos = eos.map_err(|error: String| bad(format!("eos: {error}")))?;
        let density = is_method.then(|| density.map_or(Ok(Density::default()), str::parse));
        let density = density.transpose().map_err(|error| bad(format!("density: {error}")))?;
        let mut set: Vec<(String, Rational)> = Vec::new();
        for (name, text) in values {
            set.push((name.clone(), number(&name, &text)?));
        }
        let pressure = |eos: &courant_reports::subject::EquationOfState| {
            (PRESSURE.to_string(), eos.pressure.clone())
        };
        set.extend(eos.as_ref().map(pressure));
        let file = Arc::new(file);
        let subject =
            Subject { kind, file, integrator, eos, density, kernel, values: set, parameter };
        subject.with_values().map_err(|error| of_subject(&error))?;
        Ok(Self(subject))
    }

    /// Its name: of the catalogue, or the equations.
    #[getter]
    fn name(&self) -> &str {
        &self.0.file.name
    }

    /// Its title, with everything that completes it.
    #[getter]
    fn title(&self) -> String {
        let labels = self.0.labels();
        labels.iter().map(|label| label.caption.clone()).collect::<Vec<_>>().join(", ")
    }

    /// Its equations.
    #[getter]
    fn equations(&self) -> &str {
        self.0.file.equations.text.trim()
    }

    /// Where it comes from.
    #[getter]
    fn source(&self) -> &str {
        &self.0.file.source
    }

    /// The number of space dimensions.
    #[getter]
    fn dimension(&self) -> PyResult<usize> {
        Ok(self.0.open_step().map_err(|error| of_subject(&error))?.dimension())
    }

    /// The unknowns.
    #[getter]
    fn unknowns(&self) -> PyResult<Vec<String>> {
        Ok(self.0.open_step().map_err(|error| of_subject(&error))?.unknowns().to_vec())
    }

    /// All parameters, each with its value, or its default, or nothing.
    #[getter]
    fn parameters(&self) -> PyResult<Vec<(String, Option<String>)>> {
        let open = self.0.open_step().map_err(|error| of_subject(&error))?;
        let value = |name: &str| {
            let set = self.0.values.iter().find(|(known, _)| known == name);
            let value = set.map(|(_, value)| value).or_else(|| self.0.file.parameters.get(name));
            (name.to_string(), value.map(to_text))
        };
        Ok(open.names().parameters().map(|(name, _)| value(name)).collect())
    }

    /// The parameter in question.
    #[getter]
    fn parameter(&self) -> PyResult<String> {
        Ok(self.sought(true)?.parameter)
    }

    /// What it is called before people.
    #[getter]
    fn symbol(&self) -> PyResult<String> {
        Ok(self.0.symbol(&self.parameter()?))
    }
}

impl NativeSubject {
    pub fn sought(&self, may_be_set: bool) -> PyResult<Sought> {
        self.0.sought(may_be_set).map_err(|error| of_subject(&error))
    }

    pub fn failed(&self, error: courant_analysis::scheme::SchemeError) -> PyErr {
        match &error {
            courant_analysis::scheme::SchemeError::Text(_) => of_scheme(&error),
            _ => of_subject(&self.0.failure(error)),
        }
    }

    /// How far and how hard to look.
    pub fn plan(
        &self,
        max: Option<&str>,
        growth: Option<&str>,
        budget: Option<usize>,
    ) -> PyResult<SearchPlan> {
        let max = max.map(|text| number("max", text)).transpose()?;
        let plan = SearchPlan::default().up_to(self.0.range(max.as_ref()));
        let growth = growth.map(|text| number("growth", text)).transpose()?.unwrap_or_default();
        Ok(SearchPlan { budget: budget.unwrap_or(plan.budget), ..plan }.growing(growth))
    }
}
