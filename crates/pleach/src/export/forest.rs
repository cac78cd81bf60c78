//! Many trees in one file.

use super::ExportError;
use super::extras::extras;
use super::forms::LeafForm;
use super::options::Export;
use super::tree::{Planned, Written, cards};
use crate::option_error::{OptionError, from_json};
use pleach_mesh::forest;
use pleach_mesh::send;
use pleach_mesh::write::Format;
use pleach_mesh::write::glb::{Glb, Placed, Scene, Site};
use pleach_tree::{GrowError, Species, Tree};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::io::{Seek, Write};

/// A field with trees of one species, which share a few meshes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Forest {
    /// Metres along x, above 0.
    pub width: f64,
    /// Metres along y, above 0.
    pub depth: f64,
    /// Metres between the trees, above 0.
    pub spacing: f64,
    /// Different trees, 1 to 64: those of consecutive seeds.
    pub variants: u32,
    /// Whether each tree is a node of its own, which every program reads, instead of one node for all that look alike
    /// (`EXT_mesh_gpu_instancing`), which engines draw at once.
    pub separate: bool,
}

impl Default for Forest {
    fn default() -> Self {
        Self { width: 40.0, depth: 40.0, spacing: 6.0, variants: 4, separate: false }
    }
}

impl Forest {
    /// The most different trees: all of them are in memory at a time.
    pub const MAX_VARIANTS: u32 = 64;

    /// Reads a forest from JSON, as the type's own `Deserialize` does, and tells which key is wrong.
    ///
    /// # Errors
    /// The first key that is not known, or whose value cannot be read.
    pub fn from_json(text: &str) -> Result<Self, OptionError> {
        from_json(text)
    }
}

impl Export {
    /// Checks the options for a forest: what [`Export::check`] does for GLB, and what only one tree can have.
    ///
    /// # Errors
    /// The first option that is wrong.
    pub fn check_forest(&self, forest: &Forest) -> Result<(), OptionError> {
        self.check(Format::Glb)?;
        let alone = [
            ("weld", self.weld.is_some()),
            ("sway", self.sway),
            ("roots", self.roots),
            ("collision", self.collision),
            ("pivot_painter", self.pivot_painter),
        ];
        if let Some((option, _)) = alone.into_iter().find(|(_, asked)| *asked) {
            return Err(OptionError::new(option, "is for one tree, and not for a forest"));
        }
        let most = Forest::MAX_VARIANTS;
        if !(1..=most).contains(&forest.variants) {
            let problem = format!("is {}, expected from 1 to {most} different trees", forest.variants);
            return Err(OptionError::new("variants", problem));
        }
        Ok(())
    }

    /// Grows a few trees of `species`, from `seed` on, and writes a forest of them to `out`, an empty and buffered
    /// file, as GLB. `grow` grows the tree of a seed.
    ///
    /// # Errors
    /// An [`ExportError`]: options that [`Export::check_forest`] refuses, a forest that cannot be planted, a tree that
    /// does not grow, a mesh that cannot be written. `out` may then hold a part of the file.
    pub fn write_forest<W: Write + Seek + ?Sized>(
        &self,
        forest: &Forest,
        species: &Species,
        seed: u64,
        grow: impl Fn(u64) -> Result<Tree, GrowError>,
        out: &mut W,
    ) -> Result<Written, ExportError> {
        self.check_forest(forest)?;
        let sites = forest::plant(forest.width, forest.depth, forest.spacing, forest.variants, seed)?;
        // Only variants that stand somewhere are grown.
        let mut used: Vec<u32> = sites.iter().map(|site| site.variant).collect();
        used.sort_unstable();
        used.dedup();
        let palette = self.palette(species);
        let seeds: Vec<u64> = used.iter().map(|variant| seed + u64::from(*variant)).collect();
        let grown = seeds.iter().map(|&seed| {
            let mut tree = grow(seed).map_err(|source| ExportError::Grow {
                species: species.name.clone(),
                seed,
                source,
            })?;
            palette.apply_season(&mut tree);
            Ok(tree)
        });
        let trees = grown.collect::<Result<Vec<Tree>, ExportError>>()?;
        let trees: Vec<&Tree> = trees.iter().collect();
        let Planned { export, levels, note } = self.planned(Format::Glb, &trees)?;
        let billboards = export.billboards(&trees, &palette);
        let mut sources = Vec::new();
        for (i, levels) in levels.iter().enumerate() {
            sources.extend(export.sources(levels, None, None, &[]));
            sources.extend(billboards.iter().map(|billboards| cards(&billboards.cards[i])));
        }
        let each = sources.len() / trees.len().max(1);
        let meshes = |variant: usize| (variant * each..(variant + 1) * each).collect();
        // An instance cannot hold instances.
        let is_separate = forest.separate || export.leaf_form() == LeafForm::Instances;
        let mut placed: Vec<Placed> = Vec::new();
        for (variant, number) in used.iter().enumerate() {
            let own = sites.iter().enumerate().filter(|(_, site)| site.variant == *number);
            let own = own.map(|(i, site)| {
                let position = site.position.as_vec2().extend(0.0);
                (i, Site { position, turn: site.turn as f32, scale: site.scale as f32 })
            });
            if is_separate {
                placed.extend(own.map(|(i, site)| Placed {
                    name: format!("{} {}", species.name, i + 1),
                    meshes: meshes(variant),
                    sites: vec![site],
                }));
            } else {
                let name = format!("{} {}", species.name, variant + 1);
                placed.push(Placed {
                    name,
                    meshes: meshes(variant),
                    sites: own.map(|(_, site)| site).collect(),
                });
            }
        }
        let scene = Scene {
            name: format!("{} forest", species.name),
            palette,
            extras: extras(species, json!(seeds)),
            placed,
            lod_extension: self.lod_extension,
            grid: export.grid(&sources)?,
            rig: None,
            pictures: export.pictures(&trees, &levels, &palette, billboards.as_ref())?,
        };
        send(&sources, &mut Glb::new(out, &scene))?;
        Ok(Written { beside: Vec::new(), trees: sites.len(), note })
    }
}
