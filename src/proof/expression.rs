//! Formulas as an arithmetic: evaluating a generic formula over symbols gives the formula itself, to print.

mod algebra;
mod print;

use core::ops::Neg;

use crate::numeric::{Interval, Real};

/// A formula over named quantities, each within an interval.
///
/// It implements the arithmetic trait: a formula printed from it is the formula the program evaluates: `2 x / (x x)`
/// comes out as `2/x`. It collects powers and equal terms, multiplies a single term into a sum, and writes
/// `(a + b)(a - b)` as a difference of squares; it cancels `x/x` without asking whether `x` is zero. `min`, `max` and
/// `select` that the intervals decide are gone from the result, which therefore holds **for quantities in those
/// intervals**. [`Display`](core::fmt::Display) gives plain text, [`latex`](Self::latex) LaTeX.
///
/// Its nodes are never freed (an arithmetic is `Copy`): meant for formulas of a page, not for long computations.
///
/// ```
/// use selfosc::numeric::{Interval, Real};
/// use selfosc::proof::Expression;
/// let level = Expression::symbol("C", "C", Interval::new(1.0, 2.0).unwrap());
/// let amplitude = Expression::symbol("X_m", "X_m", Interval::new(1.0, 2.0).unwrap());
/// let gain = Expression::from_f64(4.0) * level.max(Real::zero()) / (Expression::pi() * amplitude);
/// assert_eq!(gain.to_string(), "4 C/(pi X_m)");
/// assert_eq!((gain * amplitude).latex(), r"\frac{4 C}{\pi}");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expression(&'static Node);

#[derive(Debug, PartialEq)]
enum Node {
    Symbol { text: &'static str, latex: &'static str, within: Interval },
    Product(Product),
    Sum(Vec<Product>),
    Call { function: Function, arguments: Vec<Expression> },
}

/// `coefficient` times powers of expressions that are not products themselves; a number has no factors.
#[derive(Clone, Debug, PartialEq)]
struct Product {
    coefficient: f64,
    factors: Vec<(Expression, i32)>,
}

/// Declares the functions of a single argument, and implements the arithmetic.
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
                Self::symbol(PI, r"\pi", Interval::PI)
            }
            /// Of the formula's values for quantities in their intervals.
            fn bounds(self) -> (f64, f64) {
                self.range().bounds()
            }
            fn min(self, other: Self) -> Self {
                match (self.bounds(), other.bounds()) {
                    (a, b) if a.1 <= b.0 => self,
                    (a, b) if b.1 <= a.0 => other,
                    _ => Self::call(Function::min, [self, other]),
                }
            }
            fn max(self, other: Self) -> Self {
                match (self.bounds(), other.bounds()) {
                    (a, b) if a.0 >= b.1 => self,
                    (a, b) if b.0 >= a.1 => other,
                    _ => Self::call(Function::max, [self, other]),
                }
            }
            fn pow(self, exponent: Self) -> Self {
                Self::call(Function::pow, [self, exponent])
            }
            fn select_all<const N: usize>(
                self,
                below: impl FnOnce() -> [Self; N],
                above: impl FnOnce() -> [Self; N],
            ) -> [Self; N] {
                match self.bounds() {
                    (lower, _) if lower > 0.0 => above(),
                    (_, upper) if upper <= 0.0 => below(),
                    _ => {
                        let (below, above) = (below(), above());
                        core::array::from_fn(|k| Self::call(Function::select, [self, below[k], above[k]]))
                    }
                }
            }
            fn inflate(self, _: f64) -> Self {
                self
            }
            fn minus_own_sine(self, sine: Self) -> Self {
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

impl Function {
    /// Whether `f(-x) = -f(x)`.
    fn is_odd(self) -> bool {
        matches!(self, Self::sin | Self::tan | Self::asin | Self::atan | Self::sinh | Self::tanh | Self::atanh)
    }
}

/// The plain name of the circle constant.
const PI: &str = "pi";

impl Expression {
    /// A quantity by its name in plain text and in LaTeX, and where it lies.
    #[must_use]
    pub fn symbol(text: &'static str, latex: &'static str, within: Interval) -> Self {
        Self::new(Node::Symbol { text, latex, within })
    }

    /// The formula's value in another arithmetic, where `of` gives the value of a symbol by its plain name; the circle
    /// constant has its own. `None` where `of` does not know a symbol.
    pub fn value<T: Real>(self, of: &impl Fn(&str) -> Option<T>) -> Option<T> {
        self.evaluate(&|text, _| of(text))
    }

    /// Encloses the values for quantities in their intervals.
    fn range(self) -> Interval {
        self.evaluate(&|_, within| Some(within)).unwrap_or(Interval::ENTIRE)
    }

    fn evaluate<T: Real>(self, of: &impl Fn(&str, Interval) -> Option<T>) -> Option<T> {
        match self.0 {
            Node::Symbol { text, .. } if *text == PI => Some(T::pi()),
            Node::Symbol { text, within, .. } => of(text, *within),
            Node::Product(product) => product.evaluate(of),
            Node::Sum(terms) => terms.iter().try_fold(T::zero(), |sum, term| Some(sum + term.evaluate(of)?)),
            Node::Call { function, arguments } => {
                let arguments: Option<Vec<T>> = arguments.iter().map(|argument| argument.evaluate(of)).collect();
                function.apply(&arguments?)
            }
        }
    }

    fn new(node: Node) -> Self {
        Self(Box::leak(Box::new(node)))
    }

    fn call<const N: usize>(function: Function, arguments: [Self; N]) -> Self {
        if function.is_odd() && arguments.iter().any(|argument| argument.leads_negative()) {
            return -Self::call(function, arguments.map(Neg::neg));
        }
        let numbers: Option<Vec<f64>> = arguments.iter().map(|argument| argument.number()).collect();
        let value = numbers.and_then(|numbers| function.apply(&numbers)).filter(|value| value.fract() == 0.0);
        value.map_or_else(|| Self::new(Node::Call { function, arguments: arguments.into() }), Self::from_f64)
    }

    fn number(self) -> Option<f64> {
        match self.0 {
            Node::Product(Product { coefficient, factors }) if factors.is_empty() => Some(*coefficient),
            _ => None,
        }
    }
}

impl Product {
    fn evaluate<T: Real>(&self, of: &impl Fn(&str, Interval) -> Option<T>) -> Option<T> {
        self.factors.iter().try_fold(T::from_f64(self.coefficient), |product, &(factor, power)| {
            let factor = factor.evaluate(of)?;
            let size = (1..power.unsigned_abs()).fold(factor, |size, _| size * factor);
            Some(if power > 0 { product * size } else { product / size })
        })
    }
}
