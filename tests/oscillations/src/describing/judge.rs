//! Answers about describing-function loops, judged.

use std::fmt::Write as _;

use super::answer::{Balance, Bounds, Line};
use super::harmonic_balance;
use super::loops::DescribingLoop;
use super::truth::{Oscillation, Truth, oscillation, truth};

/// What an answer says and the judge denies.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Contradiction {
    /// The document is none of `balance`.
    #[error("the document is no balance: {0}")]
    Unreadable(String),
    /// No oscillation stands in a box.
    #[error("no oscillation has amplitude in {:?} and omega in {:?}; the nearest has {nearest:?}", bounds.amplitude, bounds.omega_rad_s)]
    Empty {
        /// The box.
        bounds: Bounds,
        /// Amplitude and frequency of the nearest oscillation.
        nearest: Option<(f64, f64)>,
    },
    /// A verdict on stability is wrong.
    #[error("oscillation at amplitude {amplitude}: stable {listed}, by {by}, but a disturbed motion says {attracting}")]
    Stability {
        /// Amplitude listed.
        amplitude: f64,
        /// What is listed.
        listed: bool,
        /// How it is said to be known.
        by: String,
        /// What the motion does.
        attracting: bool,
    },
    /// An intersection has neither a box nor a reason.
    #[error("the intersection of amplitude {amplitude}, omega {omega} has neither a box nor a reason")]
    Silent {
        /// Its amplitude.
        amplitude: f64,
        /// Its frequency in rad/s.
        omega: f64,
    },
    /// A box is wider than the class of the loop allows: no falsehood, a target missed.
    #[error("half-width of the amplitude {half_width:.1e} is above {target:.0e}")]
    Wide {
        /// Relative half-width.
        half_width: f64,
        /// Largest allowed.
        target: f64,
    },
}

/// Judgement of one loop.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The loop and what is true of it.
    pub truth: Truth,
    /// What is wrong.
    pub contradictions: Vec<Contradiction>,
    /// Boxes said to hold an oscillation.
    pub boxes: Vec<Bounds>,
    /// Oscillations of the loop in a box.
    pub held: usize,
    /// Reasons for what is not proved.
    pub reasons: Vec<String>,
    /// Wall time of the answer in s.
    pub seconds: Option<f64>,
    /// Whether there was an answer.
    pub answered: bool,
}

/// Largest half-width of the amplitude that is asked for, relative.
#[must_use]
pub fn target(control_loop: &DescribingLoop) -> f64 {
    match (control_loop.characteristic.has_kinks(), control_loop.plant.relative_degree()) {
        (false, _) => 1e-10,
        (true, 3..) => 1e-7,
        (true, _) => 1e-4,
    }
}

/// Judges a line.
#[must_use]
pub fn judge(line: &Line) -> Judgement {
    let mut judgement = Judgement {
        truth: truth(&line.control_loop),
        contradictions: Vec::new(),
        boxes: Vec::new(),
        held: 0,
        reasons: Vec::new(),
        seconds: line.seconds,
        answered: false,
    };
    let Some(document) = &line.answer else { return judgement };
    match serde_json::from_value::<Balance>(document.clone()) {
        Ok(balance) => {
            judgement.answered = true;
            judgement.existence(&line.control_loop, &balance);
            judgement.stability(&balance);
        }
        Err(why) => judgement.contradictions.push(Contradiction::Unreadable(why.to_string())),
    }
    judgement
}

impl Judgement {
    fn existence(&mut self, control_loop: &DescribingLoop, balance: &Balance) {
        self.boxes = balance.boxes();
        self.reasons = balance.reasons();
        for bounds in &self.boxes {
            // An oscillation that the scan has not met may be found from the box itself.
            if !self.truth.oscillations.iter().any(|one| holds(bounds, one))
                && let Some(found) = within(control_loop, bounds)
                && !self.truth.oscillations.iter().any(|one| (one.amplitude / found.amplitude - 1.0).abs() < 1e-9)
            {
                self.truth.oscillations.push(found);
            }
            if !self.truth.oscillations.iter().any(|one| holds(bounds, one)) {
                let middle = 0.5 * (bounds.amplitude[0] + bounds.amplitude[1]);
                let distance = |one: &&Oscillation| (one.amplitude - middle).abs();
                let nearest = self.truth.oscillations.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
                let nearest = nearest.map(|one| (one.best().0, one.best().1));
                self.contradictions.push(Contradiction::Empty { bounds: *bounds, nearest });
            }
            let (half_width, target) = (bounds.half_width(), target(control_loop));
            if !(half_width <= target) {
                self.contradictions.push(Contradiction::Wide { half_width, target });
            }
        }
        self.held =
            self.truth.oscillations.iter().filter(|one| self.boxes.iter().any(|bounds| holds(bounds, one))).count();
        for intersection in &balance.intersections {
            let existence = intersection.existence.as_ref();
            if !existence.is_some_and(|one| one.shown == Some(true) || one.reason.is_some()) {
                let (amplitude, omega) = (intersection.amplitude, intersection.omega_rad_s);
                self.contradictions.push(Contradiction::Silent { amplitude, omega });
            }
        }
    }

    /// Verdicts at intersections that stand for an oscillation: the nearest within a quarter of amplitude and frequency.
    fn stability(&mut self, balance: &Balance) {
        for intersection in &balance.intersections {
            let distance = |one: &&Oscillation| {
                (one.amplitude / intersection.amplitude - 1.0)
                    .abs()
                    .max((one.omega_rad_s / intersection.omega_rad_s - 1.0).abs())
            };
            let nearest = self.truth.oscillations.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let Some(one) = nearest.filter(|one| distance(one) < 0.25) else { continue };
            if let (Some(listed), Some(attracting)) = (intersection.stable, one.attracting)
                && listed != attracting
            {
                let by = intersection.stability_by.clone().unwrap_or_else(|| "nothing".to_owned());
                self.contradictions.push(Contradiction::Stability {
                    amplitude: intersection.amplitude,
                    listed,
                    by,
                    attracting,
                });
            }
        }
    }
}

fn holds(bounds: &Bounds, one: &Oscillation) -> bool {
    let (amplitude, omega, uncertainty) = one.best();
    bounds.holds(amplitude, omega, uncertainty)
}

/// The oscillation that harmonic balance finds from the middle of a box.
fn within(control_loop: &DescribingLoop, bounds: &Bounds) -> Option<Oscillation> {
    let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
    let (amplitude, omega) = (middle(bounds.amplitude), middle(bounds.omega_rad_s));
    let found = harmonic_balance::Balance::near(&control_loop.plant, &control_loop.characteristic, amplitude, omega)?;
    let near = (found.amplitude() / amplitude - 1.0).abs() < 0.01 && (found.omega / omega - 1.0).abs() < 0.01;
    near.then(|| oscillation(control_loop, &found))
}

/// The table in Markdown, and every contradiction with its loop.
#[must_use]
pub fn markdown(judgements: &[Judgement]) -> String {
    let mut text = String::from("# Describing-function loops, judged\n\n");
    text += "| loop | oscillations | held by a box | half-width | target | reasons | s |\n|---|---:|---:|---:|---:|---|---:|\n";
    for one in judgements {
        let widest = one.boxes.iter().map(Bounds::half_width).reduce(f64::max);
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.0e} | {} | {} |",
            one.truth.control_loop.name,
            one.truth.oscillations.len(),
            one.held,
            widest.map_or_else(|| "-".to_owned(), |width| format!("{width:.1e}")),
            target(&one.truth.control_loop),
            if one.reasons.is_empty() { "-".to_owned() } else { one.reasons.join(", ") },
            one.seconds.map_or_else(|| "-".to_owned(), |seconds| format!("{seconds:.2}")),
        );
    }
    let whole = |one: &&Judgement| one.held > 0 && one.held == one.truth.oscillations.len();
    let wrong = |what: fn(&Contradiction) -> bool| {
        judgements.iter().flat_map(|one| &one.contradictions).filter(|one| what(one)).count()
    };
    let _ = writeln!(
        text,
        "\n{} loops, {} answered; all oscillations held in {}, some in {}. Boxes: {}; without an oscillation: {}; wider than asked: {}. \
         Verdicts on stability that are wrong: {}. Intersections with neither a box nor a reason: {}.\n",
        judgements.len(),
        judgements.iter().filter(|one| one.answered).count(),
        judgements.iter().filter(whole).count(),
        judgements.iter().filter(|one| one.held > 0).count(),
        judgements.iter().map(|one| one.boxes.len()).sum::<usize>(),
        wrong(|one| matches!(one, Contradiction::Empty { .. })),
        wrong(|one| matches!(one, Contradiction::Wide { .. })),
        wrong(|one| matches!(one, Contradiction::Stability { .. })),
        wrong(|one| matches!(one, Contradiction::Silent { .. })),
    );
    for one in judgements {
        for contradiction in &one.contradictions {
            let _ = writeln!(text, "- {}: {contradiction}", one.truth.control_loop.name);
        }
    }
    text
}

/// What is true of each loop, in Markdown.
#[must_use]
pub fn truths(truths: &[Truth]) -> String {
    let mut text = String::from(
        "| loop | amplitude | omega, rad/s | third harmonic, % | methods differ by | attracting | multiplier |\n|---|---:|---:|---:|---:|---|---:|\n",
    );
    for Truth { control_loop, oscillations } in truths {
        for one in oscillations {
            let (amplitude, omega, _) = one.best();
            let _ = writeln!(
                text,
                "| {} | {amplitude:.13} | {omega:.13} | {:.1} | {} | {} | {} |",
                control_loop.name,
                100.0 * one.third,
                one.disagreement().map_or_else(|| "one method".to_owned(), |off| format!("{off:.1e}")),
                one.attracting.map_or("?", |yes| if yes { "yes" } else { "no" }),
                one.multiplier.map_or_else(|| "-".to_owned(), |multiplier| format!("{multiplier:.4}")),
            );
        }
    }
    text
}
