//! The first individuals of a search.

use crate::problem::Genome;
use crate::space::SearchSpace;
use crate::space::Stream;

/// Appends `lists`, if any, and random lists: `count` of them, or a tenth of that where there are lists, which are
/// better than random ones. `draws` gives each member its own stream.
pub(super) fn first(
    space: &SearchSpace,
    lists: &[Vec<f64>],
    count: usize,
    sparsity: f64,
    draws: impl Fn(u32) -> Stream,
    members: &mut Vec<Genome>,
) {
    given(space, lists, &draws, members);
    let count = if lists.is_empty() { count } else { count.div_ceil(10) };
    members.extend((0..count).map(|member| sparse(space, sparsity, &mut draws(member as u32))));
}

/// Appends `lists` as they are, each from several directions if an azimuth is not known.
pub(super) fn given(
    space: &SearchSpace,
    lists: &[Vec<f64>],
    draws: impl Fn(u32) -> Stream,
    members: &mut Vec<Genome>,
) {
    for part in 0..space.directions() {
        for (i, list) in lists.iter().enumerate() {
            let number = part * lists.len() + i;
            let mut draws = draws(u32::MAX - number as u32);
            let mut genome = space.individual(list, SearchSpace::random_seed(&mut draws));
            space.turn(&mut genome, part, &mut draws);
            members.push(genome);
        }
    }
}

/// A random list in which numbers that have a neutral value have it with a chance of up to `sparsity`, drawn
/// separately for each list: bends, variations and forks are absent from most trees.
fn sparse(space: &SearchSpace, sparsity: f64, draws: &mut Stream) -> Genome {
    let mut genome = space.random(draws);
    let share = sparsity * draws.unit();
    for (gene, neutral) in space.genes().iter().filter_map(|gene| Some((gene, gene.neutral()?))) {
        if draws.chance(share) {
            gene.set(&mut genome, neutral);
        }
    }
    genome
}
