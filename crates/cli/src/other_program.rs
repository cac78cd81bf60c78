//! Programs of others, run without a shell and for a limited time.

use anyhow::Context;
use std::fs::File;
use std::io::{Read as _, Seek as _, SeekFrom};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How often is looked whether a program has ended.
const POLL: Duration = Duration::from_millis(10);

/// Bytes of a program's messages that an error shows.
const SHOWN: u64 = 600;

/// Runs a program, the first of `words`, with the others as its arguments, to its end. What it says goes to `log`.
pub(crate) fn run(words: &[String], log: &Path, time: Duration) -> anyhow::Result<ExitStatus> {
    let log = File::create(log)?;
    let mut child = Command::new(&words[0])
        .args(&words[1..])
        .stdin(Stdio::null())
        .stdout(log.try_clone()?)
        .stderr(log)
        .spawn()
        .with_context(|| format!("`{}` cannot be started", words[0]))?;
    wait(&mut child, time)?
        .with_context(|| format!("it had not ended after {} seconds and was stopped", time.as_secs_f64()))
}

/// How a process ended; `None` if it was stopped after `time`.
fn wait(child: &mut Child, time: Duration) -> std::io::Result<Option<ExitStatus>> {
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if started.elapsed() > time {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(POLL);
    }
}

/// The end of what a program said, for an error.
pub(crate) fn last_of(log: &Path) -> String {
    let text = String::from_utf8_lossy(&end_of(log).unwrap_or_default()).into_owned();
    let text = text.trim();
    if text.is_empty() { String::new() } else { format!("; it said: {}", text.escape_debug()) }
}

/// The last bytes of a file, which may be of any length.
fn end_of(log: &Path) -> std::io::Result<Vec<u8>> {
    let mut file = File::open(log)?;
    let start = file.metadata()?.len().saturating_sub(SHOWN);
    file.seek(SeekFrom::Start(start))?;
    let mut bytes = Vec::new();
    file.take(SHOWN).read_to_end(&mut bytes)?;
    Ok(bytes)
}
