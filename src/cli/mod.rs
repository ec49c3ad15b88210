//! Arguments, dispatch, progress and exit codes. No mathematics.

mod check;
mod columns;
mod curves;
mod dispersion;
mod error;
mod limit_text;
mod limits;
mod list;
mod manual;
mod map;
mod names;
mod numbers;
mod output;
mod probe;
mod progress;
mod report;
mod run;
mod subject;
mod symbol;
mod validate;
mod verify;
mod waves;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use error::Failure;
use std::io::Write;
use std::process::ExitCode;

/// Von Neumann stability of numerical schemes: amplification factors, proved time-step limits, maps.
#[derive(Debug, Parser)]
#[command(name = "courant", version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Number of threads (default: one for each processor); results do not depend on it.
    #[arg(long, global = true, value_name = "N", value_parser = numbers::threads)]
    threads: Option<usize>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// What there is: kernels, schemes, spaces, integrators, methods, lattices, scenes, figures, with their sources.
    List(list::Arguments),
    /// Characteristic polynomial, amplification factor, order of accuracy and consistency of a scheme.
    Symbol(symbol::Arguments),
    /// Largest stable and largest monotone value of a parameter, such as the Courant number, with evidence.
    Limits(limits::Arguments),
    /// Verdict on values of a parameter, such as the Courant number; exit code 0 when all are stable or marginal (with --growth: grow by
    /// no more), 1 when one is not or is undecided.
    Check(check::Arguments),
    /// What a scheme does to every wave, branch by branch: gain, phase error, phase and group speed, points per wavelength; one figure
    /// for all schemes and values.
    Curves(curves::Arguments),
    /// Maps over two parameters: amplification with the proved limit for any scheme; phase error, amplitude or stable steps of a particle
    /// method. PNG, SVG, CSV, NPY.
    Map(map::Arguments),
    /// Frequencies of sound waves in a particle method: phase error and amplitude, branch by branch.
    Dispersion(dispersion::Arguments),
    /// Run a scene with a method: profile, figure, error norms, conservation.
    Run(Box<run::Arguments>),
    /// Predicted against measured, wave by wave, for any scheme; exit code 0 when they agree, 1 when they do not.
    Validate(validate::Arguments),
    /// The user's own program as a scheme: its stencil by impulses, its stability limit, verdicts; exit code 0 when the program is a scheme
    /// and all values of --set are stable, 1 when not.
    Probe(Box<probe::Arguments>),
    /// Regenerate the tables and figures of a paper: index.html, index.md and all data.
    Report(report::Arguments),
    /// Check a file of certificates; exit code 0 when all hold, 1 when one does not.
    Verify(verify::Arguments),
    /// Shell completions on standard output.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Manual pages: one on standard output, or all of them as files.
    Man(manual::Arguments),
}

/// The definition of all arguments. Every option reads a negative number as its value, so that it is refused
/// by the option's name and not as an unknown option.
fn definition() -> clap::Command {
    let negative = |argument: clap::Arg| {
        let takes_value = argument.is_positional() || argument.get_action().takes_values();
        argument.allow_negative_numbers(takes_value)
    };
    Arguments::command().mut_args(negative).mut_subcommands(|command| command.mut_args(negative))
}

/// The definition of the command that the program was called with, or of the program.
fn addressed() -> clap::Command {
    let mut program = definition();
    program.build();
    let command = std::env::args().skip(1).find_map(|word| program.find_subcommand(word).cloned());
    command.unwrap_or(program)
}

/// How the program ended when nothing went wrong.
enum Outcome {
    /// Done, and the answer (if there was a question) is yes.
    Yes,
    /// The answer is no.
    No,
}

/// Writes to standard error, where somebody may have stopped reading.
fn complain(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// Parses the arguments, runs the command and turns the outcome into an exit code: 0 done or yes, 1 no,
/// 2 bad input.
pub fn main() -> ExitCode {
    let parsed =
        definition().try_get_matches().and_then(|found| Arguments::from_arg_matches(&found));
    let arguments = match parsed {
        Ok(arguments) => arguments,
        Err(error) if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            complain(&error.to_string());
            return ExitCode::from(2);
        }
        Err(error) if error.use_stderr() => {
            complain(&format!("{}\n", error::plain(&error::one_line(&error, addressed()))));
            return ExitCode::from(2);
        }
        Err(help) => {
            // Help and version go to standard output; a closed pipe there is no failure.
            let _ = help.print();
            return ExitCode::SUCCESS;
        }
    };
    if let Some(threads) = arguments.threads
        && let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()
    {
        complain(&format!("error: --threads {threads}: {error}\n"));
        return ExitCode::from(2);
    }
    match dispatch(arguments.command) {
        Ok(Outcome::Yes) => ExitCode::SUCCESS,
        Ok(Outcome::No) => ExitCode::from(1),
        Err(failure) => {
            complain(&format!("{}\n", error::plain(&format!("error: {failure}"))));
            ExitCode::from(2)
        }
    }
}

fn dispatch(command: Command) -> Result<Outcome, Failure> {
    match command {
        Command::List(arguments) => list::run(&arguments),
        Command::Symbol(arguments) => symbol::run(&arguments),
        Command::Limits(arguments) => limits::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Curves(arguments) => curves::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Dispersion(arguments) => dispersion::run(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Validate(arguments) => validate::run(&arguments),
        Command::Probe(arguments) => probe::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut definition(), "courant", &mut script);
            output::print_bytes(&script)
        }
        Command::Man(arguments) => manual::run(&arguments, definition()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_argument_definitions_are_consistent() {
        definition().debug_assert();
    }
}
