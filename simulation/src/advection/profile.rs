//! How far a profile is from another.

/// The smallest and the largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrema {
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

impl Extrema {
    /// Of some values; infinite the wrong way round for none.
    pub fn of(values: &[f64]) -> Self {
        let start = Self { min: f64::INFINITY, max: f64::NEG_INFINITY };
        values.iter().fold(start, |found, &value| Self {
            min: found.min.min(value),
            max: found.max.max(value),
        })
    }
}

/// `Σ_i |u_{i+1} − u_i|` around the period.
pub fn total_variation(values: &[f64]) -> f64 {
    let next = values.iter().cycle().skip(1);
    values.iter().zip(next).map(|(value, next)| (next - value).abs()).sum()
}

/// A computed profile beside the exact one. Norms are weighted with the particles' volumes `V_i`:
/// `L1 = Σ V_i |e_i| / Σ V_i`, which on equal volumes is `Σ|e_i|/N`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// `Σ V|e| / Σ V`.
    pub l1: f64,
    /// `√(Σ V e² / Σ V)`.
    pub l2: f64,
    /// `max |e|`.
    pub l_infinity: f64,
    /// Total variation of the computed profile.
    pub total_variation: f64,
    /// Total variation of the exact profile at the same particles.
    pub exact_total_variation: f64,
    /// Extrema of the computed profile.
    pub extrema: Extrema,
    /// Mean `Σ V u / Σ V` of the computed profile less that of the initial one.
    pub mean_drift: f64,
}

impl Comparison {
    /// All three profiles and the volumes run over the same particles.
    pub fn new(initial: &[f64], computed: &[f64], exact: &[f64], volumes: &[f64]) -> Self {
        let total: f64 = volumes.iter().sum();
        let average = |term: &dyn Fn(usize) -> f64| -> f64 {
            volumes.iter().enumerate().map(|(i, volume)| volume * term(i)).sum::<f64>() / total
        };
        let error = |i: usize| computed[i] - exact[i];
        Self {
            l1: average(&|i| error(i).abs()),
            l2: average(&|i| error(i) * error(i)).sqrt(),
            l_infinity: (0..computed.len()).map(|i| error(i).abs()).fold(0.0, f64::max),
            total_variation: total_variation(computed),
            exact_total_variation: total_variation(exact),
            extrema: Extrema::of(computed),
            mean_drift: average(&|i| computed[i] - initial[i]),
        }
    }
}
