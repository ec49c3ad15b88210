//! Names of kernels and schemes, with a suggestion when one is misspelt.

use super::run;
use super::subject::Kind;
use courant::analysis::kernel::{Density, Kernel, UnknownDensity};
use courant::analysis::scheme::catalogue::SchemeFile;
use courant::analysis::scheme::{Integrator, catalogue};
use courant::analysis::spelling::spells;
use std::sync::Arc;

/// A kernel by name or alias.
pub fn kernel(text: &str) -> Result<Kernel, String> {
    text.parse().map_err(|_| {
        let aliases = Kernel::ALL.iter().flat_map(|kernel| kernel.aliases());
        with_aliases("kernel", text, &Kernel::ALL.map(Kernel::name), aliases.copied())
    })
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

/// A density of particle methods by name.
pub fn density(text: &str) -> Result<Density, String> {
    text.parse().map_err(|error: UnknownDensity| error.to_string())
}

/// What a name is that is not what its option takes: a scheme, a space, a method, an integrator.
pub fn elsewhere(name: &str, option: Option<Kind>) -> Option<String> {
    let is_among = |all: &[SchemeFile]| all.iter().any(|file| spells(name, &file.name));
    let is_not = |kind| option != Some(kind);
    let known = if is_not(Kind::Scheme) && is_among(catalogue::schemes()) {
        "it is a scheme (--scheme of limits, check, validate)"
    } else if is_not(Kind::Space) && is_among(catalogue::spaces()) {
        "it is a space (--space of limits, check, validate)"
    } else if is_not(Kind::Method) && is_among(catalogue::methods()) {
        "it is a method whose waves are judged (--method of limits, check, dispersion)"
    } else if Integrator::named(name).is_some() {
        "it is an integrator (--integrator)"
    } else if name.parse::<Kernel>().is_ok() {
        "it is a kernel (--kernel)"
    } else if option == Some(Kind::Method)
        && run::methods().iter().any(|one| spells(name, one.name))
    {
        "it runs scenes (courant run), and its waves have no relation here"
    } else {
        let wcsph =
            "there is no such method: weakly compressible SPH is sph or sph-av with --eos tait:P0";
        return spells(name, "wcsph").then(|| wcsph.into());
    };
    Some(known.into())
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
    let (_, name) = names.filter_map(|name| Some((nearness(text, name)?, name))).min()?;
    Some(name)
}

/// How many edits make one name of another, where it may be meant by it: so few that most of both is the same, or one
/// is how the other begins.
fn nearness(text: &str, name: &str) -> Option<usize> {
    let wanted = text.to_ascii_lowercase();
    let begins = wanted.len() >= 3 && name != wanted && name.starts_with(&wanted);
    let steps = if begins { 1 } else { distance(&wanted, name) };
    (steps <= 1 + name.len().min(wanted.len()) / 4).then_some(steps)
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
    let near = |(name, stands_for)| Some((nearness(text, name)?, stands_for));
    let mut ranked: Vec<(usize, &str)> = entries.filter_map(near).collect();
    ranked.sort();
    let mut nearest: Vec<&str> = Vec::new();
    for (_, name) in &ranked {
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
        assert!(kernel("cubicsplin").unwrap_err().contains("`cubic-spline`"));
        let key = misspelt_key("unknown field `equation`, expected one of `name`, `equations`");
        assert!(key.ends_with("did you mean `equations`?"), "{key}");
        assert!(!kernel("zzz").unwrap_err().contains("did you mean"));
        assert_eq!(nearest("GPH3", ["gph1", "gph3", "gph33"].into_iter()), Some("gph3"));
    }
}
