//! The program `pleach`: arguments, progress, files. Only this crate prints.
//!
//! Results go to standard output, progress and messages to standard error. Exit codes: 0 done, 1
//! failed, 2 wrong usage, 130 stopped by ctrl-C or SIGTERM.

mod choice;
mod commands;
mod converter;
mod help;
mod input;
mod memory;
mod other_program;
mod segmenter;
mod skeleton;

use pleach_console::{files, interrupted, output, regular, signals, text};
use pleach_fit::FitError;
use pleach_generators::RegistryError;
use pleach_tree::SpeciesError;
use std::process::ExitCode;

fn main() -> ExitCode {
    memory::give_back_large_blocks();
    match commands::Arguments::from_command_line().run() {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of our output has closed the pipe, as in `pleach species | head`.
        Err(error) if output::is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            output::error(&error, species_file);
            if was_interrupted(&error) { ExitCode::from(signals::INTERRUPTED) } else { ExitCode::FAILURE }
        }
    }
}

/// The excerpt of a species file with its mistake marked, if `cause` is such a mistake.
fn species_file(cause: &(dyn std::error::Error + 'static)) -> Option<String> {
    let error = match cause.downcast_ref() {
        Some(RegistryError::Species(error)) => Some(error),
        _ => cause.downcast_ref::<SpeciesError>(),
    };
    error.map(|error| error.draw(true))
}

/// Whether `error` comes from a request to stop.
fn was_interrupted(error: &anyhow::Error) -> bool {
    let is_fit = |cause: &FitError| matches!(cause, FitError::Interrupted);
    interrupted::Interrupted::is_in(error)
        || error.downcast_ref().is_some_and(is_fit)
        || error.chain().any(|cause| cause.downcast_ref().is_some_and(is_fit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_that_was_stopped_is_an_interruption_whatever_is_said_of_it() {
        let fit = anyhow::Error::from(FitError::Interrupted).context("acer.png");
        assert!(was_interrupted(&fit));
        assert!(was_interrupted(&interrupted::Interrupted::new("stopped").into()));
        assert!(!was_interrupted(&anyhow::anyhow!("interrupted")));
    }
}
