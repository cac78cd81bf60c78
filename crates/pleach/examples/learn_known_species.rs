//! Learns the numbers of trees around the known species from their pictures, into `crates/pleach/src/plan/predictors.bin`.
//!
//! `cargo run --release -p pleach --example learn_known_species [TREES]`, whenever a known species has other numbers, which
//! a test finds, or its trees look different. It grows TREES trees around each of 33 species, 1600 if not said, with
//! leaves and again without, which takes half an hour on two cores.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command")]

use pleach::plan::{Origin, plan, usual_start};
use pleach::{FitSettings, GeneratorChoice, Predictors, Species};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// With those of all species and both kinds of foliage, over a hundred thousand.
const TREES: u64 = 1600;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let trees = std::env::args().nth(1).map_or(Ok(TREES), |trees| trees.parse())?;
    let generator = GeneratorChoice::Trees;
    let start = usual_start(generator).ok_or("the usual generators have species")?;
    let guess = Origin::Guess { detect_leaves: true };
    let candidates = plan(guess, generator, &start, FitSettings::default())?.candidates;
    let species: Vec<Species> = candidates.into_iter().map(|candidate| candidate.species).collect();
    let started = Instant::now();
    let tell = |done, all| eprintln!("{done} of {all} kinds, {:.0} s", started.elapsed().as_secs_f64());
    let bytes = Predictors::record(&species, trees, &AtomicBool::new(false), tell)?;
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/plan/predictors.bin");
    std::fs::write(&file, &bytes)?;
    println!("{} bytes", bytes.len());
    Ok(())
}
