//! Growing on one thread, memory reused: a scaffold of some 5,000 nodes, and the species with their leaves.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_space_colonization::{SpaceColonization, SpaceColonizationFamily};
use pleach_tree::species::preset;
use pleach_tree::{Family, Generator, Growth, Tree, Workspace};

fn grow(c: &mut Criterion) {
    let space = SpaceColonization.space();
    // Points, length of a step, and apical control: at 0.5 nothing is divided.
    let cases = [500.0, 1000.0, 2000.0, 4000.0].map(|points| (points, 0.45, 0.5));
    let divided = [(4000.0, 0.45, 0.3), (4000.0, 0.45, 0.7)];
    let fine = [0.5, 0.4, 0.6].map(|control| (4000.0, 0.2, control));
    for (points, step, control) in cases.into_iter().chain(divided).chain(fine) {
        let mut values = space.defaults();
        for (name, value) in [("points", points), ("step", step), ("apical_control", control)] {
            let slot = space.slots().find(|slot| space.slot_name(*slot) == name).expect("a parameter");
            values[slot.index()] = value;
        }
        let params = space.check(values).expect("allowed values");
        let mut workspace = Workspace::default();
        let count = |workspace: &mut Workspace, seed| {
            SpaceColonization.scaffold_nodes(&params, &Growth::seed(seed), workspace).expect("it grows")
        };
        let nodes = count(&mut workspace, 1);
        let mut seed = 0;
        c.bench_function(&format!("scaffold of {nodes} nodes, apical control {control}"), |b| {
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
