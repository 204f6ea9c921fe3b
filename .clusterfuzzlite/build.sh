#!/bin/bash -eu
# Called by ClusterFuzzLite: every target with its seeds and its dictionary into $OUT.
cargo fuzz build --release --debug-assertions
for source in fuzz_targets/*.rs; do
  target=$(basename "$source" .rs)
  cp "target/x86_64-unknown-linux-gnu/release/$target" "$OUT/"
  (cd "corpus/$target" && zip -q -r "$OUT/${target}_seed_corpus.zip" .)
  if [ -f "dictionaries/$target" ]; then cp "dictionaries/$target" "$OUT/$target.dict"; fi
done
