//! The largest stable time step of every integrator, proved.

use super::super::{COMMAND, ReportError};
use super::usual_ratio;
use crate::number::significant;
use crate::page::Item;
use crate::table::{Align, Table};
use courant_analysis::exact::rational::{Rational, integer, ratio, to_f64, to_text};
use courant_analysis::kernel::Kernel;
use courant_analysis::scheme::integrator::Integrator;
use courant_analysis::waves::dispersion::{
    Form, StableStep, WaveMethod, WaveScheme, stable_step, stable_step_within,
};
use courant_analysis::waves::sweep::SweepError;
use num_traits::Zero;
use rayon::prelude::*;

/// Steps `c Δt/h` are searched up to here.
const RANGE: i64 = 8;

fn methods() -> [WaveMethod; 4] {
    let viscous = |alpha| WaveMethod::SphAv { alpha: integer(alpha) };
    [WaveMethod::Sph, viscous(1), viscous(2), WaveMethod::Gph { form: Form::Resolved }]
}

fn ratios() -> [Rational; 4] {
    [integer(1), usual_ratio(), ratio(3, 2), integer(2)]
}

fn proved(
    method: &WaveMethod,
    integrator: Integrator,
    kernel: Kernel,
    at: &Rational,
    growth: &Rational,
) -> Result<StableStep, SweepError> {
    let scheme = WaveScheme::new(method.clone(), kernel, at)?;
    let found = if growth.is_zero() {
        stable_step(&scheme, integrator, &integer(RANGE))
    } else {
        stable_step_within(&scheme, integrator, growth, &integer(RANGE))
    };
    Ok(found.expect("the methods of these tables are schemes that run"))
}

/// A limit in seven digits, with its closed form where that is short.
fn shown(step: &StableStep) -> String {
    let limit = step.limit();
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
    let cases: Vec<(Integrator, WaveMethod)> = Integrator::ALL
        .into_iter()
        .flat_map(|integrator| methods().into_iter().map(move |method| (integrator, method)))
        .collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|(integrator, method)| {
            let limit = |at: &Rational, growth: &Rational| {
                proved(method, *integrator, Kernel::CubicSpline, at, growth)
                    .map(|step| shown(&step))
            };
            let mut row = vec![
                integrator.title().to_owned(),
                integrator.force_evaluations().to_string(),
                method.title(),
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
    let cases: Vec<(Kernel, WaveMethod)> = Kernel::ALL
        .into_iter()
        .flat_map(|kernel| methods().into_iter().map(move |method| (kernel, method)))
        .collect();
    let rows: Result<Vec<Vec<String>>, SweepError> = cases
        .par_iter()
        .map(|(kernel, method)| {
            let step =
                proved(method, Integrator::LeapfrogKdk, *kernel, &usual_ratio(), &integer(0))?;
            Ok(vec![
                kernel.title().to_owned(),
                method.title(),
                shown(&step),
                significant(step.per_spacing(), 5),
                significant(step.per_standard_deviation(), 5),
                step.limit().evidence().name().into(),
            ])
        })
        .collect();
    for row in rows? {
        table.push(row);
    }
    Ok(Item::Table { name: "integrator_table_kernels".into(), table, command: COMMAND.into() })
}
