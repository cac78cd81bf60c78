//! What an optimiser itself costs: asking and telling in the space of the aspen, nothing evaluated.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pleach_fit::{Freedom, Genome, Method, Optimizer, Score, SearchSpace, Start, TreeSeed};
use std::sync::Arc;

fn overhead(criterion: &mut Criterion) {
    let species = pleach_generators::preset("quaking_aspen").expect("a known species");
    let base = species.params.values().to_vec();
    let generator = Arc::clone(&species.generator);
    let tree_seed = TreeSeed::Fixed(1);
    let space = SearchSpace::new(generator, &base, &Freedom::default(), tree_seed).expect("free parameters");
    // A cost that falls slowly, so that nobody restarts.
    let cost = |genome: &Genome| {
        let distance = |(value, base): (&f64, &f64)| (value - base).abs() / (1.0 + base.abs());
        Score::from_cost(genome.values.iter().zip(&base).map(distance).sum())
    };
    let mut group = criterion.benchmark_group("ask and tell, a member");
    group.throughput(Throughput::Elements(1));
    for name in Optimizer::NAMES {
        let optimizer: Optimizer = name.parse().expect("a known name");
        let mut method = optimizer.method(1, Start::Random);
        let mut members = Vec::new();
        group.bench_function(name, |b| {
            b.iter_custom(|count| {
                let mut spent = std::time::Duration::ZERO;
                let mut done = 0;
                while done < count {
                    members.clear();
                    let asked = std::time::Instant::now();
                    method.ask(&space, &mut members);
                    spent += asked.elapsed();
                    let scores: Vec<Score> = members.iter().map(cost).collect();
                    let told = std::time::Instant::now();
                    method.tell(&space, &members, &scores);
                    spent += told.elapsed();
                    done += members.len() as u64;
                }
                spent.mul_f64(count as f64 / done as f64)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, overhead);
criterion_main!(benches);
