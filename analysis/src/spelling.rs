//! Names as people type them.

/// Whether a text is a name, however it is capitalised and whatever joins its words: `WendlandC2` and `wendland_c2` are
/// `wendland-c2`.
///
/// ```
/// use courant_analysis::spelling::spells;
/// assert!(spells("WendlandC2", "wendland-c2") && spells(" leap frog", "leapfrog"));
/// assert!(!spells("wendland", "wendland-c2"));
/// ```
pub fn spells(text: &str, name: &str) -> bool {
    let letters = |text: &str| -> String {
        let kept = text.chars().filter(|c| !matches!(c, '-' | '–' | '_' | ' '));
        kept.map(|c| c.to_ascii_lowercase()).collect()
    };
    letters(text) == letters(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::scheme::catalogue;

    #[test]
    fn no_two_names_are_spelt_alike() {
        let kernels = Kernel::ALL
            .iter()
            .flat_map(|one| std::iter::once(one.name()).chain(one.aliases().iter().copied()));
        let integrators = catalogue::integrators()
            .iter()
            .flat_map(|one| [&one.name].into_iter().chain(&one.aliases).map(String::as_str));
        let files = |all: &'static [catalogue::SchemeFile]| all.iter().map(|one| one.name.as_str());
        let lists: [Vec<&str>; 5] = [
            kernels.collect(),
            integrators.collect(),
            files(catalogue::schemes()).collect(),
            files(catalogue::spaces()).collect(),
            files(catalogue::methods()).collect(),
        ];
        for names in lists {
            for name in &names {
                let alike: Vec<_> = names.iter().filter(|other| spells(name, other)).collect();
                assert_eq!(alike, [name]);
            }
        }
    }
}
