//! How often another tree of the goal's species is above what is not.

use super::Rows;
use super::blobs::{self, BLOBS};
use super::measures::{self, MEASURES, Seen, Values};
use super::pictures::Drawn;
use rayon::prelude::*;

/// Comparisons of one kind: against what, how many, and in how many of them each measure was right.
pub(super) struct Asked {
    against: String,
    comparisons: u64,
    right: [u64; MEASURES.len()],
}

impl Asked {
    fn new(against: &str) -> Self {
        Self { against: against.to_owned(), comparisons: 0, right: [0; MEASURES.len()] }
    }

    /// One more comparison; a tie is not right.
    fn count(&mut self, same: &Values, other: &Values) {
        self.comparisons += 1;
        for ((right, same), other) in self.right.iter_mut().zip(same).zip(other) {
            *right += u64::from(same > other);
        }
    }
}

/// Adds the shares that were right, and all kinds together where there are several.
pub(super) fn rows(question: &str, set: &str, asked: &[Asked], rows: &mut Rows) {
    let mut add = |kind: &Asked| {
        for (measure, right) in MEASURES.iter().zip(kind.right) {
            let share = right as f64 / kind.comparisons.max(1) as f64;
            rows.add([question, set, &kind.against, measure], kind.comparisons, share);
        }
    };
    if asked.len() > 1 {
        let mut all = Asked::new("all");
        for kind in asked {
            all.comparisons += kind.comparisons;
            all.right.iter_mut().zip(kind.right).for_each(|(sum, right)| *sum += right);
        }
        add(&all);
    }
    asked.iter().for_each(add);
}

/// For every goal that `asked` wants, every other tree of its species against every tree of other
/// species; a kind for each species of goals.
pub(super) fn species(
    drawn: &[Drawn],
    value: impl Fn(usize, usize) -> Values,
    asked: impl Fn(&Drawn) -> bool,
) -> Vec<Asked> {
    let mut kinds: Vec<Asked> = Vec::new();
    for (g, goal) in drawn.iter().enumerate().filter(|(_, goal)| asked(goal)) {
        if kinds.last().is_none_or(|kind| kind.against != goal.species) {
            kinds.push(Asked::new(&goal.species));
        }
        let Some(kind) = kinds.last_mut() else { continue };
        let (same, others): (Vec<usize>, Vec<usize>) =
            (0..drawn.len()).filter(|&t| t != g).partition(|&t| drawn[t].species == goal.species);
        for &s in &same {
            others.iter().for_each(|&o| kind.count(&value(g, s), &value(g, o)));
        }
    }
    kinds
}

/// For every goal, every other tree of its species against the goal's blobs; a kind for each blob.
pub(super) fn blobs(drawn: &[Drawn], value: impl Fn(usize, usize) -> Values) -> Vec<Asked> {
    let scores: Vec<Vec<Values>> = drawn
        .par_iter()
        .map(|goal| {
            let blobs = blobs::blobs_like(&goal.seen.bitmap).map(Seen::new);
            blobs.iter().map(|blob| measures::compare(&goal.seen, blob)).collect()
        })
        .collect();
    let mut kinds: Vec<Asked> = BLOBS.iter().map(|name| Asked::new(name)).collect();
    for (g, goal) in drawn.iter().enumerate() {
        for (s, _) in drawn.iter().enumerate().filter(|(s, d)| *s != g && d.species == goal.species) {
            for (kind, blob) in kinds.iter_mut().zip(&scores[g]) {
                kind.count(&value(g, s), blob);
            }
        }
    }
    kinds
}
