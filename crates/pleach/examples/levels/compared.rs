//! Levels of detail with a budget beside the tree that they are of.

use glam::{Vec2, vec2};
use pleach_mesh::{Material, Mesh, MeshSettings, Palette, Pictures, lod, send};
use pleach_render::{Picture, twig_sheet};
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::Likeness;
use pleach_tree::Tree;

const SIDE: usize = 256;
/// Samples of a pixel, across and down.
const SAMPLES: usize = 3;

/// A mesh from the front, as a picture that is compared: a pixel is set where half of it is covered.
#[derive(Clone)]
struct Canvas {
    samples: Vec<bool>,
    scale: f32,
    middle: f32,
    top: f32,
}

impl Canvas {
    /// One that `tree` fills.
    fn new(tree: &Tree) -> Self {
        let mesh = Mesh::new(tree, MeshSettings::default());
        let points =
            || mesh.parts.iter().flat_map(|(_, block)| &block.vertices).map(|vertex| vertex.position);
        let low = points().fold(glam::Vec3::INFINITY, glam::Vec3::min);
        let high = points().fold(glam::Vec3::NEG_INFINITY, glam::Vec3::max);
        let size = (high - low).max_element() * 1.1;
        let side = (SIDE * SAMPLES) as f32;
        let (middle, top) = ((low.x + high.x) / 2.0, (low.z + high.z) / 2.0 + size / 2.0);
        Self { samples: vec![false; SIDE * SAMPLES * SIDE * SAMPLES], scale: side / size, middle, top }
    }

    fn draw(&mut self, mesh: &Mesh, sheet: Option<&Pictures<Picture>>) {
        for (part, block) in &mesh.parts {
            let sheet = sheet.filter(|_| part.material == Material::Twig);
            for triangle in &block.triangles {
                let corners = triangle.map(|i| block.vertices[i as usize]);
                let at = corners.map(|corner| {
                    let side = (SIDE * SAMPLES) as f32 / 2.0;
                    vec2(
                        side + (corner.position.x - self.middle) * self.scale,
                        (self.top - corner.position.z) * self.scale,
                    )
                });
                self.fill(at, |weights| {
                    let Some(sheet) = sheet else { return true };
                    let uv: Vec2 = (0..3).map(|k| corners[k].uv * weights[k]).sum();
                    let (color, cutoff) = (&sheet.color, 255.0 * sheet.cutoff.unwrap_or(0.0));
                    let (x, y) = ((uv.x * color.width as f32) as u32, (uv.y * color.height as f32) as u32);
                    f32::from(color.rgba[((y * color.width + x) * 4 + 3) as usize]) >= cutoff
                });
            }
        }
    }

    fn fill(&mut self, [a, b, c]: [Vec2; 3], covers: impl Fn([f32; 3]) -> bool) {
        let side = SIDE * SAMPLES;
        let whole = (b - a).perp_dot(c - a);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        if whole.abs() < 1e-9 {
            return;
        }
        let range = |low: f32, high: f32| (low.max(0.0) as usize)..(high.max(0.0).ceil() as usize).min(side);
        for y in range(low.y, high.y) {
            for x in range(low.x, high.x) {
                let at = vec2(x as f32 + 0.5, y as f32 + 0.5);
                let (wb, wc) = ((at - a).perp_dot(c - a) / whole, (b - a).perp_dot(at - a) / whole);
                let weights = [1.0 - wb - wc, wb, wc];
                if weights.iter().all(|weight| *weight >= 0.0) && covers(weights) {
                    self.samples[y * side + x] = true;
                }
            }
        }
    }

    fn picture(&self) -> (Bitmap, f64) {
        let covered = |x: usize, y: usize| {
            let samples = (0..SAMPLES * SAMPLES).filter(|k| {
                let (x, y) = (x * SAMPLES + k % SAMPLES, y * SAMPLES + k / SAMPLES);
                self.samples[y * SIDE * SAMPLES + x]
            });
            samples.count()
        };
        let picture = Bitmap::from_fn(SIDE as u32, SIDE as u32, |x, y| {
            2 * covered(x as usize, y as usize) > SAMPLES * SAMPLES
        });
        (picture, self.samples.iter().filter(|covered| **covered).count() as f64)
    }
}

/// A level of detail.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compared {
    pub(crate) triangles: u64,
    /// Whether it has cards.
    pub(crate) has_cards: bool,
    /// Likeness to the tree from the front, 256 pixels high.
    pub(crate) likeness: f64,
    /// What it covers over what the tree covers.
    pub(crate) ink: f64,
}

/// The levels of the tree of `name` from seed 1.
pub(crate) fn compare(name: &str, budgets: &[u32]) -> Result<Vec<Compared>, Box<dyn std::error::Error>> {
    let species = pleach_generators::species(name)?;
    let palette = Palette::new(&species.appearance, None);
    let tree = species.grow(1)?;
    let blank = Canvas::new(&tree);
    let mut goal = blank.clone();
    goal.draw(&Mesh::new(&tree, MeshSettings::default()), None);
    let (goal, ink) = goal.picture();
    let levels = lod::budgets(&[&tree], MeshSettings::default(), budgets)?;
    let sheet = twig_sheet::paint(&palette, lod::painted(&[&tree], &levels));
    let compare = |level: &lod::Level<'_>| {
        let mut mesh = Mesh::default();
        send(&[level.mesher()], &mut mesh)?;
        let mut canvas = blank.clone();
        canvas.draw(&mesh, Some(&sheet));
        let (picture, own) = canvas.picture();
        Ok(Compared {
            triangles: mesh.triangles() as u64,
            has_cards: level.twigs.is_some(),
            likeness: Likeness::between(&picture, &goal).value(),
            ink: own / ink,
        })
    };
    levels[0].iter().map(compare).collect()
}
