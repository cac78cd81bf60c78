//! Silhouettes of all species as text, as they were when someone last looked at them, roots included.
//!
//! `PLEACH_BLESS=1 cargo test -p pleach-stylised --test it silhouettes` writes them again.

use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_stylised::StylisedFamily;
use pleach_tree::conformance::assert_golden;
use pleach_tree::species::preset;
use pleach_tree::{Family, Parts};
use std::path::Path;

/// Pixels across and down: enough for branches and blobs.
const SIZE: u32 = 72;

fn drawn(name: &str) -> String {
    let tree = preset(&StylisedFamily, name).unwrap().grow(1).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::ALL, SIZE, SIZE);
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::ALL, &mut bitmap);
    bitmap.to_ascii()
}

#[test]
fn species_look_as_they_did() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for (name, _) in StylisedFamily.presets() {
        assert_golden(&folder.join(format!("{name}.txt")), &drawn(name));
    }
}
