//! What of a tree turns about which point, as textures for Unreal's material functions *Pivot Painter 2*.
//!
//! An **element** is a body of [`crate::wind`]: a trunk, a limb with its forks, or a twig with all that it carries. It has
//! a pixel in two textures of one size, and the texture coordinates of the middle of that pixel are with each of its
//! vertices. Elements are numbered row by row from the top.
//!
//! | texture | red, green, blue | alpha |
//! | --- | --- | --- |
//! | [`Pivots::positions`], half floats | the pivot in centimetres | the number of the element that carries it, its own for trunks |
//! | [`Pivots::axes`], 8 bits | the direction in which the element grows, 0 to 255 for −1 to 1 | how far it reaches in that direction |
//!
//! Axes are those of a mesh that Unreal has read from a GLB file: its x is the tree's x, its y the tree's −y, its z the
//! height.
//!
//! What the functions read is documented by Epic Games ("Pivot Painter Tool 2.0 MAXScript Reference" and "Pivot Painter
//! Tool 2.0 Material Functions", Unreal Engine documentation): 30,000 elements, four levels, reaches of 8 to 2,048 cm in
//! steps of 8. `docs/pivots.md` says where the rest comes from.

mod elements;
mod exr;
mod half;
mod unreal;

pub use elements::{Element, TooManyTrunks};

use elements::elements;
use glam::{UVec2, Vec2, uvec2};
use pleach_plant::{Stem, Tree};

/// The elements of a tree, and where each has its pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Pivots {
    elements: Vec<Element>,
    /// The element of each stem by the stem's first knot, which is the same at all levels of detail; in their order.
    of_knots: Vec<(u32, u32)>,
}

impl Pivots {
    /// The most elements that there are: as many as Epic's documents name. Bits of half floats that are not infinite have
    /// room for 30,720.
    pub const MAX_ELEMENTS: usize = 30_000;

    /// The elements of `tree`. Where there are more than [`Pivots::MAX_ELEMENTS`], the shortest twigs belong to what
    /// carries them, and then the shortest limbs.
    ///
    /// # Errors
    /// If there are more trunks than that.
    pub fn new(tree: &Tree) -> Result<Self, TooManyTrunks> {
        Self::within(tree, Self::MAX_ELEMENTS)
    }

    fn within(tree: &Tree, limit: usize) -> Result<Self, TooManyTrunks> {
        let (elements, of_stem) = elements(tree, limit)?;
        let mut of_knots: Vec<(u32, u32)> =
            tree.stems.iter().zip(of_stem).map(|(stem, element)| (stem.first_knot, element)).collect();
        of_knots.sort_unstable();
        Ok(Self { elements, of_knots })
    }

    /// The elements, each behind the one that carries it.
    #[must_use]
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// Number of the element of `stem`, of the tree or of a level of detail of it.
    fn of_stem(&self, stem: &Stem) -> Option<u32> {
        let found = self.of_knots.binary_search_by_key(&stem.first_knot, |(knot, _)| *knot).ok()?;
        Some(self.of_knots[found].1)
    }

    /// Width and height of the textures in pixels. They are powers of two, so that texture coordinates of 16 bits, which
    /// Unreal makes of those of 32, still meet the middles of pixels exactly.
    #[must_use]
    pub fn size(&self) -> UVec2 {
        let mut size = UVec2::ONE;
        while ((size.x * size.y) as usize) < self.elements.len() {
            if size.x > size.y { size.y *= 2 } else { size.x *= 2 }
        }
        size
    }

    /// Texture coordinates of the middle of an element's pixel, v from the top.
    #[must_use]
    pub fn pixel(&self, element: u32) -> Vec2 {
        let size = self.size();
        (uvec2(element % size.x, element / size.x).as_vec2() + 0.5) / size.as_vec2()
    }

    /// The same for each stem of `tree`, which is theirs or a level of detail of it.
    ///
    /// # Panics
    /// If a stem is of another tree.
    #[must_use]
    pub fn pixels(&self, tree: &Tree) -> Vec<Vec2> {
        let element = |stem| self.of_stem(stem).expect("pivots are of the tree that is meshed");
        tree.stems.iter().map(|stem| self.pixel(element(stem))).collect()
    }

    /// For each pixel of the one texture the bits of four half floats; see [`crate::pivots`].
    #[must_use]
    pub fn positions(&self) -> Vec<[u16; 4]> {
        self.painted(unreal::position)
    }

    /// For each pixel of the other texture four bytes; see [`crate::pivots`].
    #[must_use]
    pub fn axes(&self) -> Vec<[u8; 4]> {
        self.painted(unreal::axis)
    }

    /// The texture of positions as an OpenEXR file.
    #[must_use]
    pub fn positions_exr(&self) -> Vec<u8> {
        exr::file(self.size(), &self.positions())
    }

    /// What `pixel` makes of each element; nothing where none is.
    fn painted<T: Copy + Default>(&self, pixel: impl Fn(&Element) -> [T; 4]) -> Vec<[T; 4]> {
        let size = self.size();
        let mut pixels: Vec<[T; 4]> = self.elements.iter().map(pixel).collect();
        pixels.resize((size.x * size.y) as usize, [T::default(); 4]);
        pixels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(name: &str) -> Tree {
        pleach_generators::preset(name).unwrap().grow_bare(1).unwrap()
    }

    #[test]
    fn pixels_are_hit_in_their_middle_by_half_floats_too() {
        let mut pivots = Pivots::new(&tree("acer")).unwrap();
        for count in [1, 2, 3, 255, 257, Pivots::MAX_ELEMENTS] {
            let one = pivots.elements[0];
            pivots.elements.resize(count, one);
            let size = pivots.size();
            assert!(size.x.is_power_of_two() && size.y.is_power_of_two());
            assert!((size.x * size.y) as usize >= count && size.x <= 256, "{count}: {size}");
            for element in [0, count as u32 / 2, count as u32 - 1] {
                let pixel = pivots.pixel(element);
                let halves = pixel.to_array().map(|uv| half::to_f32(half::from_f32(uv)));
                assert_eq!(halves, pixel.to_array());
                let at = (pixel * size.as_vec2()).floor().as_uvec2();
                assert_eq!(at.x + at.y * size.x, element);
            }
        }
    }

    #[test]
    fn too_many_elements_become_fewer_and_the_shortest_go_first() {
        let tree = tree("weeping_willow");
        let all = Pivots::new(&tree).unwrap();
        let trunks = all.elements.iter().enumerate().filter(|(i, element)| element.parent == *i as u32);
        let trunks = trunks.count();
        for limit in [all.elements.len() - 1, 100, trunks + 1, trunks] {
            let few = Pivots::within(&tree, limit).unwrap();
            assert_eq!(few.elements.len(), limit);
            assert!(few.elements.iter().enumerate().all(|(i, element)| element.parent as usize <= i));
            let kept = |element: &Element| few.elements.iter().any(|other| other.pivot == element.pivot);
            let longest = all.elements.iter().max_by(|a, b| a.extent.total_cmp(&b.extent)).unwrap();
            assert!(kept(longest), "{limit}");
        }
        let error = Pivots::within(&tree, trunks - 1).unwrap_err();
        assert_eq!(error, TooManyTrunks { found: trunks, limit: trunks - 1 });
    }
}
