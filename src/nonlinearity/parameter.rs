//! Named parameters: one declaration gives a characteristic its struct, its checks and its catalogue entry.

use super::NonlinearityError;
use crate::numeric::{Limit, Real, domain};

/// The numbers a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterDomain {
    /// Any finite number.
    Finite,
    /// A finite number, zero or more.
    NonNegative,
    /// A finite number above zero.
    Positive,
    /// A finite number, zero or more, of which the work grows with the size: 10 000 at most.
    Exponent,
    /// Points of a graph: as many pairs of values as there are, after the values of all other parameters.
    Points,
}

impl ParameterDomain {
    /// In words, as error messages and help texts have it.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Finite => "a finite number",
            Self::NonNegative => "a finite number, 0 or more",
            Self::Positive => "a finite number above 0",
            Self::Exponent => "a number from 0 to 10000",
            Self::Points => "points x0:y0,x1:y1,... with growing x",
        }
    }
}

/// Name, meaning, domain and default of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterSpec {
    /// The name used in `--set name=value`.
    pub name: &'static str,
    /// Meaning and unit.
    pub meaning: &'static str,
    /// The numbers it may be.
    pub domain: ParameterDomain,
    /// The value when none is given; `None` where the user has to choose.
    pub default: Option<f64>,
}

impl ParameterSpec {
    pub(super) fn check<T: Real>(&self, characteristic: &'static str, value: T) -> Result<(), NonlinearityError> {
        let checked = match self.domain {
            ParameterDomain::Finite | ParameterDomain::Points => domain::finite(self.name, value, ""),
            ParameterDomain::NonNegative => domain::non_negative(self.name, value, ""),
            ParameterDomain::Positive => domain::positive(self.name, value, ""),
            ParameterDomain::Exponent => {
                let remedy = "take a dead zone or a relay for what is steeper";
                domain::require(self.name, value, "", Limit::Within(0.0, 1e4), remedy)
            }
        };
        checked.map(drop).map_err(|fault| NonlinearityError::Parameter { characteristic, fault })
    }
}

/// A characteristic that the catalogue can build by name.
pub trait Catalogued<T>: Sized {
    /// Name in the catalogue and on the command line.
    const NAME: &'static str;
    /// Its parameters, in the order of [`from_values`](Self::from_values).
    const PARAMETERS: &'static [ParameterSpec];
    /// Pairs of parameters of which the first has to be below the second.
    const ORDERED: &'static [(&'static str, &'static str)];
    /// Its page `spec/characteristics/<name>.md`: formula, domain, source, limits.
    const SPEC: &'static str;

    /// Builds it from one value for each parameter.
    ///
    /// # Errors
    /// [`NonlinearityError`] where a value is outside its domain. Values that are missing count as NaN.
    fn from_values(values: &[T]) -> Result<Self, NonlinearityError>;
}

/// `lesser < greater`, else the error.
pub(super) fn ordered<T: Real>(
    characteristic: &'static str,
    (lesser, low): (&'static str, T),
    (greater, high): (&'static str, T),
) -> Result<(), NonlinearityError> {
    let (lesser_value, greater_value) = (low.bounds().1, high.bounds().0);
    if lesser_value < greater_value {
        return Ok(());
    }
    Err(NonlinearityError::Order { characteristic, lesser, lesser_value, greater, greater_value })
}

/// The page of a characteristic.
macro_rules! specification {
    ($name:literal) => {
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/spec/characteristics/", $name, ".md"))
    };
}
pub(super) use specification;

/// Figure and page together, as the documentation of the type has them.
macro_rules! document {
    ($name:literal) => {
        concat!(
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/spec/characteristics/", $name, ".svg")),
            "\n\n",
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/spec/characteristics/", $name, ".md")),
        )
    };
}
pub(super) use document;

/// Declares a characteristic: documentation, catalogue name, struct, then for each parameter its meaning, name, domain and
/// (optionally) default; last, order relations between parameters, and what is computed from them once and for all.
macro_rules! characteristic {
    (
        $(#[$doc:meta])*
        $name:literal $type:ident {
            $( #[doc = $meaning:literal] $parameter:ident: $domain:ident $(= $default:literal)? ),+ $(,)?
        }
        $(where $($lesser:ident < $greater:ident),+)?
        $(computed { $( #[doc = $content:literal] $computed:ident: $kind:ty = $value:expr ),+ $(,)? })?
    ) => {
        $(#[$doc])*
        #[doc = ""]
        #[doc = super::parameter::document!($name)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $type<T> { $($parameter: T,)+ $($($computed: $kind),+)? }

        impl<T: $crate::numeric::Real> $type<T> {
            #[doc = concat!("A `", $name, "` with the parameters of the struct's documentation.\n\n# Errors\n",
                "[`NonlinearityError`](super::NonlinearityError) where a parameter is outside its domain.")]
            pub fn new($($parameter: T),+) -> Result<Self, super::NonlinearityError> {
                let values = [$($parameter),+];
                for (parameter, value) in <Self as super::Catalogued<T>>::PARAMETERS.iter().zip(values) {
                    parameter.check($name, value)?;
                }
                $($(
                    super::parameter::ordered(
                        $name,
                        (stringify!($lesser), $lesser),
                        (stringify!($greater), $greater),
                    )?;
                )+)?
                $($(let $computed = $value;)+)?
                Ok(Self { $($parameter,)+ $($($computed),+)? })
            }
            $($(
                #[doc = $content]
                #[inline]
                pub(crate) fn $computed(&self) -> &$kind {
                    &self.$computed
                }
            )+)?
            $(
                #[doc = $meaning]
                #[inline]
                pub fn $parameter(&self) -> T {
                    self.$parameter
                }
            )+
        }

        impl<T: $crate::numeric::Real> super::Catalogued<T> for $type<T> {
            const NAME: &'static str = $name;
            const PARAMETERS: &'static [super::ParameterSpec] = &[$(
                super::ParameterSpec {
                    name: stringify!($parameter),
                    meaning: $meaning.trim_ascii(),
                    domain: super::ParameterDomain::$domain,
                    default: characteristic!(@default $($default)?),
                }
            ),+];
            const ORDERED: &'static [(&'static str, &'static str)] =
                &[$($((stringify!($lesser), stringify!($greater))),+)?];
            const SPEC: &'static str = super::parameter::specification!($name);

            fn from_values(values: &[T]) -> Result<Self, super::NonlinearityError> {
                let mut values = values.iter().copied();
                let mut next = || values.next().unwrap_or_else(|| T::from_f64(f64::NAN));
                $(let $parameter = next();)+
                Self::new($($parameter),+)
            }
        }
    };
    (@default) => { None };
    (@default $default:literal) => { Some($default) };
}
pub(super) use characteristic;
