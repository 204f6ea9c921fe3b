//! `supervise coverage`.

use std::path::Path;

use super::{FINDINGS, Outcome, print, root, telling, write};
use crate::cli::Coverage;
use crate::coverage::{Accepted, Figures, Finding, Record, compare, document, page, run as measure};

pub(super) fn run(arguments: &Coverage) -> Outcome {
    let root = root()?;
    if arguments.check {
        return check(root);
    }
    let measured = telling(|say| measure(root, &arguments.test, arguments.again, say))?;
    let record = Record::of(root, &measured)?;
    if let Some(path) = &arguments.json {
        write(path, &format!("{:#}\n", document(&record, &measured)?))?;
    }
    if let Some(path) = &arguments.html {
        write(path, &page(root, &record, &measured, &Accepted::load(root)?)?)?;
    }
    print(table(&record))?;
    if !arguments.test.is_empty() {
        print("Only a part of the tests ran: no record was written, and what is open here counts for nothing:\n")?;
        for open in &record.open {
            print(format_args!("  {open}\n"))?;
        }
        return Ok(0);
    }
    record.save(root)?;
    judge(&compare(&record.open, &Accepted::load(root)?))
}

/// The record against the present sources and the list.
fn check(root: &Path) -> Outcome {
    let record = Record::load(root)?;
    print(table(&record))?;
    let mut findings = compare(&record.open, &Accepted::load(root)?);
    let (sources, tests) = record.is_current(root)?;
    findings.extend((!sources).then_some(Finding::Stale));
    findings.extend((!tests).then_some(Finding::OtherTests));
    judge(&findings)
}

fn judge(findings: &[Finding]) -> Outcome {
    for finding in findings {
        print(format_args!("{finding}\n"))?;
    }
    Ok(if findings.iter().any(Finding::fails) { FINDINGS } else { 0 })
}

fn table(record: &Record) -> String {
    let row = |name: &str, of: &Figures| {
        format!(
            "{name:<38} {:>10} {:>9} {:>9} {:>9} {:>9}\n",
            of.statements.to_string(),
            of.branches.to_string(),
            of.decisions.to_string(),
            of.conditions.to_string(),
            of.unique.to_string()
        )
    };
    let mut text = format!(
        "{:<38} {:>10} {:>9} {:>9} {:>9} {:>9}\n",
        "", "statements", "branches", "decisions", "MC/DC", "unique"
    );
    text.extend(record.files.iter().map(|(file, figures)| row(file, figures)));
    text.push_str(&row("together", &record.sum));
    let left_out = record.left_out.iter().map(|what| format!("not instrumented: {what}\n"));
    text + &left_out.collect::<String>() + &format!("{} open\n", record.open.len())
}
