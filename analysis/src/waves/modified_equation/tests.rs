use crate::scheme::{Step, catalogue};

#[test]
fn what_a_scheme_does_wrong_first() {
    let errors = |name: &str, order: usize| {
        let file = catalogue::scheme(name).unwrap();
        let step = Step::from_tree(&file.equations, None).unwrap();
        let series = step.long_waves(file.exact.as_deref(), order).unwrap();
        let text = |power: Option<usize>| power.map(|power| (power, series.error_text(power)));
        (text(series.leading_dissipation()), text(series.leading_dispersion()))
    };
    let of = |power: usize, text: &str| Some((power, text.to_string()));
    let upwind = (of(2, "C (1 - C)/2"), of(3, "-C (1 - C) (1 - 2 C)/6"));
    assert_eq!(errors("upwind", 4), upwind);
    let lax_wendroff = (of(4, "-C^2 (1 - C) (1 + C)/8"), of(3, "-C (1 - C) (1 + C)/6"));
    assert_eq!(errors("lax-wendroff", 4), lax_wendroff);
    let beam_warming = (of(4, "-C (1 - C)^2 (2 - C)/8"), of(3, "C (1 - C) (2 - C)/6"));
    assert_eq!(errors("beam-warming", 4), beam_warming);
    // Neutral to all orders.
    assert_eq!(errors("crank-nicolson", 12).0, None);
    assert_eq!(errors("heat-ftcs", 12), (of(4, "r (1 - 6 r)/12"), None));
    // With i in the exact step even powers are speed.
    assert_eq!(errors("beam-equation", 8), (None, of(4, "i r/12")));
}

#[test]
fn equations_in_text_and_latex() {
    let text = "u[n+1,j] = 2*u[n,j] - u[n-1,j] + kappa*(u[n,j+1] - 2*u[n,j] + u[n,j-1])";
    let series = Step::from_text(text).unwrap().long_waves(None, 4).unwrap();
    let terms = series.modified_equation().unwrap();
    assert_eq!(
        series.equation_text(&terms),
        "Δt ∂t u = -sqrt(kappa) Δx ∂x u - sqrt(kappa) (1 - kappa)/24 Δx^3 ∂x^3 u + …"
    );
    assert_eq!(
        series.equation_latex(&terms),
        "\\Delta t\\,\\partial_t u = -\\sqrt{\\kappa}\\,\\Delta x\\,\\partial_x u - \\frac{\\sqrt{\\kappa} \\left(1 - \\kappa\\right)}{24}\\,\\Delta x^{3}\\,\\partial_x^{3} u + \\dots"
    );
    let shift = Step::from_text("u[n+1,j] = u[n,j-1]").unwrap().long_waves(None, 4).unwrap();
    assert_eq!(shift.equation_text(&shift.modified_equation().unwrap()), "Δt ∂t u = -Δx ∂x u + …");
}
