use pleach_silhouette::*;
use std::time::Instant;
fn main() {
    let size: u32 = std::env::args().nth(1).map_or(256, |s| s.parse().unwrap());
    for name in pleach_generators::names().into_iter().take(15) {
        let s = pleach_generators::species(name).unwrap();
        let tree = s.grow(1).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, true, size, size);
        let mut r = Rasteriser::new();
        let mut out = Bitmap::default();
        let mut best = f64::INFINITY;
        for _ in 0..7 {
            let t = Instant::now();
            r.draw(&tree, &View::FRONT, &frame, true, &mut out);
            best = best.min(t.elapsed().as_secs_f64() * 1e3);
        }
        let mut bare = f64::INFINITY;
        let mut b = Bitmap::default();
        for _ in 0..7 {
            let t = Instant::now();
            r.draw(&tree, &View::FRONT, &frame, false, &mut b);
            bare = bare.min(t.elapsed().as_secs_f64() * 1e3);
        }
        let ink = out.ink() as f64 / out.area() as f64;
        println!(
            "{name:20} {} leaves {} stems full {best:.2} ms bare {bare:.2} ms ink {ink:.4} bare {:.4}",
            tree.leaves.len(),
            tree.stems.len(),
            b.ink() as f64 / b.area() as f64
        );
        std::fs::write(format!("/tmp/w/{name}_{size}.png"), out.to_png()).unwrap();
        std::fs::write(format!("/tmp/w/{name}_{size}_bare.png"), b.to_png()).unwrap();
    }
}
