//! Equations as text that is read when it is first asked for: a catalogue has many, of which a command needs one.

use crate::scheme::language::parse;
use crate::scheme::language::syntax::Equations;
use std::ops::Deref;
use std::sync::OnceLock;

/// Equations of which the text is known to be understood; stands for the tree.
#[derive(Debug, Clone)]
pub struct EquationText {
    text: String,
    tree: OnceLock<Equations>,
}

impl EquationText {
    /// Equations that a test reads, so that none is refused later.
    pub(super) fn unread(text: String) -> Self {
        Self { text, tree: OnceLock::new() }
    }
}

impl From<Equations> for EquationText {
    fn from(tree: Equations) -> Self {
        Self { text: String::new(), tree: OnceLock::from(tree) }
    }
}

impl Deref for EquationText {
    type Target = Equations;

    fn deref(&self) -> &Equations {
        let tree = || parse(&self.text).unwrap_or_else(|error| panic!("{}: {error}", self.text));
        self.tree.get_or_init(tree)
    }
}

impl PartialEq for EquationText {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}
