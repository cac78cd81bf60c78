fn main() {
    let name = std::env::args().nth(1).unwrap();
    let n: u64 = std::env::args().nth(2).unwrap().parse().unwrap();
    let s = pleach_weber_penn::preset(&name).unwrap();
    let mut ws = pleach_tree::Workspace::default();
    let mut tree = pleach_tree::Tree::default();
    let mut times = vec![];
    for seed in 1..=n {
        let t = std::time::Instant::now();
        s.generator.grow(&s.params, &pleach_tree::Growth::seed(seed), &mut ws, &mut tree).unwrap();
        times.push(t.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    println!("{name} median {:.2} ms min {:.2}", times[times.len() / 2], times[0]);
}
