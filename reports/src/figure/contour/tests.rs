use super::*;
use proptest::prelude::*;

fn nodes(n: usize, low: f64, high: f64) -> Vec<f64> {
    (0..n).map(|i| low + (high - low) * i as f64 / (n - 1) as f64).collect()
}

/// Signed area of rings, by the shoelace formula.
fn area(rings: &[Vec<Point>]) -> f64 {
    let ring_area = |r: &Vec<Point>| -> f64 {
        (0..r.len())
            .map(|k| (r[k], r[(k + 1) % r.len()]))
            .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
            .sum()
    };
    rings.iter().map(ring_area).sum()
}

/// The area of the unit square where `a x + b y >= level`, by cutting the square along the straight line.
fn half_plane_area(a: f64, b: f64, level: f64) -> f64 {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let value = |p: Point| a * p[0] + b * p[1] - level;
    let mut kept = Vec::new();
    for k in 0..4 {
        let (p, q) = (square[k], square[(k + 1) % 4]);
        if value(p) >= 0.0 {
            kept.push(p);
        }
        if (value(p) >= 0.0) != (value(q) >= 0.0) {
            let t = value(p) / (value(p) - value(q));
            kept.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
        }
    }
    area(&[kept])
}

/// Random values, some of them blank.
fn random_field() -> impl Strategy<Value = Field> {
    (2usize..9, 2usize..9).prop_flat_map(|(n, m)| {
        let value = prop_oneof![9 => -1.0f64..1.0, 1 => Just(f64::NAN)];
        prop::collection::vec(value, n * m).prop_map(move |values| {
            let values = Array2::from_shape_vec((n, m), values).unwrap();
            Field::new(nodes(n, 0.0, (n - 1) as f64), nodes(m, 0.0, (m - 1) as f64), values)
                .unwrap()
        })
    })
}

/// The cells of a unit-spaced field that are not blank.
fn valid_cells(field: &Field) -> Vec<(usize, usize)> {
    let (n, m) = field.values.dim();
    let valid = |i: usize, j: usize| {
        CORNERS.iter().all(|&(di, dj)| field.values[[i + di, j + dj]].is_finite())
    };
    (0..n - 1).flat_map(|i| (0..m - 1).map(move |j| (i, j))).filter(|&(i, j)| valid(i, j)).collect()
}

/// The value of a unit-spaced field at a point of a grid line, linear between its nodes.
fn value_on_grid_line(field: &Field, p: Point) -> f64 {
    let (i, j) = (p[0].floor() as usize, p[1].floor() as usize);
    let (s, t) = (p[0].fract(), p[1].fract());
    assert!(s == 0.0 || t == 0.0, "{p:?} is not on a grid line");
    let a = field.values[[i, j]];
    if s > 0.0 {
        a + s * (field.values[[i + 1, j]] - a)
    } else if t > 0.0 {
        a + t * (field.values[[i, j + 1]] - a)
    } else {
        a
    }
}

fn isolines(field: &Field, level: f64) -> Vec<Vec<Point>> {
    field.on(&field.x, &field.y).isolines(&[level]).swap_remove(0)
}

#[test]
fn circle_is_one_closed_line_near_its_radius() {
    let x = nodes(101, -1.0, 1.0);
    let field = Field::from_fn(x.clone(), x, |x, y| x * x + y * y).unwrap();
    let lines = isolines(&field, 0.49);
    assert_eq!(lines.len(), 1);
    assert_eq!(lines[0].first(), lines[0].last());
    for p in &lines[0] {
        // Linear interpolation of r² over a side of h = 0.02 errs by at most h²/4 in r², that is h²/(8 r) in r.
        assert!((p[0].hypot(p[1]) - 0.7).abs() <= 0.02f64.powi(2) / (8.0 * 0.7) + 1e-12);
    }
    // Larger values lie to the left: the way around the low middle is clockwise.
    assert!(area(&lines) < 0.0);
}

#[test]
fn saddles_follow_the_mean() {
    let cell = |mean_shift: f64| {
        let values = ndarray::array![[1.0 + mean_shift, 0.0], [0.0, 1.0 + mean_shift]];
        Field::new(vec![0.0, 1.0], vec![0.0, 1.0], values).unwrap()
    };
    // Mean above the level: the high diagonal is one region; below: two corners.
    assert_eq!(cell(0.2).region_at_least(0.5).len(), 1);
    assert_eq!(cell(-0.2).region_at_least(0.5).len(), 2);
}

#[test]
fn blank_cells_leave_holes() {
    let mut values = Array2::from_elem((6, 6), 1.0);
    values[[2, 2]] = f64::NAN;
    let field = Field::new(nodes(6, 0.0, 5.0), nodes(6, 0.0, 5.0), values).unwrap();
    let rings = field.region_at_least(0.0);
    assert_eq!(rings.len(), 2);
    assert!((area(&rings) - 21.0).abs() < 1e-12);
    assert!(isolines(&field, 0.5).is_empty());
}

#[test]
fn a_peak_that_reaches_the_level_has_no_region() {
    let mut values = Array2::zeros((5, 5));
    values[[2, 2]] = 1.0;
    let field = Field::new(nodes(5, 0.0, 4.0), nodes(5, 0.0, 4.0), values).unwrap();
    assert!(field.region_at_least(1.0).is_empty());
    assert_eq!(field.region_at_least(0.5).len(), 1);
}

#[test]
fn wrong_fields_are_errors() {
    let values = Array2::<f64>::zeros((2, 3));
    let (two, three) = (vec![0.0, 1.0], vec![0.0, 1.0, 2.0]);
    assert!(Field::new(two.clone(), three.clone(), values.clone()).is_ok());
    let shape = Field::new(three.clone(), two.clone(), values.clone());
    assert!(matches!(shape, Err(FigureError::FieldShape { .. })));
    let order = Field::new(vec![1.0, 0.0], three.clone(), values.clone());
    assert!(matches!(order, Err(FigureError::NotIncreasing { .. })));
    let nan = Field::new(two, vec![0.0, f64::NAN, 2.0], values);
    assert!(matches!(nan, Err(FigureError::NotIncreasing { .. })));
}

proptest! {
    #[test]
    fn regions_of_planes_are_half_planes(a in -2.0f64..2.0, b in -2.0f64..2.0, level in -2.0f64..2.0) {
        let field = Field::from_fn(nodes(7, 0.0, 1.0), nodes(12, 0.0, 1.0), |x, y| a * x + b * y).unwrap();
        let found = area(&field.region_at_least(level));
        // Where the field is nearly flat, round-off of its values moves the line: 1e-15 / |slope|.
        let slack = 1e-12 + 1e-14 / a.hypot(b);
        prop_assert!((found - half_plane_area(a, b, level)).abs() < slack);
    }

    #[test]
    fn points_lie_on_the_level(field in random_field(), level in -0.9f64..0.9) {
        for line in isolines(&field, level) {
            for p in line {
                // Positions up to 8 are exact to 1e-15; slopes are at most 2.
                prop_assert!((value_on_grid_line(&field, p) - level).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn lines_have_no_gaps(field in random_field(), level in -0.9f64..0.9) {
        let cells = valid_cells(&field);
        let mut length = 0;
        for line in isolines(&field, level) {
            length += line.len() - 1;
            if line.first() == line.last() {
                continue;
            }
            // An open line ends only where there is a cell on one side of a grid line but not on the other.
            for p in [line[0], line[line.len() - 1]] {
                let touching = cells
                    .iter()
                    .filter(|c| (c.0 as f64..=c.0 as f64 + 1.0).contains(&p[0]))
                    .filter(|c| (c.1 as f64..=c.1 as f64 + 1.0).contains(&p[1]))
                    .count();
                prop_assert_eq!(touching, 1);
            }
        }
        // Every cell contributes half as many pieces as its sides have crossings.
        let crossings: usize = cells.iter().map(|&(i, j)| {
            let high = CORNERS.map(|(di, dj)| field.values[[i + di, j + dj]] >= level);
            (0..4).filter(|&k| high[k] != high[(k + 1) % 4]).count()
        }).sum();
        prop_assert_eq!(length, crossings / 2);
    }

    #[test]
    fn region_and_complement_fill_the_field(field in random_field(), level in -0.9f64..0.9) {
        // The negated field swaps high and low everywhere, saddles included.
        let negated = Field { values: field.values.mapv(|v| -v), ..field.clone() };
        let total = area(&field.region_at_least(level)) + area(&negated.region_at_least(-level));
        prop_assert!((total - valid_cells(&field).len() as f64).abs() < 1e-12);
    }
}
