//! A binary bush: every stem ends in two, each a little shorter, until the leaves.
//!
//! `docs/a-generator.md` walks through this file.

use pleach::glam::{DQuat, DVec3};
use pleach::param::table::{Parameters, always, scalar};
use pleach::param::{Effect, Kind, Param, Scale, Slot, Unit};
use pleach::random::Key;
use pleach::species::{Issue, SpeciesDoc};
use pleach::{
    Blame, CheckedParams, Family, Foliage, Generator, GrowError, Growth, Knot, Leaf, LeafShape, ParamSpace,
    Stem, StemKind, Tree, Workspace,
};
use std::sync::Arc;

/// The family: what reads species files that say `generator = "binary-bush"`.
#[derive(Debug)]
pub struct BinaryBushes;

impl Family for BinaryBushes {
    fn name(&self) -> &'static str {
        "binary-bush"
    }

    fn summary(&self) -> &'static str {
        "bushes whose every stem ends in two"
    }

    fn read(&self, _: &SpeciesDoc, _: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        Some(Arc::new(BinaryBush))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &[("low", include_str!("../species/low.toml")), ("broom", include_str!("../species/broom.toml"))]
    }
}

/// A length in metres, which a fit multiplies to match the height of its goal.
fn metres(default: f64, search: (f64, f64)) -> Param {
    scalar(Kind::real(0.001, 100.0), default)
        .search([search])
        .unit(Unit::Meters)
        .scale([Scale::Log])
        .effect([Effect::Size])
}

pleach::parameters! {
    /// Every number of a bush, declared once; angles in radians.
    #[derive(Clone, Copy)]
    struct Numbers, enum Id, when Numbers {
        height: f64, when always =>
            metres(2.0, (0.3, 10.0)).doc("length of all stems from the ground to a leaf, together");
        levels: i32, when always =>
            scalar(Kind::integer(1, 20), 7.0)
                .search([(3.0, 9.0)])
                .unit(Unit::Count)
                .scale([Scale::Count])
                .effect([Effect::Layout])
                .doc("stems one after the other from the ground to a leaf");
        angle: f64 [f64::to_radians], when Numbers::has_forks =>
            scalar(Kind::real(0.0, 90.0), 30.0)
                .search([(5.0, 60.0)])
                .unit(Unit::Degrees)
                .doc("angle between a stem and each of the two that it ends in");
        shrink: f64, when Numbers::has_forks =>
            scalar(Kind::real(0.1, 1.0), 0.85)
                .search([(0.6, 1.0)])
                .doc("length and radius of a stem over those of the stem before it");
        leaf_length: f64, when always => metres(0.12, (0.02, 0.3)).doc("length of a leaf");
    }
}

impl Numbers {
    fn has_forks(&self) -> bool {
        self.levels > 1
    }
}

/// The growth model. It has nothing but its numbers, so there is nothing in it.
#[derive(Debug)]
pub struct BinaryBush;

impl Generator for BinaryBush {
    fn family(&self) -> &'static str {
        "binary-bush"
    }

    fn space(&self) -> &Arc<ParamSpace> {
        Numbers::space()
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        Numbers::is_active(slot, &Numbers::read(values))
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        _: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let numbers = Numbers::read(params.values_in(Numbers::space())?);
        tree.clear();
        tree.leaf_shapes.push(Arc::clone(LeafShape::Elliptic.outline()));
        let shares = (0..numbers.levels).map(|level| numbers.shrink.powi(level));
        let first = numbers.height / shares.sum::<f64>();
        let bush = Bush { growth, numbers };
        let root = Shoot { from: DVec3::ZERO, along: DVec3::Z * first, radius: 0.06 * first, parent: None };
        bush.shoot(&root, 0, Key::root(growth.seed), tree)
    }
}

struct Bush<'a> {
    growth: &'a Growth<'a>,
    numbers: Numbers,
}

/// A stem about to be made.
struct Shoot {
    from: DVec3,
    along: DVec3,
    radius: f64,
    parent: Option<u32>,
}

impl Bush<'_> {
    fn shoot(&self, shoot: &Shoot, level: i32, key: Key, tree: &mut Tree) -> Result<(), GrowError> {
        let Numbers { levels, angle, shrink, leaf_length, .. } = self.numbers;
        let limits = &self.growth.limits;
        let blame = || Blame(vec![Id::levels.slot_name(0)]);
        if tree.stems.len() as u64 >= limits.work {
            return Err(GrowError::TooMuchWork { limit: limits.work, blame: blame() });
        }
        if tree.stems.len() >= limits.stems {
            return Err(GrowError::TooManyStems { limit: limits.stems, blame: blame() });
        }
        if tree.knots.len() + 2 > limits.knots {
            return Err(GrowError::TooManyKnots { limit: limits.knots, blame: blame() });
        }
        let (index, to) = (tree.stems.len() as u32, shoot.from + shoot.along);
        tree.stems.push(Stem {
            parent: shoot.parent,
            level: level as u16,
            kind: if shoot.parent.is_some() { StemKind::Branch } else { StemKind::Trunk },
            number: 0,
            offset: if shoot.parent.is_some() { shoot.along.length() / shrink } else { 0.0 },
            first_knot: tree.knots.len() as u32,
            knot_count: 2,
        });
        for (point, radius) in [(shoot.from, shoot.radius), (to, shoot.radius * shrink)] {
            let third = shoot.along / 3.0;
            tree.knots.push(Knot { point, handle_in: point - third, handle_out: point + third, radius });
        }
        if level + 1 < levels {
            // The two stems lie in a plane that each fork draws from its own address.
            let across = shoot.along.any_orthonormal_vector();
            let turn =
                DQuat::from_axis_angle(shoot.along.normalize(), key.unit(0, 0) * std::f64::consts::TAU);
            for (side, angle) in [angle, -angle].into_iter().enumerate() {
                let along = DQuat::from_axis_angle(turn * across, angle) * shoot.along * shrink;
                let next = Shoot { from: to, along, radius: shoot.radius * shrink, parent: Some(index) };
                self.shoot(&next, level + 1, key.child(1, side as u32), tree)?;
            }
        } else if self.growth.foliage == Foliage::All {
            if tree.leaves.len() >= limits.leaves {
                return Err(GrowError::TooManyLeaves { limit: limits.leaves, blame: blame() });
            }
            let along = (shoot.along.normalize() * leaf_length).as_vec3();
            let across = along.any_orthonormal_vector() * along.length();
            tree.leaves.push(Leaf { position: to.as_vec3(), along, across, stem: index, shape: 0 });
        }
        Ok(())
    }
}
