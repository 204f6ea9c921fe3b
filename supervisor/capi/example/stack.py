#!/usr/bin/env python3
"""A bound on the stack of every call of the library, from the machine code of an image: the longest way through the graph of
calls, each function with everything that it ever pushes or reserves. Prints a line for each call and for each function that
calls by a pointer: for those no bound follows from the graph, and the call says so.

Usage: stack.py IMAGE [OBJDUMP]      (by default arm-none-eabi-objdump)
Exit codes: 0 done; 1 no call is in the image, or the graph has a circle; 4 the disassembler is missing: NOT RUN.
"""
import re
import shutil
import subprocess
import sys

HEAD = re.compile(r"^[0-9a-f]+ <(.+)>:$")
TARGET = re.compile(r"<([^>+]+)(\+0x[0-9a-f]+)?>")


def registers(text):
    """How many words a list such as {r4, r5, lr} or {d8-d11} takes."""
    words = 0
    for part in text.strip("{} ").split(","):
        first, _, last = part.strip().partition("-")
        count = int(last[1:]) - int(first[1:]) + 1 if last else 1
        words += count * (2 if first.startswith("d") else 1)
    return words


def pushed(name, operands):
    """Bytes by which this instruction moves the stack pointer down."""
    if name.startswith(("push", "vpush")):
        return 4 * registers(operands)
    if name.startswith(("stmdb", "vstmdb")) and operands.startswith("sp!"):
        return 4 * registers(operands[operands.index("{"):])
    if name.startswith("sub") and operands.startswith("sp,"):
        amount = re.search(r"#(\d+)", operands)
        return int(amount.group(1)) if amount else 0
    moved = re.search(r"\[sp, #-(\d+)\]!", operands)
    return int(moved.group(1)) if moved else 0


def read(listing):
    """Frame, called functions, and whether it calls by a pointer, of every function."""
    frames, calls, pointers, function = {}, {}, set(), None
    for line in listing.splitlines():
        head = HEAD.match(line)
        if head:
            function = head.group(1)
            frames[function], calls[function] = 0, set()
            continue
        parts = line.split("\t")
        if function is None or len(parts) < 2:
            continue
        name, operands = parts[1].strip(), parts[2] if len(parts) > 2 else ""
        frames[function] += pushed(name, operands)
        target = TARGET.search(operands)
        if name.startswith("b") and target and not target.group(2) and target.group(1) != function:
            calls[function].add(target.group(1))
        elif name.startswith("blx") or name.startswith("bx") and not operands.startswith("lr"):
            pointers.add(function)
    return frames, calls, pointers


def main():
    tool = sys.argv[2] if len(sys.argv) > 2 else "arm-none-eabi-objdump"
    if len(sys.argv) < 2 or shutil.which(tool) is None:
        print(f"NOT RUN: the bound on the stack: {tool} is missing" if len(sys.argv) > 1 else __doc__)
        return 4
    listing = subprocess.run([tool, "-d", "--no-show-raw-insn", sys.argv[1]], check=True, capture_output=True, text=True)
    frames, calls, pointers = read(listing.stdout)
    known, open_ = {}, set()

    def deepest(function):
        """Bytes from its call on, and the functions on the way that call by a pointer."""
        if function in open_:
            raise RecursionError(function)
        if function not in known:
            open_.add(function)
            below = [deepest(called) for called in calls.get(function, ()) if called in frames]
            own = {function} if function in pointers else set()
            depth = frames[function] + max((depth for depth, _ in below), default=0)
            known[function] = depth, own.union(*(found for _, found in below))
            open_.remove(function)
        return known[function]

    entries = sorted(name for name in frames if re.fullmatch(r"supervisor_[a-z_0-9]+", name))
    try:
        for entry in entries:
            depth, by_pointer = deepest(entry)
            rest = f", and what is called by a pointer in {', '.join(sorted(by_pointer))}" if by_pointer else ""
            print(f"{entry}: at most {depth}{rest}")
    except RecursionError as circle:
        print(f"a circle of calls through {circle}: no bound")
        return 1
    return 0 if entries else 1


if __name__ == "__main__":
    sys.exit(main())
