//! Which of some numbers belongs to which of others.

use num_complex::Complex64;

/// An order of `others`: the ones nearest to `ones` first, in the order of `ones`, pairs of the least distance taken before others; what
/// is left follows as it stands.
pub(super) fn nearest(ones: &[Complex64], others: &[Complex64]) -> Vec<usize> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::with_capacity(ones.len() * others.len());
    for (i, one) in ones.iter().enumerate() {
        pairs.extend(others.iter().enumerate().map(|(j, other)| ((one - other).norm(), i, j)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut partner = vec![None; ones.len()];
    let mut taken = vec![false; others.len()];
    for (_, i, j) in pairs {
        if partner[i].is_none() && !taken[j] {
            partner[i] = Some(j);
            taken[j] = true;
        }
    }
    let rest = (0..others.len()).filter(|&j| !taken[j]);
    partner.into_iter().flatten().chain(rest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_numbers_are_paired_and_the_rest_follows() {
        let real =
            |values: &[f64]| -> Vec<_> { values.iter().map(|&x| Complex64::new(x, 0.0)).collect() };
        assert_eq!(nearest(&real(&[1.0, 2.0]), &real(&[7.0, 2.1, 0.9])), [2, 1, 0]);
        assert_eq!(nearest(&real(&[1.0, 1.0]), &real(&[1.0])), [0]);
        assert_eq!(nearest(&[], &real(&[3.0, 1.0])), [0, 1]);
        let unknown = Complex64::new(f64::NAN, 0.0);
        assert_eq!(nearest(&[unknown, real(&[1.0])[0]], &real(&[1.0, 2.0])), [1, 0]);
    }
}
