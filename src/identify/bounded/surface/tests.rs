use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::search::Search;
use super::super::setup::Setup;
use super::super::tests::{ALPHA, BETA, DELTA, record};
use super::super::{BoundedModel, DelayBound};
use super::*;
use crate::identify::DragLaw;
use crate::numeric::Real;

/// A model with its parameters, every one in the middle of a box.
struct Case {
    model: BoundedModel,
    middles: Vec<f64>,
}

fn case(law: DragLaw, drags: &[f64], extend: impl Fn(BoundedModel) -> BoundedModel) -> Case {
    let model = extend(BoundedModel { quantum: Some(0.02), ..BoundedModel::new(law, DelayBound::KnownS(0.0)) });
    let middles = [1.0 / ALPHA].iter().chain(drags).chain(&[DELTA / ALPHA]).copied().collect();
    Case { model, middles }
}

fn cases() -> Vec<Case> {
    let rate = BETA / ALPHA;
    vec![
        case(DragLaw::Linear, &[rate], |model| model),
        case(DragLaw::Mixed, &[rate, 0.4 * rate], |model| model),
        case(DragLaw::Linear, &[rate, 0.2 * rate], |model| BoundedModel { cubic: true, ..model }),
        case(DragLaw::Quadratic, &[rate, 0.1], |model| BoundedModel { stiffness: true, ..model }),
        case(DragLaw::Mixed, &[rate, 0.4 * rate, 4.0], |model| BoundedModel { lag: true, ..model }),
        case(DragLaw::Linear, &[rate, 0.05], |model| BoundedModel { delay: DelayBound::WithinS([0.0, 0.3]), ..model }),
        case(DragLaw::Quadratic, &[rate, 0.05], |model| BoundedModel {
            delay: DelayBound::WithinS([0.0, 0.3]),
            ..model
        }),
    ]
}

/// How often outputs at points of a part of the box are outside of what is known there.
fn missed(search: &Search<'_>, surface: &Surface, frame: &Frame, z: &[Interval], random: &mut Pcg64Mcg) -> usize {
    let (linear, _) = surface.over(z, &frame.centre, false);
    let span = search.model.whole()[0];
    let readings = &search.model.records[0];
    let error = Interval::point(readings.error);
    let mut missed = 0;
    for _ in 0..8 {
        let here: Vec<f64> = z
            .iter()
            .map(|side| side.lower() + side.width() * if random.random_bool(0.5) { 0.999 } else { 0.001 })
            .collect();
        let mut point = frame.centre.clone();
        for (row, place) in frame.places.iter().enumerate() {
            point[*place] += (0..=row).map(|column| frame.weight(row, column) * here[column]).sum::<f64>();
        }
        let Some(outputs) = search.model.outputs(span, &point) else { continue };
        let away: Vec<Interval> =
            z.iter().zip(&here).map(|(side, z)| Interval::point(*z) - Interval::point(side.midpoint())).collect();
        let unknowns: Vec<Interval> = away.iter().copied().chain(products(&surface.sheets[0].pairs, &away)).collect();
        let ranges = unknowns.iter().zip(&linear.deviations);
        missed += ranges.filter(|(own, range)| own.intersection(**range).is_none()).count();
        let off = |sample: usize| outputs[sample] - Interval::point(readings.value[sample + first(search)]);
        for (row, (slopes, origin)) in linear.rows.slopes.iter().zip(&linear.origins).enumerate() {
            let Origin::Reading { sample, above: true, .. } = origin else { continue };
            // Both rows together say where the output is.
            let [above, below] = [row, row + 1].map(|row| Interval::point(linear.rows.limits[row]));
            let residual = (error - above).hull(below - error);
            let way = slopes.iter().fold(residual, |sum, (unknown, slope)| sum + *slope * unknowns[*unknown]);
            missed += usize::from(way.inflate(1e-12).intersection(off(*sample - first(search))).is_none());
        }
    }
    missed
}

fn first(search: &Search<'_>) -> usize {
    search.setup.layout.windows()[0].first
}

/// A surface over a box of this relative half-width.
fn surface(search: &Search<'_>, middles: &[f64], width: f64) -> (Surface, Frame) {
    let layout = &search.setup.layout;
    let mut at = search.setup.search.clone();
    for (side, middle) in at.iter_mut().zip(middles) {
        *side = Interval::point(*middle).inflate(width * middle.abs());
    }
    at[layout.start(0, 0)] = Interval::point(0.1).inflate(width);
    at[layout.start(0, 1)] = Interval::point(0.2).inflate(width);
    if layout.lagged() {
        at[layout.start(0, 2)] = Interval::point(0.8).inflate(width);
    }
    let frame = Frame::straight(search.setup.layout.of_whole(), &at);
    let surface = search.model.surface(&at, &frame).expect("an enclosure");
    (surface, frame)
}

#[test]
fn outputs_are_where_the_surface_says_and_without_its_bends_they_are_not() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let record = record(150);
    for Case { model, middles } in cases() {
        let setup = Setup::new(&[&record], &model).expect("a problem");
        let search = Search::new(&setup);
        let (narrow, frame) = surface(&search, &middles, 0.02);
        let half = |z: &Interval| Interval::new(0.2 * z.upper(), 0.9 * z.upper()).expect("ordered");
        let half: Vec<Interval> = frame.z.iter().map(half).collect();
        for z in [&frame.z, &half] {
            assert_eq!(missed(&search, &narrow, &frame, z, &mut random), 0, "{model:?}");
        }
        let mut straight = narrow.clone();
        for off in straight.sheets.iter_mut().flat_map(|sheet| &mut sheet.readings) {
            off.bends.iter_mut().for_each(|bend| *bend = Interval::ZERO);
        }
        let count = missed(&search, &straight, &frame, &half, &mut random);
        assert!(count > 50, "without bends {count} were missed, {model:?}");
    }
}

/// What bends add at most to the sum of rows, of one reading that above and of the next that below: weighed against each other, and each
/// row's by itself. And what the rows of all readings leave in doubt besides.
fn bent(surface: &Surface, frame: &Frame) -> [f64; 3] {
    let (linear, _) = surface.over(&frame.z, &frame.centre, false);
    let mut sums = vec![Interval::ZERO; linear.deviations.len()];
    let mut apart = Interval::ZERO;
    for (slopes, origin) in linear.rows.slopes.iter().zip(&linear.origins) {
        if !matches!(origin, Origin::Reading { sample, above, .. } if *above == sample.is_multiple_of(2)) {
            continue;
        }
        for (unknown, slope) in slopes.iter().filter(|(unknown, _)| *unknown >= frame.z.len()) {
            sums[*unknown] += *slope;
            apart += *slope * linear.deviations[*unknown];
        }
    }
    let readings = surface.sheets.iter().flat_map(|sheet| &sheet.readings).zip(linear.rows.limits.chunks_exact(2));
    let besides = readings.map(|(off, limits)| limits[0] + limits[1] - 2.0 * off.error.midpoint()).sum();
    [Interval::dot(sums.into_iter().zip(linear.deviations)).upper(), apart.upper(), besides]
}

#[test]
fn what_bends_readings_alike_cancels_where_they_are_weighed_against_each_other() {
    let record = record(150);
    for Case { model, middles } in cases() {
        let setup = Setup::new(&[&record], &model).expect("a problem");
        let search = Search::new(&setup);
        let (wide, frame) = surface(&search, &middles, 0.002);
        let [together, apart, besides] = bent(&wide, &frame);
        assert!(together < 0.5 * apart && besides < apart, "{together}, {apart} and {besides}, {model:?}");
    }
}
