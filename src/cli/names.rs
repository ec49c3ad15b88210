//! Names of kernels and schemes, with a suggestion when one is misspelt.

use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::{Integrator, catalogue};
use courant::simulation::advection::AdvectionScheme;
use std::sync::Arc;

/// A kernel by name or alias.
pub fn kernel(text: &str) -> Result<Kernel, String> {
    text.parse().map_err(|_| {
        let aliases = Kernel::ALL.iter().flat_map(|kernel| kernel.aliases());
        with_aliases("kernel", text, &Kernel::ALL.map(Kernel::name), aliases.copied())
    })
}

/// A scheme by name.
pub fn scheme(text: &str) -> Result<AdvectionScheme, String> {
    text.parse()
        .map_err(|_| unknown("scheme", text, &AdvectionScheme::ALL.map(AdvectionScheme::name)))
}

/// An integrator by name, alias or file; particle codes mean kick–drift–kick by `leapfrog`.
pub fn integrator(name: &str, particles: bool) -> Result<Arc<Integrator>, String> {
    if name.ends_with(".toml") {
        let text = std::fs::read_to_string(name).map_err(|error| unreadable(&error))?;
        return Integrator::from_toml(&text)
            .map(Arc::new)
            .map_err(|error| misspelt_key(&error.to_string()));
    }
    let find = if particles { Integrator::for_particles } else { Integrator::named };
    find(name).map(|found| Arc::new(found.clone())).ok_or_else(|| {
        let entries = catalogue::integrators().iter().flat_map(|one| {
            let names = [&one.name].into_iter().chain(&one.aliases);
            names.map(|name| (name.as_str(), one.name.as_str()))
        });
        unknown_among("integrator", name, entries, "integrators")
    })
}

/// Why a file that the user names is of no use.
pub fn unreadable(error: &std::io::Error) -> String {
    format!("the file cannot be read: {error}")
}

/// What is wrong with a file that the user names: where a key is not known, with the nearest one that is.
pub fn misspelt_key(problem: &str) -> String {
    let mut names = problem.split('`').skip(1).step_by(2);
    let nearest = match names.next() {
        Some(key) if problem.starts_with("unknown field") => nearest(key, names),
        _ => None,
    };
    match nearest {
        Some(name) => format!("{problem}; did you mean `{name}`?"),
        None => problem.into(),
    }
}

/// The nearest of several names, if it is near.
pub fn nearest<'a>(text: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = text.to_ascii_lowercase();
    let (steps, name) = names.map(|name| (distance(&wanted, name), name)).min()?;
    is_near(steps, name).then_some(name)
}

/// Whether a name that so many edits make of another may be meant by it.
fn is_near(steps: usize, name: &str) -> bool {
    steps <= 1 + name.len() / 4
}

/// What to say of a name that is none: the nearest one, and all of them.
pub fn unknown(what: &str, text: &str, all: &[&str]) -> String {
    with_aliases(what, text, all, std::iter::empty())
}

/// The same where there are too many to name: pairs of an accepted name and the one it stands for, which `courant list` has under a topic.
pub fn unknown_among<'a>(
    what: &str,
    text: &str,
    entries: impl Iterator<Item = (&'a str, &'a str)>,
    topic: &str,
) -> String {
    let wanted = text.to_ascii_lowercase();
    let mut ranked: Vec<(usize, &str)> =
        entries.map(|(name, stands_for)| (distance(&wanted, name), stands_for)).collect();
    ranked.sort();
    let near = |(steps, name): &&(usize, &str)| is_near(*steps, name);
    let mut nearest: Vec<&str> = Vec::new();
    for (_, name) in ranked.iter().filter(near) {
        if nearest.len() < 3 && !nearest.contains(name) {
            nearest.push(name);
        }
    }
    let hint = match nearest.as_slice() {
        [] => String::new(),
        names => format!("did you mean `{}`? ", names.join("` or `")),
    };
    format!("there is no such {what}; {hint}see courant list {topic}")
}

fn with_aliases<'a>(
    what: &str,
    text: &str,
    all: &[&'a str],
    aliases: impl Iterator<Item = &'a str>,
) -> String {
    let hint = nearest(text, all.iter().copied().chain(aliases))
        .map_or_else(String::new, |name| format!("did you mean `{name}`? "));
    format!("there is no such {what}; {hint}accepted: {}", all.join(", "))
}

/// Levenshtein's distance.
fn distance(left: &str, right: &str) -> usize {
    let right: Vec<char> = right.chars().collect();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (i, a) in left.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in right.iter().enumerate() {
            let substituted = diagonal + usize::from(a != *b);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[right.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_edits() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("same", "same"), 0);
    }

    #[test]
    fn misspelt_names_get_a_suggestion() {
        assert!(kernel("cubicspline").unwrap_err().contains("`cubic-spline`"));
        assert!(scheme("godunow-sph").unwrap_err().contains("`godunov-sph`"));
        let key = misspelt_key("unknown field `equation`, expected one of `name`, `equations`");
        assert!(key.ends_with("did you mean `equations`?"), "{key}");
        assert!(!kernel("zzz").unwrap_err().contains("did you mean"));
    }
}
