//! Calls the routines a controller uses, in f32 and f64, without the standard library and without an allocator.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;

use selfosc::control::{Controller, RelayTest, Rule, Structure, Tuning};
use selfosc::describing::ClosedForm;
use selfosc::experiment::RelayState;
use selfosc::identify::DragLaw;
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::{Catalogued, RelayHysteresis, Sinusoid};
use selfosc::numeric::Scalar;
use selfosc::on_board::{Coordinate, Experiment, Phase, Protocol};
use selfosc::orbit::limit_cycle;
use selfosc::plant::{DragAxis, State};

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}

fn exercise<T: Scalar>() -> Option<T> {
    let number = |value: f64| black_box(T::from_f64(value));
    let characteristic = RelayHysteresis::from_values(&[number(8.23), number(6.58), number(0.0)]).ok()?;
    let output = RelayState::new(characteristic, false).step(number(7.0));
    let df = characteristic.describing_function(&Sinusoid::new(number(3.8), number(26.36)).ok()?).ok()?;
    let oscillation = Oscillation {
        relay_level: number(8.23),
        switch_level: number(6.58),
        amplitude: number(26.36),
        bias: number(3.8),
        period_s: number(2.69),
        delay_s: number(0.2),
    };
    let axis = DragAxis::linear(number(0.033), number(0.01)).ok()?.with_delay_s(number(0.2)).ok()?;
    let tuning = Tuning::new(&axis, Structure::Pid, number(0.8)).ok()?;
    let moment = Controller::new(tuning.gains()).on_circle(T::two() * T::pi()).ok()?.step(number(1.0), number(0.0), number(0.1));
    let zero = number(0.0);
    let test = RelayTest { level: number(1.0), half_width: zero, amplitude: number(0.16), bias: zero, period_s: number(3.7) };
    let gains = Rule::ZieglerNicholsPid.gains(&test.ultimate().ok()?).ok()?;
    Some(output + df.p + oscillation.identify().ok()?.alpha + moment.command + gains.integral())
}

/// An experiment on a simulated axis, what it identifies, and the limit cycle of that.
fn experiment<T: Scalar>() -> Option<T> {
    let number = |value: f64| black_box(T::from_f64(value));
    let axis = DragAxis::mixed(number(0.04), number(0.01), number(0.03)).ok()?;
    let mut state = State { position: T::zero(), velocity: T::zero() };
    let protocol = Protocol::new(Coordinate::HeadingRad, number(0.02), number(0.2), number(1.0), number(0.05));
    let mut experiment = Experiment::new(protocol).ok()?;
    let mut time_s = T::zero();
    while experiment.phase() == Phase::Running {
        let step = experiment.step(state.position, time_s);
        state = axis.advance(state, step.command, protocol.interval_s);
        time_s = time_s + protocol.interval_s;
    }
    let outcome = experiment.outcome()?;
    let linear = outcome.exact(DragLaw::Linear, number(0.0)).ok()?;
    let quadratic = outcome.exact(DragLaw::Quadratic, number(0.0)).ok()?;
    let relay = RelayHysteresis::from_values(&[outcome.relay_level, outcome.half_width, number(0.0)]).ok()?;
    let cycles = [limit_cycle(&linear, &relay).ok()?, limit_cycle(&quadratic, &relay).ok()?];
    Some(cycles[0].amplitude + cycles[1].amplitude + outcome.iso(number(0.0)).ok()?.alpha)
}

/// What a target without an operating system has in its compiler's own library, and this one takes from C's; never runs.
#[unsafe(no_mangle)]
pub extern "C" fn memcpy(to: *mut u8, _from: *const u8, _count: usize) -> *mut u8 {
    to
}

/// The same for filling.
#[unsafe(no_mangle)]
pub extern "C" fn memset(to: *mut u8, _value: i32, _count: usize) -> *mut u8 {
    to
}

/// Entry point in place of the C runtime's; never runs.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    black_box((exercise::<f32>(), exercise::<f64>()));
    black_box((experiment::<f32>(), experiment::<f64>()));
    loop {}
}
