//! Idle threads that help with trees of others change no score.

use crate::common::goal_of;
use pleach_fit::{
    AnyEvidence, Evaluate as _, Evaluator, FitProblem, Freedom, Genome, MeasuredSilhouette, Objective, Score,
    SearchSpace, Size, Stream, TreeSeed,
};
use pleach_tree::conformance::Volunteers;
use pleach_tree::{Foliage, Limits};
use std::sync::Arc;

/// Lists around the one that a search starts from, some of them far.
fn genomes(problem: &FitProblem, count: u32) -> Vec<Genome> {
    let (generator, base) = (Arc::clone(&problem.start.generator), problem.start.params.values());
    let space = SearchSpace::new(generator, base, &Freedom::default(), TreeSeed::Fixed(1)).unwrap();
    let near = |i: u32| {
        let mut draws = Stream::at(1, 9, 0, i);
        let mut genome = space.individual(base, 1 + u64::from(i));
        for gene in space.genes() {
            let unit = gene.to_unit(gene.get(&genome)) + 0.01 * f64::from(i) * draws.signed();
            gene.set(&mut genome, gene.from_unit(unit));
        }
        genome
    };
    (0..count).map(near).collect()
}

/// Problems with stems, leaves and blossoms, with and without foliage, of several families and kinds of evidence.
fn problems() -> Vec<(String, FitProblem)> {
    let mut problems = Vec::new();
    for name in ["quaking_aspen", "palm", "apple", "hill_cherry", "weeping_willow", "abop_monopodial_a"] {
        let leafy = goal_of(name, 1, 128);
        let bare = FitProblem { foliage: Foliage::None, ..goal_of(name, 1, 128) };
        let mut measured = goal_of(name, 1, 128);
        measured.goals[0].evidence = Some(AnyEvidence::new(MeasuredSilhouette::default()));
        problems.extend([
            (name.to_owned(), leafy),
            (format!("{name}, bare"), bare),
            (format!("{name}, measured"), measured),
        ]);
    }
    problems
}

/// Few enough of everything that some trees are given up.
const LIMITS: Limits = Limits { stems: 20_000, leaves: 60_000, knots: 60_000, ..Limits::DEFAULT };

fn evaluator(problem: &FitProblem) -> Evaluator {
    Evaluator::new(problem, Objective::Balance, LIMITS).unwrap().with_height_matching()
}

fn alone(problem: &FitProblem, genomes: &[Genome]) -> Vec<Score> {
    let evaluator = evaluator(problem);
    let mut memory = evaluator.workspace();
    genomes.iter().map(|genome| evaluator.evaluate(genome, &mut memory)).collect()
}

#[test]
fn help_changes_no_score() {
    let (mut calls, mut given_up) = (0, 0);
    for (name, problem) in problems() {
        let genomes = genomes(&problem, 8);
        let alone = alone(&problem, &genomes);
        given_up += alone.iter().filter(|score| **score == Score::INVALID).count();
        for (threads, patience) in [(1, 0), (2, 5), (3, 0), (8, 40)] {
            let helpers = Arc::new(Volunteers::new(threads, patience));
            let evaluator = evaluator(&problem).with_helpers(Arc::<Volunteers>::clone(&helpers));
            let scores: Vec<Score> = genomes.iter().map(|genome| evaluator.score(genome)).collect();
            assert_eq!(scores, alone, "{name} on {threads} threads");
            calls += helpers.calls();
        }
    }
    assert!(calls > 500 && given_up > 5, "{calls} calls, {given_up} trees given up");
}

#[test]
fn threads_of_a_pool_change_no_score() {
    for (name, problem) in problems() {
        let genomes = genomes(&problem, 10);
        let alone = alone(&problem, &genomes);
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let evaluator = evaluator(&problem);
            let scores = pool.install(|| evaluator.scores(&genomes, Size::ANY));
            assert_eq!(scores, alone, "{name} on {threads} threads");
            // One tree at a time leaves all others idle.
            let scores: Vec<Score> =
                genomes.iter().map(|genome| pool.install(|| evaluator.score(genome))).collect();
            assert_eq!(scores, alone, "{name}, one after the other on {threads} threads");
        }
    }
}
