//! The solution along rays `x/t`.

use super::wave::Side;
use super::{Solution, Star, State};

impl Solution {
    /// The state on the ray `x/t = ray` for `t > 0`: Toro 1999, section 4.5 and 4.6.
    ///
    /// On a discontinuity it is the state to the right of it. In a vacuum the density and pressure
    /// are 0 and the velocity is that of the ray, so that it is continuous at the fronts.
    pub fn sample(&self, ray: f64) -> State {
        match self.star {
            Star::Contact { pressure, velocity } => {
                if ray < velocity {
                    let mirrored = self.left.mirrored();
                    self.side(&mirrored, -ray, pressure, -velocity, true).mirrored()
                } else {
                    self.side(&self.right, ray, pressure, velocity, false)
                }
            }
            Star::Vacuum { left_front, right_front } => {
                if ray < left_front {
                    fan(self, &self.left.mirrored(), -ray).mirrored()
                } else if ray < right_front {
                    State::vacuum(ray)
                } else {
                    fan(self, &self.right, ray)
                }
            }
        }
    }

    /// The state on a ray between the contact and infinity, `state` being on the right. `beyond`
    /// says which side a ray that hits a shock exactly belongs to.
    fn side(&self, state: &State, ray: f64, pressure: f64, velocity: f64, beyond: bool) -> State {
        let side = Side::new(self.gas, state);
        if pressure > side.pressure {
            let shock = state.velocity() + side.shock_speed(pressure);
            if ray > shock || (ray == shock && !beyond) {
                return *state;
            }
        } else if pressure < side.pressure
            && ray > velocity + side.sound_behind_rarefaction(pressure)
        {
            return fan(self, state, ray);
        } else if pressure == side.pressure {
            return *state;
        }
        State::trusted(side.density_behind(pressure), velocity, pressure)
    }
}

/// The state on a ray in the rarefaction into `state` (on the right) or ahead of it:
/// `c = c_K 2/(γ+1) − (γ−1)/(γ+1) (v_K − ray)`, Toro 1999 (4.63).
fn fan(solution: &Solution, state: &State, ray: f64) -> State {
    let gas = solution.gas;
    let gamma = gas.gamma();
    let sound = gas.sound_speed(state.density(), state.pressure());
    if ray >= state.velocity() + sound {
        return *state;
    }
    let ratio = (2.0 - (gamma - 1.0) * (state.velocity() - ray) / sound) / (gamma + 1.0);
    // Round-off may pass the front of the gas.
    let ratio = ratio.max(0.0);
    let density = state.density() * ratio.powf(2.0 / (gamma - 1.0));
    let pressure = state.pressure() * ratio.powf(2.0 * gamma / (gamma - 1.0));
    if density == 0.0 {
        return State::vacuum(ray);
    }
    State::trusted(density, ray - ratio * sound, pressure)
}
