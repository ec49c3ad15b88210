use super::syntax::{Equations, Expression, Node, Offset, Unknown, Weight};
use super::{LONGEST_TEXT, LanguageError, parse, parse_expression};
use crate::exact::rational::{Rational, integer, ratio};

mod printing;
mod refusals;

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
