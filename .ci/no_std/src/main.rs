//! Calls the routines a controller uses, in f32 and f64, without the standard library and without an allocator.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;

use selfosc::describing::ClosedForm;
use selfosc::experiment::Relay;
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::{Catalogued, RelayHysteresis, Sinusoid};
use selfosc::numeric::Scalar;

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}

fn exercise<T: Scalar>() -> Option<T> {
    let number = |value: f64| black_box(T::from_f64(value));
    let characteristic = RelayHysteresis::from_values(&[number(8.23), number(6.58), number(0.0)]).ok()?;
    let output = Relay::new(characteristic, false).step(number(7.0));
    let df = characteristic.describing_function(&Sinusoid::new(number(3.8), number(26.36)).ok()?).ok()?;
    let oscillation = Oscillation {
        relay_level: number(8.23),
        switch_level: number(6.58),
        amplitude: number(26.36),
        bias: number(3.8),
        period_s: number(2.69),
        delay_s: number(0.2),
    };
    Some(output + df.p + oscillation.identify().ok()?.alpha)
}

/// Entry point in place of the C runtime's; never runs.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    black_box((exercise::<f32>(), exercise::<f64>()));
    loop {}
}
