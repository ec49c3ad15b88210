//! The language of schemes read once more, without places for error messages.

use super::super::verify::{CertificateError, ensure};
use crate::exact::rational::{Rational, integer};
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// A tree.
#[derive(Debug, Clone)]
pub enum Tree {
    Number(Rational),
    Name(String),
    /// `name[items]`, and whether a prime follows.
    At(String, Vec<Tree>, bool),
    Root(Box<Tree>),
    Sum(String, Box<Tree>),
    Negative(Box<Tree>),
    /// `+ - * / ^`.
    Infix(char, Box<Tree>, Box<Tree>),
}

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Number(Rational),
    Name(String),
    Sign(char),
    End,
}

type Read<T> = Result<T, CertificateError>;

fn refuse<T>(message: impl Into<String>) -> Read<T> {
    Err(CertificateError(message.into()))
}

fn tokens(text: &str) -> Read<Vec<Token>> {
    ensure(text.chars().count() <= 20_000, "the text is too long")?;
    let characters: Vec<char> = text.chars().collect();
    let at = |place: usize| characters.get(place).copied().unwrap_or(' ');
    let superscript = |c: char| matches!(c, '²' | '³' | '¹' | '\u{2070}'..='\u{207f}');
    let mut found: Vec<Token> = Vec::new();
    let (mut place, mut depth) = (0, 0i32);
    while place < characters.len() {
        let first = at(place);
        let start = place;
        place += 1;
        if first.is_ascii_digit() || first == '.' {
            while at(place).is_ascii_digit() || at(place) == '.' {
                place += 1;
            }
            if matches!(at(place), 'e' | 'E') {
                let signed = usize::from(matches!(at(place + 1), '+' | '-' | '−'));
                if at(place + 1 + signed).is_ascii_digit() {
                    place += 1 + signed;
                    while at(place).is_ascii_digit() {
                        place += 1;
                    }
                }
            }
            let word: String = characters[start..place].iter().collect();
            found.push(Token::Number(written_number(&word)?));
            continue;
        }
        if first.is_alphabetic() && !superscript(first) || first == '_' {
            while (at(place).is_alphanumeric() || at(place) == '_') && !superscript(at(place)) {
                place += 1;
            }
            found.push(Token::Name(characters[start..place].iter().collect()));
            continue;
        }
        let sign = match first {
            '\n' | '\r' => {
                let open = matches!(found.last(), Some(Token::Sign(c)) if "+-*/^=,".contains(*c));
                if depth == 0 && !open {
                    found.push(Token::Sign(';'));
                }
                continue;
            }
            '#' => {
                while place < characters.len() && !matches!(at(place), '\n' | '\r') {
                    place += 1;
                }
                continue;
            }
            c if c.is_whitespace() || c == '\u{feff}' => continue,
            '*' if at(place) == '*' => {
                place += 1;
                '^'
            }
            '·' | '⋅' | '×' => '*',
            '−' | '–' => '-',
            '′' | '’' => '\'',
            c if "+-*/^=,;'()[]".contains(c) => c,
            c => return refuse(format!("the text is not understood at {:?}", c)),
        };
        depth += i32::from(matches!(sign, '(' | '[')) - i32::from(matches!(sign, ')' | ']'));
        ensure(depth <= 100, "brackets are nested too deep")?;
        found.push(Token::Sign(sign));
    }
    found.push(Token::End);
    Ok(found)
}

fn written_number(word: &str) -> Read<Rational> {
    let word = word.replace('−', "-").to_ascii_lowercase();
    let (mantissa, exponent) = word.split_once('e').unwrap_or((&word, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    let (Ok(digits), Ok(exponent)) = (digits.parse(), exponent.parse::<i32>()) else {
        return refuse("a number is not understood");
    };
    ensure(exponent.abs() <= 400 && mantissa.len() <= 400, "a number is out of range")?;
    Ok(Rational::from_integer(digits) * integer(10).pow(exponent - fraction.len() as i32))
}

/// Equations as `left − right`.
pub fn equations(text: &str) -> Read<Vec<Tree>> {
    let mut parser = Parser { tokens: tokens(text)?, place: 0 };
    let mut found = Vec::new();
    loop {
        match parser.peek() {
            Token::End => break,
            Token::Sign(';') => parser.place += 1,
            _ => {
                let left = parser.sum()?;
                parser.expect('=')?;
                let right = parser.sum()?;
                ensure(
                    matches!(parser.peek(), Token::End | Token::Sign(';')),
                    "an equation does not end where it should",
                )?;
                found.push(Tree::Infix('-', left.into(), right.into()));
            }
        }
    }
    ensure(!found.is_empty(), "there is no equation")?;
    Ok(found)
}

/// A single value.
pub fn value(text: &str) -> Read<Tree> {
    let mut parser = Parser { tokens: tokens(text)?, place: 0 };
    let tree = parser.sum()?;
    ensure(*parser.peek() == Token::End, "a single value is expected")?;
    Ok(tree)
}

struct Parser {
    tokens: Vec<Token>,
    place: usize,
}

impl Parser {
    fn peek(&self) -> &Token {
        self.tokens.get(self.place).unwrap_or(&Token::End)
    }

    fn sign(&mut self, accepted: &str) -> Option<char> {
        match *self.peek() {
            Token::Sign(c) if accepted.contains(c) => {
                self.place += 1;
                Some(c)
            }
            _ => None,
        }
    }

    fn expect(&mut self, sign: char) -> Read<()> {
        let found = self.sign(sign.encode_utf8(&mut [0; 4])).is_some();
        if found { Ok(()) } else { refuse(format!("`{sign}` is expected")) }
    }

    fn infix(&mut self, signs: &str, next: impl Fn(&mut Self) -> Read<Tree>) -> Read<Tree> {
        let mut left = next(self)?;
        let mut count = 0;
        while let Some(sign) = self.sign(signs) {
            left = Tree::Infix(sign, left.into(), next(self)?.into());
            count += 1;
            ensure(count <= 1000, "a formula is too long")?;
        }
        Ok(left)
    }

    fn sum(&mut self) -> Read<Tree> {
        self.infix("+-", |parser| parser.infix("*/", Self::signed))
    }

    fn signs(&mut self) -> bool {
        let mut negative = false;
        while let Some(sign) = self.sign("+-") {
            negative ^= sign == '-';
        }
        negative
    }

    fn signed(&mut self) -> Read<Tree> {
        let negative = self.signs();
        let power = self.power(0)?;
        Ok(if negative { Tree::Negative(power.into()) } else { power })
    }

    fn power(&mut self, storey: usize) -> Read<Tree> {
        let base = self.atom()?;
        if self.sign("^").is_none() {
            return Ok(base);
        }
        ensure(storey < 100, "a tower of powers is too high")?;
        let negative = self.signs();
        let exponent = self.power(storey + 1)?;
        let exponent = if negative { Tree::Negative(exponent.into()) } else { exponent };
        Ok(Tree::Infix('^', base.into(), exponent.into()))
    }

    fn atom(&mut self) -> Read<Tree> {
        let token = self.peek().clone();
        self.place += 1;
        match token {
            Token::Number(value) => Ok(Tree::Number(value)),
            Token::Sign('(') => {
                let inner = self.sum()?;
                self.expect(')')?;
                Ok(inner)
            }
            Token::Name(name) => self.named(name),
            _ => refuse("a number, a name or a bracket is expected"),
        }
    }

    fn named(&mut self, name: String) -> Read<Tree> {
        if self.sign("(").is_some() {
            let tree = match name.as_str() {
                "sqrt" => Tree::Root(self.sum()?.into()),
                "sum" => {
                    let Token::Name(index) = self.peek().clone() else {
                        return refuse("a running index is expected");
                    };
                    self.place += 1;
                    self.expect(',')?;
                    Tree::Sum(index, self.sum()?.into())
                }
                _ => return refuse("there is no such function"),
            };
            self.expect(')')?;
            return Ok(tree);
        }
        if self.sign("[").is_some() {
            let mut items = vec![self.sum()?];
            while self.sign(",").is_some() {
                items.push(self.sum()?);
            }
            self.expect(']')?;
            let prime = self.sign("'").is_some();
            return Ok(Tree::At(name, items, prime));
        }
        Ok(Tree::Name(name))
    }
}

/// A number plus multiples of names, the number under the empty one; no multiple is zero.
pub fn affine(tree: &Tree) -> Read<BTreeMap<String, Rational>> {
    let mut result = match tree {
        Tree::Number(value) => [(String::new(), value.clone())].into(),
        Tree::Name(name) => [(name.clone(), Rational::one())].into(),
        Tree::Negative(inner) => scaled(affine(inner)?, &-Rational::one()),
        Tree::Infix(sign, left, right) => {
            let (mut a, mut b) = (affine(left)?, affine(right)?);
            if matches!(sign, '+' | '-') {
                let b = if *sign == '-' { scaled(b, &-Rational::one()) } else { b };
                for (name, multiple) in b {
                    *a.entry(name).or_insert_with(Rational::zero) += multiple;
                }
                a
            } else {
                if *sign == '*' && a.keys().all(String::is_empty) {
                    (a, b) = (b, a);
                }
                ensure(b.keys().all(String::is_empty), "an index or exponent is not linear")?;
                let b = b.remove("").unwrap_or_else(Rational::zero);
                ensure(*sign == '*' || !b.is_zero(), "an index or exponent is not defined")?;
                match sign {
                    '*' => scaled(a, &b),
                    '/' => scaled(a, &b.recip()),
                    _ => {
                        ensure(a.keys().all(String::is_empty), "an exponent is no number")?;
                        let base = a.remove("").unwrap_or_else(Rational::zero);
                        let power = whole(&b, 100)?;
                        let small = base.abs() <= integer(1000) && *base.denom() <= 1000.into();
                        ensure(small, "an exponent is no number")?;
                        ensure(!base.is_zero() || power > 0, "a quotient by zero")?;
                        [(String::new(), base.pow(power))].into()
                    }
                }
            }
        }
        _ => return refuse("an index or exponent is not understood"),
    };
    result.retain(|_, multiple| !multiple.is_zero());
    Ok(result)
}

fn scaled(mut values: BTreeMap<String, Rational>, factor: &Rational) -> BTreeMap<String, Rational> {
    values.values_mut().for_each(|value| *value *= factor);
    values
}

/// A whole number that is not too large.
pub fn whole(value: &Rational, most: i32) -> Read<i32> {
    let small = value.is_integer() && value.abs() <= integer(most.into());
    ensure(small, "a number is not whole, or too large")?;
    Ok(value.to_integer().to_i32().unwrap_or(0))
}
