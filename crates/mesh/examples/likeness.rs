//! How alike a species' meshes are to its silhouette and to each other, level by level, as CSV.
//!
//! `cargo run --release -p pleach-mesh --example likeness -- [SPECIES …]`

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a tool for developers that prints a table")]

#[path = "../tests/support/mod.rs"]
mod support;

use pleach_mesh::{Mesh, MeshSettings, lod};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;

fn main() {
    let only: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &&str| only.is_empty() || only.iter().any(|o| o == name);
    println!("species,foliage,iou_512,level,triangles,iou_256");
    for name in pleach_generators::names().into_iter().filter(wanted) {
        let species = pleach_generators::preset(name).unwrap();
        for foliage in [true, false] {
            let tree = if foliage { species.grow(1) } else { species.grow_bare(1) }.unwrap();
            let frame = Frame::automatic(&tree, &View::FRONT, Parts::with_foliage(foliage), 512, 512);
            let mut direct = Bitmap::new(512, 512);
            Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::with_foliage(foliage), &mut direct);
            let mesh = Mesh::of(&tree, MeshSettings::default());
            let iou = support::iou(&direct, &support::silhouette(&mesh, &View::FRONT, &frame));
            let small = frame.scaled(256, 256);
            let finest = support::silhouette(&mesh, &View::FRONT, &small);
            for n in 0..lod::MAX_LEVELS {
                let level = lod::level(&tree, MeshSettings::default(), n);
                let mesh = Mesh::of(&level.tree, level.settings);
                let like = support::iou(&finest, &support::silhouette(&mesh, &View::FRONT, &small));
                println!("{name},{foliage},{iou:.4},{n},{},{like:.4}", mesh.triangles());
            }
        }
    }
}
