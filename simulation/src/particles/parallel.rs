//! Work shared among threads in pieces that do not depend on how many threads there are.

use rayon::prelude::*;

/// Fewer values than this are not worth waking another thread.
const WORTH_SHARING: usize = 4096;
/// Nor are fewer blocks of particles.
const WORTH_SHARING_BLOCKS: usize = 5;

/// Runs a task on every block.
pub(super) fn for_each_block<T: Send>(blocks: &mut [T], task: impl Fn(&mut T) + Sync + Send) {
    if blocks.len() < WORTH_SHARING_BLOCKS {
        blocks.iter_mut().for_each(task);
    } else {
        blocks.par_iter_mut().for_each(task);
    }
}

/// `into[i] = value(i)` for `i < count`.
pub(super) fn fill<T: Send>(
    into: &mut Vec<T>,
    count: usize,
    value: impl Fn(usize) -> T + Sync + Send,
) {
    if count < WORTH_SHARING {
        into.clear();
        into.extend((0..count).map(value));
    } else {
        (0..count)
            .into_par_iter()
            .with_min_len(WORTH_SHARING / 2)
            .map(value)
            .collect_into_vec(into);
    }
}

/// The largest of `value(i)` for `i < count`; 0 if none is larger.
pub(super) fn largest(count: usize, value: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    if count < WORTH_SHARING {
        (0..count).map(value).fold(0.0, f64::max)
    } else {
        let values = (0..count).into_par_iter().with_min_len(WORTH_SHARING / 2).map(value);
        values.reduce(|| 0.0, f64::max)
    }
}

/// The first `i < count` with a property.
pub(super) fn first(count: usize, has: impl Fn(usize) -> bool + Sync + Send) -> Option<usize> {
    if count < WORTH_SHARING {
        (0..count).find(|&i| has(i))
    } else {
        (0..count).into_par_iter().with_min_len(WORTH_SHARING / 2).find_first(|&i| has(i))
    }
}
