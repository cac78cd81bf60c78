//! The layout of help texts: paragraphs wrap where the terminal ends, examples fit 80 columns.
//!
//! A command's text after its options is made of blocks with blank lines between them. A block that
//! begins with `Examples:` lists commands, each with a comment two or more spaces behind it. Lines of
//! any other block are one paragraph, but for those that begin with a space.

use clap::{Arg, Command};

/// Columns that examples are laid out for.
const WIDTH: usize = 80;

/// Lays out the texts after the options of `command` and all commands below it.
pub(crate) fn laid_out(mut command: Command) -> Command {
    if let Some(text) = command.get_after_help().map(ToString::to_string) {
        command = command.after_help(lay_out(&text));
    }
    command.mut_subcommands(laid_out)
}

/// Lets every option of `command` and of its subcommands take a negative number, so that the error for
/// `--height -3` names the heights that are possible, not an unknown option `-3`.
pub(crate) fn with_negative_numbers(command: Command) -> Command {
    let option = |arg: &Arg| !arg.is_positional() && arg.get_action().takes_values();
    let command = command.mut_args(|arg| if option(&arg) { arg.allow_negative_numbers(true) } else { arg });
    command.mut_subcommands(with_negative_numbers)
}

fn lay_out(text: &str) -> String {
    let block = |block: &str| match block.strip_prefix("Examples:\n") {
        Some(list) => format!("Examples:\n{}", examples(list)),
        None => paragraph(block),
    };
    text.split("\n\n").map(block).collect::<Vec<_>>().join("\n\n")
}

/// Joins lines that were broken by hand.
fn paragraph(block: &str) -> String {
    let mut text = String::new();
    for (i, line) in block.lines().enumerate() {
        if i > 0 {
            text.push(if line.starts_with(' ') || text.ends_with(':') { '\n' } else { ' ' });
        }
        text.push_str(line);
    }
    text
}

/// Commands with their comments beside them, or above them where they would be too wide.
fn examples(list: &str) -> String {
    let mut all: Vec<(&str, String)> = Vec::new();
    for line in list.lines().map(str::trim) {
        if !line.starts_with("pleach") {
            // The comment of the line above, which had no room for it.
            if let Some((_, comment)) = all.last_mut() {
                *comment = format!("{comment} {line}").trim().to_owned();
            }
        } else if let Some((command, comment)) = line.split_once("  ") {
            all.push((command, comment.trim().to_owned()));
        } else {
            all.push((line, String::new()));
        }
    }
    let width = |text: &str| text.chars().count();
    let commented = all.iter().filter(|(_, comment)| !comment.is_empty());
    let column = commented.clone().map(|(command, _)| width(command)).max().unwrap_or(0);
    let beside = commented.clone().all(|(_, comment)| 2 + column + 2 + width(comment) <= WIDTH);
    let mut text = String::new();
    for (command, comment) in &all {
        if comment.is_empty() {
            text.push_str(&format!("  {}\n", broken(command)));
        } else if beside {
            text.push_str(&format!("  {command:column$}  {comment}\n"));
        } else {
            text.push_str(&format!("  # {comment}\n  {}\n", broken(command)));
        }
    }
    text.truncate(text.trim_end().len());
    text
}

/// `command` on as many lines as it needs, as a shell reads it.
fn broken(command: &str) -> String {
    if 2 + command.chars().count() <= WIDTH {
        return command.to_owned();
    }
    let room = WIDTH - 4;
    let fits = command.match_indices(" --").map(|(i, _)| i).filter(|i| command[..*i].chars().count() <= room);
    match fits.last() {
        Some(i) => format!("{} \\\n    {}", &command[..i], broken(command[i..].trim_start())),
        None => command.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paragraphs_are_one_line_and_lists_are_kept() {
        let text = "One two\nthree.\n\nWhat:\n  a  1\n  b  2\n\nFour\nfive.";
        assert_eq!(lay_out(text), "One two three.\n\nWhat:\n  a  1\n  b  2\n\nFour five.");
    }

    #[test]
    fn comments_stand_beside_commands_or_above_them() {
        let short = "Examples:\n  pleach a    one\n  pleach bcd  two\n  pleach efghijk";
        assert_eq!(lay_out(short), short);
        let far = "Examples:\n  pleach a                                                                  one\n  \
                   pleach b      two words, and many more, and so\n                 on until it is wide";
        assert_eq!(
            lay_out(far),
            "Examples:\n  pleach a  one\n  pleach b  two words, and many more, and so on until it is wide"
        );
        let long = format!("Examples:\n  pleach a --long  {}\n  pleach b", "word ".repeat(14).trim());
        let above = format!("Examples:\n  # {}\n  pleach a --long\n  pleach b", "word ".repeat(14).trim());
        assert_eq!(lay_out(&long), above);
    }

    #[test]
    fn long_commands_are_broken_as_shells_read_them() {
        let command = format!("pleach a {}", "--option value ".repeat(8).trim());
        let text = lay_out(&format!("Examples:\n  {command}"));
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        let joined = text.replace("Examples:\n  ", "").replace("\\\n    ", "");
        assert_eq!(joined, command);
    }
}
