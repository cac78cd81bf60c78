//! Individuals of whole searches, evaluated again: what a fit spends its time on, which is not its goal's own tree.
//!
//! They are recorded once, in the target directory, so that two versions of the program evaluate the same ones;
//! remove `recorded.bin` there to record them again.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pleach_fit::{
    AskTell as _, Evaluate, Evaluator, Evolution, EvolutionSettings, FIT_LIMITS, FitProblem, Freedom, Genome,
    GoalView, Objective, Search, SearchSpace, Size, Start, TreeSeed,
};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::path::PathBuf;
use std::slice;
use std::sync::Arc;

const GOALS: [&str; 6] =
    ["quaking_aspen", "acer", "black_oak", "weeping_willow", "balsam_fir", "silver_birch"];
/// The species that searches start from: like none of the goals, and none of them.
const STARTS: [&str; 2] = ["hill_cherry", "european_larch"];
const EVALUATIONS: u64 = 300;
/// Of those recorded, every so many are timed.
const EVERY: [usize; 2] = [1, 6];

fn evaluator(goal: &str) -> (FitProblem, Evaluator) {
    let species = pleach_generators::preset(goal).expect("a known species");
    let tree = species.grow(1).expect("a species grows");
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
    let mut picture = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
    let problem = FitProblem::new(species, GoalView::new(picture, View::FRONT, frame));
    let evaluator = Evaluator::new(&problem, Objective::Balance, FIT_LIMITS).expect("a good problem");
    (problem, evaluator.with_height_matching())
}

/// Everything that a search asks for, and how large its trees may be: from random lists, or from other species.
fn record(problem: &FitProblem, evaluator: &Evaluator, start: Start) -> Vec<(Genome, Size)> {
    let base = problem.start.params.values();
    let generator = Arc::clone(&problem.start.generator);
    let space = SearchSpace::new(generator, base, &Freedom::default(), TreeSeed::Fixed(1));
    let mut space = space.expect("numbers to search");
    start.lists().iter().for_each(|list| space.widen(list).expect("a species' numbers"));
    let space = space.plausible(start.lists().first().map_or(base, Vec::as_slice));
    let method = Evolution::new(EvolutionSettings::default(), 1, start.clone());
    let mut search = Search::new(method, &start, Arc::new(space.settling(true)));
    search.evaluation_limit = EVALUATIONS;
    let mut asked = Vec::new();
    while !search.has_ended() {
        let batch = search.ask();
        asked.extend(batch.genomes.iter().map(|genome| (genome.clone(), batch.max_size)));
        let scores = evaluator.scores(batch.genomes, batch.max_size);
        let _ = search.tell(&scores);
    }
    asked
}

fn starts() -> [Start; 2] {
    let list = |name| pleach_generators::preset(name).expect("a known species").params.values().to_vec();
    [Start::Random, Start::Lists(STARTS.map(list).to_vec())]
}

/// For each goal and start the individuals of a search.
fn recorded() -> Vec<Vec<(Genome, Size)>> {
    let folder = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../target")), PathBuf::from);
    let file = folder.join("recorded.bin");
    if let Ok(bytes) = std::fs::read(&file) {
        return postcard::from_bytes(&bytes).expect("what was recorded: remove it to record again");
    }
    let all: Vec<_> = GOALS
        .iter()
        .flat_map(|goal| {
            let (problem, evaluator) = evaluator(goal);
            starts().map(|start| record(&problem, &evaluator, start))
        })
        .collect();
    std::fs::write(&file, postcard::to_stdvec(&all).expect("plain values")).expect("a folder to write to");
    all
}

fn evaluations(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("recorded");
    group.sample_size(10);
    let mut recorded = recorded().into_iter();
    for goal in GOALS {
        let (_, evaluator) = evaluator(goal);
        for (name, every) in ["random", "others"].into_iter().zip(EVERY) {
            let asked = recorded.next().expect("a search for each goal and start");
            let timed: Vec<&(Genome, Size)> = asked.iter().step_by(every).collect();
            group.throughput(Throughput::Elements(timed.len() as u64));
            group.bench_function(format!("{goal} from {name}"), |b| {
                let cost = |(genome, most): &&(Genome, Size)| {
                    evaluator.scores(slice::from_ref(genome), *most)[0].cost
                };
                b.iter(|| timed.iter().map(cost).fold(0.0, f64::max));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, evaluations);
criterion_main!(benches);
