//! The regenerated paper's figures.

use super::Reproduction;
use crate::paper::figure15::Counts;
use crate::paper::quantisation::{CurvePoint, Error, curves, figure14};
use crate::paper::relay_figures::{self, HALF_WIDTH, LateSwitching7};
use crate::paper::response_figures::{self, Response};
use crate::paper::thruster_figure;
use crate::report::{Figure, Mark, Panel, ReportError};
use crate::vehicle::FittedSide;

pub(super) fn quantisation() -> Figure {
    let curves = curves();
    let curve = |of: fn(&CurvePoint) -> f64| curves.iter().map(move |point| (point.amplitude_ratio, of(point)));
    let zero = (core::f64::consts::SQRT_2, 0.0);
    let panel = Panel::new("X_m / x_a", "parameter error / amplitude error (% per %)")
        .y_limits(-4.0, 10.0)
        .with("alpha (eq. 37)", Mark::Line, curve(|point| point.sensitivity.alpha).filter(|point| point.1 <= 10.0))
        .with("beta (eq. 38)", Mark::Line, curve(|point| point.sensitivity.beta))
        .with("beta_xx (eq. 39)", Mark::Line, curve(|point| point.sensitivity.beta_quadratic))
        .with("X_m = sqrt(2) x_a", Mark::Dots, [zero]);
    let caption = "Relative error of a parameter per that of the amplitude. Only the inertia's curve crosses zero.";
    Figure { name: "quantisation", title: "Sensitivity to the amplitude".to_owned(), caption, panels: vec![panel] }
}

pub(super) fn figure5() -> Result<Figure, ReportError> {
    let [rising, falling] = relay_figures::figure5()?;
    let panel = Panel::new("relay input e (units of x_a)", "relay output u (units of C)")
        .with("e rising", Mark::Line, rising)
        .with("e falling", Mark::Dashed, falling);
    let caption = "Output over input, up along the line and down along the dashes. The offset raises both levels.";
    let title = "Relay with hysteresis, level offset d = 0.3 C".to_owned();
    Ok(Figure { name: "fig5", title, caption, panels: vec![panel] })
}

pub(super) fn figure6() -> Result<Figure, ReportError> {
    let [input, output] = relay_figures::figure6()?;
    let level = |value: f64| [(0.0, value), (2.0, value)];
    let panel = Panel::new("time (periods)", "input (units of x_a), output (units of C)")
        .with("input e", Mark::Line, input)
        .with("output u", Mark::Line, output)
        .with("switching levels", Mark::Dashed, level(HALF_WIDTH))
        .with("", Mark::Dashed, level(-HALF_WIDTH));
    let caption =
        "The output jumps where the input passes a dashed level. The bias makes the upper output last longer.";
    Ok(Figure { name: "fig6", title: "Relay under a biased sinusoid".to_owned(), caption, panels: vec![panel] })
}

pub(super) fn figure7() -> Figure {
    let LateSwitching7 { input, samples, preset_level, switching } = relay_figures::figure7();
    let panel = Panel::new("time (steps)", "relay input (deg)")
        .with("input between samples", Mark::Line, input)
        .with("samples", Mark::Dots, samples)
        .with("preset level 3", Mark::Dashed, [(0.0, preset_level), (11.0, preset_level)])
        .with("switches here, at 6.57", Mark::Dots, [switching]);
    let caption = "The relay sees the samples alone. The first above the preset level is at 6.57: there it switches.";
    Figure { name: "fig7", title: "Late switching of a sampled relay".to_owned(), caption, panels: vec![panel] }
}

pub(super) fn figure9() -> Result<Figure, ReportError> {
    let map = thruster_figure::figure9()?;
    let side = |fit: &FittedSide| format!("{:.2e} n\u{b2} + {:.2e} |n|", fit.quadratic, fit.linear);
    let title = format!("Thrust ahead {}, astern {} (N)", side(&map.map.forward), side(&map.map.backward));
    let panel = Panel::new("thruster command n", "thrust (N)").with("readings", Mark::Dots, map.readings).with(
        "fit",
        Mark::Line,
        map.fitted,
    );
    let caption = "Readings and their fit, quadratic and linear on either side. Look at the sides' difference.";
    Ok(Figure { name: "fig9", title, caption, panels: vec![panel] })
}

fn response(name: &'static str, title: &str, response: Response) -> Figure {
    let Response { heading, command, maxima, minima, switchings, half_width_deg } = response;
    let end = heading.last().map_or(0.0, |sample| sample.0);
    let level = |value: f64| [(0.0, value), (end, value)];
    let above = Panel::new("time (s)", "heading (deg)")
        .with("heading", Mark::Line, heading)
        .with("maxima", Mark::Dots, maxima)
        .with("minima", Mark::Dots, minima)
        .with("switchings", Mark::Dots, switchings)
        .with("preset levels", Mark::Dashed, level(half_width_deg))
        .with("", Mark::Dashed, level(-half_width_deg));
    let below = Panel::new("time (s)", "command (1e-2 N m)").with("command", Mark::Line, command);
    let caption = "Delay and inertia carry the heading past the dashed level. Dots are readings of a row of Table 4.";
    Figure { name, title: title.to_owned(), caption, panels: vec![above, below] }
}

impl Reproduction {
    pub(super) fn figure12(&self) -> Result<Figure, ReportError> {
        let simulated = response_figures::figure12(&self.joint)?;
        Ok(response("fig12", "Heading and command, simulated", simulated))
    }

    pub(super) fn figure13(&self) -> Result<Figure, ReportError> {
        let simulated = response_figures::figure13(&self.joint)?;
        Ok(response("fig13", "Heading and command without hysteresis, simulated", simulated))
    }

    pub(super) fn figure14(&self) -> Figure {
        let errors = figure14(&self.printed);
        let points = |of: fn(&Error) -> f64| errors.iter().map(move |error| (f64::from(error.experiment), of(error)));
        let panel = |panel: Panel, label: &str, percent: fn(&Error) -> f64, bound: fn(&Error) -> f64| {
            panel
                .with(&format!("{label}, its bounds dashed"), Mark::Dots, points(percent))
                .with("", Mark::Dashed, points(bound))
                .with("", Mark::Dashed, points(bound).map(|(x, y)| (x, -y)))
        };
        let axes = |label: &str| Panel::new("experiment", label);
        let alpha = panel(axes("error of alpha (%)"), "alpha", |e| e.percent.alpha, |e| e.bound_percent.alpha);
        let drag = axes("error of drag (%)");
        let drag = panel(drag, "beta_r", |e| e.percent.beta_r, |e| e.bound_percent.beta_r);
        let drag = panel(drag, "beta_rr", |e| e.percent.beta_rr, |e| e.bound_percent.beta_rr);
        let title = "Errors against the mean, bounds by a compass step of 1 degree";
        let caption = "Experiments against their mean. The compass's rounding alone explains dots between the dashes.";
        Figure { name: "fig14", title: title.to_owned(), caption, panels: vec![alpha, drag] }
    }

    pub(super) fn figure15(&self) -> Figure {
        let bars = |place: f64, of: fn(&Counts) -> u32| {
            self.figure15.iter().map(move |counts| (f64::from(counts.criterion) + place, f64::from(of(counts))))
        };
        let mark = Mark::Bars { width: 0.22 };
        let panel = Panel::new("criterion", "pairs of experiments")
            .with("correct", mark, bars(-0.24, |counts| counts.correct))
            .with("wrong", mark, bars(0.0, |counts| counts.wrong))
            .with("undecided", mark, bars(0.24, |counts| counts.undecided));
        let title = "Drag law decided from two experiments".to_owned();
        let caption = "Verdicts under each criterion. With a larger margin fewer are wrong, more pairs undecided.";
        Figure { name: "fig15", title, caption, panels: vec![panel] }
    }
}
