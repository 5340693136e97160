"""Print the table of benchmarks as Markdown: ``python -m tests.benchmarks [NAME …]``.

Each module ``bench_NAME`` has a function ``measurements()`` that yields
:class:`~tests.benchmarks.measuring.Measurement` objects.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module
from pathlib import Path

# Waiting threads must not take the core away from those that work.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

HEADER = (
    "| what | target | ours | baseline | its time | ratio | peak memory | met |\n"
    "|---|---|---|---|---|---|---|---|"
)


def main() -> None:
    """Run the named benchmarks, or all."""
    found = sorted(path.stem for path in Path(__file__).parent.glob("bench_*.py"))
    wanted = [f"bench_{name}" for name in sys.argv[1:]] or found
    unknown = sorted(set(wanted) - set(found))
    if unknown:
        sys.exit(f"benchmarks: got {', '.join(unknown)}, want some of {', '.join(found)}")
    print(HEADER, flush=True)
    notes = []
    for name in wanted:
        for row in import_module(f"tests.benchmarks.{name}").measurements():
            ratio = f"{row.baseline_seconds / row.seconds:.1f}" if row.baseline_seconds else ""
            other = _time(row.baseline_seconds) if row.baseline_seconds else ""
            print(
                f"| {row.subject} | {row.target} | {_time(row.seconds)} | {row.baseline} "
                f"| {other} | {ratio} | {row.peak_mb:.0f} MB | {'yes' if row.met else 'no'} |",
                flush=True,
            )
            if row.note:
                notes.append(f"- {row.subject}: {row.note}")
    if notes:
        print("\n" + "\n".join(notes))


def _time(seconds: float) -> str:
    return f"{seconds:.2f} s" if seconds >= 1 else f"{1000 * seconds:.1f} ms"


if __name__ == "__main__":
    main()
