//! Trees printed and read back, and texts that must not panic.

use super::*;
use proptest::prelude::*;

#[test]
fn printing_uses_no_more_brackets_than_needed() {
    for text in [
        "a - (b - c)",
        "a*(b + c)",
        "a/(b*c)",
        "-(a*b)",
        "(-a)^2",
        "-a^2",
        "--a",
        "a*-b",
        "(a^2)^3",
        "a^-2",
        "sqrt(a + 1)/2",
        "0.25*pi",
        "1e-30*1.5e40",
        "0.001*123000000",
    ] {
        assert_eq!(parse_expression(text).unwrap().to_string(), text);
    }
    let text = "v[n+1/2,j-1/2] = sum(m, w[m]*(v[n-1/2,j+m-1/2] - v[n-1/2,j-m+1])) + W[2]*v[n,j]\nv[n,j] = 0";
    assert_eq!(parse(text).unwrap().to_string(), text);
    let third = Expression { node: Node::Power(Box::new(number(ratio(-1, 3))), 2), span: 0..0 };
    assert_eq!(third.to_string(), "(-1/3)^2");
}

pub(super) fn assert_round_trip(text: &str) {
    if let Ok(equations) = parse(text) {
        let printed = equations.to_string();
        let again = parse(&printed).unwrap_or_else(|error| panic!("{printed}\n{error}"));
        assert_eq!(bare_equations(&again), bare_equations(&equations), "{text}");
    }
    if let Ok(value) = parse_expression(text) {
        let printed = value.to_string();
        let again = parse_expression(&printed).unwrap_or_else(|error| panic!("{printed}\n{error}"));
        assert_eq!(bare(&again), bare(&value), "{text}");
    }
}

/// Expressions of every kind, below a running index `m`.
fn trees() -> impl Strategy<Value = Expression> {
    let node = |node| Expression { node, span: 0..0 };
    let offsets = || (-5..6_i32, -2..3_i32).prop_map(|(halves, index)| offset(halves, index));
    let names = prop::sample::select(vec!["C", "alpha", "ratio", "m", "ν", "e1"]);
    let weights = prop::sample::select(vec![Weight::Value, Weight::Slope, Weight::Curvature]);
    let leaf = prop_oneof![
        (0..100_000_u32, -12..12_i32).prop_map(|(digits, power)| Node::Number(
            integer(digits.into()) * integer(10).pow(power)
        )),
        Just(Node::Pi),
        names.prop_map(|name| Node::Name(name.into())),
        (prop::sample::select(vec!["u", "v", "W"]), -3..4_i32, offsets(), offsets()).prop_map(
            |(name, time, first, second)| Node::Unknown(Unknown {
                name: name.into(),
                time: Some(offset(time, 0)),
                space: vec![first, second],
                derivative: false,
            })
        ),
        (weights, -3..4_i32, -2..3_i32).prop_map(|(weight, whole, index)| Node::Weight {
            weight,
            offset: offset(2 * whole, index)
        }),
    ]
    .prop_map(node);
    leaf.prop_recursive(4, 40, 2, move |part| {
        let boxed = || part.clone().prop_map(Box::new);
        prop_oneof![
            boxed().prop_map(Node::SquareRoot),
            boxed().prop_map(Node::Negative),
            (boxed(), -3..4_i32).prop_map(|(base, exponent)| Node::Power(base, exponent)),
            (boxed(), boxed()).prop_map(|(a, b)| Node::Add(a, b)),
            (boxed(), boxed()).prop_map(|(a, b)| Node::Subtract(a, b)),
            (boxed(), boxed()).prop_map(|(a, b)| Node::Multiply(a, b)),
            (boxed(), boxed()).prop_map(|(a, b)| Node::Divide(a, b)),
        ]
        .prop_map(node)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn no_text_panics(text in any::<String>()) {
        assert_round_trip(&text);
        if let Err(error) = parse(&text) { let _ = error.to_string(); }
    }

    #[test]
    fn no_row_of_tokens_panics(tokens in prop::collection::vec(prop::sample::select(vec![
        "u", "[", "]", "(", ")", "n", "i", "j", "k", "+", "-", "*", "/", "^", "=", ",", ";", "\n", "'", "1", "1/2", "0.5",
        "sum(k,", "sqrt(", "pi", "C", "w[k]", "u[n,j]", "u[n+1,j] =", "u[j]'", "#", " ", "é", "**", "2e",
    ]), 0..40)) {
        let text = tokens.concat();
        assert_round_trip(&text);
        if let Err(error) = parse(&text) { let _ = error.to_string(); }
    }

    #[test]
    fn mutated_examples_do_not_panic(
        example in 0..EXAMPLES.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0..3_u8, any::<char>(), any::<prop::sample::Index>()), 1..5),
    ) {
        let mut text: Vec<char> = EXAMPLES[example].chars().collect();
        for (place, change, new, other) in changes {
            let place = place.index(text.len());
            match change {
                0 => { text.remove(place); }
                1 => text.insert(place, new),
                _ => { let other = other.index(text.len()); text.swap(place, other); }
            }
        }
        let text: String = text.into_iter().collect();
        assert_round_trip(&text);
        if let Err(error) = parse(&text) { let _ = error.to_string(); }
    }

    #[test]
    fn printed_trees_are_read_back(body in trees()) {
        let text = format!("u[n+1,i,j] = sum(m, {})", {
            // The running index is known only to the sum around.
            let sum = Node::Sum { index: "m".into(), body: Box::new(body.clone()) };
            let printed = Expression { node: sum, span: 0..0 }.to_string();
            printed.trim_start_matches("sum(m, ").strip_suffix(')').unwrap().to_owned()
        });
        let read = parse(&text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        match &read.equations[0].right.node {
            Node::Sum { body: read, .. } => prop_assert_eq!(bare(read), body, "{}", text),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn examples_round_trip() {
    EXAMPLES.iter().for_each(|text| assert_round_trip(text));
}
