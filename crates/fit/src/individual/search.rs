//! The search for an individual.

use super::chosen::Chosen;
use super::fill::filled;
use super::plan::{self, BATCH, Stage};
use super::state::{MIN_GAIN, Proposal, State};
use super::task::{FoundIndividual, IndividualProgress, Task};
use super::units::Units;
use super::worker::{Scene, Worker, Workers};
use crate::control::Clock;
use crate::error::FitError;
use crate::evaluator::{Evaluator, SilhouetteGoal};
use crate::problem::Objective;
use pleach_silhouette::Layer;
use pleach_tree::Trial;
use pleach_tree::{Draw, Spread};
use rayon::prelude::*;
use std::sync::atomic::Ordering;

/// One of this many parts of the allowed stems with draws of their own may be kept beyond the bound for a while:
/// dropping many at once costs one tree.
const ON_TRIAL: usize = 4;
/// The used share of the budget until which hulls are tried.
const HULL_SHARE: f64 = 0.4;
/// The used share of the budget from which none are.
const LAST: f64 = 0.9;

/// Numbers of trials per individual, so that no two have the same.
const NUMBERS: u32 = 1 << 24;

/// Searches individual number `which`; see [`super::individuals`].
pub(super) fn search(
    task: &Task<'_>,
    which: u8,
    clock: &dyn Clock,
    mut notify: impl FnMut(&IndividualProgress),
) -> Result<Option<FoundIndividual>, FitError> {
    let Task { problem, genome, settings, limits, stop } = *task;
    let from = clock.elapsed();
    let evaluator = Evaluator::new(problem, Objective::Overlap, limits)?;
    let generator = &problem.start.generator;
    let spreads = generator.spreads(&genome.values);
    let Ok(params) = generator.space().check(genome.values.clone()) else { return Ok(None) };
    if spreads.is_empty() {
        return Ok(None);
    }
    let views = problem.goals.iter().map(|goal| SilhouetteGoal::new(&goal.goal)).collect();
    let placed = evaluator.placed(genome);
    let scene = Scene { task, params, views, placed };
    let workers = Workers::default();
    let mut number = u32::from(which) * NUMBERS;
    let begun = workers.with(&scene, |worker| {
        let own = State::new(&scene, Chosen::default(), 0, worker)?;
        Some(if which == 0 { own } else { redrawn(&scene, own, &mut number, &spreads, worker) })
    });
    let Some(mut state) = begun else { return Ok(None) };
    let (mut trees, mut trials) = (0, 0);
    // The longest batch so far: a batch that would end late by more than half of it is not started.
    let mut longest = 0.0_f64;
    let passed = || clock.elapsed().saturating_sub(from).as_secs_f64();
    let used = |trees: u64, longest: f64| {
        let share = |of: f64, all: Option<f64>| all.map_or(0.0, |all| of / all.max(f64::MIN_POSITIVE));
        share(passed() + longest / 2.0, settings.time.map(|time| time.as_secs_f64()))
            .max(share(trees as f64, settings.trees.map(|all| all as f64)))
    };
    if let Some(height) = generator.hull_height(&genome.values) {
        state = filled(&scene, &workers, state, (height, u32::from(which) * NUMBERS), |count, best| {
            let (iou, likeness, share) = (best.iou, best.likeness, used(trees, 0.0).min(1.0));
            notify(&IndividualProgress { number: which, trees, trials, iou, likeness, used: share });
            trees += count;
            used(trees, 0.0) < HULL_SHARE && !stop.load(Ordering::Relaxed)
        });
        if stop.load(Ordering::Relaxed) {
            return Err(FitError::Interrupted);
        }
    }
    let generations = workers.with(&scene, |worker| {
        // It has grown before.
        worker.grow(&scene, &state.chosen.individual.draws());
        plan::generations(&worker.tree)
    });
    'stages: for stage in plan::stages(&generations) {
        if state.generation != stage.generation {
            let chosen = state.chosen.clone();
            let next = workers.with(&scene, |worker| State::new(&scene, chosen, stage.generation, worker));
            // It has grown before.
            let Some(next) = next else { break };
            state = next;
        }
        for _ in 0..stage.batches {
            let share = used(trees, longest);
            if share < 1.0 && share >= stage.until {
                break;
            }
            let likeness = state.likeness;
            notify(&IndividualProgress {
                number: which,
                trees,
                trials,
                iou: state.iou,
                likeness,
                used: share.min(1.0),
            });
            if share >= 1.0 {
                break 'stages;
            }
            let begun = passed();
            let numbers: Vec<u32> = (number..number + BATCH).collect();
            number += BATCH;
            let batch = Batch { scene: &scene, workers: &workers, state: &state, stage, spreads: &spreads };
            let found: Vec<Found> =
                numbers.par_iter().with_max_len(1).map(|&number| batch.tree(number)).collect();
            if stop.load(Ordering::Relaxed) {
                return Err(FitError::Interrupted);
            }
            trees += u64::from(BATCH);
            trials += found.iter().map(|found| found.trials).sum::<u64>();
            let better = found.into_iter().flat_map(|found| found.better).collect();
            keep(&scene, &workers, &mut state, better);
            let on_trial = if used(trees, longest) < LAST { settings.max_stems / ON_TRIAL } else { 0 };
            state = workers.with(&scene, |worker| pruned(&scene, state, on_trial, worker));
            longest = longest.max(passed() - begun);
        }
    }
    // The clock may have jumped over the last batches.
    state = workers.with(&scene, |worker| pruned(&scene, state, 0, worker));
    // The code below grows trees in memory of its own.
    drop(workers);
    let kind = problem.species(genome).map_err(crate::space::SpaceError::Start)?;
    let species = kind.with_individual(genome.tree_seed, state.chosen.individual);
    let before = evaluator.evaluate_with_likeness(genome);
    let score =
        evaluator.with_generator(std::sync::Arc::clone(&species.generator)).evaluate_with_likeness(genome);
    let elapsed = clock.elapsed().saturating_sub(from);
    Ok(Some(FoundIndividual { species, before, score, trees, trials, elapsed }))
}

/// The tree `own` with other draws of its trunks, and so of all their descendants; unchanged if no such tree grows.
fn redrawn(
    scene: &Scene<'_>,
    own: State,
    number: &mut u32,
    spreads: &[Spread],
    worker: &mut Worker,
) -> State {
    const TRIES: usize = 8;
    for _ in 0..TRIES {
        let trial =
            Trial { generation: 0, number: *number, reach: 1.0, reseeds: true, spreads: spreads.to_vec() };
        *number += 1;
        let mut chosen = Chosen::default();
        for path in own.paths() {
            let draw = trial.draw(path.address(), 0, &Draw::OWN);
            // They make it another tree, and are never dropped.
            chosen.set(path.clone(), draw, true, 0.0, f64::INFINITY);
        }
        if let Some(state) = State::new(scene, chosen, 0, worker) {
            return state;
        }
    }
    own
}

/// Makes the exchanges that still lower the cost, the best first.
fn keep(scene: &Scene<'_>, workers: &Workers, state: &mut State, mut better: Vec<Better>) {
    // Stable, so that ties are in the order of the trees.
    better.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let most = scene.task.settings.max_stems;
    for Better { proposal, layers, .. } in better {
        let loss = workers.with(scene, |worker| state.tried_again(scene, &proposal, &layers, worker));
        if loss.cost < state.cost - state.min_gain(proposal.unit, most) {
            state.exchange(&proposal, layers, loss);
        }
    }
}

/// `state` with at most the allowed number of stems with draws of their own; unchanged if it has at most `on_trial`
/// more.
fn pruned(scene: &Scene<'_>, state: State, on_trial: usize, worker: &mut Worker) -> State {
    let most = scene.task.settings.max_stems;
    if state.chosen.len() <= most + on_trial {
        return state;
    }
    // Without some of its draws a tree may exceed a limit; without any it has grown before.
    let fewer = (0..=most).rev().find_map(|most| {
        let mut chosen = state.chosen.clone();
        chosen.prune(most);
        State::new(scene, chosen, state.generation, worker)
    });
    fewer.unwrap_or(state)
}

/// A proposal that lowers the cost.
struct Better {
    /// The cost after it.
    cost: f64,
    proposal: Proposal,
    /// The layers of its parts, view by view.
    layers: Vec<Layer>,
}

/// The result of one tree of candidates.
struct Found {
    trials: u64,
    better: Vec<Better>,
}

/// Trees that are grown in parallel.
struct Batch<'a> {
    scene: &'a Scene<'a>,
    workers: &'a Workers,
    state: &'a State,
    stage: Stage,
    spreads: &'a [Spread],
}

impl Batch<'_> {
    /// Grows a tree in which all stems of the generation have other draws, and tries them one by one.
    fn tree(&self, number: u32) -> Found {
        let Self { scene, workers, state, stage, spreads } = *self;
        let mut found = Found { trials: 0, better: Vec::new() };
        if scene.task.stop.load(Ordering::Relaxed) {
            return found;
        }
        let Stage { generation, reseeds, reach, .. } = stage;
        let trial = Trial { generation, number, reach, reseeds, spreads: spreads.to_vec() };
        workers.with(scene, |worker| {
            if !worker.grow(scene, &state.chosen.individual.draws().with_trial(trial.clone())) {
                return;
            }
            let units = Units::new(&worker.tree, generation);
            for (part, unit) in (1..).zip(&units.units) {
                let Some((known, kept)) = state.find(unit.address) else { continue };
                let draw = trial.draw(unit.address, unit.level, &kept);
                let spread = spreads[unit.level.min(spreads.len() - 1)];
                let proposal = Proposal { unit: known, draw, reseeds, spread };
                worker.take(&units, part);
                found.trials += 1;
                let Some(loss) = state.tried(scene, &proposal, worker) else { continue };
                if loss.cost < state.cost - MIN_GAIN {
                    found.better.push(Better { cost: loss.cost, proposal, layers: worker.layers(scene) });
                }
            }
        });
        found
    }
}
