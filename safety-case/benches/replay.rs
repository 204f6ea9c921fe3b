//! How fast a recorded drive is replayed: from the compressed log to the summary, without page and JSON.
//!
//! `cargo bench -p safety-case`; times hold for the machine that ran it.

#![expect(missing_docs, reason = "criterion_group! declares a public function")]

use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use safety_case::replay::{Report, Request, run};
use supervisor::Sealed;

fn replayed() -> Report {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    let log = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/drives/approach-correct.candump.gz");
    let Ok(report) = run(&Request::of(log, sealed)) else { unreachable!("the drive that ships can be replayed") };
    assert_eq!(report.summary.interventions(), 0, "the correct drive");
    report
}

fn replay(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("replay");
    group.sample_size(10).throughput(Throughput::Elements(replayed().frames));
    group.bench_function("76 s of driving, frames", |bencher| bencher.iter(replayed));
    group.finish();
}

criterion_group!(benches, replay);
criterion_main!(benches);
