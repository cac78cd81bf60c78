//! The formats of mesh files, and what each can hold.

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Binary glTF, see [`super::glb`].
    Glb,
    /// Wavefront OBJ, with a file of materials beside it, see [`super::obj`].
    Obj,
    /// Binary PLY, see [`super::ply`].
    Ply,
    /// Binary STL, see [`super::stl`].
    Stl,
    /// Universal Scene Description as text, see [`super::usda`].
    Usda,
}

/// Something that only some formats can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Feature {
    /// Pictures of bark.
    Textures,
    /// Cards that show the picture of a leaf.
    LeafCards,
    /// One leaf that is placed many times.
    LeafInstances,
    /// Data for shaders of wind at each vertex.
    Wind,
    /// Data for shaders of growth at each vertex.
    Growth,
    /// The pixel of what turns with each vertex, and textures beside the file.
    PivotPainter,
    /// So many triangles, which may need cards with pictures of twigs.
    Budget,
    /// Levels of detail.
    Levels,
    /// Crossing cards that show the whole tree.
    Billboard,
    /// Joints, and their animation in wind.
    Sway,
    /// Many trees that share few meshes.
    Forest,
    /// Vertices of whole numbers.
    Compression,
    /// Convex pieces that things bump into.
    Collision,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Glb, Self::Obj, Self::Ply, Self::Stl, Self::Usda];

    /// The suffix of its files, without the dot; also its name.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Usda => "usda",
        }
    }

    /// The format of this suffix, in lower or upper case.
    #[must_use]
    pub fn from_suffix(suffix: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| suffix.eq_ignore_ascii_case(format.suffix()))
    }

    /// The media type of its files (IANA), or what servers send where none is registered.
    #[must_use]
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Glb => "model/gltf-binary",
            Self::Obj => "model/obj",
            Self::Ply => "application/octet-stream",
            Self::Stl => "model/stl",
            Self::Usda => "text/plain",
        }
    }

    /// Whether files of this format can hold `feature`.
    #[must_use]
    pub const fn holds(self, feature: Feature) -> bool {
        match self {
            Self::Glb => true,
            Self::Obj => matches!(feature, Feature::Budget | Feature::LeafCards | Feature::Textures),
            Self::Ply => matches!(feature, Feature::Wind | Feature::Growth),
            Self::Stl => false,
            Self::Usda => matches!(
                feature,
                Feature::Budget | Feature::LeafCards | Feature::LeafInstances | Feature::Textures
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suffixes_name_their_formats() {
        for format in Format::ALL {
            assert_eq!(Format::from_suffix(format.suffix()), Some(format));
            assert_eq!(Format::from_suffix(&format.suffix().to_uppercase()), Some(format));
        }
        assert_eq!(Format::from_suffix("blend"), None);
    }
}
