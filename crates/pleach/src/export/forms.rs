//! How leaves are put into a file, and how it is made smaller.

use pleach_mesh::LeafStyle;
use pleach_mesh::write::Feature;
use serde::{Deserialize, Serialize};

/// How leaves are put into a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LeafForm {
    /// Their outlines.
    #[default]
    Outline,
    /// Two triangles each.
    Simple,
    /// Two crossed cards each, which show a picture of the leaf.
    Cards,
    /// One leaf, placed many times (`EXT_mesh_gpu_instancing` in GLB); always so in USDA.
    Instances,
    /// No leaves and no blossom.
    None,
}

impl LeafForm {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Outline, Self::Simple, Self::Cards, Self::Instances, Self::None];

    /// The name in options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Outline => "outline",
            Self::Simple => "simple",
            Self::Cards => "cards",
            Self::Instances => "instances",
            Self::None => "none",
        }
    }

    /// What only some formats can hold of it.
    #[must_use]
    pub const fn feature(self) -> Option<Feature> {
        match self {
            Self::Cards => Some(Feature::LeafCards),
            Self::Instances => Some(Feature::LeafInstances),
            Self::Outline | Self::Simple | Self::None => None,
        }
    }

    pub(super) const fn style(self) -> LeafStyle {
        match self {
            Self::Outline | Self::Instances => LeafStyle::Outline,
            Self::Simple => LeafStyle::Simple,
            Self::Cards => LeafStyle::CrossedCards,
            Self::None => LeafStyle::None,
        }
    }
}

/// How a GLB file is made smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compression {
    /// Positions and texture coordinates of 16 bits, normals and tangents of 8 (`KHR_mesh_quantization`): a position is
    /// off by up to 1/131,072 of the longest side.
    Quantize,
}

impl Compression {
    /// The name in options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Quantize => "quantize",
        }
    }
}
