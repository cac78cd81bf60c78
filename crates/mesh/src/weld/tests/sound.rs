//! What makes a welded surface sound.
//!
//! No face is turned inside out, and this is why: a surface that is closed, wound alike everywhere, in one
//! piece, and that never meets itself parts space in two (Jordan and Brouwer), so that either all of its
//! faces look outwards or none does. The sign of its volume says which.

use super::*;
use glam::DVec3;

/// Least height of a face, in cells.
const MIN_HEIGHT: f64 = 0.02;
/// The cosine of the angle between the normals of neighbours is more than this: none is folded back onto
/// the other. Where a gap between two stems closes, or one ends in a point, faces do meet in sharp angles;
/// this one is six degrees.
const MAX_FOLD: f64 = -0.995;

fn corner(block: &Block, i: u32) -> DVec3 {
    block.vertices[i as usize].position.as_dvec3()
}

fn face(block: &Block, triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|i| corner(block, i))
}

fn cross([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// The edges of all faces in both directions, and the face of each, in order.
fn edges(block: &Block) -> Vec<([u32; 2], usize)> {
    let of = |(i, &[a, b, c]): (usize, &[u32; 3])| [([a, b], i), ([b, c], i), ([c, a], i)];
    let mut edges: Vec<_> = block.triangles.iter().enumerate().flat_map(of).collect();
    edges.sort_unstable();
    edges
}

/// Each edge has one face on each side, wound alike, and around each corner there is one fan of faces.
pub(super) fn check_closed(block: &Block) {
    let edges = edges(block);
    let find = |edge: [u32; 2]| edges.binary_search_by_key(&edge, |(edge, _)| *edge);
    for pair in edges.windows(2) {
        assert_ne!(pair[0].0, pair[1].0, "an edge has two faces on one side");
    }
    for &([a, b], _) in &edges {
        assert!(find([b, a]).is_ok(), "an edge has one face");
    }
    for fan in edges.chunk_by(|(a, _), (b, _)| a[0] == b[0]) {
        let (middle, first) = (fan[0].0[0], fan[0].1);
        let mut at = first;
        let mut count = 0;
        loop {
            count += 1;
            let t = block.triangles[at];
            let k = t.iter().position(|&i| i == middle).unwrap();
            at = edges[find([middle, t[(k + 2) % 3]]).unwrap()].1;
            if at == first {
                break;
            }
        }
        assert_eq!(count, fan.len(), "two fans meet in a corner");
    }
    let used: std::collections::BTreeSet<u32> = block.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), block.vertices.len(), "a corner has no face");
}

/// Closed, outwards, no face without an area, and no face folded onto its neighbour.
pub(super) fn check_sound(block: &Block, cell: f64) {
    check_closed(block);
    assert!(volume(block) > 0.0, "inside out");
    let normals: Vec<DVec3> = block.triangles.iter().map(|t| cross(face(block, *t))).collect();
    for (t, normal) in block.triangles.iter().zip(&normals) {
        let [a, b, c] = face(block, *t);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height = normal.length() / longest;
        assert!(height > MIN_HEIGHT * cell, "a face is {} cells high", height / cell);
    }
    let edges = edges(block);
    for &([a, b], i) in edges.iter().filter(|([a, b], _)| a < b) {
        let other = edges[edges.binary_search_by_key(&[b, a], |(edge, _)| *edge).unwrap()].1;
        let fold = normals[i].normalize().dot(normals[other].normalize());
        assert!(fold > MAX_FOLD, "two neighbours are folded together: {fold}");
    }
    for v in &block.vertices {
        assert!(v.position.is_finite() && (v.normal.length() - 1.0).abs() < 1e-4);
    }
}

/// Whether the open segment goes through the triangle.
fn goes_through(from: DVec3, to: DVec3, [a, b, c]: [DVec3; 3]) -> bool {
    let side = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
    if side(a, b, c, from) * side(a, b, c, to) >= 0.0 {
        return false;
    }
    let [u, v, w] = [side(from, to, a, b), side(from, to, b, c), side(from, to, c, a)];
    (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0)
}

/// No two faces meet but in the corners and edges that they share.
pub(super) fn check_apart(block: &Block) {
    let bounds = |t: &[u32; 3]| {
        let [a, b, c] = face(block, *t);
        (a.min(b).min(c), a.max(b).max(c))
    };
    let mut order: Vec<([u32; 3], DVec3, DVec3)> =
        block.triangles.iter().map(|t| (*t, bounds(t).0, bounds(t).1)).collect();
    order.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
    let enters = |one: [u32; 3], other: [u32; 3]| {
        (0..3).any(|k| {
            let (i, j) = (one[k], one[(k + 1) % 3]);
            // What shares a corner touches there; neighbours are looked at elsewhere.
            !other.contains(&i)
                && !other.contains(&j)
                && goes_through(corner(block, i), corner(block, j), face(block, other))
        })
    };
    for (i, (one, low, high)) in order.iter().enumerate() {
        for (other, from, to) in order[i + 1..].iter().take_while(|(_, from, _)| from.x <= high.x) {
            if from.cmple(*high).all() && to.cmpge(*low).all() {
                assert!(!enters(*one, *other) && !enters(*other, *one), "two faces meet");
            }
        }
    }
}

/// Where one stem is nearest by more than a cell, and no foot is near, so that the distance is smooth: faces
/// look the way in which it grows. In corners between stems that the cells are too large for, faces bridge
/// what the distance has not, and there is nothing to compare them with.
pub(super) fn check_outwards(block: &Block, stems: &Stems, cell: f64) {
    let mut local = local::Local::new(stems, &nearby::Nearby::all(stems), DVec3::ZERO);
    for t in block.triangles.iter().step_by(7) {
        let face = face(block, *t);
        let middle = (face[0] + face[1] + face[2]) / 3.0;
        let mut distances: Vec<f64> = stems.cones.iter().map(|cone| cone.distance(middle)).collect();
        distances.sort_by(f64::total_cmp);
        let is_smooth = distances.get(1).is_none_or(|second| second - distances[0] > cell);
        let is_near_foot = stems.cones.iter().any(|cone| cone.foot_near(middle, 1.5 * cell));
        if is_smooth && !is_near_foot {
            let small = 1e-4 * cell;
            let slope = DVec3::AXES
                .map(|axis| local.distance(middle + axis * small) - local.distance(middle - axis * small));
            assert!(cross(face).dot(DVec3::from_array(slope)) > 0.0, "a face is turned at {middle}");
        }
    }
}

pub(super) fn pieces(block: &Block) -> usize {
    shells::Shells::new(block.vertices.len(), &block.triangles).count()
}

/// Volume by the divergence theorem; positive where faces look outwards.
pub(super) fn volume(block: &Block) -> f64 {
    let six = |t: &[u32; 3]| corner(block, t[0]).dot(corner(block, t[1]).cross(corner(block, t[2])));
    block.triangles.iter().map(six).sum::<f64>() / 6.0
}
