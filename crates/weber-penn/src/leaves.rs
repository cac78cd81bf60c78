//! Leaves and blossoms on the deepest level.
//!
//! Weber and Penn 1995, §4.9; Hewitt 2017, §3.2.2.

use crate::children::{Spacing, Sprout, relative_length};
use crate::grow::{Bench, Job};
use crate::model::Model;
use crate::purpose;
use crate::stem::Seedling;
use glam::DVec3;
use pleach_tree::turtle::{Turtle, rotate};
use pleach_tree::{Foliage, GrowError, Leaf};
use std::f64::consts::{PI, TAU};

/// Grows the leaves and blossoms of `stem`, whose index in the tree is `index`.
pub(crate) fn grow(
    job: &Job<'_>,
    bench: &mut Bench<'_>,
    stem: &Seedling,
    index: u32,
    first_point: usize,
) -> Result<(), GrowError> {
    let model = job.model;
    let relative_scale = stem.scale / model.g_scale;
    let count = model.leaf_blos_num * relative_scale * relative_length(stem);
    let spacing = Spacing {
        stem,
        level: &model.levels[stem.depth],
        next: model.child_level(stem.depth),
        count,
        forks_cost: false,
    };
    let profile = job.profile(stem);
    let coarse = Coarse::new(job.growth.foliage, stem);
    let leaf_scale = model.leaf_scale * relative_scale * coarse.scale;
    let blossom_scale = model.blossom_scale * relative_scale * coarse.scale;

    let limit = job.growth.limits.leaves;
    let Bench { tree, path, .. } = bench;
    let path = &path[first_point..];
    spacing.places(path, |place| {
        if !coarse.keeps(place.number) {
            return Ok(());
        }
        if tree.leaves.len() + tree.blossoms.len() >= limit {
            return Err(GrowError::TooManyLeaves { limit });
        }
        let Sprout { mut turtle, outward } = spacing.sprout(path, &place);
        turtle.position += outward * profile.at(place.offset / stem.length);
        if model.leaf_bend > 0.0 {
            face_the_light(model, &mut turtle);
        }
        let blossom =
            model.blossom_rate > 0.0 && stem.key.unit(purpose::BLOSSOM, place.number) < model.blossom_rate;
        let (length, width, shapes) = if blossom {
            (blossom_scale, blossom_scale, &mut tree.blossoms)
        } else {
            (leaf_scale, leaf_scale * model.leaf_scale_x, &mut tree.leaves)
        };
        shapes.push(Leaf {
            position: turtle.position.as_vec3(),
            along: (turtle.direction * length).as_vec3(),
            across: (turtle.right * width).as_vec3(),
            stem: index,
        });
        Ok(())
    })
}

/// Turns a leaf outwards and then up, each by the part `leaf_bend` of what is missing (Weber and
/// Penn 1995, §4.9).
fn face_the_light(model: &Model, turtle: &mut Turtle) {
    let normal = turtle.down();
    let outwards = turtle.position.y.atan2(turtle.position.x) - normal.y.atan2(normal.x);
    let outwards = (outwards + PI).rem_euclid(TAU) - PI;
    let (sin, cos) = (model.leaf_bend * outwards).sin_cos();
    let about_z = |v: DVec3| DVec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
    turtle.direction = about_z(turtle.direction);
    turtle.right = about_z(turtle.right);

    let normal = turtle.down();
    let Some(axis) = DVec3::new(normal.y, -normal.x, 0.0).try_normalize() else { return };
    let up = normal.z.clamp(-1.0, 1.0).acos();
    turtle.direction = rotate(turtle.direction, axis, model.leaf_bend * up);
    turtle.right = rotate(turtle.right, axis, model.leaf_bend * up);
}

/// Which leaves of a coarse crown are made, and how much larger.
struct Coarse {
    one_in: u32,
    phase: u32,
    scale: f64,
}

impl Coarse {
    fn new(foliage: Foliage, stem: &Seedling) -> Self {
        let one_in = match foliage {
            Foliage::OneIn(n) => n.max(1),
            Foliage::All | Foliage::None => 1,
        };
        // Stems with few leaves must not all keep their first.
        let phase = if one_in == 1 {
            0
        } else {
            (stem.key.bits(purpose::COARSE_PHASE, 0) % u64::from(one_in)) as u32
        };
        Self { one_in, phase, scale: f64::from(one_in).sqrt() }
    }

    const fn keeps(&self, number: u32) -> bool {
        self.one_in == 1 || (number + self.phase).is_multiple_of(self.one_in)
    }
}
