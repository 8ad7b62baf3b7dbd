//! A session in the pool, all simulated: from the thruster map to a tuned heading controller, with figures.
//!
//! `cargo run --release --example pool_session -- FOLDER`
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

use nalgebra::Vector6;
use selfosc::control::{Answer, ControlError, Controller, FeedForward, Structure, Tuning};
use selfosc::experiment::{Record, RelayState};
use selfosc::features::RecordFeatures;
use selfosc::identify::{Method, Settings};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::DragAxis;
use selfosc::report::{Figure, Mark, Panel, identification};
use selfosc::vehicle::{
    Allocation, Axis, BodyState, Compensation, DynamometerPoint, FittedSide, Simulation, ThrustSide, Thruster,
    ThrusterMap, VehicleError, pool_thrusters, pool_vehicle,
};

type Failure = Box<dyn std::error::Error>;

/// The vehicle's computer reads the compass and commands the thrusters this often.
const INTERVAL_S: f64 = 0.1;
const STEPS: usize = 10;
/// The compass reads whole degrees.
const QUANTUM_RAD: f64 = PI / 180.0;
/// Largest moment that is asked for, N m.
const LARGEST_MOMENT: f64 = 0.15;
/// A moment by a tether that pulls, N m.
const TETHER: f64 = 0.004;
/// The step of the heading, and the bandwidth the pilot would like.
const STEP_RAD: f64 = FRAC_PI_2;
const WISH_RAD_S: f64 = 2.0;

/// Between readings of the dynamometer.
const COMMAND_STEP: f64 = 2.5;

/// What the session comes to.
#[derive(Clone, Copy, Debug)]
pub struct Session {
    /// Identified inertia over that of the vehicle.
    pub alpha_ratio: f64,
    /// The heading step with guessed gains.
    pub before: Answer,
    /// The same with gains from the identified axis.
    pub after: Answer,
}

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).ok_or("usage: pool_session FOLDER")?;
    run(Path::new(&folder)).map(drop)
}

/// The session; its figures go to `folder`.
pub fn run(folder: &Path) -> Result<Session, Failure> {
    std::fs::create_dir_all(folder)?;
    let save = |figure: &Figure| -> Result<(), Failure> {
        let path = folder.join(format!("{}.svg", figure.name));
        std::fs::write(&path, figure.svg()?)?;
        println!("  figure {}", path.display());
        Ok(())
    };

    println!("1. On the dynamometer: thrust by command.");
    let points = dynamometer()?;
    let map = ThrusterMap::asymmetric(&points, 0.05)?;
    println!(
        "  ahead {:.3e} n^2 + {:.4} n, astern {:.3e} n^2 + {:.4} n",
        map.forward.quadratic, map.forward.linear, map.backward.quadratic, map.backward.linear
    );
    save(&thruster_figure(&points, &map))?;
    // Between the last command at which it stood and the first at which it turned nobody knows: taken for standing.
    let side = |fit: &FittedSide, measured: &ThrustSide<f64>| {
        ThrustSide::new(fit.quadratic, fit.linear, measured.dead_zone() + COMMAND_STEP, measured.limit())
    };
    let thruster = Thruster::asymmetric(
        side(&map.forward, map.thruster.forward())?,
        side(&map.backward, map.thruster.backward())?,
    );
    // Turning on the spot: a constant push against the dead zone would drive this vehicle ahead, where it does not
    // keep its heading.
    let chain = Compensation::new(Allocation::pair(0.08)?, [thruster; 2]);

    println!("2. In the pool: a relay in the heading loop.");
    let mut relay = RelayState::new(RelayHysteresis::new(0.08, 0.35, 0.0)?, true);
    let run = sail(&chain, &thruster, 60.0, |heading| relay.step(-heading))?;
    let record = Record::new(run.time_s.clone(), run.heading_rad.clone(), run.moment.clone())?;
    let features = RecordFeatures::of(&record)?.features;
    println!(
        "  {} cycles of {:.2} s, amplitude {:.1} degrees",
        features.cycles,
        features.period_s.mean,
        features.amplitude.mean.to_degrees()
    );

    println!("3. Identification from the whole record.");
    let settings = Settings { method: Method::Fit, ..Settings::default() };
    let found = selfosc::identify::Session::new(settings).record("pool", record).identify()?;
    let model = found.reported().ok_or("no model")?;
    let truth = pool_vehicle()?.axis(Axis::Yaw, &Vector6::zeros());
    println!(
        "  {} drag, {}; alpha {:.4} (truth {:.4}), beta {:.4} (truth {:.4}), beta_quadratic {:.4} (truth {:.4}), delay {:.3} s",
        model.drag.name(),
        model.trust.name(),
        model.alpha.value,
        truth.alpha,
        model.beta.value,
        truth.linear_drag,
        model.beta_quadratic.value,
        truth.quadratic_drag,
        model.mean_delay_s()
    );
    let sections = identification::document(&found).sections;
    let figure = sections.iter().flat_map(|section| &section.figures).next().ok_or("no figure of the record")?;
    save(figure)?;

    println!("4. A heading controller from it.");
    // The fit knows of the hold between samples; for the controller it is half an interval more of delay.
    let axis = DragAxis::mixed(model.alpha.value, model.beta.value, model.beta_quadratic.value)?
        .with_delay_s(model.mean_delay_s() + 0.5 * INTERVAL_S)?
        .with_disturbance(model.deltas[0].value)?;
    let tuning = match Tuning::new(&axis, Structure::Pd, WISH_RAD_S) {
        Err(refusal @ ControlError::TooFast { most_rad_s, .. }) => {
            println!("  {refusal}");
            Tuning::new(&axis, Structure::Pd, 0.8 * most_rad_s)?
        }
        other => other?,
    };
    let margins = tuning.margins();
    println!(
        "  bandwidth {:.2} rad/s, phase margin {:.0} degrees, delay margin {:.2} s",
        tuning.bandwidth_rad_s(),
        margins.phase_rad.to_degrees(),
        margins.delay_s
    );
    let along = FeedForward::new(&axis, tuning.double_pole_rad_s(), None)?;
    let tuned = ready(Controller::new(tuning.gains()))?.with_feed_forward(along);
    // Before: no drag and no delay known of, and twice the inertia for good measure.
    let guess = DragAxis::linear(2.0 * truth.alpha, 0.0)?;
    let guessed = ready(Controller::new(Tuning::new(&guess, Structure::Pd, WISH_RAD_S)?.gains()))?;

    println!("5. A step of the heading by {:.0} degrees.", STEP_RAD.to_degrees());
    let steps = [guessed, tuned].map(|mut controller| {
        sail(&chain, &thruster, 25.0, |heading| controller.step(STEP_RAD, heading, INTERVAL_S).command)
    });
    let [before, after] = steps;
    let (before, after) = (before?, after?);
    let answers = [("guessed", &before), ("tuned", &after)].map(|(name, run)| {
        let answer = Answer::of(&run.time_s, &run.true_heading_rad, 0.0, STEP_RAD);
        let seconds = |time: Option<f64>| time.map_or("not reached".to_owned(), |time| format!("{time:.1} s"));
        println!(
            "  {name:8} rise {}, overshoot {:.0} %, settling {}",
            seconds(answer.rise_s),
            answer.overshoot_percent,
            seconds(answer.settling_s)
        );
        answer
    });
    save(&step_figure(&before, &after))?;
    Ok(Session { alpha_ratio: model.alpha.value / truth.alpha, before: answers[0], after: answers[1] })
}

/// Readings of one thruster, to a twentieth of a newton.
fn dynamometer() -> Result<Vec<DynamometerPoint>, VehicleError> {
    let thruster = *pool_thrusters()?[0].thruster();
    let reading = |step: i32| {
        let command = COMMAND_STEP * f64::from(step);
        DynamometerPoint { command, thrust_n: (20.0 * thruster.thrust(command)).round() / 20.0 }
    };
    Ok((-80..=80).map(reading).collect())
}

fn ready(controller: Controller<f64>) -> Result<Controller<f64>, ControlError> {
    controller.with_limits(-LARGEST_MOMENT, LARGEST_MOMENT)?.on_circle(TAU)
}

/// What the computer logs, and what it cannot know.
struct Run {
    time_s: Vec<f64>,
    heading_rad: Vec<f64>,
    moment: Vec<f64>,
    true_heading_rad: Vec<f64>,
}

/// Sails in six degrees of freedom with a law from compass reading to moment, through compensation and thrusters.
fn sail(
    chain: &Compensation<f64, 2, 2>,
    thruster: &Thruster<f64>,
    duration_s: f64,
    mut law: impl FnMut(f64) -> f64,
) -> Result<Run, Failure> {
    let mut pool =
        Simulation::new(pool_vehicle()?, pool_thrusters()?.to_vec(), INTERVAL_S / STEPS as f64, BodyState::at_rest())?;
    let mut run = Run { time_s: Vec::new(), heading_rad: Vec::new(), moment: Vec::new(), true_heading_rad: Vec::new() };
    let tether = Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, TETHER);
    let (mut heading, mut seen, mut owed) = (0.0, 0.0, [0.0; 2]);
    for sample in 0..=(duration_s / INTERVAL_S).round() as usize {
        let yaw_rad = pool.state().pose.angles().yaw_rad;
        heading += (yaw_rad - heading + PI).rem_euclid(TAU) - PI;
        // The compass is one interval late.
        let reading = (seen / QUANTUM_RAD).round() * QUANTUM_RAD;
        seen = heading;
        let moment = law(reading);
        run.time_s.push(sample as f64 * INTERVAL_S);
        run.heading_rad.push(reading);
        run.moment.push(moment);
        run.true_heading_rad.push(heading);
        // What the dead zone withholds is owed: pulses whose mean is right.
        let asked = [owed[0], moment + owed[1]];
        let [port, starboard] = chain.commands_clamped(&asked)?;
        let delivered = chain.delivered(&[port, starboard], &[*thruster; 2]);
        owed = [asked[0] - delivered[0], asked[1] - delivered[1]];
        for _ in 0..STEPS {
            pool.step(&[port, starboard, 0.0], |_| tether)?;
        }
    }
    Ok(run)
}

fn series<'a>(time_s: &'a [f64], values: &'a [f64], scale: f64) -> impl Iterator<Item = (f64, f64)> + 'a {
    time_s.iter().copied().zip(values.iter().map(move |value| value * scale))
}

fn thruster_figure(points: &[DynamometerPoint], map: &ThrusterMap) -> Figure {
    let fitted = (-200..=200).map(|n| (f64::from(n), map.thruster.thrust(f64::from(n))));
    let panel = Panel::new("command", "thrust / N")
        .with("dynamometer", Mark::Points, points.iter().map(|point| (point.command, point.thrust_n)))
        .with("fitted map", Mark::Line, fitted);
    let caption = "Readings of the dynamometer and the fitted map. Look at zero, where thrusters are weakest.";
    Figure { name: "thruster-map", title: "Thruster map".to_owned(), caption, panels: vec![panel] }
}

fn step_figure(before: &Run, after: &Run) -> Figure {
    let degrees = 1f64.to_degrees();
    let reference = [(0.0, STEP_RAD * degrees), (25.0, STEP_RAD * degrees)];
    let heading = Panel::new("time / s", "heading / deg")
        .with("guessed gains", Mark::Line, series(&before.time_s, &before.true_heading_rad, degrees))
        .with("tuned from the identified axis", Mark::Line, series(&after.time_s, &after.true_heading_rad, degrees))
        .with("reference", Mark::Dashed, reference);
    let moment = Panel::new("time / s", "moment asked for / (N m)")
        .with("guessed gains", Mark::Line, series(&before.time_s, &before.moment, 1.0))
        .with("tuned", Mark::Line, series(&after.time_s, &after.moment, 1.0));
    Figure {
        name: "heading-step",
        title: "Heading step before and after identification".to_owned(),
        caption: "The same step with guessed gains and with gains from the identified axis. Look at the overshoot.",
        panels: vec![heading, moment],
    }
}
