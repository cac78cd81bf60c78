//! Identifiability: how far each number can move before the picture shows it.

use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::FitProblem;
use crate::problem::{Genome, Scored};
use crate::run::FitSettings;
use crate::run::search_space;
use crate::space::{Gene, SearchSpace};
use pleach_tree::Slot;
use serde::Serialize;
use std::collections::VecDeque;

/// How well a goal determines a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Identifiability {
    /// A twentieth of its range to one side or the other makes the fit worse; another choice does.
    Determined,
    /// A fifth of its range does.
    Loosely,
    /// Neither does, or the number is not active.
    NotSeen,
    /// There was no time to try all moves.
    NotTried,
}

impl Identifiability {
    /// How well a picture determines a number whose variance is smaller by this part since it was seen, over trees
    /// around a species: by half or more it does, by a fifth loosely.
    #[must_use]
    pub fn from_shrunk(shrunk: f64) -> Self {
        match shrunk {
            0.5.. => Self::Determined,
            0.2.. => Self::Loosely,
            _ => Self::NotSeen,
        }
    }
}

/// What is known of one free number after a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The slot in the generator's parameter space.
    pub slot: Slot,
    /// How well it is determined.
    pub seen: Identifiability,
    /// By how much the cost rises when the number goes down, and up, by [`PROFILE_STEPS`] of its search range; for a
    /// choice only the least of all other choices. `None` beyond the range, and for small moves where no large one is
    /// seen.
    pub rises: [[Option<f64>; 2]; 2],
}

/// The two moves, as parts of the search range.
pub const PROFILE_STEPS: [f64; 2] = [0.05, 0.2];

/// Part of the tolerance that may be spent on resetting numbers that are not seen.
const SPENT_ON_RETURN: f64 = 0.1;

/// Profiles every free number of `best` against the goals: a move is seen if it raises the cost by more than
/// `tolerance`, which is best the spread of one seed's cost.
///
/// # Errors
/// Those of [`crate::fit`] on the same problem and settings, and [`FitError::Interrupted`] once asked to
/// stop.
pub fn profile(
    problem: &FitProblem,
    settings: &FitSettings,
    best: &Scored,
    tolerance: f64,
    until: Until<'_>,
) -> Result<Vec<Profile>, FitError> {
    let (space, evaluator) = prepare(problem, settings)?;
    // They move this tree, and its size can compensate: a picture does not show them.
    let hidden = space.hidden_jitters(&best.genome.values);
    // Nuisances stay as they are: they are not parameters of the tree.
    let mut tried: Vec<Tried> = Vec::new();
    for (gene, slot) in space.genes().iter().filter_map(|gene| Some((gene, gene.slot()?))) {
        let is_read = !hidden.contains(&slot) && space.is_active(&best.genome.values, gene);
        let moves = if is_read { alternatives(gene, gene.get(&best.genome)) } else { Vec::new() };
        tried.push(Tried { gene, slot, moves, rises: [[None; 2]; 2], is_late: false });
    }
    for step in [LARGE, SMALL] {
        let mut moves: Vec<(usize, usize, Genome)> = Vec::new();
        for (number, one) in tried.iter().enumerate() {
            // Most numbers of a tree are not seen. A small move is tried only where a large one is, or where there is none.
            let has_large = one.moves.iter().any(|((step, _), _)| *step == LARGE);
            if step == SMALL && has_large && !one.is_seen(LARGE, tolerance) {
                continue;
            }
            for &((_, side), value) in one.moves.iter().filter(|((of, _), _)| *of == step) {
                let mut genome = best.genome.clone();
                one.gene.set(&mut genome, value);
                moves.push((number, side, genome));
            }
        }
        let scores = until.map(&moves, |(.., genome)| evaluator.score(genome))?;
        for (at, (number, side, _)) in moves.iter().enumerate() {
            let one = &mut tried[*number];
            let Some(score) = scores.get(at) else {
                one.is_late = true;
                continue;
            };
            let rise = score.cost - best.score.cost;
            let known: &mut Option<f64> = &mut one.rises[step][*side];
            *known = Some(known.map_or(rise, |least| least.min(rise)));
        }
    }
    Ok(tried.into_iter().map(|one| one.profile(tolerance)).collect())
}

/// Places in [`PROFILE_STEPS`].
const SMALL: usize = 0;
const LARGE: usize = 1;

/// A number, and what is known of its moves.
struct Tried<'a> {
    gene: &'a Gene,
    slot: Slot,
    /// Step, side and value of each.
    moves: Vec<((usize, usize), f64)>,
    rises: [[Option<f64>; 2]; 2],
    is_late: bool,
}

impl Tried<'_> {
    fn is_seen(&self, step: usize, tolerance: f64) -> bool {
        self.rises[step].iter().flatten().any(|rise| *rise > tolerance)
    }

    fn profile(self, tolerance: f64) -> Profile {
        let seen = match (self.is_seen(SMALL, tolerance), self.is_seen(LARGE, tolerance)) {
            (true, _) => Identifiability::Determined,
            _ if self.is_late => Identifiability::NotTried,
            (_, true) => Identifiability::Loosely,
            _ => Identifiability::NotSeen,
        };
        Profile { slot: self.slot, seen, rises: self.rises }
    }
}

/// The values that are tried instead of `value`, with step and side.
fn alternatives(gene: &Gene, value: f64) -> Vec<((usize, usize), f64)> {
    if gene.is_choice() {
        let all = (0..gene.count() as usize).map(|i| gene.low + i as f64);
        return all.filter(|&other| other != value).map(|other| ((0, 0), other)).collect();
    }
    let unit = gene.to_unit(value);
    let mut list = Vec::new();
    for (step, size) in PROFILE_STEPS.iter().enumerate() {
        for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let there = unit + sign * size;
            let other = gene.from_unit(there.clamp(0.0, 1.0));
            // Beyond the end there is nothing to see; a whole number may be too coarse for the step.
            if (-1e-9..=1.0 + 1e-9).contains(&there) && other != value {
                list.push(((step, side), other));
            }
        }
    }
    list
}

/// Resets numbers that are not seen to their values in `start`, those that cost least first, as long as all of them
/// together cost less than a tenth of `tolerance`; others go half of the way, if they can.
///
/// A fit leaves such numbers at arbitrary values; those of a known species at least belong to a tree. Returns the
/// individual, with its score, and the slots that went all of the way.
///
/// # Errors
/// Those of [`crate::fit`] on the same problem and settings, and [`FitError::Interrupted`] once asked to
/// stop.
pub fn reset_unidentified(
    problem: &FitProblem,
    settings: &FitSettings,
    best: &Scored,
    profiles: &[Profile],
    start: &[f64],
    tolerance: f64,
    until: Until<'_>,
) -> Result<(Scored, Vec<Slot>), FitError> {
    let (space, evaluator) = prepare(problem, settings)?;
    let hidden = space.hidden_jitters(&best.genome.values);
    let most = best.score.cost + SPENT_ON_RETURN * tolerance;
    let back = Back { space: &space, evaluator: &evaluator, most, until };
    let moved: Vec<(Slot, f64)> = profiles
        .iter()
        .filter(|profile| profile.seen == Identifiability::NotSeen && !hidden.contains(&profile.slot))
        .map(|profile| (profile.slot, start[profile.slot.index()]))
        .filter(|&(slot, there)| best.genome.values[slot.index()] != there)
        .collect();
    let mut kept = best.clone();
    let gone = back.all(&mut kept, moved.clone())?;
    let halves = moved.into_iter().filter(|(slot, _)| !gone.contains(slot)).filter_map(|(slot, there)| {
        let gene = space.genes().iter().find(|gene| gene.slot() == Some(slot))?;
        let here = gene.get(&kept.genome);
        let half = gene.from_unit(gene.to_unit(here).midpoint(gene.to_unit(there)));
        (!gene.is_choice() && half != here).then_some((slot, half))
    });
    let halves = halves.collect();
    back.all(&mut kept, halves)?;
    Ok((kept, gone))
}

/// The conditions of a reset.
struct Back<'a> {
    space: &'a SearchSpace,
    evaluator: &'a Evaluator,
    /// Largest cost.
    most: f64,
    until: Until<'a>,
}

impl Back<'_> {
    /// Gives slots of `kept` their new values, one after the other, those that cost least first; returns those that
    /// were set.
    fn all(&self, kept: &mut Scored, moves: Vec<(Slot, f64)>) -> Result<Vec<Slot>, FitError> {
        let alone: Vec<Genome> = moves
            .iter()
            .map(|&(slot, value)| {
                let mut genome = kept.genome.clone();
                genome.values[slot.index()] = value;
                genome
            })
            .collect();
        // The clock stays on this thread.
        let Self { space, evaluator, .. } = *self;
        let costs = self.until.map(&alone, |genome| {
            let slot = genome.values.iter().zip(&kept.genome.values).position(|(a, b)| a != b);
            // An inactive number does not change the tree and its score.
            if slot.is_some_and(|slot| is_active(space, &kept.genome, Slot::new(slot))) {
                evaluator.score(genome).cost
            } else {
                kept.score.cost
            }
        })?;
        let mut order: Vec<usize> = (0..costs.len()).filter(|&i| costs[i] <= self.most).collect();
        order.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
        let mut waiting: VecDeque<(Slot, f64)> = order.into_iter().map(|i| moves[i]).collect();
        let mut slots = Vec::new();
        while !waiting.is_empty() && !self.until.is_late() {
            let steps = self.steps(&kept.genome, &waiting);
            let trials: Vec<&Genome> =
                steps.iter().filter(|step| step.is_read).map(|step| &step.genome).collect();
            let mut scores = self.until.map(&trials, |genome| evaluator.score(genome))?.into_iter();
            for Step { slot, genome, is_read } in steps {
                waiting.pop_front();
                let score = if is_read { scores.next() } else { Some(kept.score) };
                match score.filter(|score| score.cost <= self.most) {
                    Some(score) => {
                        *kept = Scored { genome, score };
                        slots.push(slot);
                    }
                    // Those after it were tried together with it, and are tried again without.
                    None => break,
                }
            }
        }
        Ok(slots)
    }

    /// The next steps from `from`: as many as there are threads to grow their trees.
    ///
    /// Most resets are allowed, so a step is tried before the result of the one before it. The number of steps that
    /// are tried together decides how much work is wasted, not the result.
    fn steps(&self, from: &Genome, waiting: &VecDeque<(Slot, f64)>) -> Vec<Step> {
        let mut genome = from.clone();
        let mut trials = rayon::current_num_threads();
        let mut steps = Vec::new();
        for &(slot, value) in waiting {
            let is_read = is_active(self.space, &genome, slot);
            if is_read && trials == 0 {
                break;
            }
            trials -= usize::from(is_read);
            genome.values[slot.index()] = value;
            steps.push(Step { slot, genome: genome.clone(), is_read });
        }
        steps
    }
}

fn is_active(space: &SearchSpace, genome: &Genome, slot: Slot) -> bool {
    let gene = space.genes().iter().find(|gene| gene.slot() == Some(slot));
    gene.is_none_or(|gene| space.is_active(&genome.values, gene))
}

/// The reset of a number, after all those before it in a list.
struct Step {
    slot: Slot,
    genome: Genome,
    is_read: bool,
}

fn prepare(problem: &FitProblem, settings: &FitSettings) -> Result<(SearchSpace, Evaluator), FitError> {
    let evaluator = Evaluator::new(problem, settings.objective, settings.limits)?.with_seeds(settings.robust);
    Ok((search_space(problem, settings)?, evaluator))
}
