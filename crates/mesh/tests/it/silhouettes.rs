//! Silhouettes of meshes, filled triangle by triangle by tiny-skia, against those that are drawn from
//! the tree without a mesh, and levels of detail against each other.

#[path = "../support/mod.rs"]
mod support;

use pleach_mesh::{Mesh, MeshSettings, lod};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use support::{iou, silhouette};

/// Species whose meshes take a moment; `experiments/export` has all of them.
const SPECIES: [&str; 6] = ["quaking_aspen", "acer", "palm", "small_pine", "apple", "lombardy_poplar"];

#[test]
fn meshes_have_the_silhouette_of_their_tree() {
    for name in SPECIES {
        for (view, foliage, least) in [(View::FRONT, true, 0.97), (View::degrees(70.0, 20.0), true, 0.97)] {
            let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
            let frame = Frame::automatic(&tree, &view, Parts::with_foliage(foliage), 512, 512);
            let mut direct = Bitmap::new(512, 512);
            Rasterizer::new().draw(&tree, &view, &frame, Parts::with_foliage(foliage), &mut direct);
            let mesh = Mesh::new(&tree, MeshSettings::default());
            let found = iou(&direct, &silhouette(&mesh, &view, &frame));
            assert!(found >= least, "{name} {view:?}: {found}");
        }
    }
}

/// Twigs of bare trees are thinner than a pixel, and whether one is ink hangs on a tenth of a pixel.
/// What must agree is how much ink there is.
#[test]
fn bare_meshes_have_the_ink_of_their_tree() {
    for name in ["quaking_aspen", "silver_birch", "acer", "hill_cherry", "palm"] {
        let tree = pleach_generators::preset(name).unwrap().grow_bare(1).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::BARE, 512, 512);
        let mut direct = Bitmap::new(512, 512);
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::BARE, &mut direct);
        let mesh = silhouette(&Mesh::new(&tree, MeshSettings::default()), &View::FRONT, &frame);
        let ink = mesh.ink() as f64 / direct.ink() as f64;
        assert!((0.92..=1.09).contains(&ink), "{name}: {ink} times the ink");
        assert!(iou(&direct, &mesh) > 0.88, "{name}: {}", iou(&direct, &mesh));
    }
}

/// Part of a picture that is dark, within the rows that hold any of it.
fn ink_of_reference(name: &str, what: &str) -> f64 {
    let path = format!("{}/../../tests/data/silhouettes/{name}_1_{what}.png", env!("CARGO_MANIFEST_DIR"));
    let mut decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let channels = info.color_type.samples();
    let dark = |x: u32, y: u32| bytes[(y * info.width + x) as usize * channels] < 128;
    ink_in_height(info.width, info.height, dark)
}

/// Ink over the square of the height: the same for any scale of the picture.
fn ink_in_height(width: u32, height: u32, dark: impl Fn(u32, u32) -> bool) -> f64 {
    let rows = (0..height).filter(|&y| (0..width).any(|x| dark(x, y))).count() as f64;
    let ink = (0..height).map(|y| (0..width).filter(|&x| dark(x, y)).count()).sum::<usize>() as f64;
    ink / (rows * rows)
}

/// The reference's trees, drawn in Blender, are other trees of the same species: single ones may have
/// more ink or less, but not all of them. Ours have a tenth less in the middle: the reference's pictures
/// put down twigs and leaves thinner than a pixel more generously than samples do.
#[test]
fn meshes_have_the_ink_of_the_reference() {
    let mut ratios = Vec::new();
    for name in SPECIES.into_iter().chain(["bamboo", "hill_cherry", "black_oak"]) {
        for (foliage, what) in [(true, "front"), (false, "front_bare")] {
            let ours = (1..=3_u64).map(|seed| {
                let species = pleach_generators::preset(name).unwrap();
                let tree = if foliage { species.grow(seed) } else { species.grow_bare(seed) }.unwrap();
                let frame = Frame::automatic(&tree, &View::FRONT, Parts::with_foliage(foliage), 512, 512);
                let seen = silhouette(&Mesh::new(&tree, MeshSettings::default()), &View::FRONT, &frame);
                ink_in_height(512, 512, |x, y| seen.get(x, y))
            });
            let ratio = ours.sum::<f64>() / 3.0 / ink_of_reference(name, what);
            assert!((0.65..1.4).contains(&ratio), "{name} {what}: {ratio} times the ink");
            ratios.push(ratio);
        }
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    assert!((0.82..1.1).contains(&median), "{median} in {ratios:?}");
}

#[test]
fn levels_of_detail_keep_the_silhouette_and_lose_triangles() {
    for name in SPECIES.into_iter().chain(["hill_cherry", "bamboo"]) {
        let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        let levels = lod::levels(&tree, MeshSettings::default(), lod::MAX_LEVELS);
        let mut last = usize::MAX;
        let mut finest = None;
        for (n, level) in levels.iter().enumerate() {
            let mesh = Mesh::new(&level.tree, level.settings);
            assert!(mesh.triangles() < last, "{name}: level {n} has {} triangles", mesh.triangles());
            last = mesh.triangles();
            let seen = silhouette(&mesh, &View::FRONT, &frame);
            let like = iou(finest.get_or_insert_with(|| seen.clone()), &seen);
            let least = [1.0, 0.95, 0.90].get(n).copied().unwrap_or(0.5);
            assert!(like >= least, "{name}: level {n} has an IoU of {like}");
        }
    }
}
