use pleach_mesh::{MeshSettings, lod};
fn main() {
    for name in pleach_generators::names() {
        let tree = pleach_generators::species(name).unwrap().grow(1).unwrap();
        let all = [100_000, 30_000, 8_000, 2_000];
        let started = std::time::Instant::now();
        for b in all {
            match lod::budgets(&[&tree], MeshSettings::default(), &[b]) {
                Err(e) => print!("{name} {e}; "),
                Ok(levels) => {
                    for l in &levels[0] {
                        let c = l.mesher().count().triangles;
                        let f = c as f64 / b as f64;
                        print!(
                            "{name} {b} {f:.3} {:?} tol {:.4} cards {} stems {}{}; ",
                            l.settings.leaves,
                            l.settings.tolerance,
                            l.twigs.as_ref().map_or(0, |t| t.cards.len()),
                            l.tree.stems.len(),
                            if f < 0.85 { " LOW" } else { "" }
                        );
                    }
                }
            }
        }
        println!("  {:.2} s", started.elapsed().as_secs_f64());
    }
}
