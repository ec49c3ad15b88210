//! `courant symbol`.

use super::output::{Format, print, print_json, table_text};
use super::{Failure, Outcome, names, numbers};
use clap::Args;
use courant::analysis::exact::rational::Rational;
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::{AdvectionScheme, Discretisation};
use courant::reports::record::SymbolRecord;
use courant::reports::table::{Align, Table};

#[derive(Debug, Args)]
pub struct Arguments {
    /// Scheme: euler-sph, lax-wendroff-sph, godunov-sph.
    #[arg(long, value_parser = names::scheme)]
    scheme: AdvectionScheme,
    /// Kernel: see `courant list kernels`.
    #[arg(long, value_parser = names::kernel, default_value = "cubic-spline")]
    kernel: Kernel,
    /// Smoothing ratio l/Δξ, read exactly: 2, 1.3, 3/2.
    #[arg(long, allow_hyphen_values = true, value_parser = numbers::ratio)]
    ratio: Rational,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let discretisation =
        Discretisation::new(arguments.scheme, arguments.kernel, arguments.ratio.clone())
            .map_err(|error| Failure::Message(format!("--ratio: {error}")))?;
    let record = SymbolRecord::new(&discretisation);
    match arguments.format {
        Format::Json => return print_json("symbol", &record),
        Format::Latex => return print(&format!("{}\n", record.latex)),
        Format::Table | Format::Csv | Format::Markdown => {}
    }
    let powers = record.coefficients.iter().map(|c| c.polynomial.len()).max().unwrap_or(0);
    let names: Vec<String> = (0..powers)
        .map(|power| match power {
            0 => "1".into(),
            1 => "C".into(),
            _ => format!("C^{power}"),
        })
        .collect();
    let mut columns = vec![("offset", Align::Right)];
    columns.extend(names.iter().map(|name| (name.as_str(), Align::Right)));
    let caption = format!(
        "{}, {}, l/Δξ = {}: coefficients of the neighbours in powers of C",
        arguments.scheme.title(),
        arguments.kernel.title(),
        record.ratio
    );
    let mut table = Table::new(caption, &columns);
    for coefficient in &record.coefficients {
        let mut row = vec![coefficient.offset.to_string()];
        row.extend(
            (0..powers).map(|power| {
                coefficient.polynomial.get(power).cloned().unwrap_or_else(|| "0".into())
            }),
        );
        table.push(row);
    }
    let mut text = table_text(&table, arguments.format).unwrap_or_default();
    if arguments.format == Format::Table {
        let order = match record.order {
            Some(0) => format!(
                "0: long waves travel at {} times the true speed",
                courant::reports::number::significant(record.long_wave_speed, 8)
            ),
            Some(order) => order.to_string(),
            None => "none: a constant is not kept, the mean drifts".into(),
        };
        text = format!(
            "{text}\n{}\n\nupdate           {}\nsource           {}\nkeeps constants  {}\norder            {order}\n",
            record.text,
            arguments.scheme.formula(),
            arguments.scheme.source(),
            if record.keeps_constants { "yes" } else { "no" },
        );
    }
    print(&text)
}
