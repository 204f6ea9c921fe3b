#!/usr/bin/env python3
"""The figures of the target as a record for the evidence, from what `run` and `figures` have left.

Usage: record.py FOLDER DIGEST      (DIGEST: of the shipped sources, from `supervise evidence --digest`)
Exit codes: 0 done; 1 a figure is missing.
"""
import json
import pathlib
import re
import sys

BARS = {
    "code_and_constants": (24_576, "bytes of code and constants, at their smallest"),
    "stack_of_step": (2_048, "bytes of stack that a step takes"),
    "state": (4_096, "bytes of state, with the link"),
}


def only(pattern, text, what):
    found = re.search(pattern, text, re.MULTILINE)
    if found is None:
        sys.exit(f"record.py: {what} is missing")
    return [int(number) for number in found.groups()]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, digest = pathlib.Path(sys.argv[1]), sys.argv[2]
    c, rust, table = ((folder / name).read_text() for name in ("qemu.txt", "qemu-rust.txt", "figures.md"))
    figures = {"target": "Cortex-M4F (thumbv7em-none-eabihf) in QEMU"}
    for name, text in (("c", c), ("rust", rust)):
        same, of = only(r"^decisions identical: (\d+) of (\d+)$", text, f"the decisions of {name}")
        figures[f"decisions_{name}"], figures[f"identical_{name}"] = of, same
    code, constants = only(r"^\| init, receive, step, watchdog \| z \| yes \| (\d+) \| (\d+)", table, "the code")
    figures["code_and_constants"] = code + constants
    for name in ("init", "receive", "step"):
        (figures[f"stack_of_{name}"],) = only(rf"^stack of {name}: (\d+)$", c, f"the stack of {name}")
    (figures["instructions_of_the_worst_step"],) = only(r"^instructions of the worst step: (\d+)$", c, "the worst step")
    (figures["state"],) = only(r"^\| `SupervisorState`, bytes \| (\d+)", table, "the state")
    open_items = [
        f"{figures[name]} {what}, above the bar of {bar}" for name, (bar, what) in BARS.items() if figures[name] > bar
    ]
    for name in ("c", "rust"):
        missing = figures[f"decisions_{name}"] - figures[f"identical_{name}"]
        if missing:
            open_items.append(f"{missing} decisions differ from the host's, firmware in {name}")
    record = {"schema": "supervise-target", "version": 1, "sources": digest, "figures": figures, "open": open_items}
    json.dump(record, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
