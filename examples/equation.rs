//! Type the equation, get the proved limit: one line each.
//!
//! Run with `cargo run --example equation`.

use courant::analysis::scheme::{Integrator, Lines, SchemeError, Step};

fn main() -> Result<(), SchemeError> {
    let leapfrog = Step::from_text("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")?.limit("C")?;
    println!("leapfrog: {} ({})", leapfrog.value(), leapfrog.evidence().name());
    assert_eq!(leapfrog.closed_form().as_deref(), Some("1"));
    // At the limit two multipliers meet on the unit circle: the limit itself is not stable.
    assert!(!leapfrog.is_included());

    let central = Lines::from_text("u[j]' = -C*(u[j+1] - u[j-1])/2")?;
    for name in ["rk3", "rk4", "ab3"] {
        let integrator = Integrator::named(name).expect("an integrator of the catalogue");
        let limit = Step::lines(&central, integrator)?.limit("C")?;
        println!("central differences with {name}: {}", limit.closed_form().unwrap_or_default());
    }
    Ok(())
}
