//! A curve of any length in bounded memory, that still looks the same.
//!
//! Each bucket keeps its first, least, greatest and last value, each with its time: drawn as lines, this gives the
//! same picture as all values would, as long as a bucket is no wider than a pixel. When the buckets are used up,
//! pairs of them are merged. A short log keeps every value.

use crate::number::seconds;

/// How many buckets there are at most.
pub const BUCKETS: usize = 8192;

/// A value and when it was.
type Point = (u64, f64);

#[derive(Clone, Copy, Debug)]
struct Bucket {
    first: Point,
    least: Point,
    greatest: Point,
    last: Point,
    /// The value was missing somewhere in it.
    gap: bool,
}

impl Bucket {
    fn of(point: Point) -> Self {
        Self { first: point, least: point, greatest: point, last: point, gap: false }
    }
    fn merge(self, later: Self) -> Self {
        Self {
            first: self.first,
            least: if later.least.1 < self.least.1 { later.least } else { self.least },
            greatest: if later.greatest.1 > self.greatest.1 { later.greatest } else { self.greatest },
            last: later.last,
            gap: self.gap || later.gap,
        }
    }
}

/// A curve.
#[derive(Clone, Debug)]
pub struct Trend {
    /// `None` is a bucket without any value.
    buckets: Vec<Option<Bucket>>,
    /// How many cycles a bucket holds.
    width: u64,
    /// How many the last one holds.
    filled: u64,
}

impl Default for Trend {
    fn default() -> Self {
        Self { buckets: Vec::new(), width: 1, filled: 1 }
    }
}

/// Points to draw: times in seconds, values or gaps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Times.
    pub x: Vec<f64>,
    /// Values; `None` breaks the line.
    pub y: Vec<Option<f64>>,
}

impl Trend {
    /// Takes the value of the next cycle.
    pub fn push(&mut self, at: u64, value: Option<f64>) {
        if self.filled == self.width {
            if self.buckets.len() == BUCKETS {
                self.halve();
            } else {
                self.buckets.push(None);
                self.filled = 0;
            }
        }
        if self.filled == self.width {
            self.buckets.push(None);
            self.filled = 0;
        }
        self.filled += 1;
        let Some(bucket) = self.buckets.last_mut() else { return };
        match (bucket, value) {
            (Some(bucket), None) => bucket.gap = true,
            (None, None) => {}
            (slot, Some(value)) => {
                let new = Bucket::of((at, value));
                // What was missing before the first value of a bucket is a gap as well.
                let missed = slot.is_none() && self.filled > 1;
                *slot = Some(slot.map_or(Bucket { gap: missed, ..new }, |old| old.merge(new)));
            }
        }
    }

    fn halve(&mut self) {
        let pairs = self.buckets.chunks(2).map(|pair| match *pair {
            [Some(first), Some(second)] => Some(first.merge(second)),
            [Some(one), None] | [None, Some(one)] => Some(Bucket { gap: true, ..one }),
            [one] => one,
            _ => None,
        });
        self.buckets = pairs.collect();
        self.width *= 2;
        // The number of buckets is even, so the last pair is full.
        self.filled = self.width;
    }

    /// Whether it ever had a value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.buckets.iter().all(Option::is_none)
    }

    /// The greatest value.
    #[must_use]
    pub fn greatest(&self) -> Option<f64> {
        self.buckets.iter().flatten().map(|bucket| bucket.greatest.1).reduce(f64::max)
    }

    /// What to draw. `decimals` rounds; points inside a stretch of one value are left out.
    #[must_use]
    pub fn curve(&self, decimals: i32) -> Curve {
        let scale = 10_f64.powi(decimals);
        let mut curve = Curve::default();
        let mut points: Vec<Point> = Vec::with_capacity(4);
        for bucket in &self.buckets {
            let Some(bucket) = bucket else {
                curve.add(None);
                continue;
            };
            points.clear();
            points.extend([bucket.first, bucket.least, bucket.greatest, bucket.last]);
            points.sort_by_key(|(at, _)| *at);
            points.dedup_by_key(|(at, _)| *at);
            for (at, value) in &points {
                curve.add(Some((seconds(*at), (value * scale).round() / scale)));
            }
            if bucket.gap {
                curve.add(None);
            }
        }
        curve
    }
}

impl Curve {
    fn add(&mut self, point: Option<(f64, f64)>) {
        let Some((x, y)) = point else {
            // One gap is enough, and none is needed at the beginning.
            if let (Some(x), Some(Some(_))) = (self.x.last().copied(), self.y.last()) {
                self.x.push(x);
                self.y.push(None);
            }
            return;
        };
        if let [.., before, last] = self.y.as_slice()
            && *before == Some(y)
            && *last == Some(y)
        {
            self.x.pop();
            self.y.pop();
        }
        self.x.push(x);
        self.y.push(Some(y));
    }
}

#[cfg(test)]
mod tests {
    use super::{BUCKETS, Trend};

    fn trend(values: impl IntoIterator<Item = Option<f64>>) -> Trend {
        let mut trend = Trend::default();
        for (at, value) in (0..).step_by(10_000).zip(values) {
            trend.push(at, value);
        }
        trend
    }

    #[test]
    fn a_short_log_keeps_every_value() {
        let curve = trend((0..1000).map(|value| Some(f64::from(value)))).curve(3);
        assert_eq!(curve.x.len(), 1000);
        assert!(curve.x.first() == Some(&0.0) && curve.x.last() == Some(&9.99));
        assert!(curve.y.last() == Some(&Some(999.0)));
    }

    #[test]
    fn a_long_log_keeps_every_peak_and_the_ends_in_bounded_memory() {
        let value = |index: u32| match index {
            123_457 => 99.0,
            777_777 => -99.0,
            index => f64::from(index % 7),
        };
        let trend = trend((0..1_000_000).map(|index| Some(value(index))));
        assert!(trend.buckets.len() <= BUCKETS);
        let curve = trend.curve(3);
        assert!(curve.x.len() <= 4 * BUCKETS);
        let at = |wanted: f64| curve.y.iter().position(|y| *y == Some(wanted)).and_then(|index| curve.x.get(index));
        assert_eq!(at(99.0), Some(&1234.57));
        assert_eq!(at(-99.0), Some(&7777.77));
        assert_eq!((curve.x.first(), curve.x.last()), (Some(&0.0), Some(&9999.99)));
        assert!(curve.x.is_sorted());
    }

    #[test]
    fn gaps_break_the_line_at_any_width() {
        let values = [None, Some(1.0), Some(2.0), None, None, Some(3.0), None];
        let curve = trend(values).curve(3);
        assert_eq!(curve.y, [Some(1.0), Some(2.0), None, Some(3.0), None]);
        let long = trend((0..40_000).map(|index| (index != 20_001).then_some(f64::from(index)))).curve(3);
        assert!(long.y.contains(&None));
        assert!(trend([None, None]).is_empty());
    }

    #[test]
    fn a_constant_needs_two_points() {
        assert_eq!(trend((0..100_000).map(|_| Some(5.0))).curve(3).x, [0.0, 999.99]);
    }
}
