//! The unit shapes of leaves and blossoms.
//!
//! Hewitt 2017, Appendix C, `leaf_shape` and `blossom_shape`. Coordinates are (u, v) for leaves, u
//! across and v along the blade, base at the origin and tip at v = 1, and (u, v, w) for blossoms,
//! w at right angles to both. See [`crate::Leaf`] for how a unit shape is placed.

mod blossom;
mod leaf;
mod outline;

pub use outline::{Outline, OutlineError};

use serde::{Deserialize, Serialize};
use std::sync::{Arc, LazyLock};

/// One of the ten leaf shapes, by their numbers in species files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum LeafShape {
    /// 1: egg-shaped, widest below the middle.
    Ovate = 1,
    /// 2: a needle or blade of grass.
    Linear = 2,
    /// 3: heart-shaped.
    Cordate = 3,
    /// 4: five pointed lobes.
    Maple = 4,
    /// 5: three pointed lobes.
    Palmate = 5,
    /// 6: oak with pointed lobes.
    SpikyOak = 6,
    /// 7: oak with rounded lobes.
    RoundedOak = 7,
    /// 8: widest in the middle.
    #[default]
    Elliptic = 8,
    /// 9: a unit square, for textures.
    Rectangle = 9,
    /// 10: a triangle with its base at the stem.
    Triangle = 10,
}

impl LeafShape {
    /// All ten, in the order of their numbers.
    pub const ALL: [Self; 10] = [
        Self::Ovate,
        Self::Linear,
        Self::Cordate,
        Self::Maple,
        Self::Palmate,
        Self::SpikyOak,
        Self::RoundedOak,
        Self::Elliptic,
        Self::Rectangle,
        Self::Triangle,
    ];

    /// The shape with this number, 1 to 10.
    #[must_use]
    pub fn from_number(number: i64) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| *shape as i64 == number)
    }

    /// The name of the shape in species files, such as `spiky_oak`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ovate => "ovate",
            Self::Linear => "linear",
            Self::Cordate => "cordate",
            Self::Maple => "maple",
            Self::Palmate => "palmate",
            Self::SpikyOak => "spiky_oak",
            Self::RoundedOak => "rounded_oak",
            Self::Elliptic => "elliptic",
            Self::Rectangle => "rectangle",
            Self::Triangle => "triangle",
        }
    }

    /// The outline, whose halves mirror each other.
    #[must_use]
    pub fn outline(self) -> &'static Arc<Outline> {
        static OUTLINES: LazyLock<[Arc<Outline>; LeafShape::ALL.len()]> = LazyLock::new(|| {
            LeafShape::ALL.map(|shape| Arc::new(Outline::from_half(shape.name(), shape.half_outline())))
        });
        &OUTLINES[self as usize - 1]
    }

    const fn half_outline(self) -> &'static [[f32; 2]] {
        match self {
            Self::Ovate => leaf::OVATE,
            Self::Linear => leaf::LINEAR,
            Self::Cordate => leaf::CORDATE,
            Self::Maple => leaf::MAPLE,
            Self::Palmate => leaf::PALMATE,
            Self::SpikyOak => leaf::SPIKY_OAK,
            Self::RoundedOak => leaf::ROUNDED_OAK,
            Self::Elliptic => leaf::ELLIPTIC,
            Self::Rectangle => leaf::RECTANGLE,
            Self::Triangle => leaf::TRIANGLE,
        }
    }
}

/// Corners and flat faces of a unit shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faces {
    /// Corners as (u, v, w).
    pub vertices: &'static [[f32; 3]],
    /// Faces by corner number, each convex and (nearly) flat, counter-clockwise from inside the cup.
    pub polygons: &'static [&'static [u8]],
    /// Outlines by corner number, a petal each: fewer polygons for (nearly) the same silhouette.
    pub petals: &'static [&'static [u8]],
}

impl Faces {
    /// Sum of the areas of all faces.
    #[must_use]
    pub fn area(&self) -> f32 {
        let corner = |i: u8| glam::Vec3::from(self.vertices[usize::from(i)]);
        let fan = |face: &&[u8]| {
            let origin = corner(face[0]);
            face.windows(2)
                .skip(1)
                .map(|e| (corner(e[0]) - origin).cross(corner(e[1]) - origin).length())
                .sum::<f32>()
        };
        self.polygons.iter().map(fan).sum::<f32>() / 2.0
    }
}

/// One of the three blossom shapes, by their numbers in species files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[repr(u8)]
pub enum BlossomShape {
    /// 1: five broad petals, nearly flat.
    #[default]
    Cherry = 1,
    /// 2: five narrow petals around a cone.
    Orange = 2,
    /// 3: a cup of six petals.
    Magnolia = 3,
}

impl BlossomShape {
    /// All three, in the order of their numbers.
    pub const ALL: [Self; 3] = [Self::Cherry, Self::Orange, Self::Magnolia];

    /// The shape with this number, 1 to 3.
    #[must_use]
    pub fn from_number(number: i64) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| *shape as i64 == number)
    }

    /// The name of the shape in species files, such as `cherry`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cherry => "cherry",
            Self::Orange => "orange",
            Self::Magnolia => "magnolia",
        }
    }

    /// Corners and faces of the unit shape.
    #[must_use]
    pub const fn faces(self) -> &'static Faces {
        match self {
            Self::Cherry => &blossom::CHERRY,
            Self::Orange => &blossom::ORANGE,
            Self::Magnolia => &blossom::MAGNOLIA,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners, area and width of the reference's shapes (measured in Blender).
    const LEAVES: [(usize, f32, f32); 10] = [
        (11, 0.283_75, 0.5),
        (9, 0.171_25, 0.2),
        (13, 0.369_5, 0.7),
        (25, 0.464_65, 1.0),
        (11, 0.366, 1.0),
        (25, 0.289_65, 0.64),
        (35, 0.283_8, 0.5),
        (11, 0.301_5, 0.5),
        (4, 1.0, 1.0),
        (3, 0.5, 1.0),
    ];

    #[test]
    fn leaves_have_the_reference_figures() {
        for (shape, (corners, area, width)) in LeafShape::ALL.into_iter().zip(LEAVES) {
            let outline = shape.outline();
            assert_eq!((outline.name(), outline.corners().len()), (shape.name(), corners));
            assert!((outline.area() - area).abs() < 1e-4 * area.max(1.0), "{shape:?} {}", outline.area());
            assert!((outline.width() - width).abs() < 1e-4, "{shape:?} {}", outline.width());
            assert_eq!(outline.half().unwrap(), shape.half_outline());
        }
    }

    #[test]
    fn blossoms_have_the_reference_figures() {
        let figures = [(21, 10, 1.826_96), (30, 14, 0.741_43), (49, 48, 1.849_14)];
        for (shape, (corners, faces, area)) in BlossomShape::ALL.into_iter().zip(figures) {
            let found = shape.faces();
            assert_eq!((found.vertices.len(), found.polygons.len()), (corners, faces), "{shape:?}");
            assert!((found.area() - area).abs() < 2e-3, "{shape:?} {}", found.area());
        }
    }

    #[test]
    fn numbers_are_those_of_the_files() {
        assert_eq!(LeafShape::from_number(0), None);
        assert_eq!(LeafShape::from_number(4), Some(LeafShape::Maple));
        assert_eq!(LeafShape::from_number(11), None);
        assert_eq!(BlossomShape::from_number(0), None);
    }
}
