//! Bounds on counts and lengths, so that nothing in a file makes the checker run for long or overflow.

use super::super::{Certificate, Exact, IntegratorStatement, LineProof, Proof, TorusProof};
use super::{CertificateError, ensure};
use crate::exact::rational::Rational;
use num_traits::{One, Signed};

const MOST: usize = 1000;
const LONGEST: usize = 20_000;

/// Cuts of one polynomial.
const MOST_CUTS: usize = 200_000;

/// The same bounds as in `docs/certificate_form.py`.
pub(super) fn check(certificate: &Certificate) -> Result<(), CertificateError> {
    let subject = &certificate.subject;
    let short = |text: &String, most: usize| text.chars().count() <= most;
    ensure(
        short(&subject.equations, LONGEST)
            && short(&subject.parameter, 200)
            && subject.values.len() <= 12
            && subject.values.keys().all(|name| short(name, 200)),
        "the subject is too long",
    )?;
    if let Some(integrator) = &subject.integrator {
        let rows: Vec<&Vec<String>> = match integrator {
            IntegratorStatement::RungeKutta { a, b } => a.iter().chain([b]).collect(),
            IntegratorStatement::Multistep { alpha, beta } => vec![alpha, beta],
            IntegratorStatement::Nystrom {
                c,
                position,
                velocity,
                position_weights,
                velocity_weights,
            } => [c, position_weights, velocity_weights]
                .into_iter()
                .chain(position.iter().chain(velocity))
                .collect(),
        };
        let entries = rows.iter().flat_map(|row| row.iter());
        ensure(
            rows.len() <= 200 && rows.iter().all(|row| row.len() <= 64) && { entries }
                .all(|text| short(text, 400)),
            "the integrator is too long",
        )?;
    }
    ensure(certificate.levels.len() <= 64, "a list is too long")?;
    match &certificate.proof {
        Proof::Line(line) => check_line(line),
        Proof::Torus(torus) => check_torus(torus),
    }
}

fn check_torus(proof: &TorusProof) -> Result<(), CertificateError> {
    let short = |text: &String, most: usize| text.chars().count() <= most;
    let small = |k: &[i32]| k.len() <= 3 && k.iter().all(|k| k.unsigned_abs() as usize <= MOST);
    ensure(proof.inequalities.len() <= 2 * MOST, "a list is too long")?;
    for stated in &proof.inequalities {
        ensure(
            stated.level <= MOST
                && short(&stated.square, LONGEST)
                && stated.margin.len() <= LONGEST
                && stated.margin.iter().all(|term| term.power <= MOST && small(&term.k))
                && stated.cells.len() <= 64,
            "a count is out of range",
        )?;
        let pieces = || stated.cells.iter().flat_map(|cell| &cell.pieces);
        ensure(
            stated.cells.iter().all(|cell| cell.pieces.len() <= LONGEST)
                && pieces().all(|piece| {
                    piece.cuts.len() <= MOST && piece.cuts.iter().all(|cuts| short(cuts, MOST_CUTS))
                }),
            "a list is too long",
        )?;
    }
    let waves = [&proof.below, &proof.above].into_iter().flatten();
    let short_ways = waves.map(|wave| &wave.wave).all(|wave| short(&wave.way, 400));
    ensure(short_ways, "a way is too long")
}

fn check_line(proof: &LineProof) -> Result<(), CertificateError> {
    let lists = proof.covers.iter().map(|cover| cover.pieces.len());
    let waves = proof.covers.iter().flat_map(|cover| &cover.pieces);
    ensure(
        proof.inequalities.len() <= 2 * MOST && { lists }.all(|length| length <= LONGEST) && {
            waves
        }
        .all(|piece| piece.waves.len() <= LONGEST),
        "a list is too long",
    )?;
    for stated in &proof.inequalities {
        let margin = &stated.margin;
        let columns = margin.coefficients.first().map_or(0, Vec::len);
        let counts =
            [margin.phase_power, margin.complement_power, margin.courant_power, stated.level];
        let lists = [
            columns,
            margin.coefficients.len(),
            margin.neutral_waves.len(),
            stated.weight.len(),
            stated.square.len(),
        ];
        ensure(
            counts.iter().all(|&count| count <= MOST)
                && lists.iter().all(|length| (1..=MOST).contains(length))
                && stated.square.iter().all(|row| row.len() <= MOST)
                && [1, 2].contains(&margin.stride),
            "a count is out of range",
        )?;
        ensure(
            margin.coefficients.iter().all(|row| row.len() == columns)
                && margin.radius.len() == margin.coefficients.len(),
            "the polynomial is not a rectangle of coefficients",
        )?;
        let whole = |value: &Exact| value.0.denom().is_one();
        let numbers = || margin.coefficients.iter().flatten().chain(&margin.radius);
        ensure(
            numbers().chain([&margin.denominator]).all(whole)
                && margin.denominator.0.is_positive()
                && margin.radius.iter().all(|radius| !radius.0.is_negative())
                && margin.neutral_waves.last().is_some_and(|h: &Exact| Rational::is_positive(&h.0)),
            "the polynomial is not written in whole numbers",
        )?;
    }
    Ok(())
}
