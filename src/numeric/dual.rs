//! Dual numbers of `num-dual` as an arithmetic: sensitivities and Jacobians from the formulas themselves.

use num_dual::{Dual64, DualNum, DualSVec64};

use super::{Real, Scalar};

/// At a kink (`abs`, `min`, `max` of equal values) the derivative is that of one side.
macro_rules! dual {
    ([$($generics:tt)*] $dual:ty) => {
        impl<$($generics)*> Real for $dual {
            fn from_f64(value: f64) -> Self {
                value.into()
            }
            fn pi() -> Self {
                core::f64::consts::PI.into()
            }
            fn bounds(self) -> (f64, f64) {
                (self.re, self.re)
            }
            fn abs(self) -> Self {
                if self.re < 0.0 { -self } else { self }
            }
            fn min(self, other: Self) -> Self {
                if other.re < self.re { other } else { self }
            }
            fn max(self, other: Self) -> Self {
                if other.re > self.re { other } else { self }
            }
            fn pow(self, exponent: Self) -> Self {
                DualNum::powd(&self, exponent)
            }
            fn floor(self) -> Self {
                libm::floor(self.re).into()
            }
            fn select_all<const M: usize>(
                self,
                below: impl FnOnce() -> [Self; M],
                above: impl FnOnce() -> [Self; M],
            ) -> [Self; M] {
                if self.re > 0.0 { above() } else { below() }
            }
            fn give_or_take(self, _: f64) -> Self {
                self
            }
            fn minus_sine(self, sine: Self) -> Self {
                super::real::minus_sine(self, sine)
            }
            fn sqrt(self) -> Self {
                // A constant zero has derivative zero; the chain rule would make it infinity times zero.
                if self.re == 0.0 && self.eps == <$dual>::from_re(0.0).eps { self } else { DualNum::sqrt(&self) }
            }
            dual!(@forward $dual: sin cos tan asin acos atan exp exp_m1 ln ln_1p sinh cosh tanh atanh);
        }
        impl<$($generics)*> Scalar for $dual {
            fn epsilon() -> Self {
                f64::EPSILON.into()
            }
        }
    };
    (@forward $dual:ty: $($method:ident)+) => {
        $(
            fn $method(self) -> Self {
                <$dual as DualNum>::$method(&self)
            }
        )+
    };
}

dual!([] Dual64);
dual!([const N: usize] DualSVec64<N>);
