//! Levels of detail with a budget beside the tree that they are of.

use glam::{Vec2, vec2};
use pleach_mesh::{Material, Mesh, MeshSettings, Palette, Pictures, lod, send};
use pleach_render::{Picture, twig_sheet};
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::Likeness;
use pleach_tree::Tree;

const SIDE: usize = 256;
/// Samples that a graphics card takes along the longer side of a pixel's place in a picture, as engines usually ask.
const ANISOTROPY: f32 = 8.0;
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

    /// Draws `mesh` with cards that show `sheet`, whole or halved as a graphics card does from afar.
    fn draw(&mut self, mesh: &Mesh, sheet: Option<&Sheet>, shown: Shown) {
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
                let uvs = corners.map(|corner| corner.uv);
                let halvings = sheet.map(|sheet| match shown {
                    Shown::Whole => 0.0,
                    Shown::Halved => sheet.halvings(at, uvs),
                });
                self.fill(at, |weights| {
                    let (Some(sheet), Some(halvings)) = (sheet, halvings) else { return true };
                    sheet.shows((0..3).map(|k| uvs[k] * weights[k]).sum(), halvings)
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

/// Which of the pictures of twigs are seen.
#[derive(Clone, Copy, Debug)]
enum Shown {
    /// The whole one, as by Cycles.
    Whole,
    /// The one whose pixels are about as large as those of the canvas, as by graphics cards.
    Halved,
}

/// The opacity of pictures of twigs, whole and halved again and again, as a graphics card keeps them.
struct Sheet {
    sizes: Vec<Opacity>,
    cutoff: f32,
}

struct Opacity {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Opacity {
    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let at =
            |x: usize, y: usize| self.values[y.min(self.height - 1) * self.width + x.min(self.width - 1)];
        let mean = |x: usize, y: usize| {
            (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1)) / 4.0
        };
        let values =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| mean(x, y)).collect();
        Self { width, height, values }
    }

    /// Between the four nearest pixels.
    fn at(&self, uv: Vec2) -> f32 {
        let (x, y) = (uv.x * self.width as f32 - 0.5, uv.y * self.height as f32 - 0.5);
        let (left, up) = (x.floor(), y.floor());
        let value = |x: f32, y: f32| {
            let (x, y) = (x.max(0.0) as usize, y.max(0.0) as usize);
            self.values[y.min(self.height - 1) * self.width + x.min(self.width - 1)]
        };
        let across = |y: f32| value(left, y) + (value(left + 1.0, y) - value(left, y)) * (x - left);
        across(up) + (across(up + 1.0) - across(up)) * (y - up)
    }
}

impl Sheet {
    fn new(pictures: &Pictures<Picture>) -> Self {
        let color = &pictures.color;
        let values = color.rgba.chunks_exact(4).map(|pixel| f32::from(pixel[3]) / 255.0).collect();
        let mut sizes = vec![Opacity { width: color.width as usize, height: color.height as usize, values }];
        while sizes.last().is_some_and(|last| last.width.max(last.height) > 1) {
            sizes.extend(sizes.last().map(Opacity::halved));
        }
        Self { sizes, cutoff: pictures.cutoff.unwrap_or(0.0) }
    }

    /// How often the picture is halved on a triangle with these corners, in samples, so that a pixel of the canvas has about
    /// one of it: along the shorter side of what a pixel covers, unless the longer one is more than [`ANISOTROPY`] times
    /// as long.
    fn halvings(&self, [a, b, c]: [Vec2; 3], [ua, ub, uc]: [Vec2; 3]) -> f32 {
        let (p, q) = ((b - a) / SAMPLES as f32, (c - a) / SAMPLES as f32);
        let size = vec2(self.sizes[0].width as f32, self.sizes[0].height as f32);
        let (s, t) = ((ub - ua) * size, (uc - ua) * size);
        let area = p.perp_dot(q);
        let (right, down) = ((s * q.y - t * p.y) / area, (t * p.x - s * q.x) / area);
        // The halves of the axes of the ellipse that a circle of a pixel is in the picture.
        let (sum, product) = (right.length_squared() + down.length_squared(), right.perp_dot(down).abs());
        let root = (sum * sum - 4.0 * product * product).max(0.0).sqrt();
        let [longer, shorter] = [sum + root, sum - root].map(|square| (square.max(0.0) / 2.0).sqrt());
        let covered = shorter.max(longer / ANISOTROPY);
        if covered.is_finite() { covered.max(1.0).log2() } else { 0.0 }
    }

    /// Whether a graphics card shows this place.
    fn shows(&self, uv: Vec2, halvings: f32) -> bool {
        let last = self.sizes.len() - 1;
        let at = |size: f32| self.sizes[(size as usize).min(last)].at(uv);
        let (finer, part) = (halvings.floor(), halvings.fract());
        let opacity = at(finer) + (at(finer + 1.0) - at(finer)) * part;
        opacity >= self.cutoff
    }
}

/// A level of detail.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compared {
    pub(crate) triangles: u64,
    /// Whether it has cards.
    pub(crate) has_cards: bool,
    /// With whole pictures.
    pub(crate) whole: Seen,
    /// With pictures that are halved as often as a graphics card does.
    pub(crate) halved: Seen,
}

/// What is seen of it beside the tree, from the front, 256 pixels high.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
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
    goal.draw(&Mesh::new(&tree, MeshSettings::default()), None, Shown::Whole);
    let (goal, ink) = goal.picture();
    let levels = lod::budgets(&[&tree], MeshSettings::default(), budgets)?;
    let sheet = Sheet::new(&twig_sheet::paint(&palette, lod::painted(&[&tree], &levels)));
    let compare = |level: &lod::Level<'_>| {
        let mut mesh = Mesh::default();
        send(&[level.mesher()], &mut mesh)?;
        let seen = |shown: Shown| {
            let mut canvas = blank.clone();
            canvas.draw(&mesh, Some(&sheet), shown);
            let (picture, own) = canvas.picture();
            Seen { likeness: Likeness::between(&picture, &goal).value(), ink: own / ink }
        };
        Ok(Compared {
            triangles: mesh.triangles() as u64,
            has_cards: level.twigs.is_some(),
            whole: seen(Shown::Whole),
            halved: seen(Shown::Halved),
        })
    };
    levels[0].iter().map(compare).collect()
}
