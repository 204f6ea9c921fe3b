//! Which harnesses run, and in which order.

use super::harness::{Harness, List};
use super::record::Record;
use super::sources::sha256;
use crate::error::ToolError;

/// What a harness is taken to need that never ran, in seconds.
const UNKNOWN: u64 = 120;
/// A quick run draws one in so many of the harnesses that are not key.
const DRAWN: usize = 10;
/// What a quick run may take on one core, by the recorded times, in seconds.
const QUICK: u64 = 420;

/// The recorded time of a harness, in seconds.
#[must_use]
pub fn seconds(harness: &Harness, record: &Record) -> u64 {
    record.of(&harness.name).map_or(UNKNOWN, |proof| proof.seconds)
}

/// Those of these names, or all.
///
/// # Errors
/// A name is not in the list.
pub fn named<'a>(list: &'a List, names: &[String]) -> Result<Vec<&'a Harness>, ToolError> {
    if let Some(name) = names.iter().find(|name| list.of(name).is_none()) {
        return Err(ToolError::Unknown(name.clone()));
    }
    Ok(list.harness.iter().filter(|harness| names.is_empty() || names.contains(&harness.name)).collect())
}

/// Longest first, before them what never ran: so the cores end together.
#[must_use]
pub fn ordered<'a>(mut chosen: Vec<&'a Harness>, record: &Record) -> Vec<&'a Harness> {
    chosen.sort_by_key(|harness| {
        let known = record.of(&harness.name);
        (known.is_some(), std::cmp::Reverse(known.map_or(0, |proof| proof.seconds)), harness.name.clone())
    });
    chosen
}

/// Part `shard` (from 1) of `shards`: each gets about the same time, and each harness stands in exactly one.
#[must_use]
pub fn shard<'a>(chosen: &[&'a Harness], record: &Record, (shard, shards): (usize, usize)) -> Vec<&'a Harness> {
    let mut loads = vec![(0_u64, Vec::new()); shards];
    let mut heaviest: Vec<&Harness> = chosen.to_vec();
    heaviest.sort_by_key(|harness| (std::cmp::Reverse(seconds(harness, record)), harness.name.clone()));
    for harness in heaviest {
        if let Some((load, part)) = loads.iter_mut().min_by_key(|(load, _)| *load) {
            *load = load.saturating_add(seconds(harness, record));
            part.push(harness);
        }
    }
    loads.into_iter().nth(shard.saturating_sub(1)).map(|(_, part)| part).unwrap_or_default()
}

/// What a quick run takes.
#[derive(Debug, Default)]
pub struct Quick<'a> {
    /// The key harnesses.
    pub key: Vec<&'a Harness>,
    /// Those drawn of the rest.
    pub drawn: Vec<&'a Harness>,
    /// Those that were drawn, and left out because they take too long.
    pub left_out: Vec<&'a Harness>,
}

/// The key harnesses and a tenth of the rest. The seed decides which: the same for the same sources, another when they
/// change, so that in time each has its turn.
#[must_use]
pub fn quick<'a>(list: &'a List, record: &Record, seed: &str, jobs: usize) -> Quick<'a> {
    let (key, mut rest): (Vec<&Harness>, Vec<&Harness>) = list.harness.iter().partition(|harness| harness.key);
    rest.sort_by_key(|harness| sha256(format!("{seed} {}", harness.name).as_bytes()));
    let mut left = QUICK.saturating_mul(u64::try_from(jobs).unwrap_or(1));
    for harness in &key {
        left = left.saturating_sub(seconds(harness, record));
    }
    let mut quick = Quick { key, ..Quick::default() };
    for harness in rest.iter().take(rest.len().div_ceil(DRAWN)) {
        match left.checked_sub(seconds(harness, record)) {
            Some(less) => {
                left = less;
                quick.drawn.push(harness);
            }
            None => quick.left_out.push(harness),
        }
    }
    quick
}

#[cfg(test)]
mod tests {
    use super::super::record::tests::{list, proof};
    use super::*;

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    fn recorded(list: &List, seconds: &[(&str, u64)]) -> Record {
        let mut record = Record::default();
        for (name, seconds) in seconds {
            record.put(proof(name, *seconds), list);
        }
        record
    }

    fn names<'a>(chosen: &[&'a Harness]) -> Vec<&'a str> {
        chosen.iter().map(|harness| harness.name.as_str()).collect()
    }

    #[test]
    fn what_never_ran_comes_first_then_the_longest() -> Outcome {
        let list = list(&["a", "b", "c", "d"])?;
        let record = recorded(&list, &[("a", 5), ("b", 50), ("d", 7)]);
        assert_eq!(names(&ordered(named(&list, &[])?, &record)), ["c", "b", "d", "a"]);
        assert_eq!(names(&named(&list, &["b".to_owned()])?), ["b"]);
        assert!(matches!(named(&list, &["x".to_owned()]), Err(ToolError::Unknown(_))));
        Ok(())
    }

    #[test]
    fn shards_are_a_partition_and_balanced() -> Outcome {
        let all: Vec<String> = (0..23).map(|number| format!("h{number}")).collect();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        let list = list(&all)?;
        let times: Vec<(&str, u64)> = all.iter().copied().zip((1..).map(|number| number * 7 % 100)).skip(1).collect();
        let record = recorded(&list, &times);
        for shards in 1..6 {
            let chosen = named(&list, &[])?;
            let parts: Vec<Vec<&Harness>> =
                (1..=shards).map(|number| shard(&chosen, &record, (number, shards))).collect();
            let mut joined: Vec<&str> = parts.iter().flat_map(|part| names(part)).collect();
            joined.sort_unstable();
            let mut expected = all.clone();
            expected.sort_unstable();
            assert_eq!(joined, expected);
            let loads = parts.iter().map(|part| part.iter().map(|harness| seconds(harness, &record)).sum::<u64>());
            let (least, most) = (loads.clone().min().unwrap_or(0), loads.max().unwrap_or(0));
            assert!(most - least <= UNKNOWN, "{least} {most}");
        }
        assert!(shard(&named(&list, &[])?, &record, (7, 3)).is_empty());
        Ok(())
    }

    #[test]
    fn a_quick_run_takes_the_key_ones_and_a_tenth_by_the_seed() -> Outcome {
        let all: Vec<String> = (0..41).map(|number| format!("h{number}")).collect();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        let mut list = list(&all)?;
        list.harness.iter_mut().take(1).for_each(|harness| harness.key = true);
        let record = recorded(&list, &all.iter().map(|name| (*name, 10)).collect::<Vec<_>>());
        let one = quick(&list, &record, "one", 2);
        assert_eq!(names(&one.key), ["h0"]);
        assert_eq!(one.drawn.len(), 4);
        assert!(one.left_out.is_empty() && !names(&one.drawn).contains(&"h0"));
        assert_eq!(names(&one.drawn), names(&quick(&list, &record, "one", 2).drawn));
        assert_ne!(names(&one.drawn), names(&quick(&list, &record, "two", 2).drawn));

        let slow = recorded(&list, &all.iter().map(|name| (*name, 200)).collect::<Vec<_>>());
        let bounded = quick(&list, &slow, "one", 1);
        assert_eq!((bounded.key.len(), bounded.drawn.len(), bounded.left_out.len()), (1, 1, 3));
        Ok(())
    }
}
