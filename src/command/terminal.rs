//! Text that may reach a terminal.

use std::io::{self, Write};

/// A writer of text; to a terminal it shows control characters instead of sending them: the name of a file may hold any.
pub(super) struct Shown<W> {
    pub(super) to: W,
    pub(super) terminal: bool,
}

impl<W: Write> Write for Shown<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.terminal {
            self.to.write_all(escaped(&String::from_utf8_lossy(bytes)).as_bytes())?;
            return Ok(bytes.len());
        }
        self.to.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Control characters but for line ends and tabulators, and marks that turn the direction of the text.
fn unsafe_to_show(c: char) -> bool {
    let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (c.is_control() && !matches!(c, '\n' | '\t'))
}

/// Text for a person.
pub(super) fn escaped(text: &str) -> String {
    with_escapes(text, |c| c.escape_default().to_string())
}

/// A JSON document that means the same: such characters are inside of its strings only.
pub(super) fn escaped_json(text: &str) -> String {
    with_escapes(text, |c| format!("\\u{:04x}", u32::from(c)))
}

fn with_escapes(text: &str, escape: impl Fn(char) -> String) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut shown, c| {
        if unsafe_to_show(c) {
            shown.push_str(&escape(c))
        } else {
            shown.push(c)
        }
        shown
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_escape_sequence_reaches_a_terminal_and_no_escape_anything_else() -> io::Result<()> {
        let text = "log \u{1b}[2J\u{7}\r\u{9b}31m\u{202e}.csv: \u{e9}\t1\n";
        let shown = "log \\u{1b}[2J\\u{7}\\r\\u{9b}31m\\u{202e}.csv: \u{e9}\t1\n";
        for (terminal, expected) in [(true, shown), (false, text)] {
            let mut written = Shown { to: Vec::new(), terminal };
            write!(written, "{text}")?;
            assert_eq!(written.to, expected.as_bytes());
        }
        Ok(())
    }
}
