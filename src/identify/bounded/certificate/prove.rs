//! Finding the steps, once it is known what is left.

use super::super::contract::{Linear, Origin};
use super::super::lp::{Multipliers, Outcome, Programme};
use super::super::search::{Search, UNBROKEN};
use super::super::setup::Setup;
use super::{By, Combination, Cut, Stage, Step, Unproved};
use crate::numeric::{Interval, Real};

/// What is left is given wider than it was found by the first of these shares, on either side, with which a proof is found: room for
/// other enclosures than those of the search, and fewer boxes.
const ROOMS: [f64; 4] = [0.1, 0.5, 2.0, 8.0];
/// A cut takes this share less than the multipliers give, for the same reason: over wide boxes and over narrow ones.
const CAUTION: [f64; 2] = [0.2, 0.1];
/// A contradiction is beyond doubt by this share of the errors that it weighs.
const BEYOND: f64 = 1e-5;
/// A cut that takes less than this of a range is left out.
const LEAST_CUT: f64 = 0.05;
/// Steps that leave more than this of every range did not help.
const HELPED: f64 = 0.8;
/// A box this much wider than what is left is cut where it sticks out.
const NEAR: f64 = 4.0;
/// Steps of a stage; while there is more room to try, fewer.
const MOST_STEPS: usize = 4000;
const TRIED_STEPS: usize = 300;

/// A box at hand, and how far it has been worked on.
#[derive(Clone)]
struct Open {
    at: Vec<Interval>,
    /// The hats help no more.
    weighed: bool,
    /// Speeds at the windows' beginnings are those that the readings tell.
    quickened: bool,
    /// Each window has been seen by itself.
    swept: bool,
}

/// What became of the box at hand.
enum Next {
    /// It is empty.
    Excluded,
    /// It is smaller.
    Smaller,
    /// It is to be divided.
    Divide([Vec<Interval>; 2], usize),
}

/// What a pass gave.
enum Found {
    Excluded(Combination),
    Cuts(Vec<Cut>),
}

struct Prover<'a> {
    search: Search<'a>,
    left: Option<Vec<Interval>>,
    room: f64,
    most_steps: usize,
    steps: Vec<Step>,
}

fn ends(at: &[Interval]) -> Vec<[f64; 2]> {
    at.iter().map(|side| [side.lower(), side.upper()]).collect()
}

impl Stage {
    /// The steps from the box of `setup` to what its search left, with some room around.
    ///
    /// # Errors
    /// [`Unproved::NotFound`] where they are too many.
    pub(super) fn prove(setup: &Setup, hull: Option<&[Interval]>) -> Result<Self, Unproved> {
        // Of what is empty there is nothing to widen.
        let rooms = if hull.is_some() { &ROOMS[..] } else { &ROOMS[..1] };
        let most = |index: usize| if index + 1 < rooms.len() { TRIED_STEPS } else { MOST_STEPS };
        let mut tries =
            rooms.iter().enumerate().map(|(index, room)| Self::prove_within(setup, hull, *room, most(index)));
        tries.find(Result::is_ok).unwrap_or(Err(Unproved::NotFound { steps: MOST_STEPS }))
    }

    fn prove_within(setup: &Setup, hull: Option<&[Interval]>, room: f64, most_steps: usize) -> Result<Self, Unproved> {
        let parameters = setup.layout.parameters();
        let left = hull.map(|hull| {
            let wider = |(side, from): (&Interval, &Interval)| {
                let room = room * side.width() + f64::EPSILON * side.magnitude();
                side.inflate(room).intersection(*from).unwrap_or(*side)
            };
            hull.iter().zip(&setup.search).take(parameters).map(wider).collect::<Vec<_>>()
        });
        let mut prover = Prover { search: Search::new(setup), left, room, most_steps, steps: Vec::new() };
        prover.go()?;
        let layout = &setup.layout;
        Ok(Self {
            delay_s: layout.delay().is_none().then(|| setup.known_delay_s.midpoint()),
            windows: layout.windows().iter().map(|window| [window.record, window.first, window.last]).collect(),
            from: ends(&setup.search[..parameters]),
            left: prover.left.as_deref().map(ends),
            steps: prover.steps,
        })
    }
}

impl Prover<'_> {
    fn go(&mut self) -> Result<(), Unproved> {
        let mut open =
            vec![Open { at: self.search.setup.search.clone(), weighed: false, quickened: false, swept: false }];
        while let Some(mut here) = open.pop() {
            loop {
                if self.kept(&here.at) {
                    self.steps.push(Step::Keep);
                    break;
                }
                if self.steps.len() > self.most_steps {
                    return Err(Unproved::NotFound { steps: self.most_steps });
                }
                match self.step(&mut here)? {
                    Next::Excluded => break,
                    Next::Smaller => {}
                    Next::Divide([low, high], unknown) => {
                        self.steps.push(Step::Divide { unknown, at: low[unknown].upper() });
                        open.push(Open { at: high, ..here.clone() });
                        here.at = low;
                    }
                }
            }
        }
        Ok(())
    }

    fn kept(&self, at: &[Interval]) -> bool {
        self.left.as_ref().is_some_and(|left| at.iter().zip(left).all(|(side, left)| side.is_subset_of(*left)))
    }

    fn step(&mut self, here: &mut Open) -> Result<Next, Unproved> {
        if !here.weighed
            && let Some(next) = self.weigh(here)
        {
            return Ok(next);
        }
        let (wide, widest) = self.search.too_wide(&here.at);
        if wide {
            // Parts of it may be weighed again.
            here.weighed = false;
            return self.halves(&here.at, widest);
        }
        if !here.quickened {
            here.quickened = true;
            if let Some(next) = self.quicken(here) {
                return Ok(next);
            }
        }
        self.follow(here)
    }

    /// By hats, while they help.
    fn weigh(&mut self, here: &mut Open) -> Option<Next> {
        let mut own = here.at.clone();
        let Some(mut linear) = self.search.weighed(&mut own) else {
            self.steps.push(Step::Exclude { by: By::Hats, rows: Vec::new() });
            return Some(Next::Excluded);
        };
        self.search.model.bound(&mut linear);
        let parameters: Vec<usize> = (0..self.search.setup.layout.parameters()).collect();
        let before = here.at.clone();
        let next = self.take(By::Hats, &linear, here, &parameters, &parameters);
        if next.is_some_and(|next| matches!(next, Next::Excluded)) {
            return Some(Next::Excluded);
        }
        if self.search.rest(&before, &here.at) < HELPED {
            return Some(Next::Smaller);
        }
        here.weighed = true;
        None
    }

    /// Speeds at the windows' beginnings, as the readings have them; `Some` where there are none.
    fn quicken(&mut self, here: &mut Open) -> Option<Next> {
        let mut own = here.at.clone();
        if self.search.weighed(&mut own).is_none() {
            self.steps.push(Step::Exclude { by: By::Hats, rows: Vec::new() });
            return Some(Next::Excluded);
        }
        let mut cuts = Vec::new();
        for (unknown, &known) in own.iter().enumerate().skip(self.search.setup.layout.parameters()) {
            let side = here.at[unknown];
            for (upper, end, other) in [(true, known.upper(), side.upper()), (false, known.lower(), side.lower())] {
                if end != other {
                    cuts.push(Cut { unknown, upper, end, rows: Vec::new() });
                }
            }
            here.at[unknown] = known;
        }
        if !cuts.is_empty() {
            self.steps.push(Step::Contract { by: By::Hats, cuts });
        }
        None
    }

    /// By the motion over whole records or, where the slopes' ranges are too wide for that, window by window.
    fn follow(&mut self, here: &mut Open) -> Result<Next, Unproved> {
        let centre = |at: &[Interval]| at.iter().map(|side| side.midpoint()).collect::<Vec<f64>>();
        let parameters: Vec<usize> = (0..self.search.setup.layout.parameters()).collect();
        let before = here.at.clone();
        let whole = self.search.unbroken(&here.at, centre(&here.at));
        let whole =
            whole.map(|linear| (self.search.slack(&linear), linear)).filter(|((slack, _), _)| *slack <= UNBROKEN);
        let (by, slack, linear) = match whole {
            Some((slack, linear)) => (By::Whole, slack, linear),
            None => {
                if !here.swept {
                    here.swept = true;
                    if let Some(next) = self.sweep(here) {
                        return Ok(next);
                    }
                }
                let chained = self.search.chained(&mut here.at.clone(), centre(&here.at));
                match chained {
                    Err(_) => {
                        self.steps.push(Step::Exclude { by: By::Chain, rows: Vec::new() });
                        return Ok(Next::Excluded);
                    }
                    Ok(None) => {
                        let (_, widest) = self.search.widest(&here.at);
                        return self.halves(&here.at, widest);
                    }
                    Ok(Some(linear)) => (By::Chain, self.search.slack(&linear), linear),
                }
            }
        };
        let next = if by == By::Whole {
            let whole = self.search.of_whole();
            self.take(by, &linear, here, &whole, &whole)
        } else {
            let all: Vec<usize> = (0..here.at.len()).collect();
            self.take(by, &linear, here, &all, &parameters)
        };
        match next {
            Some(next) if matches!(next, Next::Excluded) || self.search.rest(&before, &here.at) < HELPED => Ok(next),
            _ => self.divide(&here.at, slack.1),
        }
    }

    /// Each window by itself bounds the state at its beginning; `Some` where nothing is left.
    fn sweep(&mut self, here: &mut Open) -> Option<Next> {
        for window in 0..self.search.setup.layout.windows().len() {
            let centre = here.at.iter().map(|side| side.midpoint()).collect();
            let linear = self.search.model.alone(window, &here.at, centre)?;
            let layout = &self.search.setup.layout;
            let (_, places) = layout.columns(window);
            let own: Vec<usize> = (1..layout.state_size()).map(|component| layout.start(window, component)).collect();
            if let Some(Next::Excluded) = self.take(By::Window(window), &linear, here, &places, &own) {
                return Some(Next::Excluded);
            }
        }
        None
    }

    /// Notes what inequalities give of `unknowns`, and takes it off the box. `None` where they give nothing.
    fn take(&mut self, by: By, linear: &Linear, here: &mut Open, places: &[usize], unknowns: &[usize]) -> Option<Next> {
        match self.found(by, linear, &here.at, places, unknowns) {
            Found::Excluded(rows) => {
                self.steps.push(Step::Exclude { by, rows });
                Some(Next::Excluded)
            }
            Found::Cuts(cuts) if cuts.is_empty() => None,
            Found::Cuts(cuts) => {
                let empty = cuts.iter().any(|cut| !super::shorten(&mut here.at, cut));
                self.steps.push(Step::Contract { by, cuts });
                Some(if empty { Next::Excluded } else { Next::Smaller })
            }
        }
    }

    fn found(&self, by: By, linear: &Linear, at: &[Interval], places: &[usize], unknowns: &[usize]) -> Found {
        let programme = Programme::of(&linear.rows, &linear.deviations, places);
        let mut cuts: Vec<Cut> = Vec::new();
        for &unknown in unknowns {
            for upper in [true, false] {
                let sign = if upper { 1.0 } else { -1.0 };
                let (multipliers, nothing) = match programme.maximise(&[(unknown, sign)]) {
                    Outcome::Empty { multipliers } => (multipliers, true),
                    Outcome::Bounded { multipliers, .. } => (multipliers, false),
                };
                let objective: &[(usize, f64)] = if nothing { &[] } else { &[(unknown, sign)] };
                let bound = linear.rows.upper_bound(objective, &multipliers, &linear.deviations);
                if nothing {
                    if bound < -BEYOND * self.errors(by, linear, &multipliers) {
                        return Found::Excluded(named(linear, &multipliers));
                    }
                    continue;
                }
                let side = at[unknown];
                // Towards the end that may be taken off, zero is where the range has it now.
                let reached =
                    sign * (Interval::point(linear.centre[unknown]) + Interval::point(sign * bound)).midpoint();
                let (now, other) = if upper { (side.upper(), side.lower()) } else { (-side.lower(), -side.upper()) };
                let gained = now - reached;
                let face = self.left.as_ref().and_then(|left| left.get(unknown));
                let face = face.map(|face| if upper { face.upper() } else { -face.lower() });
                let wanted = face.is_some_and(|face| now > face) && gained > 0.1 * self.room * side.width();
                if !(gained > LEAST_CUT * side.width() || wanted) || !(gained > 0.0) {
                    continue;
                }
                // Over wide boxes enclosures differ by shares of the range, over narrow ones of what is gained.
                let caution = match by {
                    By::Hats => 0.0,
                    By::Window(_) | By::Chain => CAUTION[0] * gained + 0.2 * CAUTION[0] * side.width(),
                    By::Whole => CAUTION[1] * gained,
                };
                if caution >= gained {
                    continue;
                }
                let mut end = reached + caution;
                // Beyond what is left nothing is gained.
                if let Some(face) = face.filter(|face| *face < now && other <= *face) {
                    end = end.max(face);
                }
                let cut = Cut { unknown, upper, end: sign * end, rows: named(linear, &multipliers) };
                if end < other {
                    // Nothing is left: the other cuts are not needed.
                    return Found::Cuts(vec![cut]);
                }
                cuts.push(cut);
            }
        }
        Found::Cuts(cuts)
    }

    /// The errors that multipliers weigh; those of hats are not told apart.
    fn errors(&self, by: By, linear: &Linear, multipliers: &Multipliers) -> f64 {
        if by == By::Hats {
            return 0.0;
        }
        let of = |(row, y): &(usize, f64)| match linear.origins[*row] {
            Origin::Reading { window, .. } => {
                y * self.search.setup.records[self.search.setup.layout.windows()[window].record].error
            }
            _ => 0.0,
        };
        multipliers.iter().map(of).sum()
    }

    fn halves(&self, at: &[Interval], unknown: usize) -> Result<Next, Unproved> {
        // A range that cannot be divided leaves the widest of the others.
        let relative = |place: &usize| at[*place].width() / self.search.setup.search[*place].width();
        let mut others: Vec<usize> = (0..self.search.setup.layout.parameters()).collect();
        others.sort_by(|a, b| relative(b).total_cmp(&relative(a)));
        let parts = |place: usize| Some(Next::Divide(self.search.divide(at, place)?, place));
        core::iter::once(unknown).chain(others).find_map(parts).ok_or(Unproved::NotFound { steps: MOST_STEPS })
    }

    /// Where the box sticks out of what is left, there; else at the unknown whose range costs most.
    fn divide(&self, at: &[Interval], widest: usize) -> Result<Next, Unproved> {
        let near = |left: &Vec<Interval>| {
            let mut sides = at.iter().zip(left);
            sides.all(|(side, left)| side.width() <= NEAR * left.width() && side.intersection(*left).is_some())
        };
        let Some(left) = self.left.as_ref().filter(|left| near(left)) else { return self.halves(at, widest) };
        let mut furthest = (0.0, None);
        for (unknown, (side, left)) in at.iter().zip(left).enumerate() {
            let unit = left.width().max(f64::MIN_POSITIVE);
            for (out, value) in
                [(side.upper() - left.upper(), left.upper()), (left.lower() - side.lower(), left.lower())]
            {
                if out / unit > furthest.0 && side.lower() < value && value < side.upper() {
                    furthest = (out / unit, Some((unknown, value)));
                }
            }
        }
        let Some((unknown, value)) = furthest.1 else { return self.halves(at, widest) };
        let part = |half: Option<Interval>| {
            let mut part = at.to_vec();
            part[unknown] = half?;
            Some(part)
        };
        let [low, high] =
            [Interval::new(at[unknown].lower(), value), Interval::new(value, at[unknown].upper())].map(part);
        low.zip(high)
            .map(|(low, high)| Next::Divide([low, high], unknown))
            .ok_or(Unproved::NotFound { steps: MOST_STEPS })
    }
}

/// The multipliers by what the rows are.
fn named(linear: &Linear, multipliers: &Multipliers) -> Combination {
    multipliers.iter().filter(|(_, y)| *y > 0.0).map(|(row, y)| (linear.origins[*row], *y)).collect()
}
