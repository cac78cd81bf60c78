//! Spoilt checkpoints, with and without the checksum of what they hold now.

use super::{Area, draws, refused};
use crate::robustness::mutate;
use crate::robustness::verdict::Verdict;
use anyhow::Context;
use pleach_fit::{
    Budget, CheckpointSettings, Control, FitError, FitProblem, FitSettings, GoalView, Optimizer, Outcome,
    Start, TreeSeed, fit,
};
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Foliage, Limits};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

const LANE: u32 = 4;
/// Side of the goal in pixels; its content does not matter.
const SIDE: u32 = 16;
/// Trees that a search may grow.
const LIMITS: Limits = Limits { stems: 200, leaves: 1_000, knots: 2_000, work: 200_000 };
/// Evaluations before the checkpoint, and in all.
const EVALUATIONS: [u64; 2] = [30, 45];

/// Fits of a small goal by every optimiser, and what each has saved.
pub(in super::super) struct Checkpoints {
    problem: FitProblem,
    saved: Vec<(Optimizer, Vec<u8>)>,
}

impl Checkpoints {
    pub(in super::super) fn new() -> anyhow::Result<Self> {
        let species = pleach_generators::preset("palm").context("a known species")?;
        // Any goal will do: a cone.
        let goal = Bitmap::from_fn(SIDE, SIDE, |x, y| x.abs_diff(SIDE / 2) <= y / 3);
        let frame = Frame {
            width: SIDE,
            height: SIDE,
            meters_per_pixel: 0.5,
            axis_column: f64::from(SIDE) / 2.0,
            ground_row: f64::from(SIDE),
        };
        let problem = FitProblem {
            foliage: Foliage::None,
            ..FitProblem::new(species, GoalView::new(goal, View::FRONT, frame))
        };
        let folder = tempfile::tempdir().context("no temporary folder")?;
        let file = folder.path().join("checkpoint");
        let mut saved = Vec::new();
        for name in Optimizer::NAMES {
            let optimizer: Optimizer = name.parse()?;
            let _ = searched(&problem, &optimizer, EVALUATIONS[0], &file, false)?;
            saved.push((optimizer, std::fs::read(&file)?));
        }
        Ok(Self { problem, saved })
    }

    /// The optimiser, its spoilt checkpoint, and whether header and checksum fit what it holds.
    fn spoilt(&self, case: u64) -> (&Optimizer, Vec<u8>, bool) {
        let mut draws = draws(LANE, case);
        let (optimizer, bytes) = &self.saved[draws.below(self.saved.len())];
        if draws.chance(0.2) {
            return (optimizer, mutate::binary(bytes, &mut draws), false);
        }
        let end = bytes.iter().position(|byte| *byte == b'\n').unwrap_or(0);
        let head = String::from_utf8_lossy(&bytes[..end]);
        // Of the header only length and checksum change.
        let magic: Vec<&str> = head.split(' ').take(3).collect();
        let body = mutate::binary(&bytes[end + 1..], &mut draws);
        let head = format!("{} {} ", magic.join(" "), body.len());
        // Of the header up to it and of the body.
        let checksum = crc32fast::hash(&[head.as_bytes(), &body].concat());
        (optimizer, [format!("{head}{checksum:08x}\n").as_bytes(), &body].concat(), true)
    }
}

/// A search of this many evaluations that saves itself in `file`, and continues from there if asked to.
fn searched(
    problem: &FitProblem,
    optimizer: &Optimizer,
    evaluations: u64,
    file: &Path,
    resume: bool,
) -> Result<Outcome, FitError> {
    let settings = FitSettings {
        optimizer: optimizer.clone(),
        budget: Budget::evaluations(evaluations),
        seed: 1,
        tree_seed: TreeSeed::Fixed(1),
        start: Start::Random,
        limits: LIMITS,
        ..FitSettings::default()
    };
    let stop = AtomicBool::new(false);
    // Time does not pass: only evaluations end the search, and only its ends are saved.
    let clock = || Duration::ZERO;
    let mut control = Control::new(&clock, &stop);
    let interval = Duration::from_secs(1);
    control.checkpoint = Some(CheckpointSettings { path: file.to_owned(), interval, resume });
    fit(problem, &settings, control)
}

impl Area for Checkpoints {
    fn name(&self) -> &'static str {
        "checkpoints"
    }

    fn input(&self, case: u64) -> Vec<u8> {
        self.spoilt(case).1
    }

    fn judge(&self, case: u64, folder: &Path) -> Verdict {
        let (optimizer, input, is_forged) = self.spoilt(case);
        let file = folder.join("checkpoint");
        if let Err(error) = std::fs::write(&file, &input) {
            return Verdict::Wrong(format!("the case could not be made: {error}"));
        }
        let is_changed = self.saved.iter().all(|(_, bytes)| *bytes != input);
        let outcome = match searched(&self.problem, optimizer, EVALUATIONS[1], &file, true) {
            Ok(outcome) => outcome,
            Err(error) => {
                return refused(error.to_string().replace(&*file.to_string_lossy(), "checkpoint"), false);
            }
        };
        if is_changed && !is_forged {
            return Verdict::Wrong("a damaged checkpoint is taken".to_owned());
        }
        let Some(best) = outcome.best else { return Verdict::Accepted };
        match self.problem.start.generator.space().check(best.genome.values) {
            Ok(_) => Verdict::Accepted,
            Err(error) => Verdict::Wrong(format!("the result is no list of parameters: {error}")),
        }
    }
}
