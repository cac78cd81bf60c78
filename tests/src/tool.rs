//! Tools of others that a test uses where they are: tried for what the test needs of them, since a tool that
//! starts may still lack half of what it needs.

#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use std::process::Command;

/// Whether `probe`, which does in short what the test wants of a tool, ends well. Otherwise the test is to be
/// skipped, and standard error says why: what it `needs`, with how to get it, and what the probe said.
#[must_use]
pub fn is_usable(needs: &str, probe: &mut Command) -> bool {
    match missing(probe) {
        None => true,
        Some(why) => {
            eprintln!("skipped: needs {needs}: {why}");
            false
        }
    }
}

/// What is missing, if anything is.
fn missing(probe: &mut Command) -> Option<String> {
    let name = probe.get_program().to_string_lossy().into_owned();
    let output = match probe.output() {
        Ok(output) if output.status.success() => return None,
        Ok(output) => output,
        Err(error) => return Some(format!("`{name}` does not start: {error}")),
    };
    // Interpreters name the kind of error in one of many lines; other tools say little.
    let said = [&output.stderr, &output.stdout].map(|said| String::from_utf8_lossy(said).into_owned());
    let lines: Vec<&str> = said.iter().flat_map(|said| said.lines()).map(str::trim).collect();
    let kind = |line: &&&str| line.split_once(": ").map_or("", |(kind, _)| kind).to_owned();
    let named = lines.iter().find(|line| kind(line).len() > 5 && kind(line).ends_with("Error"));
    let line = named.or_else(|| lines.iter().find(|line| kind(line) == "Error")).or_else(|| lines.last());
    Some(format!("`{name}` ended with {}: {}", output.status, line.unwrap_or(&"it said nothing")))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str) -> Option<String> {
        missing(Command::new("sh").args(["-c", script]))
    }

    #[test]
    fn a_tool_that_is_half_there_is_told_of() {
        assert_eq!(shell("exit 0"), None);
        let script =
            "echo Traceback; echo \"ModuleNotFoundError: No module named 'numpy'\"; echo >&2 warning; exit 1";
        let why = shell(script).unwrap();
        assert!(why.contains("No module named 'numpy'") && why.contains("exit status: 1"), "{why}");
        assert!(shell("exit 3").unwrap().contains("said nothing"));
        let why = missing(&mut Command::new("no-such-tool-anywhere")).unwrap();
        assert!(why.contains("`no-such-tool-anywhere` does not start"), "{why}");
    }
}
