//! The textures that Unreal's material functions *Pivot Painter 2* read.

use super::ExportError;
use pleach_mesh::Pivots;
use pleach_render::Picture;

/// The files of positions, in half floats, and of axes, as a PNG.
pub(super) fn files(pivots: &Pivots) -> Result<[Vec<u8>; 2], ExportError> {
    let size = pivots.size();
    let axes = Picture { width: size.x, height: size.y, rgba: pivots.axes().concat() };
    let mut png = Vec::new();
    axes.write_png(&mut png).map_err(ExportError::Picture)?;
    Ok([pivots.positions_exr(), png])
}
