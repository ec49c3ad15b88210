//! A scheme of one's own: Fromm's, as a symbol, with everything that follows from it.
//!
//! Run with `cargo run --example your_own_scheme`.

use courant::analysis::exact::rational::{integer, ratio};
use courant::analysis::exact::stencil::Stencil;
use courant::analysis::scheme::Scheme;
use courant::analysis::scheme::symbol::{EnclosedSymbol, Symbol};
use courant::analysis::stability::stability_limit;
use courant::analysis::waves::consistency::consistency;

/// `u_i − C (u_i − u_{i−1}) − (C/4)(1 − C)(u_{i+1} − u_i − u_{i−1} + u_{i−2})`: Fromm 1968.
struct Fromm;

impl Scheme for Fromm {
    fn symbol(&self) -> EnclosedSymbol {
        let quarter = |values: [i64; 4]| Stencil::new(-2, values.map(|v| ratio(v, 4)).to_vec());
        let upwind = Stencil::new(-1, vec![integer(-1), integer(1)]);
        let slope = quarter([1, -1, -1, 1]);
        EnclosedSymbol::exact(
            Symbol::identity()
                - Symbol::courant_power(1, upwind)
                - Symbol::courant_power(1, slope.clone())
                + Symbol::courant_power(2, slope),
        )
    }
}

fn main() {
    let symbol = Fromm.symbol();
    let limit = stability_limit(&symbol, &integer(10));
    println!("{}", symbol.to_text());
    println!("order      {:?}", consistency(&symbol).order);
    println!("stable to  {} ({})", limit.exact().expect("the limit is 1"), limit.evidence().name());
    assert_eq!(limit.value(), 1.0);
    assert_eq!(consistency(&symbol).order, Some(2));
}
