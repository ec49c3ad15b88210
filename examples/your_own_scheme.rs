//! A scheme of one's own: Fromm's, as one types it, with everything that follows from it.
//!
//! Run with `cargo run --example your_own_scheme`.

use courant::analysis::exact::rational::ratio;
use courant::analysis::scheme::Step;
use courant::analysis::stability::SearchPlan;

/// Fromm 1968.
const FROMM: &str = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]) \
                     - C/4*(1 - C)*(u[n,j+1] - u[n,j] - u[n,j-1] + u[n,j-2])";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fromm = Step::from_text(FROMM)?;
    let one_step = fromm.one_step("C").expect("the scheme is explicit");
    let (accuracy, series) = fromm.accuracy(Some("-I*C*phi"), "C")?;
    let order = accuracy.overall;
    let stable = fromm.stable_set("C", &SearchPlan::default())?;
    let monotone = fromm.monotone_set("C", &SearchPlan::default())?.expect("it is explicit");
    let limit = stable.limit();
    println!("{}", one_step.to_text());
    println!("order          {}", order.expect("a constant is kept"));
    println!("first error    {} of the third derivative", series.error_text(3));
    println!("stable up to   {} ({})", limit.value(), limit.evidence().name());
    println!("monotone up to {}", monotone.limit().value());
    println!("C = 1.01 is {}", if stable.contains(&ratio(101, 100)) { "stable" } else { "not" });
    assert_eq!((limit.value(), order), (1.0, Some(2)));
    Ok(())
}
