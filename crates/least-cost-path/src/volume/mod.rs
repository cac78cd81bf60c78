//! Volumes that nodes are thrown into: unions of solids.

mod first;
pub(crate) mod outline;
mod solid;

pub(crate) use first::{first, underground};
pub(crate) use solid::Solid;

use glam::{DMat3, DVec3};

/// A solid in its place.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) solid: Solid,
    pub(crate) origin: DVec3,
    /// Its three axes as columns.
    pub(crate) frame: DMat3,
    /// Whether endpoints may lie in it.
    pub(crate) is_crown: bool,
}

impl Part {
    /// A solid whose axis points along `axis`, a unit vector.
    pub(crate) fn new(solid: Solid, origin: DVec3, axis: DVec3, is_crown: bool) -> Self {
        let (x, y) = axis.any_orthonormal_pair();
        let upright = axis == DVec3::Z;
        let frame = if upright { DMat3::IDENTITY } else { DMat3::from_cols(x, y, axis) };
        Self { solid, origin, frame, is_crown }
    }

    pub(crate) fn to_local(&self, p: DVec3) -> DVec3 {
        self.frame.transpose() * (p - self.origin)
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        let (low, high) = self.solid.bounds();
        let corner = |i: u32| {
            let pick = |bit: u32, a: f64, b: f64| if i >> bit & 1 == 0 { a } else { b };
            let local = DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z));
            self.origin + self.frame * local
        };
        let first = corner(0);
        (1..8).map(corner).fold((first, first), |(low, high), p| (low.min(p), high.max(p)))
    }
}

/// On which side of the ground a volume lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Above,
    Below,
}

/// A union of solids on one side of the ground.
#[derive(Clone, Debug)]
pub(crate) struct Volume {
    pub(crate) parts: Vec<Part>,
    pub(crate) side: Side,
    /// Stretches from the root upwards along which nodes are put first.
    pub(crate) axes: Vec<Axis>,
    /// Where the parts that refine a crown lie, as stretches from its foot; empty if it is whole.
    pub(crate) clusters: Vec<(DVec3, DVec3)>,
    /// Content of the union on this side.
    pub(crate) content: f64,
}

/// A stretch that gets nodes along it, so that it is never cut.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) from: DVec3,
    pub(crate) to: DVec3,
    /// How far its nodes may lie off it.
    pub(crate) wander: f64,
}

/// Points with which shares of a volume are measured.
const PROBES: u32 = 128;

impl Volume {
    /// A volume of one part.
    pub(crate) fn from_part(part: Part, side: Side) -> Self {
        Self::new(vec![part], side)
    }

    /// The union of `parts`, at least one.
    pub(crate) fn new(parts: Vec<Part>, side: Side) -> Self {
        let mut volume = Self { parts, side, axes: Vec::new(), clusters: Vec::new(), content: 0.0 };
        volume.content = volume.measure();
        volume
    }

    fn is_on_side(&self, p: DVec3) -> bool {
        match self.side {
            Side::Above => p.z >= 0.0,
            Side::Below => p.z <= 0.0,
        }
    }

    fn raw_content(&self) -> f64 {
        self.parts.iter().map(|part| part.solid.content()).sum()
    }

    /// Content of the union; where parts overlap or lie on both sides, measured with a fixed set of
    /// points.
    fn measure(&self) -> f64 {
        let whole = |part: &Part| match self.side {
            Side::Above => part.bounds().0.z >= -1e-9,
            Side::Below => part.bounds().1.z <= 1e-9,
        };
        if let [only] = self.parts.as_slice()
            && whole(only)
        {
            return only.solid.content();
        }
        let share = |(index, part): (usize, &Part)| {
            let probe = |i: u32| {
                // A sequence that fills a cube evenly, by powers of the root of x⁴ = x + 1.
                let at = |root: f64| ((f64::from(i) + 0.5) * root).fract();
                part.solid.point([
                    at(0.819_172_513_396_164_4),
                    at(0.671_043_606_703_789_2),
                    at(0.549_700_477_901_97),
                ])
            };
            let probes = (0..PROBES).filter_map(probe);
            let (hits, all) = probes.fold((0_u32, 0_u32), |(hits, all), p| {
                let p = part.origin + part.frame * p;
                (hits + u32::from(self.is_on_side(p) && self.is_first(index, p)), all + 1)
            });
            part.solid.content() * f64::from(hits) / f64::from(all.max(1))
        };
        self.parts.iter().enumerate().map(share).sum()
    }

    /// Whether no part before `index` holds `p`.
    fn is_first(&self, index: usize, p: DVec3) -> bool {
        !self.parts[..index].iter().any(|part| part.solid.holds(part.to_local(p)))
    }

    /// Picks a part by content and throws a dart into it; `None` where the dart misses the union or
    /// would be counted twice.
    pub(crate) fn dart(&self, pick: f64, u: [f64; 3]) -> Option<(DVec3, usize)> {
        let mut index = 0;
        if self.parts.len() > 1 {
            let mut rest = pick * self.raw_content();
            while index + 1 < self.parts.len() && rest >= self.parts[index].solid.content() {
                rest -= self.parts[index].solid.content();
                index += 1;
            }
        }
        let part = &self.parts[index];
        let p = part.origin + part.frame * part.solid.point(u)?;
        (self.is_on_side(p) && self.is_first(index, p)).then_some((p, index))
    }

    /// Whether `p`, in part number `index`, may be an endpoint.
    pub(crate) fn may_end(&self, p: DVec3, index: usize, shell: f64) -> bool {
        let part = &self.parts[index];
        part.is_crown && (shell >= 1.0 || part.solid.in_shell(part.to_local(p), shell))
    }

    /// Two opposite corners of a box that holds it.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let grown = |(low, high): (DVec3, DVec3), part: &Part| {
            let (a, b) = part.bounds();
            (low.min(a), high.max(b))
        };
        self.parts.iter().fold(start, grown)
    }
}
