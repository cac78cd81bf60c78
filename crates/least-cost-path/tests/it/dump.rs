//! temporary
use pleach_least_cost_path::*;
use pleach_tree::*;
use std::io::Write;
#[test]
fn dump() {
    for (name, _) in LeastCostPathFamily.presets() {
        let s = species::preset(&LeastCostPathFamily, name).unwrap();
        let mut ws = Workspace::default();
        let mut tree = Tree::default();
        let g = Growth { parallel: false, ..Growth::seed(1) };
        s.generator.grow(&s.params, &g, &mut ws, &mut tree).unwrap();
        let t = std::time::Instant::now();
        s.generator.grow(&s.params, &g, &mut ws, &mut tree).unwrap();
        eprintln!("{name} {:?} stems {} knots {}", t.elapsed(), tree.stems.len(), tree.knots.len());
        let mut f = std::io::BufWriter::new(std::fs::File::create(format!("/tmp/lcpx/{name}.txt")).unwrap());
        for leaf in &tree.leaves {
            let (p, q) = (leaf.position, leaf.position + leaf.along);
            writeln!(f, "{} {} {} {} {}", p.x, p.z, q.x, q.z, leaf.across.length() * 0.15).unwrap();
        }
        for stem in &tree.stems {
            for (c, a, b) in tree.pieces_of(stem) {
                for i in 0..4 {
                    let (u, v) = (f64::from(i) / 4.0, f64::from(i + 1) / 4.0);
                    let (p, q) = (c.at(u), c.at(v));
                    writeln!(f, "{} {} {} {} {}", p.x, p.z, q.x, q.z, a + (b - a) * u).unwrap();
                }
            }
        }
    }
}
