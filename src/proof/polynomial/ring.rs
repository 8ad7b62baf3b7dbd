//! Polynomials with whole coefficients in any number of indeterminates, exact or not at all.

use core::cmp::Ordering;
use std::collections::BTreeMap;

/// An indeterminate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Symbol {
    /// A variable of the statement.
    Variable(usize),
    /// The circle constant, of which nothing is used but that it is a number.
    Pi,
    /// A constant of the code that is no short fraction, by its bits: 0.1, say. An identity that holds for every number holds
    /// for this one.
    Constant(u64),
    /// Value of a function that is not rational.
    Call(usize),
}

/// Powers of indeterminates, each once, in their order, none zero.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Monomial(Vec<(Symbol, u32)>);

impl Monomial {
    fn times(&self, other: &Self) -> Option<Self> {
        let mut powers: BTreeMap<Symbol, u32> = self.0.iter().copied().collect();
        for &(symbol, power) in &other.0 {
            let present = powers.entry(symbol).or_insert(0);
            *present = present.checked_add(power)?;
        }
        Some(Self(powers.into_iter().collect()))
    }

    /// The quotient; `None` where it is none.
    fn over(&self, other: &Self) -> Option<Self> {
        let mut powers: BTreeMap<Symbol, u32> = self.0.iter().copied().collect();
        for &(symbol, power) in &other.0 {
            let present = powers.get_mut(&symbol)?;
            *present = present.checked_sub(power)?;
        }
        powers.retain(|_, power| *power > 0);
        Some(Self(powers.into_iter().collect()))
    }

    fn root(&self) -> Option<Self> {
        self.0
            .iter()
            .map(|&(symbol, power)| (power % 2 == 0).then_some((symbol, power / 2)))
            .collect::<Option<_>>()
            .map(Self)
    }
}

/// Lexicographic, the first symbol first: multiplication keeps the order.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        for (mine, theirs) in self.0.iter().zip(&other.0) {
            match mine.0.cmp(&theirs.0) {
                Ordering::Equal => match mine.1.cmp(&theirs.1) {
                    Ordering::Equal => {}
                    decided => return decided,
                },
                // The second monomial lacks the leading symbol.
                decided => return decided.reverse(),
            }
        }
        self.0.len().cmp(&other.0.len())
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Terms with coefficients other than zero: the zero polynomial has none, so equality is equality.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Polynomial(BTreeMap<Monomial, i128>);

/// More terms than any identity here has: beyond, no verdict.
const MOST_TERMS: usize = 20_000;

impl Polynomial {
    pub(super) fn number(value: i128) -> Self {
        Self((value != 0).then(|| (Monomial(Vec::new()), value)).into_iter().collect())
    }

    pub(super) fn symbol(symbol: Symbol) -> Self {
        Self([(Monomial(vec![(symbol, 1)]), 1)].into())
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// `self + factor * other`; `None` on overflow.
    pub(super) fn plus(&self, factor: i128, other: &Self) -> Option<Self> {
        let mut sum = self.0.clone();
        for (monomial, coefficient) in &other.0 {
            let present = sum.entry(monomial.clone()).or_insert(0);
            *present = present.checked_add(coefficient.checked_mul(factor)?)?;
        }
        sum.retain(|_, coefficient| *coefficient != 0);
        (sum.len() <= MOST_TERMS).then_some(Self(sum))
    }

    pub(super) fn times(&self, other: &Self) -> Option<Self> {
        let mut product = BTreeMap::new();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                let present = product.entry(a.times(b)?).or_insert(0_i128);
                *present = present.checked_add(x.checked_mul(*y)?)?;
            }
            if product.len() > MOST_TERMS {
                return None;
            }
        }
        product.retain(|_, coefficient| *coefficient != 0);
        Some(Self(product))
    }

    /// The polynomial whose square this is, its leading coefficient positive; `None` where there is none. The root is
    /// squared again before it is believed.
    pub(super) fn root(&self) -> Option<Self> {
        let Some((leading, &coefficient)) = self.0.last_key_value() else { return Some(self.clone()) };
        let whole = coefficient.checked_isqrt().filter(|root| root * root == coefficient)?;
        let first = leading.root()?;
        let mut root = Self([(first.clone(), whole)].into());
        let mut rest = self.plus(-1, &root.times(&root)?)?;
        // Each term of the root removes the leading term of the remainder.
        for _ in 0..self.0.len() {
            let Some((monomial, &coefficient)) = rest.0.last_key_value() else { break };
            let twice = whole.checked_mul(2)?;
            if coefficient % twice != 0 {
                return None;
            }
            root = root.plus(1, &Self([(monomial.over(&first)?, coefficient / twice)].into()))?;
            rest = self.plus(-1, &root.times(&root)?)?;
        }
        rest.is_zero().then_some(root)
    }

    /// The coefficients of the powers of a symbol, from the zeroth on.
    pub(super) fn in_powers_of(&self, symbol: Symbol) -> Vec<Self> {
        let mut powers: Vec<Self> = Vec::new();
        for (monomial, &coefficient) in &self.0 {
            let power = monomial.0.iter().find(|(other, _)| *other == symbol).map_or(0, |&(_, power)| power as usize);
            let rest = Monomial(monomial.0.iter().copied().filter(|(other, _)| *other != symbol).collect());
            powers.resize_with(powers.len().max(power + 1), || Self(BTreeMap::new()));
            powers[power].0.insert(rest, coefficient);
        }
        powers
    }

    /// Both divided by the common factor of all terms, a number and powers.
    pub(super) fn reduced(self, other: Self) -> (Self, Self) {
        let terms = || self.0.iter().chain(&other.0);
        let number = terms().fold(0, |common, (_, &coefficient)| gcd(common, coefficient.unsigned_abs()));
        let Ok(number) = i128::try_from(number) else { return (self, other) };
        let shared = terms().map(|(monomial, _)| monomial.clone()).reduce(|common, monomial| {
            let least = |&(symbol, power): &(Symbol, u32)| {
                let theirs = monomial.0.iter().find(|(other, _)| *other == symbol).map_or(0, |&(_, theirs)| theirs);
                (theirs.min(power) > 0).then_some((symbol, theirs.min(power)))
            };
            Monomial(common.0.iter().filter_map(least).collect())
        });
        let Some(shared) = shared.filter(|_| number > 0) else { return (self, other) };
        let divided = |of: &Self| {
            let term =
                |(monomial, coefficient): (&Monomial, &i128)| Some((monomial.over(&shared)?, coefficient / number));
            of.0.iter().map(term).collect::<Option<BTreeMap<_, _>>>().map(Self)
        };
        match (divided(&self), divided(&other)) {
            (Some(a), Some(b)) => (a, b),
            _ => (self, other),
        }
    }

    /// The value where each symbol has the value that `of` gives.
    pub(super) fn value(&self, of: &impl Fn(Symbol) -> f64) -> f64 {
        let term = |(monomial, coefficient): (&Monomial, &i128)| {
            monomial
                .0
                .iter()
                .fold(*coefficient as f64, |product, &(symbol, power)| product * of(symbol).powi(power as i32))
        };
        self.0.iter().map(term).sum()
    }
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
