//! One tree as meshes in memory, for programs that take arrays.

use super::ExportError;
use super::forms::LeafForm;
use super::options::Export;
use crate::option_error::OptionError;
use pleach_mesh::write::Format;
use pleach_mesh::{Mesh, Pictures, Source as _, send};
use pleach_tree::{Species, Tree};

/// The meshes of a tree, and the pictures that they show.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportedMeshes {
    /// A mesh for each level of detail, from fine to coarse, in metres with z up.
    pub levels: Vec<Mesh>,
    /// PNG files of the pictures that materials show, for all levels.
    pub pictures: Vec<Pictures<Vec<u8>>>,
}

impl Export {
    /// The meshes that a GLB file with these options would hold, in memory. What they leave open is not filled in: without
    /// a budget there are every leaf and twig, and without textures no pictures.
    ///
    /// # Errors
    /// An [`ExportError`]: options that [`Export::check`] refuses, those that are about files alone (`lod_extension`,
    /// `leaves` as instances, `compress`, `pivot_painter`, `sway`, `collision`), and meshes that cannot be made.
    pub fn meshes(&self, species: &Species, tree: &Tree) -> Result<ExportedMeshes, ExportError> {
        self.check(Format::Glb)?;
        let of_files = [
            ("lod_extension", self.lod_extension),
            ("leaves", self.leaf_form() == LeafForm::Instances),
            ("compress", self.compress.is_some()),
            ("pivot_painter", self.pivot_painter),
            ("sway", self.sway),
            ("collision", self.collision),
        ];
        if let Some((option, _)) = of_files.into_iter().find(|(_, asked)| *asked) {
            return Err(OptionError::new(option, "is for files, and arrays do not hold it").into());
        }
        let palette = self.palette(species);
        let tree = &*palette.dressed(tree);
        let levels = self.levels(&[tree])?;
        let skins = self.skins(&levels[0])?;
        let billboards = self.billboards(&[tree], &palette);
        let mut sources = self.sources(&levels[0], None, None, &skins);
        sources.extend(billboards.iter().map(|billboards| super::tree::cards(&billboards.cards[0])));
        let mut meshes = Vec::with_capacity(sources.len());
        for source in &sources {
            let mut mesh = Mesh::default();
            if !source.parts(0).is_empty() {
                send(std::slice::from_ref(source), &mut mesh)?;
            }
            meshes.push(mesh);
        }
        let pictures = self.pictures(&[tree], &levels, &palette, billboards.as_ref())?;
        Ok(ExportedMeshes { levels: meshes, pictures })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_mesh::Material;

    #[test]
    fn arrays_hold_what_files_do() {
        let species = pleach_generators::species("acer").unwrap();
        let tree = species.grow(1).unwrap();
        let export =
            Export { triangles: vec![8_000, 2_000], textures: Some(512), billboard: 2, ..Export::default() };
        let made = export.meshes(&species, &tree).unwrap();
        let triangles: Vec<usize> = made.levels.iter().map(Mesh::triangles).collect();
        assert!(triangles[0] <= 8_000 && triangles[1] <= 2_000 && triangles[2] == 4, "{triangles:?}");
        let pictures: Vec<Material> = made.pictures.iter().map(|pictures| pictures.material).collect();
        assert_eq!(pictures, [Material::Bark, Material::Twig, Material::Card]);
        let glb = export.to_file(Format::Glb, &species, 1, &tree, "acer").unwrap().bytes;
        for picture in made.pictures.iter().flat_map(|pictures| pictures.all()) {
            assert!(glb.windows(picture.1.len()).any(|bytes| bytes == picture.1), "{}", picture.0);
        }
        // What wind needs comes along, but for cards that show the whole tree.
        let windy = Export { wind: true, textures: None, ..export.clone() };
        let levels = windy.meshes(&species, &tree).unwrap().levels;
        for (number, (part, block)) in
            levels.iter().enumerate().flat_map(|(i, mesh)| mesh.parts.iter().map(move |part| (i, part)))
        {
            let rows = if number < 2 { block.vertices.len() } else { 0 };
            assert_eq!(block.wind.len(), rows, "level {number}, {:?}", part.material);
        }
        let one = Export { level: Some(1), billboard: 0, textures: None, ..export };
        // Its cards show a picture of their own.
        let alone = one.meshes(&species, &tree).unwrap().levels;
        assert!(alone.len() == 1 && alone[0].triangles() == triangles[1]);
        assert!(alone[0].part(Material::Bark) == made.levels[1].part(Material::Bark));
    }

    #[test]
    fn what_is_about_files_is_refused() {
        let species = pleach_generators::species("acer").unwrap();
        let tree = species.grow(1).unwrap();
        let error = |export: Export| export.meshes(&species, &tree).unwrap_err().to_string();
        assert!(error(Export { sway: true, ..Export::default() }).starts_with("`sway` is for files"));
        assert!(
            error(Export { leaves: Some(LeafForm::Instances), ..Export::default() })
                .starts_with("`leaves` is for")
        );
        assert!(error(Export { lod: Some(9), ..Export::default() }).contains("from 1 to"));
    }
}
