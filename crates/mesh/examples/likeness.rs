//! How alike a species' meshes are to its silhouette and to each other, level by level.

#[path = "../tests/support/mod.rs"]
mod support;

use pleach_mesh::{Mesh, MeshSettings, lod};
use pleach_silhouette::{Bitmap, Frame, Rasteriser, View};

fn main() {
    let levels = if std::env::var("TOLERANCE").is_ok() { 1 } else { 5 };
    let only: Vec<String> = std::env::args().skip(1).collect();
    println!("species,foliage,iou_512,level,triangles,iou_256");
    for name in
        pleach_generators::names().into_iter().filter(|n| only.is_empty() || only.iter().any(|o| o == n))
    {
        let species = pleach_generators::preset(name).unwrap();
        for foliage in [true, false] {
            let tree = if foliage { species.grow(1) } else { species.grow_bare(1) }.unwrap();
            let tolerance = std::env::var("TOLERANCE").ok().and_then(|t| t.parse().ok()).unwrap_or(0.002_f64);
            let mut settings = MeshSettings::with_tolerance(tolerance);
            let frame = Frame::automatic(&tree, &View::FRONT, foliage, 512, 512);
            if tolerance == 1.0 {
                settings =
                    MeshSettings { tolerance: 0.1 * frame.metres_per_pixel, min_sides: 16, ..settings };
            }
            let mut direct = Bitmap::new(512, 512);
            Rasteriser::new().draw(&tree, &View::FRONT, &frame, foliage, &mut direct);
            let mesh = Mesh::of(&tree, settings);
            let iou = support::iou(&direct, &support::silhouette(&mesh, &View::FRONT, &frame));
            let small = frame.scaled(256, 256);
            let finest = support::silhouette(&mesh, &View::FRONT, &small);
            for n in 0..levels {
                let level = lod::level(&tree, settings, n);
                let mesh = Mesh::of(&level.tree, level.settings);
                let like = support::iou(&finest, &support::silhouette(&mesh, &View::FRONT, &small));
                println!("{name},{foliage},{iou:.4},{n},{},{like:.4}", mesh.triangles());
            }
        }
    }
}
