//! One record: what is assumed of it, what was found, and whether that is true.

use std::path::Path;

use clap::ValueEnum;
use cpu_time::ThreadTime;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use selfosc::experiment::Record;
use selfosc::identify::bounded::certificate::Certificate;
use selfosc::identify::bounded::{
    BoundedModel, Bounds, Consistency, DelayBound, Quantity, enclose, enclose_with_certificate,
};
use selfosc::identify::{DragLaw, IdentifyError};
use selfosc_simulator::kinds::Case;

/// Half the width of a 95 % interval in standard deviations.
const NORMAL_95: f64 = 1.96;

/// What the model is given beside the drags.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Terms {
    /// The law of the vehicle, and every term that it has
    Right,
    /// Mixed drag, and nothing besides
    Mixed,
}

/// What came of one case.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) found: Result<Bounds, IdentifyError>,
    /// True quantities that are not within the bounds.
    pub(crate) missed: Vec<Quantity>,
    /// Width of alpha's bounds over that of the nominal 95 % interval.
    pub(crate) ratio: Option<f64>,
    /// Half the width of alpha's bounds, over alpha.
    pub(crate) half_width: Option<f64>,
    /// On one core.
    pub(crate) seconds: f64,
    pub(crate) samples: usize,
    /// What came of its certificate.
    pub(crate) certified: Option<String>,
    /// Readings that were moved, and how many of them were found.
    pub(crate) glitches: usize,
    pub(crate) found_glitches: usize,
    /// Readings called outliers that were not moved.
    pub(crate) wronged: usize,
}

/// Readings moved by three to a hundred steps of the sensor, as many as asked for: record and sample of each.
fn glitch(case: &mut Case, glitches: usize) -> Vec<(usize, usize)> {
    let mut random = Pcg64Mcg::seed_from_u64(case.seed ^ 0x6c69_7463_6867);
    let mut moved = Vec::new();
    while moved.len() < glitches {
        let record = random.random_range(0..case.runs.len());
        let run = &mut case.runs[record];
        let sample = random.random_range(0..run.record.output.len());
        if !moved.contains(&(record, sample)) {
            let steps = 10f64.powf(random.random_range(0.5..2.0)).round();
            let sign = if random.random_bool(0.5) { 1.0 } else { -1.0 };
            run.record.output[sample] += sign * steps * run.scenario.sensor.quantum;
            moved.push((record, sample));
        }
    }
    moved
}

fn model(case: &Case, terms: Terms) -> BoundedModel {
    let truth = &case.truths[0];
    let delay = case.known.delay_s.map_or(DelayBound::Unknown, DelayBound::KnownS);
    if terms == Terms::Mixed {
        return BoundedModel::new(DragLaw::Mixed, delay);
    }
    let law = match (truth.beta != 0.0, truth.beta_quadratic != 0.0) {
        (true, true) => DragLaw::Mixed,
        (false, true) => DragLaw::Quadratic,
        _ => DragLaw::Linear,
    };
    BoundedModel {
        either_sign: truth.beta < 0.0,
        cubic: truth.beta_cubic != 0.0,
        stiffness: truth.stiffness != 0.0,
        lag: truth.lag_s.is_some_and(|lag_s| lag_s > 0.0),
        ..BoundedModel::new(law, delay)
    }
}

impl Outcome {
    pub(crate) fn of(
        case: &Case,
        terms: Terms,
        glitches: usize,
        certificates: Option<&Path>,
        change: impl Fn(&mut BoundedModel),
    ) -> Self {
        let mut case = case.clone();
        let moved = glitch(&mut case, glitches);
        let case = &case;
        let mut model = model(case, terms);
        // A user knows what the sensor shows.
        model.quantum = Some(case.runs[0].scenario.sensor.quantum);
        change(&mut model);
        let records: Result<Vec<Record>, _> = case
            .runs
            .iter()
            .map(|run| {
                let log = &run.record;
                Record::new(log.time_s.clone(), log.output.clone(), log.input.clone())
            })
            .collect();
        let samples = case.runs.iter().map(|run| run.record.time_s.len()).sum();
        let records = records.unwrap_or_else(|error| panic!("{} {}: {error}", case.kind.name, case.seed));
        let records: Vec<&Record> = records.iter().collect();
        let clock = ThreadTime::now();
        let found = enclose(&records, &model);
        let seconds = clock.elapsed().as_secs_f64();
        let certified = certificates
            .map(|folder| certified(&records, &model, seconds, &folder.join(format!("{}.json", case.seed))));
        let mut outcome = Self {
            found,
            missed: Vec::new(),
            ratio: None,
            half_width: None,
            seconds,
            samples,
            certified,
            glitches,
            found_glitches: 0,
            wronged: 0,
        };
        if let Ok(bounds) = &outcome.found {
            let right = bounds.outliers.iter().filter(|place| moved.contains(&(place.record, place.sample))).count();
            outcome.found_glitches = right;
            outcome.wronged = bounds.outliers.len() - right;
        }
        if let Ok(bounds) = &outcome.found
            && bounds.verdict != Consistency::Refuted
        {
            outcome.missed = missed(bounds, case);
            if let Some([low, high]) = bounds.of(Quantity::Alpha) {
                let alpha = case.truths[0].alpha;
                outcome.half_width = Some(0.5 * (high - low) / alpha);
                outcome.ratio = case.reference_std_alpha().map(|std| 0.5 * (high - low) / (NORMAL_95 * std));
            }
        }
        outcome
    }

    /// How far the ends of alpha's bounds are apart from another's, over their width.
    pub(crate) fn apart(&self, other: &Self) -> Option<f64> {
        let alpha = |outcome: &Self| outcome.found.as_ref().ok()?.of(Quantity::Alpha);
        let ([low, high], other) = (alpha(self)?, alpha(other)?);
        Some((low - other[0]).abs().max((high - other[1]).abs()) / (high - low))
    }

    pub(crate) fn verdict(&self) -> Option<Consistency> {
        self.found.as_ref().ok().map(|bounds| bounds.verdict)
    }
}

fn missed(bounds: &Bounds, case: &Case) -> Vec<Quantity> {
    let truth = &case.truths[0];
    let mut truths = vec![
        (Quantity::Alpha, truth.alpha),
        (Quantity::Beta, truth.beta),
        (Quantity::BetaQuadratic, truth.beta_quadratic),
        (Quantity::BetaCubic, truth.beta_cubic),
        (Quantity::Stiffness, truth.stiffness),
        (Quantity::DelayS, truth.delay_s),
    ];
    truths.extend(truth.lag_s.map(|lag_s| (Quantity::LagS, lag_s)));
    truths.extend(
        case.truths.iter().enumerate().filter_map(|(index, truth)| Some((Quantity::Delta(index), truth.delta?))),
    );
    let inside = |(quantity, value): &(Quantity, f64)| {
        bounds.of(*quantity).is_none_or(|[low, high]| (low..=high).contains(value))
    };
    truths.into_iter().filter(|truth| !inside(truth)).map(|(quantity, _)| quantity).collect()
}

/// The certificate of a case, written, read and checked: what that costs against the search.
fn certified(records: &[&Record], model: &BoundedModel, searched_s: f64, path: &Path) -> String {
    let clock = ThreadTime::now();
    let certificate = match enclose_with_certificate(records, model) {
        Ok((_, Ok(certificate))) => certificate,
        Ok((_, Err(error))) => return format!("no certificate: {error}"),
        Err(error) => return format!("no certificate: {error}"),
    };
    let proved_s = clock.elapsed().as_secs_f64() - searched_s;
    let text = certificate.to_string();
    let clock = ThreadTime::now();
    let shown = Certificate::read(&text).and_then(|certificate| certificate.check());
    let checked_s = clock.elapsed().as_secs_f64();
    let written =
        std::fs::write(path, &text).map_or_else(|error| format!(", not written: {error}"), |()| String::new());
    match shown {
        Ok(shown) => format!(
            "accepted: {} enclosures, {} excluded, {} kB, proof {proved_s:.2} s, check {checked_s:.3} s, {:.3} of the search{written}",
            shown.enclosures,
            shown.excluded,
            text.len() / 1000,
            checked_s / searched_s
        ),
        Err(error) => format!("NOT ACCEPTED: {error}{written}"),
    }
}

impl core::fmt::Display for Outcome {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let bounds = match &self.found {
            Ok(bounds) => bounds,
            Err(error) => return write!(f, "error: {error}"),
        };
        write!(f, "{}", bounds.verdict.name())?;
        if !self.missed.is_empty() {
            write!(f, ", MISSED {:?}", self.missed)?;
        }
        if let Some(half_width) = self.half_width {
            write!(f, ", alpha +-{:.4} %", 100.0 * half_width)?;
        }
        if let Some(ratio) = self.ratio {
            write!(f, ", ratio {ratio:.2}")?;
        }
        let [least, most] = bounds.error_factor;
        let most = if most < f64::MAX { format!("{most:.3}") } else { "-".to_owned() };
        write!(
            f,
            ", error x [{least:.3}, {most}], {} passes, {} samples, {:.2} s",
            bounds.passes, self.samples, self.seconds
        )?;
        if self.glitches > 0 || self.wronged > 0 {
            write!(f, "; of {} outliers {} found, {} WRONGED", self.glitches, self.found_glitches, self.wronged)?;
        }
        self.certified.iter().try_for_each(|certified| write!(f, "; certificate {certified}"))
    }
}
