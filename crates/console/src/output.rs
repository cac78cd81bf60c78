//! Standard output and standard error.

#![expect(clippy::print_stderr, reason = "this is the one place that prints messages")]

use crate::text;
use anstyle::{AnsiColor, Style};
use serde::Serialize;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// As clap shows its own.
const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();

/// Whether `--quiet` was asked for.
static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on, nothing but errors and warnings goes to standard error.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Writes a line to standard output, for people: control characters are escaped.
pub fn line(text: impl std::fmt::Display) -> anyhow::Result<()> {
    data(text::lines(&text.to_string()))
}

/// Writes a line to standard output unchanged, as it would be written to a file.
pub fn data(text: impl std::fmt::Display) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{text}")?;
    Ok(())
}

/// Writes `value` to standard output as JSON on one line.
pub fn json(value: &impl Serialize) -> anyhow::Result<()> {
    data(json_text(value)?)
}

/// JSON with control characters escaped: the same value.
pub fn json_text(value: &impl Serialize) -> anyhow::Result<String> {
    let text = serde_json::to_string(value)?;
    Ok(if text.contains(text::is_hidden) { text::json(&text) } else { text })
}

/// Writes a note, which is not a result, to standard error; nothing with `--quiet`.
pub fn note(text: impl std::fmt::Display) {
    let text = text.to_string();
    if let Some(text) = text.strip_prefix("warning: ") {
        warning(text);
    } else if !QUIET.load(Ordering::Relaxed) {
        eprintln!("{}", text::lines(&text));
    }
}

/// Warns the user on standard error, also with `--quiet`.
pub fn warning(text: impl std::fmt::Display) {
    anstream::eprintln!("{WARNING}warning:{WARNING:#} {}", text::lines(&text.to_string()));
}

/// Notes which file was written; nothing for standard output.
pub fn wrote(path: &Path) {
    if !crate::files::is_stdout(path) {
        note(format_args!("wrote {}", text::path(path)));
    }
}

/// Prints why the program failed: each cause on its own line, or `drawn`.
pub fn error(error: &anyhow::Error, drawn: impl Fn(&(dyn std::error::Error + 'static)) -> Option<String>) {
    anstream::eprintln!("{ERROR}error:{ERROR:#} {}", joined(error, "\n  because: ", drawn));
}

/// The error and its causes, separated by `because`.
pub fn causes(error: &anyhow::Error, because: &str) -> String {
    joined(error, because, |_| None)
}

fn joined(
    error: &anyhow::Error,
    because: &str,
    drawn: impl Fn(&(dyn std::error::Error + 'static)) -> Option<String>,
) -> String {
    let mut message = String::new();
    for (i, cause) in error.chain().enumerate() {
        // A drawing has our own colours, and is escaped already.
        let cause = drawn(cause).unwrap_or_else(|| text::lines(&cause.to_string()).into_owned());
        // Errors whose message includes that of their source would repeat it.
        if i > 0 && message.contains(&cause) {
            continue;
        }
        if i > 0 {
            message.push_str(because);
        }
        message.push_str(&cause);
    }
    message
}

/// Whether `error` is a closed pipe at standard output.
pub fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        let io = cause.downcast_ref::<std::io::Error>().map(std::io::Error::kind);
        let json = cause.downcast_ref::<serde_json::Error>().and_then(serde_json::Error::io_error_kind);
        io.or(json) == Some(std::io::ErrorKind::BrokenPipe)
    })
}

/// Whether a person watches standard error and wants to see progress there.
pub fn is_watched() -> bool {
    !QUIET.load(Ordering::Relaxed) && std::io::stderr().is_terminal()
}

/// A table of text with aligned columns; the first row is the heading, `numbers` lists the columns
/// that are set to the right.
pub fn table(rows: &[Vec<String>], numbers: &[usize]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| rows.iter().filter_map(|r| r.get(c)).map(|t| t.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (c, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[c] - cell.chars().count());
            if c > 0 {
                line.push_str("  ");
            }
            if numbers.contains(&c) {
                line.push_str(&pad);
                line.push_str(cell);
            } else {
                line.push_str(cell);
                line.push_str(&pad);
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text
}
