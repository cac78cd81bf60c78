//! An evaluation allocates nothing once its memory is warm.
//!
//! Alone in its program: the counter sees every thread.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "it/common.rs"]
mod common;

use common::goal_of;
use pleach_fit::{Evaluator, FIT_LIMITS, Freedom, Genome, Objective, SearchSpace, Stream, TreeSeed};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::sync::Arc;

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

#[test]
fn warm_evaluations_allocate_nothing() {
    let problem = goal_of("quaking_aspen", 1, 128);
    let tree_seed = TreeSeed::Fixed(1);
    let (generator, base) = (Arc::clone(&problem.start.generator), problem.start.params.values());
    let space = SearchSpace::new(generator, base, &Freedom::default(), tree_seed).unwrap();
    // The goal's own tree, and lists around it: what a search sees in its last hours.
    let genomes: Vec<Genome> = (0..12)
        .map(|i| {
            let mut draws = Stream::at(1, 9, 0, i);
            let mut genome = space.individual(base, 1);
            for gene in space.genes() {
                let unit = gene.to_unit(gene.get(&genome)) + 0.02 * draws.signed();
                gene.set(&mut genome, gene.from_unit(unit));
            }
            genome
        })
        .collect();
    for objective in Objective::ALL {
        let evaluator = Evaluator::new(&problem, objective, FIT_LIMITS).unwrap();
        let mut memory = evaluator.workspace();
        let warm: Vec<_> = genomes.iter().map(|g| evaluator.evaluate(g, &mut memory)).collect();
        assert!(warm.iter().any(|s| s.cost < 0.9), "the lists grow");

        let mut again = warm.clone();
        let region = Region::new(COUNTING);
        for (score, genome) in again.iter_mut().zip(&genomes) {
            *score = evaluator.evaluate(genome, &mut memory);
        }
        let change = region.change();
        assert_eq!((change.allocations, change.reallocations), (0, 0), "{objective}: {change:?}");
        assert_eq!(again, warm, "reused memory leaves no trace in scores");
    }
}
