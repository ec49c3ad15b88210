//! What one step does to waves, over arrays of phases and of values of parameters.

use crate::broadcast::Broadcast;
use crate::error::{bad, of_subject, of_sweep};
use crate::exact::decimal;
use crate::subject::NativeSubject;
use crate::watch::watched;
use courant_analysis::scheme::SchemeError;
use courant_analysis::waves::CompiledStep;
use courant_analysis::waves::branches::Branches;
use courant_analysis::waves::exact_wave::ExactWave;
use courant_reports::subject::SubjectError;
use num_complex::Complex64;
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::BTreeMap;

type Floats<'py> = PyReadonlyArrayDyn<'py, f64>;

/// A step with some parameters open, and where each of its own is among the arrays.
struct Compiled {
    step: CompiledStep,
    places: Vec<usize>,
}

impl Compiled {
    /// For arrays of values of these parameters, followed by those of phases.
    fn new(subject: &NativeSubject, names: &[String], arrays: &[Floats<'_>]) -> PyResult<Self> {
        let but: Vec<&str> = names.iter().map(String::as_str).collect();
        let step = subject.0.opened(&but).map_err(|error| of_subject(&error))?;
        let known = step.names().parameters().map(|(name, _)| name.to_string());
        let known: Vec<String> = known.collect();
        if let Some(name) = names.iter().find(|name| !known.contains(name)) {
            let name = name.clone();
            return Err(of_subject(&SubjectError::UnknownParameter { name, known }));
        }
        let (dimension, phases) = (step.dimension(), arrays.len() - names.len());
        if dimension != phases {
            return Err(bad(format!(
                "{phases} phases for {dimension} space dimensions: one for each axis"
            )));
        }
        let step = step.compile().map_err(|error| subject.failed(error))?;
        let place = |name: &String| names.iter().position(|known| known == name);
        let missing = |name: &String| of_subject(&SubjectError::NotSet(vec![name.clone()]));
        let places = step.parameters().iter().map(|name| place(name).ok_or_else(|| missing(name)));
        Ok(Self { places: places.collect::<PyResult<_>>()?, step })
    }

    /// The multipliers at a point whose values are followed by its phases.
    fn multipliers(&self, point: &[f64]) -> impl Iterator<Item = Complex64> {
        let values: Vec<f64> = self.places.iter().map(|&place| point[place]).collect();
        let phases = &point[point.len() - self.step.dimension()..];
        self.step.differences(&values, phases).into_iter().map(|difference| difference + 1.0)
    }

    /// What `of` makes of the multipliers at all points.
    fn at_all<T: Send>(
        &self,
        py: Python<'_>,
        points: &Broadcast<'_>,
        of: impl Fn(&mut dyn Iterator<Item = Complex64>) -> T + Sync + Send,
    ) -> PyResult<Vec<T>> {
        let at = |point| {
            let mut values = vec![0.0; points.arrays()];
            points.at(point, &mut values);
            of(&mut self.multipliers(&values))
        };
        watched(py, None, |watch| watch.over((0..points.len()).into_par_iter(), at))?
            .map_err(|error| of_sweep(&error))
    }
}

fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    PyArray1::from_vec(py, values).reshape(shape)
}

/// The multipliers of waves, along a last axis.
#[pyfunction]
pub fn multipliers<'py>(
    py: Python<'py>,
    subject: &NativeSubject,
    names: Vec<String>,
    arrays: Vec<Floats<'py>>,
) -> PyResult<Bound<'py, PyArrayDyn<Complex64>>> {
    let compiled = Compiled::new(subject, &names, &arrays)?;
    let points = Broadcast::new(&arrays)?;
    let found = compiled.at_all(py, &points, |all| all.collect::<Vec<_>>())?;
    shaped(py, found.concat(), &[&points.shape[..], &[compiled.step.degree()]].concat())
}

/// The largest modulus among the multipliers of waves.
#[pyfunction]
pub fn gain<'py>(
    py: Python<'py>,
    subject: &NativeSubject,
    names: Vec<String>,
    arrays: Vec<Floats<'py>>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let compiled = Compiled::new(subject, &names, &arrays)?;
    let points = Broadcast::new(&arrays)?;
    let found = compiled.at_all(py, &points, |all| all.map(Complex64::norm).fold(0.0, f64::max))?;
    shaped(py, found, &points.shape)
}

/// A ray of waves of one step: the values of parameters and the direction, by their bits.
type Ray = Vec<u64>;

type Speeds<'py> = (Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<f64>>);

/// Phase speed and group speed of the physical branch over those of the equation; not a number where there is none.
#[pyfunction]
pub fn speeds<'py>(
    py: Python<'py>,
    subject: &NativeSubject,
    names: Vec<String>,
    arrays: Vec<Floats<'py>>,
) -> PyResult<Speeds<'py>> {
    Compiled::new(subject, &names, &arrays)?;
    let points = Broadcast::new(&arrays)?;
    let (mut rays, mut point) =
        (BTreeMap::<Ray, Vec<(f64, usize)>>::new(), vec![0.0; arrays.len()]);
    for place in 0..points.len() {
        points.at(place, &mut point);
        let (_, phases) = point.split_at_mut(names.len());
        let modulus = phases.iter().map(|phase| phase * phase).sum::<f64>().sqrt();
        if modulus > 0.0 && modulus.is_finite() {
            phases.iter_mut().for_each(|phase| *phase /= modulus);
            let bits = point.iter().map(|value| value.to_bits()).collect();
            rays.entry(bits).or_default().push((modulus, place));
        }
    }
    let along = |(ray, waves): (Ray, Vec<(f64, usize)>)| {
        let values: Vec<f64> = ray.into_iter().map(f64::from_bits).collect();
        let (values, direction) = values.split_at(names.len());
        speeds_along(subject, &names, values, direction, waves)
    };
    let rays: Vec<_> = rays.into_iter().collect();
    let found = watched(py, None, |watch| watch.over(rays.into_par_iter(), along))?;
    let mut speeds = [vec![f64::NAN; points.len()], vec![f64::NAN; points.len()]];
    for ray in found.map_err(|error| of_sweep(&error))? {
        for (place, [phase, group]) in ray? {
            (speeds[0][place], speeds[1][place]) = (phase, group);
        }
    }
    let [phase, group] = speeds;
    Ok((shaped(py, phase, &points.shape)?, shaped(py, group, &points.shape)?))
}

/// Relative phase and group speed at waves of one direction, each with its place.
fn speeds_along(
    subject: &NativeSubject,
    names: &[String],
    values: &[f64],
    direction: &[f64],
    mut waves: Vec<(f64, usize)>,
) -> PyResult<Vec<(usize, [f64; 2])>> {
    let failed = |error: SchemeError| subject.failed(error);
    let but: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut step = subject.0.opened(&but).map_err(|error| of_subject(&error))?;
    for (name, &value) in names.iter().zip(values) {
        step = step.with(name, &decimal(name, value)?).map_err(failed)?;
    }
    let exact = match subject.0.exact_step() {
        Some(text) => ExactWave::stated(&text, &step),
        None => ExactWave::leading(&step),
    };
    let branches = Branches::of_step(&step, exact.map_err(bad)?).map_err(failed)?;
    waves.sort_by(|one, other| one.0.total_cmp(&other.0));
    let moduli: Vec<f64> = waves.iter().map(|(modulus, _)| *modulus).collect();
    let followed = branches.along(direction, &moduli);
    let physical = followed.iter().find(|branch| branch.physical == Some(0));
    let speeds = |index: usize| {
        let wave = physical.map(|branch| &branch.waves[index]);
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        [known(wave.and_then(|w| w.phase_speed())), known(wave.and_then(|w| w.group_speed()))]
    };
    Ok(waves.iter().enumerate().map(|(index, (_, place))| (*place, speeds(index))).collect())
}
