//! Every example in the help is a command that the program takes.

use super::Arguments;
use clap::error::ErrorKind;
use clap::{Command, FromArgMatches};

/// The commands that the help of `command` and of those below it shows.
fn examples(command: &Command) -> Vec<String> {
    let mut found = Vec::new();
    let text = command.get_after_help().map(ToString::to_string).unwrap_or_default().replace("\\\n", " ");
    let lines = text.lines().skip_while(|line| *line != "Examples:").skip(1);
    for line in lines.take_while(|line| !line.is_empty()).map(str::trim) {
        // Two spaces separate a command from its comment; shells handle the rest.
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

/// As a shell splits it, or at its spaces where it is more than a shell's line.
fn words_of(command: &str) -> Vec<String> {
    shell_words::split(command).unwrap_or_else(|_| command.split_whitespace().map(str::to_owned).collect())
}

#[test]
fn every_example_is_understood() {
    let examples = examples(&Arguments::laid_out());
    assert!(examples.len() > 50, "{examples:#?}");
    // A pipe joins two commands.
    for example in examples.iter().flat_map(|example| example.split(" | ")) {
        let words = words_of(example);
        let matches = Arguments::laid_out().try_get_matches_from(words);
        let read = matches.and_then(|matches| Arguments::from_arg_matches(&matches));
        assert!(read.is_ok(), "{example}\n{}", read.unwrap_err());
    }
}

/// The commands of a page, and whether each is only named in a sentence.
fn commands_of(page: &str) -> Vec<(String, bool)> {
    let mut found = Vec::new();
    for line in page.lines() {
        let quoted = line.split('`').skip(1).step_by(2).map(|part| (part, true));
        // In a block, `echo …; pleach …` may share a line.
        let line = line.trim_start_matches([' ', '{']).trim_start_matches("$ ");
        let block = line.split("; ").map(|part| (part.trim_start(), false));
        for (part, named) in block.chain(quoted) {
            let command = part.strip_prefix("cargo run --release -- ").map(|rest| format!("pleach {rest}"));
            let command = command.unwrap_or_else(|| part.to_owned());
            // Prose may begin like a command, and `…` stands for something that the reader fills in.
            let prose = command.ends_with('.') || command.contains("finds the parameters");
            let prose = prose || command.contains('…');
            if command.starts_with("pleach ") && !prose {
                // Two spaces separate a command from its comment; a shell handles the rest.
                let command = ["  ", " | ", " > "]
                    .iter()
                    .fold(command.as_str(), |command, end| command.split(end).next().unwrap_or_default());
                found.push((command.trim().to_owned(), named));
            }
        }
    }
    found
}

#[test]
fn every_command_of_the_pages_is_understood() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let in_folder = |folder: &str| {
        std::fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect::<Vec<_>>()
    };
    let mut pages: Vec<_> =
        in_folder("experiments").into_iter().map(|folder| folder.join("README.md")).collect();
    pages.extend([in_folder("docs"), in_folder("docs/decisions")].concat());
    pages.retain(|page| page.extension().is_some_and(|ending| ending == "md"));
    pages.extend(["README.md", "targets/README.md"].map(|page| root.join(page)));
    let (mut count, mut wrong) = (0, Vec::new());
    for page in pages {
        for (command, named) in commands_of(&std::fs::read_to_string(&page).unwrap()) {
            let words = words_of(&command);
            let matches = Arguments::laid_out().try_get_matches_from(words);
            let read = matches.and_then(|matches| Arguments::from_arg_matches(&matches));
            count += 1;
            let Err(error) = read else { continue };
            let missing = error.kind() == ErrorKind::MissingRequiredArgument;
            let help = matches!(
                error.kind(),
                ErrorKind::DisplayHelp | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
            );
            if !(help || named && missing) {
                wrong.push(format!("{}: {command}\n{error}", page.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 100, "{count} commands were found");
}
