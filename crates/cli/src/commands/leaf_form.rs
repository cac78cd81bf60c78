//! What leaves become in a file.

use clap::ValueEnum;

/// How leaves are put into a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Leaves {
    /// Their outlines
    Outline,
    /// Two triangles each
    Simple,
    /// Two crossed cards each, which show a picture of the leaf
    Cards,
    /// One leaf, placed many times (EXT_mesh_gpu_instancing in .glb); always so in .usda
    Instances,
    /// No leaves and no blossom
    None,
}
