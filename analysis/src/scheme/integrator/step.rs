//! One step of every integrator, as the algorithm a code runs.

use super::{Integrator, Number};

/// A combination of states: `[x₁ + weight·x₂, y₁ + weight·y₂]`.
fn plus<T: Number>(state: &[T; 2], weight: &T, rate: &[T; 2]) -> [T; 2] {
    [0, 1].map(|index| state[index].clone() + weight.clone() * rate[index].clone())
}

impl Integrator {
    /// One step of `Ẋ = V, V̇ = F X + G V` from the state `[X, VΔt]`, with `f = FΔt²` and `g = GΔt`.
    pub fn step<T: Number>(self, state: &[T; 2], f: &T, g: &T) -> [T; 2] {
        let half = T::fraction(1, 2);
        let force = |x: &T, y: &T| f.clone() * x.clone() + g.clone() * y.clone();
        let rates = |[x, y]: &[T; 2]| [y.clone(), force(x, y)];
        let [x, y] = state;
        match self {
            Self::ForwardEuler => plus(state, &T::one(), &rates(state)),
            Self::SymplecticEuler => {
                let kicked = y.clone() + force(x, y);
                [x.clone() + kicked.clone(), kicked]
            }
            Self::CentredEuler => {
                let kicked = y.clone() + force(x, y);
                [x.clone() + half * (y.clone() + kicked.clone()), kicked]
            }
            Self::LeapfrogKdk | Self::LeapfrogKdkPredicted => {
                let first = force(x, y);
                let middle = y.clone() + half.clone() * first.clone();
                let moved = x.clone() + middle.clone();
                let viscous = match self {
                    Self::LeapfrogKdk => middle.clone(),
                    _ => y.clone() + first,
                };
                let last = middle + half * force(&moved, &viscous);
                [moved, last]
            }
            Self::Rk2Midpoint => {
                let middle = plus(state, &half, &rates(state));
                plus(state, &T::one(), &rates(&middle))
            }
            Self::Rk2Heun => {
                let first = rates(state);
                let end = plus(state, &T::one(), &first);
                plus(&plus(state, &half, &first), &half, &rates(&end))
            }
            Self::Rk3Ssp => {
                let first = plus(state, &T::one(), &rates(state));
                let blend = |old: T, new: T, weight: (i64, i64)| {
                    T::fraction(weight.1 - weight.0, weight.1) * old
                        + T::fraction(weight.0, weight.1) * new
                };
                let euler = plus(&first, &T::one(), &rates(&first));
                let second = [
                    blend(x.clone(), euler[0].clone(), (1, 4)),
                    blend(y.clone(), euler[1].clone(), (1, 4)),
                ];
                let [end_x, end_y] = plus(&second, &T::one(), &rates(&second));
                [blend(x.clone(), end_x, (2, 3)), blend(y.clone(), end_y, (2, 3))]
            }
            Self::Rk4 => {
                let (sixth, third) = (T::fraction(1, 6), T::fraction(1, 3));
                let first = rates(state);
                let second = rates(&plus(state, &half, &first));
                let third_rate = rates(&plus(state, &half, &second));
                let fourth = rates(&plus(state, &T::one(), &third_rate));
                let with_first = plus(state, &sixth, &first);
                let with_second = plus(&with_first, &third, &second);
                plus(&plus(&with_second, &third, &third_rate), &sixth, &fourth)
            }
            Self::PredictorCorrector => {
                let predicted = plus(state, &half, &rates(state));
                let rate = force(&predicted[0], &predicted[1]);
                let middle_y = y.clone() + half.clone() * rate;
                let middle_x = x.clone() + half * middle_y.clone();
                let two = T::fraction(2, 1);
                [two.clone() * middle_x - x.clone(), two * middle_y - y.clone()]
            }
        }
    }

    /// The matrix of one step on the column `(X, VΔt)`: `[[a, b], [c, d]]` by rows.
    pub fn matrix<T: Number>(self, f: &T, g: &T) -> [[T; 2]; 2] {
        let [a, c] = self.step(&[T::one(), T::zero()], f, g);
        let [b, d] = self.step(&[T::zero(), T::one()], f, g);
        [[a, b], [c, d]]
    }
}
