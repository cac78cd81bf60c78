//! A family that is small enough to be read at a glance: a trunk with a few straight twigs.

use crate::generator::Generator;
use crate::grow_error::{Blame, Conflict, GrowError};
use crate::growth::{Growth, Workspace};
use crate::param::{CheckedParams, Effect, Kind, Param, ParamSpace, Scale, Slot, Unit};
use crate::species::Family;
use crate::species::{Form, Issue, Key, SpeciesDoc};
use pleach_plant::Key as Draws;
use pleach_plant::glam::{DVec3, Vec3, dvec3};
use pleach_plant::leaf_shape::LeafShape;
use pleach_plant::{Foliage, Knot, Leaf, Stem, StemKind, Tree};
use std::sync::{Arc, OnceLock};

#[derive(Debug)]
pub(crate) struct Bushes;

#[derive(Debug)]
pub(crate) struct Bush {
    /// The structure: whether twigs come in pairs.
    pub(crate) pairs: bool,
}

pub(crate) const FILES: &[(&str, &str)] = &[
    ("plain", "generator = \"bush\"\nname = \"plain\"\nheight = 3\nlean = [50, 5.5]\n"),
    ("bare", "generator = \"bush\"\nname = \"bare\"\ntwigs = 0\n[appearance]\nbark = \"#806040\"\n"),
    ("paired", "generator = \"bush\"\nname = \"paired\"\ntree_seed = 12\npairs = \"yes\"\n"),
];

impl Family for Bushes {
    fn name(&self) -> &'static str {
        "bush"
    }

    fn summary(&self) -> &'static str {
        "a trunk with twigs"
    }

    fn keys(&self) -> &'static [Key] {
        &[Key { name: "pairs", form: Form::Text, default: "no", doc: "\"yes\" for twigs in pairs" }]
    }

    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[("tall", "the height of the bush is `height`")]
    }

    fn read(&self, doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        let pairs = doc.text("pairs").unwrap_or_else(|issue| {
            issues.push(issue);
            None
        });
        Some(Arc::new(Bush { pairs: pairs == Some("yes") }))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        FILES
    }
}

pub(crate) fn space() -> &'static Arc<ParamSpace> {
    static SPACE: OnceLock<Arc<ParamSpace>> = OnceLock::new();
    SPACE.get_or_init(|| {
        let size = |name, default, max| {
            Param::scalar(name, Kind::real(0.0, max), default).unit(Unit::Meters).group("size")
        };
        let params = vec![
            size("height", 2.0, 50.0).search([(0.5, 8.0)]).scale([Scale::Log]).effect([Effect::Size]),
            size("height_v", 0.2, 10.0).search([(0.0, 1.0)]).effect([Effect::SizeJitter]).neutral(0.0),
            Param::scalar("twigs", Kind::integer(0, 1000), 5.0)
                .search([(0.0, 20.0)])
                .unit(Unit::Count)
                .scale([Scale::Count])
                .effect([Effect::Layout])
                .group("twigs"),
            Param::list("lean", "tier", Kind::real(-90.0, 90.0), [40.0, 10.0])
                .unit(Unit::Degrees)
                .neutral(0.0)
                .group("twigs"),
            Param::scalar("lowest", Kind::real(0.0, 1.0), 0.3).group("twigs"),
            Param::scalar("highest", Kind::real(0.0, 1.0), 0.9).group("twigs"),
            Param::scalar("side", Kind::choice(1, ["left", "right"]), 1.0).group("twigs"),
        ];
        Arc::new(ParamSpace::new(params).unwrap())
    })
}

const TWIGS: usize = 2;
const LEANS: [usize; 2] = [3, 4];
const LOWEST: usize = 5;
const HIGHEST: usize = 6;

impl Generator for Bush {
    fn family(&self) -> &'static str {
        "bush"
    }

    fn space(&self) -> &Arc<ParamSpace> {
        space()
    }

    fn structure(&self) -> String {
        if self.pairs { "pairs = \"yes\"\n".to_owned() } else { String::new() }
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        slot.index() <= TWIGS || values[TWIGS] > 0.0
    }

    fn check(&self, values: &[f64]) -> Result<(), Conflict> {
        let (value, min) = (values[HIGHEST], values[LOWEST]);
        let (slot, other) = ("highest".to_owned(), "lowest".to_owned());
        // Without twigs there is nothing between them.
        if values[TWIGS] > 0.0 && value < min {
            Err(Conflict::TooSmall { slot, value, other, min })
        } else {
            Ok(())
        }
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        _: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let values = params.values_in(space())?;
        self.check(values)?;
        tree.clear();
        tree.leaf_shapes.push(Arc::clone(LeafShape::Ovate.outline()));
        let draws = Draws::root(growth.seed);
        let height = values[0] + values[1] * draws.signed(0, 0);
        if height <= 0.0 {
            return Err(Conflict::NothingLeft { blame: Blame(vec!["height".to_owned()]) }.into());
        }
        let twigs = values[TWIGS] as usize * if self.pairs { 2 } else { 1 };
        within(twigs, growth)?;
        let up = dvec3(0.0, 0.0, height);
        stem(tree, None, DVec3::ZERO, up);
        for twig in 0..twigs {
            let part = (twig as f64 + 0.5) / twigs as f64;
            let from = up * (values[LOWEST] + (values[HIGHEST] - values[LOWEST]) * part);
            let lean = values[LEANS[twig % 2]].to_radians();
            let side = if (values[7] as i64) == 1 { 1.0 } else { -1.0 };
            let to = from + 0.3 * height * dvec3(lean.sin() * side, draws.signed(1, twig as u32), lean.cos());
            stem(tree, Some(from.z), from, to);
            if growth.foliage == Foliage::All {
                let (along, across) = (Vec3::Z * 0.1, Vec3::X * 0.1);
                tree.leaves.push(Leaf {
                    position: to.as_vec3(),
                    along,
                    across,
                    stem: twig as u32 + 1,
                    shape: 0,
                });
            }
        }
        Ok(())
    }
}

fn within(twigs: usize, growth: &Growth) -> Result<(), GrowError> {
    let (limits, blame) = (growth.limits, || Blame(vec!["twigs".to_owned()]));
    let leaves = if growth.foliage == Foliage::All { twigs } else { 0 };
    if twigs + 1 > limits.stems {
        Err(GrowError::TooManyStems { limit: limits.stems, blame: blame() })
    } else if 2 * (twigs + 1) > limits.knots {
        Err(GrowError::TooManyKnots { limit: limits.knots, blame: blame() })
    } else if leaves > limits.leaves {
        Err(GrowError::TooManyLeaves { limit: limits.leaves, blame: blame() })
    } else if (twigs + 1) as u64 > limits.work {
        Err(GrowError::TooMuchWork { limit: limits.work, blame: blame() })
    } else {
        Ok(())
    }
}

/// A straight stem, on the trunk at a height or on the ground.
fn stem(tree: &mut Tree, on: Option<f64>, from: DVec3, to: DVec3) {
    let first_knot = tree.knots.len() as u32;
    for point in [from, to] {
        let (handle_in, handle_out) = (point.lerp(from, 0.3), point.lerp(to, 0.3));
        tree.knots.push(Knot { point, handle_in, handle_out, radius: 0.01 });
    }
    tree.stems.push(Stem {
        parent: on.map(|_| 0),
        level: u16::from(on.is_some()),
        kind: if on.is_some() { StemKind::Branch } else { StemKind::Trunk },
        number: 0,
        offset: on.unwrap_or(0.0),
        first_knot,
        knot_count: 2,
    });
}
