//! What a tree can be written as.

use anyhow::bail;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use pleach::{MeshFormat, SkeletonFormat};
use std::path::Path;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// The skeleton: stems, leaves and blossoms.
    Json,
    /// A flat drawing.
    Png,
    /// The axes of stems with radii.
    Skeleton(SkeletonFormat),
    /// Triangles.
    Mesh(MeshFormat),
}

impl ValueEnum for Format {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let help = match self {
            Self::Json => "The skeleton: stems, leaves and blossoms",
            Self::Png => "A flat drawing",
            Self::Skeleton(SkeletonFormat::Swc) => {
                "The axes of stems with radii, for programs of neuroscience"
            }
            Self::Skeleton(SkeletonFormat::Csv) => "A table of cylinders, as of TreeQSM",
            Self::Skeleton(SkeletonFormat::Mtg) => "A multiscale tree graph, as of OpenAlea",
            Self::Mesh(MeshFormat::Glb) => "Binary glTF",
            Self::Mesh(MeshFormat::Obj) => "Wavefront, with a .mtl file beside it",
            Self::Mesh(MeshFormat::Ply) => "Binary, with colours",
            Self::Mesh(MeshFormat::Stl) => "Binary, for 3D printers",
            Self::Mesh(MeshFormat::Usda) => "Universal Scene Description, as text",
        };
        Some(PossibleValue::new(self.suffix()).help(help))
    }
}

impl Format {
    /// Every format, in the order of the table.
    pub(crate) const ALL: [Self; 2 + SkeletonFormat::ALL.len() + MeshFormat::ALL.len()] = {
        const SKELETONS: usize = SkeletonFormat::ALL.len();
        let mut all = [Self::Json; 2 + SKELETONS + MeshFormat::ALL.len()];
        all[1] = Self::Png;
        let mut i = 2;
        while i < all.len() {
            all[i] = if i < 2 + SKELETONS {
                Self::Skeleton(SkeletonFormat::ALL[i - 2])
            } else {
                Self::Mesh(MeshFormat::ALL[i - 2 - SKELETONS])
            };
            i += 1;
        }
        all
    };

    /// The suffix of such files.
    pub(crate) const fn suffix(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Png => "png",
            Self::Skeleton(format) => format.suffix(),
            Self::Mesh(format) => format.suffix(),
        }
    }

    /// Whether it holds triangles.
    pub(crate) const fn is_mesh(self) -> bool {
        matches!(self, Self::Mesh(_))
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

#[cfg(test)]
mod tests {
    use super::*;

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
