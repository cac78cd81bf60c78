//! Learns the numbers of trees around the known species from their pictures, into `crates/pleach/src/plan/predictors.bin`.
//!
//! `cargo run --release -p pleach --example learn_known_species [TREES]`, whenever a known species has other numbers, which
//! a test finds, or its trees look different. It grows TREES trees around each of 33 species, 1600 if not said, with
//! leaves and again without, which takes an hour on two cores. What is learnt is kept in a folder beside the program as it
//! goes, and a run that was stopped goes on where it was.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command")]

use pleach::plan::{Origin, plan, usual_start};
use pleach::{FitSettings, GeneratorChoice, LearntParts, Predictors, Species};
use pleach_tree::Fnv;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// With those of all species and both kinds of foliage, over a hundred thousand.
const TREES: u64 = 1600;

/// Files of a folder.
struct Folder(PathBuf);

impl Folder {
    /// The one of this very program, next to it, for trees of this number.
    fn of_program(trees: u64) -> std::io::Result<Self> {
        let program = std::env::current_exe()?;
        let version = Fnv::hash(&std::fs::read(&program)?);
        let folder = program.with_file_name(format!("learnt-{version:016x}-{trees}"));
        std::fs::create_dir_all(&folder)?;
        Ok(Self(folder))
    }
}

impl LearntParts for Folder {
    fn load(&self, name: &str) -> Option<Vec<u8>> {
        std::fs::read(self.0.join(name)).ok()
    }

    fn save(&self, name: &str, part: &[u8]) {
        let unfinished = self.0.join("unfinished");
        let written = std::fs::write(&unfinished, part);
        if let Err(error) = written.and_then(|()| std::fs::rename(&unfinished, self.0.join(name))) {
            eprintln!("{name} is not kept: {error}");
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let trees = std::env::args().nth(1).map_or(Ok(TREES), |trees| trees.parse())?;
    let generator = GeneratorChoice::Trees;
    let start = usual_start(generator).ok_or("the usual generators have species")?;
    let guess = Origin::Guess { detect_leaves: true };
    let candidates = plan(guess, generator, &start, FitSettings::default())?.candidates;
    let species: Vec<Species> = candidates.into_iter().map(|candidate| candidate.species).collect();
    let started = Instant::now();
    let tell = |done, all| eprintln!("{done} of {all} kinds, {:.0} s", started.elapsed().as_secs_f64());
    let folder = Folder::of_program(trees)?;
    let bytes = Predictors::record(&species, trees, &folder, &AtomicBool::new(false), tell)?;
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/plan/predictors.bin");
    std::fs::write(&file, &bytes)?;
    std::fs::remove_dir_all(folder.0)?;
    println!("{} bytes", bytes.len());
    Ok(())
}
