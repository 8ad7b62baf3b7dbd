//! The tests' one table of tolerances. Each is the smallest that its reason allows. What the claims check by themselves has its
//! tolerances in the library, because `verify` needs them.

/// Closed form against quadrature, relative to the largest output.
pub(crate) const QUADRATURE: f64 = selfosc::claims::tolerance::QUADRATURE;

/// Parameters from the features of an exact orbit, and back: some ten roundings times the condition of the inversion, up
/// to 1e5 over the shapes drawn.
pub(crate) const INVERSION: f64 = 1e-10;

/// Derivatives of the same: slopes are difference quotients, good to 1e-8, under a milder condition.
pub(crate) const INVERSION_DERIVATIVE: f64 = 1e-5;

/// The inversion in single precision, for a well-conditioned shape: some ten roundings of 6e-8, magnified tenfold.
pub(crate) const INVERSION_SINGLE: f64 = 2e-5;

/// Common parameters from exact rows: the search ends at a relative step of 1e-9.
pub(crate) const JOINT: f64 = 1e-7;

/// Vehicle: sums and products of up to a hundred terms of order one, relative to the largest term.
pub(crate) const VEHICLE_ALGEBRA: f64 = 1e-12;

/// Vehicle: thrust after inverse and map, relative; a square root and a dozen operations.
pub(crate) const THRUST_ROUND_TRIP: f64 = 1e-14;

/// Vehicle: the same in f32, whose epsilon is 1.2e-7.
pub(crate) const THRUST_ROUND_TRIP_F32: f64 = 2e-6;

/// Vehicle: command after map and inverse, relative to the limit; the slope is at least a twentieth of its largest.
pub(crate) const COMMAND_ROUND_TRIP: f64 = 1e-14;

/// Vehicle: cost of an allocation within limits against the best over all active sets, relative; the oracle solves normal
/// equations of condition up to 1e6 and cost is flat at its minimum.
pub(crate) const ALLOCATION_COST: f64 = 1e-12;

/// Vehicle: pull of an effort weight of 1e-10 where singular values are above 0.05: 1e-10 / 0.05^2, with room.
pub(crate) const ALLOCATION_EFFORT: f64 = 1e-7;

/// Vehicle: standard error of a fit against the spread of 2000 fits, relative; the spread itself has an error of 1.6 %.
pub(crate) const STANDARD_ERROR: f64 = 0.08;

/// Vehicle: central difference of step 1e-5 of a quaternion, relative to the cube of its rate: truncation 1e-10 of the third
/// derivative, rounding 1e-11.
pub(crate) const QUATERNION_RATE: f64 = 1e-9;

/// Vehicle: fourth-order integration in steps of 0.25 ms, relative to the energy turned over; drag over inertia reaches 200/s
/// and bends where a speed reverses.
pub(crate) const ENERGY_BALANCE: f64 = 1e-9;

/// Width of an elementary function of intervals at a point, in units of the last place; 16 is the largest seen (the
/// tangent), and proofs rely on enclosures not much wider than rounding.
pub(crate) const ELEMENTARY_WIDTH_ULP: f64 = 20.0;

/// Width of a Bessel function's enclosure (relative for I): J near 14, where the terms of its series are 1e4 times the sum
/// and Hankel's expansion ends at 1e-12.
pub(crate) const BESSEL_WIDTH: f64 = 1e-11;

/// Relative rounding of a scaled modified Bessel function in floats: about seventy terms, an exponential, a square root.
pub(crate) const BESSEL_FLOAT: f64 = 1e-14;

/// Width wanted of an integral by rigorous quadrature; the integrands are of order one, and rounding alone costs 1e-14.
pub(crate) const QUADRATURE_WIDTH: f64 = 1e-12;

/// Relative rounding of a derivative up to the third by its formula in floating point, and of the jet that it is
/// compared with.
pub(crate) const JET_ROUNDING: f64 = 1e-14;

/// A half-period from the matrix exponential against a published 16-digit value, relative: rounding.
pub(crate) const PERIOD: f64 = 1e-14;

/// Exact orbits against integration at a relative tolerance of 1e-12 per step over some tens of periods.
pub(crate) const ORBIT_INTEGRATION: f64 = 1e-8;

/// Tsypkin's series cut after 4000 terms, relative to the largest: the tail of `k^-3` is 1e-8 of it.
pub(crate) const TSYPKIN: f64 = 1e-7;

/// A multiplier from the decay of a deviation below 1e-4, relative: its second-order part and the next multiplier's.
pub(crate) const DECAY: f64 = 1e-2;

/// Harmonic balance against a published value of 12 or 7 digits: half a unit of its last place.
pub(crate) const PUBLISHED_12: f64 = 5e-13;

/// The same for 7 decimals.
pub(crate) const PUBLISHED_7: f64 = 5e-8;

/// The published values of a minimiser, whose residual there is 1.4e-6.
pub(crate) const MINIMISED: f64 = 1.5e-6;

/// Two ways to the same balance, relative: Newton's method ends at rounding times the condition.
pub(crate) const BALANCE: f64 = 1e-9;

/// Closed-form limit cycles against integration, relative: the integrator's 1e-13 a step over some hundred steps, and
/// its approach to the cycle stopped at 1e-12 a cycle while a deviation may need ten cycles to shrink.
pub(crate) const AXIS_INTEGRATION: f64 = 1e-10;

/// Limit cycles against 30-digit references or closed forms, relative: twenty roundings, which one over the distance of
/// the multiplier from one then magnifies (by at most 125 for g >= 1e-6).
pub(crate) const REFERENCE: f64 = 20.0 * f64::EPSILON;

/// Closed-form motion against itself or an integrator, relative to the largest way and speed involved: some ten
/// roundings.
pub(crate) const MOTION: f64 = 1e-12;

/// f32 against f64, relative: some ten roundings of 6e-8, magnified up to twentyfold by a multiplier near one.
pub(crate) const SINGLE: f64 = 2e-5;

/// Derivatives against five-point differences, which are taken for good where halving the step changes them by no more.
pub(crate) const DIFFERENCE: f64 = 1e-7;

/// What the oracle itself cannot tell from zero, relative to the mean and first harmonic it finds.
pub(crate) const ORACLE: f64 = 1e-28;

/// Closed form against the oracle, relative to the value itself: what the catalogue promises.
pub(crate) const CLOSED_FORM: f64 = 1e-12;

/// Error of a closed form above that, as a multiple of what moving every input by half to one unit in its last place does to
/// the exact value: a dozen rounded operations.
pub(crate) const CONDITION: f64 = 8.0;

/// A few rounded operations, relative to the largest number that takes part.
pub(crate) const ROUNDING: f64 = 1e-15;

/// Central differences with steps of 1e-5 of a quantity near one: step squared, and rounding over the step.
pub(crate) const CENTRAL_DIFFERENCE: f64 = 1e-8;

/// The formulas of Table 3 rearranged, relative to the relay level: a few dozen roundings of terms below one.
pub(crate) const REARRANGED: f64 = 1e-14;

/// Angles printed with nine decimals of a degree, in radians.
pub(crate) const PRINTED_ANGLE: f64 = 1e-10;

/// Spacing of rounded readings, which are products of whole numbers with it.
pub(crate) const ROUNDED_STEP: f64 = 1e-6;

/// Amplitude of one cycle at 200 Hz by the parabola through a peak, where the acceleration may bend at the peak.
pub(crate) const DENSE_FEATURE: f64 = 2e-4;

/// The same at 10 Hz, with up to a twelfth of the period on either side of the peak.
pub(crate) const SLOW_FEATURE: f64 = 1e-2;

/// Sums of up to a hundred numbers in another order.
pub(crate) const SUM: f64 = 1e-13;

/// Parameters from a record without noise: the search ends at a relative step of 1e-6.
pub(crate) const CLEAN_FIT: f64 = 1e-3;

/// A percentage known to half a percent or a whole one: as printed in the findings.
pub(crate) const PRINTED_PERCENT: f64 = 0.6;

/// What is left of the start-up in a mean over a dozen cycles or more: the first counts once it is within 8 % of the one before,
/// and successive ones come nearer by the orbit's multiplier, at most a half here.
pub(crate) const START_UP_LEFT: f64 = 5e-3;

/// Width of an enclosure of a describing function at moderate parameters, and error of a proved kernel: what is promised.
pub(crate) const CERTIFIED_WIDTH: f64 = 1e-11;

/// Width of the enclosure of an orbit, relative and times one less the multiplier: a few hundred outward roundings of the
/// closed-form motion, of a multiplier itself the difference of large terms where drag is weak.
pub(crate) const ORBIT_ENCLOSURE: f64 = 2e-12;

/// Controllers: a dozen rounded operations, relative to the largest number that takes part.
pub(crate) const ROUNDING_MARGIN: f64 = 1e-12;

/// Controllers: margins against a sweep whose crossovers are bisected to rounding, relative; a crossover moves with the root of
/// rounding where curves graze.
pub(crate) const MARGIN: f64 = 1e-7;

/// Controllers: eigenvalues of a matrix with a double or triple pole, relative: the cube root of rounding.
pub(crate) const DOUBLE_POLE: f64 = 1e-3;

/// A percentage printed with one decimal.
pub(crate) const PRINTED_TENTH: f64 = 0.06;
/// A heading about a reference of up to two turns against the plain number: rounding of 720.
pub(crate) const WRAPPED: f64 = 1e-11;

/// Inertia identified in single precision against double: features to 1e-5, in times of some tens of seconds, and the
/// condition of the inversion.
pub(crate) const SINGLE_EXPERIMENT: f64 = 2e-3;

/// Inertia identified from a few cycles at some thirty samples each, relay levels read up to a sample late.
pub(crate) const SLOW_MODEL: f64 = 0.06;
/// Inertia and drag from 60 s at 10 Hz under a command that moves: four standard deviations of the readings' noise, and what a
/// ramp's unknown corners add.
pub(crate) const MOVED: f64 = 8e-3;

/// The same with both kinds of drag, which such a record hardly tells apart.
pub(crate) const MOVED_MIXED: f64 = 0.12;

/// The same where a curve is cut off between samples, with little noise: a tenth of an interval at each corner.
pub(crate) const CUT_CURVE: f64 = 2e-3;

/// Logarithm of a likelihood where a search ends: successive steps differ by less.
pub(crate) const LIKELIHOOD: f64 = 0.3;

/// Parameters by orbit inversion from a record of 4000 samples a period: a level read half a sample late, and what is left of the
/// start-up.
pub(crate) const DENSE_EXACT: f64 = 1e-2;

/// A pole near the crossover by a delay's Pade approximant of sixth order, whose phase is right to 1e-9 for `w delay` up to one.
pub(crate) const PADE: f64 = 1e-6;

/// What tanh-sinh quadrature in 42 digits leaves of an integral with an algebraic singularity, relative.
pub(crate) const POWER_ORACLE: f64 = 1e-20;

/// Two decompositions of one matrix of order ten or less, relative to its norm: some tens of roundings, and as many again.
pub(crate) const DECOMPOSITION: f64 = 1e-13;

/// Poles a factor of three or more apart, relative: rounding of the coefficients times the condition of a root, about
/// `prod (1 + r)/(1 - r)` over the ratios, up to some 30, times the dozens of roundings of a decomposition of a balanced matrix.
pub(crate) const SEPARATE_POLES: f64 = 1e-10;

/// Width of a Taylor step with a remainder of eleventh degree, relative, over a cell at most a twentieth as long as the way to
/// the next singularity: `(1/20)^11` is 5e-15, and the intervals of the remainder's coefficient are too wide by a thousand and
/// more. (At a tenth, the remainder alone reaches this.)
pub(crate) const TAYLOR_STEP: f64 = 1e-9;

/// What f32 loses of a power of a small number: below this it keeps fewer digits, and in the end none.
pub(crate) const SINGLE_UNDERFLOW: f64 = f32::MIN_POSITIVE as f64;

/// Describing functions in 32 digits against quadrature in 42: the trapezoidal rule with 144 points leaves 1e-22 of a steep tanh.
pub(crate) const TWO_ORACLES: f64 = 1e-21;

/// Width of an enclosed orbit's figures over its size: some hundreds of roundings through the partial fractions, and as many again.
pub(crate) const ENCLOSED_ORBIT: f64 = 1e-11;

/// Figures of an oscillation simulated with 71 digits, relative to its amplitude: its harmonics are sums of doubles.
pub(crate) const SIMULATED_71_DIGITS: f64 = 1e-13;

/// Relative half-width of a proved oscillation's amplitude, smooth characteristic: rounding times the condition of the balance.
pub(crate) const EXISTENCE_SMOOTH: f64 = 1e-10;

/// The same with kinks and relative degree 3 or more: harmonics above the 97th, about `97^-4.5` of the first.
pub(crate) const EXISTENCE_KINKED: f64 = 1e-7;

/// The same with kinks and relative degree 1 or 2: about `97^-2.5` times the half-range of the slopes and the condition.
pub(crate) const EXISTENCE_KINKED_LOW_DEGREE: f64 = 1e-4;

/// A simulated step against the midpoint rule at 1e-4 s: its error is some 1e-8, that of Runge-Kutta steps of 5 ms across a bend of
/// the drag 1e-7.
pub(crate) const ANOTHER_RULE: f64 = 1e-6;
