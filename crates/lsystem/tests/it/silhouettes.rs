//! Small silhouettes of grammars as pictures. `PLEACH_BLESS=1 cargo test --workspace --test it` writes them
//! again.

use pleach_lsystem::LSystemFamily;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use pleach_tree::conformance::assert_golden;
use std::fmt::Write as _;
use std::path::Path;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/silhouettes.txt");
/// Pixels of a side.
const SIDE: u32 = 28;
/// Finer pixels in a row of one: twigs are thinner than a pixel, which is ink if any of it is.
const FINE: u32 = 8;

/// The silhouette of the tree of seed 1, from the front.
fn silhouette(name: &str) -> Bitmap {
    let species =
        pleach_tree::species::preset(&LSystemFamily, name).unwrap_or_else(|| panic!("no species {name}"));
    let tree = species.grow(1).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE * FINE, SIDE * FINE);
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut bitmap);
    let is_ink = |x, y| (0..FINE * FINE).any(|i| bitmap.get(x * FINE + i % FINE, y * FINE + i / FINE));
    Bitmap::from_fn(SIDE, SIDE, is_ink)
}

/// Of the grammars that the file names.
#[test]
fn silhouettes_are_as_they_were() {
    let known = std::fs::read_to_string(FILE).unwrap();
    let names: Vec<&str> = known.lines().filter_map(|line| line.strip_prefix("# ")).collect();
    assert!(names.len() > 15, "{names:?}");
    let mut text = String::new();
    for name in names {
        let _ = write!(text, "# {name}\n{}", silhouette(name).to_ascii());
    }
    assert_golden(Path::new(FILE), &text);
}
