use super::*;
use crate::exact::rational::{integer, ratio};
use crate::kernel::Kernel;
use crate::scheme::testing::{SPH, sph};
use crate::scheme::{Integrator, Lines, catalogue};

fn of_file(name: &str) -> (Accuracy, LongWaves) {
    let file = catalogue::scheme(name).unwrap();
    let step = Step::from_tree(&file.equations, None).unwrap();
    step.accuracy(file.exact.as_deref(), file.parameter.as_deref().unwrap()).unwrap()
}

fn orders(accuracy: &Accuracy) -> [Option<u32>; 3] {
    [accuracy.space, accuracy.time, accuracy.overall]
}

#[test]
fn conditional_consistency_is_told() {
    let (lax, _) = of_file("lax-friedrichs");
    assert_eq!((orders(&lax), lax.conditions), ([None, Some(1), Some(1)], vec![(-1, 2)]));
    let (frankel, series) = of_file("dufort-frankel");
    assert_eq!(
        (orders(&frankel), &frankel.conditions[..]),
        ([Some(2), None, Some(2)], &[(2, -2)][..])
    );
    // The telegraph term, Δt² u_tt (Δt/Δx)² = r² Δx⁴ u_xxxx at fixed r.
    assert_eq!(series.coefficient_text(4), "r (1 - 12 r^2)/12");
}

#[test]
fn orders_in_space_and_time_are_those_of_their_parts() {
    for (space, in_space) in [("upwind-1", 1), ("central-2", 2), ("upwind-5", 5), ("compact-6", 6)]
    {
        for (integrator, in_time) in
            [("forward-euler", 1), ("rk2-heun", 2), ("rk4", 4), ("ab3", 3), ("crank-nicolson", 2)]
        {
            let file = catalogue::space(space).unwrap();
            let lines = Lines::from_tree(&file.equations, None).unwrap();
            let step = Step::lines(&lines, Integrator::named(integrator).unwrap()).unwrap();
            let (accuracy, _) = step.accuracy(file.exact.as_deref(), "C").unwrap();
            let expected = [Some(in_space), Some(in_time), Some(in_space.min(in_time))];
            assert_eq!(orders(&accuracy), expected, "{space} with {integrator}");
            assert!(accuracy.conditions.is_empty());
        }
    }
}

#[test]
fn special_values_raise_the_order() {
    let (accuracy, series) = of_file("heat-ftcs");
    let special = series.special_values(accuracy.power.unwrap(), "r");
    assert_eq!(special.iter().map(RealRoot::exact).collect::<Vec<_>>(), [Some(&ratio(1, 6))]);
    let file = catalogue::scheme("heat-crandall").unwrap();
    let step = Step::from_tree(&file.equations, None).unwrap();
    let (accuracy, series) = step.accuracy(file.exact.as_deref(), "r").unwrap();
    assert_eq!(orders(&accuracy), [Some(4), Some(2), Some(4)]);
    // 20 r² = 1 (Crandall 1955).
    let [root] = &series.special_values(6, "r")[..] else { panic!("one value") };
    assert!(root.exact().is_none());
    assert!(&root.lower * &root.lower <= ratio(1, 20) && &root.upper * &root.upper >= ratio(1, 20));
    // A whole cell a step.
    let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])").unwrap();
    let shift = upwind.with("C", &integer(1)).unwrap().accuracy(Some("-I*C*phi"), "C").unwrap().0;
    assert!(shift.is_exact_shift && shift.overall.is_none() && shift.power.is_none());
}

#[test]
fn mixed_equations_are_weighed_by_their_parameters() {
    // Forward Euler, central: −C²/2 and r² are Δt; C/6 x³ and r/12 x⁴ are Δx².
    let text = "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let step = Step::from_text(text).unwrap();
    let of = |parameter| step.accuracy(Some("-I*C*phi - r*phi^2"), parameter).unwrap().0;
    // Δt ∝ Δx at fixed C, Δt ∝ Δx² at fixed r.
    assert_eq!(orders(&of("C")), [Some(2), Some(1), Some(1)]);
    assert_eq!(orders(&of("r")), [Some(2), Some(1), Some(2)]);
}

#[test]
fn a_kernel_that_does_not_add_up_moves_long_waves_at_a_wrong_speed() {
    let order = |name, kernel, l: &Rational| sph(name, kernel, l).accuracy(Some("-I*C*phi"), "C");
    assert_eq!(order("godunov-sph", Kernel::CubicSpline, &ratio(2, 1)).unwrap().0.overall, Some(1));
    assert_eq!(
        order("lax-wendroff-sph", Kernel::CubicSpline, &ratio(2, 1)).unwrap().0.overall,
        Some(2)
    );
    assert_eq!(
        order("godunov-sph", Kernel::CubicSpline, &ratio(13, 10)).unwrap().0.overall,
        Some(0)
    );
    // There a constant is not kept.
    let drifts = order("lax-wendroff-sph", Kernel::CubicSpline, &ratio(13, 10)).unwrap_err();
    assert_eq!(drifts, NoSeries::Drift);
    for scheme in SPH {
        let found = order(scheme, Kernel::Gaussian, &integer(2));
        match scheme {
            "lax-wendroff-sph" => assert_eq!(found.unwrap_err(), NoSeries::Drift),
            _ => {
                let (accuracy, series) = found.unwrap();
                assert_eq!(orders(&accuracy), [None, None, Some(0)], "{scheme}");
                let speed = crate::exact::rational::to_f64(&series.speed_ratio().unwrap());
                assert!((speed - 1.0).abs() < 1e-3);
            }
        }
    }
}
