//! Leaves, blossoms and blobs.

use super::grid::{Corner, Grid};
use super::occlusion::Occlusion;
use super::outline::{Blade, Looks};
use super::sheet::Sheet;
use super::{Rasterizer, Scene, part_of, parts_of};
use crate::view::Camera;
use glam::{Vec2, Vec3};
use pleach_plant::leaf_shape::{Faces, Outline};
use pleach_plant::{Helpers, Leaf, Tree};
use std::mem;

impl Rasterizer {
    /// In several passes over all of the crown where it has many leaves: after each of them the pixels are marked
    /// that are black, so that most leaves of the later ones need only a look.
    pub(super) fn leaves(&mut self, scene: &Scene<'_>) {
        let Scene { tree, helpers, .. } = *scene;
        let placer = Placer::new(scene);
        // To look for them takes as long as to place the leaves, and each pass wants them.
        let mut runs = mem::take(&mut self.runs);
        runs.clear();
        Run::add_all(&tree.leaves, &mut runs);
        let passes = self.passes(tree.leaves.len() * LEAVES_TO_SWEEP);
        let parts = parts_of(tree.leaves.len());
        self.in_passes(passes, parts, helpers, &|sheet, pass, part| {
            every_so_many_leaves(
                sheet,
                tree,
                &placer,
                &runs[part_of(runs.len(), part, parts)],
                (pass, passes),
            )
        });
        self.runs = runs;
    }

    /// In passes, as leaves are.
    pub(super) fn blossoms(&mut self, scene: &Scene<'_>) {
        let Scene { tree, helpers, .. } = *scene;
        let placer = Placer::new(scene);
        // Leaves may have been drawn since black pixels were looked for.
        if self.saturates {
            self.sheet.look(PIXELS_FOR_A_LEAF);
        }
        let passes = self.passes(tree.blossoms.len() * BLOSSOMS_TO_SWEEP);
        let parts = parts_of(tree.blossoms.len());
        self.in_passes(passes, parts, helpers, &|sheet, pass, part| {
            let blossoms = &tree.blossoms[part_of(tree.blossoms.len(), part, parts)];
            every_so_many_blossoms(sheet, tree, &placer, blossoms, (pass, passes))
        });
    }

    /// In how many passes shapes are drawn: several if `count` is more than there are pixels.
    const fn passes(&self, count: usize) -> usize {
        if self.saturates && count > self.sheet.grid.area() { PASSES } else { 1 }
    }

    /// Draws shapes in several passes, each in so many parts, and looks for black pixels between passes. `draw` draws
    /// the shapes of a pass in a part, and returns how many were drawn.
    fn in_passes(
        &mut self,
        passes: usize,
        parts: usize,
        helpers: Option<&dyn Helpers>,
        draw: &(dyn Fn(&mut Sheet, usize, usize) -> usize + Sync),
    ) {
        self.sheet.pass = 0;
        self.sheet.draw(passes * parts, helpers, &|sheet, number| {
            let (pass, part) = (number / parts, number % parts);
            if pass != sheet.pass {
                sheet.pass = pass;
                sheet.look(PIXELS_FOR_A_LEAF);
            }
            let drawn = draw(sheet, pass, part);
            sheet.occlusion.add(drawn);
        });
    }

    /// The sides of each blob that face the viewer: what is behind them has the same outline.
    pub(super) fn blobs(&mut self, scene: &Scene<'_>) {
        let (tree, placer) = (scene.tree, Placer::new(scene));
        for blob in &tree.blobs {
            let vertices = &tree.blob_vertices[blob.vertices()];
            for triangle in &tree.blob_triangles[blob.triangles()] {
                let [a, b, c] = triangle.map(|i| placer.point(vertices[i as usize]));
                let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
                // Rows count downwards, so that what is counter-clockwise in the world is clockwise.
                let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                if turn < 0.0 {
                    self.sheet.grid.fill(&[a, b, c]);
                }
            }
        }
    }
}

/// Draws the leaves of each run at `first`, and every `step` from there on; returns how many were drawn. Those are not
/// that lie where all is black: of pixels, or of samples while no black pixels are known.
fn every_so_many_leaves(
    sheet: &mut Sheet,
    tree: &Tree,
    placer: &Placer<'_>,
    runs: &[Run],
    (first, step): (usize, usize),
) -> usize {
    let pixels = placer.camera.pixels_per_meter() as f32;
    let row = 1.0 / placer.scale.y;
    let Sheet { grid, occlusion, outlines, .. } = sheet;
    let mut corners = [[0.0; 2]; Outline::MAX_CORNERS];
    let mut drawn = 0;
    for &Run { like, start, end } in runs {
        let leaf = &tree.leaves[like];
        let size = [leaf.across.length() * pixels, leaf.along.length() * pixels];
        let Blade { outline, half_width, lowest, highest } = outlines.get(tree.outline_of(leaf), size);
        let corners = &mut corners[..outline.len()];
        for leaf in tree.leaves[start..end].iter().skip(first).step_by(step) {
            let Some([at, across, along]) = placer.place(leaf) else { continue };
            // Most leaves of a dense crown lie before or behind others.
            let reach = |axis: usize| {
                let (low, high) = (along[axis] * lowest, along[axis] * highest);
                let side = across[axis].abs() * half_width;
                (at[axis] + low.min(high) - side, at[axis] + low.max(high) + side)
            };
            let (top, bottom) = reach(1);
            if !Grid::has_row(top, bottom) {
                continue;
            }
            let (left, right) = reach(0);
            if is_hidden(occlusion, grid, [left, right], [top, bottom], row) {
                continue;
            }
            for (corner, p) in corners.iter_mut().zip(outline) {
                *corner =
                    [at[0] + across[0] * p[0] + along[0] * p[1], at[1] + across[1] * p[0] + along[1] * p[1]];
            }
            grid.fill(corners);
            drawn += 1;
        }
    }
    drawn
}

/// As [`every_so_many_leaves`], of blossoms.
fn every_so_many_blossoms(
    sheet: &mut Sheet,
    tree: &Tree,
    placer: &Placer<'_>,
    blossoms: &[Leaf],
    (first, step): (usize, usize),
) -> usize {
    let row = 1.0 / placer.scale.y;
    let Sheet { grid, occlusion, .. } = sheet;
    let mut corners = [[0.0; 2]; Outline::MAX_CORNERS];
    let mut drawn = 0;
    let mut last: Option<(u16, Cup)> = None;
    for blossom in blossoms.iter().skip(first).step_by(step) {
        let Some([at, across, along]) = placer.place(blossom) else { continue };
        let normal = placer.normal(blossom);
        // Nearly all trees have blossoms of one shape.
        let (_, Cup { faces, middle, half }) = match last.take() {
            Some(cup) if cup.0 == blossom.shape => last.insert(cup),
            _ => {
                let faces = tree.blossom_shapes[usize::from(blossom.shape)].faces();
                last.insert((blossom.shape, Cup::new(faces)))
            }
        };
        let place = |[u, v, w]: [f32; 3], axis: usize| {
            at[axis] + across[axis] * u + along[axis] * v + normal[axis] * w
        };
        let reach = |axis: usize| {
            let center = place(*middle, axis);
            let far =
                across[axis].abs() * half[0] + along[axis].abs() * half[1] + normal[axis].abs() * half[2];
            [center - far, center + far]
        };
        let [top, bottom] = reach(1);
        if !Grid::has_row(top, bottom) {
            continue;
        }
        let [left, right] = reach(0);
        if is_hidden(occlusion, grid, [left, right], [top, bottom], row) {
            continue;
        }
        for polygon in faces.petals {
            let corners = &mut corners[..polygon.len()];
            for (corner, &vertex) in corners.iter_mut().zip(*polygon) {
                let point = faces.vertices[usize::from(vertex)];
                *corner = [place(point, 0), place(point, 1)];
            }
            grid.fill(corners);
        }
        drawn += 1;
    }
    drawn
}

/// Whether all of a box in samples, of which there are 1 / `row` down each pixel, is black: by pixels where these have been
/// looked for, and else by samples.
#[inline]
fn is_hidden(occlusion: &Occlusion, grid: &Grid, across: [f32; 2], down: [f32; 2], row: f32) -> bool {
    if occlusion.is_known() {
        return occlusion.hides(across, down, row);
    }
    grid.is_covered(across[0], across[1], down[0], down[1])
}

/// Passes of a dense crown, and its density: more than one leaf per this many pixels.
const PASSES: usize = 8;
const LEAVES_TO_SWEEP: usize = 16;
/// The same of blossoms, which take several polygons each.
const BLOSSOMS_TO_SWEEP: usize = 64;
/// Black pixels are looked for after a pass once there is a shape per this many pixels.
const PIXELS_FOR_A_LEAF: usize = 100;

/// Leaves in a row that one part has, a multiple of [`PASSES`].
const LONGEST_RUN: usize = 512;

/// Leaves in a row that are drawn with one outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// The leaf whose outline it is.
    like: usize,
    start: usize,
    end: usize,
}

impl Run {
    /// Adds the runs of all leaves, each of which looks like the one before.
    fn add_all(leaves: &[Leaf], runs: &mut Vec<Self>) {
        let mut rest = leaves.iter().enumerate();
        let Some((_, first)) = rest.next() else { return };
        let (mut last, mut run) = (Looks::new(first), Self { like: 0, start: 0, end: 1 });
        for (i, leaf) in rest {
            let looks = Looks::new(leaf);
            if !last.are_those(&looks) {
                runs.push(run);
                run = Self { like: i, start: i, end: i };
            } else if i - run.start == LONGEST_RUN {
                runs.push(run);
                run.start = i;
            }
            run.end = i + 1;
            last = looks;
        }
        runs.push(run);
    }
}

/// The unit shape of a blossom and the box around it.
struct Cup {
    faces: &'static Faces,
    middle: [f32; 3],
    /// Half of its extents.
    half: [f32; 3],
}

impl Cup {
    fn new(faces: &'static Faces) -> Self {
        let along = |axis: usize| {
            let all = faces.vertices.iter().map(|vertex| vertex[axis]);
            all.fold([f32::MAX, f32::MIN], |[low, high], v| [low.min(v), high.max(v)])
        };
        let bounds = [along(0), along(1), along(2)];
        Self {
            faces,
            middle: bounds.map(|[low, high]| (low + high) / 2.0),
            half: bounds.map(|[low, high]| (high - low) / 2.0),
        }
    }
}

/// Takes the frames of leaves from the world to samples.
pub(super) struct Placer<'a> {
    pub(super) camera: &'a Camera,
    right: Vec3,
    down: Vec3,
    origin: Vec2,
    scale: Vec2,
    orthographic: bool,
}

impl<'a> Placer<'a> {
    pub(super) fn new(&Scene { camera, scale, .. }: &Scene<'a>) -> Self {
        let (x, y) = camera.project(glam::DVec3::ZERO, 1.0);
        Self {
            camera,
            right: camera.right.as_vec3() * scale.x,
            down: camera.down.as_vec3() * scale.y,
            origin: Vec2::new(x as f32, y as f32) * scale,
            scale,
            orthographic: camera.is_orthographic(),
        }
    }

    /// Position and the two axes of a leaf in samples; `None` behind the camera. Under perspective a
    /// leaf is drawn at the magnification of its base.
    pub(super) fn place(&self, leaf: &Leaf) -> Option<[Corner; 3]> {
        let (across, along) = (self.flat(leaf.across), self.flat(leaf.along));
        if self.orthographic {
            let at = self.flat(leaf.position);
            return Some([[at[0] + self.origin.x, at[1] + self.origin.y], across, along]);
        }
        let point = leaf.position.as_dvec3();
        let magnification = self.camera.magnification(point)?;
        let (x, y) = self.camera.project(point, magnification);
        let grown = |a: Corner| a.map(|v| v * magnification as f32);
        Some([[x as f32 * self.scale.x, y as f32 * self.scale.y], grown(across), grown(along)])
    }

    /// A point in samples; `None` behind the camera.
    pub(super) fn point(&self, point: Vec3) -> Option<Corner> {
        if self.orthographic {
            let at = self.flat(point);
            return Some([at[0] + self.origin.x, at[1] + self.origin.y]);
        }
        let point = point.as_dvec3();
        let (x, y) = self.camera.project(point, self.camera.magnification(point)?);
        Some([x as f32 * self.scale.x, y as f32 * self.scale.y])
    }

    /// The third axis, which only blossoms have a use for.
    pub(super) fn normal(&self, leaf: &Leaf) -> Corner {
        let magnification = self.camera.magnification(leaf.position.as_dvec3()).unwrap_or(1.0);
        self.flat(leaf.normal()).map(|v| v * magnification as f32)
    }

    fn flat(&self, v: Vec3) -> Corner {
        [v.dot(self.right), v.dot(self.down)]
    }
}
