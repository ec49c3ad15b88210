//! What can go wrong, as one clear line each.

use super::names;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use courant::analysis::scheme::SchemeError;
use courant::reports::figure::FigureError;
use courant::reports::publish::PublishError;
use courant::reports::report::ReportError;

/// Why a command gave no result.
#[derive(Debug)]
pub enum Failure {
    /// A line that names the option, the value and what would be accepted.
    Message(String),
}

impl std::fmt::Display for Failure {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Message(message) => formatter.write_str(message),
        }
    }
}

/// Only standard output is written without an error type of its own.
impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self::Message(format!("standard output: {error}"))
    }
}

impl From<SchemeError> for Failure {
    fn from(error: SchemeError) -> Self {
        Self::Message(error.to_string())
    }
}

impl From<PublishError> for Failure {
    fn from(error: PublishError) -> Self {
        Self::Message(format!("--out: {error}"))
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Publish(error) => error.into(),
            other => Self::Message(other.to_string()),
        }
    }
}

impl From<FigureError> for Failure {
    fn from(error: FigureError) -> Self {
        Self::Message(error.to_string())
    }
}

/// The longest word of a line that is shown whole, and how much is shown of a longer one.
const LONGEST_WORD: usize = 200;

/// The longest line, and how much is shown of both ends of a longer one.
const LONGEST_LINE: usize = 1500;

/// An error as one line that a terminal takes: what is in it may come from anywhere, of any length.
pub fn plain(line: &str) -> String {
    let escape = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.into() };
    let escaped: String = line.chars().map(escape).collect();
    let words: Vec<String> = escaped.split(' ').map(|word| cut(word, LONGEST_WORD)).collect();
    cut(&words.join(" "), LONGEST_LINE)
}

/// The two ends of a text that is too long.
fn cut(text: &str, longest: usize) -> String {
    let count = text.chars().count();
    if count <= longest {
        return text.into();
    }
    let left: String = text.chars().take(longest / 3).collect();
    let right: String = text.chars().skip(count - longest / 3).collect();
    format!("{left}… ({} characters) …{right}", count - 2 * (longest / 3))
}

/// What an option of `command` takes: the first line of its help.
fn accepted(command: &clap::Command, shown: &str) -> Option<String> {
    let argument = command.get_arguments().find(|argument| argument.to_string() == shown)?;
    let help = argument.get_help()?.to_string();
    Some(help.lines().next()?.trim_end_matches('.').to_owned())
}

/// A parse error of the argument library as one line; `command` is the one that was called.
pub fn one_line(error: &clap::Error, command: clap::Command) -> String {
    let get = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        Some(ContextValue::Strings(texts)) => Some(texts.join(", ")),
        _ => None,
    };
    let argument = get(ContextKind::InvalidArg).unwrap_or_default();
    let value = get(ContextKind::InvalidValue).unwrap_or_default();
    let suggestion =
        get(ContextKind::SuggestedArg).or_else(|| get(ContextKind::SuggestedSubcommand));
    let hint = suggestion.map_or_else(String::new, |text| format!("; did you mean `{text}`?"));
    match error.kind() {
        ErrorKind::InvalidValue => {
            let known = get(ContextKind::ValidValue).filter(|list| !list.is_empty());
            let hint = known
                .as_deref()
                .and_then(|list| names::nearest(&value, list.split(", ")))
                .map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
            let accepted = known.map_or_else(String::new, |list| format!("; accepted: {list}"));
            if value.is_empty() {
                let accepted = match accepted.is_empty() {
                    true => self::accepted(&command, &argument)
                        .map_or_else(String::new, |list| format!("; accepted: {list}")),
                    false => accepted,
                };
                format!("error: {argument} needs a value{accepted}")
            } else {
                format!("error: {argument}: `{value}` is not accepted{hint}{accepted}")
            }
        }
        ErrorKind::UnknownArgument if !argument.starts_with('-') => {
            format!("error: `{argument}` is one argument too many; see --help")
        }
        ErrorKind::UnknownArgument => {
            format!("error: there is no option `{argument}` here{hint}; see --help")
        }
        ErrorKind::InvalidSubcommand => {
            let name = get(ContextKind::InvalidSubcommand).unwrap_or_default();
            format!("error: there is no command `{name}`{hint}; see courant --help")
        }
        ErrorKind::MissingRequiredArgument => {
            // `<--scheme <SCHEME>|--method <METHOD>>`: one of these.
            let needed: Vec<String> = argument
                .split(", ")
                .map(|one| match one.strip_prefix('<').and_then(|one| one.strip_suffix('>')) {
                    Some(choice) if choice.contains('|') => {
                        format!("one of {}", choice.replace('|', " and "))
                    }
                    _ => one.into(),
                })
                .collect();
            let verb = if needed.len() > 1 { "are" } else { "is" };
            format!("error: {} {verb} required; see --help", needed.join(", "))
        }
        _ => {
            // `error: invalid value 'x' for '--ratio <LIST>': what is accepted`
            if let (ErrorKind::ValueValidation, Some(why)) =
                (error.kind(), std::error::Error::source(error))
            {
                return format!("error: invalid value '{value}' for '{argument}': {why}");
            }
            let rendered = error.to_string();
            let mut lines = rendered.lines();
            let first = lines.next().unwrap_or("error: bad arguments");
            if first.ends_with(':') {
                // The options themselves follow, a line for each.
                let rest: Vec<&str> =
                    lines.map(str::trim).take_while(|line| !line.is_empty()).collect();
                return format!("{first} {}", rest.join(", "));
            }
            first.into()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_one_short_line_whatever_is_in_it() {
        assert_eq!(plain("--ratio 1\n2\u{1b}[m: αβ"), "--ratio 1\\n2\\u{1b}[m: αβ");
        let long = plain(&format!("--ratio {}: no number", "9".repeat(20_000)));
        assert!(
            long.len() < 200 && long.starts_with("--ratio 99") && long.ends_with(": no number")
        );
        let words = plain(&format!("--equation {}: no equation", "a ".repeat(10_000)));
        assert!(words.len() < 1200 && words.ends_with(": no equation"), "{words}");
    }
}
