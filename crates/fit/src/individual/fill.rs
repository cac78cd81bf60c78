//! The search for the hull that a crown grows into.
//!
//! A crown does not end where its hull does, since twigs reach out of it, and it is not as dense as its points are. So
//! hulls of several margins are tried, and then corrected by what the tree lacks or has too much of, cell by cell.

use super::hull::Crown;
use super::state::State;
use super::worker::{Scene, Workers};
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// Margins that are tried, in cells; negative ones reach out of the crown.
const MARGINS: RangeInclusive<i32> = -2..=5;
/// Other draws of the scaffold that are tried with each correction.
const SEEDS: u32 = 3;
/// By which part of what is lacking a hull is corrected.
const GAINS: [f64; 2] = [0.5, 1.2];
/// Greatest density while it is corrected: more than the densest, so that it is not lost at once.
const MAX_LEVEL: f64 = 1.2;
/// Corrections without success after which there are no more.
const PATIENCE: u32 = 3;
/// A crown whose first hulls cost more than it by this is not searched on: it has its form already.
const HOPELESS: f64 = 0.1;
/// Most corrections.
const ROUNDS: u32 = 12;

/// A hull that is tried.
#[derive(Clone)]
struct Candidate {
    levels: Vec<Vec<f64>>,
    seed: u32,
}

/// The tree of `own`, or the best of those that grow into hulls of the goals. Scaffolds are drawn by `first_seed` and those after
/// it. `go_on` is told how many trees were grown
/// and the best so far, and says whether there is budget for more.
pub(super) fn filled(
    scene: &Scene<'_>,
    workers: &Workers,
    own: State,
    (height, first_seed): (f64, u32),
    mut go_on: impl FnMut(u64, &State) -> bool,
) -> State {
    let Some(crown) = Crown::new(scene, height) else { return own };
    let grow = |candidate: &Candidate| {
        let chosen = own.chosen.with_hull(crown.hull(&candidate.levels, candidate.seed));
        workers.with(scene, |worker| State::new(scene, chosen, 0, worker))
    };
    let mut best: Option<(State, Candidate)> = None;
    let mut try_all = |candidates: Vec<Candidate>, best: &mut Option<(State, Candidate)>| {
        let count = candidates.len() as u64;
        let grown: Vec<_> = candidates.into_par_iter().with_max_len(1).map(|one| (grow(&one), one)).collect();
        let mut is_better = false;
        for (state, candidate) in grown {
            let Some(state) = state else { continue };
            if best.as_ref().is_none_or(|(best, _)| state.cost < best.cost) {
                *best = Some((state, candidate));
                is_better = true;
            }
        }
        (is_better, go_on(count, best.as_ref().map_or(&own, |(best, _)| best)))
    };
    let margins = MARGINS.flat_map(|margin| [true, false].map(|is_even| (margin, is_even)));
    let first = margins
        .map(|(margin, is_even)| Candidate { levels: crown.levels(margin, is_even), seed: first_seed });
    let (_, mut goes_on) = try_all(first.collect(), &mut best);
    let is_hopeless = |(best, _): &(State, Candidate)| best.cost > own.cost + HOPELESS;
    goes_on &= !best.as_ref().is_some_and(is_hopeless);
    let (mut failures, mut next_seed) = (0, first_seed + 1);
    for _ in 0..ROUNDS {
        let Some((state, base)) = best.as_ref().filter(|_| goes_on && failures < PATIENCE) else { break };
        let lacking = crown.lacking(scene, state, height);
        let corrected = |gain: f64| {
            let correct = |(levels, lacking): (&Vec<f64>, &Vec<f64>)| {
                let levels = levels.iter().zip(lacking);
                levels.map(|(level, lacking)| (level + gain * lacking).clamp(0.0, MAX_LEVEL)).collect()
            };
            base.levels.iter().zip(&lacking).map(correct).collect::<Vec<Vec<f64>>>()
        };
        let mut candidates: Vec<Candidate> =
            GAINS.iter().map(|&gain| Candidate { levels: corrected(gain), seed: base.seed }).collect();
        for seed in next_seed..next_seed + SEEDS {
            candidates.push(Candidate { levels: base.levels.clone(), seed });
            candidates.push(Candidate { levels: corrected(GAINS[0]), seed });
        }
        next_seed += SEEDS;
        let is_better;
        (is_better, goes_on) = try_all(candidates, &mut best);
        failures = if is_better { 0 } else { failures + 1 };
    }
    match best {
        Some((state, _)) if state.cost < own.cost => state,
        _ => own,
    }
}
