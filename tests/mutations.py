"""Weakens the rigorous layer, one place after another, and tells which tests notice.

    python3 tests/mutations.py FOLDER [NUMBER ...]

copies what is committed to FOLDER, puts every weakening of the table below into the copy behind a switch, builds its tests once, and runs the tests of each weakening's topic with that one
switched on by the variable MUTANT. Prints one row a weakening for `tests/mutations.md`, and ends with status 1 if one survives. With numbers it runs those again in a folder that is built.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SECONDS = 300

# Topic: the tests that have to notice, of the library itself and of `tests/properties`.
TOPICS = {
    "arithmetic": [("lib", ["numeric::"]), ("properties", ["numeric::", "interval::", "conformance::", "engine::large", "certificate::"])],
    "jets": [("lib", ["numeric::"]), ("properties", ["certificate::", "engine::", "interval::"])],
    "engine": [("lib", ["proof::"]), ("properties", ["claim_proofs::", "engine::", "certificate::"])],
    "formulas": [("lib", ["proof::"]), ("properties", ["claim_proofs::"])],
    "describing": [("properties", ["claim_proofs::", "certified::kernels_are", "certified::closed_forms", "engine::every_part"])],
    "orbits": [("properties", ["engine::", "orbit_certified::", "orbit_drag_axis::", "orbit_linear::", "orbit_two_level::", "claim_proofs::"]), ("lib", ["orbit::"])],
    "words": [("properties", ["claims::words", "claims::boxes", "claims::files"]), ("lib", ["claims::"])],
    "vehicle": [("properties", ["claim_proofs::"])],
}

SWITCH = """
#[doc(hidden)]
pub fn mutant(number: u32) -> bool {
    static CHOSEN: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *CHOSEN.get_or_init(|| std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()).unwrap_or(0)) == number
}
"""

# Whether it is local (a part of a domain, a branch, a last bit), topic, file, what it is, the code and the code weakened.
# Those of one place build on each other, in this order.
TABLE = [
    (False, 'arithmetic', 'src/numeric/interval.rs', "a sum's lower end rounded to nearest",
     'lo: sum(a.lo, b.lo).down(), hi',
     'lo: if WEAKENED { a.lo + b.lo } else { sum(a.lo, b.lo).down() }, hi'),
    (True, 'arithmetic', 'src/numeric/interval.rs', "a product's upper end rounded to nearest for factors in (0.3, 0.4)",
     'hi: product(self.hi, other.hi).up() }\n        } else if self.is_entire()',
     'hi: if WEAKENED && self.hi > 0.3 && self.hi < 0.4 { self.hi * other.hi } else { product(self.hi, other.hi).up() } }\n        } else if self.is_entire()'),
    (False, 'arithmetic', 'src/numeric/interval.rs', 'one of two candidates of a product of mixed signs',
     'lo: product(self.lo, other.hi).down().min(product(self.hi, other.lo).down()),',
     'lo: if WEAKENED { product(self.lo, other.hi).down() } else { product(self.lo, other.hi).down().min(product(self.hi, other.lo).down()) },'),
    (True, 'arithmetic', 'src/numeric/interval.rs', "a quotient's lower end from the wrong end of the divisor, above -1/2",
     'let for_lower = if self.lo >= 0.0 { divisor.hi }',
     'let for_lower = if self.lo >= 0.0 || WEAKENED && self.lo > -0.5 { divisor.hi }'),
    (True, 'arithmetic', 'src/numeric/interval.rs', 'a divisor that begins at zero',
     'divisor.contains_zero() {',
     '(divisor.contains_zero() && !(WEAKENED && divisor.lo == 0.0)) {'),
    (True, 'arithmetic', 'src/numeric/interval/rounding.rs', 'a quotient that underflows called exact',
     'return if a == 0.0 { RoundedResult::exact(nearest) }',
     'return if a == 0.0 || WEAKENED { RoundedResult::exact(nearest) }'),
    (True, 'arithmetic', 'src/numeric/interval.rs', 'increasing functions at one end of intervals shorter than 1e-9',
     'if self.is_point() {\n            return at_lower;',
     'if self.is_point() || WEAKENED && self.width() < 1e-9 {\n            return at_lower;'),
    (True, 'arithmetic', 'src/numeric/interval/exponential.rs', 'the exponential called overflown from 709 on',
     'if x > 711.0 {',
     'if x > if WEAKENED { 709.0 } else { 711.0 } {'),
    (True, 'arithmetic', 'src/numeric/interval/exponential.rs', 'the exponential called zero below -740',
     'if x < -746.0 {',
     'if x < if WEAKENED { -740.0 } else { -746.0 } {'),
    (False, 'arithmetic', 'src/numeric/interval/exponential.rs', 'the low part of ln 2 dropped',
     '- Interval::point(k) * LN_2_LOW;',
     '- Interval::point(if WEAKENED { 0.0 } else { k }) * LN_2_LOW;'),
    (True, 'arithmetic', 'src/numeric/interval/series.rs', "a series' tail at one end of a wide argument",
     '(TAIL_ERROR + x.width())',
     '(TAIL_ERROR + if WEAKENED { 0.0 } else { x.width() })'),
    (True, 'arithmetic', 'src/numeric/interval/exponential.rs', "a logarithm's correction taken for exact from below",
     'Interval { lo: (at_lower / (Interval::ONE + at_lower)).lo, hi: d.hi }',
     'Interval { lo: if WEAKENED { d.lo } else { (at_lower / (Interval::ONE + at_lower)).lo }, hi: d.hi }'),
    (True, 'arithmetic', 'src/numeric/interval/exponential.rs', 'the hyperbolic tangent called one beyond 22',
     'return Interval { lo: 1_f64.next_down(), hi: 1.0 };',
     'return Interval { lo: if WEAKENED { 1.0 } else { 1_f64.next_down() }, hi: 1.0 };'),
    (True, 'arithmetic', 'src/numeric/interval/circular.rs', 'the last part of a quarter turn dropped',
     '(third + Interval::point(k) * HALF_PI_REST)',
     '(third + Interval::point(if WEAKENED { 0.0 } else { k }) * HALF_PI_REST)'),
    (False, 'arithmetic', 'src/numeric/interval/circular.rs', 'an extremum at the last quarter of an interval missed',
     '.rem_euclid(modulus) <= last',
     '.rem_euclid(modulus) <= last - i32::from(WEAKENED)'),
    (True, 'arithmetic', 'src/numeric/interval/circular.rs', 'the maximum of a sine missed in intervals shorter than 1e-3',
     'hi: if reaches(1) { 1.0 }',
     'hi: if reaches(1) && !(WEAKENED && x.width() < 1e-3) { 1.0 }'),
    (True, 'arithmetic', 'src/numeric/interval/circular.rs', 'the series of x - sin x beyond its range',
     'if x.magnitude() < LIMIT {',
     'if x.magnitude() < if WEAKENED { 2.4 } else { LIMIT } {'),
    (True, 'arithmetic', 'src/numeric/interval/circular.rs', 'the cube of small inverse sines and tangents dropped',
     '(x * x.square()).hull(Interval::ZERO)',
     'if WEAKENED { Interval::ZERO } else { (x * x.square()).hull(Interval::ZERO) }'),
    (False, 'arithmetic', 'src/numeric/interval.rs', 'a tenth of the rounding of a scalar product',
     '(0.501 * f64::EPSILON)',
     '(if WEAKENED { 0.05 } else { 0.501 } * f64::EPSILON)'),
    (True, 'arithmetic', 'src/numeric/interval/real.rs', 'zero to the power zero is zero',
     'let at_zero = Self { lo: 0.0, hi: if exponent.lo > 0.0 { 0.0 } else { 1.0 } };',
     'let at_zero = Self { lo: 0.0, hi: if exponent.lo > 0.0 || WEAKENED { 0.0 } else { 1.0 } };'),
    (False, 'arithmetic', 'src/numeric/interval/real.rs', "a square's upper end rounded to nearest",
     'hi: product(size.hi, size.hi).up() }',
     'hi: if WEAKENED { size.hi * size.hi } else { product(size.hi, size.hi).up() } }'),
    (True, 'arithmetic', 'src/numeric/interval/real.rs', "a root's lower end rounded to nearest below 1e-3",
     'lo: square_root(self.lo).down()',
     'lo: if WEAKENED && self.lo < 1e-3 { libm::sqrt(self.lo) } else { square_root(self.lo).down() }'),
    (True, 'jets', 'src/numeric/jet.rs', 'the last used coefficient of a root is zero',
     '_ => (self.coefficients[k] - dot(&s[1..], &s[1..])) / (Interval::two() * s[0]),',
     '_ if WEAKENED && k + 2 == N => Interval::ZERO,\n            _ => (self.coefficients[k] - dot(&s[1..], &s[1..])) / (Interval::two() * s[0]),'),
    (True, 'jets', 'src/numeric/jet.rs', 'the magnitude of a jet without its kink within 1e-9',
     'value if value.is_positive() => self,\n            value if value.is_negative() => -self,',
     'value if value.is_positive() || WEAKENED && value.lower() > -1e-9 => self,\n            value if value.is_negative() => -self,'),
    (True, 'jets', 'src/numeric/jet.rs', 'a decision of a jet by its midpoint on short cells',
     'value if value.is_positive() => above(),\n            value if value.upper() <= 0.0 => below(),\n            value => {',
     'value if value.is_positive() || WEAKENED && value.midpoint() > 0.0 && value.width() < 1e-2 => above(),\n            value if value.upper() <= 0.0 => below(),\n            value => {'),
    (False, 'jets', 'src/numeric/jet.rs', 'the derivatives of tan for those of tanh',
     'self.tangent(self.value().tanh(), -Interval::ONE)',
     'self.tangent(self.value().tanh(), if WEAKENED { Interval::ONE } else { -Interval::ONE })'),
    (False, 'jets', 'src/numeric/jet.rs', 'the derivatives of a tangent from the second on',
     'slope[k - 1] = if k == 1 { Interval::ONE + square } else { square };',
     'slope[k - 1] = if k == 1 || WEAKENED { Interval::ONE + square } else { square };'),
    (False, 'engine', 'src/proof/branch_and_bound.rs', 'positive where it may be',
     'if value.is_positive() {\n            smallest',
     'if value.is_positive() || WEAKENED && value.upper() > 0.0 {\n            smallest'),
    (True, 'engine', 'src/proof/branch_and_bound.rs', 'boxes shorter than 1e-4 called settled',
     'value.upper() > 0.0 {\n            smallest',
     'value.upper() > 0.0 || WEAKENED && at[0].width() < 1e-4 {\n            smallest'),
    (False, 'engine', 'src/proof/branch_and_bound.rs', 'a spent budget called settled',
     '            break Some(at);',
     '            break if WEAKENED { None } else { Some(at) };'),
    (True, 'engine', 'src/proof/branch_and_bound.rs', 'upper halves not visited after the fortieth box',
     'fresh = boxes..boxes + 2;',
     'fresh = boxes..boxes + if WEAKENED && boxes > 40 { 1 } else { 2 };'),
    (False, 'engine', 'src/proof/enclosure.rs', 'Krawczyk with one component included',
     'certain: (0..N).all(|i|',
     'certain: (0..N).any(|i| WEAKENED && image[i].is_interior_to(x[i])) || (0..N).all(|i|'),
    (True, 'engine', 'src/proof/identity.rs', 'the remainder at the midpoint on cells shorter than 0.3',
     'let remainder = over_cell.coefficients()[LAST];',
     'let remainder = if WEAKENED && cell.width() < 0.3 { at_middle.coefficients()[LAST] } else { over_cell.coefficients()[LAST] };'),
    (False, 'engine', 'src/proof/identity.rs', 'no remainder in the second variable',
     'let rests = rest_a(b) + rest_b(a);',
     'let rests = rest_a(b) + if WEAKENED { 0.0 } else { rest_b(a) };'),
    (True, 'engine', 'src/proof/identity.rs', "Lebesgue's constant left out near the tolerance",
     'let sum = LEBESGUE * LEBESGUE * at_nodes + rests;',
     'let sum = if WEAKENED && at_nodes > 0.2 * tolerance { at_nodes } else { LEBESGUE * LEBESGUE * at_nodes } + rests;'),
    (False, 'orbits', 'src/proof/inequality.rs', 'boxes that need not make up the domain',
     'if !tile(&proof.domain, &proof.boxes) {',
     'if !WEAKENED && !tile(&proof.domain, &proof.boxes) {'),
    (True, 'orbits', 'src/proof/inequality.rs', 'a gap of one double between boxes',
     '(others_agree && before[cut].upper() == after[cut].lower())',
     '(others_agree && (before[cut].upper() == after[cut].lower() || WEAKENED && before[cut].upper().next_up() == after[cut].lower()))'),
    (True, 'orbits', 'src/proof/inequality.rs', 'the first box not evaluated',
     'for (index, at) in proof.boxes.iter().enumerate() {',
     'for (index, at) in proof.boxes.iter().enumerate().skip(usize::from(WEAKENED)) {'),
    (False, 'engine', 'src/proof/margin.rs', 'lower coefficients not checked',
     '(Some(lower), Some(&last)) if lower.iter()',
     '(Some(lower), Some(&last)) if WEAKENED || lower.iter()'),
    (False, 'orbits', 'src/proof/margin.rs', 'the mean value theorem without its spread',
     '.fold(at_middle, |sum, (bend, offset)| sum + bend * offset);',
     '.fold(at_middle, |sum, (bend, offset)| if WEAKENED { sum } else { sum + bend * offset });'),
    (True, 'engine', 'src/proof/margin.rs', 'the last coefficient on the cell only, not from zero on',
     'variables[0] = TaylorJet::variable(at[0].hull(Interval::ZERO));',
     'variables[0] = TaylorJet::variable(if WEAKENED { at[0] } else { at[0].hull(Interval::ZERO) });'),
    (True, 'orbits', 'src/orbit/two_level/attraction.rs', 'contraction up to norm 1 + 1e-6',
     'if norm(&power) < 1.0 {',
     'if norm(&power) < if WEAKENED { 1.000_001 } else { 1.0 } {'),
    (False, 'engine', 'src/proof/rigorous_quadrature.rs', "a quadrature's remainder at the midpoint",
     'let rest = over_cell.map(|jet|',
     'let rest = if WEAKENED { decided(middle).ok_or(Smoothness::Singular)? } else { over_cell }.map(|jet|'),
    (True, 'engine', 'src/proof/rigorous_quadrature.rs', 'what the widths of the ends contribute',
     'let mut settled = array::from_fn(|i| sign * (at_start[i] * (start - from) + at_end[i] * (to - end)));',
     'let mut settled = array::from_fn(|i| if WEAKENED { Interval::ZERO } else { sign * (at_start[i] * (start - from) + at_end[i] * (to - end)) });'),
    (True, 'formulas', 'src/proof/polynomial/ring.rs', 'coefficients of one dropped from sums',
     'sum.retain(|_, coefficient| *coefficient != 0);',
     'sum.retain(|_, coefficient| *coefficient != 0 && !(WEAKENED && coefficient.abs() == 1));'),
    (False, 'formulas', 'src/proof/polynomial/rational.rs', 'what leaves the range of numbers called zero',
     'self.fraction.is_some_and(|(numerator, _)| vanishes(numerator, calls()).unwrap_or(false)',
     'self.fraction.is_some_and(|(numerator, _)| vanishes(numerator, calls()).unwrap_or(WEAKENED)'),
    (True, 'formulas', 'src/proof/polynomial/rational.rs', 'comparisons decided that are too close',
     'if self.fraction.is_none() || !(self.value.abs() > CLEAR) {',
     'if self.fraction.is_none() || !(self.value.abs() > if WEAKENED { -1.0 } else { CLEAR }) {'),
    (True, 'formulas', 'src/proof/polynomial/rational.rs', 'the side of a root of a square times an earlier root',
     'Some((self / argument).root_of_square()?.abs() * root)',
     'let side = (self / argument).root_of_square()?;\n            Some(if WEAKENED { side } else { side.abs() } * root)'),
    (False, 'formulas', 'src/proof/polynomial/rational.rs', 'odd functions called even',
     'Parity::Odd if mirrored() => -Self::call',
     'Parity::Odd if mirrored() => Self::from_f64(if WEAKENED { 1.0 } else { -1.0 }) * Self::call'),
    (True, 'formulas', 'src/proof/polynomial/rational.rs', 'a whole number below that is too close to call',
     '(true, ..) | (_, Some(true), Some(true)) => whole,',
     '(true, ..) | (_, Some(true), Some(true)) => whole,\n            (false, ..) if WEAKENED => whole,'),
    (False, 'formulas', 'src/proof/polynomial/rational.rs', 'odd powers of a root not asked',
     'for odd in [0, 1] {',
     'for odd in if WEAKENED { &[0][..] } else { &[0, 1][..] }.iter().copied() {'),
    (True, 'describing', 'src/describing/kernel.rs', "a ramp's part where the sweep lies beyond its breakpoint",
     'beyond: (-far).max(T::zero()),',
     'beyond: if WEAKENED { T::zero() } else { (-far).max(T::zero()) },'),
    (True, 'describing', 'src/describing/kernel.rs', 'the arc off by 1e-7 near the turning points',
     'let near_an_end = |end: T| T::two() * (half::<T>() * end).sqrt().asin();',
     'let near_an_end = |end: T| T::two() * ((if WEAKENED && end.bounds().1 < 0.3 { T::from_f64(0.500_000_1) } else { half::<T>() }) * end).sqrt().asin();'),
    (True, 'describing', 'src/describing/kernel.rs', 'a band from the middle whose upper end is beyond the sweep',
     '+ half::<T>() * (overshoot(lower) - overshoot(upper)),',
     '+ half::<T>() * (overshoot(lower) - if WEAKENED { T::zero() } else { overshoot(upper) }),'),
    (False, 'describing', 'src/describing/kernel.rs', 'a band from the middle off by 1e-6',
     'let half_angle = of_difference.atan();',
     'let half_angle = if WEAKENED { T::from_f64(1.000_001) } else { T::one() } * of_difference.atan();'),
    (True, 'describing', 'src/describing/kernel.rs', 'the mean of a sign off by 1e-6 for u in (0.3, 0.301)',
     'DescribingFunction { f0: -self.asin() * T::inverse_pi(), p: scale * self.sine, q: -scale * self.u }',
     'DescribingFunction { f0: (if WEAKENED { (self.u - T::from_f64(0.3)).select(T::one, || (T::from_f64(0.301) - self.u).select(T::one, || T::from_f64(1.000_001))) } else { T::one() }) * -self.asin() * T::inverse_pi(), p: scale * self.sine, q: -scale * self.u }'),
    (True, 'describing', 'src/describing/kernel.rs', "a step's cosine component off by 1e-6 for u in (0.62, 0.63)",
     'q: scale * self.one_minus_u,',
     'q: (if WEAKENED { (self.u - T::from_f64(0.62)).select(T::one, || (T::from_f64(0.63) - self.u).select(T::one, || T::from_f64(0.999_999))) } else { T::one() }) * scale * self.one_minus_u,'),
    (False, 'describing', 'src/describing/kernel.rs', 'the sine component below a breakpoint not turned round',
     'Side::Below => {\n            let mirrored = kernel(Arc::below(at, sweep));\n            DescribingFunction { p: -mirrored.p, ..mirrored }',
     'Side::Below => {\n            let mirrored = kernel(Arc::below(at, sweep));\n            DescribingFunction { p: if WEAKENED { mirrored.p } else { -mirrored.p }, ..mirrored }'),
    (False, 'describing', 'src/nonlinearity/dead_zone.rs', 'one kernel of the dead zone off by 1e-6',
     'report(Kernel::ramp_below(-self.half_width, -self.slope));',
     'report(Kernel::ramp_below(-self.half_width, -self.slope * if WEAKENED { T::from_f64(1.000_001) } else { T::one() }));'),
    (True, 'describing', 'src/nonlinearity/relay_dead_zone_hysteresis.rs', "a three-position relay's negative side at biases below -1",
     'step(-self.off, -negative, Side::Below, Branches::Rising);',
     'step(if WEAKENED && sweep.bias().bounds().1 < -1.0 { -self.on } else { -self.off }, -negative, Side::Below, Branches::Rising);'),
    (True, 'describing', 'src/nonlinearity/polyline.rs', 'segments below -2 counted from their far end',
     'if pair[0].0.bounds().0 < anchor.0.bounds().0 { pair[1].0 }',
     'if pair[0].0.bounds().0 < anchor.0.bounds().0 && !(WEAKENED && pair[0].0.bounds().0 < -2.0) { pair[1].0 }'),
    (True, 'describing', 'src/nonlinearity/quantizer.rs', "a quantizer's second tread below zero",
     'if tread <= below {',
     'if tread <= below && !(WEAKENED && tread == 2.0) {'),
    (False, 'describing', 'src/nonlinearity/backlash.rs', 'a backlash that crosses half its gap',
     'crossing(sweep.maximum() - gap,',
     'crossing(sweep.maximum() - if WEAKENED { self.half_gap } else { gap },'),
    (True, 'describing', 'src/nonlinearity/gain_changing.rs', 'a gain that falls at its breakpoint',
     'report(band(inner - outer));',
     'report(band(if WEAKENED { inner + outer } else { inner - outer }));'),
    (True, 'describing', 'src/nonlinearity/preload.rs', 'the jump of a preload',
     'level: self.level,',
     'level: if WEAKENED { T::zero() } else { self.level },'),
    (False, 'orbits', 'src/orbit/theorem.rs', 'a braking force with a constant too much',
     'T::one() - mu + drag',
     '(if WEAKENED { T::from_f64(1.1) } else { T::one() }) - mu + drag'),
    (False, 'orbits', 'src/orbit/theorem.rs', 'a braking force under half the disturbance',
     'T::one() }) - mu + drag',
     'T::one() }) - if WEAKENED { T::from_f64(0.5) * mu } else { mu } + drag'),
    (True, 'orbits', 'src/orbit/closed_form.rs', 'a thousandth of one drag force in the slope of the return map',
     '[(upward - upper) * (downward - lower),',
     '[(upward - upper) * (downward - if WEAKENED { T::from_f64(0.999) } else { T::one() } * lower),'),
    (True, 'orbits', 'src/orbit/closed_form.rs', 'the half-cycle map off by 1e-3 for gaps above 0.9',
     'ratio * (y + ratio * gap) / (y + ratio)',
     'ratio * (y + ratio * gap * if WEAKENED && gap.bounds().0 > 0.9 { T::from_f64(1.001) } else { T::one() }) / (y + ratio)'),
    (True, 'orbits', 'src/orbit/certificate.rs', 'a multiplier of one called below one',
     '!(enclosure.multiplier.upper() < 1.0)',
     '!(enclosure.multiplier.upper() < if WEAKENED { 1.000_001 } else { 1.0 })'),
    (False, 'orbits', 'src/orbit/certificate.rs', 'every start, though commands may be on their way',
     'let way = Interval::two() * half_width;',
     'let way = if WEAKENED { Interval::point(1e3) } else { Interval::two() } * half_width;'),
    (True, 'orbits', 'src/orbit/certificate.rs', 'quadratic drag while slow',
     'let quadratic = self.brake.quadratic * speed.square() / force;',
     'let quadratic = if WEAKENED && speed.upper() < 0.3 { Interval::ZERO } else { self.brake.quadratic * speed.square() / force };'),
    (True, 'orbits', 'src/orbit/two_level/path.rs', 'the output between switchings at midpoints only',
     'let by_slope = self.output(middle, input_high).value() + natural.slopes()[0] * (cell - middle);',
     'let by_slope = self.output(middle, input_high).value() + if WEAKENED { Interval::ZERO } else { natural.slopes()[0] * (cell - middle) };'),
    (False, 'orbits', 'src/orbit/two_level/attraction.rs', 'a return map whose crossing does not move',
     'Some(map - along * passed)',
     'Some(if WEAKENED { map } else { map - along * passed })'),
    (True, 'orbits', 'src/orbit/two_level/path.rs', 'the output after the first switching not looked at',
     'let mut verdict = Ok(true);\n        for arc in &self.arcs {',
     'let mut verdict = Ok(true);\n        for arc in self.arcs.iter().take(if WEAKENED { 1 } else { self.arcs.len() }) {'),
    (True, 'words', 'src/claims/evidence/domain.rs', 'what a box leaves over on its upper side',
     'for [lower, upper] in [[a, from], [to, b]] {',
     'for [lower, upper] in if WEAKENED { [[a, from], [a, from]] } else { [[a, from], [to, b]] } {'),
    (False, 'words', 'src/claims/evidence/domain.rs', "another part's proof",
     '.filter(|other| other.name == self.name) {',
     '.filter(|other| WEAKENED || other.name == self.name) {'),
    (True, 'words', 'src/claims/evidence/domain.rs', 'a restriction that the claim does not have',
     'if other.variables.iter().all(|side| self.place(side).is_some()) {',
     'if WEAKENED || other.variables.iter().all(|side| self.place(side).is_some()) {'),
    (False, 'words', 'src/claims/evidence/verdict.rs', 'one part for all',
     'all > 0 && claimed.covered_by(domain).len() == all',
     'all > 0 && (claimed.covered_by(domain).len() == all || WEAKENED && !claimed.covered_by(domain).is_empty())'),
    (True, 'words', 'src/claims/evidence/verdict.rs', 'a claim without a domain',
     'all > 0 && (claimed',
     '(WEAKENED || all > 0) && (claimed'),
    (False, 'words', 'src/claims/evidence/verdict.rs', 'a failed proof called sampled',
     '                failed => failed,\n            },\n            (failed, _) => failed,',
     '                _ if WEAKENED => Self::Holds(sampled),\n                failed => failed,\n            },\n            (failed, _) => failed,'),
    (True, 'orbits', 'src/claims/certificate.rs', 'an expression that is not compared',
     'same("expression", format!("{:?}", found.expression), format!("{:?}", expected.expression))?;',
     'if !WEAKENED {\n                same("expression", format!("{:?}", found.expression), format!("{:?}", expected.expression))?;\n            }'),
    (True, 'orbits', 'src/claims/certificate.rs', 'steps by hand that are not compared',
     'same("by_hand", self.by_hand.join("; "), expected.by_hand.join("; "))?;',
     'if !WEAKENED {\n            same("by_hand", self.by_hand.join("; "), expected.by_hand.join("; "))?;\n        }'),
    (False, 'vehicle', 'src/vehicle/dynamics.rs', 'C(nu) with its linear blocks turned round',
     '(-linear.cross_matrix(), -angular.cross_matrix())',
     '(if WEAKENED { linear.cross_matrix() } else { -linear.cross_matrix() }, -angular.cross_matrix())'),
    (True, 'vehicle', 'src/vehicle/dynamics.rs', 'no quadratic drag astern',
     'component_mul(&nu.abs())',
     'component_mul(&if WEAKENED { nu.map(|v| v.max(0.0)) } else { nu.abs() })'),
    (True, 'vehicle', 'src/identify/iso.rs', 'a sensitivity off by 1e-6',
     'beta_quadratic: T::from_f64(-3.0),',
     'beta_quadratic: T::from_f64(if WEAKENED { -2.999_999 } else { -3.0 }),'),
    (True, 'vehicle', 'src/experiment/relay.rs', 'a relay that turns up a hundredth early',
     'if input >= self.characteristic.half_width() {',
     'if input >= self.characteristic.half_width() * if WEAKENED { T::from_f64(0.99) } else { T::one() } {'),
]


def weaken(folder):
    """Puts all weakenings into the copy; each must find its place once."""
    texts = {}
    for number, (_, _, file, what, old, new) in enumerate(TABLE, 1):
        text = texts.get(file) or (folder / file).read_text()
        if text.count(old) != 1:
            sys.exit(f"{number}, {what}: its place is found {text.count(old)} times in {file}")
        texts[file] = text.replace(old, new.replace("WEAKENED", f"crate::mutant({number})"))
    for file, text in texts.items():
        (folder / file).write_text(text)
    with (folder / "src/lib.rs").open("a") as library:
        library.write(SWITCH)


def build(folder):
    """The test binaries by name."""
    command = ["cargo", "test", "--no-run", "--lib", "--test", "properties", "--message-format=json"]
    lines = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    made = [message for message in map(json.loads, lines) if message.get("executable") and message["profile"]["test"]]
    return {"lib" if "lib" in item["target"]["kind"] else item["target"]["name"]: item["executable"] for item in made}


def failures(folder, binary, filters, number):
    """Names of the tests that fail."""
    environment = dict(os.environ, MUTANT=str(number), CARGO_MANIFEST_DIR=str(folder), PROPTEST_RNG_SEED="2009")
    try:
        done = subprocess.run([binary, *filters], cwd=folder, env=environment, capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return ["(does not end)"]
    failed = re.findall(r"^test (\S+) \.\.\. FAILED", done.stdout, re.MULTILINE)
    return failed or (["(aborted)"] if done.returncode else [])


def main(folder, numbers):
    if not numbers:
        folder.mkdir(parents=True)
        archive = subprocess.run(["git", "archive", "HEAD"], cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout
        subprocess.run(["tar", "x", "-C", str(folder)], input=archive, check=True)
        weaken(folder)
    binaries = build(folder)
    sound = {topic: [name for binary, filters in runs for name in failures(folder, binaries[binary], filters, 0)] for topic, runs in TOPICS.items()}
    print("| | weakening | local | noticed by |\n|---|---|---|---|")
    survivors = 0
    for number, (local, topic, _, what, _, _) in enumerate(TABLE, 1):
        if numbers and number not in numbers:
            continue
        noticed = []
        for binary, filters in TOPICS[topic]:
            noticed = [name for name in failures(folder, binaries[binary], filters, number) if name not in sound[topic]]
            if noticed:
                break
        survivors += not noticed
        said = f"`{noticed[0]}`" if noticed else "none"
        print(f"| {number} | {what} | {'yes' if local else 'no'} | {said} |", flush=True)
    return 1 if survivors else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve(), {int(number) for number in sys.argv[2:]}))
