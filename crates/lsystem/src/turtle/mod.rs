//! From a string to a tree.
//!
//! Hewitt 2017, §3.1.2, and Prusinkiewicz and Lindenmayer 1990, chapter 1. The string is walked twice:
//! once to count branches, pieces and leaves, so that limits are checked before memory is taken,
//! and once to draw.

mod leaves;
mod pen;
mod stems;
mod survey;

use crate::derive::purpose;
use crate::program::Command;
use crate::system::Derived;
use glam::DVec3;
use leaves::Leaves;
pub(crate) use pen::{At, Pen, Steps};
use pleach_tree::math;
use pleach_tree::{Foliage, Key, Limits, Tree};
use std::f64::consts::TAU;
use stems::Stems;
use survey::{Survey, leaves_of};

/// Why a string cannot be a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GrowFault {
    /// More stems than the limit.
    #[error("the tree has too many stems")]
    Stems,
    /// More knots than the limit.
    #[error("the tree's stems have too many knots")]
    Knots,
    /// More leaves than the limit.
    #[error("the tree has too many leaves")]
    Leaves,
    /// A position beyond all bounds.
    #[error("a position of the tree is not finite")]
    NotFinite,
    /// No piece is drawn.
    #[error("nothing of the tree is drawn")]
    NothingDrawn,
}

/// Metres beyond which single precision and sense end.
const MAX_POSITION: f64 = 1e7;

/// A thousand turns, in degrees.
const MAX_TURN: f64 = 360e3;

/// Whether a position is beyond all bounds.
pub(crate) fn is_beyond(position: DVec3) -> bool {
    !position.is_finite() || position.abs().max_element() >= MAX_POSITION
}

impl Derived<'_> {
    /// Draws the string into `tree`, whose former content is dropped and whose memory is kept.
    ///
    /// # Errors
    /// See [`GrowFault`].
    pub fn grow(&self, limits: &Limits, foliage: Foliage, tree: &mut Tree) -> Result<(), GrowFault> {
        tree.clear();
        let leafy = foliage == Foliage::All;
        let survey = Survey::new(self, limits, leafy)?;
        let stems = Stems::new(&survey, tree).ok_or(GrowFault::NothingDrawn)?;
        let leaves = Leaves::new(self.header(), if leafy { survey.leaves } else { 0 }, leafy, tree);
        let mut walk = Walk {
            derived: self,
            steps: Steps::new(self.header()),
            pen: Pen::new(self.header()),
            stack: Vec::new(),
            polygons: Vec::new(),
            begun: 0,
            survey: &survey,
            stems,
            leaves,
        };
        walk.run(tree)?;
        walk.leaves.finish(tree);
        Ok(())
    }
}

struct Walk<'a> {
    derived: &'a Derived<'a>,
    steps: Steps,
    pen: Pen,
    stack: Vec<Pen>,
    /// Corners of the polygons that are open.
    polygons: Vec<Vec<DVec3>>,
    /// Number of the branch that began last.
    begun: u32,
    survey: &'a Survey,
    stems: Stems,
    leaves: Leaves,
}

impl Walk<'_> {
    fn run(&mut self, tree: &mut Tree) -> Result<(), GrowFault> {
        let program = &self.derived.system.program;
        let keys = &self.derived.modules.keys;
        for (number, (kind, values)) in self.derived.modules.iter(&program.kinds).enumerate() {
            match kind.command {
                Command::Open => {
                    self.stack.push(self.pen);
                    self.begun += 1;
                    let parent = self.pen.at.branch;
                    self.pen.at = At { branch: self.begun, gap: false };
                    self.pen.rotation = 0.0;
                    self.pen.width *= self.steps.branch_thinning;
                    self.stems.begin(self.begun, parent);
                }
                Command::Close => {
                    self.tip(tree);
                    if let Some(pen) = self.stack.pop() {
                        self.pen = pen;
                    }
                }
                Command::Forward => {
                    let key = keys.get(number).copied().unwrap_or(self.derived.key);
                    self.forward(values, key, tree);
                }
                Command::Move => {
                    let length = self.pen.length(values, &self.steps);
                    self.pen.turtle.walk(length);
                    self.pen.at.gap = true;
                    self.corner();
                }
                Command::Leaf => {
                    let mut turtle = self.pen.turtle;
                    turtle.roll_right(values.first().unwrap_or(&0.0).to_radians());
                    turtle.pitch_down(values.get(1).unwrap_or(&0.0).to_radians());
                    self.leaves.put(turtle, self.stems.host(self.pen.at.branch), tree);
                }
                Command::End => self.stems.end(self.pen.at.branch, tree),
                Command::OpenPolygon => self.polygons.push(vec![self.pen.turtle.position]),
                Command::ClosePolygon => {
                    let corners = self.polygons.pop().unwrap_or_default();
                    self.leaves.polygon(&corners, self.stems.host(self.pen.at.branch), tree);
                }
                Command::Vertex => self.corner(),
                command => self.pen.obey(command, values, &self.steps),
            }
            // Leaves stand on the bark.
            let is_sane = self.pen.radius(&self.steps).abs() < MAX_POSITION;
            if !is_sane || is_beyond(self.pen.turtle.position) {
                return Err(GrowFault::NotFinite);
            }
        }
        Ok(())
    }

    fn corner(&mut self) {
        let position = self.pen.turtle.position;
        if let Some(corners) = self.polygons.last_mut()
            && corners.last().is_none_or(|last| last.distance(position) > 1e-9)
        {
            corners.push(position);
        }
    }

    fn forward(&mut self, values: &[f64], key: Key, tree: &mut Tree) {
        let dialect = self.derived.system.program.dialect;
        let is_smooth = dialect == crate::syntax::Dialect::Hewitt;
        if self.pen.at.gap && self.stems.pieces(self.pen.at.branch) > 0 {
            self.begun += 1;
            self.stems.beside(self.begun, self.pen.at.branch, tree);
            self.pen.at.branch = self.begun;
        }
        self.pen.at.gap = false;
        if self.steps.bendiness > 0.0 {
            let side = key.unit(purpose::BEND, 1) * TAU;
            let turtle = &mut self.pen.turtle;
            let axis = turtle.right * math::cos(side) + turtle.down() * math::sin(side);
            let angle = key.unit(purpose::BEND, 0) * self.steps.bendiness;
            turtle.rotate_about(axis, angle.to_radians());
        }
        if is_smooth {
            self.pen.bend(dialect, &self.steps);
        }
        let length = self.pen.length(values, &self.steps);
        let from = self.pen.turtle;
        self.pen.turtle.walk(length);
        let knot = self.stems.piece(
            &from,
            length,
            self.pen.radius(&self.steps),
            is_smooth,
            self.pen.at.branch,
            tree,
        );
        let count = leaves_of(values);
        if count > 0 {
            // Less whole turns, so that sums of turns are finite.
            let turn = values.get(3).copied().unwrap_or(0.0) % MAX_TURN;
            let group = leaves::Group {
                first_knot: knot,
                right: from.right,
                stem: self.stems.host(self.pen.at.branch),
                count,
                down: values.get(2).copied().unwrap_or(0.0),
                turn,
                rotation: self.pen.rotation,
            };
            self.leaves.group(group);
            self.pen.rotation += f64::from(count) * turn;
        }
        self.corner();
        if !is_smooth {
            self.pen.bend(dialect, &self.steps);
        }
    }

    /// A branch may end in a cone and a leaf.
    fn tip(&mut self, tree: &mut Tree) {
        let branch = self.pen.at.branch;
        if self.steps.tips && self.survey.branches[branch as usize].pieces > 0 {
            self.stems.end(branch, tree);
            self.leaves.put(self.pen.turtle, self.stems.host(branch), tree);
        }
    }
}
