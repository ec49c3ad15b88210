//! A sink: the point mass that stands for what has become too dense to follow.

use super::softening::{SUPPORT, attraction, potential};
use crate::particles::{Particles, Vector, dot, plus_scaled};

/// A particle without pressure that takes up what falls into it. Bate, Bonnell & Price (1995), section 2.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sink {
    /// Where it is.
    pub position: Vector<3>,
    /// How it moves.
    pub velocity: Vector<3>,
    /// What it holds.
    pub mass: f64,
    /// Gas farther out is safe. It is also where the sink's own attraction becomes that of a point: inside it is
    /// spread like the cubic spline.
    pub radius: f64,
    /// Angular momentum taken up, about the sink.
    pub spin: Vector<3>,
    /// Energy taken up: what particles had about the sink, of motion and of attraction by it.
    pub energy: f64,
    /// How many particles it has taken.
    pub taken: usize,
}

/// Inside this part of the radius everything is taken, bound or not.
const CORE: f64 = 0.1;

impl Sink {
    /// A sink at rest.
    pub fn new(position: Vector<3>, mass: f64, radius: f64) -> Self {
        Self { position, velocity: [0.0; 3], mass, radius, spin: [0.0; 3], energy: 0.0, taken: 0 }
    }

    /// `M f(r) d`: its attraction on what is at `x`, over `G`.
    #[inline]
    pub fn attraction(&self, x: &Vector<3>) -> Vector<3> {
        let d = plus_scaled(&self.position, -1.0, x);
        let strength = self.mass * attraction(dot(&d, &d).sqrt(), self.radius / SUPPORT);
        d.map(|component| strength * component)
    }

    /// The potential over `G` at `x`.
    pub fn depth(&self, x: &Vector<3>) -> f64 {
        let d = plus_scaled(&self.position, -1.0, x);
        self.mass * potential(dot(&d, &d).sqrt(), self.radius / SUPPORT)
    }

    /// Whether a particle is to be taken: inside the radius, bound, and with less angular momentum than a circular orbit there; or in
    /// the core.
    ///
    /// ```
    /// use courant_simulation::gravity::Sink;
    /// let sink = Sink::new([0.0; 3], 1.0, 0.1);
    /// let x = [0.05, 0.0, 0.0];
    /// assert!(sink.takes(&x, &[-1.0, 0.0, 0.0], 1.0));
    /// assert!(!sink.takes(&x, &[0.0, 6.4, 0.0], 1.0)); // on the way out again
    /// assert!(!sink.takes(&[0.2, 0.0, 0.0], &[0.0; 3], 1.0));
    /// ```
    pub fn takes(&self, x: &Vector<3>, v: &Vector<3>, constant: f64) -> bool {
        let d = plus_scaled(x, -1.0, &self.position);
        let square = dot(&d, &d);
        if square >= self.radius * self.radius {
            return false;
        }
        if square <= (CORE * self.radius).powi(2) {
            return true;
        }
        let w = plus_scaled(v, -1.0, &self.velocity);
        let attracted = constant * self.mass;
        let spin = cross(&d, &w);
        0.5 * dot(&w, &w) + constant * self.depth(x) < 0.0
            && dot(&spin, &spin) < attracted * self.radius
    }

    /// Takes a particle up: mass, momentum and angular momentum go over, the place moves to the centre of mass.
    pub fn take(&mut self, x: &Vector<3>, v: &Vector<3>, mass: f64, constant: f64) {
        let total = self.mass + mass;
        let d = plus_scaled(x, -1.0, &self.position);
        let w = plus_scaled(v, -1.0, &self.velocity);
        let reduced = if total > 0.0 { self.mass * mass / total } else { 0.0 };
        self.spin = plus_scaled(&self.spin, reduced, &cross(&d, &w));
        self.energy += 0.5 * reduced * dot(&w, &w) + constant * mass * self.depth(x);
        let share = mass / total;
        self.position = plus_scaled(&self.position, share, &d);
        self.velocity = plus_scaled(&self.velocity, share, &w);
        self.mass = total;
        self.taken += 1;
    }

    /// Gives it momentum.
    pub(super) fn push(&mut self, momentum: &Vector<3>) {
        self.velocity = plus_scaled(&self.velocity, 1.0 / self.mass, momentum);
    }

    /// Takes the marked particles up, in their order; whether there were any.
    pub(super) fn swallow<T>(
        &mut self,
        particles: &Particles<3, T>,
        marked: &[bool],
        constant: f64,
    ) -> bool {
        let before = self.taken;
        for (i, _) in marked.iter().enumerate().filter(|(_, marked)| **marked) {
            let (x, v) = (&particles.position[i], &particles.velocity[i]);
            self.take(x, v, particles.mass[i], constant);
        }
        self.taken > before
    }
}

/// `a × b`.
pub fn cross(a: &Vector<3>, b: &Vector<3>) -> Vector<3> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_up_is_kept() {
        let mut sink = Sink::new([0.1, 0.0, 0.0], 1.0, 0.2);
        sink.velocity = [0.0, 0.3, 0.0];
        let parts = [([0.15, 0.1, 0.0], [-0.4, 0.1, 0.2], 0.25), ([0.0, 0.0, 0.05], [0.3; 3], 0.5)];
        let particles = Particles {
            position: parts.map(|part| part.0).to_vec(),
            velocity: parts.map(|part| part.1).to_vec(),
            mass: parts.map(|part| part.2).to_vec(),
            thermal: vec![(); 2],
            smoothing: vec![0.1; 2],
        };
        let momentum = |sink: &Sink| sink.velocity.map(|v| v * sink.mass);
        let orbit = |m: f64, x: &Vector<3>, v: &Vector<3>| cross(x, v).map(|l| m * l);
        let (mut total, mut turning) =
            (momentum(&sink), orbit(sink.mass, &sink.position, &sink.velocity));
        for (x, v, m) in &parts {
            total = plus_scaled(&total, *m, v);
            turning = plus_scaled(&turning, 1.0, &orbit(*m, x, v));
        }
        assert!(sink.swallow(&particles, &[true, true], 1.0));
        let after = plus_scaled(&orbit(sink.mass, &sink.position, &sink.velocity), 1.0, &sink.spin);
        assert!(sink.taken == 2 && sink.mass == 1.75);
        for axis in 0..3 {
            assert!((momentum(&sink)[axis] - total[axis]).abs() < 1e-15);
            assert!((after[axis] - turning[axis]).abs() < 1e-15);
        }
    }
}
