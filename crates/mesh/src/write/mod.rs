//! Files: GLB, OBJ with MTL, PLY, STL and USDA.
//!
//! | format | up | holds |
//! | --- | --- | --- |
//! | [`glb`] | +y | everything: materials, levels of detail, instances, wind, growth, pixels of pivots, joints and their sway |
//! | [`obj`] | +y | one mesh, materials in a file beside it |
//! | [`ply`] | +z | one mesh, one colour per vertex, wind, growth |
//! | [`stl`] | +z | triangles alone |
//! | [`usda`] | +z | one mesh, materials, leaves as instances |

mod decimal;
mod format;
pub mod glb;
pub mod obj;
pub mod ply;
pub mod stl;
pub mod usda;

pub use format::{Feature, Format};

use crate::part::{MeshError, Part};

/// Checks that `parts` are one plain mesh, which is all that `format` can hold.
fn one_plain_mesh(parts: &[Part], format: &'static str) -> Result<(), MeshError> {
    let unsupported = |what| Err(MeshError::Unsupported { what, format });
    if parts.iter().any(|p| p.mesh != 0) {
        return unsupported("several levels of detail or variants");
    }
    if parts.iter().any(|p| p.instances > 0) {
        return unsupported("instances");
    }
    if parts.iter().any(|p| p.rigged) {
        return unsupported("joints");
    }
    Ok(())
}

/// Sum over `parts`, or an error if it is beyond what `format` counts in 32 bits.
fn total(
    parts: &[Part],
    of: impl Fn(&Part) -> u64,
    what: &'static str,
    format: &'static str,
) -> Result<u32, MeshError> {
    let found = parts.iter().map(of).sum::<u64>();
    let limit = u64::from(u32::MAX);
    u32::try_from(found).map_err(|_| MeshError::TooLarge { what, found, limit, format })
}
