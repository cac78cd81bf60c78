//! How much of many threads a search would use: its trees are scored on one thread and timed, and distributed over
//! threads that are only counted, in the order in which a fit scores them; and what the same trees would make of
//! the threads if all waited for the end of each generation.
//!
//! `cargo run --release -p pleach-fit --example efficiency [EVALUATIONS [GOAL…]]`, on Linux; breeding is
//! taken to cost nothing.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use pleach_fit::{
    AskTell as _, Evaluate as _, Evaluator, Evolution, EvolutionSettings, FIT_LIMITS, Freedom, Objective,
    Score, Search, SearchSpace, Start, TreeSeed,
};
use std::collections::VecDeque;
use std::slice;
use std::sync::Arc;

#[path = "../tests/it/common.rs"]
mod common;

const GOALS: [&str; 6] =
    ["quaking_aspen", "acer", "black_oak", "weeping_willow", "balsam_fir", "silver_birch"];
/// The species that searches start from: like none of the goals, and none of them.
const STARTS: [&str; 2] = ["hill_cherry", "european_larch"];
const THREADS: [usize; 4] = [2, 4, 8, 16];

/// Seconds of processor time that this thread has taken.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux counts it");
    let nanoseconds = text.split(' ').next().and_then(|first| first.parse::<f64>().ok());
    nanoseconds.expect("a number") * 1e-9
}

/// Threads that take one tree after the other, in order.
struct Pool {
    /// When each will be done.
    busy_until: Vec<f64>,
    now: f64,
    worked: f64,
}

impl Pool {
    fn new(threads: usize) -> Self {
        Self { busy_until: vec![0.0; threads], now: 0.0, worked: 0.0 }
    }

    /// When a tree will be done that is asked for now and takes `seconds`.
    fn work(&mut self, seconds: f64) -> f64 {
        let next = self.busy_until.iter_mut().min_by(|a, b| a.total_cmp(b)).expect("at least one thread");
        *next = next.max(self.now) + seconds;
        self.worked += seconds;
        *next
    }

    /// The share of its threads' time that was made use of.
    fn efficiency(&self) -> f64 {
        let end = self.busy_until.iter().copied().fold(0.0, f64::max);
        self.worked / (end * self.busy_until.len() as f64)
    }
}

/// What a search of `evaluations` trees makes of each number of [`THREADS`], and what it would with barriers.
fn efficiencies(goal: &str, start: &Start, evaluations: u64) -> [[f64; 4]; 2] {
    let settings = EvolutionSettings::default();
    let (first, generation) = (settings.first, settings.children);
    let problem = common::goal_of(goal, 1, 256);
    let evaluator = Evaluator::new(&problem, Objective::Balance, FIT_LIMITS).expect("a good problem");
    let evaluator = evaluator.with_height_matching();
    let base = problem.start.params.values();
    let generator = Arc::clone(&problem.start.generator);
    let space = SearchSpace::new(generator, base, &Freedom::default(), TreeSeed::Fixed(1));
    let mut space = space.expect("numbers to search");
    start.lists().iter().for_each(|list| space.widen(list).expect("a species' numbers"));
    let space = space.plausible(start.lists().first().map_or(base, Vec::as_slice)).settling(true);
    let mut search = Search::new(Evolution::new(settings, 1, start.clone()), start, Arc::new(space));
    search.evaluation_limit = evaluations;

    let mut pools = THREADS.map(Pool::new);
    let mut times = Vec::new();
    let mut queued: VecDeque<(Score, [f64; 4])> = VecDeque::new();
    while !search.has_ended() {
        loop {
            let batch = search.ask();
            if batch.genomes.is_empty() {
                break;
            }
            for genome in batch.genomes {
                let before = processor_time();
                let score = evaluator.scores(slice::from_ref(genome), batch.max_size)[0];
                let seconds = processor_time() - before;
                times.push(seconds);
                queued.push_back((score, pools.each_mut().map(|pool| pool.work(seconds))));
            }
        }
        // A batch ends with the last of its trees.
        let collected: Vec<(Score, [f64; 4])> = queued.drain(..search.awaited()).collect();
        for (i, pool) in pools.iter_mut().enumerate() {
            pool.now = collected.iter().fold(pool.now, |now, (_, done)| now.max(done[i]));
        }
        let _ = search.tell(&collected.iter().map(|(score, _)| *score).collect::<Vec<_>>());
    }
    let mut waiting = THREADS.map(Pool::new);
    let (first, others) = times.split_at(first.min(times.len()));
    for generation in std::iter::once(first).chain(others.chunks(generation)) {
        for pool in &mut waiting {
            let before = pool.now;
            pool.now = generation.iter().map(|seconds| pool.work(*seconds)).fold(before, f64::max);
        }
    }
    [waiting, pools].map(|pools| pools.map(|pool| pool.efficiency()))
}

fn report(evaluations: u64, goals: &[String]) {
    let list = |name| pleach_generators::preset(name).expect("a known species").params.values().to_vec();
    let starts =
        [("random lists", Start::Random), ("other species", Start::Lists(STARTS.map(list).to_vec()))];
    println!("{:16} {:14} {:8} {}", "goal", "start", "", THREADS.map(|n| format!("{n:>6}")).concat());
    for goal in goals {
        for (from, start) in &starts {
            let rows = efficiencies(goal, start, evaluations);
            for (name, row) in ["barriers", "stream"].iter().zip(rows) {
                println!("{goal:16} {from:14} {name:8} {}", row.map(|x| format!("{x:6.2}")).concat());
            }
        }
    }
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
