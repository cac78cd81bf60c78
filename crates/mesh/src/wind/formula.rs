//! Where wind moves a vertex: what shaders are to do, once more on the processor.

use crate::block::Wind;
use glam::{Quat, Vec3};
use pleach_plant::math::sin_cos_f32;
use std::f32::consts::TAU;

/// The wind at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breeze {
    /// Where it blows to, z up; of length 1 in a fresh breeze.
    pub wind: Vec3,
    /// In seconds.
    pub time: f32,
    /// Height of the tree in metres.
    pub height: f32,
}

/// Part of a radian that no body turns by more.
const MAX_TURN: f32 = 0.25;
/// How far the top of a tree leans in a fresh breeze, over its height.
const LEAN: f32 = 0.03;

fn sin_turns(turns: f32) -> f32 {
    sin_cos_f32(TAU * (turns - turns.floor())).0
}

/// Where a vertex is in wind that is at `position` with `normal` at rest, in metres, z up.
///
/// All steps are functions of the position at which they find the vertex, so that two vertices in one place that are
/// carried by one body stay in one place. The base of a body does not move when the body turns, and so it stays where
/// what carries it is. `docs/wind.md` has the same as shaders.
#[must_use]
pub fn moved(position: Vec3, normal: Vec3, wind: &Wind, breeze: &Breeze) -> Vec3 {
    let Wind { pivot, bend, phase, parent_pivot, parent_bend, parent_phase, flutter, .. } = *wind;
    let along = position.dot(Vec3::new(1.3, 1.7, 0.9));
    let shiver = sin_turns(3.0 * breeze.time + phase + along) * breeze.wind.length();
    let at = position + normal * (flutter * shiver);
    let at = turned(at, pivot, bend, phase, breeze);
    let at = turned(at, parent_pivot, parent_bend, parent_phase, breeze);
    leaned(at, breeze)
}

/// About the base of a body, the more the further from it.
fn turned(at: Vec3, pivot: Vec3, bend: Vec3, phase: f32, breeze: &Breeze) -> Vec3 {
    let stiff = bend.length();
    if stiff == 0.0 {
        return at;
    }
    let arm = at - pivot;
    // Small bodies are quick.
    let turns = (0.25 + 1.5 * stiff.sqrt()) * breeze.time + phase;
    let bob = 0.25 * breeze.wind.length() * sin_turns(1.37 * turns + 0.3);
    let force = breeze.wind * (0.4 + 0.6 * sin_turns(turns)) + Vec3::Z * bob;
    let turn = bend.cross(force) * arm.length();
    let angle = turn.length();
    if angle == 0.0 {
        return at;
    }
    pivot + Quat::from_axis_angle(turn / angle, angle / (1.0 + angle / MAX_TURN)) * arm
}

/// The whole tree, by the height above the ground.
fn leaned(at: Vec3, breeze: &Breeze) -> Vec3 {
    let up = at.z.max(0.0);
    let gust = LEAN * (0.5 + 0.5 * sin_turns(0.21 * breeze.time));
    let bow = breeze.wind * (gust / breeze.height.max(1e-3));
    at + bow * (up * up) - Vec3::Z * (bow.length_squared() * up * up * up * 2.0 / 3.0)
}
