//! A first-order process with dead time from a few hundred readings: in f32 or f64, without allocation.

use super::{FirstOrderProcess, LEAST_EXPLAINED, ProcessError};
use crate::numeric::Scalar;

/// Dead times, and rates of decay, that are tried first.
const DEAD_TIMES: u8 = 12;
const RATES: u8 = 8;
/// Rounds of the search, and the share of its first steps at which it ends.
const ROUNDS: u8 = 60;
const FINEST: f64 = 1e-3;
/// The rate of decay reaches `exp(FASTEST) - 1` over the time scale: a lag of a hundredth of the time between changes.
const FASTEST: f64 = 4.0;

/// Readings of a relay's or thermostat's record: time in s, output, command, each command from its row's time on.
#[derive(Clone, Copy, Debug)]
pub struct ProcessReadings<'a, T> {
    time_s: &'a [T],
    output: &'a [T],
    command: &'a [T],
}

/// A triangle that takes rows of a least-squares problem one at a time by Givens rotations (Golub and Van Loan, Matrix Computations,
/// 5.2.5): three unknowns and the right-hand side. Errors grow as those of the rows do, not as their squares: f32 suffices.
#[derive(Clone, Copy)]
struct Triangle<T>([[T; 4]; 4]);

impl<T: Scalar> Triangle<T> {
    fn push(&mut self, mut row: [T; 4]) {
        for (k, kept) in self.0.iter_mut().enumerate() {
            let [mine, new] = [&*kept, &row].map(|row| row.get(k).copied().unwrap_or(T::zero()));
            let length = (mine.square() + new.square()).sqrt();
            if !(length > T::zero()) {
                continue;
            }
            let (cosine, sine) = (mine / length, new / length);
            for (mine, new) in kept.iter_mut().zip(&mut row).skip(k) {
                (*mine, *new) = (cosine * *mine + sine * *new, cosine * *new - sine * *mine);
            }
        }
    }

    /// The sum of squares that is left.
    fn square(&self) -> T {
        let [.., [.., last]] = self.0;
        last.square()
    }

    /// The last unknown, by its row of the triangle; 0 where the rows do not tell it.
    fn last(&self) -> T {
        let [_, _, [_, _, own, right], _] = self.0;
        if own.abs() > T::zero() { right / own } else { T::zero() }
    }
}

/// Time scale of the record, and the readings that count.
#[derive(Clone, Copy)]
struct ReadingSpan<T> {
    /// Mean time between changes of the command, s: a longer dead time is one of another change.
    half_s: T,
    /// Readings from this time on count: the command before the record acts up to the dead time.
    from_s: T,
}

/// Dead time over the mean time between changes, and `ln(1 + rate half_s)` with the rate of decay `stiffness/drag`.
type SearchPlace<T> = [T; 2];

impl<'a, T: Scalar> ProcessReadings<'a, T> {
    /// Most readings.
    pub const MOST: usize = 256;

    /// Readings as they are.
    ///
    /// ```
    /// use selfosc::autotune::ProcessReadings;
    /// // 2/(5 s + 1) after 1 s under a square wave of period 8 s, read at 5 Hz in f32.
    /// let (mut time, mut output, mut command, mut y) = ([0.0_f32; 200], [0.0; 200], [0.0; 200], 0.0);
    /// for k in 0..200 {
    ///     time[k] = 0.2 * k as f32;
    ///     output[k] = y;
    ///     command[k] = if k % 40 < 20 { 1.0 } else { 0.0 };
    ///     let late = if k >= 5 && (k - 5) % 40 < 20 { 2.0 } else { 0.0 };
    ///     y = late + (y - late) * (-0.2_f32 / 5.0).exp();
    /// }
    /// let process = ProcessReadings::new(&time, &output, &command)?.first_order()?;
    /// assert!((process.dead_time_s - 1.0).abs() < 0.02 && (process.drag - 2.5).abs() < 0.03);
    /// let gains = process.gains(0.2)?;
    /// assert!(gains.proportional() > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ProcessError::Readings`] unless all three have one length of at most [`MOST`](Self::MOST), times rise and all are finite.
    pub fn new(time_s: &'a [T], output: &'a [T], command: &'a [T]) -> Result<Self, ProcessError> {
        let samples = time_s.len();
        let finite = [time_s, output, command].into_iter().flatten().all(|value| value.is_finite());
        let rises = time_s.iter().zip(time_s.iter().skip(1)).all(|(now, next)| now < next);
        if samples > Self::MOST || output.len() != samples || command.len() != samples || !finite || !rises {
            return Err(ProcessError::Readings);
        }
        Ok(Self { time_s, output, command })
    }

    fn rows(&self) -> impl Iterator<Item = (T, T, T)> + '_ {
        self.time_s
            .iter()
            .zip(self.output)
            .zip(self.command)
            .map(|((time, output), command)| (*time, *output, *command))
    }

    /// Times of the first and the last change of the command, and how many there are.
    fn changes(&self) -> (T, T, usize) {
        let mut found = (T::zero(), T::zero(), 0);
        let pairs = self.time_s.iter().skip(1).zip(self.command.iter().zip(self.command.iter().skip(1)));
        for (time, (before, after)) in pairs {
            if before != after {
                found = (if found.2 == 0 { *time } else { found.0 }, *time, found.2 + 1);
            }
        }
        found
    }

    /// Least squares for the answer to the command, a constant load and the initial state, at a dead time and a rate of decay:
    /// `x' = -rate x + u(t - delay)`, `x' = -rate x + 1` and `x' = -rate x` from 1.
    fn triangle(&self, [delay, rate]: [T; 2], from_s: T) -> Triangle<T> {
        let mut triangle = Triangle([[T::zero(); 4]; 4]);
        let (Some(begin_s), Some(begin)) = (self.time_s.first().copied(), self.output.first().copied()) else {
            return triangle;
        };
        let mut delayed =
            self.time_s.iter().zip(self.command).map(|(time, command)| (*time + delay, *command)).peekable();
        // The command before the record is that of its first row: readings that this reaches do not count.
        let mut command = self.command.first().copied().unwrap_or(T::zero());
        let (mut now, mut state, mut load, mut mode) = (begin_s, T::zero(), T::zero(), T::one());
        for (time, output, _) in self.rows() {
            loop {
                let next = delayed.peek().copied().filter(|(at, _)| *at <= time);
                let until = next.map_or(time, |(at, _)| at.max(now));
                let share = -rate * (until - now);
                // (1 - exp(-rate t))/rate, which is t for an integrator.
                let held = if share.abs() > T::zero() { share.exp_m1() / -rate } else { until - now };
                let decay = share.exp();
                (state, load, mode) = (state * decay + command * held, load * decay + held, mode * decay);
                now = until;
                match next {
                    Some((_, then)) => {
                        command = then;
                        delayed.next();
                    }
                    None => break,
                }
            }
            if time >= from_s {
                triangle.push([mode, load, state, output - begin]);
            }
        }
        triangle
    }

    /// Dead time in s and rate of decay in 1/s at a place.
    fn meant([delay, rate]: SearchPlace<T>, half_s: T) -> [T; 2] {
        [delay * half_s, rate.exp_m1() / half_s]
    }

    fn square(&self, place: SearchPlace<T>, span: ReadingSpan<T>) -> T {
        let fastest = T::from_f64(FASTEST);
        let [delay, rate] = place.map(|side| side >= T::zero());
        if !(delay && rate && place[0] <= T::one() && place[1] <= fastest) {
            return T::from_f64(f64::INFINITY);
        }
        self.triangle(Self::meant(place, span.half_s), span.from_s).square()
    }

    /// A pattern search, which steps over the kinks where a delayed change meets a reading.
    fn descent(&self, start: SearchPlace<T>, span: ReadingSpan<T>) -> SearchPlace<T> {
        let (mut place, mut least) = (start, self.square(start, span));
        let number = T::from_f64;
        let mut step = [number(1.0 / f64::from(DEAD_TIMES)), number(FASTEST / f64::from(RATES))];
        let finest = step.map(|side| side * number(FINEST));
        for _ in 0..ROUNDS {
            let before = place;
            let [along, across] = step;
            let [delay, rate] = before;
            let around = [
                [delay + along, rate],
                [delay - along, rate],
                [delay, rate + across],
                [delay, rate - across],
                // At the bounds themselves: no dead time, no decay.
                [T::zero(), rate],
                [delay, T::zero()],
            ];
            for other in around {
                let square = self.square(other, span);
                if square < least {
                    (place, least) = (other, square);
                }
            }
            let factor = number(if place == before { 0.5 } else { 1.2 });
            step = step.map(|side| side * factor);
            if step.iter().zip(&finest).all(|(step, finest)| step < finest) {
                break;
            }
        }
        place
    }

    /// The first-order process, or the integrator, that is nearest to the readings.
    ///
    /// Errors of the readings count as independent: a load that wanders shows in the process. Two periods of a relay's
    /// oscillation give dead time and `drag` to some percent of what the full record of the command gives; `stiffness` is told
    /// the less, the longer the time constant beside the period. The process is one answer without its interval.
    ///
    /// # Errors
    /// [`ProcessError::FewChanges`], [`ProcessError::FewSamples`], and [`ProcessError::NoAnswer`] where most of the output's
    /// variation is left, or the output does not move with the command.
    pub fn first_order(&self) -> Result<FirstOrderProcess<T>, ProcessError> {
        let samples = self.time_s.len();
        let (first_s, last_s, changes) = self.changes();
        if samples < ProcessError::LEAST_SAMPLES {
            return Err(ProcessError::FewSamples { samples });
        }
        if changes < ProcessError::LEAST_CHANGES {
            return Err(ProcessError::FewChanges { changes });
        }
        let number = T::from_f64;
        let half_s = (last_s - first_s) / number((changes - 1) as f64);
        let begin_s = self.time_s.first().copied().unwrap_or(T::zero());
        let mut span = ReadingSpan { half_s, from_s: begin_s + half_s };
        let infinity = number(f64::INFINITY);
        let (mut place, mut least) = ([T::zero(); 2], infinity);
        for delay in 0..DEAD_TIMES {
            for rate in 0..RATES {
                let other = [
                    number(f64::from(delay) / f64::from(DEAD_TIMES)),
                    number(FASTEST * f64::from(rate) / f64::from(RATES)),
                ];
                let square = self.square(other, span);
                if square < least {
                    (place, least) = (other, square);
                }
            }
        }
        place = self.descent(place, span);
        // Readings after the dead time count.
        span.from_s = begin_s + number(1.2) * place[0] * half_s;
        place = self.descent(place, span);
        let [delay_s, rate] = Self::meant(place, half_s);
        let triangle = self.triangle([delay_s, rate], span.from_s);
        let slope = triangle.last();
        let left = triangle.square() / self.variation(span.from_s);
        let (drag, reverse) = (T::one() / slope.abs(), slope < T::zero());
        let process = FirstOrderProcess { drag, stiffness: rate * drag, dead_time_s: delay_s, reverse };
        let numbers = drag > T::zero() && drag.is_finite() && process.stiffness.is_finite();
        if !(numbers && left < number(1.0 - LEAST_EXPLAINED)) {
            return Err(ProcessError::NoAnswer { left: if left.is_finite() { left.value().min(1.0) } else { 1.0 } });
        }
        Ok(process)
    }

    /// Sum of squares of the output about its mean.
    fn variation(&self, from_s: T) -> T {
        let counted = || self.rows().filter(|row| row.0 >= from_s).map(|row| row.1);
        let (sum, count) = counted().fold((T::zero(), T::zero()), |(sum, count), y| (sum + y, count + T::one()));
        let mean = sum / count;
        counted().fold(T::zero(), |sum, y| sum + (y - mean).square())
    }
}
