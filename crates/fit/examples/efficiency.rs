//! How much of many threads a search would use: its trees are scored on one thread and timed, and distributed over
//! threads that are only counted, in the order in which a fit scores them. Beside that, what the same trees would make
//! of the threads if all waited for the end of each generation, and if no idle thread helped with trees of others.
//!
//! What help costs is measured: each tree is scored once more for each number of threads, divided among as many, its
//! parts one after the other. `cargo run --release -p pleach-fit --example efficiency [EVALUATIONS [GOAL…]]`, on Unix;
//! breeding is taken to cost nothing, and to call a thread 30 µs.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use dividing::{Divided, Piece};
use machine::Machine;
use pleach_fit::{
    AskTell as _, Evaluate as _, Evaluator, Evolution, EvolutionSettings, FIT_LIMITS, Freedom, Objective,
    Score, Search, SearchSpace, Start, TreeSeed,
};
use std::collections::VecDeque;
use std::slice;
use std::sync::Arc;

#[path = "efficiency/clock.rs"]
mod clock;
#[path = "../tests/it/common.rs"]
mod common;
#[path = "efficiency/dividing.rs"]
mod dividing;
#[path = "efficiency/machine.rs"]
mod machine;

const GOALS: [&str; 6] =
    ["quaking_aspen", "acer", "black_oak", "weeping_willow", "balsam_fir", "silver_birch"];
/// The species that searches start from: like none of the goals, and none of them.
const STARTS: [&str; 2] = ["hill_cherry", "european_larch"];
const THREADS: [usize; 4] = [2, 4, 8, 16];

/// What was timed, to see whether the clock is good enough.
#[derive(Default)]
struct Timed {
    /// Seconds of each tree, undivided.
    trees: Vec<f64>,
    /// Seconds of all trees, divided and not, and of the process meanwhile.
    sum: f64,
    process: f64,
}

/// What a search of `evaluations` trees makes of each number of [`THREADS`]: with barriers, without help, and with it.
fn efficiencies(goal: &str, start: &Start, evaluations: u64, timed: &mut Timed) -> [[f64; 4]; 3] {
    let settings = EvolutionSettings::default();
    let (first, generation) = (settings.first, settings.children);
    let problem = common::goal_of(goal, 1, 256);
    let evaluator = Evaluator::new(&problem, Objective::Balance, FIT_LIMITS).expect("a good problem");
    let divided = Arc::new(Divided::default());
    let evaluator = evaluator.with_height_matching().with_helpers(Arc::<Divided>::clone(&divided));
    let base = problem.start.params.values();
    let generator = Arc::clone(&problem.start.generator);
    let space = SearchSpace::new(generator, base, &Freedom::default(), TreeSeed::Fixed(1));
    let mut space = space.expect("numbers to search");
    start.lists().iter().for_each(|list| space.widen(list).expect("a species' numbers"));
    let space = space.plausible(start.lists().first().map_or(base, Vec::as_slice)).settling(true);
    let mut search = Search::new(Evolution::new(settings, 1, start.clone()), start, Arc::new(space));
    search.evaluation_limit = evaluations;

    let mut machines = [false, true].map(|helps| THREADS.map(|threads| Machine::new(threads, helps)));
    let mut times = Vec::new();
    let mut queued: VecDeque<(Score, usize)> = VecDeque::new();
    while !search.has_ended() {
        loop {
            let batch = search.ask();
            if batch.genomes.is_empty() {
                break;
            }
            for genome in batch.genomes {
                let before = clock::of_process();
                let scored = |threads| {
                    let before = clock::of_thread();
                    let score = || evaluator.scores(slice::from_ref(genome), batch.max_size)[0];
                    let (score, pieces) = divided.among(threads, score);
                    (score, clock::of_thread() - before, pieces)
                };
                // The first time that a tree is grown there may be too little memory for it.
                let (_, warm, _) = scored(0);
                let (score, seconds, _) = scored(0);
                let divided = THREADS.map(scored);
                assert!(
                    divided.iter().all(|(same, ..)| *same == score),
                    "a tree is the same, divided or not"
                );
                timed.process += clock::of_process() - before;
                timed.sum += warm + seconds + divided.iter().map(|(_, seconds, _)| seconds).sum::<f64>();
                timed.trees.push(seconds);
                times.push(seconds);
                for machines in &mut machines {
                    for (machine, (.., pieces)) in machines.iter_mut().zip(&divided) {
                        machine.submit(seconds, pieces);
                    }
                }
                queued.push_back((score, times.len() - 1));
            }
        }
        // A batch ends with the last of its trees.
        let collected: Vec<(Score, usize)> = queued.drain(..search.awaited()).collect();
        for machine in machines.as_flattened_mut() {
            collected.iter().for_each(|(_, tree)| machine.wait_for(*tree));
        }
        let _ = search.tell(&collected.iter().map(|(score, _)| *score).collect::<Vec<_>>());
    }
    let mut waiting = THREADS.map(|threads| Machine::new(threads, false));
    let (first, others) = times.split_at(first.min(times.len()));
    for generation in std::iter::once(first).chain(others.chunks(generation)) {
        for machine in &mut waiting {
            let trees: Vec<usize> =
                generation.iter().map(|&seconds| machine.submit(seconds, &[Piece::Alone(seconds)])).collect();
            trees.into_iter().for_each(|tree| machine.wait_for(tree));
        }
    }
    let [mut rigid, mut helped] = machines;
    [&mut waiting, &mut rigid, &mut helped].map(|machines| machines.each_mut().map(Machine::efficiency))
}

fn report(evaluations: u64, goals: &[String]) {
    let list = |name| pleach_generators::preset(name).expect("a known species").params.values().to_vec();
    let starts =
        [("random lists", Start::Random), ("other species", Start::Lists(STARTS.map(list).to_vec()))];
    println!("{:16} {:14} {:8} {}", "goal", "start", "", THREADS.map(|n| format!("{n:>6}")).concat());
    let (mut timed, mut sums, mut searches) = (Timed::default(), [[0.0; 4]; 3], 0.0);
    let names = ["barriers", "alone", "helped"];
    for goal in goals {
        for (from, start) in &starts {
            let rows = efficiencies(goal, start, evaluations, &mut timed);
            searches += 1.0;
            for ((name, row), sums) in names.iter().zip(rows).zip(&mut sums) {
                println!("{goal:16} {from:14} {name:8} {}", row.map(|x| format!("{x:6.2}")).concat());
                sums.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
            }
        }
    }
    for (name, sums) in names.iter().zip(sums) {
        println!("{:31} {name:8} {}", "mean", sums.map(|x| format!("{:6.3}", x / searches)).concat());
    }
    let mut distinct: Vec<u64> = timed.trees.iter().map(|seconds| seconds.to_bits()).collect();
    distinct.sort_unstable();
    distinct.dedup();
    let share = distinct.len() as f64 / timed.trees.len() as f64;
    println!(
        "clock: {:.3} of the process's time, {share:.3} of the values distinct",
        timed.sum / timed.process
    );
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let evaluations = arguments.next().map_or(1000, |n| n.parse().expect("a number of evaluations"));
    let mut goals: Vec<String> = arguments.collect();
    if goals.is_empty() {
        goals = GOALS.map(str::to_owned).to_vec();
    }
    // Scores are made on the pool: of one thread, this one.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(|| report(evaluations, &goals));
}
