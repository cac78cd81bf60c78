//! What the numbers of files are made into.

use glam::DVec3;
use pleach_tree::leaf_shape::{BlossomShape, LeafShape};

/// The next `N` values.
pub(super) fn next<const N: usize>(values: &mut &[f64]) -> [f64; N] {
    let (taken, rest) = values.split_first_chunk().expect("checked values are one for each slot");
    *values = rest;
    *taken
}

pub(super) const fn number([value]: [f64; 1]) -> f64 {
    value
}

pub(super) const fn whole([value]: [f64; 1]) -> i64 {
    value as i64
}

pub(super) const fn count([value]: [f64; 1]) -> u32 {
    value as u32
}

pub(super) const fn size([value]: [f64; 1]) -> usize {
    value as usize
}

pub(super) const fn vector(values: [f64; 3]) -> DVec3 {
    DVec3::from_array(values)
}

pub(super) fn leaf_shape([value]: [f64; 1]) -> LeafShape {
    LeafShape::from_number(value as i64).unwrap_or_default()
}

pub(super) fn blossom_shape([value]: [f64; 1]) -> BlossomShape {
    BlossomShape::from_number(value as i64).unwrap_or_default()
}

/// A level's number as it is.
pub(super) const fn plain(value: f64) -> f64 {
    value
}

/// Segments of a stem, at least 1.
pub(super) fn segments(value: f64) -> u32 {
    (value as u32).max(1)
}
