//! Names of kernels and schemes, with a suggestion when one is misspelt.

use courant::analysis::kernel::Kernel;
use courant::analysis::scheme::AdvectionScheme;

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

/// What to say of a name that is none: the nearest one, and all of them.
pub fn unknown(what: &str, text: &str, all: &[&str]) -> String {
    with_aliases(what, text, all, std::iter::empty())
}

fn with_aliases<'a>(
    what: &str,
    text: &str,
    all: &[&'a str],
    aliases: impl Iterator<Item = &'a str>,
) -> String {
    let wanted = text.to_ascii_lowercase();
    let names = all.iter().copied().chain(aliases);
    let nearest = names.map(|name| (distance(&wanted, name), name)).min();
    let hint = match nearest {
        Some((steps, name)) if steps <= 1 + name.len() / 3 => format!("did you mean `{name}`? "),
        _ => String::new(),
    };
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
        assert!(!kernel("zzz").unwrap_err().contains("did you mean"));
    }
}
