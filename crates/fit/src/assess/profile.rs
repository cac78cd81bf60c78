//! Identifiability: how far each number can move before the picture shows it.

use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::posterior::PosteriorNumber;
use crate::problem::{FitProblem, Genome, Scored};
use crate::run::{FitSettings, search_space};
use crate::space::Gene;
use pleach_tree::Slot;
use serde::Serialize;

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
    /// choice only the least of all other choices. `None` beyond the range, for small moves where no large one is
    /// seen, and for all moves of a number that is known from elsewhere.
    pub rises: [[Option<f64>; 2]; 2],
}

/// The two moves, as parts of the search range.
pub const PROFILE_STEPS: [f64; 2] = [0.05, 0.2];

/// Profiles every free number of `best` against the goals: a move is seen if it raises the cost by more than
/// `tolerance`, which is best the spread of one seed's cost. Those that are `known` are not moved: what was learnt from
/// many trees says more than what this one shows.
///
/// # Errors
/// Those of [`crate::fit`] on the same problem and settings, and [`FitError::Interrupted`] once asked to
/// stop.
pub fn profile(
    problem: &FitProblem,
    settings: &FitSettings,
    best: &Scored,
    known: &[PosteriorNumber],
    tolerance: f64,
    until: Until<'_>,
) -> Result<Vec<Profile>, FitError> {
    let space = search_space(problem, settings)?;
    let evaluator = Evaluator::new(problem, settings.objective, settings.limits)?.with_seeds(settings.robust);
    // They move this tree, and its size can compensate: a picture does not show them.
    let hidden = space.hidden_jitters(&best.genome.values);
    // Nuisances stay as they are: they are not parameters of the tree.
    let mut tried: Vec<Tried> = Vec::new();
    for (gene, slot) in space.genes().iter().filter_map(|gene| Some((gene, gene.slot()?))) {
        let known = known.iter().find(|number| number.slot == slot);
        let known = known.map(|number| Identifiability::from_shrunk(number.shrunk));
        let is_read = !hidden.contains(&slot) && space.is_active(&best.genome.values, gene);
        let is_moved = is_read && known.is_none();
        let moves = if is_moved { alternatives(gene, gene.get(&best.genome)) } else { Vec::new() };
        tried.push(Tried { gene, slot, known, moves, rises: [[None; 2]; 2], is_late: false });
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
    /// Where it is known without a move.
    known: Option<Identifiability>,
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
        let seen = self.known.unwrap_or_else(|| {
            match (self.is_seen(SMALL, tolerance), self.is_seen(LARGE, tolerance)) {
                (true, _) => Identifiability::Determined,
                _ if self.is_late => Identifiability::NotTried,
                (_, true) => Identifiability::Loosely,
                _ => Identifiability::NotSeen,
            }
        });
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
