//! Formulas as an arithmetic: evaluating a generic formula over symbols gives the formula itself, to print.

mod print;

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;

/// A formula over named quantities, kept as a fraction of powers or as a sum of such.
///
/// It is an arithmetic like any other, so a formula printed from it is the formula the program evaluates: `2 x / (x x)`
/// comes out as `2/x`. Collecting powers and equal terms is all the algebra it does; it cancels `x/x` without asking
/// whether `x` is zero. [`Display`](core::fmt::Display) gives plain text, [`latex`](Self::latex) LaTeX.
///
/// Its nodes are never freed (an arithmetic is `Copy`): meant for formulas of a page, not for long computations.
///
/// ```
/// use selfosc::numeric::{Expression, Real};
/// let (level, amplitude) = (Expression::symbol("C", "C"), Expression::symbol("X_m", "X_m"));
/// let gain = Expression::from_f64(4.0) * level / (Expression::pi() * amplitude);
/// assert_eq!(gain.to_string(), "4 C/(pi X_m)");
/// assert_eq!((gain * amplitude).latex(), r"\frac{4 C}{\pi}");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expression(&'static Node);

#[derive(Debug, PartialEq)]
enum Node {
    Symbol { text: &'static str, latex: &'static str },
    Product(Product),
    Sum(Vec<Expression>),
    Call { function: Function, arguments: Vec<Expression> },
}

/// `coefficient` times powers of expressions that are not products themselves; a number has no factors.
#[derive(Clone, Debug, PartialEq)]
struct Product {
    coefficient: f64,
    factors: Vec<(Expression, i32)>,
}

macro_rules! functions {
    ($($function:ident)+) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(non_camel_case_types, reason = "a function's name is how it is printed")]
        enum Function { $($function,)+ min, max, pow, select }

        impl Function {
            fn name(self) -> &'static str {
                match self {
                    $(Self::$function => stringify!($function),)+
                    Self::min => "min",
                    Self::max => "max",
                    Self::pow => "pow",
                    Self::select => "select",
                }
            }
            fn apply<T: Real>(self, arguments: &[T]) -> Option<T> {
                match (self, arguments) {
                    $((Self::$function, &[x]) => Some(x.$function()),)+
                    (Self::min, &[x, y]) => Some(x.min(y)),
                    (Self::max, &[x, y]) => Some(x.max(y)),
                    (Self::pow, &[x, y]) => Some(x.pow(y)),
                    (Self::select, &[x, below, above]) => Some(x.select(|| below, || above)),
                    _ => None,
                }
            }
        }

        impl Real for Expression {
            fn from_f64(value: f64) -> Self {
                Product::number(value).expression()
            }
            fn pi() -> Self {
                Self::symbol("pi", r"\pi")
            }
            /// A number's own value; nothing is known of a symbol.
            fn bounds(self) -> (f64, f64) {
                self.number().map_or((f64::NEG_INFINITY, f64::INFINITY), |value| (value, value))
            }
            fn min(self, other: Self) -> Self {
                Self::call(Function::min, [self, other])
            }
            fn max(self, other: Self) -> Self {
                Self::call(Function::max, [self, other])
            }
            fn pow(self, exponent: Self) -> Self {
                Self::call(Function::pow, [self, exponent])
            }
            /// Both cases are kept; a number decides.
            fn select(self, below: impl FnOnce() -> Self, above: impl FnOnce() -> Self) -> Self {
                match self.number() {
                    Some(value) => if value > 0.0 { above() } else { below() },
                    None => Self::call(Function::select, [self, below(), above()]),
                }
            }
            fn minus_sine(self, sine: Self) -> Self {
                self - sine
            }
            $(
                fn $function(self) -> Self {
                    Self::call(Function::$function, [self])
                }
            )+
        }
    };
}

functions!(abs sqrt sin cos tan asin acos atan exp exp_m1 ln ln_1p sinh cosh tanh atanh floor);

impl Expression {
    /// A quantity by its name in plain text and in LaTeX.
    #[must_use]
    pub fn symbol(text: &'static str, latex: &'static str) -> Self {
        Self::new(Node::Symbol { text, latex })
    }

    /// The formula's value in another arithmetic, where `of` gives the value of a symbol by its plain name and the circle
    /// constant is known; `None` where `of` does not know a symbol.
    pub fn value<T: Real>(self, of: &impl Fn(&str) -> Option<T>) -> Option<T> {
        match self.0 {
            Node::Symbol { text: "pi", .. } => Some(T::pi()),
            Node::Symbol { text, .. } => of(text),
            Node::Product(Product { coefficient, factors }) => {
                factors.iter().try_fold(T::from_f64(*coefficient), |product, &(factor, power)| {
                    let factor = factor.value(of)?;
                    let times = |product: T| if power > 0 { product * factor } else { product / factor };
                    Some((0..power.unsigned_abs()).fold(product, |product, _| times(product)))
                })
            }
            Node::Sum(terms) => terms.iter().try_fold(T::zero(), |sum, term| Some(sum + term.value(of)?)),
            Node::Call { function, arguments } => {
                let arguments: Option<Vec<T>> = arguments.iter().map(|argument| argument.value(of)).collect();
                function.apply(&arguments?)
            }
        }
    }

    fn new(node: Node) -> Self {
        Self(Box::leak(Box::new(node)))
    }

    fn call<const N: usize>(function: Function, arguments: [Self; N]) -> Self {
        Self::new(Node::Call { function, arguments: arguments.into() })
    }

    fn number(self) -> Option<f64> {
        match self.0 {
            Node::Product(Product { coefficient, factors }) if factors.is_empty() => Some(*coefficient),
            _ => None,
        }
    }

    fn product(self) -> Product {
        match self.0 {
            Node::Product(product) => product.clone(),
            _ => Product { coefficient: 1.0, factors: vec![(self, 1)] },
        }
    }

    fn terms(self) -> Vec<Product> {
        match self.0 {
            Node::Sum(terms) => terms.iter().map(|term| term.product()).collect(),
            _ => vec![self.product()],
        }
    }
}

impl Product {
    fn number(value: f64) -> Self {
        Self { coefficient: value, factors: Vec::new() }
    }

    fn times(mut self, other: Self, sign: i32) -> Self {
        self.coefficient = if sign > 0 { self.coefficient * other.coefficient } else { self.coefficient / other.coefficient };
        for (factor, power) in other.factors {
            match self.factors.iter_mut().find(|(present, _)| *present == factor) {
                Some((_, present)) => *present += sign * power,
                None => self.factors.push((factor, sign * power)),
            }
        }
        self.factors.retain(|&(_, power)| power != 0);
        self
    }

    fn expression(self) -> Expression {
        match self.factors[..] {
            [(factor, 1)] if self.coefficient == 1.0 => factor,
            _ if self.coefficient == 0.0 => Expression::new(Node::Product(Self::number(0.0))),
            _ => Expression::new(Node::Product(self)),
        }
    }
}

impl Add for Expression {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mut sum: Vec<Product> = self.terms();
        for term in other.terms() {
            match sum.iter_mut().find(|present| present.factors == term.factors) {
                Some(present) => present.coefficient += term.coefficient,
                None => sum.push(term),
            }
        }
        sum.retain(|term| term.coefficient != 0.0);
        let mut terms: Vec<Self> = sum.into_iter().map(Product::expression).collect();
        match terms.len() {
            0 => Self::zero(),
            1 => terms.remove(0),
            _ => Self::new(Node::Sum(terms)),
        }
    }
}

impl Sub for Expression {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Expression {
    type Output = Self;
    fn neg(self) -> Self {
        match self.0 {
            Node::Sum(terms) => Self::new(Node::Sum(terms.iter().map(|&term| -term).collect())),
            _ => Self::from_f64(-1.0) * self,
        }
    }
}

impl Mul for Expression {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.product().times(other.product(), 1).expression()
    }
}

impl Div for Expression {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.product().times(other.product(), -1).expression()
    }
}
