//! The two comparisons at the ends of their ranges: RSP-1 reports or stays silent, and never overflows.

use supervisor_observe::{Follow, SteeredAngle};
use supervisor_terms::{AngleDeciDeg, Millis};

const CYCLE: Millis = Millis::new(10);
const INNER: Millis = Millis::new(700);
const OUTER: Millis = Millis::new(1_000);

/// How many cycles until it fails, of at most 200.
fn cycles(target: u16, measured: Option<u16>, error: u8) -> Option<usize> {
    let mut follow = Follow::INITIAL;
    (0..200).find(|_| {
        follow = follow.advance(target, measured, error, CYCLE);
        follow.fails(INNER, OUTER)
    })
}

/// RSP-1g: the greatest target; 95 % of it and one bit less; no target, nothing measured, an error of 255 %.
#[test]
fn follow_at_the_ends() {
    assert_eq!(cycles(u16::MAX, Some(0), 15), Some(100));
    assert_eq!(cycles(u16::MAX, Some(62_258), 15), Some(100));
    assert_eq!(cycles(u16::MAX, Some(62_259), 15), None);
    assert_eq!(cycles(u16::MAX, Some(u16::MAX), 255), None);
    assert_eq!(cycles(1, Some(0), 255), Some(100), "the error counts once it follows");
    assert_eq!(cycles(0, Some(0), 15), None);
    assert_eq!(cycles(u16::MAX, None, 15), None);
}

/// RSP-1g: times saturate: a shortfall that lasts for ever stays one.
#[test]
fn follow_for_ever() {
    let mut follow = Follow::INITIAL;
    for _ in 0..10 {
        follow = follow.advance(100, Some(0), 15, Millis::new(u32::MAX));
    }
    assert!(follow.fails(INNER, OUTER));
    assert!(!follow.advance(100, Some(95), 15, CYCLE).fails(INNER, OUTER), "until it follows");
}

/// RSP-1e, RSP-1f: from one end of the range to the other, either way.
#[test]
fn steered_at_the_ends() {
    for (target, measured) in [(i16::MAX, i16::MIN), (i16::MIN, i16::MAX)] {
        let mut angle = SteeredAngle::INITIAL;
        let found = (0..200).find(|_| {
            angle = angle.advance(AngleDeciDeg::new(target), Some(AngleDeciDeg::new(measured)), 20, CYCLE);
            angle.fails(Millis::new(100), Millis::new(500))
        });
        assert_eq!(found, Some(10), "{target} {measured}");
        let here = angle.advance(AngleDeciDeg::new(target), Some(AngleDeciDeg::new(target)), 20, CYCLE);
        assert_eq!(here, SteeredAngle::INITIAL);
        let none = angle.advance(AngleDeciDeg::new(target), None, 20, CYCLE);
        assert_eq!(none, angle, "nothing measured: as it was");
    }
}
