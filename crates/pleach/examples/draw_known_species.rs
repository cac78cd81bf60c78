//! Draws the known species for first guesses, into `crates/pleach/src/plan/known.bin`.
//!
//! `cargo run --release -p pleach --example draw_known_species`, whenever a species, its generator, the rasteriser,
//! or what a first guess compares has changed; a test says so.

#![allow(clippy::print_stdout, reason = "a command")]

use pleach::plan::{Origin, draw, plan, usual_start};
use pleach::{FitSettings, GeneratorChoice};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let generator = GeneratorChoice::Trees;
    let start = usual_start(generator).ok_or("the usual generators have species")?;
    let guess = Origin::Guess { detect_leaves: true };
    let candidates = plan(guess, generator, &start, FitSettings::default())?.candidates;
    let bytes = draw(candidates.into_iter().map(|candidate| candidate.species))?;
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/plan/known.bin");
    std::fs::write(&file, &bytes)?;
    println!("{} bytes", bytes.len());
    Ok(())
}
