//! The formats of skeletons.

/// A format that holds a [`Skeleton`](super::Skeleton).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SkeletonFormat {
    /// Nodes with parents, as programs for the shapes of nerve cells read them: number, type, x, y, z, radius, parent.
    /// Lengths are metres. The type is 5 plus the level of the stem, since 0 to 4 are parts of nerve cells.
    Swc,
    /// A table of cylinders with the columns of TreeQSM, by the names that rTwig gives them, see
    /// [`Cylinder`](super::Cylinder).
    Csv,
    /// A multiscale tree graph as text, as OpenAlea reads it: plants (`P`, one for each trunk) of axes (`A`, stems) of nodes
    /// (`N`), with the columns XX, YY, ZZ and Radius in metres and Level.
    Mtg,
}

impl SkeletonFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Swc, Self::Csv, Self::Mtg];

    /// The suffix of its files, without the dot; also its name.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Swc => "swc",
            Self::Csv => "csv",
            Self::Mtg => "mtg",
        }
    }

    /// The format of this suffix, in lower or upper case.
    #[must_use]
    pub fn from_suffix(suffix: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| suffix.eq_ignore_ascii_case(format.suffix()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suffixes_name_their_formats() {
        for format in SkeletonFormat::ALL {
            assert_eq!(SkeletonFormat::from_suffix(&format.suffix().to_uppercase()), Some(format));
        }
        assert_eq!(SkeletonFormat::from_suffix("obj"), None);
    }
}
