//! An expression in plain text, in LaTeX and in Coq: a single traversal, three notations.

use core::fmt;

use super::algebra::common;
use super::{Expression, Function, Node, PI, Product};

/// The notations.
#[derive(Clone, Copy, PartialEq)]
enum Notation {
    Text,
    Latex,
    Coq,
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.print(Notation::Text))
    }
}

impl Expression {
    /// The formula in LaTeX, for math mode.
    #[must_use]
    pub fn latex(self) -> String {
        self.print(Notation::Latex)
    }

    /// The formula as a term of Coq over its real numbers, constants exact; functions as Coq's library and Coquelicot name them.
    #[must_use]
    pub fn coq(self) -> String {
        self.print(Notation::Coq)
    }

    /// The same as an argument of a function.
    #[must_use]
    pub fn coq_argument(self) -> String {
        coq_bracketed(&self.coq())
    }

    fn print(self, notation: Notation) -> String {
        match self.0 {
            Node::Symbol { text: PI, .. } if notation == Notation::Coq => "PI".to_owned(),
            Node::Symbol { text, latex, .. } => notation.pick(text, latex).to_owned(),
            Node::Product(product) => notation.product(product),
            Node::Sum(terms) => notation.sum(terms),
            Node::Call { function, arguments } => {
                let arguments: Vec<String> = arguments.iter().map(|argument| argument.print(notation)).collect();
                notation.call(*function, &arguments)
            }
        }
    }
}

impl Notation {
    fn pick(self, text: &'static str, latex: &'static str) -> &'static str {
        if self == Self::Latex { latex } else { text }
    }

    fn brackets(self, inner: &str) -> String {
        format!("{}{inner}{}", self.pick("(", r"\left("), self.pick(")", r"\right)"))
    }

    /// Terms in their order, except that a positive term leads; common factors stand before a bracket.
    fn sum(self, terms: &[Product]) -> String {
        let (mut shared, rest) = common(terms);
        if shared != Product::number(1.0) {
            shared.factors.push((Expression::new(Node::Sum(rest)), 1));
            return self.product(&shared);
        }
        let first = terms.iter().position(|term| term.coefficient > 0.0).unwrap_or(0);
        let others = terms.iter().enumerate().filter(|(place, _)| *place != first);
        terms.iter().skip(first).take(1).chain(others.map(|(_, term)| term)).fold(String::new(), |sum, term| {
            let printed = self.product(term);
            match (sum.is_empty(), printed.strip_prefix('-')) {
                (true, _) => printed,
                (false, Some(magnitude)) => format!("{sum} - {magnitude}"),
                (false, None) => format!("{sum} + {printed}"),
            }
        })
    }

    fn product(self, product: &Product) -> String {
        let (over, under) = match (fraction(product.coefficient.abs()), self) {
            ((over, under), Self::Coq) => whole(over, under),
            (as_it_is, _) => as_it_is,
        };
        let sign = if product.coefficient < 0.0 { "-" } else { "" };
        // The circle constant, symbols by name, sums, functions: as formulas are written.
        let mut factors = product.factors.clone();
        factors.sort_by_key(|(factor, _)| match factor.0 {
            Node::Symbol { text: PI, .. } => (0, ""),
            Node::Symbol { text, .. } => (1, *text),
            Node::Product(_) | Node::Sum(_) => (2, ""),
            Node::Call { .. } => (3, ""),
        });
        let is_fraction = under != "1" || factors.iter().any(|(_, power)| *power < 0);
        let side = |number: String, sign: i32| -> Vec<String> {
            let factors: Vec<_> = factors.iter().copied().filter(|(_, power)| power * sign > 0).collect();
            match (number.as_str(), &factors[..]) {
                // The bar of the fraction holds a sum together.
                ("1", [(base, 1 | -1)]) if self == Self::Latex && is_fraction => vec![base.print(self)],
                ("1", _) => factors.iter().map(|&(base, power)| self.power(base, power.abs())).collect(),
                _ => {
                    let powers = factors.iter().map(|&(base, power)| self.power(base, power.abs()));
                    [number].into_iter().chain(powers).collect()
                }
            }
        };
        let (numerator, denominator) = (side(over, 1), side(under, -1));
        let times = if self == Self::Coq { " * " } else { " " };
        let above = if numerator.is_empty() { "1".to_owned() } else { numerator.join(times) };
        if denominator.is_empty() {
            return format!("{sign}{above}");
        }
        let below = denominator.join(times);
        match self {
            Self::Latex => format!(r"{sign}\frac{{{above}}}{{{below}}}"),
            Self::Coq => format!("{sign}{above} / {}", coq_bracketed(&below)),
            Self::Text if denominator.len() > 1 => format!("{sign}{above}/({below})"),
            Self::Text => format!("{sign}{above}/{below}"),
        }
    }

    fn power(self, base: Expression, power: i32) -> String {
        let printed = base.print(self);
        let printed = if matches!(base.0, Node::Sum(_)) { self.brackets(&printed) } else { printed };
        if power == 1 { printed } else { format!("{printed}^{power}") }
    }

    fn call(self, function: Function, arguments: &[String]) -> String {
        match (self, function, arguments) {
            (Self::Coq, ..) => format!("({})", coq_call(function, arguments)),
            (_, Function::select, [x, below, above]) => {
                let (when, otherwise) = (self.pick(" if ", r"\text{ if } "), self.pick(" else ", r"\text{ else } "));
                self.brackets(&format!("{above}{when}{x} > 0{otherwise}{below}"))
            }
            (Self::Latex, Function::sqrt, [x]) => format!(r"\sqrt{{{x}}}"),
            (Self::Latex, Function::abs, [x]) => format!(r"\left|{x}\right|"),
            (Self::Latex, Function::asin, [x]) => format!(r"\arcsin{}", self.brackets(x)),
            (Self::Latex, Function::acos, [x]) => format!(r"\arccos{}", self.brackets(x)),
            (Self::Latex, Function::atan, [x]) => format!(r"\arctan{}", self.brackets(x)),
            (Self::Latex, ..) => {
                let name = function.name().replace('_', r"\_");
                format!(r"\operatorname{{{name}}}{}", self.brackets(&arguments.join(", ")))
            }
            (Self::Text, ..) => format!("{}({})", function.name(), arguments.join(", ")),
        }
    }
}

/// A function's value in Coq, without brackets around it.
fn coq_call(function: Function, arguments: &[String]) -> String {
    let name = match (function, arguments) {
        (Function::select, [x, below, above]) => {
            return format!("if Rlt_dec 0 {} then {above} else {below}", coq_bracketed(x));
        }
        (Function::exp_m1, [x]) => return format!("exp {} - 1", coq_bracketed(x)),
        (Function::ln_1p, [x]) => return format!("ln (1 + {})", coq_bracketed(x)),
        (Function::atanh, [x]) => return format!("ln ((1 + {x}) / (1 - {x})) / 2", x = coq_bracketed(x)),
        (Function::floor, [x]) => return format!("IZR (Int_part {})", coq_bracketed(x)),
        (Function::abs, _) => "Rabs",
        (Function::min, _) => "Rmin",
        (Function::max, _) => "Rmax",
        (Function::pow, _) => "Rpower",
        _ => function.name(),
    };
    arguments.iter().fold(name.to_owned(), |call, argument| format!("{call} {}", coq_bracketed(argument)))
}

/// A term of Coq as an argument: a name, a number or a bracketed term as it is.
fn coq_bracketed(term: &str) -> String {
    let mut depth = 0;
    let mut outside = term.char_indices().filter(|&(place, letter)| {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        depth == 0 && place + 1 < term.len()
    });
    let is_name = term.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
    if is_name || outside.next().is_none() { term.to_owned() } else { format!("({term})") }
}

/// The same fraction of whole numbers, where the numerator is a decimal.
fn whole(over: String, under: String) -> (String, String) {
    match over.split_once('.') {
        Some((before, after)) => {
            let digits = format!("{before}{after}");
            (digits.trim_start_matches('0').to_owned(), format!("1{}", "0".repeat(after.len())))
        }
        None => (over, under),
    }
}

/// A number as numerator and denominator where a small denominator makes both whole, as a decimal over 1 elsewhere.
fn fraction(value: f64) -> (String, String) {
    let exact = (1..=64).map(f64::from).find(|denominator| (value * denominator).fract() == 0.0);
    match exact {
        Some(denominator) => (format!("{}", value * denominator), format!("{denominator}")),
        None => (format!("{value}"), "1".to_owned()),
    }
}
