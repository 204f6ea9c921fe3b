//! FUS-3: which radar object and which camera object are the same thing.
//!
//! Two boxes match when their intersection is more than a configured share of their union (S1 §3.1.1), decided
//! exactly, by cross-multiplication. Each camera object takes the radar object that it fits best; a radar object that
//! several take goes to the one that fits best. So matches are one to one and depend on no order of the lists, and two
//! reflections of one thing are not both confirmed by one box. What loses its partner stays unmatched: a match creates
//! evidence, so it is given sparingly.
//!
//! # What a match means, and why that is safe both ways
//! - *Matched*: two sensors of different kinds see one thing. It counts at once, with the radar's distance and closing
//!   speed, which are measured; the camera's are estimated from pixels and only ever *permit* (rule 1).
//! - *Radar alone* obliges only once its tracker has counted the configured updates: a ghost of one update brakes
//!   nobody (phantom braking), and a thing that the camera misses waits two updates more, no longer (missed braking).
//! - *Camera alone* obliges nothing and permits: the picture of a car on a poster brakes nobody, and the main controller
//!   may still brake for what only the camera sees.
//! - *The distances disagree*: still matched. The box is made at the radar's depth, so at 30 % the depth of a thing of
//!   the assumed size is right within a factor of 1.8. A bound on the camera's distance would undo matches just when
//!   its estimate is worst: one degree of pitch makes 50 m into 33 m or 100 m, as the bus begins to brake.
//!
//! `updates` is what the radar's own tracker counts. Perception keeps no memory on purpose: no bit can flip in it, and
//! nothing about it has to be assumed from one cycle to the next.

use heapless::Vec;
use supervisor_core::{Config, Percent, kernel};

use crate::picture::{Lens, Outline, Span};
use crate::scene::{CameraObject, Class, MAX_CAMERA, MAX_RADAR, RadarObject};
use crate::time::{moved, whole};

/// A box and its area, in steps of a pixel: edges of 16 bits, so areas of 32.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Boxed {
    outline: Outline,
    area: u32,
}

/// Intersection of two boxes, and the sum of their areas.
///
/// The sum is intersection and union together, so that the greater share of the sum is the greater share of the union:
/// s/(S − s) rises with s/S. It saves a subtraction in each of 512 pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlap {
    /// Area of the intersection.
    pub shared: u32,
    /// Both areas. An image of up to 4096 px on each side has 2³⁰ square steps: nothing saturates.
    pub sum: u32,
}

fn common(first: Span, second: Span) -> u16 {
    first.most.min(second.most).saturating_sub(first.least.max(second.least))
}

fn area(width: u16, height: u16) -> u32 {
    u32::from(width).saturating_mul(u32::from(height))
}

impl Boxed {
    /// Measures a box.
    #[must_use]
    pub fn of(outline: Outline) -> Self {
        let [width, height] = outline.map(|span| span.most.saturating_sub(span.least));
        Self { outline, area: area(width, height) }
    }

    /// How they overlap; `None` if they share nothing.
    #[must_use]
    pub fn overlap(&self, other: &Self) -> Option<Overlap> {
        let ([columns, rows], [other_columns, other_rows]) = (self.outline, other.outline);
        // Most pairs stand apart.
        let width = common(columns, other_columns);
        if width == 0 {
            return None;
        }
        let height = common(rows, other_rows);
        if height == 0 {
            return None;
        }
        let shared = area(width, height);
        Some(Overlap { shared, sum: self.area.saturating_add(other.area) })
    }
}

impl Overlap {
    /// The share that a match must exceed: p of 100 of the union are p of 100 + p of the sum.
    #[must_use]
    pub fn threshold(share: Percent) -> Self {
        Self { shared: share.raw().into(), sum: u32::from(share.raw()).saturating_add(100) }
    }

    /// Both shares, on one denominator: 32 by 32 bits each, exact.
    fn shares(self, other: Self) -> (u64, u64) {
        kernel::crossed(self.shared, self.sum, other.shared, other.sum)
    }

    /// FUS-3a: intersection over union is greater than the other's.
    #[must_use]
    pub fn exceeds(self, other: Self) -> bool {
        let (mine, theirs) = self.shares(other);
        mine > theirs
    }
}

/// The best radar object so far; none as long as `place` lies outside the list.
#[derive(Clone, Copy)]
struct Best {
    overlap: Overlap,
    values: u64,
    place: usize,
}

impl Best {
    /// The greater overlap wins, between equal ones the values decide: never the places. Equal values are the same
    /// object twice. An overlap of exactly the threshold is not taken: no values are less than 0.
    fn consider(&mut self, overlap: Overlap, values: u64, place: usize) {
        let (new, old) = overlap.shares(self.overlap);
        if new > old || (new == old && values < self.values) {
            *self = Self { overlap, values, place };
        }
    }
}

/// Everything about a radar object that decides anything, in one word, to be compared at once.
fn values(object: &RadarObject, config: &Config) -> u64 {
    let RadarObject { distance, offset, closing, age, updates } = *object;
    let consistent = u64::from(updates >= config.consistent_updates);
    let bits = |raw: i16| u64::from(raw.cast_unsigned());
    // An age has 15 bits, and one is left over.
    (u64::from(distance.raw()) << 48)
        | (bits(offset.raw()) << 32)
        | (bits(closing.raw()) << 16)
        | (u64::from(whole(age).unsigned_abs()) << 1)
        | consistent
}

/// A camera object, ready to be compared.
struct Seen {
    boxed: Boxed,
    best: Best,
}

/// FUS-3a, FUS-3b: the class that the camera gives to each radar object, in the order of the radar's list; `None` if unmatched.
///
/// FUS-1: the common time is that of the image, the age of the newest camera object. (The objects of one image have
/// one age; should a list mix images, its older boxes are compared a little late, which may cost a match.) An object
/// that is older than `object_age` matches nothing.
#[must_use]
pub fn matches(radar: &[RadarObject], camera: &[CameraObject], config: &Config) -> [Option<Class>; MAX_RADAR] {
    let lens = Lens::of(config);
    let nothing = Best { overlap: Overlap::threshold(config.match_iou), values: 0, place: MAX_RADAR };
    let mut image = config.object_age;
    // Things first, then pedestrians: each radar object is cast once in the size of either.
    let mut seen: Vec<Seen, MAX_CAMERA> = Vec::new();
    let mut things = 0;
    for pedestrians in [false, true] {
        for &CameraObject { pixels, class, age, .. } in camera {
            if age <= config.object_age && (class == Class::Pedestrian) == pedestrians {
                image = image.min(age);
                // The list is no longer than the camera's.
                seen.push(Seen { boxed: Boxed::of(lens.seen(pixels)), best: nothing }).unwrap_or(());
            }
        }
        things = if pedestrians { things } else { seen.len() };
    }
    let mut classes = [None; MAX_RADAR];
    let Some((things, pedestrians)) = seen.split_at_mut_checked(things) else { return classes };

    let sizes = [config.object_size, config.pedestrian_size].map(|size| lens.size(size));
    for (place, object) in radar.iter().enumerate() {
        let RadarObject { distance, offset, closing, age, .. } = *object;
        let foot = lens.foot(moved(distance, closing, age, image), offset);
        let Some(foot) = foot.filter(|_| age <= config.object_age) else { continue };
        let values = values(object, config);
        for (size, seen) in sizes.iter().zip([&mut *things, &mut *pedestrians]) {
            if !seen.is_empty() {
                // What the camera would see, if the object were what the camera says.
                let cast = Boxed::of(lens.outline(foot, *size));
                for Seen { boxed, best } in seen {
                    if let Some(overlap) = cast.overlap(boxed) {
                        best.consider(overlap, values, place);
                    }
                }
            }
        }
    }

    // Pedestrians first, so that between equally good ones the pedestrian counts: no order of a list decides.
    let mut held = [nothing.overlap; MAX_RADAR];
    for (class, seen) in [(Class::Pedestrian, pedestrians), (Class::Object, things)] {
        for Seen { best, .. } in seen {
            if let (Some(matched), Some(held)) = (classes.get_mut(best.place), held.get_mut(best.place))
                && best.overlap.exceeds(*held)
            {
                (*held, *matched) = (best.overlap, Some(class));
            }
        }
    }
    classes
}
