//! What a person beside the vehicle sees: on a terminal a picture of seven lines, redrawn; elsewhere a line for each cycle.

use std::io::{Write, stderr};
use std::time::{Duration, Instant};

use crate::features::{Cycle, Cycles, Features, Summary};
use crate::identify::exact::MeanCycle;
use crate::numeric::significant;
use crate::on_board::{Experiment, Phase, Protocol};

/// Between two pictures.
const PAUSE: Duration = Duration::from_millis(100);
/// Characters of a bar.
const BAR: usize = 41;

pub(super) struct Display {
    protocol: Protocol<f64>,
    terminal: bool,
    drawn: Option<Instant>,
    started_s: Option<f64>,
    elapsed_s: f64,
    attempt: u8,
    finder: Cycles<f64>,
    summary: Summary<f64>,
    last: Option<Cycle<f64>>,
    /// Of the steady cycles, once the experiment is done.
    found: Option<Features<f64>>,
}

impl Display {
    pub(super) fn new(protocol: &Protocol<f64>, terminal: bool) -> Self {
        Self {
            protocol: *protocol,
            terminal,
            drawn: None,
            started_s: None,
            elapsed_s: 0.0,
            attempt: 1,
            finder: Cycles::new(protocol.middle_command()),
            summary: Summary::new(),
            last: None,
            found: None,
        }
    }

    /// A sample: time, coordinate, command.
    pub(super) fn sample(&mut self, experiment: &Experiment<f64>, [time_s, position, command]: [f64; 3]) {
        if experiment.attempt() != self.attempt {
            let (started_s, drawn, attempt) = (self.started_s, self.drawn, experiment.attempt());
            *self = Self { started_s, drawn, attempt, ..Self::new(&self.protocol, self.terminal) };
        }
        self.elapsed_s = time_s - *self.started_s.get_or_insert(time_s);
        let ended = self.finder.step(time_s, position, command);
        if let Some(cycle) = ended {
            self.summary.push(cycle);
            self.last = Some(cycle);
        }
        if self.terminal {
            if self.drawn.is_none_or(|drawn| drawn.elapsed() >= PAUSE) {
                self.draw(experiment.phase(), [position, command]);
            }
        } else if let Some(cycle) = ended {
            let about = cycle_text(&cycle);
            let _ =
                writeln!(stderr(), "{} s  cycle ended: {about}; {}", significant(self.elapsed_s, 4), self.estimate());
        }
    }

    /// The last picture, with the steady cycles' estimate.
    pub(super) fn end(&mut self, experiment: &Experiment<f64>) {
        self.found = experiment.outcome().map(|outcome| outcome.features);
        if let (true, Some(position)) = (self.terminal, experiment.position()) {
            self.draw(experiment.phase(), [position, experiment.command()]);
        } else if self.found.is_some() {
            let _ = writeln!(stderr(), "{} s  done: {}", significant(self.elapsed_s, 4), self.estimate());
        }
    }

    fn draw(&mut self, phase: Phase, [position, command]: [f64; 2]) {
        let protocol = &self.protocol;
        let unit = protocol.coordinate.angle_unit().unwrap_or_default();
        let room = (protocol.highest_command - protocol.neutral_command)
            .max(protocol.neutral_command - protocol.lowest_command);
        let rows = [
            format!("selfosc run: {}, attempt {} of {}", phase, self.attempt, protocol.attempts),
            format!("time        {} s of {} s", significant(self.elapsed_s, 4), significant(protocol.duration_s, 4)),
            format!(
                "coordinate  {:>10} {unit:3} {}",
                significant(position, 4),
                bar((position - protocol.reference) / protocol.largest_excursion)
            ),
            format!(
                "command     {:>10}     {}",
                significant(command, 4),
                bar((command - protocol.neutral_command) / room)
            ),
            format!("cycles      {}", self.last.as_ref().map_or_else(|| "none yet".to_owned(), cycle_text)),
            format!("estimate    {}", self.estimate()),
        ];
        let mut picture = String::new();
        if self.drawn.is_some() {
            picture.push_str(&format!("\x1b[{}A", rows.len()));
        }
        for row in &rows {
            let shown: String = row.chars().take(79).collect();
            picture.push_str(&format!("\x1b[2K{shown}\n"));
        }
        let _ = stderr().write_all(picture.as_bytes());
        self.drawn = Some(Instant::now());
    }

    /// The axis whose exact limit cycle has the means so far, without delay: a first impression, no result.
    fn estimate(&self) -> String {
        let Some(features) = self.found.or_else(|| self.summary.features().ok()) else {
            return "after two cycles that agree".to_owned();
        };
        let level = self.protocol.relay_level;
        match MeanCycle::of(&features, level, self.protocol.interval_s / 2.0).linear_drag() {
            Ok(axis) => {
                let (alpha, drag) = (significant(axis.alpha(), 3), significant(axis.linear_drag(), 3));
                format!("alpha {alpha}, linear drag {drag}, over {} cycles", features.cycles)
            }
            Err(error) => error.code().to_owned(),
        }
    }
}

fn cycle_text(cycle: &Cycle<f64>) -> String {
    format!("amplitude {}, period {} s", significant(cycle.amplitude(), 4), significant(cycle.period_s, 4))
}

/// A line from -1 to 1 with its middle and a mark.
fn bar(place: f64) -> String {
    let half = (BAR / 2) as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to BAR - 1")]
    let mark = (half + (place.clamp(-1.0, 1.0) * half).round()) as usize;
    let mut line = ["-"; BAR];
    (line[BAR / 2], line[mark]) = ("|", "*");
    format!("[{}]", line.concat())
}
