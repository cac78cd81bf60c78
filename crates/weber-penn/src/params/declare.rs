//! The beginnings of declarations: group, documentation, kind and default.

use super::{HEIGHTS, LEVELS};
use pleach_tree::Param;
use pleach_tree::param::{Kind, table};

/// Where all but a few are defined.
const SOURCE: &str = "Hewitt 2017, Appendix C";
const OURS: &str = "ours";

/// One number.
pub(super) fn scalar(group: &'static str, doc: &'static str, kind: Kind, default: f64) -> Param {
    table::scalar(kind, default).group(group).doc(doc).source(SOURCE)
}

/// One number for each level: 0 the trunk, 3 the deepest twigs and the leaves.
pub(super) fn levels(group: &'static str, doc: &'static str, kind: Kind, default: [f64; LEVELS]) -> Param {
    table::list("level", kind, default).group(group).doc(doc).source(SOURCE)
}

/// A vector.
pub(super) fn vector(group: &'static str, doc: &'static str, kind: Kind, default: [f64; 3]) -> Param {
    table::vector(kind, default).group(group).doc(doc).source(SOURCE)
}

/// What tells trees of one species apart by how they stand; a search has it where its start has it.
pub(super) fn stature(doc: &'static str, kind: Kind, default: f64) -> Param {
    scalar("stature", doc, kind, default).source(OURS).neutral(default).opt_in()
}

/// One number for each of the heights of the crown's outline.
pub(super) fn heights(doc: &'static str, kind: Kind, default: f64) -> Param {
    let default = [default; HEIGHTS];
    table::list("height", kind, default).group("stature").doc(doc).source(OURS).neutral(default[0]).opt_in()
}
