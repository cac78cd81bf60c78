//! Where everything lies in the binary chunk.

use super::quantize::Form;
use super::{Scene, Site, animation};
use crate::block::{Block, Placement};
use crate::part::Part;
use crate::pictures::Pictures;
use glam::Vec3;

/// Bytes of a vertex' joint numbers and weights.
pub(super) const SKIN_BYTES: u64 = 12;

/// Sets of texture coordinates that hold a vertex' wind data, growth data or pixel, from the second one on.
pub(super) const fn data_sets(part: &Part) -> u64 {
    if part.wind {
        7
    } else if part.growth {
        2
    } else if part.pixels {
        1
    } else {
        0
    }
}

/// Bytes of a vertex' wind data, growth data or pixel.
pub(super) const fn data_bytes(part: &Part) -> u64 {
    8 * data_sets(part)
}

/// Offsets of a part's data in the binary chunk; those of data that it does not have are unused.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    pub(super) vertices: u64,
    pub(super) tangents: u64,
    /// Wind data, growth data or pixels.
    pub(super) data: u64,
    pub(super) skin: u64,
    pub(super) indices: u64,
    pub(super) placements: Placements,
}

/// Offsets of a run of placements, and how many there are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Placements {
    pub(super) translations: u64,
    pub(super) rotations: u64,
    pub(super) scales: u64,
    pub(super) count: u64,
}

impl Placements {
    fn new(count: u64, take: &mut impl FnMut(u64) -> u64) -> Self {
        Self { translations: take(count * 12), rotations: take(count * 16), scales: take(count * 12), count }
    }

    /// Moves behind so many placements.
    const fn advance(&mut self, count: u64) {
        self.translations += count * 12;
        self.rotations += count * 16;
        self.scales += count * 12;
    }

    /// The numbers of `placements`, each run with its offset.
    pub(super) fn runs(&self, placements: &[Placement]) -> [(u64, Vec<f32>); 3] {
        [
            (self.translations, placements.iter().flat_map(|p| p.translation.to_array()).collect()),
            (self.rotations, placements.iter().flat_map(|p| p.rotation.to_array()).collect()),
            (self.scales, placements.iter().flat_map(|p| p.scale.to_array()).collect()),
        ]
    }
}

/// A part, its place, how much of it is written, and its bounds so far.
#[derive(Clone, Debug)]
pub(super) struct PartLayout {
    pub(super) part: Part,
    pub(super) place: Place,
    pub(super) form: Form,
    /// Whether its material shows a picture of normals.
    pub(super) has_tangents: bool,
    next: Place,
    /// Smallest and largest coordinates of what has been written.
    pub(super) bounds: Option<(Vec3, Vec3)>,
}

impl PartLayout {
    /// Number of the next corner.
    pub(super) fn next_corner(&self) -> u32 {
        ((self.next.vertices - self.place.vertices) / self.form.stride()) as u32
    }

    /// Whether indices have 16 bits. The largest number of them stands for none.
    pub(super) fn has_short_indices(&self) -> bool {
        self.form != Form::Floats && self.part.count.vertices <= u64::from(u16::MAX)
    }

    /// Bytes of a triangle's indices.
    pub(super) fn index_bytes(&self) -> u64 {
        if self.has_short_indices() { 6 } else { 12 }
    }

    /// Where `block` goes; the next one goes behind it.
    pub(super) fn advance(&mut self, block: &Block) -> Place {
        let place = self.next;
        let vertices = block.vertices.len() as u64;
        self.next.vertices += vertices * self.form.stride();
        self.next.tangents += vertices * self.form.tangent_bytes();
        self.next.data += vertices * data_bytes(&self.part);
        self.next.skin += vertices * SKIN_BYTES;
        self.next.indices += block.triangles.len() as u64 * self.index_bytes();
        self.next.placements.advance(block.instances.len() as u64);
        for at in block.vertices.iter().map(|v| v.position) {
            let (min, max) = self.bounds.unwrap_or((at, at));
            self.bounds = Some((min.min(at), max.max(at)));
        }
        place
    }
}

/// The binary chunk.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    pub(super) parts: Vec<PartLayout>,
    pub(super) bind_matrices: u64,
    pub(super) times: u64,
    pub(super) rotations: u64,
    /// Of each of the scene's trees, if it is instanced, where it stands.
    pub(super) sites: Vec<Option<Placements>>,
    /// Offset and length of the PNG files of each of the scene's pictures that a part shows.
    pub(super) pictures: Vec<Pictures<(u64, u64)>>,
    /// Size of the whole, a multiple of 4.
    pub(super) bytes: u64,
}

impl Layout {
    pub(super) fn new(parts: &[Part], scene: &Scene<'_>) -> Self {
        let mut at = 0;
        let mut take = |bytes: u64| {
            let start = at;
            at += bytes.next_multiple_of(4);
            start
        };
        let parts: Vec<PartLayout> = parts
            .iter()
            .map(|&part| {
                let vertices = part.count.vertices;
                let own = scene.pictures.iter().find(|pictures| pictures.material == part.material);
                let has_tangents = own.is_some_and(|pictures| pictures.normal.is_some());
                let form = Form::new(scene.grid.as_ref(), &part, own.is_some());
                let mut layout = PartLayout {
                    part,
                    place: Place::default(),
                    form,
                    has_tangents,
                    next: Place::default(),
                    bounds: None,
                };
                let place = Place {
                    vertices: take(vertices * form.stride()),
                    tangents: take(if has_tangents { vertices * form.tangent_bytes() } else { 0 }),
                    data: take(vertices * data_bytes(&part)),
                    skin: take(if part.rigged { vertices * SKIN_BYTES } else { 0 }),
                    indices: take(part.count.triangles * layout.index_bytes()),
                    placements: Placements::new(part.instances, &mut take),
                };
                (layout.place, layout.next) = (place, place);
                layout
            })
            .collect();
        let joints = scene.rig.map_or(0, |rig| rig.joints.len() as u64);
        let keys = if joints > 0 { u64::from(animation::KEYS) } else { 0 };
        let bind_matrices = take(joints * 64);
        let times = take(keys * 4);
        let rotations = take(joints * keys * 16);
        let sites = scene.placed.iter().map(|placed| {
            placed.is_instanced().then(|| Placements::new(placed.sites.len() as u64, &mut take))
        });
        let sites = sites.collect();
        let shown = |material| parts.iter().any(|p| p.part.material == material);
        let pictures = scene
            .pictures
            .iter()
            .filter(|pictures| shown(pictures.material))
            .map(|pictures| {
                pictures.as_ref().map(|_, png| {
                    let length = png.len() as u64;
                    (take(length), length)
                })
            })
            .collect();
        Self { parts, bind_matrices, times, rotations, sites, pictures, bytes: at }
    }

    /// What does not come in blocks: offset and bytes.
    pub(super) fn fixed(&self, scene: &Scene<'_>) -> Vec<(u64, Vec<u8>)> {
        let mut fixed = Vec::new();
        if let Some(rig) = scene.rig {
            let floats = |values: &[f32]| bytemuck::cast_slice(values).to_vec();
            fixed.push((self.bind_matrices, floats(&animation::bind_matrices(rig))));
            fixed.push((self.times, floats(&animation::times())));
            fixed.push((self.rotations, floats(&animation::rotations(rig))));
        }
        for (placed, at) in scene.placed.iter().zip(&self.sites) {
            let Some(at) = at else { continue };
            let put = |site: &Site| {
                let upright = site.upright();
                scene.grid.as_ref().map_or(upright, |grid| grid.placement(&upright))
            };
            let sites: Vec<Placement> = placed.sites.iter().map(put).collect();
            for (offset, numbers) in at.runs(&sites) {
                fixed.push((offset, bytemuck::cast_slice(&numbers).to_vec()));
            }
        }
        let shown = scene
            .pictures
            .iter()
            .filter(|pictures| self.parts.iter().any(|part| part.part.material == pictures.material));
        for (pictures, places) in shown.zip(&self.pictures) {
            for ((_, png), (_, (offset, _))) in pictures.all().zip(places.all()) {
                let mut bytes = png.clone();
                bytes.resize(bytes.len().next_multiple_of(4), 0);
                fixed.push((*offset, bytes));
            }
        }
        fixed
    }
}

/// One joint with all the weight: four numbers of 16 bits, four weights of 8.
pub(super) fn skin(joint: u16) -> [u8; SKIN_BYTES as usize] {
    let [low, high] = joint.to_le_bytes();
    [low, high, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0]
}
