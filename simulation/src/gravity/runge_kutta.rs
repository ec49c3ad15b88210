//! Two ordinary differential equations in time or space.

/// One step of the classical method of fourth order for `y' = slope(x, y)`.
pub(super) fn runge_kutta(
    slope: impl Fn(f64, [f64; 2]) -> [f64; 2],
    x: f64,
    y: [f64; 2],
    h: f64,
) -> [f64; 2] {
    let along = |k: [f64; 2], part: f64| [y[0] + part * h * k[0], y[1] + part * h * k[1]];
    let first = slope(x, y);
    let second = slope(x + 0.5 * h, along(first, 0.5));
    let third = slope(x + 0.5 * h, along(second, 0.5));
    let fourth = slope(x + h, along(third, 1.0));
    std::array::from_fn(|i| {
        y[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
    })
}
