//! The graph of a characteristic as a small SVG, for its page.

use core::fmt::Write;

use crate::describing::{CatalogueError, Entry};
use crate::nonlinearity::{Branch, Sinusoid};

/// Width, height and margin of the drawing.
const WIDTH: f64 = 200.0;
const HEIGHT: f64 = 140.0;
const MARGIN: f64 = 10.0;
/// Input values along one branch.
const SAMPLES: u32 = 80;

/// The output over the input for the example on its page, up and down again: SVG on one line.
///
/// The SVG file next to the page is this function's output; a test compares them.
///
/// # Errors
/// As [`Entry::build`].
pub fn sketch(entry: &Entry) -> Result<String, CatalogueError> {
    let example = entry.example()?;
    let characteristic = entry.build(&example.values)?;
    let sweep = Sinusoid::new(0.0, example.amplitude)?;
    let mut inputs: Vec<f64> =
        (0..=SAMPLES).map(|sample| example.amplitude * (2.0 * f64::from(sample) / f64::from(SAMPLES) - 1.0)).collect();
    characteristic.kinks(&sweep, &mut |kink| {
        // Both sides of a jump.
        let near = 1e-9 * example.amplitude;
        inputs.extend([kink - near, kink + near].into_iter().filter(|x| x.abs() < example.amplitude));
    });
    inputs.sort_by(f64::total_cmp);

    let output = |&x: &f64, branch| (x, characteristic.output(x, branch, &sweep));
    let rising = inputs.iter().map(|x| output(x, Branch::Rising));
    let falling = inputs.iter().rev().map(|x| output(x, Branch::Falling));
    let curve: Vec<(f64, f64)> = rising.chain(falling).collect();
    let largest = curve.iter().fold(f64::MIN_POSITIVE, |largest, (_, y)| largest.max(y.abs()));
    let across = |x: f64| 0.5 * WIDTH + (0.5 * WIDTH - MARGIN) * x / example.amplitude;
    let down = |y: f64| 0.5 * HEIGHT - (0.5 * HEIGHT - MARGIN) * y / largest;

    let (middle, centre) = (0.5 * HEIGHT, 0.5 * WIDTH);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" role=\"img\" \
         aria-label=\"output of {name} over input\"><path d=\"M0 {middle}H{WIDTH}M{centre} 0V{HEIGHT}\" \
         stroke=\"#999\" stroke-width=\"0.7\"/><path fill=\"none\" stroke=\"#06c\" stroke-width=\"2\" d=\"",
        name = entry.name
    );
    let mut drawn = (f64::NAN, f64::NAN);
    for (x, y) in curve {
        let point = ((10.0 * across(x)).round() / 10.0, (10.0 * down(y)).round() / 10.0);
        if point != drawn {
            let command = if drawn.0.is_nan() { 'M' } else { 'L' };
            // Writing to a string does not fail.
            let _ = write!(svg, "{command}{} {}", point.0, point.1);
            drawn = point;
        }
    }
    svg.push_str("\"/></svg>");
    Ok(svg)
}
