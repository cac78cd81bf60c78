//! The program `pleach`: arguments, progress, files. Only this crate prints.
//!
//! Results go to standard output, progress and messages to standard error. Exit codes: 0 done, 1
//! failed, 2 wrong usage, 130 ended by a signal.

mod commands;
mod files;
mod input;
mod interrupted;
mod output;
mod skeleton;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = commands::Arguments::parse();
    match arguments.run() {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads our output has read enough, as in `pleach species | head`.
        Err(error) if output::is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            output::error(&error);
            if error.is::<interrupted::Interrupted>() { ExitCode::from(130) } else { ExitCode::FAILURE }
        }
    }
}
