//! Which parts of a tree turn as one in wind, and about what.

use super::Sway;
use crate::block::Wind;
use glam::{DVec3, Vec3};
use pleach_plant::{Leaf, StemKind, Tree};

/// The level of bodies beyond which everything turns with what carries it.
const MAX_LEVEL: u8 = 2;

/// What turns about one point: a stem with its forks, and at the last level with all that it carries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    pub(crate) level: u8,
    /// The stem whose base is its own.
    pub(crate) stem: u32,
    pub(crate) pivot: Vec3,
    /// Along the body, in radians per metre.
    bend: Vec3,
    phase: f32,
    /// The body that carries it, which comes before it; that of a trunk is itself.
    pub(crate) parent: u32,
}

/// The bodies of a tree: trunks, limbs that grow from them, and twigs that grow from limbs. They give what moves in wind its
/// numbers: all knots of a stem have those of the stem, and what it carries too.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    bodies: Vec<Body>,
    /// The body of each stem.
    of_stem: Vec<u32>,
}

impl Bodies {
    /// The bodies of `tree`.
    #[must_use]
    pub fn new(tree: &Tree) -> Self {
        let mut new = Self::default();
        for (i, stem) in tree.stems.iter().enumerate() {
            let carrier = stem.parent.map(|parent| new.of_stem[parent as usize]);
            let body = match carrier {
                Some(carrier) if matches!(stem.kind, StemKind::Fork | StemKind::Root) => carrier,
                Some(carrier) if new.bodies[carrier as usize].level == MAX_LEVEL => carrier,
                _ => new.add(tree, i, carrier),
            };
            new.of_stem.push(body);
        }
        new
    }

    fn add(&mut self, tree: &Tree, stem: usize, parent: Option<u32>) -> u32 {
        let number = self.bodies.len() as u32;
        let knots = tree.knots_of(&tree.stems[stem]);
        let (base, tip) = (knots[0].point, knots[knots.len() - 1].point);
        let level = parent.map_or(0, |parent| self.bodies[parent as usize].level + 1);
        let along = tip - base;
        // A trunk sways with the ground under it, by its height alone.
        let turn = if level == 0 { 0.0 } else { Sway::new(tree, stem).amplitude / along.length().max(0.05) };
        self.bodies.push(Body {
            level,
            stem: stem as u32,
            pivot: base.as_vec3(),
            bend: (along.normalize_or(DVec3::Z) * turn).as_vec3(),
            phase: phase(base.as_vec3()),
            parent: parent.unwrap_or(number),
        });
        number
    }

    /// All of them.
    pub(crate) fn all(&self) -> &[Body] {
        &self.bodies
    }

    /// The number of the body of each stem.
    pub(crate) fn of_stems(&self) -> &[u32] {
        &self.of_stem
    }

    /// Wind data of the vertices of a stem, and of all that it carries and that does not flutter.
    ///
    /// # Panics
    /// If the tree has no such stem.
    #[must_use]
    pub fn of_stem(&self, stem: usize) -> Wind {
        let body = &self.bodies[self.of_stem[stem] as usize];
        let parent = &self.bodies[body.parent as usize];
        Wind {
            pivot: body.pivot,
            bend: body.bend,
            phase: body.phase,
            parent_pivot: parent.pivot,
            parent_bend: if body.level == 0 { Vec3::ZERO } else { parent.bend },
            parent_phase: parent.phase,
            level: f32::from(body.level),
            flutter: 0.0,
        }
    }

    /// Wind data of a vertex of a leaf or a card, `place` of the way from its foot to its tip.
    ///
    /// # Panics
    /// If the tree has no such stem as the leaf's.
    #[must_use]
    pub fn of_leaf(&self, leaf: &Leaf, place: f32) -> Wind {
        let far = (FLUTTER * leaf.along.length()).min(MAX_FLUTTER);
        Wind { flutter: far * place.clamp(0.0, 1.0), ..self.of_stem(leaf.stem as usize) }
    }
}

/// How far the tip of a leaf flutters, over its length.
const FLUTTER: f32 = 0.15;
/// The same in metres, at most.
const MAX_FLUTTER: f32 = 0.03;

/// A phase in turns that stays what it is at every level of detail, and that differs between neighbours.
fn phase(pivot: Vec3) -> f32 {
    let [x, y, z] = pivot.to_array().map(f64::from);
    let turns = 7.31 * x + 5.17 * y + 3.73 * z;
    // Less than 1, since the whole part of the number in a file is a level.
    (turns - turns.floor()).min(0.999) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limbs_grow_from_trunks_and_twigs_from_limbs() {
        let tree = pleach_generators::preset("weeping_willow").unwrap().grow_bare(1).unwrap();
        let bodies = Bodies::new(&tree);
        let mut of_level = [0; 3];
        for (i, stem) in tree.stems.iter().enumerate() {
            let own = bodies.of_stem(i);
            of_level[own.level as usize] += 1;
            let Some(parent) = stem.parent else { continue };
            let below = bodies.of_stem(parent as usize);
            if stem.kind == StemKind::Fork || below.level == 2.0 {
                assert_eq!(own, below, "stem {i}");
            } else {
                assert_eq!(own.level, below.level + 1.0, "stem {i}");
                assert_eq!((own.parent_pivot, own.parent_bend), (below.pivot, below.bend), "stem {i}");
            }
        }
        assert!(of_level.iter().all(|count| *count > 0), "{of_level:?}");
    }
}
