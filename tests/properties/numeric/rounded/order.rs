//! Formulas with cases: every way that their comparisons can take.
//!
//! Numbers without error are the same in both senses, so that a comparison of them has one outcome for float and exact value, if not
//! for all of a box: both outcomes are followed, each by a run of the formula. Where an error came in, float and exact value may
//! take different cases, and nothing is said of such a box: a domain has to keep away from there.

use core::cell::RefCell;
use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Format, Rounded};
use crate::numeric::{Real, Scalar};

/// A number of a formula with cases.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compared<F>(pub(crate) Rounded<F>);

/// Comparisons that a formula may leave open.
const MOST_OPEN: usize = 24;

/// The way that a run takes.
struct Way {
    /// Outcomes of the open comparisons, in their order, and how many of them were used.
    outcomes: Vec<bool>,
    used: usize,
    /// Rounding may decide, and that is no outcome.
    unclear: bool,
    /// Rounding may decide as it likes.
    lenient: bool,
}

std::thread_local! {
    static WAY: RefCell<Way> = const { RefCell::new(Way { outcomes: Vec::new(), used: 0, unclear: false, lenient: false }) };
}

/// What a formula of [`Compared`] numbers gives, on every way that its comparisons can take; `None` where rounding may decide one of them,
/// or too many are open.
///
/// Comparisons mean nothing outside of this.
pub(crate) fn every_way<R>(formula: impl Fn() -> R) -> Option<Vec<R>> {
    follow(false, formula)
}

/// The same where it does not matter whether float and exact value take the same case: what holds of every result holds of both.
pub(crate) fn every_outcome<R>(formula: impl Fn() -> R) -> Option<Vec<R>> {
    follow(true, formula)
}

fn follow<R>(lenient: bool, formula: impl Fn() -> R) -> Option<Vec<R>> {
    WAY.with_borrow_mut(|way| *way = Way { outcomes: Vec::new(), used: 0, unclear: false, lenient });
    let mut results = Vec::new();
    loop {
        WAY.with_borrow_mut(|way| way.used = 0);
        results.push(formula());
        let ended = WAY.with_borrow_mut(|way| {
            // The next way differs in the last outcome that was not turned yet.
            while way.outcomes.last() == Some(&false) {
                way.outcomes.pop();
            }
            way.outcomes.last_mut().map(|last| *last = false).is_none()
        });
        if WAY.with_borrow(|way| way.unclear) {
            return None;
        }
        if ended {
            return Some(results);
        }
    }
}

impl<F: Format> Compared<F> {
    /// The outcome of a comparison that is certainly true or certainly false, or else open.
    fn decide(self, other: Self, certainly: bool, certainly_not: bool) -> bool {
        if certainly || certainly_not {
            return certainly;
        }
        WAY.with_borrow_mut(|way| {
            let rounded = self.0.error > 0.0 || other.0.error > 0.0;
            way.unclear |= rounded && !way.lenient || way.used >= MOST_OPEN;
            if way.unclear {
                return false;
            }
            if way.used == way.outcomes.len() {
                way.outcomes.push(true);
            }
            way.used += 1;
            way.outcomes.get(way.used - 1).copied().unwrap_or(false)
        })
    }
}

impl<F: Format> PartialEq for Compared<F> {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (self.0.hull(), other.0.hull());
        let same = a.is_point() && a == b && self.0.error == 0.0 && other.0.error == 0.0;
        self.decide(*other, same, a.intersection(b).is_none())
    }
}

impl<F: Format> PartialOrd for Compared<F> {
    fn lt(&self, other: &Self) -> bool {
        let (a, b) = (self.0.hull(), other.0.hull());
        self.decide(*other, a.upper() < b.lower(), a.lower() >= b.upper())
    }
    fn le(&self, other: &Self) -> bool {
        let (a, b) = (self.0.hull(), other.0.hull());
        self.decide(*other, a.upper() <= b.lower(), a.lower() > b.upper())
    }
    fn gt(&self, other: &Self) -> bool {
        other < self
    }
    fn ge(&self, other: &Self) -> bool {
        other <= self
    }
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(match (self < other, self == other) {
            (true, _) => Ordering::Less,
            (false, true) => Ordering::Equal,
            (false, false) => Ordering::Greater,
        })
    }
}

impl<F: Format> Scalar for Compared<F> {
    fn epsilon() -> Self {
        Self::from_f64(2.0 * F::UNIT)
    }
    fn is_finite(self) -> bool {
        self.0.hull().is_bounded() && self.0.error.is_finite()
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),+) => { $(
        impl<F: Format> $operator for Compared<F> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )+ };
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl<F: Format> Neg for Compared<F> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! arithmetic {
    (constants: $($constant:ident)+; functions: $($function:ident)+; of_two: $($of_two:ident)+) => {
        impl<F: Format> Real for Compared<F> {
            $(
                fn $constant() -> Self {
                    Self(Rounded::$constant())
                }
            )+
            $(
                fn $function(self) -> Self {
                    Self(self.0.$function())
                }
            )+
            $(
                fn $of_two(self, other: Self) -> Self {
                    Self(self.0.$of_two(other.0))
                }
            )+
            fn from_f64(value: f64) -> Self {
                Self(Rounded::from_f64(value))
            }
            fn bounds(self) -> (f64, f64) {
                self.0.bounds()
            }
            fn vanishes(self) -> bool {
                self.0.vanishes()
            }
            fn inflate(self, error: f64) -> Self {
                Self(self.0.inflate(error))
            }
            fn select_all<const N: usize>(
                self,
                below: impl FnOnce() -> [Self; N],
                above: impl FnOnce() -> [Self; N],
            ) -> [Self; N] {
                self.0.select_all(|| below().map(|x| x.0), || above().map(|x| x.0)).map(Self)
            }
            fn prefer_all<const N: usize>(
                self,
                below: impl FnOnce() -> [Self; N],
                above: impl FnOnce() -> [Self; N],
            ) -> [Self; N] {
                self.0.prefer_all(|| below().map(|x| x.0), || above().map(|x| x.0)).map(Self)
            }
        }
    };
}

arithmetic! {
    constants: pi inverse_pi;
    functions: abs sqrt square sin cos tan asin atan exp exp_m1 ln ln_1p sinh cosh tanh atanh floor;
    of_two: min max pow minus_own_sine
}
