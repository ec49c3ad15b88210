//! One step of Maxwell's equations in the plane (Yee's lattice, transverse magnetic) as a filter of `.npy` files, for `courant probe`.
//!
//! The electric field Ez stands at the corners of cells, Hx and Hy on their sides; `C = c Δt/Δ`. Files are read and written without
//! any library.
//!
//! ```text
//! cargo build --example probe_step
//! courant probe --unknowns E,Hx,Hy --size 16,16 -- target/debug/examples/probe_step {in} {out} {C}
//! ```

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().collect();
    let [_, read, write, courant] = words.as_slice() else {
        return Err("probe_step IN.npy OUT.npy C".into());
    };
    let c: f64 = courant.parse()?;
    // What is written begins with what was read: shape and type are the same.
    let mut bytes = std::fs::read(read)?;
    let begin = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (shape, mut state) = parsed(&bytes, begin)?;
    let [3, n, m] = shape[..] else { return Err("three fields in the plane are needed".into()) };
    step(&mut state, n, m, c);
    bytes.truncate(begin);
    bytes.extend(state.iter().flat_map(|value| value.to_le_bytes()));
    std::fs::write(write, bytes)?;
    Ok(())
}

/// The shape in the header and the numbers behind it.
fn parsed(bytes: &[u8], begin: usize) -> Result<(Vec<usize>, Vec<f64>), Box<dyn Error>> {
    let header = std::str::from_utf8(&bytes[10..begin])?;
    let (_, shape) = header.split_once("'shape': (").ok_or("no shape")?;
    let (shape, _) = shape.split_once(')').ok_or("no shape")?;
    let sizes = shape.split(',').map(str::trim).filter(|size| !size.is_empty());
    let shape = sizes.map(str::parse).collect::<Result<_, _>>()?;
    let numbers = bytes[begin..].chunks_exact(8);
    let numbers =
        numbers.map(|eight| f64::from_le_bytes([0, 1, 2, 3, 4, 5, 6, 7].map(|i| eight[i])));
    Ok((shape, numbers.collect()))
}

/// Hx and Hy by the curl of Ez, then Ez by the curl of the new ones.
fn step(state: &mut [f64], n: usize, m: usize, c: f64) {
    let (electric, magnetic) = state.split_at_mut(n * m);
    let (hx, hy) = magnetic.split_at_mut(n * m);
    let at = |i: usize, j: usize| i % n * m + j % m;
    for i in 0..n {
        for j in 0..m {
            hx[at(i, j)] -= c * (electric[at(i, j + 1)] - electric[at(i, j)]);
            hy[at(i, j)] += c * (electric[at(i + 1, j)] - electric[at(i, j)]);
        }
    }
    for i in 0..n {
        for j in 0..m {
            let curl = hy[at(i, j)] - hy[at(i + n - 1, j)] - hx[at(i, j)] + hx[at(i, j + m - 1)];
            electric[at(i, j)] += c * curl;
        }
    }
}
