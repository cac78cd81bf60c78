use pleach_fit::*;
use pleach_silhouette::{Detail, Frame, Rasteriser, View, Bitmap};
use std::sync::Arc;
fn main() {
    let names = pleach_generators::names();
    let fifteen: Vec<&str> = names.iter().copied().collect();
    let candidates: Vec<Candidate> = fifteen.iter().map(|n| Candidate { name: n.to_string(), values: pleach_generators::preset(n).unwrap().params.values().to_vec() }).collect();
    let obj: Objective = std::env::args().nth(1).unwrap().parse().unwrap();
    let mut hits = 0; let mut total = 0;
    let t = std::time::Instant::now();
    for n in &fifteen { for seed in [11, 12] {
        let sp = pleach_generators::preset(n).unwrap();
        let tree = sp.grow(seed).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, true, 256, 256);
        let mut goal = Bitmap::default();
        Rasteriser::with_detail(Detail::Full).draw(&tree, &View::FRONT, &frame, true, &mut goal);
        let problem = FitProblem { generator: Arc::clone(&sp.generator), base: sp.params.values().to_vec(), goals: vec![GoalView { goal, view: View::FRONT, frame }], foliage: true };
        let settings = FitSettings { objective: obj, ..FitSettings::default() };
        let g = first_guess(&problem, &settings, &candidates, &GuessSettings { seeds: 3, variants: 8, ..Default::default() }, |_, _| ()).unwrap();
        total += 1; let ok = g.names[0].0 == *n; hits += i32::from(ok);
        println!("{n:18} {ok} {:?} start {:.3} {}", g.names[..3].iter().map(|(a, b)| format!("{a} {b:.2}")).collect::<Vec<_>>(), g.nearest[0].score.iou, g.nearest[0].name);
    } }
    println!("{obj} {hits}/{total} {:?}", t.elapsed() / total as u32);
}
