//! The program `pleach`: arguments, progress, files. Only this crate prints.
//!
//! Results go to standard output, progress and messages to standard error. Exit codes: 0 done, 1
//! failed, 2 wrong usage, 130 stopped by ctrl-C or SIGTERM.

mod commands;
mod files;
mod help;
mod input;
mod interrupted;
mod output;
mod skeleton;

use std::process::ExitCode;

fn main() -> ExitCode {
    match commands::Arguments::from_command_line().run() {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads our output has read enough, as in `pleach species | head`.
        Err(error) if output::is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            output::error(&error);
            if interrupted::Interrupted::is_in(&error) { ExitCode::from(130) } else { ExitCode::FAILURE }
        }
    }
}
