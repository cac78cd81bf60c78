//! Draws species files, leafy and bare: `sheet OUT.png FILE…`.
use pleach_mesh::Palette;
use pleach_space_colonization::SpaceColonizationFamily;
use pleach_tree::{Foliage, Growth, SpeciesDoc, Tree, Workspace};
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let size: u32 = std::env::var("SIZE").ok().and_then(|s| s.parse().ok()).unwrap_or(330);
    let seeds: Vec<u64> = std::env::var("SEEDS")
        .ok()
        .map(|s| s.split(',').map(|x| x.parse().unwrap()).collect())
        .unwrap_or(vec![1, 2]);
    let files = &args[1..];
    let cols = seeds.len() * 2;
    let (w, h) = (size * cols as u32, size * files.len() as u32);
    let mut rgba = vec![255u8; (w * h * 4) as usize];
    for (row, file) in files.iter().enumerate() {
        let text = std::fs::read_to_string(file).unwrap();
        let species = SpeciesDoc::parse(file, &text)
            .and_then(|d| d.species(&SpaceColonizationFamily))
            .unwrap_or_else(|e| panic!("{e}"));
        for (i, &seed) in seeds.iter().enumerate() {
            for bare in [false, true] {
                let mut ws = Workspace::default();
                let mut tree = Tree::default();
                let t0 = std::time::Instant::now();
                let growth =
                    Growth { foliage: if bare { Foliage::None } else { Foliage::All }, ..Growth::seed(seed) };
                species.generator.grow(&species.params, &growth, &mut ws, &mut tree).unwrap();
                species.generator.grow(&species.params, &growth, &mut ws, &mut tree).unwrap();
                let ms = t0.elapsed().as_secs_f64() * 500.0;
                let levels = tree.level_count();
                let b = tree.knots.iter().map(|k| k.point.z).fold(0.0, f64::max);
                println!(
                    "{} seed {seed} bare {bare}: {ms:.2} ms, {} stems, {} knots, {} leaves, {levels} levels, {b:.1} m high",
                    species.name,
                    tree.stems.len(),
                    tree.knots.len(),
                    tree.leaves.len()
                );
                let palette = Palette::new(&species.appearance, None);
                let p = pleach_render::preview::render(&tree, &palette, size);
                let col = (2 * i + usize::from(bare)) as u32;
                for y in 0..size {
                    for x in 0..size {
                        let from = ((y * size + x) * 4) as usize;
                        let to = (((row as u32 * size + y) * w + col * size + x) * 4) as usize;
                        rgba[to..to + 4].copy_from_slice(&p.rgba[from..from + 4]);
                    }
                }
            }
        }
    }
    let picture = pleach_render::Picture { width: w, height: h, rgba };
    picture.write_png(&mut std::fs::File::create(&args[0]).unwrap()).unwrap();
}
