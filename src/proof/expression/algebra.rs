//! Sums and products of expressions in a form that shows cancellation.

use core::ops::{Add, Div, Mul};

use super::{Expression, Node, Product};
use crate::numeric::{Real, operators};

impl Expression {
    fn product(self) -> Product {
        match self.0 {
            Node::Product(product) => product.clone(),
            _ => Product { coefficient: 1.0, factors: vec![(self, 1)] },
        }
    }

    pub(super) fn terms(self) -> Vec<Product> {
        match self.0 {
            Node::Sum(terms) => terms.clone(),
            _ => vec![self.product()],
        }
    }

    /// Whether the formula starts with a minus.
    pub(super) fn leads_negative(self) -> bool {
        self.terms().first().is_some_and(|term| term.coefficient < 0.0)
    }

    fn is_sum(self) -> bool {
        matches!(self.0, Node::Sum(_))
    }

    fn sum(terms: Vec<Product>) -> Self {
        match terms.len() {
            0 => Self::zero(),
            1 => terms.into_iter().map(Product::expression).fold(Self::zero(), |_, term| term),
            _ => Self::new(Node::Sum(terms)),
        }
    }

    /// A sum as the common factor of its terms times the rest; anything else as it is.
    fn factored(self) -> Product {
        match self.0 {
            Node::Sum(terms) => {
                let (common, rest) = common(terms);
                common.times(Product { coefficient: 1.0, factors: vec![(Self::sum(rest), 1)] }, 1)
            }
            _ => self.product(),
        }
    }
}

/// The common factor of all terms, and the terms without it: the lowest powers, and the smallest coefficient where the
/// rest are multiples of it.
pub(super) fn common(terms: &[Product]) -> (Product, Vec<Product>) {
    let Some((first, others)) = terms.split_first() else { return (Product::number(1.0), Vec::new()) };
    let smallest = terms.iter().map(|term| term.coefficient.abs()).fold(f64::INFINITY, f64::min);
    let divides = terms.iter().all(|term| (term.coefficient / smallest).fract() == 0.0);
    let shared = first.factors.iter().filter_map(|&(factor, power)| {
        others
            .iter()
            .try_fold(power, |lowest, other| {
                let power = other.power(factor);
                (power.signum() == lowest.signum()).then_some(if power.abs() < lowest.abs() { power } else { lowest })
            })
            .map(|lowest| (factor, lowest))
    });
    let common = Product { coefficient: if divides { smallest } else { 1.0 }, factors: shared.collect() };
    let rest = terms.iter().map(|term| term.clone().times(common.clone(), -1)).collect();
    (common, rest)
}

impl Product {
    pub(super) fn number(value: f64) -> Self {
        Self { coefficient: value, factors: Vec::new() }
    }

    fn power(&self, factor: Expression) -> i32 {
        self.factors.iter().find(|(present, _)| *present == factor).map_or(0, |&(_, power)| power)
    }

    /// The product with `other`, or the quotient where `sign` is -1.
    fn times(mut self, other: Self, sign: i32) -> Self {
        if sign > 0 {
            self.coefficient *= other.coefficient;
        } else {
            self.coefficient /= other.coefficient;
        }
        for (factor, power) in other.factors {
            match self.factors.iter_mut().find(|(present, _)| *present == factor) {
                Some((_, present)) => *present += sign * power,
                None => self.factors.push((factor, sign * power)),
            }
        }
        self.factors.retain(|&(_, power)| power != 0);
        self
    }

    /// The same factors in any order.
    fn is_like(&self, other: &Self) -> bool {
        self.factors.len() == other.factors.len() && self.factors.iter().all(|factor| other.factors.contains(factor))
    }

    pub(super) fn expression(self) -> Expression {
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
            match sum.iter_mut().find(|present| present.is_like(&term)) {
                Some(present) => present.coefficient += term.coefficient,
                None => sum.push(term),
            }
        }
        sum.retain(|term| term.coefficient != 0.0);
        Self::sum(sum)
    }
}

operators! {
    [Expression]
    Neg::neg = |a| Self::from_f64(-1.0) * a;
    Sub::sub = |a, b| a + -b;
}

impl Mul for Expression {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let distributed = |sum: Self, factor: Self| {
            sum.terms()
                .into_iter()
                .map(|term| term.times(factor.product(), 1).expression())
                .fold(Self::zero(), Add::add)
        };
        match (self.is_sum(), other.is_sum()) {
            (false, false) => self.product().times(other.product(), 1).expression(),
            (true, false) => distributed(self, other),
            (false, true) => distributed(other, self),
            (true, true) => {
                let half = Self::from_f64(0.5);
                let (mean, difference) = (half * (self + other), half * (self - other));
                // (m + d)(m - d) where the middle m is a single term, and d is not zero.
                if !mean.is_sum() && difference.number().is_none() {
                    mean * mean - difference * difference
                } else {
                    self.factored().times(other.factored(), 1).expression()
                }
            }
        }
    }
}

impl Div for Expression {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let reciprocal = Product::number(1.0).times(other.factored(), -1);
        if other.is_sum() { self.factored().times(reciprocal, 1).expression() } else { self * reciprocal.expression() }
    }
}
