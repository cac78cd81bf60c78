//! Twigs and leaves in groups of about the same area, each of what hangs on one stretch of a stem.

use super::stems::Kept;
use crate::settings::{LeafStyle, MeshSettings};
use glam::{DVec3, Vec3};
use pleach_plant::{Leaf, Parts, Stem, Tree};
use std::ops::Range;

/// What hangs on a stem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hanging {
    /// A stem that is not drawn, with all that it carries.
    Stem(u32),
    Leaf(u32),
    Blossom(u32),
}

#[derive(Clone, Copy, Debug)]
struct Hang {
    what: Hanging,
    /// Where on the stem, 0 at its base to 1 at its tip.
    place: f32,
    /// What it and all that it carries show, in square metres.
    area: f32,
}

/// A stretch of a stem and what hangs there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Group {
    /// The stem, which is drawn or not.
    pub(super) stem: u32,
    hangs: Range<u32>,
}

/// What hangs where on a tree some of whose stems are not drawn.
#[derive(Debug)]
pub(super) struct Hangs<'a> {
    tree: &'a Tree,
    kept: &'a Kept,
    /// Sorted by stem and place.
    hangs: Vec<Hang>,
    /// Where each stem's begin, and the end of the last.
    first: Vec<u32>,
}

impl<'a> Hangs<'a> {
    /// What of `tree` is drawn with these settings.
    pub(super) fn new(tree: &'a Tree, kept: &'a Kept, settings: MeshSettings) -> Self {
        let has_foliage = settings.leaves != LeafStyle::None;
        let has = |part| has_foliage && settings.parts.contains(part);
        let is_drawn = |stem: &Stem| settings.parts.has_stem(stem.kind);
        let area_of = |leaf: &Leaf, unit: f32| leaf.unit_area() * unit;
        let mut areas: Vec<f32> = tree.stems.iter().map(|stem| tree_area(tree, stem)).collect();
        let mut all: Vec<(u32, Hang)> = Vec::with_capacity(tree.leaves.len() + tree.blossoms.len());
        let axes: Vec<Axis> = (0..tree.stems.len()).map(|stem| Axis::new(tree, stem)).collect();
        let mut hang = |leaf: &Leaf, what, area: f32| {
            areas[leaf.stem as usize] += area;
            all.push((leaf.stem, Hang { what, place: axes[leaf.stem as usize].place(leaf.position), area }));
        };
        for (i, leaf) in (0..).zip(&tree.leaves).filter(|_| has(Parts::LEAVES)) {
            hang(leaf, Hanging::Leaf(i), area_of(leaf, tree.outline_of(leaf).area()));
        }
        for (i, blossom) in (0..).zip(&tree.blossoms).filter(|_| has(Parts::BLOSSOMS)) {
            let unit = tree.blossom_shapes[usize::from(blossom.shape)].faces().area();
            hang(blossom, Hanging::Blossom(i), area_of(blossom, unit));
        }
        // Children come after their parents.
        for (i, stem) in tree.stems.iter().enumerate().rev() {
            let Some(parent) = stem.parent.filter(|_| !kept.is_kept[i] && is_drawn(stem)) else { continue };
            let foot = tree.knots_of(stem)[0].point.as_vec3();
            let area = areas[i];
            areas[parent as usize] += area;
            let place = axes[parent as usize].place(foot);
            all.push((parent, Hang { what: Hanging::Stem(i as u32), place, area }));
        }
        all.sort_by(|(stem, a), (other, b)| stem.cmp(other).then(a.place.total_cmp(&b.place)));
        let mut first = vec![0; tree.stems.len() + 1];
        all.iter().for_each(|(stem, _)| first[*stem as usize + 1] += 1);
        for i in 0..tree.stems.len() {
            first[i + 1] += first[i];
        }
        Self { tree, kept, hangs: all.into_iter().map(|(_, hang)| hang).collect(), first }
    }

    /// At most `count` groups of about equal area, and as many as that allows.
    pub(super) fn groups(&self, count: usize) -> Vec<Group> {
        let whole: f32 = self.hangs.iter().map(|hang| hang.area).sum();
        let (mut low, mut high) = (0.0, whole.max(f32::MIN_POSITIVE));
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            if self.split(middle).len() > count { low = middle } else { high = middle }
        }
        self.split(high)
    }

    /// Groups of at most this area each, where no single thing is larger.
    fn split(&self, most: f32) -> Vec<Group> {
        let mut groups = Vec::new();
        let mut stems: Vec<u32> = (0..self.tree.stems.len() as u32)
            .filter(|&i| self.kept.is_kept[i as usize] || self.tree.stems[i as usize].parent.is_none())
            .collect();
        while let Some(stem) = stems.pop() {
            let range = self.first[stem as usize]..self.first[stem as usize + 1];
            let (mut start, mut area) = (range.start, 0.0);
            let mut close = |hangs: Range<u32>| {
                if !hangs.is_empty() {
                    groups.push(Group { stem, hangs });
                }
            };
            for i in range.clone() {
                let hang = &self.hangs[i as usize];
                match hang.what {
                    Hanging::Stem(child) if hang.area > most && self.carries(child) => {
                        close(start..i);
                        (start, area) = (i + 1, 0.0);
                        stems.push(child);
                    }
                    _ if area + hang.area > most => {
                        close(start..i);
                        (start, area) = (i, hang.area);
                    }
                    _ => area += hang.area,
                }
            }
            close(start..range.end);
        }
        groups
    }

    fn carries(&self, stem: u32) -> bool {
        self.first[stem as usize] < self.first[stem as usize + 1]
    }

    /// What a group shows, in square metres.
    pub(super) fn area(&self, group: &Group) -> f32 {
        self.hangs_of(group).iter().map(|hang| hang.area).sum()
    }

    fn hangs_of(&self, group: &Group) -> &[Hang] {
        &self.hangs[group.hangs.start as usize..group.hangs.end as usize]
    }

    /// Where a group begins, on the axis of its stem.
    pub(super) fn foot(&self, group: &Group) -> Vec3 {
        let place = self.hangs_of(group).first().map_or(0.0, |hang| hang.place);
        Axis::new(self.tree, group.stem as usize).at(place)
    }

    /// Shows everything in a group to `see`: stems that are not drawn and all that they carry, and its own stem if
    /// that is not drawn either.
    pub(super) fn each(&self, group: &Group, mut see: impl FnMut(Hanging)) {
        if !self.kept.is_kept[group.stem as usize] {
            see(Hanging::Stem(group.stem));
        }
        let mut stems = Vec::new();
        let mut take = |hang: &Hang, stems: &mut Vec<u32>| {
            see(hang.what);
            if let Hanging::Stem(child) = hang.what {
                stems.push(child);
            }
        };
        self.hangs_of(group).iter().for_each(|hang| take(hang, &mut stems));
        while let Some(stem) = stems.pop() {
            let range = self.first[stem as usize] as usize..self.first[stem as usize + 1] as usize;
            self.hangs[range].iter().for_each(|hang| take(hang, &mut stems));
        }
    }
}

/// What the wood of a stem shows from the side.
fn tree_area(tree: &Tree, stem: &Stem) -> f32 {
    let pieces = tree.knots_of(stem).windows(2);
    pieces.map(|pair| pair[0].point.distance(pair[1].point) * (pair[0].radius + pair[1].radius)).sum::<f64>()
        as f32
}

/// The straight line from a stem's base to its tip.
#[derive(Clone, Copy, Debug)]
struct Axis {
    base: DVec3,
    along: DVec3,
}

impl Axis {
    fn new(tree: &Tree, stem: usize) -> Self {
        let knots = tree.knots_of(&tree.stems[stem]);
        let base = knots[0].point;
        Self { base, along: knots[knots.len() - 1].point - base }
    }

    fn place(&self, point: Vec3) -> f32 {
        let length = self.along.length_squared().max(1e-12);
        ((point.as_dvec3() - self.base).dot(self.along) / length).clamp(0.0, 1.0) as f32
    }

    fn at(&self, place: f32) -> Vec3 {
        (self.base + self.along * f64::from(place)).as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(name: &str) -> Tree {
        pleach_generators::preset(name).unwrap().grow(1).unwrap()
    }

    #[test]
    fn every_leaf_and_every_thin_stem_is_in_one_group() {
        for name in ["quaking_aspen", "hill_cherry", "small_pine"] {
            let tree = tree(name);
            let kept = Kept::new(&tree, 0.01);
            let hangs = Hangs::new(&tree, &kept, MeshSettings::default());
            for count in [1, 20, 500] {
                let groups = hangs.groups(count);
                let mut seen =
                    [vec![0; tree.stems.len()], vec![0; tree.leaves.len()], vec![0; tree.blossoms.len()]];
                for group in &groups {
                    hangs.each(group, |what| match what {
                        Hanging::Stem(i) => seen[0][i as usize] += 1,
                        Hanging::Leaf(i) => seen[1][i as usize] += 1,
                        Hanging::Blossom(i) => seen[2][i as usize] += 1,
                    });
                }
                assert!(seen[1].iter().chain(&seen[2]).all(|n| *n == 1), "{name} {count}");
                let thin = seen[0].iter().zip(&kept.is_kept);
                assert!(thin.clone().all(|(n, kept)| (*n == 0) == *kept), "{name} {count}");
            }
        }
    }

    #[test]
    fn groups_are_nearly_as_many_as_there_may_be() {
        let tree = tree("quaking_aspen");
        let kept = Kept::new(&tree, 0.03);
        let hangs = Hangs::new(&tree, &kept, MeshSettings::default());
        let mut largest = f32::INFINITY;
        for count in [200, 1000, 5000] {
            let groups = hangs.groups(count);
            assert!((count * 9 / 10..=count).contains(&groups.len()), "{count}: {}", groups.len());
            let area = groups.iter().map(|group| hangs.area(group)).fold(0.0, f32::max);
            assert!(area < largest, "{count}: {area}");
            largest = area;
        }
    }
}
