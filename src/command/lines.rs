//! Lines of standard input as they come, with signals and time.

use std::io::{BufRead, Read};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::Instant;

use crate::files::on_signal;

/// Bytes of a line that are read; a longer line is cut there, and the rest is the next line.
const LONGEST: u64 = 4096;
/// Lines that wait: whoever writes faster than they are answered waits, too.
const WAITING: usize = 64;

/// What comes next.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Event {
    /// A line, without its end.
    Line(String),
    /// Standard input is at its end or cannot be read.
    End,
    /// This process is asked to end.
    Signal,
    /// Nothing came in time.
    TimeOut,
}

/// Standard input, read by a thread of its own.
#[derive(Debug)]
pub(super) struct Lines {
    events: Receiver<Event>,
}

impl Lines {
    pub(super) fn of_standard_input() -> Self {
        let (sender, events) = sync_channel(WAITING);
        let of_signal = sender.clone();
        on_signal(move || {
            // Where lines wait, the reader is about to look at them: a signal never waits behind a full channel.
            std::thread::spawn(move || of_signal.send(Event::Signal));
        });
        std::thread::spawn(move || read(&sender));
        Self { events }
    }

    /// Waits without limit.
    pub(super) fn next(&self) -> Event {
        self.events.recv().unwrap_or(Event::End)
    }

    /// Waits until `due`.
    pub(super) fn before(&self, due: Instant) -> Event {
        self.events.recv_timeout(due.saturating_duration_since(Instant::now())).unwrap_or_else(|error| match error {
            RecvTimeoutError::Timeout => Event::TimeOut,
            RecvTimeoutError::Disconnected => Event::End,
        })
    }
}

fn read(sender: &SyncSender<Event>) {
    let mut input = std::io::stdin().lock();
    loop {
        let mut line = Vec::new();
        let event = match input.by_ref().take(LONGEST).read_until(b'\n', &mut line) {
            Ok(1..) => Event::Line(String::from_utf8_lossy(&line).trim().to_owned()),
            _ => Event::End,
        };
        let last = event == Event::End;
        if sender.send(event).is_err() || last {
            return;
        }
    }
}
