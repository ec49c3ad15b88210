//! The largest stable time step of every integrator, proved.

use super::super::{COMMAND, ReportError};
use super::{integrator, lattice, usual_ratio};
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use courant_analysis::scheme::{COURANT, Integrator, LatticeMethod};
use courant_analysis::stability::{Limit, SearchPlan};
use courant_analysis::waves::sweep::SweepError;
use rayon::prelude::*;

/// Steps `c Δt/h` are searched up to here.
const RANGE: i64 = 8;

/// Methods by name, with the viscosity of those that have one.
const METHODS: [(&str, Option<i64>); 4] =
    [("sph", None), ("sph-av", Some(1)), ("sph-av", Some(2)), ("gph", None)];

fn method(
    (name, alpha): (&str, Option<i64>),
    kernel: Kernel,
    at: &Rational,
) -> Result<LatticeMethod, SweepError> {
    let lattice = lattice(name, kernel, at)?;
    Ok(match alpha {
        Some(alpha) => lattice.with("alpha", &integer(alpha)),
        None => lattice,
    })
}

fn ratios() -> [Rational; 4] {
    [integer(1), usual_ratio(), ratio(3, 2), integer(2)]
}

fn proved(
    method: &LatticeMethod,
    integrator: &Integrator,
    growth: &Rational,
) -> Result<Limit, SweepError> {
    let plan = SearchPlan::default().up_to(integer(RANGE)).growing(growth.clone());
    Ok(method.step(integrator)?.stable_set(COURANT, &plan)?.limit())
}

/// A limit in seven digits, with its closed form where that is short.
fn shown(limit: &Limit) -> String {
    if limit.value().is_infinite() {
        return format!("> {}", significant(limit.lower(), 3));
    }
    let exact = limit
        .exact()
        .map(ToString::to_string)
        .filter(|text| text.len() <= 10 && text.contains(['/', '(']) && limit.is_positive());
    let decimals = significant(limit.value(), 7);
    exact.map_or(decimals.clone(), |exact| format!("{decimals} = {exact}"))
}

pub fn items() -> Result<Vec<Item>, ReportError> {
    let text = "A particle scheme is not run exactly in time. Each mode obeys Ẋ = V, V̇ = −ω_SPH² X − bV; one step \
                multiplies it by a matrix, and the step is stable when both multipliers of every mode lie in the unit \
                circle. The conditions of Jury on the characteristic polynomial are polynomials in c Δt/h with cosine \
                series as coefficients, whose signs are decided in exact arithmetic: the limits below are proved over all \
                wavelengths for the cubic B-spline and enclosed for the Gaussian. A limit 0 means that some wave grows at \
                every step; where that growth is weak (forward Euler, centred Euler and second-order Runge–Kutta without viscosity) the \
                last column gives the step up to which it stays below 1e-3. Symplectic Euler, the leapfrogs and the predictor–corrector without viscosity lose \
                stability through a double multiplier −1: at the limit itself the amplitude grows linearly, \
                so only smaller steps are stable.";
    Ok(vec![Item::Paragraph(text.into()), by_integrator()?, by_kernel()?])
}

fn by_integrator() -> Result<Item, ReportError> {
    let ratios = ratios();
    let names: Vec<String> = ratios
        .iter()
        .map(|at| format!("h/Δ = {}", significant(to_f64(at), 2)))
        .chain([format!("h/Δ = {}, growth 1e-3", significant(to_f64(&usual_ratio()), 2))])
        .collect();
    let mut columns = vec![
        ("integrator", Align::Left),
        ("forces per step", Align::Right),
        ("method", Align::Left),
    ];
    columns.extend(names.iter().map(|name| (name.as_str(), Align::Right)));
    let caption = "Largest stable c Δt/h, proved: cubic B-spline, ρ0 = M Σ W, isothermal";
    let mut table = Table::new(caption, &columns);
    let cases: Vec<_> = PARTICLE_INTEGRATORS
        .into_iter()
        .flat_map(|name| METHODS.map(|method| (integrator(name), method)))
        .collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|&(integrator, named)| {
            let limit = |at: &Rational, growth: &Rational| {
                let lattice = method(named, Kernel::CubicSpline, at)?;
                proved(&lattice, integrator, growth).map(|limit| shown(&limit))
            };
            let mut row = vec![
                integrator.title.clone(),
                integrator.stages().to_string(),
                method(named, Kernel::CubicSpline, &usual_ratio())?.title(),
            ];
            for at in &ratios {
                row.push(limit(at, &integer(0))?);
            }
            row.push(limit(&usual_ratio(), &ratio(1, 1000))?);
            Ok(row)
        })
        .collect();
    for row in rows? {
        table.push(row);
    }
    Ok(Item::Table { name: "integrator_table".into(), table, command: COMMAND.into() })
}

fn by_kernel() -> Result<Item, ReportError> {
    let caption = format!(
        "Largest stable step of the leapfrog KDK by kernel, h/Δ = {}, in three units: per smoothing length, per spacing \
         and per standard deviation σ of the kernel; ρ0 = M Σ W, isothermal",
        to_text(&usual_ratio())
    );
    let mut table = Table::new(
        caption,
        &[
            ("kernel", Align::Left),
            ("method", Align::Left),
            ("c Δt/h", Align::Right),
            ("c Δt/Δ", Align::Right),
            ("c Δt/σ", Align::Right),
            ("evidence", Align::Left),
        ],
    );
    let cases: Vec<_> =
        Kernel::ALL.into_iter().flat_map(|kernel| METHODS.map(|method| (kernel, method))).collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|&(kernel, named)| {
            let lattice = method(named, kernel, &usual_ratio())?;
            let limit = proved(&lattice, integrator("leapfrog-kdk"), &integer(0))?;
            Ok(vec![
                kernel.title().to_owned(),
                lattice.title(),
                shown(&limit),
                significant(limit.value() * to_f64(&usual_ratio()), 5),
                significant(limit.value() / kernel.standard_deviation(), 5),
                limit.evidence().name().into(),
            ])
        })
        .collect();
    for row in rows? {
        table.push(row);
    }
    Ok(Item::Table { name: "integrator_table_kernels".into(), table, command: COMMAND.into() })
}
