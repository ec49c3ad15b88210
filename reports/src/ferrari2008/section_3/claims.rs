//! What section 3.3 says of its figures.

use super::{text, tubes};
use crate::claim::{Claim, Claims, rows};
use crate::page::Item;
use crate::study::riemann_measures::measure;
use crate::study::riemann_run::{RiemannRun, with_option};
use crate::study::tubes::{method, tube};
use std::borrow::Cow;

/// The table of claims.
pub fn table(runs: &[RiemannRun]) -> Item {
    let claims = Claims::from_toml(include_str!("../../../papers/ferrari2008/claims.toml"))
        .expect("the file of claims is read by a test");
    let found = claims
        .judge(|claim, name, arguments, member| {
            measure(run(runs, claim, member)?.as_ref(), name, arguments)
        })
        .expect("the claims are judged by a test");
    text().table("section_3_statements", &[], rows(&found))
}

/// The run of a claim's test by a member: a method, with options where it is not run as in the figures.
fn run<'a>(runs: &'a [RiemannRun], claim: &Claim, member: &str) -> Option<Cow<'a, RiemannRun>> {
    let test = claim.place.strip_prefix("test ")?;
    let Some((name, option)) = member.split_once(' ') else {
        let mut runs = runs.iter();
        let found = runs.find(|run| run.test == test && run.method.name() == member)?;
        return Some(Cow::Borrowed(found));
    };
    let tubes = tubes();
    let (_, scene) = tubes.tests.iter().find(|(name, _)| name == test)?;
    let method = with_option(method(name), option)?;
    Some(Cow::Owned(RiemannRun::new(test, tube(scene), method, tubes.particles)))
}
