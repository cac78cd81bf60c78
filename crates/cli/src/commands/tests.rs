//! Every example in the help is a command that the program takes.

use super::Arguments;
use clap::{Command, FromArgMatches};

/// The commands that the help of `command` and of those below it shows.
fn examples(command: &Command) -> Vec<String> {
    let mut found = Vec::new();
    let text = command.get_after_help().map(ToString::to_string).unwrap_or_default().replace("\\\n", " ");
    let lines = text.lines().skip_while(|line| *line != "Examples:").skip(1);
    for line in lines.take_while(|line| !line.is_empty()).map(str::trim) {
        // What stands behind a command is set apart by two spaces; shells take care of the rest.
        let commands = line.split("  ").next().unwrap_or_default().split("&&");
        found.extend(commands.map(|c| c.split(" > ").next().unwrap_or_default().trim().to_owned()));
    }
    found.retain(|line| !line.starts_with('#'));
    found.extend(command.get_subcommands().flat_map(examples));
    found
}

#[test]
fn the_command_line_has_no_faults_of_its_own() {
    Arguments::laid_out().debug_assert();
}

#[test]
fn every_example_is_understood() {
    let examples = examples(&Arguments::laid_out());
    assert!(examples.len() > 50, "{examples:#?}");
    for example in examples {
        let words = example.split_whitespace().map(|word| word.trim_matches('\''));
        let matches = Arguments::laid_out().try_get_matches_from(words);
        let read = matches.and_then(|matches| Arguments::from_arg_matches(&matches));
        assert!(read.is_ok(), "{example}\n{}", read.unwrap_err());
    }
}
