//! Long work, and the thread that watches it.

use courant_analysis::interest::Interest;
use courant_analysis::stability::SearchPlan;
use courant_analysis::waves::sweep::{Progress, SweepError};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// How often Python is asked whether to stop.
const LOOK: Duration = Duration::from_millis(100);

/// What work tells the thread that watches it, and hears from it.
pub struct Watch<'a> {
    /// Told of every point that is done.
    pub progress: Progress<'a>,
    /// Lost when the user interrupts, or what is told of progress raises.
    pub interest: Interest,
}

impl Watch<'_> {
    /// A plan that is given up with the work.
    pub fn plan(&self, plan: SearchPlan) -> SearchPlan {
        plan.while_wanted(self.interest.clone())
    }

    /// What `of` makes of all items, in parallel and in their order.
    pub fn over<Item: Send, T: Send>(
        &self,
        items: impl IndexedParallelIterator<Item = Item>,
        of: impl Fn(Item) -> T + Sync + Send,
    ) -> Result<Vec<T>, SweepError> {
        let wanted =
            |item| if self.interest.is_lost() { Err(SweepError::Cancelled) } else { Ok(of(item)) };
        items.map(wanted).collect()
    }
}

/// Does long work in another thread, without the interpreter's lock. Meanwhile this thread tells `report` how much is done, and interest in the
/// work is lost when the user interrupts or `report` raises: that is the outer error, the inner one is the work's own.
pub fn watched<T: Send, E: Send>(
    py: Python<'_>,
    report: Option<Py<PyAny>>,
    work: impl FnOnce(&Watch<'_>) -> Result<T, E> + Send,
) -> PyResult<Result<T, E>> {
    let (done, all) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let stop = Arc::new(AtomicBool::new(false));
    let stops = || stop.load(Ordering::Relaxed);
    let advance = |now: usize, of: usize| {
        all.store(of, Ordering::Relaxed);
        done.fetch_max(now, Ordering::Relaxed);
        if stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let tell = |py: Python<'_>| -> PyResult<()> {
        py.check_signals()?;
        let (done, all) = (done.load(Ordering::Relaxed), all.load(Ordering::Relaxed));
        match &report {
            Some(report) if all > 0 => report.call1(py, (done, all)).map(|_| ()),
            _ => Ok(()),
        }
    };
    let asked = Arc::clone(&stop);
    let interest = Interest::as_long_as(move || !asked.load(Ordering::Relaxed));
    let watch = Watch { progress: &advance, interest };
    let raised = Mutex::new(None);
    let found = py.detach(|| {
        let (ended, end) = channel();
        std::thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let found = work(&watch);
                // Nobody listens any more only where the other thread has panicked.
                let _ = ended.send(());
                found
            });
            while end.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                if stops() {
                    continue;
                }
                if let Err(error) = Python::attach(tell) {
                    stop.store(true, Ordering::Relaxed);
                    raised.lock().map(|mut raised| *raised = Some(error)).unwrap_or_default();
                }
            }
            worker.join()
        })
    });
    if let Some(error) = raised.into_inner().unwrap_or_default() {
        return Err(error);
    }
    match found {
        Ok(found) => {
            tell(py)?;
            Ok(found)
        }
        Err(panic) => std::panic::resume_unwind(panic),
    }
}
