//! Leaf outlines with no more corners than can be seen.

use pleach_plant::Leaf;
use pleach_plant::leaf_shape::Outline;
use pleach_plant::math;

/// Removes corners of a closed outline while the new edge passes within `tolerance` of the removed
/// corner, then scales what is left about its centroid so that its area stays the same.
///
/// `scale` is the size of a unit along u and v, in the units of `tolerance`. At least three corners
/// stay, four where there were more.
fn simplify(shape: &Outline, scale: [f32; 2], tolerance: f32, kept: &mut Vec<[f32; 2]>) {
    kept.clear();
    kept.extend_from_slice(shape.corners());
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
        // Too little is left of the shape: keep it whole.
        kept.clear();
        kept.extend_from_slice(shape.corners());
    }
}

/// Distance of `b` from the line through `a` and `c`, or from `a` if they coincide.
fn height(a: [f32; 2], b: [f32; 2], c: [f32; 2], scale: [f32; 2]) -> f32 {
    let to = |p: [f32; 2]| [(p[0] - a[0]) * scale[0], (p[1] - a[1]) * scale[1]];
    let (ab, ac) = (to(b), to(c));
    let length = math::hypotf(ac[0], ac[1]);
    if length < 1e-12 { math::hypotf(ab[0], ab[1]) } else { (ab[0] * ac[1] - ab[1] * ac[0]).abs() / length }
}

fn area(corners: &[[f32; 2]]) -> f32 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f32>() / 2.0
}

/// By how much the squares of two leaves' measures may differ for both to be drawn with one outline.
const ALIKE: f32 = 1e-3;

/// Whether one simplified outline serves both leaves: the same shape, nearly the same size.
pub(crate) fn look_alike(one: &Leaf, other: &Leaf) -> bool {
    Looks::new(one).are_those(&Looks::new(other))
}

/// Shape and size of a leaf.
pub(super) struct Looks {
    shape: u16,
    along: f32,
    across: f32,
}

impl Looks {
    pub(super) fn new(leaf: &Leaf) -> Self {
        let Leaf { along, across, shape, .. } = leaf;
        Self { shape: *shape, along: along.length_squared(), across: across.length_squared() }
    }

    /// Whether one simplified outline serves both.
    pub(super) fn are_those(&self, other: &Self) -> bool {
        let near = |a: f32, b: f32| (a - b).abs() <= ALIKE * a.abs();
        self.shape == other.shape && near(self.along, other.along) && near(self.across, other.across)
    }
}

/// Tolerance of outlines in pixels: over half a sample's height.
const TOLERANCE: f32 = 0.15;
/// And as a part of a leaf's width: needles far thinner than a pixel keep their shape, since longer
/// ones of the same area would overlap less.
const RELATIVE_TOLERANCE: f32 = 0.1;

/// A simplified outline, and how far it reaches from the stalk in units of the leaf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blade<'a> {
    pub(crate) outline: &'a [[f32; 2]],
    pub(crate) half_width: f32,
    pub(crate) lowest: f32,
    pub(crate) highest: f32,
}

/// Simplified outlines of the last few shapes and sizes, kept from one tree to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outlines {
    known: Vec<Known>,
    /// Which of `known` is replaced next.
    oldest: usize,
}

#[derive(Clone, Debug)]
struct Known {
    shape: Outline,
    /// Logarithms of the size in tenths.
    steps: [f32; 2],
    /// Sizes that surely have these logarithms, from and to: a comparison is faster than a logarithm.
    surely: [[f32; 2]; 2],
    corners: Vec<[f32; 2]>,
    half_width: f32,
    lowest: f32,
    highest: f32,
}

impl Known {
    fn new(shape: &Outline, steps: [f32; 2]) -> Self {
        let scale = steps.map(|s| math::expf(s / 10.0));
        let least = (shape.width() * scale[0]).min(scale[1]);
        let mut corners = Vec::new();
        simplify(shape, scale, TOLERANCE.min(RELATIVE_TOLERANCE * least), &mut corners);
        let (half_width, lowest, highest) = corners.iter().fold((0.0, 0.0, 0.0), |(w, l, h), p| {
            (f32::max(w, p[0].abs()), f32::min(l, p[1]), f32::max(h, p[1]))
        });
        let surely = steps.map(|s| [s - HALF_STEP, s + HALF_STEP].map(|s| math::expf(s / 10.0)));
        Self { shape: shape.clone(), steps, surely, corners, half_width, lowest, highest }
    }

    /// Whether leaves of `scale` surely have its logarithms.
    fn is_near(&self, scale: [f32; 2]) -> bool {
        let [[from, to], [low, high]] = self.surely;
        from < scale[0] && scale[0] < to && low < scale[1] && scale[1] < high
    }
}

/// Half of the distance between two logarithms in tenths, without what rounding may change.
const HALF_STEP: f32 = 0.499;

/// The smallest and the largest size that is told from others.
const MIN_SCALE: f32 = 1e-4;
const MAX_SCALE: f32 = 1e6;
/// Outlines that are kept: more than the shapes and sizes of most trees.
const MAX_KNOWN: usize = 32;

impl Outlines {
    /// The outline of `shape` for leaves whose unit measures `scale` pixels across and along.
    ///
    /// Sizes within a tenth share an outline, so that a search over leaf sizes seldom makes one.
    pub(crate) fn get(&mut self, shape: &Outline, scale: [f32; 2]) -> Blade<'_> {
        let near = self.known.iter().position(|known| known.is_near(scale) && known.shape == *shape);
        let known = near.unwrap_or_else(|| {
            let steps = scale.map(|s| (math::lnf(s.clamp(MIN_SCALE, MAX_SCALE)) * 10.0).round());
            let known = self.known.iter().position(|known| known.steps == steps && known.shape == *shape);
            known.unwrap_or_else(|| self.add(shape, steps))
        });
        let Known { corners, half_width, lowest, highest, .. } = &self.known[known];
        Blade { outline: corners, half_width: *half_width, lowest: *lowest, highest: *highest }
    }

    fn add(&mut self, shape: &Outline, steps: [f32; 2]) -> usize {
        let known = Known::new(shape, steps);
        if self.known.len() < MAX_KNOWN {
            self.known.push(known);
            return self.known.len() - 1;
        }
        let at = self.oldest;
        self.known[at] = known;
        self.oldest = (at + 1) % MAX_KNOWN;
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use pleach_plant::leaf_shape::LeafShape;

    #[test]
    fn small_leaves_have_few_corners_and_the_same_area() {
        for leaf in LeafShape::ALL {
            let shape = leaf.outline();
            let mut last = shape.corners().len();
            for size in [100.0, 10.0, 3.0, 1.0, 0.1] {
                let mut outline = Vec::new();
                simplify(shape, [size, size], TOLERANCE, &mut outline);
                assert!(outline.len() <= last, "{leaf:?} at {size}: {} corners", outline.len());
                assert!((area(&outline) / shape.area() - 1.0).abs() < 1e-3, "{leaf:?} at {size}");
                last = outline.len();
            }
            // Three lobes of a palmate leaf need at least six corners.
            assert!(last <= 7, "{leaf:?}: {last}");
            let mut outline = Vec::new();
            simplify(shape, [1e5, 1e5], TOLERANCE, &mut outline);
            assert_eq!(outline.len(), shape.corners().len(), "{leaf:?}");
        }
    }

    #[test]
    fn leaves_of_one_shape_and_size_share_an_outline() {
        let leaf = |length: f32, turn: f32, shape| Leaf {
            position: Vec3::ZERO,
            along: Vec3::new(turn.cos(), turn.sin(), 0.0) * length,
            across: Vec3::Z * length,
            stem: 0,
            shape,
        };
        assert!(look_alike(&leaf(0.3, 0.1, 0), &leaf(0.3, 2.0, 0)));
        assert!(!look_alike(&leaf(0.3, 0.1, 0), &leaf(0.3, 0.1, 1)));
        assert!(!look_alike(&leaf(0.3, 0.1, 0), &leaf(0.31, 0.1, 0)));
    }

    #[test]
    fn what_is_known_changes_no_outline() {
        let shape = LeafShape::Maple.outline();
        let (mut warm, mut shortcuts) = (Outlines::default(), 0);
        for i in 0..4000 {
            // Many lie at the edge between two logarithms.
            let size =
                [0, 1].map(|axis| math::expf((i * (axis + 3) % 29) as f32 / 20.0 + 1e-6 * (i % 7) as f32));
            shortcuts += usize::from(warm.known.iter().any(|known| known.is_near(size)));
            let mut fresh = Outlines::default();
            assert_eq!(warm.get(shape, size).outline, fresh.get(shape, size).outline, "{size:?}");
        }
        assert!(shortcuts > 100, "{shortcuts}");
    }

    #[test]
    fn outlines_are_remembered_and_the_oldest_forgotten() {
        let mut outlines = Outlines::default();
        let whole = |outlines: &mut Outlines, leaf: LeafShape| {
            let (found, all) = (outlines.get(leaf.outline(), [1e3, 1e3]).outline, leaf.outline().corners());
            let near = |(p, q): (&[f32; 2], &[f32; 2])| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-5;
            found.len() == all.len() && found.iter().zip(all).all(near)
        };
        for size in 0..100 {
            let _ = outlines.get(LeafShape::Maple.outline(), [1.0 + size as f32, 1.0]);
            assert!(LeafShape::ALL.into_iter().all(|leaf| whole(&mut outlines, leaf)));
        }
        assert_eq!(outlines.known.len(), MAX_KNOWN);
    }
}
