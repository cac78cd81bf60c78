//! What the numbers of files are made into, where they are not taken as they are.

use pleach_tree::leaf_shape::{BlossomShape, LeafShape};

pub(super) fn leaf_shape(number: i64) -> LeafShape {
    LeafShape::from_number(number).unwrap_or_default()
}

pub(super) fn blossom_shape(number: i64) -> BlossomShape {
    BlossomShape::from_number(number).unwrap_or_default()
}

/// Segments of a stem, at least 1.
pub(super) fn segments(number: u32) -> u32 {
    number.max(1)
}
