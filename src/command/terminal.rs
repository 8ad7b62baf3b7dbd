//! What may reach a terminal.

use std::io::{self, Write};

/// A writer of text that shows control characters instead of sending them: the name of a file may hold any.
pub(super) struct Shown<W>(pub(super) W);

impl<W: Write> Write for Shown<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match core::str::from_utf8(bytes) {
            Ok(text) if text.contains(unsafe_to_show) => self.0.write_all(escaped(text).as_bytes())?,
            Ok(_) => self.0.write_all(bytes)?,
            Err(_) => self.0.write_all(escaped(&String::from_utf8_lossy(bytes)).as_bytes())?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Control characters but for line ends and tabulators, and marks that turn the direction of the text.
fn unsafe_to_show(c: char) -> bool {
    let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (c.is_control() && !matches!(c, '\n' | '\t'))
}

fn escaped(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut shown, c| {
        if unsafe_to_show(c) {
            shown.extend(c.escape_default())
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
    fn no_escape_sequence_passes() -> io::Result<()> {
        let mut shown = Shown(Vec::new());
        write!(shown, "log \u{1b}[2J\u{7}\r\u{9b}31m\u{202e}.csv: \u{e9}\t1\n")?;
        assert_eq!(shown.0, "log \\u{1b}[2J\\u{7}\\r\\u{9b}31m\\u{202e}.csv: \u{e9}\t1\n".as_bytes());
        Ok(())
    }
}
