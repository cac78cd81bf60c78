//! Growing every species on one thread, stems and leaves, memory reused.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_tree::{Foliage, Growth, Tree, Workspace};
use pleach_weber_penn::{HEWITT_2017, preset};

fn grow(c: &mut Criterion) {
    for name in HEWITT_2017 {
        let species = preset(name).expect("a built-in species");
        let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
        for (what, foliage) in [("whole", Foliage::All), ("stems", Foliage::None)] {
            let mut seed = 0;
            c.bench_function(&format!("{name}/{what}"), |b| {
                b.iter(|| {
                    // Another tree each time: sizes vary as they do in a fit.
                    seed = seed % 20 + 1;
                    let growth = Growth { foliage, ..Growth::seed(seed) };
                    species.generator.grow(&species.params, &growth, &mut workspace, &mut tree)
                });
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2)).warm_up_time(std::time::Duration::from_millis(300));
    targets = grow
}
criterion_main!(benches);
