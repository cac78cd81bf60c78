//! What a tree can be written as.

use anyhow::bail;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use pleach::MeshFormat;
use std::path::Path;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// The skeleton: stems, leaves and blossoms.
    Json,
    /// A flat drawing.
    Png,
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
    pub(crate) const ALL: [Self; 2 + MeshFormat::ALL.len()] = {
        let mut all = [Self::Json; 2 + MeshFormat::ALL.len()];
        all[1] = Self::Png;
        let mut i = 0;
        while i < MeshFormat::ALL.len() {
            all[2 + i] = Self::Mesh(MeshFormat::ALL[i]);
            i += 1;
        }
        all
    };

    /// The suffix of such files.
    pub(crate) const fn suffix(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Png => "png",
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
