//! Time of derivation and of growing, on one thread.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_lsystem::{Derivation, LSystem, LSystemFamily};
use pleach_tree::{Growth, Tree, Workspace};
use std::hint::black_box;

fn derivation(c: &mut Criterion) {
    let cases = [
        // 15.6 million modules.
        ("plane", "axiom: F-F-F-F\nF -> F-F+F+FF-F-F+F", 7),
        // 1.3 million modules with numbers.
        (
            "parametric",
            "axiom: A(1, 10)\nA(l, w) -> !(w) F(l) [ +(30) A(l*0.9, w*0.7) ] [ -(30) A(l*0.8, w*0.7) ]",
            17,
        ),
    ];
    for (name, text, steps) in cases {
        let system = LSystem::read(name, text).expect("the grammar is right");
        let derivation = Derivation { steps: Some(steps), ..Derivation::default() };
        c.bench_function(name, |b| b.iter(|| black_box(system.derive(&derivation).map(|d| d.len()))));
    }
}

fn growing(c: &mut Criterion) {
    let species =
        pleach_tree::species::preset(&LSystemFamily, "hewitt_quaking_aspen").expect("a built-in species");
    let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
    c.bench_function("aspen", |b| {
        b.iter(|| species.generator.grow(&species.params, &Growth::seed(1), &mut workspace, &mut tree));
    });
}

criterion_group!(benches, derivation, growing);
criterion_main!(benches);
