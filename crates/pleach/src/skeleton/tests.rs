use super::*;
use pleach_tree::{Limits, StemKind};

/// Trees of three families, whose branches start on surfaces and on axes, with forks, fans, helices and several trunks.
pub(super) const SPECIES: [&str; 9] = [
    "acer",
    "palm",
    "small_pine",
    "black_oak",
    "bamboo",
    "stylised_oak",
    "fan_elm",
    "lombardy_poplar",
    "quaking_aspen",
];

pub(super) fn grown(name: &str) -> Tree {
    let species = pleach_generators::species(name).unwrap();
    let growth = pleach_tree::Growth { limits: Limits::DEFAULT, ..pleach_tree::Growth::seed(2) };
    species.grow_with(&growth).unwrap()
}

/// Length and volume of the stems above the ground, by many chords.
fn measured(tree: &Tree) -> (f64, f64) {
    const CHORDS: u32 = 200;
    let (mut length, mut volume) = (0.0, 0.0);
    for stem in tree.stems.iter().filter(|stem| stem.kind != StemKind::Root) {
        for (piece, from, to) in tree.pieces_of(stem) {
            let at = |chord: u32| f64::from(chord) / f64::from(CHORDS);
            for chord in 0..CHORDS {
                let (a, b) = (at(chord), at(chord + 1));
                let step = piece.at(a).distance(piece.at(b));
                length += step;
                volume += step * PI * mean_square(from + (to - from) * a, from + (to - from) * b);
            }
        }
    }
    (length, volume)
}

#[test]
fn lengths_and_volumes_are_those_of_the_tree() {
    for name in SPECIES {
        let tree = grown(name);
        let skeleton = Skeleton::new(&tree);
        let (length, volume) = measured(&tree);
        let off = (skeleton.length() / length - 1.0, skeleton.volume() / volume - 1.0);
        assert!(off.0.abs() < 0.004 && off.1.abs() < 0.004, "{name}: {off:?}");
        let cylinders = skeleton.cylinders();
        let length: f64 = cylinders.iter().map(|c| c.length).sum();
        let volume: f64 = cylinders.iter().map(|c| PI * c.radius * c.radius * c.length).sum();
        assert!((length / skeleton.length() - 1.0).abs() < 1e-9, "{name}");
        assert!((volume / skeleton.volume() - 1.0).abs() < 1e-9, "{name}");
    }
}

#[test]
fn stems_begin_on_their_parents_and_are_not_moved_far() {
    for name in SPECIES {
        let tree = grown(name);
        let skeleton = Skeleton::new(&tree);
        let thickest = tree.knots.iter().map(|knot| knot.radius).fold(0.0, f64::max);
        let (mut first, mut starts) = (vec![None; tree.stems.len()], 0);
        for (i, node) in skeleton.nodes.iter().enumerate() {
            assert!(node.parent.is_none_or(|parent| (parent as usize) < i), "{name}: {i}");
            if first[node.stem as usize].replace(i).is_some() {
                continue;
            }
            let stem = &tree.stems[node.stem as usize];
            assert_eq!(node.parent.is_some(), stem.parent.is_some());
            assert_eq!(node.level, stem.level);
            let moved = node.position.distance(tree.knots_of(stem)[0].point);
            assert!(moved < 4.0 * thickest, "{name}: {i} was moved by {moved} m");
            if let Some(parent) = node.parent {
                let parent = skeleton.nodes[parent as usize];
                assert_eq!(Some(parent.stem), stem.parent);
                assert_eq!(parent.position, node.position, "{name}: {i}");
                starts += 1;
            }
        }
        assert_eq!(
            starts,
            tree.stems.iter().filter(|s| s.parent.is_some() && s.kind != StemKind::Root).count()
        );
    }
}

#[test]
fn cylinders_follow_each_other_without_gaps() {
    for name in SPECIES {
        let cylinders = Skeleton::new(&grown(name)).cylinders();
        let top = |c: &Cylinder| c.start + c.axis * c.length;
        for (i, cylinder) in cylinders.iter().enumerate() {
            assert!((cylinder.axis.length() - 1.0).abs() < 1e-9, "{name}: {i}");
            let place = (name, i);
            if cylinder.position_in_branch > 1 {
                assert_eq!(cylinder.parent as usize, i, "{place:?}");
                assert_eq!(cylinders[i - 1].extension as usize, i + 1, "{place:?}");
                assert_eq!(cylinders[i - 1].branch, cylinder.branch, "{place:?}");
            }
            let Some(parent) = (cylinder.parent as usize).checked_sub(1).map(|parent| &cylinders[parent])
            else {
                assert_eq!(cylinder.branch_order, 0, "{place:?}");
                continue;
            };
            let gap = top(parent).distance(cylinder.start).min(parent.start.distance(cylinder.start));
            assert!(gap < 1e-6, "{place:?}: {gap}");
        }
    }
}

#[test]
fn files_hold_every_node_and_every_cylinder() {
    let skeleton = Skeleton::new(&grown("acer"));
    let text = |format| {
        let mut bytes = Vec::new();
        skeleton.write(format, &mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    };
    let swc = text(SkeletonFormat::Swc);
    let rows: Vec<&str> = swc.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(rows.len(), skeleton.nodes.len());
    assert!(rows[0].starts_with("1 5 0.00000000 0.00000000 0.00000000 0.") && rows[0].ends_with(" -1"));
    assert!(!swc.contains("-0.00000000"));
    let csv = text(SkeletonFormat::Csv);
    let columns = csv.lines().next().unwrap().split(',').count();
    assert_eq!(columns, 15);
    assert!(csv.lines().all(|line| line.split(',').count() == columns));
    assert_eq!(csv.lines().count(), skeleton.cylinders().len() + 1);
}

#[test]
fn lines_pass_the_nodes_of_each_stem() {
    let skeleton = Skeleton::new(&grown("acer"));
    let mut bytes = Vec::new();
    skeleton.write_lines(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let points: Vec<Vec<f64>> = text
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .map(|line| line.split(' ').map(|value| value.parse().unwrap()).collect())
        .collect();
    assert_eq!(points.len(), skeleton.nodes.len());
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    let mut length = 0.0;
    for line in text.lines().filter_map(|line| line.strip_prefix("l ")) {
        let numbers: Vec<usize> = line.split(' ').map(|number| number.parse().unwrap()).collect();
        length += numbers.windows(2).map(|w| distance(&points[w[0] - 1], &points[w[1] - 1])).sum::<f64>();
    }
    assert!((length / skeleton.length() - 1.0).abs() < 1e-5);
    let highest = points.iter().map(|point| point[1]).fold(0.0, f64::max);
    assert!(highest > 5.0 && !text.contains("-0.00000000"), "y is up: {highest}");
}

#[test]
fn a_tree_without_stems_has_no_nodes() {
    let skeleton = Skeleton::new(&Tree::default());
    assert_eq!((skeleton.nodes.len(), skeleton.cylinders().len()), (0, 0));
    assert_eq!((skeleton.length(), skeleton.volume()), (0.0, 0.0));
}

/// Of each node of a multiscale tree graph, in its order: axis, number, parent among them, position and radius.
fn read_mtg(text: &str) -> Vec<(String, Option<usize>, Vec<f64>)> {
    let (_, body) = text.split_once("\nMTG:\n").unwrap();
    let mut lines = body.lines();
    let head: Vec<&str> = lines.next().unwrap().split('\t').collect();
    let columns = head.iter().position(|name| *name == "XX").unwrap();
    assert_eq!(&head[columns..], ["XX", "YY", "ZZ", "Radius", "Level"]);
    // Of each column, the node that was there last.
    let mut last: Vec<usize> = Vec::new();
    let mut nodes: Vec<(String, Option<usize>, Vec<f64>)> = Vec::new();
    for line in lines {
        let cells: Vec<&str> = line.split('\t').collect();
        assert_eq!(cells.len(), head.len(), "{line}");
        let depth = cells.iter().position(|cell| !cell.is_empty()).unwrap();
        let (code, parent) = (cells[depth], (depth > 0).then(|| last[depth - 1]));
        let (axis, parent) = match code.strip_prefix("^<") {
            Some(_) => (nodes[last[depth]].0.clone(), Some(last[depth])),
            None => (
                code.split('/').find(|part| part.contains('A')).unwrap().trim_start_matches('+').to_owned(),
                parent,
            ),
        };
        last.truncate(depth);
        last.push(nodes.len());
        nodes.push((axis, parent, cells[columns..].iter().map(|cell| cell.parse().unwrap()).collect()));
    }
    nodes
}

#[test]
fn a_multiscale_tree_graph_has_every_node_on_its_parent() {
    for name in SPECIES {
        let skeleton = Skeleton::new(&grown(name));
        let mut bytes = Vec::new();
        skeleton.write(SkeletonFormat::Mtg, &mut bytes).unwrap();
        let read = read_mtg(&String::from_utf8(bytes).unwrap());
        assert_eq!(read.len(), skeleton.nodes.len(), "{name}");
        // Nodes are in another order: each is known by its stem and its number there.
        let key = |axis: &str, seen: &mut std::collections::BTreeMap<String, usize>| {
            let number = seen.entry(axis.to_owned()).or_default();
            *number += 1;
            (axis.to_owned(), *number)
        };
        let mut seen = std::collections::BTreeMap::new();
        let keys: Vec<_> = read.iter().map(|(axis, ..)| key(axis, &mut seen)).collect();
        let mut seen = std::collections::BTreeMap::new();
        let own: Vec<_> =
            skeleton.nodes.iter().map(|node| key(&format!("A{}", node.stem + 1), &mut seen)).collect();
        let at: std::collections::BTreeMap<_, usize> = keys.iter().zip(0..).collect();
        for (i, node) in skeleton.nodes.iter().enumerate() {
            let (_, parent, values) = &read[at[&own[i]]];
            assert_eq!(parent.map(|p| &keys[p]), node.parent.map(|p| &own[p as usize]), "{name}: {i}");
            assert!((values[2] - node.position.z).abs() < 1e-7 && (values[3] - node.radius).abs() < 1e-7);
            assert_eq!(values[4], f64::from(node.level));
        }
    }
}

#[test]
fn a_multiscale_tree_graph_of_many_columns_is_refused() {
    let node = |stem: u32| {
        let (position, parent) = (DVec3::Z * f64::from(stem), stem.checked_sub(1));
        SkeletonNode { position, radius: 0.1, parent, stem, level: 0 }
    };
    let nested = |stems: u32| Skeleton { nodes: (0..stems).map(node).collect() };
    let write = |stems| nested(stems).write(SkeletonFormat::Mtg, &mut Vec::new());
    write(1000).unwrap();
    assert!(write(1001).unwrap_err().to_string().contains("nested 1001 deep"));
}
