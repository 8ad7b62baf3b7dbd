//! Where the search begins: the equation of motion under smooth weights, solved by linear least squares for each of several
//! delays (modulating functions, Shinbrot 1957): derivatives fall on the weights, so that noise is not differentiated.

use nalgebra::{DMatrix, DVector};

use crate::identify::answer::DragLaw;
use crate::identify::signal::{CommandPiece, Signal, least_squares};

/// Inertia, linear and quadratic drag, disturbance, delay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ModulatedStart {
    pub(crate) alpha: f64,
    pub(crate) linear: f64,
    pub(crate) quadratic: f64,
    pub(crate) disturbance: f64,
    pub(crate) delay_s: f64,
    /// Root mean square of the equations' residuals, in units of the command.
    pub(crate) misfit: f64,
}

/// Longest delay tried, in half-periods.
const LONGEST_DELAY: f64 = 0.6;
/// Delays tried, in half-periods: inertia and delay turn the phase alike, so a single equation's misfit does not determine both.
const DELAYS: [&[f64]; 4] = [&[0.0, 0.03, 0.06], &[0.1, 0.14, 0.18], &[0.23, 0.28, 0.33], &[0.4, 0.5, LONGEST_DELAY]];

/// The best start of each range of delays, or the start at the given delay.
pub(crate) fn starts(signal: &Signal, delay_s: Option<f64>) -> Vec<ModulatedStart> {
    let rows = ModulatedEquations::new(signal, LONGEST_DELAY * signal.half_period_s);
    let best = |delays: &mut dyn Iterator<Item = f64>| {
        let starts = delays.filter_map(|delay_s| rows.solve(signal, delay_s));
        starts.min_by(|a, b| a.misfit.total_cmp(&b.misfit))
    };
    match delay_s {
        Some(known) => best(&mut core::iter::once(known)).into_iter().collect(),
        None => {
            let range = |parts: &&[f64]| best(&mut parts.iter().map(|part| part * signal.half_period_s));
            DELAYS.iter().filter_map(range).collect()
        }
    }
}

/// Orders of magnitude where noise makes equations without sense.
pub(crate) fn rough(signal: &Signal, delay_s: Option<f64>) -> ModulatedStart {
    let speed = signal.fastest.max(signal.span / signal.half_period_s);
    let force = 0.5 * signal.range;
    ModulatedStart {
        alpha: STAND_IN * force * signal.half_period_s / speed,
        linear: 0.5 * STAND_IN * force / speed,
        quadratic: 0.5 * STAND_IN * force / (speed * speed),
        disturbance: 0.0,
        delay_s: delay_s.unwrap_or(ROUGH_DELAY * signal.half_period_s),
        misfit: f64::INFINITY,
    }
}

/// The best start of each delay that is looked for; none where the equations make no sense.
pub(crate) fn at_every_delay(signal: &Signal) -> Vec<ModulatedStart> {
    let rows = ModulatedEquations::new(signal, LONGEST_DELAY * signal.half_period_s);
    let delays = DELAYS.iter().flat_map(|parts| parts.iter().map(|part| part * signal.half_period_s));
    delays.filter_map(|delay_s| rows.solve(signal, delay_s)).collect()
}

/// Default delay, in half-periods.
const ROUGH_DELAY: f64 = 0.05;
/// Distance of successive weights, in half-periods.
const STRIDE: f64 = 0.3;
/// The speed under a weight is a difference quotient over twice the half-period divided by this.
const SPEED_SPANS: f64 = 8.0;
/// How many times as well the command's opposite has to fit.
const CONTRARY: f64 = 3.0;
/// Misfit, in ranges of the command, above which the equations are taken for noise.
const SENSIBLE: f64 = 0.15;

/// Whether the output answers the command's opposite: with it the equations of motion make sense, and with the command they do not.
pub(crate) fn answers_against(signal: &Signal, delay_s: Option<f64>) -> bool {
    let misfit =
        |signal: &Signal| starts(signal, delay_s).iter().map(|start| start.misfit).fold(f64::INFINITY, f64::min);
    let mut opposite = signal.clone();
    for piece in &mut opposite.pieces {
        (piece.value, piece.slope) = (-piece.value, -piece.slope);
    }
    let against = misfit(&opposite);
    against < SENSIBLE * signal.range && misfit(signal) > CONTRARY * against
}

/// The integrals that do not depend on the delay.
struct ModulatedEquations {
    begins: Vec<f64>,
    integrals: Vec<[f64; 4]>,
}

impl ModulatedEquations {
    fn new(signal: &Signal, longest_delay_s: f64) -> Self {
        let Signal { time_s, output, half_period_s, interval_s, .. } = signal;
        let (half_period, last) = (*half_period_s, time_s.len() - 1);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
        let reach = (half_period / (SPEED_SPANS * interval_s)).max(1.0) as usize;
        let (mut begins, mut integrals) = (Vec::new(), Vec::new());
        let mut begin = time_s[0] + longest_delay_s;
        while begin + half_period <= time_s[last] {
            let from = time_s.partition_point(|t| *t < begin).max(1);
            let to = time_s.partition_point(|t| *t <= begin + half_period).min(last);
            let mut sums = [0.0; 4];
            let middle = output[from];
            let rate = core::f64::consts::TAU / half_period;
            for k in from..to {
                let weight = 0.5 * (time_s[k + 1] - time_s[k - 1]);
                let (sine, cosine) = libm::sincos(rate * (time_s[k] - begin));
                let (value, slope, bend) = (0.5 * (1.0 - cosine), 0.5 * rate * sine, 0.5 * rate * rate * cosine);
                let (back, ahead) = (k.saturating_sub(reach), (k + reach).min(last));
                let speed = (output[ahead] - output[back]) / (time_s[ahead] - time_s[back]);
                sums[0] += weight * bend * (output[k] - middle);
                sums[1] -= weight * slope * (output[k] - middle);
                sums[2] += weight * value * speed * speed.abs();
                sums[3] -= weight * value;
            }
            begins.push(begin);
            integrals.push(sums);
            begin += STRIDE * half_period;
        }
        Self { begins, integrals }
    }

    /// The command under every weight, acting after a delay.
    fn command(&self, signal: &Signal, delay_s: f64) -> Vec<f64> {
        self.begins.iter().map(|begin| weighted(&signal.pieces, begin - delay_s, signal.half_period_s)).collect()
    }

    /// Inertia, linear drag, quadratic drag and disturbance by least squares, those of `columns` alone.
    fn parameters(&self, columns: &[usize], right: &[f64]) -> [f64; 4] {
        let rows = self.begins.len();
        let matrix = DMatrix::from_fn(rows, columns.len(), |row, column| self.integrals[row][columns[column]]);
        let solution = least_squares(matrix, DVector::from_fn(rows, |row, _| right[row]));
        let mut values = [0.0; 4];
        for (index, column) in columns.iter().enumerate() {
            values[*column] = solution[index];
        }
        values
    }

    fn solve(&self, signal: &Signal, delay_s: f64) -> Option<ModulatedStart> {
        let right = self.command(signal, delay_s);
        // Laws with a single kind of drag replace the mixed law where its solution is outside the domain.
        let laws: [&[usize]; 3] = [&[0, 1, 2, 3], LINEAR, QUADRATIC];
        let solved = laws.iter().filter_map(|columns| {
            let rows = self.begins.len();
            if rows < columns.len() + 2 {
                return None;
            }
            let values = self.parameters(columns, &right);
            let square: f64 = self
                .integrals
                .iter()
                .zip(&right)
                .map(|(row, right)| (row.iter().zip(values).map(|(a, b)| a * b).sum::<f64>() - right).powi(2))
                .sum();
            let misfit = (square / (rows - columns.len()) as f64).sqrt();
            let [alpha, linear, quadratic, disturbance] = values;
            let drag = linear + quadratic * signal.fastest;
            let sensible = alpha > 0.0 && drag > 0.0 && quadratic >= 0.0 && misfit.is_finite();
            sensible.then_some(ModulatedStart { alpha, linear, quadratic, disturbance, delay_s, misfit })
        });
        solved.min_by(|a, b| a.misfit.total_cmp(&b.misfit))
    }
}

/// Columns of the equations of an axis with a single kind of drag.
const LINEAR: &[usize] = &[0, 1, 3];
const QUADRATIC: &[usize] = &[0, 2, 3];
/// Solutions within this factor of their orders of magnitude count, on either side.
const SENSIBLE_FACTOR: f64 = 50.0;
/// The part of an order of magnitude that stands in for a solution.
const STAND_IN: f64 = 0.3;

/// Inertia, the coefficient of a single kind of drag, and disturbance at a delay; their orders of magnitude where noise makes equations
/// without sense. `None` for a record that is too short.
pub(crate) fn with_one_drag(signal: &Signal, law: DragLaw, delay_s: f64) -> Option<[f64; 3]> {
    let equations = ModulatedEquations::new(signal, delay_s);
    if equations.begins.len() < 4 {
        return None;
    }
    let columns = if law == DragLaw::Quadratic { QUADRATIC } else { LINEAR };
    let [alpha, linear, quadratic, disturbance] = equations.parameters(columns, &equations.command(signal, delay_s));
    let (force, speed) = (0.25 * signal.range, signal.span / signal.half_period_s);
    let unit = if law == DragLaw::Quadratic { speed * speed } else { speed };
    let or = |value: f64, order: f64| {
        if value > order / SENSIBLE_FACTOR && value < order * SENSIBLE_FACTOR { value } else { STAND_IN * order }
    };
    let disturbance = if disturbance.is_finite() { disturbance.clamp(-force, force) } else { 0.0 };
    Some([or(alpha, force * signal.half_period_s / speed), or(linear + quadratic, force / unit), disturbance])
}

/// The command under the weight that begins at a time, integrated piece by piece.
fn weighted(pieces: &[CommandPiece], begin: f64, half_period: f64) -> f64 {
    let rate = core::f64::consts::TAU / half_period;
    let integral = |t: f64| 0.5 * (t - libm::sin(rate * t) / rate);
    let mut sum = 0.0;
    let mut index = pieces.partition_point(|piece| piece.begin_s <= begin).saturating_sub(1);
    while index < pieces.len() {
        let piece = pieces[index];
        let from = if index == 0 { begin } else { piece.begin_s.max(begin) };
        let to = pieces.get(index + 1).map_or(f64::INFINITY, |next| next.begin_s).min(begin + half_period);
        if from >= begin + half_period {
            break;
        }
        let value = piece.value + piece.slope * (0.5 * (from + to) - piece.begin_s);
        sum += value * (integral(to - begin) - integral(from - begin));
        index += 1;
    }
    sum
}
