//! Every refusal with its place in the text, and what the manual says of them.

use super::*;

/// Text with the marked place between `»` and `«`, and a part of the message.
const REFUSED: &[(&str, &str)] = &[
    // Characters, numbers, brackets.
    ("u[n+1,j] = u[n,j] »$« 2", "unexpected character `$`"),
    ("u_j^»{«n+1} = u_j", "is no bracket here"),
    ("u[n+1,j] = C»²«*u[n,j]", "write a power with ^"),
    ("u[n+1,j] = »1.2.3«*u[n,j]", "`1.2.3` is not a number"),
    ("u[n+1,j] = »1e399«*u[n,j]", "out of range"),
    ("u[n+1,j] = »1e999«*u[n,j]", "out of range"),
    ("u[n+1,j] = C*»(«u[n,j] - u[n,j-1]", "`(` is never closed"),
    ("u[n+1,j] = C*»(«u[n,j]; u[n,j] = 0", "`(` is not closed before the `;`"),
    ("u[n+1,j] = C*u[n,j]»)«", "`)` closes no bracket"),
    ("u[n+1,j] = C*(u[n,j»)«", "`)` closes a `[`"),
    // Equations.
    ("»«", "there is no equation"),
    ("»  # nothing but a comment«", "there is no equation"),
    ("»u[n+1,j] - u[n,j]«", "no `=` in this equation"),
    ("u[n+1,j] = u[n,j]\n»- C*u[n,j-1]«", "a line that goes on ends in an operator"),
    ("u[n+1,j] = u[n,j] »=« 0", "a second `=`"),
    ("»=« u[n,j]", "one side of the equation is missing"),
    ("u[n+1,j] »=«", "something is missing after this"),
    ("u[n+1,j] = u[n,j] »+«; p[n,j] = 0", "something is missing after this"),
    ("u[n+1,j] = (u[n,j] »=« 0)", "`=` inside brackets"),
    ("»C = 1/2«\nu[n+1,j] = C*u[n,j]", "no unknown in this equation"),
    // Operators and operands.
    ("u[n+1,j] = 2»u«[n,j]", "a product needs its sign, as in 2*u[n,j]"),
    ("u[n+1,j] = C »u«[n,j]", "a product needs its sign"),
    ("u[n+1,j] = (1-C)»(«u[n,j])", "a product needs its sign"),
    ("u[n+1,j] = u[n,j] + »*« 2", "a number, a name or a bracket is missing"),
    ("u[n+1,j] = u[n,j]*(»)«", "a number, a name or a bracket is missing"),
    ("u[n+1,j] = 0»,«5*u[n,j]", "decimals have a point"),
    ("u[n+1,j] = »[«n,j]", "the name of an unknown is missing"),
    ("u[n+1,j] = (C)»[«n,j]", "follows the name of an unknown"),
    ("u[n+1,j] = u[n,j]^»(1/2)«", "the exponent is not an integer"),
    ("u[n+1,j] = u[n,j]*2^»C«", "the exponent is not an integer"),
    ("u[n+1,j] = u[n,j]*C^»0.5«", "the exponent is not an integer"),
    ("u[n+1,j] = u[n,j]*C^»101«", "the exponent is not an integer"),
    ("u[n+1,j] = u[n,j]*C^»2^-1«", "the exponent is not an integer"),
    ("u[n+1,j] = u[n,j]*(C^100)^»100«", "powers of powers"),
    ("u[n+1,j] = C»'«*u[n,j]", "a prime follows an unknown"),
    // Names and functions.
    ("u[n+1,j] = »sin«(x)*u[n,j]", "there is no function `sin`, only sqrt(…) and sum(k, …)"),
    ("u[n+1,j] = »C«(u[n,j] - u[n,j-1])", "a product is C*(…)"),
    ("u[n+1,j] = »sqrt«*u[n,j]", "sqrt is a function"),
    ("u[n+1,j] = »sum«*u[n,j]", "sum is a function"),
    ("u[n+1,j] = »pi«[n,j]", "pi is a number"),
    ("u[n+1,j] = »n«*u[n,j]", "n is an index and no parameter"),
    ("u[n+1,j] = »j«*u[n,j]", "j is an index and no parameter"),
    ("u[n+1,j] = »i«*u[n,j]", "i is an index and no parameter"),
    ("»j«[n+1,j] = u[n,j]", "j is an index and no parameter"),
    ("u[n+1,j] = »u«/2", "`u` is an unknown and needs its index, as in u[n+1,j]"),
    // Indices.
    ("u»[]« = 0", "there is no index; write u[n,j]"),
    ("u[n+1,j+»x«] = 0", "`x` in an index"),
    ("u[n,j,»n«] = 0", "the time index n stands first"),
    ("u[j,»n«] = 0", "the time index n stands first"),
    ("»u[n]« = 0", "has no index in space"),
    ("»u[n,i,j,k,k]« = 0", "more than three indices"),
    ("u[n,»j«,i] = 0", "`j` stands where i belongs: with 2 indices in space the order is i,j"),
    ("u[n,»i«] = 0", "`i` stands where j belongs: with 1 index in space the order is j"),
    ("u[n,j+»k«] = 0", "k is the running index of no sum around it"),
    ("u[n,»k«] = 0", "k is the running index of no sum around it"),
    ("u[n,»1«] = 0", "an index is relative to j"),
    ("u[n,»2*j«] = 0", "j has the factor 1"),
    ("u[»-n«,j] = 0", "n has the factor 1"),
    ("u[n,»j+0.3«] = 0", "not an integer or a half"),
    ("u[n+»j«,j] = 0", "`j` in the time index"),
    ("u[n,»j+100000000000«] = 0", "not an integer or a half"),
    ("u[n,»j*j«] = 0", "not understood in an index"),
    ("u[n,j+»pi«] = 0", "not understood in an index"),
    ("u[n,j+»u«[n,j]] = 0", "with brackets in an index"),
    ("u[n,j+»sqrt«(4)] = 0", "with brackets in an index"),
    ("»u[n,j]'« = 0", "a time derivative has no time index (method of lines); write u[j]'"),
    ("u[j]'»'« = u[j]", "only first derivatives"),
    ("u[n+1,j] = »u[j]«", "u[n+1,j] has the time index n and u[j] has none"),
    ("u[n+1,j] = »p[n,i,j]«", "u lives in one dimension and p in two dimensions"),
    // Sums and weights.
    ("u[n+1,j] = sum(k, w[k]*»sum«(m, u[n,j+m]))", "a sum in a sum"),
    ("u[n+1,j] = sum(»n«, u[n,j])", "a meaning of its own"),
    ("u[n+1,j] = sum(»2«, u[n,j])", "the running index is missing"),
    ("u[n+1,j] = sum(k»)«", "a comma belongs behind the running index"),
    ("u[n+1,j] = sum(k, »)«", "a number, a name or a bracket is missing"),
    ("u[n+1,j] = sum(k, u[n,j+k]»,« 3)", "a comma stands only between indices"),
    ("u[n+1,j] = w[»k«]*u[n,j]", "stands in no sum"),
    ("u[n+1,j] = sum(m, w[»k«]*u[n,j+m])", "is not the running index"),
    ("u[n+1,j] = sum(k, w[»k+1/2«]*u[n,j+k])", "is not an integer"),
    ("u[n+1,j] = sum(k, »w[k]'«*u[n,j+k])", "has no time derivative"),
    ("u[n+1,j] = sum(k, w[k]*u[n,»j+k/2«])", "the running index has an integer factor"),
    ("u[n+1,j] = sum(k, w[k]*u[n+»k«,j])", "`k` in the time index"),
    ("u[n+1,i,j,k] = sum(k, w[k]*u[n,i,j,»k«])", "k is an axis of i,j,k"),
    ("u[n+1,i,j,k] = »k«*u[n,i,j,k]", "k is the third axis"),
];

fn marked(error: &LanguageError) -> String {
    let (start, end) = (error.span.start, error.span.end);
    format!("{}»{}«{}", &error.text[..start], &error.text[start..end], &error.text[end..])
}

#[test]
fn every_refusal_marks_its_place() {
    for (expected, message) in REFUSED {
        let text = expected.replace(['»', '«'], "");
        match parse(&text) {
            Ok(_) => panic!("`{text}` is read"),
            Err(error) => {
                assert_eq!(marked(&error), *expected, "{error}");
                assert!(error.message.contains(message), "{}", error.message);
                assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }
}

#[test]
fn values_are_constant() {
    for (text, place, message) in [
        ("", 0..0, "there is no expression"),
        ("u[n,j]/2", 0..6, "an unknown in a value"),
        ("2*w[1]", 2..6, "a lattice weight in a value"),
        ("sum(k, k)", 0..9, "a sum in a value"),
        ("C = 2", 2..3, "`=` in a value"),
        ("1 2", 2..3, "a product needs its sign"),
        ("1\n2", 2..3, "a second value"),
        ("±2", 0..2, "unexpected character"),
        ("-i*C", 1..2, "i is an index"),
    ] {
        let error = parse_expression(text).expect_err(text);
        assert_eq!(error.span, place, "{error}");
        assert!(error.message.contains(message), "{}", error.message);
    }
}

#[test]
fn the_printed_line_is_short() {
    let long = format!("u[n+1,j] = {} $ {}", "u[n,j] + ".repeat(20), "u[n,j]".repeat(20));
    let error = parse(&long).unwrap_err();
    assert_eq!(
        error.to_string(),
        "unexpected character `$`: …j] + u[n,j] + u[n,j] +  »$« u[n,j]u[n,j]u[n,j]u[n,j…"
    );
    assert_eq!(
        parse("\n").unwrap_err().to_string(),
        "there is no equation; write one such as u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])"
    );
    let bell = parse("u[n+1,j] = \u{7} é").unwrap_err().to_string();
    assert!(!bell.contains(char::is_control), "{bell:?}");
    // Places that are no character boundaries, and beyond the end.
    let strange = LanguageError::new("?", "ééé", 1..99);
    assert_eq!(strange.to_string(), "?: »ééé«");
}

#[test]
fn the_manual_says_what_is_so() {
    let manual = include_str!("../../../../../docs/language.md");
    let blocks = |kind: &str| -> Vec<&str> {
        let opening = format!("```{kind}\n");
        let ends = |block: &'static str| block.split("```").next().unwrap_or(block);
        manual.split(opening.as_str()).skip(1).map(ends).collect()
    };
    let schemes = blocks("scheme");
    assert!(schemes.len() >= 30, "{}", schemes.len());
    for scheme in schemes {
        parse(scheme).unwrap_or_else(|error| panic!("{error}"));
        super::printing::assert_round_trip(scheme);
    }
    let refusals: Vec<&str> =
        blocks("refused").iter().flat_map(|block| block.split("\n\n")).collect();
    assert!(refusals.len() >= 60, "{}", refusals.len());
    for refusal in refusals {
        let (text, answer) = refusal.trim_end().split_once('\n').expect("a text and its answer");
        assert_eq!(parse(text).expect_err(text).to_string(), answer);
    }
}
