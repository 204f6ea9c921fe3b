//! Callgrind's output: one part for each return from the measured function, with its total.

/// Instructions of each measured call, in order.
///
/// Callgrind dumps a part whenever the measured function returns (`--dump-after`), and one at the end of the program;
/// that one belongs to no call.
#[must_use]
pub fn counts(text: &str) -> Vec<u64> {
    let (mut counts, mut dumped) = (Vec::new(), false);
    for line in text.lines() {
        if let Some(trigger) = line.strip_prefix("desc: Trigger: ") {
            dumped = trigger.starts_with("--dump-after");
        } else if let Some(total) = line.strip_prefix("totals: ").filter(|_| dumped) {
            counts.extend(total.split_whitespace().next().and_then(|total| total.parse::<u64>().ok()));
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::counts;

    #[test]
    fn a_total_counts_for_each_return_and_not_for_the_end() {
        let text = "part: 1\ndesc: Trigger: --dump-after=f\nfn=(1) f\n0 2\ntotals: 5\n\
            part: 2\ndesc: Trigger: --dump-after=f\ntotals: 910\n\
            part: 3\ndesc: Trigger: Program termination\ntotals: 7\n";
        assert_eq!(counts(text), [5, 910]);
        assert!(counts("").is_empty());
    }
}
