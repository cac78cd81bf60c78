//! How good masks are, and whether their confidence can be believed, on pictures whose truth is known.
//!
//! ```text
//! cargo run --release -p pleach-silhouette --example composites -- FIRST COUNT [table|sheet OUT]
//! ```
//!
//! Trees grown by pleach are drawn with leaves in sun and shade before skies, lawns, far tree lines, hedges, houses, walls
//! and other trees of the same kind; `FIRST` and `COUNT` choose the pictures. Each is masked by `auto`, from a box
//! that is a few percent off on each side, as a hand drags it, and from one where the picture cuts off the crown. Prints quantiles of IoU by scenery, how many of the
//! masks of about a confidence are good, and with `table` a line per mask: way, scenery, whether sky is behind most
//! of the crown, IoU, confidence, what it was made by. Confidence was fitted to some of the
//! pictures 1000 to 1112; judge by others.

#![allow(clippy::print_stdout, reason = "an example's output")]

use pleach_plant::Parts;
use pleach_silhouette::mask::{Mask, MaskOptions, Photo, PixelBox, Segmentation};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use std::error::Error;

const WIDTH: u32 = 420;
const HEIGHT: u32 = 480;
const SPECIES: [&str; 8] = [
    "quaking_aspen",
    "acer",
    "black_oak",
    "small_pine",
    "silver_birch",
    "lombardy_poplar",
    "cambridge_oak",
    "european_larch",
];
const SCENERY: [&str; 8] = ["sky", "lawn", "tree line", "high wood", "hedge", "house", "wall", "neighbours"];
/// Sceneries in which the sky, or a wall, is behind most of the crown.
const OPEN: [usize; 6] = [0, 1, 2, 4, 5, 6];

/// By itself; from a box; from a box in a picture that cuts the crown off at both sides.
const WAYS: [&str; 3] = ["auto", "box", "box-cut-off"];

/// A mask with this IoU is good.
const GOOD: f64 = 0.85;

type Rgb = [f64; 3];

/// A number from 0 to 1 without order.
fn chance(x: u32, y: u32, salt: u32) -> f64 {
    let mut h = u64::from(x) << 40 ^ u64::from(y) << 20 ^ u64::from(salt);
    for _ in 0..3 {
        h = (h ^ h >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    (h >> 40) as f64 / f64::from(1 << 24)
}

/// Smooth noise from 0 to 1 over some `size` pixels.
fn cloud(x: u32, y: u32, size: f64, salt: u32) -> f64 {
    let (x, y) = (f64::from(x) / size, f64::from(y) / size);
    let at = |dx: u32, dy: u32| chance(x as u32 + dx, y as u32 + dy, salt);
    let ease = |v: f64| v * v * (3.0 - 2.0 * v);
    let (u, v) = (ease(x.fract()), ease(y.fract()));
    let row = |dy| at(0, dy) + u * (at(1, dy) - at(0, dy));
    row(0) + v * (row(1) - row(0))
}

/// The same with finer noise on top.
fn turbulence(x: u32, y: u32, size: f64, salt: u32) -> f64 {
    (0..4).map(|i| cloud(x, y, size / f64::from(1 << i), salt + i) / f64::from(2 << i)).sum::<f64>() / 0.9375
}

fn mix(a: Rgb, b: Rgb, share: f64) -> Rgb {
    std::array::from_fn(|i| a[i] + share.clamp(0.0, 1.0) * (b[i] - a[i]))
}

fn pick(salt: u32, i: u32, from: f64, to: f64) -> f64 {
    from + (to - from) * chance(i, 77, salt)
}

/// A tree as coverage of its wood and of all of it, 0 to 1, and as ink.
struct Drawn {
    stems: Vec<f64>,
    all: Vec<f64>,
    ink: Bitmap,
}

/// Draws a tree of a height in pixels with its foot at a place.
fn draw(
    species: &str,
    seed: u32,
    parts: Parts,
    height: f64,
    foot: (f64, f64),
) -> Result<Drawn, Box<dyn Error>> {
    let tree = pleach_generators::species(species)?.grow(u64::from(seed))?;
    let upright = Frame::automatic(&tree, &View::FRONT, parts, WIDTH, HEIGHT);
    let natural = {
        let mut bitmap = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &upright, parts, &mut bitmap);
        bitmap.ink_box().map_or(1.0, |(_, top, _, bottom)| f64::from(bottom - top + 1))
    };
    let frame = Frame {
        meters_per_pixel: upright.meters_per_pixel * natural / height,
        axis_column: foot.0,
        ground_row: foot.1,
        ..upright
    };
    let mut raster = Rasterizer::new();
    let mut drawn = |parts: Parts| {
        let (mut bitmap, mut covered) = (Bitmap::default(), Vec::new());
        raster.draw(&tree, &View::FRONT, &frame, parts, &mut bitmap);
        raster.coverage(&mut covered);
        let whole = f64::from(raster.samples());
        (covered.iter().map(|c| f64::from(*c) / whole).collect::<Vec<f64>>(), bitmap)
    };
    let (stems, _) = drawn(Parts::STEMS);
    let (all, ink) = drawn(parts);
    Ok(Drawn { stems, all, ink })
}

/// Colours of a tree's leaves and bark.
struct Tones {
    leaf: [Rgb; 2],
    bark: [Rgb; 2],
    salt: u32,
}

impl Tones {
    fn new(salt: u32) -> Self {
        let leaves: [[Rgb; 2]; 6] = [
            [[50.0, 85.0, 30.0], [115.0, 150.0, 60.0]],
            [[35.0, 60.0, 35.0], [80.0, 110.0, 70.0]],
            [[90.0, 110.0, 40.0], [170.0, 185.0, 80.0]],
            [[150.0, 60.0, 20.0], [230.0, 140.0, 50.0]],
            [[60.0, 80.0, 60.0], [130.0, 150.0, 120.0]],
            [[190.0, 150.0, 20.0], [245.0, 215.0, 70.0]],
        ];
        let barks: [[Rgb; 2]; 3] = [
            [[50.0, 40.0, 30.0], [120.0, 95.0, 75.0]],
            [[90.0, 85.0, 80.0], [175.0, 165.0, 155.0]],
            [[90.0, 55.0, 40.0], [160.0, 110.0, 85.0]],
        ];
        let of = |n: usize, i: u32| (chance(i, 3, salt) * n as f64) as usize;
        Self { leaf: leaves[of(6, 1)], bark: barks[of(3, 2)], salt }
    }

    fn at(&self, x: u32, y: u32, wood: f64) -> Rgb {
        let light = turbulence(x + 50, y, 40.0, self.salt + 20);
        let shine = 0.35 + 0.75 * light + 0.35 * (chance(x, y, self.salt + 30) - 0.5);
        let leaf = mix(self.leaf[0], self.leaf[1], shine);
        let bark = mix(self.bark[0], self.bark[1], 0.2 + 0.6 * chance(x, y / 3, self.salt + 31));
        mix(leaf, bark, wood)
    }
}

struct Scene {
    photo: Photo,
    truth: Bitmap,
    scenery: usize,
}

fn scene(salt: u32) -> Result<Scene, Box<dyn Error>> {
    let scenery = (salt % 8) as usize;
    let species = SPECIES[(chance(salt, 1, 5) * 8.0) as usize];
    let parts = if chance(salt, 2, 5) < 0.15 { Parts::STEMS } else { Parts::LEAFY };
    let (w, h) = (f64::from(WIDTH), f64::from(HEIGHT));
    let horizon = h * pick(salt, 1, 0.68, 0.85);
    let foot = (w * pick(salt, 2, 0.42, 0.58), horizon + h * pick(salt, 3, 0.04, 0.12));
    let tree = draw(species, salt % 5 + 1, parts, (foot.1 - 12.0).min(h * pick(salt, 4, 0.6, 0.85)), foot)?;
    let tones = Tones::new(1000 + salt);
    let kin = Tones::new(5000 + salt);
    let mut others = Vec::new();
    if scenery == 7 {
        for (i, at) in [0.02, 0.98].into_iter().enumerate() {
            let other = SPECIES[(chance(salt, 10 + i as u32, 5) * 8.0) as usize];
            let tall = h * pick(salt, 20 + i as u32, 0.3, 0.6);
            let place = (w * at, horizon + h * 0.03);
            others.push(draw(other, salt % 3 + 1, Parts::LEAFY, tall, place)?);
        }
    }
    let skies: [[Rgb; 2]; 4] = [
        [[70.0, 125.0, 205.0], [190.0, 215.0, 238.0]],
        [[195.0, 200.0, 205.0], [235.0, 236.0, 238.0]],
        [[25.0, 60.0, 140.0], [90.0, 140.0, 205.0]],
        [[120.0, 160.0, 215.0], [235.0, 238.0, 240.0]],
    ];
    let [high, low] = skies[(chance(salt, 30, 5) * 4.0) as usize];
    let cloudiness = pick(salt, 31, 0.0, 1.0).powi(2);
    let grain = pick(salt, 32, 2.0, 8.0);
    let ground: [[Rgb; 2]; 3] = [
        [[70.0, 115.0, 40.0], [125.0, 170.0, 75.0]],
        [[120.0, 110.0, 70.0], [185.0, 170.0, 120.0]],
        [[110.0, 110.0, 112.0], [150.0, 150.0, 152.0]],
    ];
    let [dark, bright] = ground[(chance(salt, 33, 5) * 3.0) as usize];
    let line = match scenery {
        2 => horizon - h * pick(salt, 34, 0.08, 0.2),
        3 => horizon - h * pick(salt, 34, 0.3, 0.5),
        4 => horizon - h * pick(salt, 34, 0.1, 0.25),
        _ => horizon,
    };
    let behind = |x: u32, y: u32| -> Rgb {
        let (fx, fy) = (f64::from(x), f64::from(y));
        let clouds = ((turbulence(x, y, 120.0, 40 + salt) - 0.5) * 4.0).clamp(0.0, 1.0) * cloudiness;
        let sky = mix(mix(high, low, fy / horizon), [246.0; 3], clouds);
        let lawn = mix(
            dark,
            bright,
            0.3 + 0.4 * turbulence(x, 3 * y, 20.0, 41 + salt) + 0.4 * chance(x, y, 42) - 0.2,
        );
        if scenery == 6 {
            let plaster = mix([200.0, 190.0, 170.0], [235.0, 228.0, 215.0], turbulence(x, y, 90.0, 43));
            return if fy < horizon { plaster.map(|v| v * (1.0 - 0.2 * fx / w)) } else { lawn };
        }
        let rim = match scenery {
            4 => line + 4.0 * cloud(x, 9, 9.0, 44 + salt),
            2 | 3 => {
                line + h * 0.09 * (turbulence(x, 7, 45.0, 45 + salt) - 0.5) + 8.0 * cloud(x, 11, 5.0, 46)
            }
            _ => horizon,
        };
        if scenery == 5 && (fx - w * 0.8).abs() < w * 0.3 && fy > h * 0.5 && fy < horizon {
            let window = (x / 24).is_multiple_of(2) && (y / 30).is_multiple_of(2);
            return if window {
                [60.0, 70.0, 85.0]
            } else {
                [175.0, 95.0, 75.0].map(|v| v * (0.9 + 0.1 * chance(x / 9, y / 4, 47)))
            };
        }
        if fy < rim {
            sky
        } else if fy < horizon {
            kin.at(x + 900, y + 77, 0.0).map(|v| v * 0.8)
        } else {
            lawn
        }
    };
    let photo = Photo::from_fn(WIDTH, HEIGHT, |x, y| {
        let i = (y * WIDTH + x) as usize;
        let mut seen = behind(x, y);
        for other in &others {
            let (wood, all) = (other.stems[i], other.all[i]);
            seen = mix(seen, kin.at(x, y, if all > 0.0 { wood / all } else { 0.0 }), all);
        }
        let (wood, all) = (tree.stems[i], tree.all[i]);
        seen = mix(seen, tones.at(x, y, if all > 0.0 { (wood / all).min(1.0) } else { 0.0 }), all);
        let noise =
            |c: u32| grain * ((0..3).map(|k| 2.0 * chance(x, y, 60 + 8 * c + k + salt) - 1.0).sum::<f64>());
        let [r, g, b] = [0, 1, 2].map(|c| (seen[c] + noise(c as u32)).clamp(0.0, 255.0) as u8);
        [r, g, b, 255]
    });
    Ok(Scene { photo, truth: tree.ink, scenery })
}

/// A box around ink that is up to a few percent off on each side, mostly too large.
fn dragged(ink: &Bitmap, salt: u32) -> Option<PixelBox> {
    let (left, top, right, bottom) = ink.ink_box()?;
    let side = f64::from((right - left).max(bottom - top));
    let off = |i: u32| (side * pick(salt, 90 + i, -0.005, 0.03)).round() as i32;
    let (x, y) = (left.saturating_add_signed(-off(0)), top.saturating_add_signed(-off(1)));
    let (end, foot) = (
        (right + 1).saturating_add_signed(off(2)).min(ink.width()),
        (bottom + 1).saturating_add_signed(off(3)).min(ink.height()),
    );
    Some(PixelBox { x, y, width: end - x, height: foot - y })
}

/// The part of a scene between two columns that cut off a twelfth of the tree's width at either side.
fn cut_off(scene: &Scene) -> Option<Scene> {
    let (left, _, right, _) = scene.truth.ink_box()?;
    let gap = (right - left) / 12;
    let (first, end) = (left + gap, right + 1 - gap);
    let pixels = scene.photo.pixels();
    let photo = Photo::from_fn(end - first, HEIGHT, |x, y| {
        let [r, g, b, _] = pixels[(y * scene.truth.width() + first + x) as usize];
        [r, g, b, 255]
    });
    let truth = Bitmap::from_fn(end - first, HEIGHT, |x, y| scene.truth.get(first + x, y));
    Some(Scene { photo, truth, scenery: scene.scenery })
}

fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b);
    both as f64 / (a.ink() + b.ink() - both).max(1) as f64
}

/// What a mask was made by.
const fn means(segmentation: Segmentation) -> &'static str {
    match segmentation {
        Segmentation::Opacity | Segmentation::TwoTones => "given",
        Segmentation::Color { .. } => "background",
        Segmentation::Colors => "colors",
        Segmentation::Cut { .. } => "cut",
    }
}

fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(((values.len().max(1) - 1) as f64 * part).round() as usize).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (Some(first), Some(count)) = (arguments.first(), arguments.get(1)) else {
        return Err("usage: composites FIRST COUNT [table|sheet OUT]".into());
    };
    let (first, count): (u32, u32) = (first.parse()?, count.parse()?);
    let wanted = arguments.get(2).map(String::as_str);
    // By way: scenery, IoU, confidence.
    let mut seen: [Vec<(usize, f64, f64)>; WAYS.len()] = Default::default();
    for salt in first..first + count {
        let whole = scene(salt)?;
        let cut = cut_off(&whole).ok_or("a scene without a tree")?;
        let ways = [(&whole, None), (&whole, dragged(&whole.truth, salt)), (&cut, dragged(&cut.truth, salt))];
        for (way, (scene, region)) in ways.into_iter().enumerate() {
            let made = Mask::from_photo(&scene.photo, &MaskOptions { region, ..MaskOptions::default() });
            let (found, confidence) =
                made.as_ref().map_or((0.0, 0.0), |mask| (iou(&mask.bitmap, &scene.truth), mask.confidence));
            seen[way].push((scene.scenery, found, confidence));
            let name = WAYS[way];
            if wanted == Some("table") {
                let open = OPEN.contains(&scene.scenery);
                let means = made.as_ref().map_or("none", |mask| means(mask.segmentation));
                println!(
                    "{salt} {name} {} {open} {found:.4} {confidence:.4} {means}",
                    SCENERY[scene.scenery].replace(' ', "-")
                );
            }
            if let (Some("sheet"), Some(out), Ok(mask)) = (wanted, arguments.get(3), made) {
                std::fs::create_dir_all(out)?;
                let path = format!("{out}/{salt:03}_{name}.png");
                mask.overlay(&scene.photo).write_png(&mut std::fs::File::create(path)?)?;
            }
        }
    }
    for (name, seen) in WAYS.iter().zip(&seen) {
        println!("{name}: IoU, first decile, median");
        let row = |label: &str, wanted: &dyn Fn(usize) -> bool| {
            let mut of: Vec<f64> = seen.iter().filter(|s| wanted(s.0)).map(|s| s.1).collect();
            println!("  {label:12} {:.3} {:.3}", quantile(&mut of, 0.1), quantile(&mut of, 0.5));
        };
        for (i, scenery) in SCENERY.iter().enumerate() {
            row(scenery, &|s| s == i);
        }
        row("open", &|s| OPEN.contains(&s));
        row("all", &|_| true);
        let bounds = [0.0, 0.2, 0.45, 0.6, 0.7, 0.8, 0.85, 0.95, 1.01];
        for (low, high) in bounds.iter().zip(&bounds[1..]) {
            let of: Vec<f64> = seen.iter().filter(|s| (low..high).contains(&&s.2)).map(|s| s.1).collect();
            let good = of.iter().filter(|iou| **iou >= GOOD).count();
            println!(
                "  confidence {low:.2} to {high:.2}: {good} of {} have an IoU of {GOOD} or more",
                of.len()
            );
        }
    }
    Ok(())
}
