//! `pleach completions`: what shells need to complete arguments.

use super::Arguments;
use crate::files;
use anyhow::Context;
use clap_complete::Shell;
use std::path::Path;

const EXAMPLES: &str = "Examples:
  pleach completions bash > ~/.local/share/bash-completion/completions/pleach
  pleach completions zsh > ~/.zfunc/_pleach    with ~/.zfunc in fpath
  pleach completions fish > ~/.config/fish/completions/pleach.fish";

/// Print a script that lets a shell complete pleach's arguments
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::laid_out(), "pleach", &mut script);
        files::write_out(Path::new("-"), |out| out.write_all(&script).context("cannot write the script"))
    }
}
