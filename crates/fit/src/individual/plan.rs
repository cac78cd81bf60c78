//! The order in which stems get other draws.

use pleach_tree::Tree;

/// Trees of a batch. Exchanges are decided after a batch, so that they do not depend on the number of threads.
pub(super) const BATCH: u32 = 8;
/// Batches of a stage.
const BATCHES: u32 = 4;
/// Batches of the first stage, in which whole trees are drawn: one candidate per tree, instead of one per stem.
const FIRST_BATCHES: u32 = 4;
/// Share of the budget for whole trees.
const FIRST_SHARE: f64 = 0.12;
/// Generations with more stems are not changed.
const MAX_UNITS: usize = 6000;

/// Some batches of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stage {
    /// The generation of the stems.
    pub(super) generation: u16,
    /// Whether they are drawn again, or only turned.
    pub(super) reseeds: bool,
    /// Distance of new draws from the present ones, relative to their spread.
    pub(super) reach: f64,
    pub(super) batches: u32,
    /// The used share of the budget at which it ends, even if batches are left.
    pub(super) until: f64,
}

/// The generations beyond the trunks of `tree` whose stems are drawn again: those with not too many stems.
pub(super) fn generations(tree: &Tree) -> Vec<u16> {
    let mut of_stems: Vec<u16> = Vec::with_capacity(tree.stems.len());
    let mut counts: Vec<usize> = Vec::new();
    for stem in &tree.stems {
        let generation = stem.parent.map_or(0, |parent| of_stems[parent as usize].saturating_add(1));
        of_stems.push(generation);
        let index = usize::from(generation);
        counts.resize(counts.len().max(index + 1), 0);
        counts[index] += 1;
    }
    let some = (0..).zip(counts).skip(1).filter(|(_, count)| (1..=MAX_UNITS).contains(count));
    some.map(|(generation, _)| generation).collect()
}

/// The stages of a tree: whole trees first, then these generations in turn, without end.
pub(super) fn stages(generations: &[u16]) -> impl Iterator<Item = Stage> + '_ {
    let whole = [
        Stage { generation: 0, reseeds: true, reach: 1.0, batches: FIRST_BATCHES, until: FIRST_SHARE },
        Stage { generation: 0, reseeds: false, reach: 0.3, batches: 1, until: FIRST_SHARE },
    ];
    let stage =
        |generation, reseeds, reach| Stage { generation, reseeds, reach, batches: BATCHES, until: 1.0 };
    // Turns get smaller from round to round.
    let reaches = (1..).map(|round| (0.5 / f64::from(round)).max(0.1));
    let round = move |reach: f64| {
        generations
            .iter()
            .flat_map(move |&generation| [stage(generation, true, 1.0), stage(generation, false, reach)])
    };
    let rounds = if generations.is_empty() { 0 } else { usize::MAX };
    whole.into_iter().chain(reaches.take(rounds).flat_map(round))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generations_that_are_too_many_are_left_out_and_no_stage_is_without_stems() {
        let grown = |name: &str| pleach_generators::preset(name).unwrap().grow(1).unwrap();
        assert_eq!(generations(&grown("palm")), [1]);
        let willow = grown("weeping_willow");
        let chosen = generations(&willow);
        assert!(chosen.contains(&1) && willow.stems.len() > MAX_UNITS, "{chosen:?}");
        // Without branches there are only whole trees.
        assert_eq!(stages(&[]).count(), 2);
        let first: Vec<(u16, bool)> = stages(&[1, 3]).take(8).map(|s| (s.generation, s.reseeds)).collect();
        let round = [(1, true), (1, false), (3, true), (3, false)];
        assert_eq!(first, [&[(0, true), (0, false)], &round[..], &round[..2]].concat());
    }
}
