//! An expression in plain text and in LaTeX: one traversal, two notations.

use core::fmt;

use super::algebra::common;
use super::{Expression, Function, Node, PI, Product};

/// What differs between the two.
#[derive(Clone, Copy, PartialEq)]
enum Notation {
    Text,
    Latex,
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

    fn print(self, notation: Notation) -> String {
        match self.0 {
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
        if self == Self::Text { text } else { latex }
    }

    fn brackets(self, inner: &str) -> String {
        format!("{}{inner}{}", self.pick("(", r"\left("), self.pick(")", r"\right)"))
    }

    /// Terms in the order they came but a positive one first, what they share before a bracket.
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
        let (over, under) = fraction(product.coefficient.abs());
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
        let above = if numerator.is_empty() { "1".to_owned() } else { numerator.join(" ") };
        if denominator.is_empty() {
            return format!("{sign}{above}");
        }
        let below = denominator.join(" ");
        match self {
            Self::Latex => format!(r"{sign}\frac{{{above}}}{{{below}}}"),
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

/// A number as numerator and denominator where a small denominator makes both whole, as a decimal over one elsewhere.
fn fraction(value: f64) -> (String, String) {
    let exact = (1..=64).map(f64::from).find(|denominator| (value * denominator).fract() == 0.0);
    match exact {
        Some(denominator) => (format!("{}", value * denominator), format!("{denominator}")),
        None => (format!("{value}"), "1".to_owned()),
    }
}
