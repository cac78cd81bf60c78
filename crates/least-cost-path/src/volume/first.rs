//! The volume of the first graph, from a species' numbers.

use super::outline::Outline;
use super::{Axis, Part, Side, Solid, Volume};
use crate::numbers::{CrownShape, Numbers};
use crate::purpose::CLUSTER;
use glam::DVec3;
use pleach_tree::Key;
use pleach_tree::math;
use pleach_tree::trig::sin_cos;
use std::f64::consts::PI;
use std::sync::Arc;

/// The trunk's cylinder and the crown above it. `drawn` stands for the profile among the numbers.
pub(crate) fn first(n: &Numbers, drawn: Option<&Arc<Outline>>, key: Key) -> Volume {
    let lean = n.trunk_lean.to_radians();
    let ((sin, cos), (y, x)) = (sin_cos(lean), sin_cos(n.trunk_lean_azimuth.to_radians()));
    let trunk_axis = DVec3::new(sin * x, sin * y, cos);
    let has_trunk = n.trunk_height > 0.0;
    let fork = if has_trunk { trunk_axis * n.trunk_height } else { DVec3::ZERO };
    let (solid, mut foot) = crown(n, drawn);
    if let (true, Solid::Portion { .. }) = (has_trunk, &solid) {
        // A narrow portion meets the cylinder at the cylinder's width, not in a point.
        let alpha = n.crown_angle.to_radians();
        if alpha < 0.45 * PI {
            foot -= n.trunk_width / math::tan(alpha);
        }
    }
    let crown = Part::new(solid, fork + DVec3::Z * foot, DVec3::Z, true);
    let top = crown.origin + DVec3::Z * crown.solid.top();
    let mut parts = Vec::new();
    let mut axes = Vec::new();
    let is_led = n.axis_cost < 1.0;
    if has_trunk {
        let solid = Solid::Cylinder { radius: n.trunk_width, height: n.trunk_height };
        parts.push(Part::new(solid, DVec3::ZERO, trunk_axis, false));
        axes.push(Axis { from: DVec3::ZERO, to: fork, wander: if is_led { 0.0 } else { n.trunk_width } });
    }
    if is_led {
        axes.push(Axis { from: fork, to: top, wander: 0.0 });
    }
    let clusters = if n.clusters > 0.0 { refine(&mut parts, &crown, fork, n, key) } else { Vec::new() };
    if clusters.is_empty() {
        parts.push(crown);
    }
    let wander = n.cluster_size * 0.3 * n.crown_radius / math::cbrt(n.clusters.max(1.0));
    axes.extend(clusters.iter().map(|&(from, to)| Axis { from, to, wander }));
    Volume { axes, clusters, ..Volume::new(parts, Side::Above) }
}

/// The crown's solid, and how far above the fork its origin lies.
fn crown(n: &Numbers, drawn: Option<&Arc<Outline>>) -> (Solid, f64) {
    let (radius, height) = (n.crown_radius, n.crown_height);
    match n.crown_shape {
        CrownShape::SpherePortion => {
            (Solid::Portion { radius, cos: math::cos(n.crown_angle.to_radians()) }, 0.0)
        }
        CrownShape::Cone => (Solid::Cone { radius, height }, 0.0),
        CrownShape::Ellipsoid => (Solid::Ellipsoid { across: radius, along: height / 2.0 }, height / 2.0),
        CrownShape::Revolution => {
            let outline = match drawn {
                Some(drawn) if n.outline_scale == [1.0; 8] => Arc::clone(drawn),
                Some(drawn) => Arc::new(drawn.scaled(&n.outline_scale)),
                None => Arc::new(Outline::of_radii(&n.crown_profile)),
            };
            (Solid::Turned { outline, radius, height }, 0.0)
        }
    }
}

/// Adds what refines the crown to `parts`: spheres around coarse points and cones from them to the
/// fork. Returns the stretches from there to the points.
fn refine(parts: &mut Vec<Part>, crown: &Part, fork: DVec3, n: &Numbers, key: Key) -> Vec<(DVec3, DVec3)> {
    let wanted = n.clusters as usize;
    let spacing = math::cbrt(crown.solid.content() / wanted as f64);
    let radius = n.cluster_size * spacing;
    let mut points: Vec<DVec3> = Vec::new();
    for throw in 0..50 * wanted as u32 {
        let dart = key.child(CLUSTER, throw);
        let Some(p) = crown.solid.point([dart.unit(0, 0), dart.unit(0, 1), dart.unit(0, 2)]) else {
            continue;
        };
        let p = crown.origin + crown.frame * p;
        if p.z > 0.0 && points.iter().all(|other| other.distance(p) > 0.7 * spacing) {
            points.push(p);
        }
        if points.len() == wanted {
            break;
        }
    }
    for &p in &points {
        parts.push(Part::new(Solid::Portion { radius, cos: -1.0 }, p, DVec3::Z, true));
        let back = fork - p;
        let height = back.length();
        if height > radius {
            let solid = Solid::Cone { radius: 0.6 * radius, height };
            parts.push(Part::new(solid, p, back / height, false));
        }
    }
    points.into_iter().map(|p| (fork, p)).collect()
}

/// The half ellipsoid below ground that roots grow in.
pub(crate) fn underground(n: &Numbers) -> Volume {
    let solid = Solid::Ellipsoid { across: n.root_depth * n.root_spread, along: n.root_depth };
    let mut volume = Volume::from_part(Part::new(solid, DVec3::ZERO, DVec3::Z, true), Side::Below);
    let to = DVec3::Z * -n.root_depth;
    volume.axes.push(Axis { from: DVec3::ZERO, to, wander: 0.1 * n.root_depth });
    volume
}
