//! Stems of a level of detail that are one surface, in as many triangles as their tubes would have.

use super::boxes::Boxes;
use super::unroll::Unrolled;
use super::{Shape, Stems, WeldError, WeldSettings, closed};
use crate::block::{Block, Vertex};
use crate::decimate::Surface;
use crate::lod::Level;
use glam::Vec3;
use pleach_plant::Tree;
use rayon::prelude::*;

/// Welded stems, and which of a tree's these are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// The surface; empty where no stem is welded.
    pub bark: Block,
    /// Of each vertex of the surface, the number of the stem that is nearest to it: the same for all in one place, so that
    /// what moves the surface by its stems does not tear it.
    pub nearest: Vec<u32>,
    /// Whether each stem is part of the surface.
    pub stems: Vec<bool>,
}

impl Skin {
    /// All stems of `tree`, however many triangles that takes. With `is_unrolled` a picture of bark can be laid on it, for
    /// which corners are there more than once; without it every edge has two triangles, and texture coordinates are 0
    /// and the height in metres.
    ///
    /// # Errors
    /// See [`WeldError`].
    pub fn whole(tree: &Tree, settings: &WeldSettings, is_unrolled: bool) -> Result<Self, WeldError> {
        let stems = vec![true; tree.stems.len()];
        let shape = Shape::new(tree, settings, &stems)?;
        let (corners, triangles) = shape.surface()?;
        let bark = closed(corners, triangles);
        Ok(shape.skin(tree, bark, stems, is_unrolled))
    }

    /// The stems of `level` that are at least a cell thick in radius where they begin, in at most as many triangles as
    /// their tubes have; thinner ones stay tubes, which begin inside of the surface. Ends that are thinner than a cell
    /// are as thin as they should be. Cells are no finer than the level's
    /// tolerance. Where the surface does not fit into so few triangles, no stem is welded.
    ///
    /// # Errors
    /// See [`WeldError`].
    pub fn of_level(
        level: &Level<'_>,
        settings: &WeldSettings,
        is_unrolled: bool,
    ) -> Result<Self, WeldError> {
        settings.check()?;
        let tree = &*level.tree;
        let cell = settings.cell.max(level.settings.tolerance);
        let settings = WeldSettings { cell, ..*settings };
        let stems = thick(tree, &settings);
        let none = || Self { stems: vec![false; stems.len()], ..Self::default() };
        let thin: Vec<bool> = stems.iter().map(|is_welded| !is_welded).collect();
        let tubes = level.mesher_without(&thin).bark().triangles as usize;
        if tubes == 0 {
            return Ok(none());
        }
        let shape = Shape::new(tree, &settings, &stems)?;
        let (mut corners, triangles) = shape.surface()?;
        shape.slim(&mut corners);
        let mut surface = Surface::new(corners, triangles);
        surface.collapse(tubes);
        if surface.left() > tubes || surface.left() == 0 {
            return Ok(none());
        }
        let (corners, triangles) = surface.compact();
        let bark = closed(corners, triangles);
        Ok(shape.skin(tree, bark, stems, is_unrolled))
    }
}

/// The stems that are at least a cell thick in radius where they begin and that grow from such stems.
fn thick(tree: &Tree, settings: &WeldSettings) -> Vec<bool> {
    let mut is_thick: Vec<bool> = Vec::with_capacity(tree.stems.len());
    for stem in &tree.stems {
        let base = tree.knots_of(stem)[0].radius;
        let stands = stem.parent.is_none_or(|parent| is_thick[parent as usize]);
        is_thick.push(stands && base >= settings.cell && settings.parts.has_stem(stem.kind));
    }
    is_thick
}

impl Shape {
    fn skin(&self, tree: &Tree, bark: Block, stems: Vec<bool>, is_unrolled: bool) -> Skin {
        let Self { cell, stems: Stems { cones, .. }, pieces } = self;
        let bark =
            if is_unrolled { Unrolled::new(tree, &pieces.of_stems, cones, *cell).cut(&bark) } else { bark };
        let mut stem_of = vec![0; cones.len()];
        for (stem, own) in pieces.of_stems.iter().enumerate() {
            stem_of[own.clone()].fill(stem as u32);
        }
        let boxes = Boxes::new(cones);
        let nearest = |vertex: &Vertex| {
            boxes.nearest(vertex.position.as_dvec3()).map_or(0, |cone| stem_of[cone as usize])
        };
        let nearest = bark.vertices.par_iter().map(nearest).collect();
        Skin { bark, nearest, stems }
    }

    /// Moves the corners around stems that are thinner than the grid can see to where their surface is.
    fn slim(&self, corners: &mut [Vec3]) {
        let boxes = Boxes::new(&self.stems.cones);
        corners.par_iter_mut().for_each(|corner| {
            let p = corner.as_dvec3();
            let Some(number) = boxes.nearest(p).map(|cone| cone as usize) else { return };
            let (cone, own) = (&self.stems.cones[number], self.pieces.radii[number]);
            let part = cone.nearest(p);
            let at = |[a, b]: [f64; 2]| a + (b - a) * part;
            let ratio = at(own) / at(cone.radii);
            if ratio < 1.0 {
                let center = cone.from.lerp(cone.to, part);
                *corner = (center + (p - center) * ratio).as_vec3();
            }
        });
    }
}
