//! Sway as an animation that loops: rotations of the joints of a rig.
//!
//! Each joint leans with a wind along +x by a part of its amplitude and sways about that lean, in the
//! wind's direction and, slower and weaker, across it (the shape of Weber and Penn 1995, §4.7).
//! Frequencies are rounded to whole cycles a loop.

use super::upright;
use crate::rig::{Joint, Rig};
use glam::{Quat, Vec3};
use pleach_plant::trig::sin_cos;
use std::f64::consts::TAU;

/// Length of the loop in seconds.
const SECONDS: u32 = 8;
/// Keys of every joint: twelve a second, and the first again at the end.
pub(super) const KEYS: u32 = SECONDS * 12 + 1;
/// Most cycles a loop that twelve keys a second can show, six keys each.
const MAX_CYCLES: f64 = 16.0;

/// Times of the keys in seconds.
pub(super) fn times() -> Vec<f32> {
    (0..KEYS).map(|k| k as f32 / 12.0).collect()
}

/// Translation of each joint against its parent, in the file's axes.
pub(super) fn translations(rig: &Rig) -> Vec<Vec3> {
    let pivot = |joint: &Joint| {
        let parent = joint.parent.map_or(glam::DVec3::ZERO, |p| rig.joints[usize::from(p)].pivot);
        upright((joint.pivot - parent).as_vec3())
    };
    rig.joints.iter().map(pivot).collect()
}

/// Inverse bind matrices, column by column: back to each joint's pivot.
pub(super) fn bind_matrices(rig: &Rig) -> Vec<f32> {
    // The sum of translations, as a viewer adds them up, so that rest is exactly rest.
    let mut at: Vec<Vec3> = Vec::with_capacity(rig.joints.len());
    for (joint, translation) in rig.joints.iter().zip(translations(rig)) {
        at.push(joint.parent.map_or(Vec3::ZERO, |p| at[usize::from(p)]) + translation);
    }
    at.iter().flat_map(|&p| glam::Mat4::from_translation(-p).to_cols_array()).collect()
}

/// Rotations of all joints, one joint's keys after the other's, as quaternions x, y, z, w.
pub(super) fn rotations(rig: &Rig) -> Vec<f32> {
    let mut rotations = Vec::with_capacity(rig.joints.len() * KEYS as usize * 4);
    for joint in &rig.joints {
        let sway = joint.sway;
        let cycles = (sway.frequency * f64::from(SECONDS)).round().clamp(1.0, MAX_CYCLES);
        let across = (cycles * 0.7).round().max(1.0);
        for key in 0..KEYS {
            // The last key is the first, bit for bit.
            let part = f64::from(key % (KEYS - 1)) / f64::from(KEYS - 1);
            let wave = |cycles: f64| sin_cos(TAU * (cycles * part + sway.phase)).0;
            let along = sway.amplitude * (0.35 + 0.65 * wave(cycles));
            let side = sway.amplitude * 0.3 * wave(across);
            // Leaning towards +x is a turn about +y of the tree, which is -z of the file.
            let turn = Quat::from_axis_angle(Vec3::NEG_Z, along as f32)
                * Quat::from_axis_angle(Vec3::X, side as f32);
            rotations.extend_from_slice(&turn.normalize().to_array());
        }
    }
    rotations
}
