//! A tree cut into the stems of one generation with their descendants, and the rest.

use pleach_tree::{Address, Blob, Leaf, Stem, StemKind, Tree};

/// A stem of the generation with its descendants.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) address: Address,
    /// Its number in the tree.
    pub(super) stem: usize,
    pub(super) level: usize,
}

/// The parts of a tree: part 0 is the rest, then unit by unit.
#[derive(Debug, Default)]
pub(super) struct Units {
    pub(super) units: Vec<Unit>,
    stems: Grouped,
    leaves: Grouped,
    blossoms: Grouped,
    blobs: Grouped,
}

/// Indices, part by part.
#[derive(Debug, Default)]
struct Grouped {
    /// Where each part begins, and the end of the last.
    starts: Vec<usize>,
    numbers: Vec<u32>,
}

impl Grouped {
    /// Groups indices by their parts, each group in order.
    fn new(parts: usize, of: impl Iterator<Item = u32> + Clone) -> Self {
        let mut starts = vec![0; parts + 1];
        for part in of.clone() {
            starts[part as usize + 1] += 1;
        }
        for part in 0..parts {
            starts[part + 1] += starts[part];
        }
        let mut next = starts.clone();
        let mut numbers = vec![0; starts[parts]];
        for (number, part) in (0..).zip(of) {
            let place = &mut next[part as usize];
            numbers[*place] = number;
            *place += 1;
        }
        Self { starts, numbers }
    }

    fn get(&self, part: usize) -> impl Iterator<Item = usize> + '_ {
        self.numbers[self.starts[part]..self.starts[part + 1]].iter().map(|&number| number as usize)
    }
}

impl Units {
    /// The stems of `generation` in `tree`, roots left out.
    pub(super) fn new(tree: &Tree, generation: u16) -> Self {
        let mut units = Vec::new();
        let mut parts: Vec<u32> = Vec::with_capacity(tree.stems.len());
        let mut addresses: Vec<Address> = Vec::with_capacity(tree.stems.len());
        for (index, stem) in tree.stems.iter().enumerate() {
            let address = match (stem.parent, stem.kind) {
                (None, _) => Address::trunk(stem.number),
                (Some(parent), StemKind::Fork) => addresses[parent as usize].fork(stem.number),
                (Some(parent), _) => addresses[parent as usize].child(stem.number),
            };
            addresses.push(address);
            let part = if address.generation() == generation && stem.kind != StemKind::Root {
                units.push(Unit { address, stem: index, level: usize::from(stem.level) });
                units.len() as u32
            } else {
                stem.parent.map_or(0, |parent| parts[parent as usize])
            };
            parts.push(part);
        }
        let count = units.len() + 1;
        let on =
            |leaves: &'_ [Leaf]| Grouped::new(count, leaves.iter().map(|leaf| parts[leaf.stem as usize]));
        let (leaves, blossoms) = (on(&tree.leaves), on(&tree.blossoms));
        let blobs = Grouped::new(count, tree.blobs.iter().map(|blob| parts[blob.stem as usize]));
        let stems = Grouped::new(count, parts.iter().copied());
        Self { units, stems, leaves, blossoms, blobs }
    }

    /// Copies a part of `tree` to `out`, without parents, to draw it.
    pub(super) fn copy(&self, tree: &Tree, part: usize, out: &mut Tree) {
        out.clear();
        out.leaf_shapes.extend_from_slice(&tree.leaf_shapes);
        out.blossom_shapes.extend_from_slice(&tree.blossom_shapes);
        for index in self.stems.get(part) {
            let stem = &tree.stems[index];
            let first_knot = out.knots.len() as u32;
            out.knots.extend_from_slice(tree.knots_of(stem));
            out.stems.push(Stem { parent: None, first_knot, ..*stem });
        }
        let leaf = |leaf: &Leaf| Leaf { stem: 0, ..*leaf };
        out.leaves.extend(self.leaves.get(part).map(|index| leaf(&tree.leaves[index])));
        out.blossoms.extend(self.blossoms.get(part).map(|index| leaf(&tree.blossoms[index])));
        for index in self.blobs.get(part) {
            let blob = &tree.blobs[index];
            let first_vertex = out.blob_vertices.len() as u32;
            let first_triangle = out.blob_triangles.len() as u32;
            out.blob_vertices.extend_from_slice(&tree.blob_vertices[blob.vertices()]);
            out.blob_triangles.extend_from_slice(&tree.blob_triangles[blob.triangles()]);
            out.blobs.push(Blob { stem: 0, first_vertex, first_triangle, ..*blob });
        }
    }
}
