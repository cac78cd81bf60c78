//! What a tree can be written as, and which option each kind of file takes: one table, used by the
//! check and by the help.

use super::Grow;
use crate::commands::leaf_form::Leaves;
use anyhow::bail;
use clap::ValueEnum;
use std::path::Path;
use std::sync::LazyLock;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// The skeleton: stems, leaves and blossoms
    Json,
    /// A flat drawing
    Png,
    /// Binary glTF
    Glb,
    /// Wavefront, with a .mtl file beside it
    Obj,
    /// Binary, with colours
    Ply,
    /// Binary, for 3D printers
    Stl,
    /// Universal Scene Description, as text
    Usda,
}

impl Format {
    /// Every format, in the order of the table.
    pub(crate) const ALL: [Self; 7] =
        [Self::Json, Self::Png, Self::Glb, Self::Obj, Self::Ply, Self::Stl, Self::Usda];

    /// The suffix of such files.
    pub(crate) const fn suffix(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Png => "png",
            Self::Glb => "glb",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Usda => "usda",
        }
    }

    /// Whether it holds triangles.
    pub(super) const fn is_mesh(self) -> bool {
        !matches!(self, Self::Json | Self::Png)
    }

    /// The format that the suffix of `path` names.
    pub(crate) fn from_path(path: &Path) -> anyhow::Result<Self> {
        let suffix = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match Self::ALL.into_iter().find(|format| format.suffix() == suffix) {
            Some(format) => Ok(format),
            None => bail!(
                "cannot write `.{suffix}` files, known are .{}",
                Self::ALL.map(Self::suffix).join(", .")
            ),
        }
    }
}

/// Where a tree goes: a file, or statistics alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goes {
    Into(Format),
    Statistics,
}

impl Goes {
    const ALL: [Self; 8] = [
        Self::Into(Format::Json),
        Self::Into(Format::Png),
        Self::Into(Format::Glb),
        Self::Into(Format::Obj),
        Self::Into(Format::Ply),
        Self::Into(Format::Stl),
        Self::Into(Format::Usda),
        Self::Statistics,
    ];

    const fn name(self) -> &'static str {
        match self {
            Self::Into(format) => format.suffix(),
            Self::Statistics => "statistics",
        }
    }
}

/// An option that not everything takes.
struct Choice {
    /// As it is typed.
    flag: &'static str,
    /// What it asks for.
    what: &'static str,
    /// What takes it, in the order of [`Goes::ALL`]: an `x` for yes.
    takes: [char; 8],
    /// Whether it was given.
    given: fn(&Grow) -> bool,
}

impl Choice {
    fn takes(&self, goes: Goes) -> bool {
        Goes::ALL.iter().zip(self.takes).any(|(one, mark)| *one == goes && mark == 'x')
    }
}

/// The table. `--no-leaves`, `--leafy`, `--seed`, `--seeds` and the limits are for everything.
#[rustfmt::skip]
static CHOICES: [Choice; 14] = {
    const fn choice(
        flag: &'static str,
        what: &'static str,
        takes: [char; 8],
        given: fn(&Grow) -> bool,
    ) -> Choice {
        Choice { flag, what, takes, given }
    }
    [
        //                                                      json png  glb  obj  ply  stl  usda statistics
        choice("--size", "the size of a picture",               ['-', 'x', '-', '-', '-', '-', '-', '-'], |g| g.size.is_some()),
        choice("--season", "a season's leaves and colours",     ['x', '-', 'x', 'x', 'x', 'x', 'x', 'x'], |g| g.mesh.season.is_some()),
        choice("--tolerance", "the tolerance of a surface",     ['-', '-', 'x', 'x', 'x', 'x', 'x', '-'], |g| g.mesh.tolerance.is_some()),
        choice("--leaves none", "a tree without leaves",        ['x', 'x', 'x', 'x', 'x', 'x', 'x', 'x'], |g| g.mesh.leaves == Some(Leaves::None)),
        choice("--leaves outline", "leaves as triangles",       ['-', '-', 'x', 'x', 'x', 'x', 'x', '-'], |g| g.mesh.leaves == Some(Leaves::Outline)),
        choice("--leaves simple", "leaves of two triangles",    ['-', '-', 'x', 'x', 'x', 'x', 'x', '-'], |g| g.mesh.leaves == Some(Leaves::Simple)),
        choice("--leaves cards", "cards with a leaf's picture", ['-', '-', 'x', 'x', '-', '-', 'x', '-'], |g| g.mesh.leaves == Some(Leaves::Cards)),
        choice("--leaves instances", "placed leaves",           ['-', '-', 'x', '-', '-', '-', 'x', '-'], |g| g.mesh.leaves == Some(Leaves::Instances)),
        choice("--weld", "one watertight surface",              ['-', '-', 'x', 'x', 'x', 'x', 'x', '-'], |g| g.mesh.weld.is_some()),
        choice("--wind", "data for wind shaders",               ['-', '-', 'x', '-', 'x', '-', '-', '-'], |g| g.mesh.wind),
        choice("--lod", "levels of detail",                     ['-', '-', 'x', '-', '-', '-', '-', '-'], |g| g.mesh.lod.is_some()),
        choice("--billboard", "billboards",                     ['-', '-', 'x', '-', '-', '-', '-', '-'], |g| g.mesh.billboard.is_some()),
        choice("--sway", "an animation",                        ['-', '-', 'x', '-', '-', '-', '-', '-'], |g| g.mesh.sway),
        choice("--forest", "a forest",                          ['-', '-', 'x', '-', '-', '-', '-', '-'], |g| g.mesh.forest.is_some()),
    ]
};

/// Fails if an option was given that none of `goes` takes: it would do nothing.
pub(super) fn check(grow: &Grow, goes: &[Goes]) -> anyhow::Result<()> {
    for choice in CHOICES.iter().filter(|choice| (choice.given)(grow)) {
        if goes.iter().any(|goes| choice.takes(*goes)) {
            continue;
        }
        let here: Vec<String> = goes.iter().map(|goes| named(*goes)).collect();
        let there: Vec<String> =
            Goes::ALL.into_iter().filter(|goes| choice.takes(*goes)).map(named).collect();
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
    for goes in Goes::ALL {
        text.push_str("  ");
        text.push_str(goes.name());
    }
    for choice in &CHOICES {
        let mut line = format!("\n  {:width$}", choice.flag);
        for goes in Goes::ALL {
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
        for leaves in Leaves::value_variants() {
            let flag = format!("--leaves {}", leaves.to_possible_value().unwrap().get_name());
            assert_eq!(CHOICES.iter().filter(|choice| choice.flag == flag).count(), 1, "{flag}");
        }
    }

    #[test]
    fn suffixes_are_the_words_of_the_option_and_found_in_paths() {
        for format in Format::ALL {
            assert_eq!(format.to_possible_value().unwrap().get_name(), format.suffix());
            assert_eq!(
                Format::from_path(Path::new(&format!("a.b.{}", format.suffix().to_uppercase()))).unwrap(),
                format
            );
        }
        assert_eq!(Format::value_variants(), Format::ALL);
    }
}
