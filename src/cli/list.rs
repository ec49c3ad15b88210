//! `courant list`.

use super::output::{Format, print, print_json, table_text};
use super::waves::MethodName;
use super::{Failure, Outcome, run};
use clap::{Args, ValueEnum};
use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::AdvectionScheme;
use courant::analysis::scheme::integrator::Integrator;
use courant::reports::table::{Align, Table};
use serde::Serialize;

/// What can be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Topic {
    /// Smoothing kernels.
    Kernels,
    /// Advection schemes.
    Schemes,
    /// Methods that run scenes.
    Methods,
    /// Time integrators of particle methods.
    Integrators,
    /// Scenes to run.
    Scenes,
    /// Tables and figures of the reports.
    Figures,
}

#[derive(Debug, Args)]
pub struct Arguments {
    /// What to list (default: everything).
    topic: Option<Topic>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
}

/// One thing there is.
#[derive(Debug, Serialize)]
struct Entry {
    name: &'static str,
    aliases: &'static [&'static str],
    description: String,
    source: &'static str,
}

impl From<run::Entry> for Entry {
    fn from(entry: run::Entry) -> Self {
        let description = entry.description.into();
        Self { name: entry.name, aliases: &[], description, source: entry.source }
    }
}

/// A method whose waves are known in closed form.
fn wave_entry(name: MethodName) -> Entry {
    let method = name.example();
    let what = match name {
        MethodName::Sph => "waves of SPH",
        MethodName::SphAv => "waves of SPH with viscosity α",
        MethodName::Gph => "waves of Godunov particle hydrodynamics, --form resolved",
    };
    let description = format!("{what}: {}", method.relation());
    Entry { name: method.name(), aliases: &[], description, source: method.source() }
}

impl Topic {
    const ALL: [Self; 6] = [
        Self::Kernels,
        Self::Schemes,
        Self::Methods,
        Self::Integrators,
        Self::Scenes,
        Self::Figures,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Kernels => "kernels",
            Self::Schemes => "schemes",
            Self::Methods => "methods",
            Self::Integrators => "integrators",
            Self::Scenes => "scenes",
            Self::Figures => "figures",
        }
    }

    fn entries(self) -> Vec<Entry> {
        match self {
            Self::Kernels => Kernel::ALL
                .into_iter()
                .map(|kernel| Entry {
                    name: kernel.name(),
                    aliases: kernel.aliases(),
                    description: format!(
                        "{}; support {} l, standard deviation {:.4} l",
                        kernel.title(),
                        kernel.support(),
                        kernel.standard_deviation()
                    ),
                    source: kernel.source(),
                })
                .collect(),
            Self::Schemes => AdvectionScheme::ALL
                .into_iter()
                .map(|scheme| Entry {
                    name: scheme.name(),
                    aliases: &[],
                    description: scheme.formula().into(),
                    source: scheme.source(),
                })
                .collect(),
            Self::Methods => {
                let waves = MethodName::ALL.into_iter().map(wave_entry);
                run::methods().into_iter().map(Entry::from).chain(waves).collect()
            }
            Self::Integrators => Integrator::ALL
                .into_iter()
                .map(|integrator| Entry {
                    name: integrator.name(),
                    aliases: integrator.aliases(),
                    description: format!(
                        "{}; force evaluations per step: {}",
                        integrator.title(),
                        integrator.force_evaluations()
                    ),
                    source: integrator.source(),
                })
                .collect(),
            Self::Scenes => run::scenes().into_iter().map(Entry::from).collect(),
            Self::Figures => courant::reports::catalogue()
                .map(|item| Entry {
                    name: item.name,
                    aliases: &[],
                    description: item.description.into(),
                    source: item.source,
                })
                .collect(),
        }
    }
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let topics = arguments.topic.map_or_else(|| Topic::ALL.to_vec(), |topic| vec![topic]);
    if arguments.format == Format::Json {
        let lists: serde_json::Map<String, serde_json::Value> = topics
            .iter()
            .map(|topic| {
                let entries =
                    serde_json::to_value(topic.entries()).expect("entries are plain data");
                (topic.name().into(), entries)
            })
            .collect();
        return print_json("list", &lists);
    }
    let mut text = String::new();
    for topic in topics {
        let mut table = Table::new(
            topic.name(),
            &[
                ("name", Align::Left),
                ("also", Align::Left),
                ("what it is", Align::Left),
                ("source", Align::Left),
            ],
        );
        for entry in topic.entries() {
            table.push([
                entry.name.to_string(),
                entry.aliases.join(", "),
                entry.description,
                entry.source.into(),
            ]);
        }
        text.push_str(&table_text(&table, arguments.format).unwrap_or_default());
        text.push('\n');
    }
    print(text.trim_end_matches('\n')).and_then(|_| print("\n"))
}
