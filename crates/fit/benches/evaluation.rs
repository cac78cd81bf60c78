//! A whole evaluation (grow, draw, score) at 256², on one thread and on two.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pleach_fit::{Evaluate, Evaluator, FIT_LIMITS, FitProblem, Genome, GoalView, Objective, Size};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::hint::black_box;

fn problem(name: &str) -> FitProblem {
    let species = pleach_generators::preset(name).expect("a known species");
    let tree = species.grow(1).expect("a species grows");
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    FitProblem::new(species, GoalView::new(goal, View::FRONT, frame))
}

fn evaluations(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("evaluation");
    group.sample_size(20);
    for name in ["palm", "quaking_aspen", "black_oak", "weeping_willow"] {
        let problem = problem(name);
        let evaluator = Evaluator::new(&problem, Objective::Blend, FIT_LIMITS).expect("a good problem");
        let genome = Genome::new(problem.start.params.values().to_vec(), 1);
        let mut memory = evaluator.workspace();
        group.throughput(Throughput::Elements(1));
        group.bench_function(name, |b| b.iter(|| evaluator.evaluate(black_box(&genome), &mut memory)));
    }
    let problem = problem("quaking_aspen");
    let evaluator = Evaluator::new(&problem, Objective::Blend, FIT_LIMITS).expect("a good problem");
    let population = vec![Genome::new(problem.start.params.values().to_vec(), 1); 32];
    let most = Size { stems: usize::MAX, leaves: usize::MAX, knots: usize::MAX };
    group.throughput(Throughput::Elements(32));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        group.bench_function(format!("32 aspens, threads {threads}"), |b| {
            b.iter(|| pool.install(|| evaluator.scores(black_box(&population), most)));
        });
    }
    group.finish();
}

criterion_group!(benches, evaluations);
criterion_main!(benches);
