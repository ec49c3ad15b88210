//! All particles and their ghosts, from left to right.

use crate::boundary::Boundary;

/// A particle or the image of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Body {
    /// Where it is.
    pub x: f64,
    /// The particle whose state it has.
    pub owner: usize,
    /// Whether it is an image.
    pub ghost: bool,
}

/// Particles and ghosts sorted by position.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    order: Vec<usize>,
    sorted: Vec<Body>,
}

impl Bodies {
    pub fn new(particles: usize) -> Self {
        Self { order: (0..particles).collect(), sorted: Vec::new() }
    }

    /// Sorts the particles and adds ghosts up to `reach` beyond the ends.
    pub fn arrange(&mut self, x: &[f64], boundary: Boundary, domain: [f64; 2], reach: f64) {
        // Equal positions are told apart by index, so that the order is the same on every machine.
        self.order.sort_unstable_by(|&a, &b| x[a].total_cmp(&x[b]).then(a.cmp(&b)));
        let order = &self.order;
        let count = order.len();
        let body = |index: usize, x: f64, ghost: bool| Body { x, owner: order[index], ghost };
        self.sorted.clear();
        match boundary {
            // The scenes of this method have no others.
            Boundary::Transmissive | Boundary::Mirror | Boundary::Open => {
                let (first, last) = (x[order[0]], x[order[count - 1]]);
                let left = x[order[1]] - first;
                let right = last - x[order[count - 2]];
                // Particles that meet at an end must not ask for endless ghosts.
                let needed = |gap: f64| ((reach / gap).ceil()).min(count as f64) as usize;
                for j in (1..=needed(left)).rev() {
                    self.sorted.push(body(0, first - j as f64 * left, true));
                }
                self.sorted.extend((0..count).map(|i| body(i, x[order[i]], false)));
                for j in 1..=needed(right) {
                    self.sorted.push(body(count - 1, last + j as f64 * right, true));
                }
            }
            Boundary::Periodic => {
                let period = domain[1] - domain[0];
                let (first, last) = (x[order[0]], x[order[count - 1]]);
                let images =
                    |shift: f64| (0..count).map(move |i| body(i, x[order[i]] + shift, true));
                self.sorted.extend(images(-period).filter(|ghost| ghost.x >= first - reach));
                self.sorted.extend((0..count).map(|i| body(i, x[order[i]], false)));
                self.sorted.extend(images(period).filter(|ghost| ghost.x <= last + reach));
            }
        }
    }

    /// Calls `visit(particle, neighbour)` for every particle and every body (itself included) no
    /// farther than `reach(particle)`, in a fixed order.
    pub fn for_each_pair(
        &self,
        reach: impl Fn(usize) -> f64,
        mut visit: impl FnMut(usize, &Body, f64),
    ) {
        for (place, here) in self.sorted.iter().enumerate().filter(|(_, body)| !body.ghost) {
            let far = reach(here.owner);
            let before = self.sorted[..place].iter().rev();
            let behind = self.sorted[place..].iter();
            for other in before.take_while(|other| here.x - other.x <= far) {
                visit(here.owner, other, here.x - other.x);
            }
            for other in behind.take_while(|other| other.x - here.x <= far) {
                visit(here.owner, other, here.x - other.x);
            }
        }
    }
}
