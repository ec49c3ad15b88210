//! Work shared among threads in pieces that do not depend on how many threads there are.
//!
//! What is shared is asked for by reference, once for each piece: the machinery of threads is compiled for each type of value
//! and not for each loop.

use rayon::prelude::*;
use std::ops::Range;

/// Fewer values than this are not worth waking another thread.
const WORTH_SHARING: usize = 4096;
/// So many are a piece.
const PIECE: usize = 2048;
/// Nor are fewer blocks of particles.
const WORTH_SHARING_BLOCKS: usize = 5;

/// Runs a task on every block.
pub(super) fn for_each_block<T: Send>(blocks: &mut [T], task: &(dyn Fn(&mut T) + Sync)) {
    if blocks.len() < WORTH_SHARING_BLOCKS {
        blocks.iter_mut().for_each(task);
    } else {
        blocks.par_iter_mut().for_each(task);
    }
}

/// `into[i] = value(i)` for `i < count`. `value` depends on nothing but `i`.
pub(super) fn fill<T: Copy + Send>(
    into: &mut Vec<T>,
    count: usize,
    value: impl Fn(usize) -> T + Sync,
) {
    into.truncate(count);
    if into.len() < count {
        into.resize(count, value(0));
    }
    fill_pieces(into, &|start, piece| {
        for (place, i) in piece.iter_mut().zip(start..) {
            *place = value(i);
        }
    });
}

fn fill_pieces<T: Send>(into: &mut [T], task: &(dyn Fn(usize, &mut [T]) + Sync)) {
    if into.len() < WORTH_SHARING {
        task(0, into);
    } else {
        let pieces = into.par_chunks_mut(PIECE).enumerate();
        pieces.for_each(|(index, piece)| task(index * PIECE, piece));
    }
}

/// The largest of `value(i)` for `i < count`; 0 if none is larger.
pub(super) fn largest(count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let of = |range: Range<usize>| Some(range.map(&value).fold(0.0, f64::max));
    over_pieces(count, &of, &f64::max).unwrap_or(0.0)
}

/// The first `i < count` with a property.
pub(super) fn first(count: usize, has: impl Fn(usize) -> bool + Sync) -> Option<usize> {
    over_pieces(count, &|mut range| range.find(|&i| has(i)), &usize::min)
}

/// The best of what is found in the pieces of `0..count`.
fn over_pieces<T: Send>(
    count: usize,
    find: &(dyn Fn(Range<usize>) -> Option<T> + Sync),
    better: &(dyn Fn(T, T) -> T + Sync),
) -> Option<T> {
    if count < WORTH_SHARING {
        return find(0..count);
    }
    let pieces = (0..count.div_ceil(PIECE)).into_par_iter();
    pieces.filter_map(|k| find(k * PIECE..count.min((k + 1) * PIECE))).reduce_with(better)
}
