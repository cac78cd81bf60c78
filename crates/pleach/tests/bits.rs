//! Trees, silhouettes and searches have the same bits on every platform: those of `tests/data/bits.csv`, which the
//! page's tests compare with what WebAssembly gives.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach::{Bitmap, BlendMap, Control, Effort, FitOptions, MapSettings, Point, View, fit_picture};
use pleach_tree::Fnv;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

fn ink(picture: &Bitmap) -> u64 {
    let rows = (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
    Fnv::hash(&rows.map(|(x, y)| u8::from(picture.get(x, y))).collect::<Vec<u8>>())
}

/// What is compared, and its hash: every species' tree 1 and its silhouette, points of the map, and a fit of the
/// palm among the targets by 300 trees.
fn bits(root: &Path) -> String {
    let mut text = String::from("what,hash\n");
    for name in pleach::species_names() {
        let tree = pleach::species(name).unwrap().grow(1).unwrap();
        writeln!(text, "tree {name},{:016x}", tree.digest()).unwrap();
        writeln!(text, "silhouette {name},{:016x}", ink(&pleach::silhouette(&tree, View::FRONT, 256)))
            .unwrap();
    }
    let species = pleach::HEWITT_2017.iter().map(|name| pleach::species(name).unwrap()).collect();
    let map = BlendMap::new(species, MapSettings::default()).unwrap();
    for (x, y) in [(0.2, -0.4), (-0.5, 0.3), (0.0, 0.0), (2.5, 1.5)] {
        let blend = map.at(Point { x, y }).unwrap();
        let toml = map.species_at(&blend, "blend").to_toml(&[]);
        writeln!(text, "map {x} {y},{:016x}", Fnv::hash(toml.as_bytes())).unwrap();
    }
    writeln!(text, "fit palm,{:016x}", Fnv::hash(fitted(root).as_bytes())).unwrap();
    text
}

/// The species file that a fit of 300 trees finds.
fn fitted(root: &Path) -> String {
    let options =
        FitOptions { height: 14.0, evaluations: Some(300), individual: Effort::Off, ..FitOptions::default() };
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let palm = root.join("targets/palm.png");
    let report = fit_picture(palm.as_path(), &options, Control::new(&clock, &stop)).unwrap();
    report.best().species.to_toml(&[])
}

/// If what they are of has changed, `PLEACH_BLESS=1 cargo test -p pleach --test bits` rewrites them.
#[test]
fn bits_are_those_of_every_platform() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (path, found) = (root.join("tests/data/bits.csv"), bits(&root));
    if std::env::var_os("PLEACH_BLESS").is_some() {
        std::fs::write(&path, &found).unwrap();
    }
    let known = std::fs::read_to_string(&path).unwrap();
    for (found, known) in found.lines().zip(known.lines()) {
        assert_eq!(found, known);
    }
    assert_eq!(found.lines().count(), known.lines().count());
}
