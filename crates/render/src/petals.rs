//! What a blossom looks like from above.

use crate::blade::Look;
use crate::preview::bark::{floor, noise, smooth};
use glam::{Vec2, Vec3, vec2, vec3};
use pleach_mesh::blossom_spread;
use pleach_plant::leaf_shape::BlossomShape;
use pleach_plant::trig::atan2;

/// The faces of a blossom from above, as parts of its reach: from −1 to 1, the third axis downwards.
pub(crate) fn outlines(shape: BlossomShape) -> Vec<Vec<[f32; 2]>> {
    let faces = shape.faces();
    let reach = blossom_spread(shape).0;
    let at = |i: &u8| {
        let [x, _, z] = faces.vertices[usize::from(*i)];
        [x / reach, -z / reach]
    };
    // The whole square, in which texture coordinates are reckoned.
    let corner = |x: f32, y: f32| vec![[x, y]; 3];
    let faces = faces.polygons.iter().map(|face| face.iter().map(at).collect());
    faces.chain([corner(-1.0, -1.0), corner(1.0, 1.0)]).collect()
}

/// Petals that are paler towards their rim, with fine streaks along them, and stamens in the middle. `point` is in parts
/// of the blossom's reach from its axis.
pub(crate) fn look(point: Vec2) -> Look {
    let far = point.length();
    let turn = atan2(f64::from(point.y), f64::from(point.x)) as f32 / std::f32::consts::TAU;
    let turn = turn - floor(turn) as f32;
    let streaks = noise(turn * 90.0, far * 3.0, [90, 1 << 16]) - 0.5;
    // Fourteen stamens whose tips stand in a ring.
    let place = turn * 14.0;
    let off = (place - floor(place) as f32 - 0.5).abs() * std::f32::consts::TAU * far / 14.0;
    let tip = (1.0 - smooth(0.02, 0.035, vec2(off, far - 0.24).length())).max(1.0 - smooth(0.05, 0.09, far));
    let deep = 1.0 - smooth(0.05, 0.5, far);
    let petal = Vec3::ONE * (0.97 + 0.05 * far + 0.06 * streaks) - vec3(0.05, 0.22, 0.14) * deep;
    Look {
        light: petal.lerp(vec3(0.95, 0.8, 0.3), tip),
        height: 0.01 * streaks + 0.12 * far * far + 0.02 * tip,
    }
}
