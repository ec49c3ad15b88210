//! The largest stable time step of every integrator, proved.

use super::plan::{Named, integrator, lattice};
use crate::number::significant;
use crate::page::Item;
use crate::paper_text::PaperText;
use crate::report::{Detail, ReportError};
use crate::{cells, words};
use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::catalogue::PARTICLE_INTEGRATORS;
use courant_analysis::scheme::{COURANT, Integrator, LatticeMethod};
use courant_analysis::stability::{Limit, SearchPlan};
use courant_analysis::waves::sweep::SweepError;
use rayon::prelude::*;
use serde::Deserialize;

/// Steps `c Δt/h` are searched up to here.
const RANGE: i64 = 8;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    methods: Vec<MethodPlan>,
    kernel: Named<Kernel>,
    ratios: Vec<Named<Rational>>,
    /// The ratio of other kernels and of steps that may grow.
    usual: Named<Rational>,
    /// The integrator of other kernels.
    integrator: String,
}

/// A particle method, with its viscosity if it has one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct MethodPlan {
    name: String,
    alpha: Option<i64>,
    /// Whether a quick report does without.
    #[serde(default)]
    long: bool,
}

impl MethodPlan {
    fn on(&self, kernel: Kernel, at: &Rational) -> Result<LatticeMethod, SweepError> {
        let lattice = lattice(&self.name, kernel, at)?;
        Ok(match self.alpha {
            Some(alpha) => lattice.with("alpha", &integer(alpha)),
            None => lattice,
        })
    }
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

/// Tables by integrator and by kernel.
///
/// # Errors
/// When a ratio is out of range.
pub fn items(text: &PaperText, detail: Detail) -> Result<Vec<Item>, ReportError> {
    let mut plan: Plan = text.plan("integrators");
    plan.methods.retain(|method| detail != Detail::Quick || !method.long);
    let paragraph = text.paragraph("integrator_text", &[]);
    Ok(vec![paragraph, by_integrator(text, &plan)?, by_kernel(text, &plan)?])
}

fn by_integrator(text: &PaperText, plan: &Plan) -> Result<Item, ReportError> {
    let Plan { methods, kernel, ratios, usual, .. } = plan;
    let heading = |at: &Rational| format!("h/Δ = {}", significant(to_f64(at), 2));
    let mut columns: Vec<String> = ratios.iter().map(|at| heading(&at.0)).collect();
    columns.push(format!("{}, growth 1e-3", heading(&usual.0)));
    let cases: Vec<_> = PARTICLE_INTEGRATORS
        .into_iter()
        .flat_map(|name| methods.iter().map(move |method| (integrator(name), method)))
        .collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|&(integrator, method)| {
            let limit = |at: &Rational, growth: &Rational| {
                let lattice = method.on(kernel.0, at)?;
                proved(&lattice, integrator, growth).map(|limit| shown(&limit))
            };
            let title = method.on(kernel.0, &usual.0)?.title();
            let mut row = cells![integrator.title, integrator.stages(), title];
            for at in ratios {
                row.push(limit(&at.0, &integer(0))?);
            }
            row.push(limit(&usual.0, &ratio(1, 1000))?);
            Ok(row)
        })
        .collect();
    Ok(text.wide_table("integrator_table", &[], &columns, rows?))
}

fn by_kernel(text: &PaperText, plan: &Plan) -> Result<Item, ReportError> {
    let usual = &plan.usual.0;
    let cases: Vec<_> = Kernel::ALL
        .into_iter()
        .flat_map(|kernel| plan.methods.iter().map(move |method| (kernel, method)))
        .collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|&(kernel, method)| {
            let lattice = method.on(kernel, usual)?;
            let limit = proved(&lattice, integrator(&plan.integrator), &integer(0))?;
            Ok(cells![
                kernel.title(),
                lattice.title(),
                shown(&limit),
                significant(limit.value() * to_f64(usual), 5),
                significant(limit.value() / kernel.standard_deviation(), 5),
                limit.evidence().name(),
            ])
        })
        .collect();
    let ratio = words!["ratio" = to_text(usual)];
    Ok(text.table("integrator_table_kernels", ratio, rows?))
}
