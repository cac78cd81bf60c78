//! From units of the sliders to a tree in metres, within the limits.

use crate::params::Id;
use crate::skeleton::{Chain, Skeleton};
use glam::{DQuat, DVec3, Vec3};
use pleach_tree::{Blame, Blob, GrowError, Knot, Limits, Stem, Tree};

/// Steps of work that are left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    limit: u64,
    spent: u64,
}

impl Budget {
    pub(crate) const fn new(limits: &Limits) -> Self {
        Self { limit: limits.work, spent: 0 }
    }

    /// Takes `steps` for `parameter`.
    ///
    /// # Errors
    /// If fewer are left.
    pub(crate) fn spend(&mut self, steps: u64, parameter: Id) -> Result<(), GrowError> {
        self.spent = self.spent.saturating_add(steps);
        if self.spent > self.limit {
            return Err(GrowError::TooMuchWork { limit: self.limit, blame: blame(parameter) });
        }
        Ok(())
    }
}

fn blame(parameter: Id) -> Blame {
    Blame(vec![parameter.slot_name(0)])
}

/// Writes a tree.
pub(crate) struct Writer<'a> {
    pub(crate) tree: &'a mut Tree,
    pub(crate) limits: &'a Limits,
    /// Metres for one unit of the sliders.
    pub(crate) scale: f64,
    /// How the whole tree is turned about its foot, if it is.
    pub(crate) turn: Option<DQuat>,
}

impl Writer<'_> {
    /// Where a point is in metres.
    fn place(&self, point: DVec3) -> DVec3 {
        self.turn.map_or(point, |turn| turn * point) * self.scale
    }

    /// Writes all stems.
    ///
    /// # Errors
    /// If a limit is passed.
    pub(crate) fn skeleton(&mut self, skeleton: &Skeleton) -> Result<(), GrowError> {
        skeleton.chains.iter().try_for_each(|chain| self.stem(chain, skeleton.knots_of(chain)))
    }

    fn stem(&mut self, chain: &Chain, knots: &[Knot]) -> Result<(), GrowError> {
        let blame = || blame(Id::branch_quantity);
        if self.tree.stems.len() >= self.limits.stems {
            return Err(GrowError::TooManyStems { limit: self.limits.stems, blame: blame() });
        }
        if self.tree.knots.len() + knots.len() > self.limits.knots {
            return Err(GrowError::TooManyKnots { limit: self.limits.knots, blame: blame() });
        }
        self.tree.stems.push(Stem {
            parent: chain.parent,
            level: chain.level,
            kind: chain.kind,
            number: chain.number,
            offset: chain.offset * self.scale,
            first_knot: self.tree.knots.len() as u32,
            knot_count: knots.len() as u32,
        });
        self.tree.knots.reserve(knots.len());
        for knot in knots {
            let [point, handle_in, handle_out] =
                [knot.point, knot.handle_in, knot.handle_out].map(|point| self.place(point));
            self.tree.knots.push(Knot { point, handle_in, handle_out, radius: knot.radius * self.scale });
        }
        Ok(())
    }

    /// Writes a closed surface that stem number `stem` carries.
    ///
    /// # Errors
    /// If a limit is passed; a surface counts as a leaf.
    pub(crate) fn blob(
        &mut self,
        stem: u32,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
    ) -> Result<(), GrowError> {
        if self.tree.blobs.len() >= self.limits.leaves {
            return Err(GrowError::TooManyLeaves {
                limit: self.limits.leaves,
                blame: blame(Id::leaves_quantity),
            });
        }
        let placed = vertices.iter().map(|&vertex| self.place(vertex).as_vec3()).collect::<Vec<Vec3>>();
        let tree = &mut *self.tree;
        tree.blobs.push(Blob {
            stem,
            first_vertex: tree.blob_vertices.len() as u32,
            vertex_count: vertices.len() as u32,
            first_triangle: tree.blob_triangles.len() as u32,
            triangle_count: triangles.len() as u32,
        });
        tree.blob_vertices.extend(placed);
        tree.blob_triangles.extend_from_slice(triangles);
        Ok(())
    }
}
