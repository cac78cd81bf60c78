//! An element in the numbers that Unreal's functions read.

use super::elements::Element;
use super::half;
use glam::{Vec3, vec3};

/// Centimetres in a metre: Unreal's unit.
const UNITS: f32 = 100.0;
/// Centimetres for which the alpha of an extent is 255.
const MAX_EXTENT: f32 = 2048.0;
/// The half float whose bits stand for the number 0. The bits of smaller ones are of numbers so small that graphics
/// cards make 0 of them.
const FIRST_INDEX: u16 = 1024;
/// The largest half float that is not infinite.
const MAX_HALF: f32 = 65_504.0;

/// From the tree's axes to those of a mesh that Unreal has read from a GLB file, which are left-handed.
fn turned(v: Vec3) -> Vec3 {
    vec3(v.x, -v.y, v.z)
}

/// Pivot and number of the parent, as bits of half floats.
pub(super) fn position(element: &Element) -> [u16; 4] {
    let at = (turned(element.pivot) * UNITS).clamp(Vec3::splat(-MAX_HALF), Vec3::splat(MAX_HALF));
    let [x, y, z] = at.to_array().map(half::from_f32);
    [x, y, z, element.parent as u16 + FIRST_INDEX]
}

/// Axis and extent as bytes. The extent is never 0, so that no program takes the pixel for an empty one.
pub(super) fn axis(element: &Element) -> [u8; 4] {
    let [x, y, z] = turned(element.axis).to_array().map(|v| (255.0 * (0.5 + 0.5 * v)).round() as u8);
    let extent = (255.0 * UNITS * element.extent / MAX_EXTENT).round().clamp(1.0, 255.0);
    [x, y, z, extent as u8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pivots::Pivots;

    #[test]
    fn an_element_is_in_the_numbers_of_unreal() {
        let pivot = vec3(1.0, 2.0, 3.0);
        let element = Element { pivot, axis: Vec3::Y, extent: 4.1, parent: 0 };
        let [x, y, z, parent] = position(&element);
        assert_eq!([x, y, z].map(half::to_f32), [100.0, -200.0, 300.0]);
        assert_eq!(parent, 1024);
        assert_eq!(axis(&element), [128, 0, 128, 51]);
        let short = Element { extent: 0.0, ..element };
        assert_eq!(axis(&short)[3], 1);
        assert_eq!(axis(&Element { extent: 99.0, ..element })[3], 255);
    }

    #[test]
    fn every_number_of_a_parent_is_a_half_float_that_is_kept() {
        let element = Element { pivot: Vec3::ZERO, axis: Vec3::Z, extent: 1.0, parent: 0 };
        for parent in 0..Pivots::MAX_ELEMENTS as u32 {
            let bits = position(&Element { parent, ..element })[3];
            let value = half::to_f32(bits);
            assert!(value.is_finite() && value >= 6.1e-5, "{parent}: {value}");
            assert_eq!(half::from_f32(value), bits);
        }
    }
}
