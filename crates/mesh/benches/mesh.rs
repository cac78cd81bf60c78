//! Meshing and writing: a small tree, the aspen, and a large one.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use pleach_mesh::write::glb::{Glb, Placed, Scene};
use pleach_mesh::write::{obj, stl};
use pleach_mesh::{Mesh, MeshSettings, Mesher, Palette, lod, send};
use std::hint::black_box;
use std::io::Cursor;

const SPECIES: [&str; 3] = ["acer", "quaking_aspen", "weeping_willow"];

fn meshes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("mesh");
    group.sample_size(10);
    for name in SPECIES {
        let Some(species) = pleach_generators::preset(name) else { continue };
        let Ok(tree) = species.grow(1) else { continue };
        let scene = Scene {
            name: name.to_owned(),
            palette: Palette::new(&species.appearance, None),
            extras: serde_json::Value::Null,
            placed: vec![Placed::at_origin(name, 1)],
            lod_extension: false,
            grid: None,
            rig: None,
            pictures: Vec::new(),
        };
        let mesher = || Mesher::new(&tree, MeshSettings::default());
        group.bench_function(format!("measure/{name}"), |b| b.iter(|| black_box(mesher().count())));
        group.bench_function(format!("memory/{name}"), |b| {
            b.iter(|| black_box(Mesh::new(&tree, MeshSettings::default()).triangles()));
        });
        group.bench_function(format!("glb/{name}"), |b| {
            b.iter_batched_ref(
                || Cursor::new(Vec::with_capacity(256 << 20)),
                |out| send(&[mesher()], &mut Glb::new(out, &scene)),
                BatchSize::PerIteration,
            );
        });
        group.bench_function(format!("stl/{name}"), |b| {
            b.iter(|| send(&[mesher()], &mut stl::Stl::new(std::io::sink())));
        });
        group.bench_function(format!("obj/{name}"), |b| {
            b.iter(|| send(&[mesher()], &mut obj::Obj::new(std::io::sink(), name, "a.mtl")));
        });
        group.bench_function(format!("levels/{name}"), |b| {
            b.iter(|| black_box(lod::levels(&tree, MeshSettings::default(), 4).len()));
        });
    }
    group.finish();
}

criterion_group!(benches, meshes);
criterion_main!(benches);
