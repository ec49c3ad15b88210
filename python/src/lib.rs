//! The native half of `courant_stability`: questions asked of the analysis, answers as NumPy arrays and as the program's JSON.
//!
//! Python is the better language for what users touch: classes, plots, text for notebooks. It is in `package/`; nothing here is public.

mod broadcast;
mod certificate;
mod error;
mod exact;
mod limits;
mod map;
mod probe;
mod subject;
mod sweep;
mod symbol;
mod validation;
mod watch;
mod waves;

use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue;
use pyo3::prelude::*;

/// The names of the catalogue: schemes, spaces, methods, integrators, kernels.
#[pyfunction]
fn names() -> [Vec<&'static str>; 5] {
    let of = |files: &'static [catalogue::SchemeFile]| {
        files.iter().map(|file| file.name.as_str()).collect()
    };
    [
        of(catalogue::schemes()),
        of(catalogue::spaces()),
        of(catalogue::methods()),
        catalogue::integrators().iter().map(|one| one.name.as_str()).collect(),
        Kernel::ALL.map(Kernel::name).to_vec(),
    ]
}

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("EVIDENCE", sweep::EVIDENCE)?;
    module.add("CAUSES", sweep::CAUSES)?;
    module.add_class::<subject::NativeSubject>()?;
    module.add_class::<probe::NativeProbe>()?;
    module.add_function(wrap_pyfunction!(names, module)?)?;
    module.add_function(wrap_pyfunction!(limits::stable_set, module)?)?;
    module.add_function(wrap_pyfunction!(limits::monotone_set, module)?)?;
    module.add_function(wrap_pyfunction!(limits::check, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::limits, module)?)?;
    module.add_function(wrap_pyfunction!(map::gains, module)?)?;
    module.add_function(wrap_pyfunction!(map::stable, module)?)?;
    module.add_function(wrap_pyfunction!(waves::multipliers, module)?)?;
    module.add_function(wrap_pyfunction!(waves::gain, module)?)?;
    module.add_function(wrap_pyfunction!(waves::speeds, module)?)?;
    module.add_function(wrap_pyfunction!(symbol::symbol, module)?)?;
    module.add_function(wrap_pyfunction!(certificate::certify, module)?)?;
    module.add_function(wrap_pyfunction!(certificate::verify, module)?)?;
    module.add_function(wrap_pyfunction!(validation::validate, module)?)?;
    Ok(())
}
