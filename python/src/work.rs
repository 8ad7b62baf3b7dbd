//! Long work: without the interpreter's lock, and interrupted when Python is.

use std::panic::resume_unwind;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How often Python is asked whether it was interrupted.
const POLL: Duration = Duration::from_millis(50);

/// What the worker says.
enum Message<T> {
    Stage(String),
    Done(T),
}

/// Hears what comes next.
pub(crate) type Progress<'a> = &'a dyn Fn(String);

/// Does the work in a thread of its own, in which no Python runs. An interrupt ends the call within a twentieth of a second;
/// what was begun runs on to its next stage, or to its end, and is dropped.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(Progress<'_>) -> T + Send + 'static,
) -> PyResult<T> {
    let (sender, mut receiver) = mpsc::channel();
    let worker = move || {
        let stage = |text| {
            if sender.send(Message::Stage(text)).is_err() {
                // Nobody waits for the result: end here, without a message.
                resume_unwind(Box::new("interrupted"));
            }
        };
        let done = work(&stage);
        let _ = sender.send(Message::Done(done));
    };
    thread::Builder::new().name("selfosc".to_owned()).spawn(worker)?;
    loop {
        let message;
        (receiver, message) = py.detach(move || {
            let message = receiver.recv_timeout(POLL);
            (receiver, message)
        });
        match message {
            Ok(Message::Done(done)) => return Ok(done),
            Ok(Message::Stage(text)) => {
                if let Some(progress) = progress {
                    progress.call1((text,))?;
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the computation ended without a result; please report its input"));
            }
        }
        py.check_signals()?;
    }
}
