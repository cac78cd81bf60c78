//! Growing on one thread, memory reused: a scaffold of some 5,000 nodes, and the species with their leaves.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_space_colonization::{SpaceColonization, SpaceColonizationFamily};
use pleach_tree::species::preset;
use pleach_tree::{Family, Generator, Growth, Tree, Workspace};

fn grow(c: &mut Criterion) {
    let space = SpaceColonization.space();
    for points in [500.0, 1000.0, 2000.0, 4000.0] {
        let mut values = space.defaults();
        let slot = space.slots().find(|slot| space.slot_name(*slot) == "points").expect("a parameter");
        values[slot.index()] = points;
        let params = space.check(values).expect("allowed values");
        let mut workspace = Workspace::default();
        let count = |workspace: &mut Workspace, seed| {
            SpaceColonization.scaffold_nodes(&params, &Growth::seed(seed), workspace).expect("it grows")
        };
        let nodes = count(&mut workspace, 1);
        let mut seed = 0;
        c.bench_function(&format!("scaffold of {nodes} nodes"), |b| {
            b.iter(|| {
                seed = seed % 20 + 1;
                count(&mut workspace, seed)
            });
        });
    }
    for (name, _) in SpaceColonizationFamily.presets() {
        let species = preset(&SpaceColonizationFamily, name).expect("a built-in species");
        let (mut workspace, mut tree, mut seed) = (Workspace::default(), Tree::default(), 0);
        c.bench_function(name, |b| {
            b.iter(|| {
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
