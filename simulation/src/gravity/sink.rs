//! A sink: the point mass that stands for what has become too dense to follow.

use super::softening::{SUPPORT, attraction, potential};
use crate::particles::{Particles, ThermalState, Vector, dot, plus_scaled};

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
}

/// A sink or none, `()`.
pub trait MaybeSink: Clone + std::fmt::Debug + Send + Sync {
    /// The sink, if it is one.
    fn state(&self) -> Option<&Sink>;

    /// The potential over `G` at `x`.
    fn potential(&self, x: &Vector<3>) -> f64;

    /// Its attraction on the active particles, and which of them it will take.
    fn look<T: ThermalState>(
        &self,
        particles: &Particles<3, T>,
        active: impl Fn(usize) -> bool,
        constant: f64,
        pull: &mut Vec<Vector<3>>,
        marked: &mut [bool],
    );

    /// Gives it momentum.
    fn push(&mut self, momentum: &Vector<3>);

    /// Moves it.
    fn drift(&mut self, duration: f64);

    /// Takes the marked particles up, in their order; whether there were any.
    fn swallow<T: ThermalState>(
        &mut self,
        particles: &Particles<3, T>,
        marked: &[bool],
        constant: f64,
    ) -> bool;
}

impl MaybeSink for () {
    fn state(&self) -> Option<&Sink> {
        None
    }

    #[inline]
    fn potential(&self, _: &Vector<3>) -> f64 {
        0.0
    }

    fn look<T: ThermalState>(
        &self,
        _: &Particles<3, T>,
        _: impl Fn(usize) -> bool,
        _: f64,
        _: &mut Vec<Vector<3>>,
        _: &mut [bool],
    ) {
    }

    fn push(&mut self, _: &Vector<3>) {}

    fn drift(&mut self, _: f64) {}

    fn swallow<T: ThermalState>(&mut self, _: &Particles<3, T>, _: &[bool], _: f64) -> bool {
        false
    }
}

impl MaybeSink for Sink {
    fn state(&self) -> Option<&Sink> {
        Some(self)
    }

    fn potential(&self, x: &Vector<3>) -> f64 {
        self.depth(x)
    }

    fn look<T: ThermalState>(
        &self,
        particles: &Particles<3, T>,
        active: impl Fn(usize) -> bool,
        constant: f64,
        pull: &mut Vec<Vector<3>>,
        marked: &mut [bool],
    ) {
        pull.resize(particles.len(), [0.0; 3]);
        for i in (0..particles.len()).filter(|&i| active(i)) {
            let (x, v) = (&particles.position[i], &particles.velocity[i]);
            pull[i] = self.attraction(x).map(|a| constant * a);
            // Once marked, always: it may be through the other side before the step of the whole ends.
            marked[i] |= self.takes(x, v, constant);
        }
    }

    fn push(&mut self, momentum: &Vector<3>) {
        self.velocity = plus_scaled(&self.velocity, 1.0 / self.mass, momentum);
    }

    fn drift(&mut self, duration: f64) {
        self.position = plus_scaled(&self.position, duration, &self.velocity);
    }

    fn swallow<T: ThermalState>(
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
