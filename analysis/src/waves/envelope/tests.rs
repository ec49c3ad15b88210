use super::*;
use crate::exact::cosine_series::CosineSeries;
use proptest::prelude::*;

fn envelope(series: &[CosineSeries<f64>]) -> Envelope {
    let degree = series.iter().map(CosineSeries::degree).max().unwrap_or(0);
    Envelope::new(degree, series.len(), |phase, values| {
        for (value, series) in values.iter_mut().zip(series) {
            *value = series.at_cosine(phase.cos());
        }
    })
}

fn at(series: &[CosineSeries<f64>], t: f64, phase: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, one| sum * t + one.at_cosine(phase.cos()))
}

/// Dense samples and golden sections about every maximum among them: two may be nearly as high.
fn brute_force(f: impl Fn(f64) -> f64, degree: usize) -> f64 {
    let cells = 200 * (degree + 1);
    let step = PI / cells as f64;
    let values: Vec<f64> = (0..=cells).map(|i| f(i as f64 * step)).collect();
    let value = |i: usize| values.get(i).copied().unwrap_or(f64::NEG_INFINITY);
    let peaks =
        (0..=cells).filter(|&i| value(i) >= value(i.wrapping_sub(1)) && value(i) >= value(i + 1));
    let refined = peaks.map(|i| {
        let middle = i as f64 * step;
        let (mut lower, mut upper) = (middle - step, middle + step);
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        while upper - lower > 1e-9 * step {
            let (left, right) =
                (upper - golden * (upper - lower), lower + golden * (upper - lower));
            if f(left) < f(right) { lower = left } else { upper = right }
        }
        value(i).max(f(lower.midpoint(upper)))
    });
    refined.fold(f64::NEG_INFINITY, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]
    #[test]
    fn extremes_are_those_of_brute_force(
        coefficients in prop::collection::vec(prop::collection::vec(-1.0f64..1.0, 1..30), 1..6),
        parameters in prop::collection::vec(-3.0f64..3.0, 1..20),
    ) {
        let series: Vec<_> = coefficients.into_iter().map(CosineSeries::new).collect();
        let degree = series.iter().map(CosineSeries::degree).max().unwrap_or(0);
        let (found, _) = envelope(&series).extremes(&parameters);
        prop_assert_eq!(found.len(), parameters.len());
        for (&t, [high, low]) in parameters.iter().zip(found) {
            let size: f64 = series.iter().rev().fold(0.0, |sum, one| {
                sum * t.abs() + one.coefficients().iter().map(|value| value.abs()).sum::<f64>()
            });
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * size;
            prop_assert!(close(high.value, brute_force(|phase| at(&series, t, phase), degree)));
            prop_assert!(close(low.value, -brute_force(|phase| -at(&series, t, phase), degree)));
            for extreme in [high, low] {
                prop_assert!((0.0..=PI).contains(&extreme.phase));
                prop_assert!(close(extreme.value, at(&series, t, extreme.phase)));
            }
        }
    }
}

#[test]
fn work_is_a_few_times_the_degree() {
    // cos 20φ + t cos φ: 81 nodes, 21 samples to know the coefficients.
    let mut fast = vec![0.0; 21];
    fast[20] = 1.0;
    let series = [CosineSeries::new(fast), CosineSeries::new(vec![0.0, 1.0])];
    let parameters: Vec<f64> = (0..64).map(|i| 0.1 + f64::from(i)).collect();
    let (found, work) = envelope(&series).extremes(&parameters);
    assert_eq!(work.phases, 21 + 81);
    // The largest value is at 0, one cell for each column. The smallest is next to π, inside at first.
    assert!(found.iter().all(|pair| pair[0].phase == 0.0));
    assert!(work.cells <= 4 * parameters.len(), "{work:?}");
    assert!(work.newton_steps <= 6 * work.cells.div_ceil(LANES), "{work:?}");
    assert_eq!(work.halved, 0);
}

#[test]
fn flat_extremes_are_found_by_halving() {
    // −(cos φ − c)² (1 + cos φ)² has two maxima of 0 that meet as c → −1, and a pitchfork there.
    for c in [-0.9, -0.99, -0.999, -0.999_999, -1.0] {
        let f = |x: f64| -((x - c) * (1.0 + x)).powi(2) + 1e-3 * x;
        let envelope = Envelope::new(4, 1, |phase, values| values[0] = f(phase.cos()));
        let ([[high, _]], _) = (<[_; 1]>::try_from(envelope.extremes(&[1.0]).0).unwrap(), ());
        assert!((high.value - brute_force(|phase| f(phase.cos()), 4)).abs() < 1e-14, "{c}");
    }
    // Twelve times flatter than any parabola.
    let flat = Envelope::new(6, 1, |phase, values| values[0] = -(phase.cos() - 0.3).powi(6));
    let (found, work) = flat.extremes(&[1.0]);
    assert!(found[0][0].value.abs() < 1e-13 && work.halved > 0, "{found:?} {work:?}");
}

#[test]
fn nothing_moves_where_nothing_depends_on_the_wave() {
    let constant = Envelope::new(3, 2, |_, values| values.copy_from_slice(&[0.5, 2.0]));
    let (found, work) = constant.extremes(&[0.0, 1.0]);
    assert_eq!(found[1], [Extreme { value: 2.5, phase: 0.0 }; 2]);
    assert_eq!((work.cells, found[0][0].value), (0, 0.5));
}
