//! Leaves that differ from each other: each shape of a tree's leaves in several forms, and the picture of each form in a
//! cell of one sheet.
//!
//! Which form a leaf has follows from where it stands, so that it has the same in every level of detail that has it.

use crate::twigs::Sheet;
use pleach_plant::Leaf;

/// Cells that the shapes of a tree share, if there are no more shapes than that.
const CELLS: usize = 16;
/// Farthest that the tip is moved sideways, in lengths of the blade.
const BEND: f32 = 0.09;
/// Most by which one half is wider than drawn and the other narrower, in parts of its width.
const LEAN: f32 = 0.14;
/// Farthest that the middle of a blade is moved towards tip or base, in its lengths.
const SHIFT: f32 = 0.05;

/// How the forms of some shapes lie on a sheet of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Atlas {
    /// Forms of each shape.
    pub forms: usize,
    /// The cells: the forms of the first shape, then those of the second, and so on.
    pub sheet: Sheet,
}

impl Atlas {
    /// For so many shapes: of one shape there are 16 forms, of more shapes fewer each.
    #[must_use]
    pub fn new(shapes: usize) -> Self {
        let forms = (CELLS / shapes.max(1)).max(1);
        Self { forms, sheet: Sheet::with_room(forms * shapes) }
    }

    /// Number of the form that `leaf` has, below [`Atlas::forms`].
    #[must_use]
    pub fn form_of(&self, leaf: &Leaf) -> usize {
        let mix = |hash: u32, bits: u32| (hash ^ bits).wrapping_mul(0x9e37_79b1).rotate_left(13);
        // Millimetres, so that a rounding elsewhere does not change the form.
        let place = leaf.position.to_array().map(|x| (x * 1000.0).round() as i32 as u32);
        let hash = place.into_iter().fold(0x85eb_ca6b, mix);
        (hash >> 8) as usize % self.forms
    }

    /// Number of the cell of a form of a shape.
    #[must_use]
    pub const fn cell(&self, shape: usize, form: usize) -> usize {
        shape * self.forms + form
    }
}

/// What makes one form of a shape: a map of the blade's plane that keeps base and tip apart and folds nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Form {
    /// How far the tip is moved across, in lengths of the blade.
    bend: f32,
    /// By what part the right half is wider.
    lean: f32,
    /// How far the middle is moved towards the tip, in lengths of the blade.
    shift: f32,
}

/// Numbers from −1 to 1 that are evenly spread over the forms, another row of them for each `step`; 0 for form 0.
#[must_use]
pub fn spread(form: usize, step: f32) -> f32 {
    if form == 0 { 0.0 } else { 2.0 * (form as f32 * step).fract() - 1.0 }
}

impl Form {
    /// Form number `form`; the first is the shape as it is drawn.
    #[must_use]
    pub fn new(form: usize) -> Self {
        Self {
            bend: BEND * spread(form, 0.618_034),
            lean: LEAN * spread(form, 0.754_878),
            shift: SHIFT * spread(form, 0.569_840),
        }
    }

    /// Where a point of the shape is in this form: (u, v), u across and v from the base (0) to the tip (1).
    #[must_use]
    pub fn place(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let y = y + self.shift * bulge(y);
        let wider = if x > 0.0 { 1.0 + self.lean } else { 1.0 - self.lean };
        [x * wider + self.bend * y * y, y]
    }

    /// The point of the shape that is at `place` in this form.
    #[must_use]
    pub fn origin(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let x = x - self.bend * y * y;
        let wider = if x > 0.0 { 1.0 + self.lean } else { 1.0 - self.lean };
        // The slope of the shift is at most 0.2, so that each round leaves a fifth of the error.
        let mut from = y;
        for _ in 0..4 {
            from = y - self.shift * bulge(from);
        }
        [x / wider, from]
    }

    /// An outline in this form.
    #[must_use]
    pub fn outline(&self, corners: &[[f32; 2]]) -> Vec<[f32; 2]> {
        corners.iter().map(|&corner| self.place(corner)).collect()
    }
}

/// 0 at base and tip and beyond, 1 in the middle.
fn bulge(y: f32) -> f32 {
    4.0 * (y * (1.0 - y)).max(0.0)
}

/// Left, bottom, right and top of what `corners` reach.
#[must_use]
pub fn bounds(corners: &[[f32; 2]]) -> [f32; 4] {
    let start = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
    corners.iter().fold(start, |[left, bottom, right, top], &[x, y]| {
        [left.min(x), bottom.min(y), right.max(x), top.max(y)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use pleach_plant::leaf_shape::LeafShape;

    #[test]
    fn a_form_can_be_undone_and_hardly_changes_the_area() {
        let area = |corners: &[[f32; 2]]| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f32>() / 2.0
        };
        for shape in LeafShape::ALL {
            let corners = shape.outline().corners();
            assert_eq!(Form::new(0).outline(corners), corners);
            for number in 0..CELLS {
                let form = Form::new(number);
                let ratio = area(&form.outline(corners)) / shape.outline().area();
                assert!((0.9..1.1).contains(&ratio), "{shape:?} {number}: {ratio}");
                for &corner in corners {
                    let back = form.origin(form.place(corner));
                    let off = (back[0] - corner[0]).hypot(back[1] - corner[1]);
                    assert!(off < 1e-3, "{shape:?} {number}: {corner:?} {back:?}");
                }
            }
        }
    }

    #[test]
    fn all_forms_are_worn_about_as_often_and_each_has_its_cell() {
        for shapes in [1, 2, 5, 40] {
            let atlas = Atlas::new(shapes);
            assert!(
                atlas.cell(shapes - 1, atlas.forms - 1) < (atlas.sheet.columns * atlas.sheet.rows) as usize
            );
        }
        let (atlas, mut worn) = (Atlas::new(1), [0; CELLS]);
        let mut leaf = Leaf { position: Vec3::ZERO, along: Vec3::Z, across: Vec3::X, stem: 0, shape: 0 };
        for i in 0..16_000 {
            leaf.position = Vec3::new((i % 40) as f32, (i / 40 % 20) as f32, (i / 800) as f32) * 0.05;
            worn[atlas.form_of(&leaf)] += 1;
        }
        assert!(worn.iter().all(|count| (800..1200).contains(count)), "{worn:?}");
    }
}
