//! Silhouettes of all species against those in `tests/data/silhouettes.txt`: what changes a tree shows
//! in a review. `PLEACH_BLESS=1 cargo test` rewrites the file.

use pleach_least_cost_path::LeastCostPathFamily;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::conformance::assert_golden;
use pleach_tree::{Family, Parts, species};
use std::path::Path;

const SIZE: u32 = 40;
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/silhouettes.txt");

fn drawn() -> String {
    let mut text = String::new();
    for (name, _) in LeastCostPathFamily.presets() {
        let tree = species::preset(&LeastCostPathFamily, name).unwrap().grow(1).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIZE, SIZE);
        let mut bitmap = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut bitmap);
        let rows = bitmap.to_ascii();
        let rows = rows.lines().map(|row| row.trim_end_matches('.')).collect::<Vec<_>>().join("\n");
        text.push_str(&format!("{name}\n{}\n\n", rows.trim_start_matches('\n')));
    }
    text
}

#[test]
fn silhouettes_are_as_they_were() {
    assert_golden(Path::new(FILE), &drawn());
}
