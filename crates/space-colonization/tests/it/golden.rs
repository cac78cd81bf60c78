//! Silhouettes of all species as text, as they were when someone last looked at them.
//!
//! `PLEACH_BLESS=1 cargo test -p pleach-space-colonization golden` rewrites them.

use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_space_colonization::SpaceColonizationFamily;
use pleach_tree::conformance::assert_golden;
use pleach_tree::species::preset;
use pleach_tree::{Family, Parts};
use std::path::Path;

/// Pixels across and down: enough for the main branches.
const SIZE: u32 = 96;

fn drawn(name: &str) -> String {
    let tree = preset(&SpaceColonizationFamily, name).unwrap().grow_bare(1).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::STEMS, SIZE, SIZE);
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::STEMS, &mut bitmap);
    bitmap.to_ascii()
}

#[test]
fn species_look_as_they_did() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/golden");
    for (name, _) in SpaceColonizationFamily.presets() {
        assert_golden(&folder.join(format!("{name}.txt")), &drawn(name));
    }
}
