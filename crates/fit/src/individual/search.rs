//! The search for an individual.

use super::chosen::Chosen;
use super::hand::{Hand, Scene};
use super::plan::{self, BATCH, Stage};
use super::state::{Deal, LEAST_GAIN, State};
use super::units::Units;
use super::{FoundIndividual, IndividualProgress, Quest};
use crate::budget::Clock;
use crate::error::FitError;
use crate::evaluator::{Evaluator, PreparedView};
use crate::objective::Objective;
use pleach_silhouette::Layer;
use pleach_tree::Trial;
use pleach_tree::{Draw, Spread};
use rayon::prelude::*;
use std::sync::atomic::Ordering;
use std::sync::{Mutex, PoisonError};

/// The part of the stems with draws of their own that are kept on trial beyond those that may stay: what is
/// dropped is dropped for many at once, for the price of a tree.
const ON_TRIAL: usize = 4;
/// The used share of the budget from which on none are.
const LAST: f64 = 0.9;

/// Numbers of trials that one tree may use up, so that no two have the same.
const NUMBERS: u32 = 1 << 24;

/// Searches one tree, the one of this number; see [`super::individuals`].
pub(super) fn search(
    quest: &Quest<'_>,
    which: u8,
    clock: &dyn Clock,
    mut tell: impl FnMut(&IndividualProgress),
) -> Result<Option<FoundIndividual>, FitError> {
    let Quest { problem, genome, settings, limits, stop } = *quest;
    let from = clock.elapsed();
    let evaluator = Evaluator::new(problem, Objective::Overlap, limits)?;
    let generator = &problem.start.generator;
    let spreads = generator.spreads(&genome.values);
    let Ok(params) = generator.space().check(genome.values.clone()) else { return Ok(None) };
    if spreads.is_empty() {
        return Ok(None);
    }
    let views = PreparedView::of_problem(problem);
    let placed = evaluator.placed(genome);
    let scene = Scene { quest, params, views, placed };
    let hands = Hands::default();
    let mut number = u32::from(which) * NUMBERS;
    let begun = hands.with(&scene, |hand| {
        let own = State::new(&scene, Chosen::default(), 0, hand)?;
        Some(if which == 0 { own } else { dealt_anew(&scene, own, &mut number, &spreads, hand) })
    });
    let Some(mut state) = begun else { return Ok(None) };
    let (mut trees, mut trials) = (0, 0);
    // The longest batch so far: another that would end late by more than half of it is not begun.
    let mut longest = 0.0_f64;
    let passed = || clock.elapsed().saturating_sub(from).as_secs_f64();
    let used = |trees: u64, longest: f64| {
        let share = |of: f64, all: Option<f64>| all.map_or(0.0, |all| of / all.max(f64::MIN_POSITIVE));
        share(passed() + longest / 2.0, settings.time.map(|time| time.as_secs_f64()))
            .max(share(trees as f64, settings.trees.map(|all| all as f64)))
    };
    let generations = hands.with(&scene, |hand| plan::generations(&hand.tree));
    'stages: for stage in plan::stages(&generations) {
        if state.generation != stage.generation {
            let chosen = state.chosen.clone();
            let next = hands.with(&scene, |hand| State::new(&scene, chosen, stage.generation, hand));
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
            tell(&IndividualProgress {
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
            let batch = Batch { scene: &scene, hands: &hands, state: &state, stage, spreads: &spreads };
            let found: Vec<Found> =
                numbers.par_iter().with_max_len(1).map(|&number| batch.tree(number)).collect();
            if stop.load(Ordering::Relaxed) {
                return Err(FitError::Interrupted);
            }
            trees += u64::from(BATCH);
            trials += found.iter().map(|found| found.trials).sum::<u64>();
            let better = found.into_iter().flat_map(|found| found.better).collect();
            keep(&scene, &hands, &mut state, better);
            let on_trial = if used(trees, longest) < LAST { settings.max_stems / ON_TRIAL } else { 0 };
            state = hands.with(&scene, |hand| pruned(&scene, state, on_trial, hand));
            longest = longest.max(passed() - begun);
        }
    }
    // The clock may have leapt over the last batches.
    state = hands.with(&scene, |hand| pruned(&scene, state, 0, hand));
    // What follows grows trees in memory of its own.
    drop(hands);
    let kind = problem.species(genome).map_err(crate::space::SpaceError::Start)?;
    let species = kind.with_individual(genome.tree_seed, state.chosen.individual);
    let before = evaluator.evaluate_with_likeness(genome);
    let score =
        evaluator.with_generator(std::sync::Arc::clone(&species.generator)).evaluate_with_likeness(genome);
    let elapsed = clock.elapsed().saturating_sub(from);
    Ok(Some(FoundIndividual { species, before, score, trees, trials, elapsed }))
}

/// The tree `own` with other draws of its trunks, and so of all that they carry; the same where no such tree grows.
fn dealt_anew(scene: &Scene<'_>, own: State, number: &mut u32, spreads: &[Spread], hand: &mut Hand) -> State {
    const TRIES: usize = 8;
    for _ in 0..TRIES {
        let trial =
            Trial { generation: 0, number: *number, reach: 1.0, reseeds: true, spreads: spreads.to_vec() };
        *number += 1;
        let mut chosen = Chosen::default();
        for path in own.paths() {
            let draw = trial.draw(path.address(), 0, &Draw::OWN);
            // They make the tree another one, and stay.
            chosen.set(path.clone(), draw, true, 0.0, f64::INFINITY);
        }
        if let Some(state) = State::new(scene, chosen, 0, hand) {
            return state;
        }
    }
    own
}

/// Makes the exchanges that are still worth it, the best first.
fn keep(scene: &Scene<'_>, hands: &Hands, state: &mut State, mut better: Vec<Better>) {
    // Stable, so that ties are in the order of the trees.
    better.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let most = scene.quest.settings.max_stems;
    for Better { deal, layers, .. } in better {
        let worth = hands.with(scene, |hand| state.tried_again(scene, &deal, &layers, hand));
        if worth.cost < state.cost - state.least_gain(deal.unit, most) {
            state.exchange(&deal, layers, worth);
        }
    }
}

/// `state` with at most as many stems with draws of their own as there may be; as it is where it has no more than
/// that and `on_trial`.
fn pruned(scene: &Scene<'_>, state: State, on_trial: usize, hand: &mut Hand) -> State {
    let most = scene.quest.settings.max_stems;
    if state.chosen.len() <= most + on_trial {
        return state;
    }
    // Without some of its draws a tree may have too much of something; without all it has grown before.
    let fewer = (0..=most).rev().find_map(|most| {
        let mut chosen = state.chosen.clone();
        chosen.prune(most);
        State::new(scene, chosen, state.generation, hand)
    });
    fewer.unwrap_or(state)
}

/// A deal that makes the cost smaller.
struct Better {
    /// The cost after it.
    cost: f64,
    deal: Deal,
    /// What its parts cover, view by view.
    layers: Vec<Layer>,
}

/// What one tree of candidates has brought.
struct Found {
    trials: u64,
    better: Vec<Better>,
}

/// Trees that are grown beside each other.
struct Batch<'a> {
    scene: &'a Scene<'a>,
    hands: &'a Hands,
    state: &'a State,
    stage: Stage,
    spreads: &'a [Spread],
}

impl Batch<'_> {
    /// Grows a tree in which all stems of the generation have other draws, and tries them one by one.
    fn tree(&self, number: u32) -> Found {
        let Self { scene, hands, state, stage, spreads } = *self;
        let mut found = Found { trials: 0, better: Vec::new() };
        if scene.quest.stop.load(Ordering::Relaxed) {
            return found;
        }
        let Stage { generation, reseeds, reach, .. } = stage;
        let trial = Trial { generation, number, reach, reseeds, spreads: spreads.to_vec() };
        hands.with(scene, |hand| {
            if !hand.grow(scene, &state.chosen.individual.draws().with_trial(trial.clone())) {
                return;
            }
            let units = Units::new(&hand.tree, generation);
            for (part, unit) in (1..).zip(&units.units) {
                let Some((known, kept)) = state.find(unit.address) else { continue };
                let draw = trial.draw(unit.address, unit.level, &kept);
                let spread = spreads[unit.level.min(spreads.len() - 1)];
                let deal = Deal { unit: known, draw, reseeds, spread };
                hand.take(&units, part);
                found.trials += 1;
                let Some(worth) = state.tried(scene, &deal, hand) else { continue };
                if worth.cost < state.cost - LEAST_GAIN {
                    found.better.push(Better { cost: worth.cost, deal, layers: hand.layers(scene) });
                }
            }
        });
        found
    }
}

/// Memory that threads take from and give back to.
#[derive(Default)]
struct Hands(Mutex<Vec<Hand>>);

impl Hands {
    fn with<T>(&self, scene: &Scene<'_>, work: impl FnOnce(&mut Hand) -> T) -> T {
        let pool = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = pool().pop();
        let mut hand = taken.unwrap_or_else(|| Hand::new(scene));
        let result = work(&mut hand);
        pool().push(hand);
        result
    }
}
