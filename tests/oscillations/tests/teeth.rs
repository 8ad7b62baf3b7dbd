//! A right listing passes the judge; each false variant of it is caught.

use selfosc_oscillations::relay::answer::{Line, Listing, Multiplier};
use selfosc_oscillations::relay::draw::draw;
use selfosc_oscillations::relay::judge::{Contradiction, judge, own_listing};

fn line(seed: u64) -> Line {
    Line { seed, control_loop: draw(seed), seconds: None, answer: None, refused: None }
}

fn contradictions(seed: u64, listing: &Listing) -> Vec<Contradiction> {
    let judgement = judge(&Line { answer: Some(serde_json::to_value(listing).unwrap()), ..line(seed) }, true);
    assert_eq!(judgement.counts.faults, 0);
    judgement.contradictions
}

/// A lag with dead time: one attracting orbit and three repelling ones in the range of the search.
const SEED: u64 = 28;

fn right() -> Listing {
    let listing = own_listing(&line(SEED));
    assert_eq!(
        listing.orbits.iter().map(|orbit| orbit.attracting).collect::<Vec<_>>(),
        [Some(true), Some(false), Some(false), Some(false)]
    );
    listing
}

/// The single contradiction of a changed listing.
fn caught(change: impl Fn(&mut Listing)) -> Contradiction {
    let mut listing = right();
    change(&mut listing);
    let mut found = contradictions(SEED, &listing);
    assert_eq!(found.len(), 1, "{found:?}");
    found.remove(0)
}

#[test]
fn right_listings_pass() {
    for seed in [0, 1, 12, 15, 18, 24, 25, SEED, 37] {
        let listing = own_listing(&line(seed));
        assert_eq!(contradictions(seed, &listing), [], "seed {seed}");
    }
}

#[test]
fn wrong_numbers_are_caught() {
    let mut moved = right();
    moved.orbits[0].time_high_s *= 1.0 + 1e-8;
    // What is listed does not exist, and what exists is not listed.
    let found = contradictions(SEED, &moved);
    assert!(
        matches!(found.as_slice(), [Contradiction::Absent { .. }, Contradiction::Missing { starts: 30, .. }]),
        "{found:?}"
    );
    for (name, change) in [
        ("period_s", (|listing| listing.orbits[0].period_s += 1e-8) as fn(&mut Listing)),
        ("amplitude", |listing| *listing.orbits[0].amplitude.as_mut().unwrap() *= 1.0 + 1e-8),
        ("bias", |listing| *listing.orbits[0].bias.as_mut().unwrap() += 1e-8),
        ("largest multiplier", |listing| listing.orbits[1].multipliers = vec![Multiplier::Real(-1.5315)]),
    ] {
        let found = caught(change);
        assert!(matches!(&found, Contradiction::Value { field, .. } if *field == name), "{found}");
    }
    let found = caught(|listing| {
        let time = listing.orbits[0].time_low_s;
        listing.orbits[0].enclosure =
            serde_json::from_value(serde_json::json!({ "time_low_s": [time - 1e-9, time - 1e-12] })).ok();
    });
    assert!(matches!(found, Contradiction::Enclosure { field: "time_low_s", .. }), "{found}");
}

#[test]
fn wrong_verdicts_are_caught() {
    for (index, verdict) in [(0, false), (1, true), (3, true)] {
        let found = caught(|listing| listing.orbits[index].attracting = Some(verdict));
        assert!(matches!(found, Contradiction::Verdict { listed, .. } if listed == verdict), "{found}");
    }
}

#[test]
fn invented_missing_and_repeated_orbits_are_caught() {
    let invented = caught(|listing| {
        let mut orbit = listing.orbits[0].clone();
        orbit.time_high_s *= 25.0;
        orbit.time_low_s *= 25.0;
        listing.orbits.push(orbit);
    });
    assert!(matches!(invented, Contradiction::Absent { .. }), "{invented}");
    let twice = caught(|listing| listing.orbits.push(listing.orbits[1].clone()));
    assert!(matches!(twice, Contradiction::Twice { .. }), "{twice}");
    let stable = caught(|listing| drop(listing.orbits.remove(0)));
    assert!(matches!(stable, Contradiction::Missing { starts: 30, attracting: Some(true), .. }), "{stable}");
    let unstable = caught(|listing| drop(listing.orbits.remove(2)));
    assert!(matches!(unstable, Contradiction::Missing { starts: 0, attracting: Some(false), .. }), "{unstable}");
}

#[test]
fn what_is_not_claimed_is_no_contradiction() {
    let mut listing = right();
    let fastest = listing.orbits[2].period_s * 1.01;
    listing.orbits.truncate(2);
    listing.complete = Some(false);
    listing.not_covered = vec![[Some(0.0), Some(fastest)]];
    listing.orbits[1].attracting = None;
    assert_eq!(contradictions(SEED, &listing), []);
}

/// Solutions of the switching conditions at which the output has passed a threshold before: no orbits.
#[test]
fn solutions_of_the_equations_that_switch_too_early_are_caught() {
    use f256::f256;
    use selfosc_oscillations::plant::Plant;
    use selfosc_oscillations::relay::control_loop::RelayLoop;
    use selfosc_oscillations::relay::orbit::{Absent, Orbit};
    use selfosc_oscillations::relay::simulation::Simulator;

    // A resonance of damping 0.05: the output crosses zero several times in a long half-period.
    let plant = Plant::new(&[1.0], &[1.0, 0.1, 1.0], 0.2);
    let control_loop = RelayLoop { plant, high: 1.0, low: -1.0, half_width: 0.0, reference: 0.0 };
    let simulator = Simulator::<f256>::new(&control_loop);
    let mut early = 0;
    for half in 4..60 {
        let half = 0.5 * f64::from(half);
        if let Ok(orbit) = Orbit::near(&simulator, half, half) {
            early += usize::from(matches!(orbit.simulate(&simulator), Err(Absent::OtherSwitching { .. })));
        }
    }
    assert!(early >= 1, "{early}");
}
