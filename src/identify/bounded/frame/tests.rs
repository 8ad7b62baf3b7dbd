use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::*;

const PLACES: usize = 5;
const LED: usize = 3;

fn interval(random: &mut Pcg64Mcg, half: f64) -> Interval {
    let middle = random.random_range(-half..half);
    Interval::new(middle - half * random.random_range(0.1..1.0), middle + half * random.random_range(0.1..1.0))
        .expect("an interval")
}

/// A box in a frame of its own, and the box along the axes around it.
fn boxed(random: &mut Pcg64Mcg) -> (Vec<Interval>, Frame) {
    let z: Vec<Interval> = (0..PLACES).map(|_| interval(random, 0.1)).collect();
    let lower = (0..PLACES).map(|row| (0..row).map(|_| random.random_range(-3.0..3.0)).collect()).collect();
    let centre = (0..PLACES).map(|_| random.random_range(-1.0..1.0)).collect();
    let frame = Frame { places: (0..PLACES).collect(), centre, lower, z };
    let at = (0..PLACES).map(|row| Interval::point(frame.centre[row]) + dot(&frame.row(row), &frame.z)).collect();
    (at, frame)
}

/// A point of a box, given by its coordinates in a frame.
fn drawn(frame: &Frame, random: &mut Pcg64Mcg) -> Vec<f64> {
    let z: Vec<f64> = frame.z.iter().map(|z| random.random_range(z.lower()..z.upper())).collect();
    let value = |row: usize| (0..=row).map(|column| frame.weight(row, column) * z[column]).sum::<f64>();
    (0..PLACES).map(|row| frame.centre[row] + value(row)).collect()
}

#[test]
fn a_frame_that_is_led_by_boxes_holds_their_points_and_one_that_is_led_by_fewer_does_not() {
    let mut random = Pcg64Mcg::seed_from_u64(71);
    let mut missed = 0;
    for case in 0..60 {
        let boxes: Vec<(Vec<Interval>, Frame)> = (0..3).map(|_| boxed(&mut random)).collect();
        let states: Vec<Interval> = (0..PLACES).map(|_| interval(&mut random, 2.0)).collect();
        // One of them as if it had no frame.
        let with = |frames: usize, count: usize| {
            let boxes = boxes.iter().enumerate().take(count);
            let boxes = boxes.map(move |(index, (at, frame))| (&at[..], (index < frames).then_some(frame)));
            Frame::led_by(LED, boxes, (0..PLACES).collect(), &states)
        };
        let (all, fewer) = (with(2, 3).expect("a frame"), with(2, 2).expect("a frame"));
        assert!(with(0, 3).is_none());
        // No wider than it need be: in a frame of its own, a box is what it was.
        let own = with(1, 1).expect("a frame");
        for (z, before) in own.z.iter().zip(&boxes[0].1.z).take(LED) {
            assert!(z.width() < 1.0 + 1e-9 && (z.width() / before.width() - 1.0).abs() < 1e-9, "case {case}");
        }
        for (_, frame) in &boxes {
            let mut point = drawn(frame, &mut random);
            for (value, side) in point.iter_mut().zip(&states).skip(LED) {
                *value = random.random_range(side.lower()..side.upper());
            }
            let near = Frame { z: all.z.iter().map(|z| *z + Interval::symmetric(1e-9)).collect(), ..all.clone() };
            assert!(near.holds(&point, 0.0), "case {case}: {point:?}");
            missed += usize::from(!fewer.holds(&point, 0.0));
        }
    }
    assert!(missed > 30, "only {missed} points of the third box are missed without it");
}
