//! What a species has beside its numbers: a drawn outline, or the parts of its first volume.

mod drawn;
mod volumes;

pub(crate) use drawn::{Drawn, OUTLINE};
pub(crate) use volumes::{SHAPES, VOLUMES, Volumes};

/// Everything about a species that is not a number.
#[derive(Clone, Debug, Default)]
pub(crate) struct Structure {
    pub(crate) outline: Option<Drawn>,
    pub(crate) volumes: Option<Volumes>,
}

impl Structure {
    /// As lines of a species file.
    pub(crate) fn to_toml(&self) -> String {
        let mut text = String::new();
        if let Some(drawn) = &self.outline {
            text.push_str(&drawn.to_toml());
        }
        if let Some(volumes) = &self.volumes {
            text.push_str(&volumes.to_toml());
        }
        text
    }
}
