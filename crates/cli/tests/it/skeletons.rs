//! Skeletons for programs that measure trees, read back from the files that the program writes.

use pleach_tests::Dir;
use std::f64::consts::PI;

/// Rows of numbers of a text, by separator, without the lines that `skip` says.
fn rows(text: &str, separator: char, skip: impl Fn(&str) -> bool) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !skip(line));
    lines.map(|line| line.split(separator).map(|value| value.parse().unwrap()).collect()).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The sum over all levels of a list of the statistics.
fn total(stats: &serde_json::Value, key: &str) -> f64 {
    stats[key].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).sum()
}

#[test]
fn cylinders_have_the_length_of_the_tree_and_no_gaps() {
    let dir = Dir::new();
    for species in ["acer", "palm", "quaking_aspen", "stylised_oak", "black_oak"] {
        let stats = dir.run(["grow", species, "--seed", "3", "--stats-only", "--json"]).json();
        let _ = dir.run(["grow", species, "--seed", "3", "-o", "tree.cylinders.csv"]).ok();
        let text = std::fs::read_to_string(dir.path("tree.cylinders.csv")).unwrap();
        let header = "radius,length,start.x,start.y,start.z,axis.x,axis.y,axis.z,parent,extension,added,UnmodRadius,\
                      branch,BranchOrder,PositionInBranch";
        assert_eq!(text.lines().next(), Some(header));
        let cylinders = rows(&text, ',', |line| line == header);
        let length: f64 = cylinders.iter().map(|c| c[1]).sum();
        let off = length / total(&stats, "length_total_m") - 1.0;
        assert!(off.abs() < 0.01, "{species}: {off}");
        let top = |c: &[f64]| [2, 3, 4].map(|i| c[i] + c[i + 3] * c[1]);
        for (i, cylinder) in cylinders.iter().enumerate() {
            let Some(parent) = (cylinder[8] as usize).checked_sub(1) else { continue };
            let (parent, start) = (&cylinders[parent], &cylinder[2..5]);
            let gap = distance(&top(parent), start).min(distance(&parent[2..5], start));
            assert!(gap < 1e-6, "{species}: {i} is {gap} m away");
        }
    }
}

#[test]
fn nodes_have_the_length_and_volume_of_the_cylinders() {
    let dir = Dir::new();
    let swc = dir.run(["grow", "acer", "-o", "-", "--format", "swc", "-q"]).ok();
    let csv = dir.run(["grow", "acer", "-o", "-", "--format", "csv", "-q"]).ok();
    let nodes = rows(&swc, ' ', |line| line.starts_with('#'));
    let (mut length, mut volume, mut roots) = (0.0, 0.0, 0);
    for (i, node) in nodes.iter().enumerate() {
        assert!(node[0] as usize == i + 1 && node[1] >= 5.0);
        if node[6] < 0.0 {
            roots += 1;
            continue;
        }
        let below = &nodes[node[6] as usize - 1];
        let step = distance(&node[2..5], &below[2..5]);
        let (r, s) = (node[5], below[5]);
        length += step;
        volume += step * PI * (r * r + r * s + s * s) / 3.0;
    }
    let cylinders = rows(&csv, ',', |line| line.starts_with("radius"));
    let sum = |of: fn(&Vec<f64>) -> f64| cylinders.iter().map(of).sum::<f64>();
    assert!((length / sum(|c| c[1]) - 1.0).abs() < 1e-4);
    assert!((volume / sum(|c| PI * c[0] * c[0] * c[1]) - 1.0).abs() < 1e-4);
    let trunks = cylinders.iter().filter(|c| c[8] == 0.0).count();
    assert!(roots == trunks && roots >= 1, "{roots} {trunks}");
}

#[test]
fn a_skeleton_takes_no_options_of_leaves_and_meshes() {
    let dir = Dir::new();
    dir.run(["grow", "acer", "-o", "x.swc", "--season", "winter"]).fails(1, &["--season", ".swc", ".json"]);
    dir.run(["grow", "acer", "-o", "x.csv", "--tolerance", "1"]).fails(1, &["--tolerance", ".csv", ".glb"]);
    let _ = dir.run(["grow", "acer", "--seeds", "0..2", "-o", "all/", "--format", "swc"]).ok();
    assert!(dir.path("all/acer-0.swc").exists() && dir.path("all/acer-1.swc").exists());
}
