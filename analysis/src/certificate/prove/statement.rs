//! What a certificate is about: the names and the coefficients.

use super::super::{Certificate, CertifiedStencil, CertifiedSymbol, Exact, Proof, Subject};
use crate::exact::rational::Rational;
use crate::scheme::symbol::EnclosedSymbol;
use num_traits::Zero;

pub(super) fn certificate(
    symbol: &EnclosedSymbol,
    subject: Option<&crate::scheme::Discretisation>,
    proof: Proof,
) -> Certificate {
    let exact = |values: &[Rational]| values.iter().cloned().map(Exact).collect();
    let powers = symbol.even_radius().len();
    let stencils = (0..powers).map(|power| {
        let center = symbol.center().stencils().get(power);
        let radius = &symbol.coefficient_radius()[power];
        let reaches = center.and_then(|stencil| stencil.reach()).into_iter().chain(radius.reach());
        let reach = reaches.reduce(|(a, b), (c, d)| (a.min(c), b.max(d)));
        let (low, high) = reach.unwrap_or((0, -1));
        CertifiedStencil {
            lowest: low,
            coefficients: (low..=high)
                .map(|k| center.map_or_else(Rational::zero, |c| c.coefficient(k)).into())
                .collect(),
            radius: (low..=high).map(|k| radius.coefficient(k).into()).collect(),
        }
    });
    Certificate {
        subject: subject.map(|subject| Subject {
            scheme: subject.scheme().name().into(),
            kernel: subject.kernel().name().into(),
            ratio: subject.ratio().clone().into(),
        }),
        evidence: if symbol.is_exact() { "proved" } else { "enclosed" }.into(),
        symbol: CertifiedSymbol {
            stencils: stencils.collect(),
            even_radius: exact(symbol.even_radius()),
            odd_radius: exact(symbol.odd_radius()),
            keeps_constants: symbol.keeps_constants(),
        },
        proof,
    }
}
