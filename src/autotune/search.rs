//! The search over dead times and time constants: grids, and pattern searches from their best points.

use super::Family;
use super::projection::{ProjectionProblem, SearchPoint};

/// Starts: so many time constants, and so many dead times, on grids.
const TIME_CONSTANTS: u32 = 10;
const DEAD_TIMES: u32 = 12;
/// Variance of the load: what it gains in a period, over the variance of a reading's white error. Starts of the search.
pub(super) const WANDERING: &[f64] = &[1e-4, 1.0];
/// The same, at least: no reading shows less, and the load counts as constant.
pub(super) const CONSTANT: &[f64] = &[1e-6];
/// A time constant of so many durations of the record is an integrator.
const LONGEST: f64 = 20.0;
/// Starts that are followed to the processes of a record.
pub(super) const FOLLOWED: usize = 3;
/// Rounds of the search from one start.
const ROUNDS: u32 = 120;
/// The search ends where a step changes twice the log likelihood by less: a thirtieth of a standard deviation.
pub(super) const SETTLED: f64 = 1e-3;
/// A record without errors has no such end: then a step this small, relative to the time scale, ends the search.
const FINEST: f64 = 1e-6;

/// Times within which a structure is searched.
#[derive(Clone, Copy)]
pub(super) struct SearchScales {
    /// Time scale of the record: twice the mean time between changes.
    pub(super) scale_s: f64,
    /// Longest dead time.
    pub(super) longest_s: f64,
    /// Starts that are followed.
    pub(super) followed: usize,
    /// The load's variance: its starts, or its one value.
    pub(super) walks: &'static [f64],
}

impl SearchScales {
    /// A load that moves the output by as much as a white error in a period.
    fn walk(self, family: Family) -> f64 {
        self.scale_s.powi(if family.integrates() { -3 } else { -1 })
    }
}

/// The likeliest points.
fn few(
    problem: &ProjectionProblem,
    family: Family,
    followed: usize,
    points: impl IntoIterator<Item = SearchPoint>,
) -> Vec<SearchPoint> {
    let mut few: Vec<(f64, SearchPoint)> =
        points.into_iter().map(|point| (problem.variance(family, &point), point)).collect();
    few.sort_by(|a, b| a.0.total_cmp(&b.0));
    few.truncate(followed);
    few.into_iter().map(|(_, point)| point).collect()
}

/// Points on a grid of dead times and, where the structure has one time constant, of that.
fn grid(family: Family, scales: SearchScales) -> Vec<SearchPoint> {
    let lags: Vec<f64> = (0..TIME_CONSTANTS)
        .map(|k| 0.02 * scales.scale_s * libm::pow(500.0_f64, f64::from(k) / f64::from(TIME_CONSTANTS - 1)))
        .collect();
    let delays = (0..DEAD_TIMES).map(|k| scales.longest_s * (f64::from(k) / f64::from(DEAD_TIMES - 1)).powi(2));
    let times = delays.flat_map(|delay| match family {
        Family::Integrator => vec![vec![delay]],
        _ => lags.iter().map(|lag| vec![delay, *lag]).collect(),
    });
    let walks: Vec<f64> = scales.walks.iter().map(|walk| walk * scales.walk(family)).collect();
    times
        .flat_map(|times_s| {
            walks.iter().map(|walk| SearchPoint { times_s: times_s.clone(), walk: *walk }).collect::<Vec<_>>()
        })
        .collect()
}

/// Points with a second time constant about a point without it; the second lag stands for part of the dead time, or not.
fn with_second(point: &SearchPoint) -> impl Iterator<Item = SearchPoint> {
    let (delay, lag, walk) = (point.times_s[0], point.times_s[1], point.walk);
    [0.05, 0.2, 0.6].into_iter().flat_map(move |share| {
        let less = (delay - share * lag).max(0.0);
        let times = [vec![delay, lag, share * lag], vec![less, lag, share * lag], vec![delay, lag / share, lag]];
        times.map(|times_s| SearchPoint { times_s, walk })
    })
}

/// A pattern search from one start, which steps over the kinks where a delayed switching meets a reading.
fn descent(
    problem: &ProjectionProblem,
    family: Family,
    start: SearchPoint,
    scales: SearchScales,
) -> (f64, SearchPoint) {
    let interval_s = scales.scale_s / 400.0;
    let duration_s = problem.command.time_s().last().copied().unwrap_or(0.0);
    let count = (problem.output.len() - problem.first) as f64;
    let (mut least, mut point) = (problem.variance(family, &start), start);
    let times = point.times_s.len();
    let least_walk = CONSTANT[0] * scales.walk(family);
    // Steps of the dead time in s, of the time constants and of the load's variance relative.
    let wanders = usize::from(scales.walks.len() > 1);
    let mut step = [vec![scales.longest_s / 10.0], vec![0.5; times - 1], vec![2.0; wanders]].concat();
    let finest = |k: usize| FINEST * if k == 0 { interval_s } else { 1.0 };
    for _ in 0..ROUNDS {
        let mut settled = true;
        for k in 0..step.len() {
            let moved = |sign: f64| {
                let mut other = point.clone();
                if k == 0 {
                    other.times_s[0] = (other.times_s[0] + sign * step[0]).max(0.0)
                } else if k < times {
                    other.times_s[k] = (other.times_s[k] * libm::exp(sign * step[k])).min(LONGEST * duration_s)
                } else {
                    other.walk = (other.walk * libm::exp(sign * step[k])).max(least_walk);
                }
                // Dead time and time constants stand for each other: a longer lag takes from the dead time.
                let turned = (0 < k && k < times).then(|| {
                    let mut turned = other.clone();
                    turned.times_s[0] = (turned.times_s[0] - (other.times_s[k] - point.times_s[k])).max(0.0);
                    turned
                });
                core::iter::once(other).chain(turned)
            };
            let around: Vec<(f64, SearchPoint)> = [1.0, -1.0]
                .into_iter()
                .flat_map(moved)
                .map(|other| (problem.variance(family, &other), other))
                .collect();
            let worst = around.iter().map(|(other, _)| *other).fold(least, f64::max);
            let better = around.into_iter().filter(|(other, _)| *other < least).min_by(|a, b| a.0.total_cmp(&b.0));
            match better {
                Some(found) => {
                    // A narrow valley is followed in many small gains.
                    settled = false;
                    (least, point) = found;
                    step[k] *= 1.5;
                }
                None => {
                    // Twice the log likelihood falls by `count ln(worst/least)`.
                    settled &= worst - least < SETTLED * least / count || step[k] <= finest(k);
                    step[k] *= 0.4;
                }
            }
        }
        if settled {
            break;
        }
    }
    (least, point)
}

/// Ends of the searches, structure by structure, the best first.
#[derive(Default)]
pub(super) struct Searches(Vec<(Family, Vec<SearchPoint>)>);

impl Searches {
    fn ends(&self, family: Family) -> impl Iterator<Item = &SearchPoint> {
        self.0.iter().filter(move |found| found.0 == family).flat_map(|found| &found.1)
    }

    /// The searches of these structures on this problem, from a grid and from the ends of the pass before.
    pub(super) fn pass(&self, problem: &ProjectionProblem, families: &[Family], scales: SearchScales) -> Self {
        let mut found = Self::default();
        for &family in families {
            let before = self.ends(family).cloned();
            // Structures nest: those with two different time constants begin about the ends of those with one.
            let starts = if matches!(family, Family::SecondOrder | Family::SecondOrderZero) {
                let one = [Family::FirstOrder, Family::EqualLags].into_iter().flat_map(|one| found.ends(one));
                few(problem, family, scales.followed, one.flat_map(with_second).chain(before))
            } else {
                few(problem, family, scales.followed, grid(family, scales).into_iter().chain(before))
            };
            let mut ends: Vec<(f64, SearchPoint)> =
                starts.into_iter().map(|start| descent(problem, family, start, scales)).collect();
            ends.sort_by(|a, b| a.0.total_cmp(&b.0));
            found.0.push((family, ends.into_iter().map(|(_, point)| point).collect()));
        }
        found
    }

    /// Each structure with its best point.
    pub(super) fn best(&self) -> impl Iterator<Item = (Family, &SearchPoint)> {
        self.0.iter().filter_map(|(family, ends)| Some((*family, ends.first()?)))
    }
}

/// Structures with one time constant at most, and then those that begin at their ends.
pub(super) const ONE: [Family; 4] = [Family::FirstOrder, Family::EqualLags, Family::Integrator, Family::IntegratorLag];
pub(super) const TWO: [Family; 2] = [Family::SecondOrder, Family::SecondOrderZero];
