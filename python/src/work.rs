//! Long work: without the interpreter's lock, interrupted when Python is, on threads of this process.

use std::mem;
use std::panic::resume_unwind;
use std::process;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// How often Python is asked whether it was interrupted.
const POLL: Duration = Duration::from_millis(50);

/// What the worker says.
enum Message<T> {
    Stage(String),
    Done(T),
}

/// Hears what comes next.
pub(crate) type Progress<'a> = &'a dyn Fn(String);

/// The threads of the process with this number.
static THREADS: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads that share out work in this process. `fork` copies memory and no thread but its caller (POSIX.1-2017, fork): work given
/// to the threads of the parent would wait for ever, so that a child makes threads of its own. Python forks under the
/// interpreter's lock, which the caller has: no child finds the mutex locked.
pub(crate) fn threads(_: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*threads
        && *process == process::id()
    {
        return Ok(Arc::clone(pool));
    }
    let made = ThreadPoolBuilder::new().thread_name(|number| format!("selfosc-{number}")).build();
    let pool = Arc::new(made.map_err(|error| PyRuntimeError::new_err(error.to_string()))?);
    // The parent's pool is not dropped: that would wake threads which are not there, through locks that they may have held.
    mem::forget(threads.replace((process::id(), Arc::clone(&pool))));
    Ok(pool)
}

/// Does the work in a thread of its own, in which no Python runs. An interrupt ends the call within a twentieth of a second;
/// what was begun runs on to its next stage, or to its end, and is dropped.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(Progress<'_>) -> T + Send + 'static,
) -> PyResult<T> {
    let threads = threads(py)?;
    let (sender, mut receiver) = mpsc::channel();
    let worker = move || {
        let stage = |text| {
            if sender.send(Message::Stage(text)).is_err() {
                // Nobody waits for the result: end here, without a message.
                resume_unwind(Box::new("interrupted"));
            }
        };
        let done = threads.install(|| work(&stage));
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
