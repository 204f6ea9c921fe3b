//! Object lists: complete, or not used.

use supervisor_core::{Count, Millis, Signal};
use supervisor_perceive::{CameraObject, PixelBox, RadarObject};

use crate::qualifier::elapsed;

/// An object that comes in parts.
pub trait Object: Copy + PartialEq {
    /// No object.
    const NONE: Self;
    /// How many parts.
    const PARTS: u8;
    /// Takes over one part.
    fn merge(&mut self, part: u8, from: &Self);
}

impl Object for RadarObject {
    const NONE: Self = Self::NONE;
    const PARTS: u8 = 2;
    fn merge(&mut self, part: u8, from: &Self) {
        *self = match part {
            0 => Self { distance: from.distance, offset: from.offset, ..*self },
            _ => Self { distance: self.distance, offset: self.offset, ..*from },
        };
    }
}

impl Object for CameraObject {
    const NONE: Self = Self::NONE;
    const PARTS: u8 = 3;
    fn merge(&mut self, part: u8, from: &Self) {
        let (new, old) = (from.pixels, self.pixels);
        *self = match part {
            0 => Self { distance: from.distance, closing: from.closing, class: from.class, ..*self },
            1 => Self { age: from.age, pixels: PixelBox { left: new.left, top: new.top, ..old }, ..*self },
            _ => Self { pixels: PixelBox { width: new.width, height: new.height, ..old }, ..*self },
        };
    }
}

/// What one frame of a list carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Entry<T> {
    /// Counts the lists.
    pub cycle: Count,
    /// Which object.
    pub index: Count,
    /// Of how many; unknown if the sensor is out of order.
    pub length: Signal<Count>,
    /// The object.
    pub object: T,
}

impl<T: Object> Entry<T> {
    /// Nothing.
    pub const NONE: Self = Self { cycle: Count::ZERO, index: Count::ZERO, length: Signal::NEVER, object: T::NONE };

    /// Whether the list is not longer than `longest`, the index lies in it, and an empty list has no object.
    #[must_use]
    pub fn fits(&self, longest: usize) -> bool {
        let length = self.length.known().unwrap_or(Count::ZERO);
        let empty = length == Count::ZERO && self.index == Count::ZERO && self.object == T::NONE;
        usize::from(length.raw()) <= longest && (self.index < length || empty)
    }
}

/// A list in the making, and since when the last whole one is in use.
#[derive(Clone, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct List<T, const N: usize> {
    /// A list older than this is not used.
    timeout: Millis,
    cycle: Count,
    length: Signal<Count>,
    /// When its first frame came; `None` before it, and once the list is complete.
    began: Option<Millis>,
    /// Objects so far; per object the parts that are there, one bit each.
    objects: [(T, u8); N],
    /// When the list in use was begun.
    current: Option<Millis>,
    /// Up to when the ages of the list in use count.
    aged: Millis,
}

impl<T: Object, const N: usize> List<T, N> {
    /// No list yet.
    #[must_use]
    pub const fn new(timeout: Millis) -> Self {
        let Entry { cycle, length, object, .. } = Entry::NONE;
        let objects = [(object, 0); N];
        Self { timeout, cycle, length, began: None, objects, current: None, aged: Millis::ZERO }
    }

    /// Adds a part; the objects, once every part of every object of one list is there. Parts may come in any order.
    ///
    /// A frame of another cycle or length begins a new list, and so does one so late that the cycle may have come
    /// round: what was there is forgotten.
    pub fn add(&mut self, now: Millis, part: u8, entry: &Entry<T>) -> Option<impl Iterator<Item = T>> {
        let same = self.cycle == entry.cycle && self.length == entry.length;
        let began = self.began.filter(|began| same && elapsed(now, *began) <= self.timeout);
        if began.is_none() {
            (self.cycle, self.length, self.objects) = (entry.cycle, entry.length, [(T::NONE, 0); N]);
        }
        let began = began.unwrap_or(now);
        self.began = Some(began);
        if let Some((object, parts)) = self.objects.get_mut(usize::from(entry.index.raw())) {
            object.merge(part, &entry.object);
            *parts |= 1_u8.wrapping_shl(u32::from(part));
        }
        let whole = |(_, parts): &(T, u8)| parts.count_ones() == u32::from(T::PARTS);
        self.current = self.current.filter(|_| self.length.known().is_some());
        let objects = self.objects.get(..usize::from(self.length.known()?.raw()))?;
        if !objects.iter().all(whole) {
            return None;
        }
        (self.began, self.current, self.aged) = (None, Some(began), began);
        Some(objects.iter().map(|(object, _)| *object))
    }
    /// Lets the objects in use grow older; whether the list is whole and not older than the time-out.
    pub fn known<'a>(&mut self, now: Millis, ages: impl Iterator<Item = &'a mut Millis>) -> bool {
        let older = elapsed(now, self.aged);
        ages.for_each(|age| *age = Millis::new(age.raw().saturating_add(older.raw())));
        self.aged = now;
        self.current = self.current.filter(|began| elapsed(now, *began) <= self.timeout);
        self.current.is_some()
    }
}
