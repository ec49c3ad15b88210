//! Seconds of a wall clock, for what stands beside counted work.

use std::time::Instant;

/// The result of some work and the seconds it took on one thread of its own: what else is done at the time takes no
/// turn on it, so that on a machine with a free core these are the seconds of a processor.
pub fn timed<T: Send>(work: impl FnOnce() -> T + Send) -> (T, f64) {
    let measured = || {
        let start = Instant::now();
        let result = work();
        (result, start.elapsed().as_secs_f64())
    };
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(measured),
        Err(_) => measured(),
    }
}
