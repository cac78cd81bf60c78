//! `pleach man`: manual pages.

use super::Arguments;
use crate::{files, output};
use clap::Command;
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
    let page = clap_mangen::Man::new(command.clone());
    let mut text = Vec::new();
    page.render(&mut text)?;
    let path = files::inside(folder, page.get_filename())?;
    files::write_whole(&path, |file| Ok(file.write_all(&text)?))?;
    let mut pages = 1;
    for below in command.get_subcommands().filter(|below| !below.is_hide_set()) {
        pages += write(below, folder)?;
    }
    Ok(pages)
}
