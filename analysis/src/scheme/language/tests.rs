use super::syntax::{Equations, Expression, Node, Offset, Unknown, Weight};
use super::{LONGEST_TEXT, LanguageError, parse, parse_expression};
use crate::exact::rational::{Rational, integer, ratio};
use proptest::prelude::*;

/// The examples of the design, and one in three dimensions.
const EXAMPLES: [&str; 9] = [
    "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])                                # upwind",
    "u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])                            # leapfrog",
    "u[n+1,j] - r/2*(u[n+1,j+1] - 2*u[n+1,j] + u[n+1,j-1]) = u[n,j] + r/2*(u[n,j+1] - 2*u[n,j] + u[n,j-1])",
    "p[n,j] = u[n,j] - C*(u[n,j+1] - u[n,j]); u[n+1,j] = (u[n,j] + p[n,j] - C*(p[n,j] - p[n,j-1]))/2",
    "v[n+1/2,j+1/2] = v[n-1/2,j+1/2] - C*(p[n,j+1] - p[n,j]); p[n+1,j] = p[n,j] - C*(v[n+1/2,j+1/2] - v[n+1/2,j-1/2])",
    "u[n+1,i,j] = u[n,i,j] - A*(u[n,i,j] - u[n,i-1,j]) - B*(u[n,i,j] - u[n,i,j-1])",
    "u[j]' = -C*(u[j] - u[j-1])                                               # method of lines: t counts steps",
    "u[n+1,j] = u[n,j] - C*sum(k, w[k]*(u[n,j+k] - u[n,j-k]))                  # kernel sums",
    "u[n+1,i,j,k] = u[n,i,j,k] + C^2*sum(m, W[m]*(u[n,i+m,j,k] - u[n,i,j,k-m]))",
];

/// Without places, which no two ways of writing share.
fn bare(expression: &Expression) -> Expression {
    let again = |part: &Expression| Box::new(bare(part));
    let node = match &expression.node {
        Node::SquareRoot(a) => Node::SquareRoot(again(a)),
        Node::Negative(a) => Node::Negative(again(a)),
        Node::Power(a, exponent) => Node::Power(again(a), *exponent),
        Node::Sum { index, body } => Node::Sum { index: index.clone(), body: again(body) },
        Node::Add(a, b) => Node::Add(again(a), again(b)),
        Node::Subtract(a, b) => Node::Subtract(again(a), again(b)),
        Node::Multiply(a, b) => Node::Multiply(again(a), again(b)),
        Node::Divide(a, b) => Node::Divide(again(a), again(b)),
        leaf => leaf.clone(),
    };
    Expression { node, span: 0..0 }
}

fn bare_equations(equations: &Equations) -> Vec<[Expression; 2]> {
    equations
        .equations
        .iter()
        .map(|equation| [bare(&equation.left), bare(&equation.right)])
        .collect()
}

fn value(text: &str) -> Expression {
    bare(&parse_expression(text).unwrap_or_else(|error| panic!("{error}")))
}

/// The right side of `u[n+1,j] = …`.
fn right(text: &str) -> Expression {
    let equations = parse(&format!("u[n+1,j] = {text}")).unwrap_or_else(|error| panic!("{error}"));
    bare(&equations.equations[0].right)
}

fn number(value: Rational) -> Expression {
    Expression { node: Node::Number(value), span: 0..0 }
}

fn offset(halves: i32, index: i32) -> Offset {
    Offset { halves, index }
}

fn unknown(name: &str, time: Option<i32>, space: &[(i32, i32)]) -> Unknown {
    Unknown {
        name: name.into(),
        time: time.map(|halves| offset(halves, 0)),
        space: space.iter().map(|&(halves, index)| offset(halves, index)).collect(),
        derivative: false,
    }
}

#[test]
fn the_examples_of_the_design_are_read() {
    let counts =
        EXAMPLES.map(|text| parse(text).unwrap_or_else(|error| panic!("{error}")).equations.len());
    assert_eq!(counts, [1, 1, 1, 2, 2, 1, 1, 1, 1]);
    assert_eq!(parse(&EXAMPLES[..2].join("\n")).unwrap().equations.len(), 2);
}

#[test]
fn places_are_those_of_the_text() {
    let text = "u[n+1,j] = -C*(u[n,j] - 2)  # comment";
    let equations = parse(text).unwrap();
    let equation = &equations.equations[0];
    assert_eq!(&text[equation.span.clone()], "u[n+1,j] = -C*(u[n,j] - 2)");
    assert_eq!(&text[equation.left.span.clone()], "u[n+1,j]");
    let Node::Multiply(left, right) = &equation.right.node else { panic!("a product") };
    assert_eq!([&text[left.span.clone()], &text[right.span.clone()]], ["-C", "(u[n,j] - 2)"]);
}

#[test]
fn precedence_is_that_of_formulas() {
    for (text, bracketed) in [
        ("a + b*c", "a + (b*c)"),
        ("a - b - c", "(a - b) - c"),
        ("a/b*c", "(a/b)*c"),
        ("a/b/c", "(a/b)/c"),
        ("-a^2", "-(a^2)"),
        ("-a*b", "(-a)*b"),
        ("a*-b", "a*(-b)"),
        ("a - -b", "a - (-b)"),
        ("+a", "a"),
        ("2*a^2", "2*(a^2)"),
        ("a^2^3", "a^8"),
        ("a^-2", "a^(-2)"),
        ("a^-1^2", "a^(-1)"),
        ("a^(3-1)", "a^2"),
        ("a**2", "a^2"),
        ("a − b – c", "a - b - c"),
        ("a·b×c", "a*b*c"),
        ("π", "pi"),
        ("sqrt(3)/6", "(sqrt(3))/6"),
        ("-I*C*phi", "((-I)*C)*phi"),
    ] {
        assert_eq!(value(text), value(bracketed), "{text}");
    }
    assert_ne!(value("a - b - c"), value("a - (b - c)"));
}

#[test]
fn numbers_are_exact() {
    for (text, expected) in [
        ("2", integer(2)),
        ("0.5", ratio(1, 2)),
        (".5", ratio(1, 2)),
        ("5.", integer(5)),
        ("1e-3", ratio(1, 1000)),
        ("2.5E+2", integer(250)),
        ("1e−1", ratio(1, 10)),
        ("0.1", ratio(1, 10)),
    ] {
        assert_eq!(value(text), number(expected), "{text}");
    }
}

#[test]
fn the_index_decides_between_unknowns_and_weights() {
    let weight = |weight, halves, index| Node::Weight { weight, offset: offset(halves, index) };
    let lattice = |unknown| Node::Unknown(unknown);
    let body = |text: &str| match right(&format!("sum(k, {text}*u[n,j])")).node {
        Node::Sum { body, .. } => match body.node {
            Node::Multiply(left, _) => left.node,
            other => panic!("{other:?}"),
        },
        other => panic!("{other:?}"),
    };
    assert_eq!(body("w[k]"), weight(Weight::Slope, 0, 1));
    assert_eq!(body("v[k+1]"), weight(Weight::Curvature, 2, 1));
    assert_eq!(body("W[-2*k]"), weight(Weight::Value, 0, -2));
    assert_eq!(body("v[0]"), weight(Weight::Curvature, 0, 0));
    assert_eq!(body("v[n,j-k]"), lattice(unknown("v", Some(0), &[(0, -1)])));
    assert_eq!(body("v[n+1/2,j+k-0.5]"), lattice(unknown("v", Some(1), &[(-1, 1)])));
    assert_eq!(body("v[n,k-1+j]"), lattice(unknown("v", Some(0), &[(-2, 1)])));
    assert_eq!(body("u[n-3/2,j-(k-1)]"), lattice(unknown("u", Some(-3), &[(2, -1)])));

    let lines =
        parse("v[j]' = -C*(w[j+1/2] - w[j-1/2]); w[j+1/2]' = v[1]*(v[j+1] - v[j])").unwrap();
    let derivative = Unknown { derivative: true, ..unknown("v", None, &[(0, 0)]) };
    assert_eq!(lines.equations[0].left.node, Node::Unknown(derivative));
    let Node::Multiply(left, _) = &lines.equations[1].right.node else { panic!("a product") };
    assert_eq!(left.node, weight(Weight::Curvature, 2, 0));

    let solid = parse(EXAMPLES[8]).unwrap();
    let expected = unknown("u", Some(2), &[(0, 0), (0, 0), (0, 0)]);
    assert_eq!(solid.equations[0].left.node, Node::Unknown(expected));
    // In one and two dimensions k is a name like any other.
    assert!(parse("u[n+1,j] = k*u[n,j]").is_ok());
    assert!(parse("u[n+1,i,j] = sum(k, w[k]*u[n,i+k,j-k])").is_ok());
}

#[test]
fn lines_go_on_after_operators_and_inside_brackets() {
    let split = "\n\n u[n+1,j] =\n u[n,j] -  # what follows is the flux\n\n C*(u[n,j]\r\n - u[n,\n j-1])\n;\n# end\n";
    assert_eq!(
        bare_equations(&parse(split).unwrap()),
        bare_equations(&parse(EXAMPLES[0]).unwrap())
    );
    let two = parse("p[n,j] = u[n,j]\nu[n+1,j] = p[n,j];").unwrap();
    assert_eq!(two.equations.len(), 2);
    assert!(parse_expression("\n 1/2 # half\n").is_ok());
}

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

/// On a small stack: what is read must be walked, compared, printed and dropped by recursion.
fn on_a_small_stack(task: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(task).unwrap();
    thread.join().unwrap();
}

#[test]
fn large_texts_end_well() {
    on_a_small_stack(|| {
        let too_long = format!("u[n+1,j] = {}", "é".repeat(LONGEST_TEXT));
        assert!(parse(&too_long).unwrap_err().message.contains("longer than 20000"));
        let filled = |start: &str, middle: &str, end: &str| {
            let count = (LONGEST_TEXT - start.len() - end.len()) / middle.len();
            format!("{start}{}{end}", middle.repeat(count))
        };
        for (start, middle, end) in [
            ("u[n+1,j] = ", "(", "u[n,j]"),
            ("u[n+1,j] = ", "-", "u[n,j]"),
            ("u[n+1,j] = ", "+", "u[n,j]"),
            ("u[n+1,j] = u[n,j]", "+1", ""),
            ("u[n+1,j] = u[n,j]", "*9", ""),
            ("u[n+1,j] = u[n,j]", "^1", ""),
            ("u[n+1,j] = u[n,j]*9", "^9", ""),
            ("u[n+1,j] = u[n,j", "+1", "]"),
            ("u[n+1,j] = u[n,j", "*99999999", "]"),
            ("u[n+1,j] = u[n,j]^", "-", "1"),
            ("", "u[n,j]=1;", ""),
            ("", "u[", ""),
            ("", "'", ""),
            ("", "\n", ""),
            ("u[n+1,j]=u[n,", "j,", "j]"),
        ] {
            if let Ok(equations) = parse(&filled(start, middle, end)) {
                let printed = equations.to_string();
                assert_eq!(equations.clone(), equations);
                drop(printed);
            }
        }
        let nest = |depth| format!("u[n+1,j] = {}u[n,j]{}", "(".repeat(depth), ")".repeat(depth));
        assert!(parse(&nest(99)).is_ok());
        assert!(parse(&nest(100)).unwrap_err().message.contains("nested more than 100"));
        let sum = |terms| format!("u[n+1,j] = u[n,j]{}", "+1".repeat(terms));
        assert_eq!(parse(&sum(999)).map(|e| e.equations.len()), Ok(1));
        assert!(parse(&sum(1000)).unwrap_err().message.contains("more than 1000 operations"));
        // Towers of bracketed powers.
        let tower = format!("{}9^99{}", "(".repeat(50), ")^99".repeat(50));
        assert!(parse_expression(&tower).is_err());
        assert!(parse(&format!("u[n,j+{tower}] = 0")).is_err());
    });
}

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

fn assert_round_trip(text: &str) {
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
fn the_manual_says_what_is_so() {
    let manual = include_str!("../../../../docs/language.md");
    let blocks = |kind: &str| -> Vec<&str> {
        let opening = format!("```{kind}\n");
        let ends = |block: &'static str| block.split("```").next().unwrap_or(block);
        manual.split(opening.as_str()).skip(1).map(ends).collect()
    };
    let schemes = blocks("scheme");
    assert!(schemes.len() >= 30, "{}", schemes.len());
    for scheme in schemes {
        parse(scheme).unwrap_or_else(|error| panic!("{error}"));
        assert_round_trip(scheme);
    }
    let refusals: Vec<&str> =
        blocks("refused").iter().flat_map(|block| block.split("\n\n")).collect();
    assert!(refusals.len() >= 60, "{}", refusals.len());
    for refusal in refusals {
        let (text, answer) = refusal.trim_end().split_once('\n').expect("a text and its answer");
        assert_eq!(parse(text).expect_err(text).to_string(), answer);
    }
}

#[test]
fn examples_round_trip() {
    EXAMPLES.iter().for_each(|text| assert_round_trip(text));
}
