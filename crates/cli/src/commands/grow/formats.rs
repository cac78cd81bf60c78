//! Which option each kind of file takes: one table, used by the check and by the help.

use super::Grow;
use crate::commands::format::Format;
use anyhow::bail;
use pleach::{LeafForm, MeshFeature, MeshFormat};
use std::sync::LazyLock;

/// Where a tree goes: a file, or statistics alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goes {
    Into(Format),
    Statistics,
}

impl Goes {
    fn all() -> impl Iterator<Item = Self> {
        Format::ALL.into_iter().map(Self::Into).chain([Self::Statistics])
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Into(format) => format.suffix(),
            Self::Statistics => "statistics",
        }
    }
}

/// What takes an option.
#[derive(Clone, Copy)]
enum Takes {
    /// Everything but skeletons, which have no leaves.
    Leafy,
    /// The same but for a flat drawing, which has colours of its own.
    LeafyButPng,
    /// A flat drawing.
    Png,
    /// Every mesh.
    Meshes,
    /// The format of meshes that has lines.
    Obj,
    /// Meshes whose format can hold it.
    Holding(MeshFeature),
}

/// An option that not everything takes.
struct Choice {
    /// As it is typed.
    flag: &'static str,
    /// Its purpose, for messages.
    what: &'static str,
    takes: Takes,
    /// Whether it was given.
    given: fn(&Grow) -> bool,
}

impl Choice {
    fn takes(&self, goes: Goes) -> bool {
        match (self.takes, goes) {
            (Takes::Meshes, Goes::Into(Format::Mesh(_))) => true,
            (Takes::Leafy | Takes::LeafyButPng, Goes::Into(Format::Skeleton(_))) => false,
            (Takes::Leafy, _) => true,
            (Takes::LeafyButPng, goes) => goes != Goes::Into(Format::Png),
            (Takes::Png, goes) => goes == Goes::Into(Format::Png),
            (Takes::Obj, goes) => goes == Goes::Into(Format::Mesh(MeshFormat::Obj)),
            (Takes::Holding(feature), Goes::Into(Format::Mesh(format))) => format.holds(feature),
            (Takes::Meshes | Takes::Holding(_), _) => false,
        }
    }
}

/// The table. `--no-leaves`, `--leafy`, `--seed`, `--seeds` and the limits apply to every output.
#[rustfmt::skip]
static CHOICES: [Choice; 24] = {
    use MeshFeature::{Billboard, Budget, Collision, Compression, Forest, Growth, LeafCards, LeafInstances, Levels, PivotPainter, Sway, Textures, Wind};
    use Takes::{Holding, Leafy, LeafyButPng, Meshes, Obj, Png};

    const fn choice(flag: &'static str, what: &'static str, takes: Takes, given: fn(&Grow) -> bool) -> Choice {
        Choice { flag, what, takes, given }
    }
    [
        choice("--size", "the size of a picture", Png, |g| g.size.is_some()),
        choice("--season", "a season's leaves and colours", LeafyButPng, |g| g.mesh.season.is_some()),
        choice("--lines", "axes as lines", Obj, |g| g.lines),
        choice("--finest", "every leaf and twig", Meshes, |g| g.mesh.finest),
        choice("--tolerance", "the tolerance of a surface", Meshes, |g| g.mesh.tolerance.is_some()),
        choice("--leaves none", "a tree without leaves", Leafy, |g| g.mesh.leaves == Some(LeafForm::None)),
        choice("--leaves outline", "leaves as triangles", Meshes, |g| g.mesh.leaves == Some(LeafForm::Outline)),
        choice("--leaves simple", "leaves of two triangles", Meshes, |g| g.mesh.leaves == Some(LeafForm::Simple)),
        choice("--leaves cards", "cards with a leaf's picture", Holding(LeafCards), |g| g.mesh.leaves == Some(LeafForm::Cards)),
        choice("--leaves instances", "placed leaves", Holding(LeafInstances), |g| g.mesh.leaves == Some(LeafForm::Instances)),
        choice("--textures", "pictures of bark and leaves", Holding(Textures), |g| g.mesh.textures.is_some()),
        choice("--compress", "smaller vertices", Holding(Compression), |g| g.mesh.compress.is_some()),
        choice("--weld", "one watertight surface", Meshes, |g| g.mesh.weld.is_some()),
        choice("--wind", "data for wind shaders", Holding(Wind), |g| g.mesh.wind),
        choice("--growth", "data for growing trees", Holding(Growth), |g| g.mesh.growth),
        choice("--pivot-painter", "textures of pivots for Unreal", Holding(PivotPainter), |g| g.mesh.pivot_painter),
        choice("--lod", "levels of detail", Holding(Levels), |g| g.mesh.lod.is_some() && !g.mesh.lod_files),
        choice("--triangles", "a budget of triangles", Holding(Budget), |g| !g.mesh.triangles.is_empty()),
        choice("--lod-files", "a file for each level", Meshes, |g| g.mesh.lod_files),
        choice("--lod-extension", "levels by MSFT_lod", Holding(Levels), |g| g.mesh.lod_extension),
        choice("--billboard", "billboards", Holding(Billboard), |g| g.mesh.billboard.is_some()),
        choice("--sway", "an animation", Holding(Sway), |g| g.mesh.sway),
        choice("--collision", "pieces that things bump into", Holding(Collision), |g| g.mesh.collision),
        choice("--forest", "a forest", Holding(Forest), |g| g.mesh.forest.is_some()),
    ]
};

/// Fails if an option was given that none of `goes` takes, since it would do nothing.
pub(super) fn check(grow: &Grow, goes: &[Goes]) -> anyhow::Result<()> {
    for choice in CHOICES.iter().filter(|choice| (choice.given)(grow)) {
        if goes.iter().any(|goes| choice.takes(*goes)) {
            continue;
        }
        let here: Vec<String> = goes.iter().map(|goes| named(*goes)).collect();
        let there: Vec<String> = Goes::all().filter(|goes| choice.takes(*goes)).map(named).collect();
        bail!(
            "`{}` ({}) would do nothing for {}; it is for {}",
            choice.flag,
            choice.what,
            here.join(" and "),
            there.join(", ")
        );
    }
    Ok(())
}

fn named(goes: Goes) -> String {
    match goes {
        Goes::Into(format) => format!(".{}", format.suffix()),
        Goes::Statistics => "statistics".to_owned(),
    }
}

/// The table as text.
pub(super) static TABLE: LazyLock<String> = LazyLock::new(|| {
    let width = CHOICES.iter().map(|choice| choice.flag.len()).max().unwrap_or(0);
    let mut text = String::from("What takes which option; any other combination is refused:\n");
    text.push_str(&format!("  {:width$}", ""));
    for goes in Goes::all() {
        text.push_str("  ");
        text.push_str(goes.name());
    }
    for choice in &CHOICES {
        let mut line = format!("\n  {:width$}", choice.flag);
        for goes in Goes::all() {
            let mark = if choice.takes(goes) { 'x' } else { '-' };
            line.push_str(&format!("  {mark:<0$}", goes.name().len()));
        }
        text.push_str(line.trim_end());
    }
    text
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_leaves_has_a_row_of_its_own() {
        for leaves in LeafForm::ALL {
            let flag = format!("--leaves {}", leaves.name());
            assert_eq!(CHOICES.iter().filter(|choice| choice.flag == flag).count(), 1, "{flag}");
        }
    }
}
