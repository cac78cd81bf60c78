//! A second family of generators: a pole of two numbers.

use glam::DVec3;
use pleach_tree::Appearance;
use pleach_tree::param::Effect;
use pleach_tree::{
    CheckedParams, Foliage, Generator, GrowError, Growth, Kind, Knot, Param, ParamSpace, Species, Stem,
    StemKind, Tree, Unit, Workspace,
};
use std::sync::{Arc, LazyLock};

static SPACE: LazyLock<Arc<ParamSpace>> = LazyLock::new(|| {
    let positive = Kind::real(0.001, 1000.0);
    let height = Param::scalar("height", positive.clone(), 10.0)
        .search([(1.0, 50.0)])
        .unit(Unit::Meters)
        .effect([Effect::Size]);
    // The radius as a part of the height.
    let girth = Param::scalar("girth", positive, 0.1).search([(0.01, 0.5)]);
    Arc::new(ParamSpace::new(vec![height, girth]).expect("declarations that agree"))
});

/// The generator.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pole;

impl Generator for Pole {
    fn family(&self) -> &'static str {
        "pole"
    }

    fn space(&self) -> &Arc<ParamSpace> {
        &SPACE
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        _: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let &[height, girth] = params.values_in(&SPACE)? else { unreachable!("two numbers are declared") };
        tree.clear();
        if growth.limits.stems == 0 {
            return Err(GrowError::TooManyStems { limit: 0, blame: pleach_tree::Blame::default() });
        }
        let knot = |z: f64| {
            let point = DVec3::Z * z;
            Knot { point, handle_in: point, handle_out: point, radius: girth * height }
        };
        tree.knots.extend([knot(0.0), knot(height)]);
        tree.stems.push(Stem {
            parent: None,
            level: 0,
            kind: StemKind::Trunk,
            number: 0,
            offset: 0.0,
            first_knot: 0,
            knot_count: 2,
        });
        Ok(())
    }
}

/// The pole of this height in metres and this girth, by a name.
pub(crate) fn pole(name: &str, height: f64, girth: f64) -> Species {
    Species {
        name: name.to_owned(),
        description: String::new(),
        generator: Arc::new(Pole),
        params: SPACE.check(vec![height, girth]).expect("allowed values"),
        tree_seed: None,
        foliage: Foliage::All,
        appearance: Appearance::default(),
    }
}
