//! The pictures that a material shows instead of its colour.

use crate::part::Material;

/// Pictures of one material: the bytes of PNG files, or their names.
#[derive(Clone, Debug, PartialEq)]
pub struct Pictures<P> {
    /// Whose they are.
    pub material: Material,
    /// Whether they are tiles that repeat.
    pub repeats: bool,
    /// Opacity, 0 to 1, below which pixels are cut out; `None` where all of the picture is shown.
    pub cutoff: Option<f32>,
    /// Colours, as sRGB.
    pub color: P,
    /// Directions in tangent space, x to the right, y up.
    pub normal: Option<P>,
    /// Occlusion in red, roughness in green.
    pub roughness: Option<P>,
}

impl<P> Pictures<P> {
    /// A picture of colours alone that is cut out where it is less opaque than `cutoff`.
    pub const fn cut_out(material: Material, color: P, cutoff: f32) -> Self {
        Self { material, repeats: false, cutoff: Some(cutoff), color, normal: None, roughness: None }
    }

    /// A picture of colours alone whose tiles repeat.
    pub const fn tiles(material: Material, color: P) -> Self {
        Self { material, repeats: true, cutoff: None, color, normal: None, roughness: None }
    }

    /// Those that there are, with what each is called.
    pub fn all(&self) -> impl Iterator<Item = (&'static str, &P)> {
        let further = [("normal", &self.normal), ("roughness", &self.roughness)];
        let further = further.into_iter().filter_map(|(name, picture)| Some((name, picture.as_ref()?)));
        std::iter::once(("color", &self.color)).chain(further)
    }

    /// The same by reference.
    #[must_use]
    pub const fn as_ref(&self) -> Pictures<&P> {
        let Self { material, repeats, cutoff, color, normal, roughness } = self;
        Pictures {
            material: *material,
            repeats: *repeats,
            cutoff: *cutoff,
            color,
            normal: normal.as_ref(),
            roughness: roughness.as_ref(),
        }
    }

    /// The same with each picture replaced by what `replace` makes of what it is called and of it, in the order of
    /// [`Pictures::all`].
    pub fn map<Q>(self, mut replace: impl FnMut(&'static str, P) -> Q) -> Pictures<Q> {
        let Self { material, repeats, cutoff, color, normal, roughness } = self;
        Pictures {
            material,
            repeats,
            cutoff,
            color: replace("color", color),
            normal: normal.map(|picture| replace("normal", picture)),
            roughness: roughness.map(|picture| replace("roughness", picture)),
        }
    }

    /// [`Pictures::map`] that may fail.
    ///
    /// # Errors
    /// The first error of `replace`.
    pub fn try_map<Q, E>(
        self,
        mut replace: impl FnMut(&'static str, P) -> Result<Q, E>,
    ) -> Result<Pictures<Q>, E> {
        let Pictures { material, repeats, cutoff, color, normal, roughness } = self.map(&mut replace);
        Ok(Pictures {
            material,
            repeats,
            cutoff,
            color: color?,
            normal: normal.transpose()?,
            roughness: roughness.transpose()?,
        })
    }
}
