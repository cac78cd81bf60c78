//! Pictures of trees of other programs: those of `targets/foreign.csv`, so that the exam needs no file.

/// A name, and the file.
macro_rules! pictures {
    ($($name:literal,)*) => {
        [$(($name, include_bytes!(concat!("foreign/", $name, ".png")).as_slice()),)*]
    };
}

const PICTURES: [(&str, &[u8]); 10] = pictures![
    "arbaro_black_tupelo",
    "arbaro_lombardy_poplar",
    "eztree_oak_large_cards",
    "sapling_small_maple",
    "sapling_white_birch",
    "treegen_acer_bare",
    "treegen_apple_bare",
    "treegen_black_oak",
    "treegen_quaking_aspen",
    "treegen_small_pine",
];

/// Their names.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    PICTURES.iter().map(|(name, _)| *name)
}

/// The bytes of the PNG of this name.
pub(super) fn picture(name: &str) -> Option<&'static [u8]> {
    PICTURES.iter().find(|(known, _)| *known == name).map(|(_, bytes)| *bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// A file that is not the same is copied again: `cp targets/NAME.png crates/experiments/src/bench/foreign/`.
    #[test]
    fn they_are_the_files_of_targets() {
        let targets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../targets");
        let list = std::fs::read_to_string(targets.join("foreign.csv")).unwrap();
        let mut listed: Vec<&str> =
            list.lines().skip(1).filter_map(|line| line.split_once(".png,").map(|(name, _)| name)).collect();
        listed.sort_unstable();
        assert_eq!(listed, names().collect::<Vec<_>>());
        for name in names() {
            let file = std::fs::read(targets.join(name).with_extension("png")).unwrap();
            assert!(picture(name) == Some(file.as_slice()), "{name} is not that of targets/");
        }
    }
}
