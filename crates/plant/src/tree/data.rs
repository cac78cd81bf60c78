//! A tree as it is written.

use super::{Blob, Knot, Leaf, MalformedTree, Stem, Tree};
use crate::leaf_shape::{BlossomShape, Outline};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The arrays of a tree, unchecked. Those that most generators leave empty may be left out.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TreeData {
    stems: Vec<Stem>,
    knots: Vec<Knot>,
    #[serde(default)]
    leaves: Vec<Leaf>,
    #[serde(default)]
    blossoms: Vec<Leaf>,
    #[serde(default)]
    leaf_shapes: Vec<Outline>,
    #[serde(default)]
    blossom_shapes: Vec<BlossomShape>,
    #[serde(default)]
    blobs: Vec<Blob>,
    #[serde(default)]
    blob_vertices: Vec<Vec3>,
    #[serde(default)]
    blob_triangles: Vec<[u32; 3]>,
}

impl From<Tree> for TreeData {
    fn from(tree: Tree) -> Self {
        Self {
            stems: tree.stems,
            knots: tree.knots,
            leaves: tree.leaves,
            blossoms: tree.blossoms,
            leaf_shapes: tree.leaf_shapes.into_iter().map(Arc::unwrap_or_clone).collect(),
            blossom_shapes: tree.blossom_shapes,
            blobs: tree.blobs,
            blob_vertices: tree.blob_vertices,
            blob_triangles: tree.blob_triangles,
        }
    }
}

impl TryFrom<TreeData> for Tree {
    type Error = MalformedTree;

    fn try_from(data: TreeData) -> Result<Self, MalformedTree> {
        let tree = Self {
            stems: data.stems,
            knots: data.knots,
            leaves: data.leaves,
            blossoms: data.blossoms,
            leaf_shapes: data.leaf_shapes.into_iter().map(Arc::new).collect(),
            blossom_shapes: data.blossom_shapes,
            blobs: data.blobs,
            blob_vertices: data.blob_vertices,
            blob_triangles: data.blob_triangles,
        };
        tree.well_formed()?;
        Ok(tree)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StemKind;
    use crate::leaf_shape::LeafShape;
    use glam::{DVec3, dvec3, vec3};

    fn tree() -> Tree {
        let knot = |z: f64| Knot {
            point: dvec3(0.0, 0.1, z),
            handle_in: dvec3(0.0, 0.0, z - 0.2),
            handle_out: DVec3::Z * (z + 0.2),
            radius: 0.1,
        };
        let stem = Stem {
            parent: None,
            level: 0,
            kind: StemKind::Trunk,
            number: 0,
            offset: 0.0,
            first_knot: 0,
            knot_count: 2,
        };
        let leaf = Leaf {
            position: vec3(0.0, 0.0, 0.7),
            along: vec3(0.1, 0.0, 0.0),
            across: vec3(0.0, 0.1, 0.0),
            stem: 0,
            shape: 0,
        };
        Tree {
            stems: vec![stem],
            knots: vec![knot(0.0), knot(1.0 / 3.0)],
            leaves: vec![leaf],
            blossoms: vec![leaf],
            leaf_shapes: vec![LeafShape::default().outline().clone()],
            blossom_shapes: vec![BlossomShape::Magnolia],
            ..Tree::default()
        }
    }

    #[test]
    fn a_tree_reads_back_bit_for_bit() {
        let tree = tree();
        tree.well_formed().unwrap();
        let text = serde_json::to_string(&tree).unwrap();
        let back: Tree = serde_json::from_str(&text).unwrap();
        assert_eq!(back, tree);
        assert_eq!(back.digest(), tree.digest());
        assert!(back.leaf_shapes[0].half().is_some(), "the mirror of the outline is kept");
        assert_eq!(serde_json::from_str::<Tree>(r#"{"stems": [], "knots": []}"#).unwrap(), Tree::default());
    }

    #[test]
    fn what_is_read_is_checked() {
        let broken = |change: fn(&mut Tree)| {
            let mut tree = tree();
            change(&mut tree);
            let text = serde_json::to_string(&tree).unwrap();
            serde_json::from_str::<Tree>(&text).unwrap_err().to_string()
        };
        assert!(broken(|tree| tree.stems[0].knot_count = 9).contains("stem 0"));
        assert!(broken(|tree| tree.leaves[0].stem = 4).contains("leaf 0"));
        let unknown = serde_json::from_str::<Tree>(r#"{"stems": [], "knots": [], "twigs": []}"#);
        assert!(unknown.unwrap_err().to_string().contains("twigs"));
        let outline = |text: &str| serde_json::from_str::<Outline>(text).map_err(|error| error.to_string());
        let flat = r#"{"name": "flat", "corners": [[0, 0], [1, 1], [2, 2]]}"#;
        assert!(outline(flat).unwrap_err().contains("no area"));
        let odd = r#"{"name": "odd", "corners": [[0, 0], [1, 0], [1, 1]], "half": 2}"#;
        assert!(outline(odd).unwrap().half().is_none(), "nothing mirrors the half");
    }
}
