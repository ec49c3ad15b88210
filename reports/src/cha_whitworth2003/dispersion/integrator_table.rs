//! The largest stable time step of every integrator, proved.

use super::super::ReportError;
use super::{integrator, lattice, text, usual_ratio};
use crate::number::significant;
use crate::page::Item;
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use courant_analysis::scheme::{COURANT, Integrator, LatticeMethod};
use courant_analysis::stability::{Limit, SearchPlan};
use courant_analysis::waves::sweep::SweepError;
use num_traits::Signed;
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
    let mut plan = SearchPlan::default().up_to(integer(RANGE)).growing(growth.clone());
    if growth.is_positive() {
        // A budget leaves no closed form: the digits shown suffice.
        plan = plan.to_bits(32);
    }
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
    Ok(vec![text().paragraph("integrator_text", &[]), by_integrator()?, by_kernel()?])
}

fn by_integrator() -> Result<Item, ReportError> {
    let ratios = ratios();
    let mut columns: Vec<String> =
        ratios.iter().map(|at| format!("h/Δ = {}", significant(to_f64(at), 2))).collect();
    columns.push(format!("h/Δ = {}, growth 1e-3", significant(to_f64(&usual_ratio()), 2)));
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
            let title = method(named, Kernel::CubicSpline, &usual_ratio())?.title();
            let mut row = cells![integrator.title, integrator.stages(), title];
            for at in &ratios {
                row.push(limit(at, &integer(0))?);
            }
            row.push(limit(&usual_ratio(), &ratio(1, 1000))?);
            Ok(row)
        })
        .collect();
    Ok(text().wide_table("integrator_table", &[], &columns, rows?))
}

fn by_kernel() -> Result<Item, ReportError> {
    let cases: Vec<_> =
        Kernel::ALL.into_iter().flat_map(|kernel| METHODS.map(|method| (kernel, method))).collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|&(kernel, named)| {
            let lattice = method(named, kernel, &usual_ratio())?;
            let limit = proved(&lattice, integrator("leapfrog-kdk"), &integer(0))?;
            Ok(cells![
                kernel.title(),
                lattice.title(),
                shown(&limit),
                significant(limit.value() * to_f64(&usual_ratio()), 5),
                significant(limit.value() / kernel.standard_deviation(), 5),
                limit.evidence().name(),
            ])
        })
        .collect();
    let ratio = words!["ratio" = to_text(&usual_ratio())];
    Ok(text().table("integrator_table_kernels", ratio, rows?))
}
