//! The promises of a tree's arrays, checked.

use super::{Blob, StemKind, Tree};

/// A promise that a tree breaks: a mistake in the generator that grew it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{part} {index} {problem}")]
pub struct MalformedTree {
    /// What kind of part: `stem`, `leaf`, `blossom` or `blob`.
    pub part: &'static str,
    /// Its number in the tree's array.
    pub index: usize,
    /// What is wrong with it, as the end of a sentence.
    pub problem: &'static str,
}

impl Tree {
    /// Checks every promise of the arrays.
    ///
    /// # Errors
    /// The first promise that is broken, for tests and for generators under development.
    pub fn well_formed(&self) -> Result<(), MalformedTree> {
        for index in 0..self.stems.len() {
            self.check_stem(index).map_err(|problem| MalformedTree { part: "stem", index, problem })?;
        }
        let parts = [
            ("leaf", &self.leaves, self.leaf_shapes.len()),
            ("blossom", &self.blossoms, self.blossom_shapes.len()),
        ];
        for (part, leaves, shapes) in parts {
            for (index, leaf) in leaves.iter().enumerate() {
                let at = |problem| Err(MalformedTree { part, index, problem });
                if !(leaf.position.is_finite() && leaf.along.is_finite() && leaf.across.is_finite()) {
                    return at("is not finite");
                }
                if leaf.stem as usize >= self.stems.len() {
                    return at("hangs on a stem that does not exist");
                }
                if usize::from(leaf.shape) >= shapes {
                    return at("has a shape that does not exist");
                }
            }
        }
        for (index, blob) in self.blobs.iter().enumerate() {
            self.check_blob(blob).map_err(|problem| MalformedTree { part: "blob", index, problem })?;
        }
        Ok(())
    }

    fn check_stem(&self, index: usize) -> Result<(), &'static str> {
        let stem = &self.stems[index];
        if stem.knot_count < 2 || stem.knots().end > self.knots.len() {
            return Err("needs at least two knots, inside the array");
        }
        match stem.parent {
            None if stem.level != 0 => return Err("has no parent and is not of level 0"),
            Some(p) if p as usize >= index => return Err("comes before its parent"),
            Some(p) => {
                let parent = self.stems[p as usize].level;
                let expected = if stem.kind == StemKind::Fork { parent } else { parent.saturating_add(1) };
                if stem.kind != StemKind::Root && stem.level != expected {
                    return Err("is not one level below its parent");
                }
            }
            None => {}
        }
        if !stem.offset.is_finite() {
            return Err("has an offset that is not finite");
        }
        for knot in self.knots_of(stem) {
            if !(knot.point.is_finite() && knot.handle_in.is_finite() && knot.handle_out.is_finite()) {
                return Err("has a knot that is not finite");
            }
            if !(knot.radius.is_finite() && knot.radius >= 0.0) {
                return Err("has a radius that is negative or not finite");
            }
        }
        Ok(())
    }

    fn check_blob(&self, blob: &Blob) -> Result<(), &'static str> {
        if blob.stem as usize >= self.stems.len() {
            return Err("hangs on a stem that does not exist");
        }
        let (Some(vertices), Some(triangles)) =
            (self.blob_vertices.get(blob.vertices()), self.blob_triangles.get(blob.triangles()))
        else {
            return Err("reaches beyond the arrays");
        };
        if !vertices.iter().all(|v| v.is_finite()) {
            return Err("is not finite");
        }
        if triangles.iter().flatten().any(|&v| v >= blob.vertex_count) {
            return Err("has a triangle with a vertex that does not exist");
        }
        if triangles.is_empty() || !Blob::is_closed(triangles) {
            return Err("is not a closed surface");
        }
        Ok(())
    }
}
