//! The turtle with a pen: what symbols do to it.

use crate::header::Header;
use crate::program::{Axis, Command};
use crate::syntax::{Dialect, SettingKey};
use glam::DVec3;
use pleach_tree::turtle::Turtle;
use std::f64::consts::PI;

/// What the header says about single steps. Angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steps {
    pub(crate) scale: f64,
    pub(crate) step: f64,
    pub(crate) angle: f64,
    pub(crate) thickness: f64,
    pub(crate) thinning: f64,
    pub(crate) branch_thinning: f64,
    pub(crate) tropism: DVec3,
    pub(crate) elasticity: f64,
    pub(crate) bendiness: f64,
    pub(crate) tips: bool,
}

impl Steps {
    /// What the header says about single steps.
    pub(crate) fn new(header: &Header) -> Self {
        Self {
            scale: header.get(SettingKey::Scale),
            step: header.get(SettingKey::Step),
            angle: header.get(SettingKey::Angle),
            thickness: header.get(SettingKey::Thickness),
            thinning: header.get(SettingKey::Thinning),
            branch_thinning: header.get(SettingKey::BranchThinning),
            tropism: header.tropism(),
            elasticity: header.get(SettingKey::Elasticity),
            bendiness: header.get(SettingKey::Bendiness),
            tips: header.get(SettingKey::Tips) > 0.5,
        }
    }
}

/// Which branch is drawn, and whether a gap came before the next piece.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct At {
    pub(crate) branch: u32,
    pub(crate) gap: bool,
}

/// What `[` saves and `]` brings back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    pub(crate) turtle: Turtle,
    /// Set by `!`, in the grammar's unit.
    pub(crate) width: f64,
    /// How far leaves have turned around the branch, degrees.
    pub(crate) rotation: f64,
    pub(crate) at: At,
}

impl Pen {
    /// The pen before the first symbol.
    pub(crate) fn new(header: &Header) -> Self {
        Self { turtle: Turtle::UP, width: header.get(SettingKey::Width), rotation: 0.0, at: At::default() }
    }

    /// The radius of what is drawn, metres.
    pub(crate) fn radius(&self, steps: &Steps) -> f64 {
        steps.thickness * self.width.max(0.0) * steps.scale
    }

    /// Obeys a command that draws nothing.
    pub(crate) fn obey(&mut self, command: Command, values: &[f64], steps: &Steps) {
        match command {
            Command::Rotate(axis, sign) => {
                let angle = sign * values.first().unwrap_or(&steps.angle).to_radians();
                match axis {
                    Axis::Turn => self.turtle.turn_right(-angle),
                    Axis::Pitch => self.turtle.pitch_down(angle),
                    Axis::Roll => self.turtle.roll_right(angle),
                }
            }
            Command::About => self.turtle.turn_right(PI),
            Command::Level => {
                // Left is level: right is the heading times up.
                if let Some(right) = self.turtle.direction.cross(DVec3::Z).try_normalize() {
                    self.turtle.right = right;
                }
            }
            Command::Upright => {
                // The right axis stays as near to itself as it can.
                let right = self.turtle.right.with_z(0.0);
                self.turtle.direction = DVec3::Z;
                self.turtle.right = right.try_normalize().unwrap_or(DVec3::X);
            }
            Command::Width => match values.first() {
                Some(&width) => self.width = width,
                None => self.width *= steps.thinning,
            },
            _ => {}
        }
    }

    /// Metres that a step goes.
    pub(crate) fn length(&self, values: &[f64], steps: &Steps) -> f64 {
        values.first().unwrap_or(&steps.step) * steps.scale
    }

    /// Bends towards the tropism: in Hewitt's dialect by degrees before a piece, in the book's by
    /// radians after it.
    pub(crate) fn bend(&mut self, dialect: Dialect, steps: &Steps) {
        let rate = match dialect {
            Dialect::Hewitt => steps.elasticity.to_radians(),
            Dialect::Abop => steps.elasticity,
        };
        self.turtle.lean(steps.tropism, rate);
    }
}
