//! Growing on one thread, memory reused: a regular ternary tree of nine generations (29,524 branches)
//! and the species.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_fractal::FractalFamily;
use pleach_tree::species::preset;
use pleach_tree::{Family, Growth, Species, Tree, Workspace};

fn grow(c: &mut Criterion) {
    let fan = preset(&FractalFamily, "coffey_fan").expect("a built-in species");
    let space = fan.generator.space();
    let set = |set: &[(&str, f64)]| {
        let mut values = fan.params.values().to_vec();
        for (name, value) in set {
            let (param, _) = space.find(name).expect("a parameter");
            values[param] = *value;
        }
        Species { params: space.check(values).expect("allowed values"), ..fan.clone() }
    };
    let mut cases = vec![
        ("ternary_9_plane".to_owned(), set(&[("generations", 9.0)])),
        ("ternary_9_space".to_owned(), set(&[("generations", 9.0), ("dimensions", 2.0)])),
    ];
    let names = FractalFamily.presets().iter().map(|(name, _)| *name);
    cases.extend(names.filter_map(|name| Some((name.to_owned(), preset(&FractalFamily, name)?))));
    for (name, species) in cases {
        let (mut workspace, mut tree, mut seed) = (Workspace::default(), Tree::default(), 0);
        c.bench_function(&name, |b| {
            b.iter(|| {
                // Another tree each time: sizes vary as they do in a fit.
                seed = seed % 20 + 1;
                species.generator.grow(&species.params, &Growth::seed(seed), &mut workspace, &mut tree)
            });
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2)).warm_up_time(std::time::Duration::from_millis(300));
    targets = grow
}
criterion_main!(benches);
