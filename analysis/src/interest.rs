//! Whether an answer is still wanted.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether somebody still waits for an answer. Long work asks before every box it looks at and ends early where nobody does: what is left is undecided, and
/// whoever asked hears [`Cancelled`](crate::scheme::SchemeError::Cancelled). By what interest is lost, a signal, a clock, a window that was closed,
/// is no business of the mathematics.
///
/// ```
/// use courant_analysis::interest::Interest;
/// use courant_analysis::scheme::{SchemeError, Step};
/// use courant_analysis::stability::SearchPlan;
/// let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
/// let lost = SearchPlan::default().while_wanted(Interest::as_long_as(|| false));
/// assert_eq!(upwind.stable_set("C", &lost), Err(SchemeError::Cancelled));
/// # Ok::<(), SchemeError>(())
/// ```
#[derive(Clone, Default)]
pub struct Interest(Option<Arc<dyn Fn() -> bool + Send + Sync>>);

impl Interest {
    /// As long as a function says so; it is not asked again after a no. It is called often, and from several threads.
    pub fn as_long_as(wanted: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        // What one place took for lost no other may take for wanted: half an answer would look whole.
        let lost = AtomicBool::new(false);
        Self(Some(Arc::new(move || {
            if !lost.load(Ordering::Relaxed) && !wanted() {
                lost.store(true, Ordering::Relaxed);
            }
            !lost.load(Ordering::Relaxed)
        })))
    }

    /// Whether nobody waits any longer; never, by default.
    pub fn is_lost(&self) -> bool {
        self.0.as_ref().is_some_and(|wanted| !wanted())
    }
}

impl fmt::Debug for Interest {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(if self.0.is_some() { "Interest(for now)" } else { "Interest(always)" })
    }
}

/// The interest of the same asker.
impl PartialEq for Interest {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(one), Some(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::rational::integer;
    use crate::scheme::{Integrator, SchemeError, Step, catalogue};
    use crate::stability::SearchPlan;
    use crate::stability::verdict::check;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Interest that is lost when it has been asked so often, and how often it was asked.
    fn asked(times: usize) -> (Interest, Arc<AtomicUsize>) {
        let count = Arc::new(AtomicUsize::new(0));
        let counter = Arc::clone(&count);
        (Interest::as_long_as(move || counter.fetch_add(1, Ordering::Relaxed) < times), count)
    }

    /// How often a question asks, and how often more than it should when interest is lost on the way.
    fn loses<T: std::fmt::Debug>(
        question: impl Fn(SearchPlan) -> Result<T, SchemeError>,
    ) -> (usize, usize) {
        let with = |times| {
            let (interest, count) = asked(times);
            let answer = question(SearchPlan::default().while_wanted(interest));
            (answer, count.load(Ordering::Relaxed))
        };
        let (answer, all) = with(usize::MAX);
        assert!(answer.is_ok());
        let late = [0, 1, all / 4, all / 2, all - 1].map(|times| {
            let (answer, asked) = with(times);
            assert_eq!(answer.unwrap_err(), SchemeError::Cancelled);
            asked - times
        });
        (all, late.into_iter().max().unwrap())
    }

    fn named(space: &str, integrator: &str) -> Step {
        let integrator = Integrator::named(integrator).unwrap();
        catalogue::space(space).unwrap().step(None, Some(integrator), &[], Some("C")).unwrap()
    }

    #[test]
    fn lost_interest_ends_a_decision_at_its_next_box() {
        // Boxes of one variable, cubes of waves, and an unstable stretch that is halved.
        let cube = "u[n+1,i,j,k] = u[n,i,j,k] - C*(u[n,i,j,k] - u[n,i-1,j,k]) \
                    - C/2*(u[n,i,j+1,k] - u[n,i,j-1,k]) + C/2*(u[n,i,j+1,k] - 2*u[n,i,j,k] + u[n,i,j-1,k]) \
                    - C*(u[n,i,j,k] - u[n,i,j,k-1])";
        for step in [named("upwind-5", "rk4"), named("dg-1", "rk4"), Step::from_text(cube).unwrap()]
        {
            let (all, late) = loses(|plan| step.stable_set("C", &plan));
            assert!(all > 5 && late < 200, "{all} {late}");
            let (all, late) = loses(|plan| check(&step, "C", &integer(1), &plan));
            assert!(all > 5 && late < 200, "{all} {late}");
        }
    }

    #[test]
    fn who_is_asked_changes_no_answer() {
        let (step, plan) = (named("upwind-3", "rk3-ssp"), SearchPlan::default());
        let (interest, _) = asked(usize::MAX);
        let watched = plan.clone().while_wanted(interest);
        assert_eq!(step.stable_set("C", &watched), step.stable_set("C", &plan));
        assert!(
            watched != plan && watched == watched.clone() && format!("{plan:?}").contains("always")
        );
    }
}
