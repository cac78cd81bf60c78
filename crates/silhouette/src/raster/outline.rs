//! Leaf outlines with no more corners than can be seen.

use pleach_tree::leaf_shape::LeafShape;

/// Removes corners of a closed outline while the new edge passes within `tolerance` of the removed
/// corner, then scales what is left about its centroid so that its area stays the same.
///
/// `scale` is the size of a unit along u and v, in the units of `tolerance`. At least three corners
/// stay, four where there were more.
fn simplify(shape: LeafShape, scale: [f32; 2], tolerance: f32, kept: &mut Vec<[f32; 2]>) {
    fill(shape, kept);
    let least = kept.len().min(4);
    let full = area(kept);
    while kept.len() > least {
        let n = kept.len();
        let (corner, off) = (0..n)
            .map(|i| (i, height(kept[(i + n - 1) % n], kept[i], kept[(i + 1) % n], scale)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0, f32::INFINITY));
        if off > tolerance {
            break;
        }
        kept.remove(corner);
    }
    let left = area(kept);
    if left.abs() > 0.05 * full.abs() {
        let factor = (full / left).abs().sqrt();
        let n = kept.len() as f32;
        let center = kept.iter().fold([0.0, 0.0], |c, p| [c[0] + p[0] / n, c[1] + p[1] / n]);
        for p in kept {
            *p = [center[0] + (p[0] - center[0]) * factor, center[1] + (p[1] - center[1]) * factor];
        }
    } else {
        // Nothing like the shape is left of it: keep it whole.
        fill(shape, kept);
    }
}

/// The whole outline of `shape`, into memory that is at hand.
fn fill(shape: LeafShape, corners: &mut Vec<[f32; 2]>) {
    let half = shape.half_outline();
    corners.clear();
    corners.extend_from_slice(half);
    corners.extend(half.iter().rev().filter(|p| p[0] > 0.0).map(|p| [-p[0], p[1]]));
}

/// Distance of `b` from the line through `a` and `c`, or from `a` if they coincide.
fn height(a: [f32; 2], b: [f32; 2], c: [f32; 2], scale: [f32; 2]) -> f32 {
    let to = |p: [f32; 2]| [(p[0] - a[0]) * scale[0], (p[1] - a[1]) * scale[1]];
    let (ab, ac) = (to(b), to(c));
    let length = ac[0].hypot(ac[1]);
    if length < 1e-12 { ab[0].hypot(ab[1]) } else { (ab[0] * ac[1] - ab[1] * ac[0]).abs() / length }
}

fn area(corners: &[[f32; 2]]) -> f32 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f32>() / 2.0
}

/// The outline of one leaf shape at one size, kept from one tree to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct OutlineCache {
    key: Option<(LeafShape, [u32; 2])>,
    corners: Vec<[f32; 2]>,
}

/// Tolerance of outlines in pixels: over half a sample's height.
const TOLERANCE: f32 = 0.15;
/// And as a part of a leaf's width: needles far thinner than a pixel keep their shape, since longer
/// ones of the same area would overlap less.
const RELATIVE_TOLERANCE: f32 = 0.1;

impl OutlineCache {
    /// The outline of `shape` for leaves whose unit measures `scale` pixels across and along.
    ///
    /// Sizes within a tenth share an outline, so that a search over leaf sizes seldom makes one.
    pub(crate) fn get(&mut self, shape: LeafShape, scale: [f32; 2]) -> &[[f32; 2]] {
        let step = |s: f32| (s.clamp(1e-4, 1e6).ln() * 10.0).round();
        let steps = scale.map(step);
        let key = (shape, steps.map(f32::to_bits));
        if self.key != Some(key) {
            self.key = Some(key);
            let scale = steps.map(|s| (s / 10.0).exp());
            let width = 2.0 * shape.half_outline().iter().map(|p| p[0]).fold(0.0, f32::max);
            let least = (width * scale[0]).min(scale[1]);
            simplify(shape, scale, TOLERANCE.min(RELATIVE_TOLERANCE * least), &mut self.corners);
        }
        &self.corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_leaves_have_few_corners_and_the_same_area() {
        for shape in LeafShape::ALL {
            let full = shape.outline();
            let mut last = full.len();
            for size in [100.0, 10.0, 3.0, 1.0, 0.1] {
                let mut outline = Vec::new();
                simplify(shape, [size, size], TOLERANCE, &mut outline);
                assert!(outline.len() <= last, "{shape:?} at {size}: {} corners", outline.len());
                assert!((area(&outline) / shape.area() - 1.0).abs() < 1e-3, "{shape:?} at {size}");
                last = outline.len();
            }
            // Three lobes of a palmate leaf cannot be had with fewer than six corners.
            assert!(last <= 7, "{shape:?}: {last}");
            let mut outline = Vec::new();
            simplify(shape, [1e5, 1e5], TOLERANCE, &mut outline);
            assert_eq!(outline.len(), full.len(), "{shape:?}");
        }
    }
}
