//! From the controller's forces to thrust: eqs. 1-3 and 35, Fig. 11.

use super::algebra::{exactly, number};
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::numeric::Real;
use crate::proof::polynomial::Rational;
use crate::vehicle::{Allocation, BilinearThruster, Compensation, ThrustSide, Thruster};

claim! {
    THRUSTER_BILINEAR = "thruster-bilinear" Identity
    "Thrust T_nn abs(n) n - T_nu abs(n) u_a and torque alike; each thrust has one rate that turns its way and does not brake";
    printed Holds bilinear(1.0, 1.0);
    // Still water: the rate found without the ambient speed.
    false bilinear(0.0, 1.0);
    needs "not-braking" bilinear(1.0, 0.0);
    exactly eq_1 on "whole" at &[
        [0.5, 0.3, 0.2, 0.1, 2.0, 3.0, 9.0], [0.5, 0.3, 0.2, 0.1, -2.0, 3.0, 9.0],
        [0.5, 0.3, 0.2, 0.1, 2.0, -3.0, 9.0], [0.5, 0.3, 0.2, 0.1, -2.0, -3.0, 9.0],
    ];
}

/// Eq. 1 and back, `seen` the share of the ambient speed given to the inverse; rates from `least` braking rates upwards.
fn bilinear(draw: &mut Draw, seen: f64, least: f64) -> Option<Case> {
    const LARGEST_RATE: f64 = 40.0;
    let mut pair =
        |names: [&'static str; 2]| (draw.log_uniform(names[0], 1e-3, 1e-1), draw.log_uniform(names[1], 1e-3, 1e-1));
    let (thrust, torque) = (pair(["t_nn", "t_nu"]), pair(["q_nn", "q_nu"]));
    let ambient = draw.uniform("ambient_speed_m_s", -2.0, 2.0);
    let thruster = BilinearThruster::new(thrust, torque, LARGEST_RATE).ok()?;
    let rate = draw.uniform("rate", -LARGEST_RATE, LARGEST_RATE);
    if rate.abs() < least * 1.01 * thrust.1 * ambient.abs() / thrust.0 {
        return None;
    }
    let eq_1 = |(by_rate, by_speed): (f64, f64)| by_rate * rate.abs() * rate - by_speed * rate.abs() * ambient;
    let scale = |(by_rate, by_speed): (f64, f64)| (by_rate * rate * rate) + by_speed * (rate * ambient).abs();
    let Ok(back) = thruster.rate(thruster.thrust(rate, ambient), seen * ambient) else {
        return Some(Case::truth(false));
    };
    let equations = [
        ("thrust_n", thruster.thrust(rate, ambient), eq_1(thrust), scale(thrust)),
        ("torque_n_m", thruster.torque(rate, ambient), eq_1(torque), scale(torque)),
    ];
    let inverse = draw.equal(("rate_found", back), rate, LARGEST_RATE, tolerance::CANCELLING);
    Some(inverse.and(draw.equations(equations, tolerance::ROUNDING)))
}

/// A direction of a thruster: thrust grows from zero.
#[derive(Clone, Copy)]
struct ThrustCurve {
    quadratic: f64,
    linear: f64,
    dead_zone: f64,
    limit: f64,
}

impl ThrustCurve {
    fn draw(draw: &mut Draw, simplest: bool) -> Self {
        let (quadratic, dead_zone) = (draw.log_uniform("a", 1e-5, 1e-3), draw.uniform("dead_zone", 5.0, 30.0));
        let linear = if simplest { 0.0 } else { draw.log_uniform("b", 1e-3, 1e-1) };
        Self { quadratic, linear, dead_zone, limit: draw.uniform("limit", 100.0, 200.0) }
    }

    fn command(&self, draw: &mut Draw, commands: Commands) -> f64 {
        let [from, to] = commands(self);
        draw.uniform("command", from, to)
    }

    fn side(&self) -> Option<ThrustSide<f64>> {
        ThrustSide::new(self.quadratic, self.linear, self.dead_zone, self.limit).ok()
    }

    /// Eq. 2.
    fn thrust(&self, command: f64) -> f64 {
        self.quadratic * command.abs() * command + self.linear * command
    }
}

/// A range of random commands.
type Commands = fn(&ThrustCurve) -> [f64; 2];

const TURNING: Commands = |curve| [curve.dead_zone, curve.limit];

claim! {
    THRUSTER_AFFINE = "thruster-affine" Identity
    "Thrust a abs(n) n + b n is odd and has one command, sgn(T) sqrt(abs(T)/a) where b = 0";
    printed Holds affine(TURNING, inverse) and simplest();
    // The simplest thruster's inverse for every b.
    false affine(TURNING, |curve, thrust| (thrust.abs() / curve.quadratic).sqrt().copysign(thrust));
    needs "turning" affine(|curve| [0.1, curve.dead_zone], inverse);
    needs "within-limit" affine(|curve| [1.01 * curve.limit, 2.0 * curve.limit], inverse);
    needs "thrust-grows" falling();
    exactly
        both_ways on "whole" at &[[0.5, 0.3, 1.0, 9.0, 4.0], [0.5, -0.3, 1.0, 9.0, 4.0], [-0.01, 0.3, 1.0, 9.0, 4.0]],
        root on "whole" at &[[0.5, 1.0, 9.0, 7.0]];
}

fn inverse(curve: &ThrustCurve, thrust_n: f64) -> f64 {
    curve.side().and_then(|side| Thruster::asymmetric(side, side).command(thrust_n).ok()).unwrap_or(f64::NAN)
}

/// Eq. 2 both ways, and back by `inverse`.
fn affine(draw: &mut Draw, commands: Commands, inverse: fn(&ThrustCurve, f64) -> f64) -> Option<Case> {
    let curve = ThrustCurve::draw(draw, false);
    let command = curve.command(draw, commands);
    let thruster = Thruster::affine(curve.quadratic, curve.linear, curve.dead_zone, curve.limit).ok()?;
    let thrust = curve.thrust(command);
    let equations = [
        ("thrust_n", thruster.thrust(command), thrust, thrust),
        ("thrust_astern_n", thruster.thrust(-command), -thrust, thrust),
        ("command_found", inverse(&curve, thrust), command, command),
        ("command_astern", inverse(&curve, -thrust), -command, command),
    ];
    Some(draw.equations(equations, tolerance::ROUNDING))
}

fn simplest(draw: &mut Draw) -> Option<Case> {
    let curve = ThrustCurve::draw(draw, true);
    let thrust = curve.thrust(curve.command(draw, TURNING));
    let root = (thrust / curve.quadratic).sqrt();
    Some(draw.equal(("command_found", inverse(&curve, -thrust)), -root, root, tolerance::ROUNDING))
}

/// A thrust that falls before the limit has two commands: such a thruster is refused.
fn falling(draw: &mut Draw) -> Option<Case> {
    let mut curve = ThrustCurve::draw(draw, false);
    curve.quadratic = draw.note("a", -0.6 * curve.linear / curve.limit);
    Some(Case::truth(curve.side().is_some()))
}

claim! {
    THRUSTER_ASYMMETRIC = "thruster-asymmetric" Definition
    "Coefficients of their own for n > 0 and n <= 0; the sign of the thrust picks the side of the inverse";
    printed Holds asymmetric(false);
    // The forward coefficients astern too.
    false asymmetric(true);
    proof prove_asymmetric;
}

fn asymmetric(draw: &mut Draw, forward_only: bool) -> Option<Case> {
    let (ahead, astern) = (ThrustCurve::draw(draw, false), ThrustCurve::draw(draw, false));
    let (forward, backward) = (ahead.side()?, astern.side()?);
    let thruster = Thruster::asymmetric(forward, if forward_only { forward } else { backward });
    let mut case = Case::truth(thruster.thrust(0.0) == 0.0);
    for (curve, sign) in [(ahead, 1.0), (astern, -1.0)] {
        let command = sign * curve.command(draw, TURNING);
        let thrust = curve.thrust(command);
        let found = thruster.command(thrust).unwrap_or(f64::NAN);
        let equations =
            [("thrust_n", thruster.thrust(command), thrust, thrust), ("command_found", found, command, command)];
        case = case.and(draw.equations(equations, tolerance::ROUNDING));
    }
    Some(case)
}

claim! {
    ALLOCATION = "allocation" Identity
    "X = tau_1 + tau_2, N = d (tau_1 - tau_2); tau = (X +- N/d)/2 is its inverse";
    printed Holds allocation(1.0, 1.0);
    // The two thrusters exchanged.
    false allocation(-1.0, 1.0);
    needs "arm-positive" allocation(1.0, 0.0);
    proof |distortion| exactly(ClaimPart::WHOLE, distortion, &[[0.1, 2.0, 3.0]], |at, factor| {
        Some(pair_of_forces(at, factor)?.map(|(_, left, right, _)| left - right))
    });
}

fn allocation(draw: &mut Draw, sign: f64, arm_factor: f64) -> Option<Case> {
    let arm = draw.log_uniform("arm_m", 0.01, 1.0) * arm_factor;
    let thrusts = [draw.uniform("port_n", -5.0, 5.0), draw.uniform("starboard_n", -5.0, 5.0)];
    let Some(equations) = pair_of_forces([arm, thrusts[0], thrusts[1]], sign) else { return Some(Case::truth(false)) };
    Some(draw.equations(equations, tolerance::ROUNDING))
}

/// Eq. 35 of an arm and two thrusts of up to 5 N, and its inverse: both sides of each equation, and its scale.
fn pair_of_forces<T: Real>([arm, port, starboard]: [T; 3], sign: T) -> Option<[(&'static str, T, T, T); 5]> {
    let pair = Allocation::pair(arm).ok()?;
    let [ahead, turning] = pair.forces(&[port, starboard]);
    let [port_found, starboard_found] = pair.thrusts(&[ahead, turning]);
    let scale = T::from_f64(5.0);
    Some([
        ("x_n", ahead, port + starboard, scale),
        ("n_n_m", turning, sign * arm * (port - starboard), scale * arm),
        ("port_split_n", T::from_f64(0.5) * (ahead + turning / arm), port, scale),
        ("port_found_n", port_found, port, scale),
        ("starboard_found_n", starboard_found, starboard, scale),
    ])
}

claim! {
    COMPENSATION = "compensation" Theorem
    "Inverse allocation, offset and inverse maps before the thrusters leave the force asked for, plus a constant";
    printed Holds compensation(&Chain::INTACT);
    // Without the constant.
    false compensation(&Chain { bias: 0.0, ..Chain::INTACT });
    needs "same-thrusters" compensation(&Chain { actual: 0.95, ..Chain::INTACT });
    needs "within-limits" compensation(&Chain { reach: 20.0, ..Chain::INTACT });
    needs "outside-dead-zone" compensation(&Chain { offset: false, ..Chain::INTACT });
    proof prove_compensation;
}

/// A compensated vehicle, and its faults.
struct Chain {
    /// Thrust of the real thrusters over that of the compensated model.
    actual: f64,
    /// Moments asked for over the largest the offset is made for.
    reach: f64,
    /// Whether the offset stands against the dead zone.
    offset: bool,
    /// Share of the constant that is accounted for.
    bias: f64,
}

impl Chain {
    const INTACT: Self = Self { actual: 1.0, reach: 1.0, offset: true, bias: 1.0 };
}

/// A pair of thrusters with a dead zone, both turning ahead, asked for moments about the vertical; clamped where it must be.
fn compensation(draw: &mut Draw, chain: &Chain) -> Option<Case> {
    const ARM_M: f64 = 0.08;
    const LARGEST_N_M: f64 = 0.1;
    let (ahead, astern) = (ThrustCurve::draw(draw, false), ThrustCurve::draw(draw, false));
    let thruster = |factor: f64| {
        let scaled = |curve: ThrustCurve| {
            ThrustCurve { quadratic: factor * curve.quadratic, linear: factor * curve.linear, ..curve }.side()
        };
        Some(Thruster::asymmetric(scaled(ahead)?, scaled(astern)?))
    };
    let (known, actual, pair) = (thruster(1.0)?, thruster(chain.actual)?, Allocation::pair(ARM_M).ok()?);
    let made = if chain.offset {
        Compensation::against_dead_zone(pair, [known; 2], [1.0, 1.0], [0.0, LARGEST_N_M])
    } else {
        Ok(Compensation::new(pair, [known; 2]))
    };
    // Too weak a thruster for offset and moment together.
    let compensation = made.ok()?;
    let moment = chain.reach * draw.uniform("moment_n_m", -LARGEST_N_M, LARGEST_N_M);
    let Ok(commands) = compensation.commands_clamped(&[0.0, moment]) else { return Some(Case::truth(false)) };
    let ([ahead_n, turning_n_m], bias) = (compensation.delivered(&commands, &[actual; 2]), compensation.bias_forces());
    let scale = bias[0].abs() + moment.abs() / ARM_M;
    let equations = [
        ("turning_n_m", turning_n_m, moment + chain.bias * bias[1], ARM_M * scale),
        ("ahead_n", ahead_n, chain.bias * bias[0], scale),
    ];
    Some(draw.equations(equations, tolerance::ROUNDING))
}

/// Eq. 1, and its rate: coefficients of thrust and torque, speed of the water, rate, largest rate.
fn eq_1([t_nn, t_nu, q_nn, q_nu, ambient, rate, largest]: [Rational; 7], factor: Rational) -> Option<[Rational; 3]> {
    let thruster = BilinearThruster::new((t_nn, t_nu), (q_nn, q_nu), largest).ok()?;
    let eq_1 = |by_rate, by_speed| by_rate * rate.abs() * rate - by_speed * rate.abs() * ambient;
    let thrust = thruster.thrust(rate, ambient);
    Some([
        thrust - factor * eq_1(t_nn, t_nu),
        thruster.torque(rate, ambient) - eq_1(q_nn, q_nu),
        thruster.rate(thrust, ambient).ok()? - rate,
    ])
}

/// Eq. 2 at a command, and the commands found for the thrusts there: on a side, the terms that must vanish.
fn eq_2(
    thruster: &Thruster<Rational>,
    [quadratic, linear]: [Rational; 2],
    command: Rational,
    factor: Rational,
) -> Option<[Rational; 2]> {
    let thrust = thruster.thrust(command);
    let printed = quadratic * command.abs() * command + linear * command;
    Some([thrust - factor * printed, thruster.command(thrust).ok()? - command])
}

/// Eq. 2 both ways: coefficients, dead zone, limit and a command between them; both coefficients positive, or a single coefficient.
fn both_ways([quadratic, linear, dead_zone, limit, command]: [Rational; 5], factor: Rational) -> Option<[Rational; 5]> {
    let thruster = Thruster::affine(quadratic, linear, dead_zone, limit).ok()?;
    let ahead = eq_2(&thruster, [quadratic, linear], command, factor)?;
    let astern = eq_2(&thruster, [quadratic, linear], -command, factor)?;
    Some([ahead[0], ahead[1], astern[0], astern[1], thruster.thrust(command) + thruster.thrust(-command)])
}

/// Of four thrusts the root is that of two commands.
fn root([quadratic, dead_zone, limit, thrust]: [Rational; 4], factor: Rational) -> Option<[Rational; 2]> {
    let thruster = Thruster::affine(quadratic, number(0.0), dead_zone, limit).ok()?;
    let [ahead, astern] = [thrust, -thrust].map(|thrust| thruster.command(thrust).ok());
    Some([ahead?.square() - factor * (thrust / quadratic).sqrt().square(), astern? + ahead?])
}

/// Coefficients, dead zone, limit and command of either side.
fn prove_asymmetric(distortion: Distortion) -> Verdict {
    let functions = |at: [Rational; 10], factor: Rational| {
        let [a, b, dead_zone, limit, command, a_astern, b_astern, dead_astern, limit_astern, command_astern] = at;
        let ahead = ThrustSide::new(a, b, dead_zone, limit).ok()?;
        let astern = ThrustSide::new(a_astern, b_astern, dead_astern, limit_astern).ok()?;
        let thruster = Thruster::asymmetric(ahead, astern);
        let [thrust, found] = eq_2(&thruster, [a, b], command, factor)?;
        let [back, found_astern] = eq_2(&thruster, [a_astern, b_astern], -command_astern, factor)?;
        Some([thrust, found, back, found_astern, thruster.thrust(number(0.0))])
    };
    let sides = [[0.5, 0.3, 1.0, 9.0, 4.0], [0.4, -0.3, 1.5, 8.0, 3.0], [-0.01, 0.3, 1.0, 9.0, 4.0]];
    let pairs = sides.iter().flat_map(|ahead| sides.iter().map(move |astern| [*ahead, *astern]));
    let points: Vec<[f64; 10]> = pairs.map(|pair| core::array::from_fn(|i| pair[i / 5][i % 5])).collect();
    exactly(ClaimPart::WHOLE, distortion, &points, functions)
}

/// A pair of thrusters with offsets against their dead zones: the thrusts asked for are those of commands within reach.
fn prove_compensation(distortion: Distortion) -> Verdict {
    let functions = |at: [Rational; 10], factor: Rational| {
        let [arm, largest, a, b, dead_zone, first, a_other, b_other, dead_other, second] = at;
        let thruster = |a, b, dead_zone| Thruster::affine(a, b, dead_zone, number(100.0)).ok();
        let thrusters = [thruster(a, b, dead_zone)?, thruster(a_other, b_other, dead_other)?];
        let (pair, one) = (Allocation::pair(arm).ok()?, number(1.0));
        let made = Compensation::against_dead_zone(pair, thrusters, [one, one], [number(0.0), largest]).ok()?;
        let ([force, moment], [force_bias, moment_bias]) =
            (made.delivered(&[first, second], &thrusters), made.bias_forces());
        let asked = [force - force_bias, moment - moment_bias];
        let commands = made.commands(&asked).ok()?;
        let [force_given, moment_given] = made.delivered(&commands, &thrusters);
        Some([
            commands[0] - first,
            commands[1] - second,
            force_given - (asked[0] + factor * force_bias),
            moment_given - (asked[1] + factor * moment_bias),
        ])
    };
    let point = |[a, b]: [f64; 2], [c, d]: [f64; 2], dead| [0.5, 0.25, a, b, 1.0, 4.0, c, d, dead, 5.0];
    let (both, falling, bending) = ([0.5, 0.3], [0.5, -0.3], [-0.001, 0.5]);
    let laws = [both, falling, bending];
    let points: Vec<_> = laws.iter().flat_map(|&one| laws.iter().map(move |&other| point(one, other, 1.25))).collect();
    exactly(ClaimPart::WHOLE, distortion, &points, functions)
}
