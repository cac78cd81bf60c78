//! The maps of the same species by two ways of comparing numbers, and three ways between two species.

use pleach_blend::{Blend, BlendMap, Encoding, Settings};
use pleach_tree::Species;

/// How a blend of two species is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// Across the map by declared features.
    Map,
    /// By declared features of the two alone.
    Straight,
    /// Across the map by the plain list of numbers: the dissertation's way.
    Raw,
}

pub(super) const METHODS: [Method; 3] = [Method::Map, Method::Straight, Method::Raw];

impl Method {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Map => "map",
            Self::Straight => "straight",
            Self::Raw => "raw",
        }
    }
}

/// Both maps of the same species.
pub(super) struct Maps {
    pub(super) declared: BlendMap,
    pub(super) raw: BlendMap,
}

impl Maps {
    pub(super) fn new(species: &[Species]) -> anyhow::Result<Self> {
        let map = |features| BlendMap::new(species.to_vec(), Settings { features, dots: None });
        Ok(Self { declared: map(Encoding::Declared)?, raw: map(Encoding::Raw)? })
    }

    pub(super) fn species(&self) -> &[Species] {
        self.declared.landmarks().species()
    }

    pub(super) fn between(&self, method: Method, (a, b): (usize, usize), at: f64) -> anyhow::Result<Species> {
        let across = |map: &BlendMap| -> anyhow::Result<Species> {
            Ok(map.species_at(&map.at(map.between(a, b, at)?)?, "blend"))
        };
        match method {
            Method::Map => across(&self.declared),
            Method::Raw => across(&self.raw),
            Method::Straight => {
                let weights = self.declared.landmarks().between(a, b, at)?;
                let params = self.declared.landmarks().mix(&weights);
                Ok(self.declared.species_at(&Blend { params, weights, outside: 0.0 }, "blend"))
            }
        }
    }
}
