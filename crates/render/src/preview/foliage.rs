//! The colours of leaves and blossoms in a picture: those of the sheets that meshes show.

use crate::leaf_atlas;
use crate::picture::{Picture, Relief};
use crate::srgb::decode;
use glam::{Vec2, Vec3};
use pleach_mesh::{Atlas, Material, Palette};
use pleach_plant::Tree;

/// The sheets of a tree.
#[derive(Clone, Debug)]
pub(crate) struct Foliage {
    leaf: Option<Picture>,
    blossom: Option<Picture>,
}

/// Pixels of a leaf's picture, at least and at most.
const CELL: (u32, u32) = (8, 256);

impl Foliage {
    /// The sheets of `tree` for leaves that are seen `pixels` long.
    pub(crate) fn new(tree: &Tree, palette: &Palette, pixels: f32) -> Self {
        let cell = (pixels as u32).clamp(CELL.0, CELL.1).next_power_of_two();
        let across = |shapes: usize| {
            let sheet = Atlas::new(shapes).sheet;
            sheet.columns.max(sheet.rows)
        };
        let side = cell * across(tree.leaf_shapes.len()).max(across(tree.blossom_shapes.len()));
        let (mut leaf, mut blossom) = (None, None);
        for sheet in leaf_atlas::paint(tree, palette, side.min(4096), Relief::Omitted) {
            match sheet.material {
                Material::Blossom => blossom = Some(sheet.color),
                _ => leaf = Some(sheet.color),
            }
        }
        Self { leaf, blossom }
    }

    /// The colour at a place of a sheet, as intensities; `None` where there is no sheet.
    pub(super) fn color(&self, material: Material, uv: Vec2) -> Option<Vec3> {
        let sheet = if material == Material::Blossom { &self.blossom } else { &self.leaf };
        let Picture { width, height, rgba } = sheet.as_ref()?;
        let place = |part: f32, of: u32| ((part * of as f32) as usize).min(of as usize - 1);
        let at = (place(uv.y, *height) * *width as usize + place(uv.x, *width)) * 4;
        Some(Vec3::new(decode(rgba[at]), decode(rgba[at + 1]), decode(rgba[at + 2])))
    }
}
