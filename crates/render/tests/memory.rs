//! What a picture takes beside its tree. A process of its own, since its peak is measured.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_mesh::Palette;
use pleach_render::{Preview, PreviewSettings};

/// A number of this process, in megabytes: `VmRSS` is what it takes, `VmHWM` the most that it has taken.
fn megabytes(name: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with(name)).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<f64>().unwrap() / 1024.0
}

#[test]
fn a_dense_crown_is_never_a_mesh() {
    let species = pleach_generators::preset("weeping_willow").unwrap();
    let mut tree = species.grow(1).unwrap();
    tree.shrink_to_fit();
    let palette = Palette::new(&species.appearance, None);
    let settings = PreviewSettings { width: 256, height: 256, ..PreviewSettings::default() };
    // What growing took at most is forgotten, where the system lets us.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let before = megabytes("VmRSS");
    // Each thread has blocks of its own.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let picture = pool.install(|| Preview::new(&tree, &palette, 256).picture(&settings));
    assert!(picture.rgba.iter().any(|value| *value != picture.rgba[0]));
    // Some 30; with all triangles and corners in lists it took 98.
    let taken = megabytes("VmHWM") - before;
    assert!(taken < 48.0, "{taken} MB");
}
