//! A second family of generators: a pole of two numbers.

use glam::DVec3;
use pleach_tree::species::Appearance;
use pleach_tree::{
    CheckedParams, Generator, GrowError, Growth, Kind, Knot, Layout, Param, ParamSpace, Species, Stem,
    StemKind, Tree, Unit, Workspace,
};
use std::borrow::Cow;
use std::sync::{Arc, LazyLock};

static SPACE: LazyLock<ParamSpace> = LazyLock::new(|| {
    ParamSpace::new(vec![
        param("height", Unit::Meters, 1.0, 50.0, 10.0),
        // The radius as a part of the height.
        param("girth", Unit::Ratio, 0.01, 0.5, 0.1),
    ])
});

fn param(name: &'static str, unit: Unit, low: f64, high: f64, default: f64) -> Param {
    Param {
        name: name.into(),
        layout: Layout::Scalar,
        kind: Kind::Real { min: 0.001, max: 1000.0 },
        search: Cow::Owned(vec![(low, high)]),
        unit,
        default: Cow::Owned(vec![default]),
        group: "pole",
        doc: "for tests".into(),
        source: "none",
    }
}

/// The generator.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pole;

impl Generator for Pole {
    fn family(&self) -> &'static str {
        "pole"
    }

    fn space(&self) -> &ParamSpace {
        &SPACE
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        _: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let &[height, girth] = params.values() else { unreachable!("two numbers are declared") };
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
            offset: 0.0,
            length: height,
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
        appearance: Appearance::default(),
    }
}
