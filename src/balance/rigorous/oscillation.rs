//! Oscillations proved to exist, and the document that shows an oscillation.

use core::ops::RangeInclusive;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::characteristic::OddCharacteristic;
use super::closed_loop::LipschitzLoop;
use super::error::{CannotTell, ExistenceError};
use super::refine::COMPARED;
use super::wave::{HIGHEST, HarmonicOrders, Wave};
use crate::balance::Intersection;
use crate::numeric::Interval;
use crate::plant::TransferFunction;

/// Changes with the meaning of a field.
const FORMAT: u32 = 2;
/// Highest harmonics that are tried in turn: any proof but the first ends the search.
const ORDERS: [usize; 3] = [49, 97, 197];
/// Half-width of the amplitude over the amplitude with which the first ends it, too.
const NARROW: f64 = 1e-10;
/// Share of the remainder shown that is stated: another checker bounds the same series in another way.
const STATED: f64 = 1.01;
/// Relative distance below which two centres are the same.
const SAME: f64 = 1e-6;

/// A box of frequency and harmonics in which an oscillation of a loop exists.
///
/// The oscillation is `x(t) = Re sum of X_k exp(jkwt)` over odd k or all at the characteristic's input, `X_1` real and
/// positive: frequency and harmonics up to the highest listed lie within the radii, the rest together have at most the
/// remainder as root mean square. It is not shown to be unique in the box, nor to attract or repel.
///
/// Written as JSON it is a certificate: [`check`](Self::check) proves it again without a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProvedOscillation {
    format: u32,
    version: String,
    claim: String,
    plant: TransferFunction,
    characteristic: OddCharacteristic,
    omega_rad_s: f64,
    omega_radius_rad_s: f64,
    orders: HarmonicOrders,
    /// Real and imaginary parts of the harmonics, by growing order.
    harmonics: Vec<[f64; 2]>,
    /// Radii of the same; zero for the imaginary parts of the mean and of X_1.
    radii: Vec<[f64; 2]>,
    remainder: f64,
}

/// A place where an oscillation may be, and why none is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnprovedOscillation {
    /// Amplitude of the first harmonic, in input units.
    pub amplitude: f64,
    /// Frequency, rad/s.
    pub omega_rad_s: f64,
    /// Why.
    pub reason: CannotTell,
}

/// The result on a loop.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Oscillations {
    /// Each once, by growing amplitude. There may be more.
    pub proved: Vec<ProvedOscillation>,
    /// For each intersection given, its place in `proved`, or why none is shown.
    pub at: Vec<Result<usize, CannotTell>>,
    /// Further places where harmonic balance finds an oscillation and none is shown.
    pub unproved: Vec<UnprovedOscillation>,
}

impl LipschitzLoop<'_> {
    /// Proves an oscillation near a first harmonic, such as an intersection of harmonic balance.
    ///
    /// # Errors
    /// [`CannotTell`], which does not say that there is none.
    ///
    /// ```
    /// use selfosc::balance::{LipschitzLoop, OddCharacteristic};
    /// use selfosc::plant::TransferFunction;
    /// // 3/(s (s + 1)^2) with a saturation at 1: the first harmonic says 1.807 at 1 rad/s.
    /// let plant = TransferFunction::new(&[3.0], &[1.0, 2.0, 1.0, 0.0])?;
    /// let saturation = OddCharacteristic::from_catalogue("saturation", &[1.0, 1.0])?;
    /// let proved = LipschitzLoop::new(&plant, saturation)?.prove_near(1.807, 1.0)?;
    /// assert!(proved.amplitude().contains(1.842_240_774_7) && proved.amplitude().width() < 1e-7);
    /// assert!(proved.omega_rad_s().contains(0.992_660_749_6));
    /// proved.check()?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn prove_near(&self, amplitude: f64, omega_rad_s: f64) -> Result<ProvedOscillation, CannotTell> {
        self.prove(self.refine(first_harmonic(amplitude, omega_rad_s), COMPARED)?)
    }

    /// Proves an oscillation without the half-wave symmetry near a first harmonic with a bias.
    ///
    /// # Errors
    /// [`CannotTell`], which does not say that there is none.
    ///
    /// ```
    /// use selfosc::balance::{LipschitzLoop, OddCharacteristic};
    /// use selfosc::plant::TransferFunction;
    /// // An odd characteristic and an integrator: 0.6/(s (s + 1)^2) with x^3 - 2 x oscillates with a bias.
    /// let plant = TransferFunction::new(&[0.6], &[1.0, 2.0, 1.0, 0.0])?;
    /// let cubic = OddCharacteristic::from_catalogue("polynomial", &[0.0, -2.0, 0.0, 1.0])?;
    /// let proved = LipschitzLoop::new(&plant, cubic)?.prove_biased_near(1.3, 0.5, 1.0)?;
    /// assert!(proved.mean().precedes(proved.mean() + proved.mean()) && proved.largest_input()? < 1.81);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn prove_biased_near(
        &self,
        bias: f64,
        amplitude: f64,
        omega_rad_s: f64,
    ) -> Result<ProvedOscillation, CannotTell> {
        let harmonics = vec![[bias, 0.0], [amplitude, 0.0]];
        self.prove(self.refine(Wave { omega_rad_s, orders: HarmonicOrders::All, harmonics }, COMPARED)?)
    }

    /// Oscillations of the loop that a scan of harmonic balances finds over a range of frequencies, and those near
    /// [intersections](super::super::HarmonicBalance::intersections), each proved or with the reason why not.
    ///
    /// The scan follows curves on which the loop gain varies, and passes folds, where the first harmonic has no balance.
    #[must_use]
    pub fn oscillations(&self, omega_rad_s: &RangeInclusive<f64>, intersections: &[Intersection]) -> Oscillations {
        let mut tried: Vec<(Wave, Result<ProvedOscillation, CannotTell>)> = Vec::new();
        // Its place among those tried, each of them once.
        let mut attempt = |start: Wave| {
            let centre = self.refine(start.clone(), COMPARED).map_err(|reason| start.unproved(reason))?;
            let known = tried.iter().position(|(other, _)| same(other, &centre));
            Ok(known.unwrap_or_else(|| {
                tried.push((centre.clone(), self.prove(centre)));
                tried.len() - 1
            }))
        };
        let first = |one: &Intersection| attempt(first_harmonic(one.amplitude, one.omega_rad_s));
        let near: Vec<Result<usize, UnprovedOscillation>> = intersections.iter().map(first).collect();
        let lost = self.starts(omega_rad_s).into_iter().filter_map(|start| attempt(start).err());
        let mut unproved: Vec<UnprovedOscillation> = lost.collect();
        let elsewhere = tried.iter().enumerate().filter(|(place, _)| !near.contains(&Ok(*place)));
        unproved.extend(elsewhere.filter_map(|(_, (centre, proof))| Some(centre.unproved(*proof.as_ref().err()?))));

        let mut order: Vec<usize> = (0..tried.len()).filter(|&place| tried[place].1.is_ok()).collect();
        order.sort_by(|&a, &b| tried[a].0.amplitude().total_cmp(&tried[b].0.amplitude()));
        let at = near.into_iter().map(|one| {
            let place = one.map_err(|one| one.reason)?;
            tried[place].1.as_ref().map_err(|&reason| reason)?;
            Ok(order.iter().position(|&other| other == place).unwrap_or(place))
        });
        let at = at.collect();
        let proved = order.iter().filter_map(|&place| tried[place].1.clone().ok()).collect();
        Oscillations { proved, at, unproved }
    }

    /// With more and more harmonics, until the box is narrow enough.
    fn prove(&self, mut centre: Wave) -> Result<ProvedOscillation, CannotTell> {
        let orders = centre.orders;
        let mut best = Err(CannotTell::NoBalance);
        for highest in ORDERS {
            centre = self.refine(centre, highest)?;
            match self.enclose_near(&centre) {
                Ok((radii, remainder)) => {
                    let proved = ProvedOscillation {
                        format: FORMAT,
                        version: env!("CARGO_PKG_VERSION").to_owned(),
                        claim: ProvedOscillation::CLAIM.to_owned(),
                        plant: self.plant.clone(),
                        characteristic: self.characteristic.clone(),
                        omega_rad_s: centre.omega_rad_s,
                        omega_radius_rad_s: radii[0],
                        orders,
                        harmonics: centre.harmonics.clone(),
                        radii: orders.pairs(&radii.as_slice()[1..]),
                        remainder: STATED * remainder,
                    };
                    if highest > ORDERS[0] || radii[orders.reals()] <= NARROW * centre.amplitude() {
                        return Ok(proved);
                    }
                    best = Ok(proved);
                }
                Err(why) => best = best.or(Err(why)),
            }
        }
        best
    }
}

fn first_harmonic(amplitude: f64, omega_rad_s: f64) -> Wave {
    Wave { omega_rad_s, orders: HarmonicOrders::Odd, harmonics: vec![[amplitude, 0.0]] }
}

fn same(a: &Wave, b: &Wave) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= SAME * b.abs();
    near(a.amplitude(), b.amplitude()) && near(a.omega_rad_s, b.omega_rad_s)
}

impl Wave {
    fn unproved(&self, reason: CannotTell) -> UnprovedOscillation {
        UnprovedOscillation { amplitude: self.amplitude(), omega_rad_s: self.omega_rad_s, reason }
    }
}

fn around(middle: f64, radius: f64) -> Interval {
    Interval::point(middle) + Interval::symmetric(radius)
}

impl ProvedOscillation {
    /// The field `claim` of every document of this kind.
    pub const CLAIM: &'static str = "oscillation";

    /// Bounds of the first harmonic's amplitude, in input units.
    #[must_use]
    pub fn amplitude(&self) -> Interval {
        self.harmonic(1).map_or(Interval::ENTIRE, |[re, _]| re)
    }

    /// Bounds of the frequency, rad/s.
    #[must_use]
    pub fn omega_rad_s(&self) -> Interval {
        around(self.omega_rad_s, self.omega_radius_rad_s)
    }

    /// The orders of its harmonics: odd ones alone, or the mean and all.
    #[must_use]
    pub fn orders(&self) -> HarmonicOrders {
        self.orders
    }

    /// Bounds of the mean, in input units.
    #[must_use]
    pub fn mean(&self) -> Interval {
        self.harmonic(0).map_or(Interval::ZERO, |[re, _]| re)
    }

    /// Bounds of the real and imaginary part of `X_k`, the mean `X_0`; `None` for an even k of odd orders and beyond the highest harmonic
    /// listed.
    #[must_use]
    pub fn harmonic(&self, k: usize) -> Option<[Interval; 2]> {
        let place = self.orders.place(k)?;
        let ([re, im], [re_radius, im_radius]) = (self.harmonics.get(place)?, self.radii.get(place)?);
        Some([around(*re, *re_radius), around(*im, *im_radius)])
    }

    /// The highest harmonic listed.
    #[must_use]
    pub fn highest_harmonic(&self) -> usize {
        self.harmonics.len().checked_sub(1).map_or(0, |last| self.orders.at(last))
    }

    /// Upper bound of the root mean square of all harmonics above the highest listed, in input units.
    #[must_use]
    pub fn remainder(&self) -> f64 {
        self.remainder
    }

    /// The plant.
    #[must_use]
    pub fn plant(&self) -> &TransferFunction {
        &self.plant
    }

    /// The characteristic.
    #[must_use]
    pub fn characteristic(&self) -> &OddCharacteristic {
        &self.characteristic
    }

    /// Proves the existence again from the numbers of the document, without a search.
    ///
    /// # Errors
    /// [`ExistenceError`]: the document is none, its loop is none of those, or its box is not shown to hold an oscillation.
    pub fn check(&self) -> Result<(), ExistenceError> {
        let (centre, radii) = self.numbers()?;
        let shown = LipschitzLoop::new(&self.plant, self.characteristic.clone())?.holds(&centre, &radii)?;
        let claimed = self.remainder;
        if shown <= claimed { Ok(()) } else { Err(ExistenceError::Remainder { shown, claimed }) }
    }

    /// Upper bound of the input's magnitude, in input units. Another characteristic that is the same up to there has the same
    /// oscillation, odd or not.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn largest_input(&self) -> Result<f64, ExistenceError> {
        self.check()?;
        let (centre, radii) = self.numbers()?;
        Ok(LipschitzLoop::new(&self.plant, self.characteristic.clone())?.largest_input(&centre, &radii)?)
    }

    /// Wave and radii, if they can be those of an oscillation.
    fn numbers(&self) -> Result<(Wave, DVector<f64>), ExistenceError> {
        let (count, reals) = (self.harmonics.len(), self.orders.reals());
        let numbers = self.harmonics.iter().chain(&self.radii).flatten().chain([&self.omega_rad_s, &self.remainder]);
        let mut imaginary = self.harmonics.iter().take(reals).chain(self.radii.iter().take(reals)).map(|pair| pair[1]);
        let radii = core::iter::once(self.omega_radius_rad_s).chain(self.orders.unknowns(&self.radii));
        let radii = DVector::from_vec(radii.collect());
        let faults = [
            (self.format != FORMAT || self.claim != Self::CLAIM, "another format or claim"),
            (
                count <= reals || self.highest_harmonic() > HIGHEST || self.radii.len() != count,
                "as many radii as harmonics are wanted, up to at most the 299th",
            ),
            (!numbers.copied().all(f64::is_finite), "a number is not finite"),
            (imaginary.any(|part| part != 0.0), "the mean or the first harmonic has an imaginary part"),
            (!radii.iter().all(|&radius| radius > 0.0 && radius.is_finite()), "a radius is not above 0"),
            (!(self.amplitude().is_positive() && self.omega_rad_s().is_positive()), "amplitude or frequency may be 0"),
        ];
        if let Some((_, text)) = faults.into_iter().find(|fault| fault.0) {
            return Err(ExistenceError::Malformed { text: text.to_owned() });
        }
        let centre = Wave { omega_rad_s: self.omega_rad_s, orders: self.orders, harmonics: self.harmonics.clone() };
        Ok((centre, radii))
    }
}

crate::proof::document!(ProvedOscillation, ExistenceError, to_string);
