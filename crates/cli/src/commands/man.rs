//! `pleach man`: manual pages.

use super::Arguments;
use crate::{files, output};
use clap::Command;
use clap::builder::Resettable;
use std::io::Write;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach man -o ~/.local/share/man/man1    then `man pleach-grow`";

/// Write a manual page for every command
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Man {
    /// Folder for the pages
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
}

impl Man {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let mut command = Arguments::laid_out().disable_help_subcommand(true);
        command.build();
        let pages = write(&command, &self.out)?;
        output::note(format_args!("wrote {pages} pages into {}", self.out.display()));
        Ok(())
    }
}

/// Writes the page of `command` and those of the commands below it. Returns how many they are.
fn write(command: &Command, folder: &Path) -> anyhow::Result<usize> {
    let page = clap_mangen::Man::new(command.clone().after_help(Resettable::Reset));
    let mut text = Vec::new();
    page.render(&mut text)?;
    let notes = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    text.extend_from_slice(sections(&notes).as_bytes());
    let path = files::inside(folder, page.get_filename())?;
    files::write_whole(&path, |file| Ok(file.write_all(&text)?))?;
    let mut pages = 1;
    for below in command.get_subcommands().filter(|below| !below.is_hide_set()) {
        pages += write(below, folder)?;
    }
    Ok(pages)
}

/// The text after a command's options as sections of a manual page: lists keep their lines, which a
/// page would otherwise run together.
fn sections(text: &str) -> String {
    let mut page = String::new();
    let mut notes = false;
    for block in text.split("\n\n").filter(|block| !block.is_empty()) {
        let (head, list) = block.split_once('\n').unwrap_or((block, ""));
        if head == "Examples:" {
            page.push_str(".SH EXAMPLES\n");
        } else {
            page.push_str(if notes { ".PP\n" } else { ".SH NOTES\n" });
            notes = true;
            page.push_str(&format!("{}\n", escaped(head)));
        }
        if !list.is_empty() {
            let lines: Vec<String> = list.lines().map(escaped).collect();
            page.push_str(&format!(".PP\n.nf\n{}\n.fi\n", lines.join("\n")));
        }
    }
    page
}

/// A line of text as roff reads it.
fn escaped(line: &str) -> String {
    let line = line.replace('\\', "\\e").replace('-', "\\-");
    if line.starts_with(['.', '\'']) { format!("\\&{line}") } else { line }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_their_lines_and_nothing_is_taken_for_an_order() {
        let text = "Examples:\n  pleach a --b  c\n  pleach d\n\n.png is\na format.\n\nMore.";
        assert_eq!(
            sections(text),
            ".SH EXAMPLES\n.PP\n.nf\n  pleach a \\-\\-b  c\n  pleach d\n.fi\n.SH NOTES\n\\&.png is\n.PP\n.nf\na \
             format.\n.fi\n.PP\nMore.\n"
        );
        assert_eq!(sections(""), "");
    }
}
