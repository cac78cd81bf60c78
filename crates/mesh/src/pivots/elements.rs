//! Which bodies of a tree are elements, and how far each reaches.

use crate::wind::Bodies;
use glam::{DVec3, Vec3};
use pleach_plant::Tree;

/// What turns about one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// The point, in metres, z up.
    pub pivot: Vec3,
    /// Of length 1, from there to the tip of its first stem.
    pub axis: Vec3,
    /// How far it reaches along the axis, with all that turns with it, in metres.
    pub extent: f32,
    /// Number of the element that carries it; its own for trunks.
    pub parent: u32,
}

/// A tree of more trunks than there may be elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the tree has {found} stems on the ground, and textures for Pivot Painter 2 hold {limit} parts that move: grow fewer, or leave out `pivot_painter`"
)]
pub struct TooManyTrunks {
    /// How many there are.
    pub found: usize,
    /// How many there may be.
    pub limit: usize,
}

/// At most `limit` elements of `tree`, and the number of that of each stem.
pub(super) fn elements(tree: &Tree, limit: usize) -> Result<(Vec<Element>, Vec<u32>), TooManyTrunks> {
    let bodies = Bodies::new(tree);
    let is_kept = kept(tree, &bodies, limit)?;
    let mut elements = Vec::new();
    let mut of_body: Vec<u32> = Vec::with_capacity(is_kept.len());
    for (number, (body, is_kept)) in bodies.all().iter().zip(is_kept).enumerate() {
        let own = elements.len() as u32;
        let parent = if body.parent as usize == number { own } else { of_body[body.parent as usize] };
        of_body.push(if is_kept { own } else { parent });
        if is_kept {
            let knots = tree.knots_of(&tree.stems[body.stem as usize]);
            let along = knots[knots.len() - 1].point - knots[0].point;
            let axis = along.normalize_or(DVec3::Z).as_vec3();
            elements.push(Element { pivot: body.pivot, axis, extent: 0.0, parent });
        }
    }
    let of_stem: Vec<u32> = bodies.of_stems().iter().map(|body| of_body[*body as usize]).collect();
    reach(tree, &mut elements, &of_stem);
    Ok((elements, of_stem))
}

/// Whether each body is an element: trunks before limbs and limbs before twigs, the longest of each first. What carries
/// an element is then one too.
fn kept(tree: &Tree, bodies: &Bodies, limit: usize) -> Result<Vec<bool>, TooManyTrunks> {
    let all = bodies.all();
    if all.len() <= limit {
        return Ok(vec![true; all.len()]);
    }
    let found = all.iter().filter(|body| body.level == 0).count();
    if found > limit {
        return Err(TooManyTrunks { found, limit });
    }
    let lengths: Vec<f64> = all.iter().map(|body| tree.length_of(&tree.stems[body.stem as usize])).collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| all[a].level.cmp(&all[b].level).then(lengths[b].total_cmp(&lengths[a])));
    let mut is_kept = vec![false; all.len()];
    order[..limit].iter().for_each(|&body| is_kept[body] = true);
    Ok(is_kept)
}

/// Gives `elements` their extents.
fn reach(tree: &Tree, elements: &mut [Element], of_stem: &[u32]) {
    let mut add = |stem: u32, point: Vec3| {
        let element = &mut elements[of_stem[stem as usize] as usize];
        element.extent = element.extent.max((point - element.pivot).dot(element.axis));
    };
    for (i, stem) in tree.stems.iter().enumerate() {
        tree.knots_of(stem).iter().for_each(|knot| add(i as u32, knot.point.as_vec3()));
    }
    for leaf in tree.leaves.iter().chain(&tree.blossoms) {
        add(leaf.stem, leaf.position + leaf.along);
    }
    for blob in &tree.blobs {
        tree.blob_vertices[blob.vertices()].iter().for_each(|point| add(blob.stem, *point));
    }
}
