//! The event-exact simulation against small Runge-Kutta steps with a bisected switching, on drawn loops from drawn starts.

use selfosc_oscillations::relay::control_loop::{Level, RelayLoop};
use selfosc_oscillations::relay::draw::draw;
use selfosc_oscillations::relay::settle::Scales;
use selfosc_oscillations::relay::simulation::{Event, Simulator, State};
use selfosc_oscillations::relay::starts::start;

/// Classical Runge-Kutta of the controller form with commands from a list of switchings.
struct Runge<'a> {
    control_loop: &'a RelayLoop,
    z: Vec<f64>,
    now: f64,
    command: Level,
    /// What the plant receives, and the instants at which that changes.
    applied: Level,
    due: Vec<f64>,
}

impl Runge<'_> {
    fn rate(&self, z: &[f64]) -> Vec<f64> {
        let den = &self.control_loop.plant.den;
        let mut rate = z[1..].to_vec();
        let feedback: f64 = den[1..].iter().rev().zip(z).map(|(a, z)| a * z).sum();
        rate.push((self.control_loop.command(self.applied) - feedback) / den[0]);
        rate
    }

    fn moved(&self, h: f64) -> Vec<f64> {
        let shifted = |by: &[f64], h: f64| self.z.iter().zip(by).map(|(z, rate)| z + h * rate).collect::<Vec<_>>();
        let first = self.rate(&self.z);
        let second = self.rate(&shifted(&first, 0.5 * h));
        let third = self.rate(&shifted(&second, 0.5 * h));
        let fourth = self.rate(&shifted(&third, h));
        (0..self.z.len()).map(|i| self.z[i] + h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i])).collect()
    }

    fn beyond(&self, z: &[f64]) -> bool {
        let output: f64 = self.control_loop.plant.num.iter().rev().zip(z).map(|(b, z)| b * z).sum();
        let RelayLoop { reference, half_width, .. } = *self.control_loop;
        match self.command {
            Level::High => output > reference + half_width,
            Level::Low => output < reference - half_width,
        }
    }

    /// Time to the next switching in s.
    fn switching(&mut self, h: f64, most: f64) -> Option<f64> {
        let begin = self.now;
        while self.now - begin < most {
            let arrival = self.due.first().copied().filter(|&due| due < self.now + h);
            let step = arrival.map_or(h, |due| due - self.now);
            if self.beyond(&self.moved(step)) {
                let (mut low, mut high) = (0.0, step);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if self.beyond(&self.moved(middle)) { high = middle } else { low = middle }
                }
                self.z = self.moved(high);
                self.now += high;
                self.command = self.command.other();
                if self.control_loop.plant.delay > 0.0 {
                    self.due.push(self.now + self.control_loop.plant.delay);
                } else {
                    self.applied = self.command;
                }
                return Some(self.now - begin);
            }
            self.z = self.moved(step);
            self.now += step;
            if arrival.is_some() {
                self.due.remove(0);
                self.applied = self.applied.other();
            }
        }
        None
    }
}

#[test]
fn twelve_switchings_of_sixty_loops() {
    let mut compared = 0;
    for seed in 0..60 {
        let control_loop = draw(seed);
        let simulator = Simulator::<f64>::new(&control_loop);
        let scales = Scales::of(&simulator);
        let State { z, command, due, .. } = start(&simulator, &scales, seed, 0);
        let mut exact = State { z: z.clone(), command, due: due.clone(), on_threshold: false };
        let applied = exact.applied();
        // The simulator's state belongs to a monic denominator.
        let z = z.iter().map(|z| z / control_loop.plant.den[0]).collect();
        let mut runge = Runge { control_loop: &control_loop, z, now: 0.0, command, applied, due: due.into() };
        let h = 0.02 * simulator.motion.step();
        for switching in 0..12 {
            let Event::Switched(after) = simulator.run(&mut exact, scales.limit) else { break };
            let found = runge.switching(h, 2.0 * after + h).unwrap_or(f64::NAN);
            let scale = after.max(scales.time);
            // Unstable plants amplify what the Runge-Kutta steps have lost.
            assert!(
                ((found - after) / scale).abs() < 1e-6,
                "seed {seed}, switching {switching}: {found} instead of {after}"
            );
            compared += 1;
        }
    }
    assert!(compared > 400, "{compared}");
}
