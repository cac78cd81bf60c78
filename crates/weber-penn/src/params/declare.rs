//! The beginnings of declarations: group, documentation, kind and default.

use super::LEVELS;
use pleach_tree::Param;
use pleach_tree::param::{Kind, table};

/// Where all of them are defined.
const SOURCE: &str = "Hewitt 2017, Appendix C";

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
