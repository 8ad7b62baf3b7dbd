//! Single parameters: the one with the least largest misfit, and ones near the ends of the bounds.

use super::contract::Linear;
use super::lp::Outcome;
use super::search::Search;
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// Steps towards the least largest misfit.
const MOST_STEPS: usize = 16;

/// A step that gains less than this share of a parameter's width is the last.
const REACHED: f64 = 0.002;

/// How far within what readings allow a far witness is sought, of what the nearest leaves: room for what is not linear.
const INSIDE: f64 = 0.01;

/// Largest errors by which a window's beginning may miss its reading, where no parameter meets the record.
const FAR: f64 = 30.0;

/// Misfits up to which a better parameter is looked for, one after the other, beyond what readings allow.
const MISFITS: [f64; 3] = [1.0, 30.0, 1000.0];

/// A step that gains less than this share of the misfit is the last.
const LEAST_GAIN: f64 = 1e-4;

/// A parameter with its misfit.
#[derive(Clone, Debug)]
pub(super) struct Tried {
    /// All unknowns; of the windows' states those of each record's first count.
    pub(super) at: Vec<f64>,
    /// Upper bound of the largest misfit of a reading over its largest error.
    pub(super) misfit: f64,
}

/// Where the unknowns at these places make the misfit least; `None` where no misfit will do.
fn least(linear: &mut Linear, misfit: usize, places: &[usize]) -> Option<Vec<f64>> {
    MISFITS.into_iter().find_map(|most| {
        linear.deviations[misfit] = Interval::new(-1.0, most)?;
        match linear.programme(places).maximise(&[(misfit, -1.0)]) {
            Outcome::Bounded { at, .. } => Some(at),
            Outcome::Empty { .. } => None,
        }
    })
}

impl Search<'_> {
    /// The largest misfit of one parameter over the whole records. `None` where its motion cannot be enclosed.
    pub(super) fn misfit(&mut self, at: &[f64]) -> Option<f64> {
        self.count_pass();
        let spans = self.model.whole().into_iter();
        spans.map(|span| self.model.misfit(span, at)).try_fold(0.0, |largest: f64, misfit| Some(largest.max(misfit?)))
    }

    /// The rows with the misfit as one more unknown, and its number.
    pub(super) fn with_misfit(&self, linear: &Linear) -> (Linear, usize) {
        let mut linear = linear.clone();
        let misfit = linear.deviations.len();
        let errors: Vec<f64> = self.setup.records.iter().map(|readings| readings.error).collect();
        for (slopes, origin) in linear.rows.slopes.iter_mut().zip(&linear.origins) {
            if let super::contract::Origin::Reading { window, .. } = origin {
                let record = self.setup.layout.windows()[*window].record;
                slopes.push((misfit, Interval::point(-errors[record])));
            }
        }
        // One is what the readings allow; this is how much more.
        linear.deviations.push(Interval::ZERO);
        linear.centre.push(0.0);
        (linear, misfit)
    }

    /// A parameter with a small largest misfit, from the middle of a box and within another: by whole records where these lead to a
    /// witness, else by their windows.
    pub(super) fn nearest(&mut self, from: &[Interval], within: &[Interval]) -> Option<Tried> {
        let unbroken = self.nearest_unbroken(from, within).filter(|tried| tried.misfit <= 1.0);
        unbroken.or_else(|| self.nearest_by_windows(from, within))
    }

    /// By linear programmes about one parameter after another, while the misfit becomes smaller.
    fn nearest_unbroken(&mut self, from: &[Interval], within: &[Interval]) -> Option<Tried> {
        let places = self.setup.layout.of_whole();
        let mut centre: Vec<f64> = from.iter().map(|side| side.midpoint()).collect();
        let mut best: Option<Tried> = None;
        for _ in 0..MOST_STEPS {
            let Some((linear, misfit, _)) = self.about_point(&centre) else { break };
            let before = best.as_ref().map_or(f64::INFINITY, |best| best.misfit);
            if misfit < before {
                best = Some(Tried { at: centre.clone(), misfit });
            }
            if before - misfit < LEAST_GAIN * misfit {
                break;
            }
            let (mut linear, excess) = self.with_misfit(&linear);
            for place in &places {
                linear.deviations[*place] = within[*place] - Interval::point(centre[*place]);
            }
            let all: Vec<usize> = places.iter().copied().chain([excess]).collect();
            let Some(step) = least(&mut linear, excess, &all) else { break };
            for (place, step) in places.iter().zip(&step) {
                centre[*place] += step;
            }
        }
        best
    }

    /// The same with a state for every window, each step no further from the one before than the box `from` is wide.
    fn nearest_by_windows(&mut self, from: &[Interval], within: &[Interval]) -> Option<Tried> {
        let mut centre: Vec<f64> = from.iter().map(|side| side.midpoint()).collect();
        let mut best: Option<Tried> = None;
        // How far from the centre is searched, against the box.
        let mut trust = 1.0;
        for _ in 0..MOST_STEPS {
            let point: Vec<Interval> = centre.iter().map(|value| Interval::point(*value)).collect();
            let Some(linear) = self.at_point(&point) else { break };
            let (mut linear, misfit) = self.with_misfit(&linear);
            for (place, (side, from)) in within.iter().zip(from).enumerate() {
                let width = trust * from.width();
                let middle = Interval::point(centre[place]);
                let room = (middle + Interval::symmetric(width)).intersection(*side).unwrap_or(middle);
                linear.deviations[place] = room - middle;
            }
            let places: Vec<usize> = (0..=misfit).collect();
            let Some(solution) = least(&mut linear, misfit, &places) else { break };
            let next: Vec<f64> = centre.iter().zip(&solution).map(|(centre, step)| centre + step).collect();
            let reached = self.misfit(&next);
            let improved = reached.is_some_and(|reached| best.as_ref().is_none_or(|best| reached < best.misfit));
            if let (Some(misfit), true) = (reached, improved) {
                let small = best.as_ref().is_some_and(|best| best.misfit - misfit < LEAST_GAIN * misfit);
                best = Some(Tried { at: next.clone(), misfit });
                centre = next;
                if small {
                    break;
                }
            } else {
                trust *= 0.25;
            }
        }
        best
    }

    /// A box with room for a parameter that meets no reading of the record, but comes near.
    pub(super) fn loosened(&self, at: &[Interval]) -> Vec<Interval> {
        let layout = &self.setup.layout;
        let mut loose: Vec<Interval> = at.iter().map(|side| *side + Interval::symmetric(side.width())).collect();
        for (index, window) in layout.windows().iter().enumerate() {
            let room = FAR * self.setup.records[window.record].error;
            let (position, velocity) = (layout.start(index, 0), layout.start(index, 1));
            loose[position] = at[position] + Interval::symmetric(room);
            loose[velocity] = at[velocity] + Interval::symmetric(room / self.setup.swing_s + at[velocity].width());
        }
        for (loose, widest) in loose.iter_mut().zip(&self.setup.search).take(layout.parameters()) {
            *loose = loose.intersection(*widest).unwrap_or(*widest);
        }
        loose
    }

    /// The inequalities at a point.
    fn at_point(&mut self, point: &[Interval]) -> Option<Linear> {
        let centre: Vec<f64> = point.iter().map(|side| side.midpoint()).collect();
        self.count_pass();
        let layout = &self.setup.layout;
        let windows = layout.windows();
        let mut linear = self.model.about(point, centre);
        for index in 0..windows.len() {
            let span = super::contract::Span { from: index, to: index + 1 };
            let motion = self.model.motion(span, point, &linear.centre)?;
            let linked = windows.get(index + 1).is_some_and(|next| next.record == windows[index].record);
            self.model.linearise(span, &motion, linked, &mut linear);
        }
        self.model.bound(&mut linear);
        Some(linear)
    }

    /// The inequalities of whole records about a point, the largest misfit there, and how wide its motion's enclosure is; both in
    /// largest errors.
    fn about_point(&mut self, centre: &[f64]) -> Option<(Linear, f64, f64)> {
        self.count_pass();
        let point: Vec<Interval> = centre.iter().map(|value| Interval::point(*value)).collect();
        let mut linear = self.model.about(&point, centre.to_vec());
        let (mut largest, mut widest) = (0.0f64, 0.0f64);
        for span in self.model.whole() {
            let motion = self.model.motion(span, &point, centre)?;
            let stretch = self.setup.layout.windows()[span.from];
            let readings = &self.setup.records[stretch.record];
            let error = Interval::point(readings.error);
            for (node, reading) in motion.iter().zip(&readings.value[stretch.first..]) {
                if readings.jitter_s <= 0.0 {
                    let misfit = (node.at[0] - Interval::point(*reading)).abs() / error;
                    largest = largest.max(misfit.upper());
                }
                widest = widest.max(node.at[0].width() / readings.error);
            }
            let rows = linear.origins.len();
            self.model.linearise(span, &motion, false, &mut linear);
            if readings.jitter_s > 0.0 {
                largest = largest.max(self.model.misfit(span, centre)?);
                // That grants nothing to what is beyond the motion's ends, for which the rows grant the fastest speed.
                let stray = readings.jitter_s * self.model.fastest;
                let last = linear.rows.limits.len() - 1;
                [rows, rows + 1, last - 1, last].into_iter().for_each(|row| linear.rows.limits[row] -= stray);
            }
        }
        self.model.bound(&mut linear);
        Some((linear, largest, widest))
    }

    /// The witness with `unknown` furthest up (or, `sign` negative, down) that linear programmes, one after another from a
    /// witness, find in a box.
    pub(super) fn furthest(&mut self, from: &Tried, within: &[Interval], unknown: usize, sign: f64) -> Option<Tried> {
        let places = self.setup.layout.of_whole();
        let inside = INSIDE * (1.0 - from.misfit);
        let mut centre = from.at.clone();
        let mut best: Option<Tried> = None;
        for _ in 0..MOST_STEPS {
            let Some((linear, misfit, doubt)) = self.about_point(&centre) else { break };
            if misfit <= 1.0 {
                let gained = best.as_ref().map_or(f64::INFINITY, |best| sign * (centre[unknown] - best.at[unknown]));
                if gained > 0.0 {
                    best = Some(Tried { at: centre.clone(), misfit });
                }
                if gained < REACHED * within[unknown].width() {
                    break;
                }
            }
            let (mut linear, tightened) = self.with_misfit(&linear);
            for place in &places {
                linear.deviations[*place] = within[*place] - Interval::point(centre[*place]);
            }
            linear.deviations[tightened] = Interval::point(-(inside + doubt));
            let all: Vec<usize> = places.iter().copied().chain([tightened]).collect();
            let programme = linear.programme(&all);
            let Outcome::Bounded { at: step, .. } = programme.maximise(&[(unknown, sign)]) else { break };
            for (place, step) in places.iter().zip(&step) {
                centre[*place] += step;
            }
        }
        best
    }
}
