//! A second reading allocates nothing: a search reads millions of pictures.
//!
//! Alone in its program: the counter sees every thread. The test harness allocates a little while a test begins, so that
//! one round of several without an allocation is asked for: a reader that allocates does so in each.

use pleach_reading::{Reader, Reading};
use pleach_silhouette::Bitmap;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

#[test]
fn second_readings_allocate_nothing() {
    let is_limb = |x: u32, y: u32| y < 90 && (x + y == 190 || x + y == 191 || x == y + 30 || x == y + 31);
    let pictures = [
        Bitmap::from_fn(220, 200, |x, y| (105..115).contains(&x) || y < 120 && (x * 7 + y * 13) % 11 < 4),
        Bitmap::from_fn(220, 200, |x, y| (105..115).contains(&x) && y > 80 || is_limb(x, y)),
        Bitmap::from_fn(100, 150, |x, y| x % 30 < 6 || y < 60 && x > 20),
        Bitmap::new(50, 50),
    ];
    let (mut reader, mut reading) = (Reader::new(), Reading::default());
    for picture in &pictures {
        reader.read(picture, &mut reading);
    }
    let rounds = (0..8).map(|_| {
        let region = Region::new(COUNTING);
        for picture in &pictures {
            reader.read(picture, &mut reading);
        }
        let change = region.change();
        change.allocations + change.reallocations
    });
    assert_eq!(rounds.min(), Some(0), "allocations of the round with the fewest");
}
