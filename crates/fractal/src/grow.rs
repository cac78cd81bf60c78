//! The recursion, as a stack of stems that wait.

use crate::choices::{Dimensions, ThicknessRule};
use crate::count::{self, MIN_LENGTH};
use crate::frame::{Angle, Frame};
use crate::model::Model;
use crate::purpose::{APICAL, AZIMUTH, COUNT, DAUGHTER, DROP, LEAF, LEAN, LEAN_AZIMUTH, POLAR, SCALE};
use glam::DVec3;
use pleach_tree::{Address, Foliage, GrowError, Growth, Key, Knot, Leaf, Spread, Stem, StemKind, Tree};
use std::f64::consts::TAU;
use std::sync::Arc;

/// One branch: the straight piece from a node to the next.
#[derive(Clone, Copy, Debug)]
struct Branch {
    foot: DVec3,
    frame: Frame,
    length: f64,
    /// At its foot.
    radius: f64,
    /// 0 for the trunk.
    generation: u16,
    key: Key,
}

/// A stem that waits: a branch, and the central branches that go on from it.
#[derive(Clone, Copy, Debug)]
struct Shoot {
    first: Branch,
    address: Address,
    /// Among those that its parent carries.
    number: u32,
    parent: Option<u32>,
    level: u16,
    kind: StemKind,
    /// Metres along the parent.
    offset: f64,
}

/// A daughter of a node before it is known how thick it is.
#[derive(Clone, Copy, Debug)]
struct Daughter {
    frame: Frame,
    /// Length over its parent's, but for what an individual makes of it: by this its sisters get thick.
    scale: f64,
    /// Its own key, by which it is left out or not.
    own: Key,
    key: Key,
    /// Factor on its length.
    length: f64,
    /// Its stem, where it begins one.
    stem: Option<(Address, u32)>,
}

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    waiting: Vec<Shoot>,
    daughters: Vec<Daughter>,
}

/// Grows the tree of `model` into `tree`.
pub(crate) fn grow(
    model: &Model,
    growth: &Growth,
    scratch: &mut Scratch,
    tree: &mut Tree,
) -> Result<(), GrowError> {
    tree.clear();
    if let Some(error) = count::refusal(model, growth) {
        return Err(error);
    }
    tree.leaf_shapes.push(Arc::clone(model.leaf_shape.outline()));
    scratch.waiting.clear();
    let address = Address::trunk(0);
    let draw = growth.draw(address, 0);
    let frame = match (model.dimensions, draw.azimuth, draw.pitch) {
        (_, 0.0, 0.0) => Frame::TRUNK,
        (Dimensions::Plane, _, pitch) => Frame::TRUNK.in_plane(Angle::new(pitch)),
        (Dimensions::Space, azimuth, pitch) => {
            let turned = Frame::TRUNK.turned(Angle::new(azimuth));
            // Towards where it is turned.
            turned.leaning(Angle::new(pitch), Angle::new(0.0))
        }
    };
    let trunk = Branch {
        foot: DVec3::ZERO,
        frame,
        length: model.trunk_length * draw.length,
        radius: model.trunk_radius,
        generation: 0,
        key: draw.key(Key::root(growth.seed)),
    };
    let kind = StemKind::Trunk;
    scratch.waiting.push(Shoot {
        first: trunk,
        address,
        number: 0,
        parent: None,
        level: 0,
        kind,
        offset: 0.0,
    });
    let mut grower = Grower { model, growth, scratch, tree, work: 1 };
    while let Some(shoot) = grower.scratch.waiting.pop() {
        grower.stem(&shoot)?;
    }
    Ok(())
}

struct Grower<'a> {
    model: &'a Model,
    growth: &'a Growth<'a>,
    scratch: &'a mut Scratch,
    tree: &'a mut Tree,
    work: u64,
}

impl Grower<'_> {
    /// A branch and its central daughters, one after the other; their side branches wait.
    fn stem(&mut self, shoot: &Shoot) -> Result<(), GrowError> {
        let limits = self.growth.limits;
        if self.tree.stems.len() >= limits.stems {
            return Err(GrowError::TooManyStems { limit: limits.stems, blame: count::blame(self.model) });
        }
        let (index, first_knot) = (self.tree.stems.len() as u32, self.tree.knots.len() as u32);
        let &Shoot { first, address, number, parent, level, kind, offset } = shoot;
        self.tree.stems.push(Stem { parent, level, kind, number, offset, first_knot, knot_count: 1 });
        self.knot(first.foot, first.radius)?;
        let (mut branch, mut length) = (first, 0.0);
        // Numbers of the stems that this one carries, from its foot up.
        let mut carried = 0;
        loop {
            let tip = branch.foot + branch.frame.along * branch.length;
            self.daughters(&branch, address, level, &mut carried);
            self.work += self.scratch.daughters.len() as u64;
            if self.work > limits.work {
                return Err(GrowError::TooMuchWork { limit: limits.work, blame: count::blame(self.model) });
            }
            let thickness = Thickness::new(self.model, &branch, &self.scratch.daughters);
            let third = branch.frame.along * (branch.length / 3.0);
            if let Some(foot) = self.tree.knots.last_mut() {
                foot.handle_out = branch.foot + third;
            }
            self.knot(tip, thickness.tip)?;
            if let Some(knot) = self.tree.knots.last_mut() {
                knot.handle_in = tip - third;
            }
            length += branch.length;
            let mut central = None;
            for daughter in &self.scratch.daughters {
                if !is_grown(self.model, &branch, daughter) {
                    continue;
                }
                let next = Branch {
                    foot: tip,
                    frame: daughter.frame,
                    length: branch.length * daughter.scale * daughter.length,
                    radius: thickness.radius_of(daughter),
                    generation: branch.generation + 1,
                    key: daughter.key,
                };
                let Some((address, number)) = daughter.stem else {
                    central = Some(next);
                    continue;
                };
                // Without central branches a node is a fork of its stem.
                let (level, kind) = match self.model.has_central() {
                    true => (level + 1, StemKind::Branch),
                    false => (level, StemKind::Fork),
                };
                self.scratch.waiting.push(Shoot {
                    first: next,
                    address,
                    number,
                    parent: Some(index),
                    level,
                    kind,
                    offset: length,
                });
            }
            match central {
                Some(next) => branch = next,
                None => break,
            }
        }
        self.tree.stems[index as usize].knot_count = self.tree.knots.len() as u32 - first_knot;
        self.leaf(&branch, index)
    }

    /// A knot of the stem that is being grown.
    fn knot(&mut self, point: DVec3, radius: f64) -> Result<(), GrowError> {
        let limit = self.growth.limits.knots;
        if self.tree.knots.len() >= limit {
            return Err(GrowError::TooManyKnots { limit, blame: count::blame(self.model) });
        }
        self.tree.knots.push(Knot { point, handle_in: point, handle_out: point, radius });
        Ok(())
    }

    /// Collects the candidates for daughters at the tip of `branch`, which belongs to the stem at `address`;
    /// the central daughter first.
    fn daughters(&mut self, branch: &Branch, address: Address, level: u16, carried: &mut u32) {
        let growth = self.growth;
        let (model, key, daughters) = (self.model, branch.key, &mut self.scratch.daughters);
        daughters.clear();
        if branch.generation >= model.generations {
            return;
        }
        if model.has_central() {
            let key = key.child(DAUGHTER, 0);
            let apical = &model.apical_ratio;
            let ratio = model.noise.vary(apical.nominal, apical.deviation, key, APICAL);
            let scale = Model::central_scale(scale(model, key), ratio);
            daughters.push(Daughter {
                frame: leader(model, &branch.frame, key),
                scale,
                own: key,
                key,
                length: 1.0,
                stem: None,
            });
        }
        let sides = &model.side_branches;
        let count = Model::sides(model.noise.vary(sides.nominal, sides.deviation, key, COUNT));
        for number in 0..count {
            let own = key.child(DAUGHTER, number + 1);
            let (address, level) = match model.has_central() {
                true => (address.child(*carried), usize::from(level) + 1),
                false => (address.fork(*carried), usize::from(level)),
            };
            let draw = growth.draw(address, level);
            let key = draw.key(own);
            let polar = model.noise.vary(model.polar.nominal, model.polar.deviation, key, POLAR);
            let frame = match model.dimensions {
                Dimensions::Plane => {
                    let fan = Model::fan(number, count);
                    let away = if fan < 0.0 { -draw.pitch } else { draw.pitch };
                    branch.frame.in_plane(Angle::new(polar * fan + away))
                }
                Dimensions::Space => {
                    let azimuth = azimuth(model, key) + TAU * f64::from(number) / f64::from(count);
                    branch.frame.branch(Angle::new(polar + draw.pitch), Angle::new(azimuth + draw.azimuth))
                }
            };
            let length = match draw.seed {
                0 => 1.0,
                // Its sisters keep what they were beside its own length.
                _ => Model::side_scale(scale(model, key)) / Model::side_scale(scale(model, own)),
            };
            daughters.push(Daughter {
                frame,
                scale: Model::side_scale(scale(model, own)),
                own,
                key,
                length: draw.length * length,
                stem: Some((address, *carried)),
            });
            *carried += 1;
        }
    }

    /// The leaf of the twig that ends in `branch`, which lies along it.
    fn leaf(&mut self, branch: &Branch, stem: u32) -> Result<(), GrowError> {
        let model = self.model;
        // A limb that lost its branches has no leaf.
        let is_twig = branch.generation == model.generations;
        let grows = self.growth.foliage == Foliage::All && is_twig;
        if !grows || branch.key.unit(LEAF, 0) >= model.leaf_rate {
            return Ok(());
        }
        let limit = self.growth.limits.leaves;
        if self.tree.leaves.len() >= limit {
            return Err(GrowError::TooManyLeaves { limit, blame: count::blame(model) });
        }
        let length = branch.length * model.leaf_length;
        self.tree.leaves.push(Leaf {
            position: branch.foot.as_vec3(),
            along: (branch.frame.along * length).as_vec3(),
            across: (branch.frame.across * (length * model.leaf_width)).as_vec3(),
            stem,
            shape: 0,
        });
        Ok(())
    }
}

/// The frame of a central branch: turned, so that whorls advance, then leaning.
fn leader(model: &Model, parent: &Frame, key: Key) -> Frame {
    let lean = model.noise.vary(0.0, model.central_polar_v, key, LEAN);
    match model.dimensions {
        Dimensions::Plane => parent.in_plane(Angle::new(lean)),
        Dimensions::Space => {
            let turned = parent.turned(Angle::new(azimuth(model, key)));
            if lean == 0.0 {
                return turned;
            }
            turned.leaning(Angle::new(lean), Angle::new(TAU * key.unit(LEAN_AZIMUTH, 0)))
        }
    }
}

fn azimuth(model: &Model, key: Key) -> f64 {
    model.noise.vary(model.azimuth.nominal, model.azimuth.deviation, key, AZIMUTH)
}

fn scale(model: &Model, key: Key) -> f64 {
    model.noise.vary(model.scale.nominal, model.scale.deviation, key, SCALE)
}

/// How far draws of single stems may lie from their own, level by level.
pub(crate) fn spreads(model: &Model) -> Vec<Spread> {
    let part = if model.scale.nominal > 0.0 { model.scale.deviation / model.scale.nominal } else { 0.0 };
    let stems = Spread::for_stems(Spread {
        azimuth: model.azimuth.deviation,
        pitch: model.polar.deviation,
        length: part,
    });
    // Where branches are forks, all are of one level.
    if model.has_central() {
        vec![Spread::for_trunks(), stems]
    } else {
        vec![Spread { length: 0.0, ..stems }]
    }
}

/// Whether a daughter of `parent` is long enough, and not left out by chance.
fn is_grown(model: &Model, parent: &Branch, daughter: &Daughter) -> bool {
    let is_long = parent.length * daughter.scale >= MIN_LENGTH * model.trunk_length;
    let may_drop = model.drop > 0.0 && parent.generation + 1 >= model.drop_from;
    is_long && !(may_drop && daughter.own.unit(DROP, 0) < model.drop)
}

/// Radii at a node. Branches that were left out count: they were there when the others got thick.
#[derive(Clone, Copy, Debug)]
struct Thickness {
    /// Radius of a daughter for each unit of its scale, by the rule of areas; of every daughter otherwise.
    radius: f64,
    rule: ThicknessRule,
    /// Radius of the branch that ends here: that of its thickest daughter.
    tip: f64,
}

impl Thickness {
    fn new(model: &Model, branch: &Branch, daughters: &[Daughter]) -> Self {
        let rule = model.thickness_rule;
        match rule {
            ThicknessRule::Factor => {
                let radius = branch.radius / model.thickness_factor;
                Self { radius, rule, tip: radius }
            }
            ThicknessRule::Area => {
                let sum: f64 = daughters.iter().map(|d| d.scale * d.scale).sum();
                if sum <= 0.0 {
                    return Self { radius: 0.0, rule, tip: branch.radius * model.tip_taper() };
                }
                let radius = branch.radius / sum.sqrt();
                let greatest = daughters.iter().map(|d| d.scale).fold(0.0, f64::max);
                Self { radius, rule, tip: radius * greatest }
            }
        }
    }

    fn radius_of(&self, daughter: &Daughter) -> f64 {
        match self.rule {
            ThicknessRule::Factor => self.radius,
            ThicknessRule::Area => self.radius * daughter.scale,
        }
    }
}
