//! Errors of files.

/// Why a file cannot be read or written. Names are cut to a readable length.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// It cannot be opened or read to its end.
    #[error("cannot read {name}: {reason}; give the path of a file that you may read")]
    Unreadable {
        /// The file.
        name: String,
        /// Message of the operating system.
        reason: String,
    },
    /// It has more bytes than are read.
    #[error("{name} is longer than {limit_mib} MiB, the most that is read; cut or thin it out")]
    TooLong {
        /// The file.
        name: String,
        /// Most that is read, MiB.
        limit_mib: u64,
    },
    /// Writing it would destroy an input or another output.
    #[error("{name} is {other} and would replace it; choose another name for what is written")]
    Taken {
        /// The output.
        name: String,
        /// The other.
        other: String,
    },
    /// It cannot be written; its former content is unchanged.
    #[error("cannot write {name}: {reason}; choose a place that you may write to")]
    Unwritable {
        /// The file or folder.
        name: String,
        /// Message of the operating system.
        reason: String,
    },
}

crate::numeric::codes! { pub FileError {
    Unreadable => "unreadable", TooLong => "file-too-long", Taken => "output-is-input", Unwritable => "unwritable",
} }
