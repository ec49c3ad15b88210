use super::*;
use crate::exact::rational::{integer, ratio};
use num_traits::Signed;
use proptest::prelude::*;
use std::rc::Rc;

/// The powers and the coefficients of a sum of terms.
type Terms = Vec<(Vec<usize>, i64)>;

fn terms() -> impl Strategy<Value = (usize, Terms)> {
    (1usize..=3).prop_flat_map(|dimension| {
        let term = (prop::collection::vec(0usize..=2, dimension), -3i64..=3);
        (Just(dimension), prop::collection::vec(term, 1..6))
    })
}

fn tensor(dimension: usize, terms: &Terms) -> Tensor {
    Tensor::new(vec![2; dimension], terms.iter().cloned())
}

fn form<const N: usize>(degree: usize, terms: &[([usize; N], i64)]) -> Tensor {
    Tensor::new(vec![degree; N], terms.iter().copied())
}

/// All points with these coordinates.
fn grid(dimension: usize, coordinates: &[Rational]) -> Vec<Vec<Rational>> {
    (0..dimension).fold(vec![Vec::new()], |points, _| {
        let longer = |point: &Vec<Rational>| {
            coordinates.iter().map(|x| [&point[..], std::slice::from_ref(x)].concat()).collect()
        };
        points.iter().flat_map(|point| -> Vec<Vec<Rational>> { longer(point) }).collect()
    })
}

fn with(point: &[Rational], axis: usize, x: Rational) -> Vec<Rational> {
    let mut moved = point.to_vec();
    moved[axis] = x;
    moved
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn operations_are_those_on_values((dimension, terms) in terms(), x in prop::collection::vec((1i64..9, 1i64..9), 3), mask in 1usize..8) {
        let p = tensor(dimension, &terms);
        let point: Vec<Rational> = x[..dimension].iter().map(|&(a, b)| ratio(a, b)).collect();
        let direct = |point: &[Rational]| terms.iter().fold(integer(0), |sum, (powers, value)| {
            let powers = powers.iter().zip(point).map(|(&k, x)| x.pow(k as i32));
            sum + powers.fold(integer(*value), |product, power| product * power)
        });
        let value = direct(&point);
        prop_assert_eq!(p.at(&point), value.clone());
        prop_assert_eq!(p.clone().plus(&p.flipped(0)).minus(&p).at(&point), p.flipped(0).at(&point));
        prop_assert_eq!(p.clone().with_an_axis().at(&[&point[..], &[ratio(1, 7)]].concat()), value.clone());
        let trimmed = p.trimmed();
        prop_assert_eq!(trimmed.at(&point).signum(), value.signum());
        prop_assert_eq!(trimmed.is_zero(), p.is_zero());
        let gcd = trimmed.values().iter().fold(BigInt::zero(), |all, value| all.gcd(value));
        prop_assert!(gcd.is_one() || p.is_zero());
        let bernstein = Bernstein::of(&p);
        let double = grid(dimension, &[ratio(1, 3), integer(2)]);
        let proportional = |a: &Tensor, b: &Tensor| double.iter().all(|y| {
            a.at(y) * b.at(&point) == b.at(y) * a.at(&point) && a.at(y).signum() == b.at(y).signum()
        });
        prop_assert!(proportional(&bernstein.powers(), &p));
        for axis in 0..dimension {
            let x = &point[axis];
            let at = |x: Rational| direct(&with(&point, axis, x));
            let used: usize = (0..=2).filter(|&k| !p.slice(axis, k).is_zero()).max().unwrap_or(0);
            prop_assert!(trimmed.degrees()[axis] == used || p.is_zero());
            let rest: Vec<Rational> = (0..dimension).filter(|a| *a != axis).map(|a| point[a].clone()).collect();
            let slices = (0..=2).fold(integer(0), |sum, k| sum + p.slice(axis, k).at(&rest) * x.pow(k as i32));
            prop_assert_eq!(slices, value.clone());
            prop_assert_eq!(p.flipped(axis).at(&point), at(integer(1) - x));
            prop_assert_eq!(p.reversed(axis).at(&point), at(x.recip()) * x * x);
            let (lower, upper) = bernstein.halves(axis);
            for (half, bernstein, upper) in [(p.half(axis, false), lower, 0), (p.half(axis, true), upper, 1)] {
                prop_assert_eq!(half.at(&point), at((x + integer(upper)) / integer(2)) * integer(4));
                prop_assert!(proportional(&bernstein.powers(), &half));
            }
        }
        // Where some variables are 0, and charts about it.
        let axes: Vec<usize> = (0..dimension).filter(|axis| mask >> axis & 1 == 1).collect();
        prop_assume!(!axes.is_empty());
        let sum = |powers: &Vec<usize>| axes.iter().map(|&axis| powers[axis]).sum::<usize>();
        let occupied: Vec<Vec<usize>> = (0..p.values().len()).filter(|&at| !p.values()[at].is_zero()).map(|at| p.powers(at)).collect();
        prop_assert_eq!(p.order(&axes), occupied.iter().map(sum).min());
        prop_assert_eq!(p.vanishes_on(&axes), occupied.iter().all(|powers| sum(powers) > 0));
        if let Some(order) = p.order(&axes) {
            for &leader in &axes {
                let x = &point[leader];
                let mut image = point.clone();
                axes.iter().filter(|&&axis| axis != leader).for_each(|&axis| image[axis] *= x);
                prop_assert_eq!(p.in_chart(&axes, leader, order).at(&point) * x.pow(order as i32), direct(&image));
            }
        }
    }

    #[test]
    fn signs_are_those_of_values((dimension, terms) in terms(), squared in prop::bool::ANY) {
        let mut p = tensor(dimension, &terms);
        if squared {
            let terms = terms.iter().flat_map(|(a, x)| terms.iter().map(move |(b, y)| {
                (a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<_>>(), x * y)
            }));
            p = Tensor::new(vec![4; dimension], terms);
        }
        let budget = 60;
        let (sign, work) = sign_on_cube(&p, budget);
        prop_assert!(work <= budget);
        match sign {
            CubeSign::NowhereNegative => {
                let coordinates = [integer(0), ratio(1, 3), ratio(1, 2), ratio(4, 5), integer(1)];
                prop_assert!(grid(dimension, &coordinates).iter().all(|point| !p.at(point).is_negative()));
                // The boxes that it takes are enough, and one less is not.
                prop_assert_eq!(sign_on_cube(&p, work), (CubeSign::NowhereNegative, work));
                let (sign, less) = sign_on_cube(&p, work - 1);
                prop_assert!(sign == CubeSign::Undecided && less < work || work == 1);
            }
            CubeSign::NegativeAt(point) => {
                prop_assert!(!squared && p.at(&point).is_negative());
                prop_assert!(point.iter().all(|x| !x.is_negative() && *x <= integer(1)));
            }
            CubeSign::Undecided => {}
        }
    }
}

#[test]
fn zeros_at_corners_edges_and_faces_are_resolved() {
    let power = |k: usize| form(2 * k, &[([0, 2], 1), ([k, 1], -1), ([2 * k, 0], 1)]);
    let touching = [
        form(1, &[([0], 0)]),
        form(2, &[([0, 0, 0], 1), ([1, 0, 0], -2), ([2, 0, 0], 1)]),
        form(2, &[([0], 1), ([1], -4), ([2], 4)]),
        form(2, &[([2, 0], 1), ([1, 1], -2), ([0, 2], 1)]),
        form(2, &[([2, 0, 1], 1), ([1, 1, 1], -2), ([0, 2, 1], 2)]),
        // (x + y − 1)², which vanishes at two corners, and x² + y² + z² − xy − yz − zx on the diagonal of a cube.
        form(2, &[([0, 0], 1), ([1, 0], -2), ([0, 1], -2), ([2, 0], 1), ([1, 1], 2), ([0, 2], 1)]),
        form(
            2,
            &[
                ([2, 0, 0], 1),
                ([0, 2, 0], 1),
                ([0, 0, 2], 1),
                ([1, 1, 0], -1),
                ([0, 1, 1], -1),
                ([1, 0, 1], -1),
            ],
        ),
        // y² − x^12 y + x^24, a chart for every power.
        power(12),
    ];
    for p in touching {
        let (sign, work) = sign_on_cube(&p, 400);
        assert_eq!((sign, work < 400), (CubeSign::NowhereNegative, true), "{p:?}: {work}");
    }
    // One chart too many; zeros at no corner of any box.
    assert!(matches!(sign_on_cube(&power(13), 4000), (CubeSign::Undecided, work) if work < 4000));
    let third = form(2, &[([0], 1), ([1], -6), ([2], 9)]);
    assert_eq!(sign_on_cube(&third, 30).0, CubeSign::Undecided);
    // Negative between two lines through a corner, where every corner is not: x² − 3xy + 2y², turned to each corner.
    let between = form(2, &[([2, 0], 1), ([1, 1], -3), ([0, 2], 2)]);
    for p in
        [between.clone(), between.flipped(0), between.flipped(1), between.flipped(0).flipped(1)]
    {
        let (CubeSign::NegativeAt(point), _) = sign_on_cube(&p, 20) else { panic!("{p:?}") };
        assert!(p.at(&point).is_negative());
    }
}

#[test]
fn what_lies_across_a_blow_up_and_is_not_joined_to_it_is_cut_off() {
    use super::chart::separating_axis;
    let along = |dimension, axes: &[usize], others: &[usize], joined: &[usize]| {
        let others = others.iter().copied();
        separating_axis(dimension, axes, others, |fixed| fixed == joined)
    };
    let nothing = [usize::MAX];
    // The opposite corner, a neighbour, and one that a face of zeros joins.
    assert_eq!(along(2, &[0, 1], &[3], &nothing), Some(0));
    assert_eq!(along(2, &[0, 1], &[1], &nothing), Some(0));
    assert_eq!(along(2, &[0, 1], &[2], &nothing), Some(1));
    assert_eq!(along(2, &[0, 1], &[1], &[1]), None);
    assert_eq!(along(2, &[0, 1], &[1, 3], &[1]), Some(0));
    assert_eq!(separating_axis(2, &[0, 1], [3].into_iter(), |_| true), Some(0));
    // Not across: along an axis that is not blown up, or a factor.
    assert_eq!(along(3, &[0, 1], &[4], &nothing), None);
    assert_eq!(along(3, &[1, 2], &[5], &nothing), Some(2));
    assert_eq!((along(2, &[0], &[1], &nothing), along(2, &[0, 1], &[], &nothing)), (None, None));
    // A factor is no chart; within a chart other coordinates are multiples of the leading one.
    let chart = |of, axes: Vec<usize>, leader| Origin::Chart { of: Rc::new(of), axes, leader };
    let inner = chart(Origin::Whole, vec![0, 1], 1);
    assert_eq!((inner.charts(), chart(Origin::Whole, vec![0], 0).charts()), (1, 0));
    let point = inner.in_whole(vec![ratio(1, 2), ratio(1, 3), ratio(1, 5)]);
    assert_eq!(point, [ratio(1, 6), ratio(1, 3), ratio(1, 5)]);
    assert_eq!(chart(inner, vec![0, 2], 0).charts(), 2);
}

#[test]
fn a_negative_corner_is_a_point_at_once_also_in_a_chart() {
    let found = |degrees: [usize; 2], terms: &[([usize; 2], i64)]| {
        sign_on_cube(&Tensor::new(degrees.to_vec(), terms.iter().copied()), 100)
    };
    // 2x − 1; and x² − 3xy + y² + 8x²y², which is negative next to the corner 0 along the diagonal alone.
    let (sign, work) = found([1, 0], &[([0, 0], -1), ([1, 0], 2)]);
    assert!(matches!(sign, CubeSign::NegativeAt(point) if point[0] == integer(0)) && work == 1);
    let terms = [([2, 0], 1), ([1, 1], -3), ([0, 2], 1), ([2, 2], 8)];
    let (sign, work) = found([2, 2], &terms);
    assert!(matches!(sign, CubeSign::NegativeAt(_)) && work == 2, "{work}");
}
