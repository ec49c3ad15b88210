//! What stands in the brackets of `u[n+1,j]` and `w[k]`: an unknown on the lattice or a lattice weight.

use super::affine::{Affine, whole};
use super::error::Problem;
use super::syntax::{Expression, Node, Offset, Span, Unknown, Weight};
use crate::exact::rational::{Rational, integer};
use num_traits::{One, Zero};

/// No scheme reaches farther, in levels or cells.
const FARTHEST: i32 = 1000;

/// `name[items]` or `name[items]'`, not yet understood.
pub(super) struct Bracketed<'t> {
    pub name: &'t str,
    pub items: Vec<Expression>,
    pub derivative: bool,
    /// From the name to the closing bracket or the prime.
    pub span: Span,
    /// The running index of the sum around it.
    pub running: Option<&'t str>,
}

/// One item, with its place.
struct Item {
    value: Affine,
    span: Span,
}

impl Item {
    fn has(&self, name: &str) -> bool {
        self.value.multiples.contains_key(name)
    }

    /// Where a name stands in it.
    fn place(&self, name: &str) -> Span {
        self.value.multiples.get(name).map_or(self.span.clone(), |(_, span)| span.clone())
    }
}

impl Bracketed<'_> {
    /// The index decides: with `n`, `i` or `j` in it the name is an unknown; without, `W`, `w` and `v` are
    /// weights.
    pub(super) fn resolve(self) -> Result<Node, Problem> {
        let weight = match self.name {
            "W" => Some(Weight::Value),
            "w" => Some(Weight::Slope),
            "v" => Some(Weight::Curvature),
            _ => None,
        };
        let items = self.items.iter().map(|item| self.read(item)).collect::<Result<Vec<_>, _>>()?;
        let on_lattice = ["n", "i", "j"];
        match (weight, items.as_slice()) {
            (Some(weight), [item]) if !on_lattice.iter().any(|name| item.has(name)) => {
                self.weight(weight, item)
            }
            _ => self.unknown(&items),
        }
    }

    fn problem<T>(&self, message: impl Into<String>, span: Span) -> Result<T, Problem> {
        Err(Problem::new(message, span))
    }

    fn is_running(&self, name: &str) -> bool {
        self.running == Some(name)
    }

    /// One item as a number plus multiples of the names an index may hold.
    fn read(&self, item: &Expression) -> Result<Item, Problem> {
        let value = Affine::of(item).or_else(|span| {
            self.problem("not understood in an index; write j, j+1, j-1/2 or, in a sum, j+k", span)
        })?;
        let known = |name: &str| ["n", "i", "j", "k"].contains(&name) || self.is_running(name);
        match value.multiples.iter().find(|(name, _)| !known(name)) {
            None => Ok(Item { value, span: item.span.clone() }),
            Some((name, (_, span))) => self.problem(
                format!(
                    "`{name}` in an index; an index holds n, j (or i,j or i,j,k), the running index of a sum, and numbers"
                ),
                span.clone(),
            ),
        }
    }

    fn weight(&self, weight: Weight, item: &Item) -> Result<Node, Problem> {
        let name = self.name;
        if self.derivative {
            let message = format!("the weight {name}[…] has no time derivative");
            return self.problem(message, self.span.clone());
        }
        if let Some(other) = item.value.multiples.keys().find(|name| !self.is_running(name)) {
            let message = match self.running {
                Some(running) => {
                    format!(
                        "`{other}` is not the running index of the sum around it; that is {running}"
                    )
                }
                None => {
                    format!("`{name}[{other}]` stands in no sum; write sum({other}, …) around it")
                }
            };
            return self.problem(message, item.place(other));
        }
        let offset = self.offset(item)?;
        if offset.halves % 2 != 0 {
            let message = format!("the offset of the weight {name} is not an integer");
            return self.problem(message, item.span.clone());
        }
        Ok(Node::Weight { weight, offset })
    }

    fn unknown(&self, items: &[Item]) -> Result<Node, Problem> {
        let name = self.name;
        let (time, space) = match items.split_first() {
            Some((first, rest)) if first.has("n") => (Some(first), rest),
            _ => (None, items),
        };
        if let Some(item) = space.iter().find(|item| item.has("n")) {
            let message = "the time index n stands first, and once; write u[n+1,j]";
            return self.problem(message, item.place("n"));
        }
        let axes: &[&str] = match space.len() {
            0 => {
                let message = format!("`{name}` has no index in space; write {name}[n,j]");
                return self.problem(message, self.span.clone());
            }
            1 => &["j"],
            2 => &["i", "j"],
            3 => &["i", "j", "k"],
            _ => {
                let message =
                    "more than three indices in space; write u[n,j], u[n,i,j] or u[n,i,j,k]";
                return self.problem(message, self.span.clone());
            }
        };
        let time = time.map(|item| self.time(item)).transpose()?;
        if let (Some(_), true) = (time, self.derivative) {
            let message = format!(
                "a time derivative has no time index (method of lines); write {name}[{}]'",
                axes.join(",")
            );
            return self.problem(message, self.span.clone());
        }
        let space = space
            .iter()
            .zip(axes)
            .map(|(item, axis)| self.cell(item, axis, axes))
            .collect::<Result<_, _>>()?;
        Ok(Node::Unknown(Unknown { name: name.into(), time, space, derivative: self.derivative }))
    }

    fn time(&self, item: &Item) -> Result<Offset, Problem> {
        if let Some(other) = item.value.multiples.keys().find(|name| *name != "n") {
            let message = format!("`{other}` in the time index; write n, n+1, n-1/2");
            return self.problem(message, item.place(other));
        }
        self.stands_alone(item, "n")?;
        self.offset(item)
    }

    fn cell(&self, item: &Item, axis: &str, axes: &[&str]) -> Result<Offset, Problem> {
        let all = axes.join(",");
        if self.is_running(axis) {
            let message = format!(
                "{axis} is an axis of {all} and cannot be the running index of the sum; call that m, as in sum(m, …)"
            );
            return self.problem(message, item.place(axis));
        }
        let other = |name: &&String| *name != axis && !self.is_running(name);
        if let Some(other) = item.value.multiples.keys().find(other) {
            let message = match (other.as_str(), axes.len()) {
                ("k", 1 | 2) if axes.len() == 1 || item.has(axis) => {
                    "k is the running index of no sum around it; write j+k inside sum(k, …)".into()
                }
                (_, count) => format!(
                    "`{other}` stands where {axis} belongs: with {count} {} in space the order is {all}",
                    if count == 1 { "index" } else { "indices" }
                ),
            };
            return self.problem(message, item.place(other));
        }
        if !item.has(axis) {
            let message =
                format!("an index is relative to {axis}; write {axis}, {axis}+1, {axis}-1/2");
            return self.problem(message, item.span.clone());
        }
        self.stands_alone(item, axis)?;
        self.offset(item)
    }

    fn stands_alone(&self, item: &Item, name: &str) -> Result<(), Problem> {
        if item.value.multiple(name).is_one() {
            return Ok(());
        }
        let message =
            format!("{name} has the factor 1 in an index; write {name}, {name}+1, {name}-1/2");
        self.problem(message, item.span.clone())
    }

    /// The constant part in halves and the multiple of the running index.
    fn offset(&self, item: &Item) -> Result<Offset, Problem> {
        let Some(halves) = whole(&(&item.value.constant * integer(2)), 2 * FARTHEST) else {
            let message = format!("the offset is not an integer or a half up to {FARTHEST}");
            return self.problem(message, item.span.clone());
        };
        let multiple = self.running.map_or_else(Rational::zero, |name| item.value.multiple(name));
        let Some(index) = whole(&multiple, FARTHEST) else {
            let message = "the running index has an integer factor in an index";
            return self.problem(message, item.span.clone());
        };
        Ok(Offset { halves, index })
    }
}
