"""Refuse notebooks that carry outputs, execution counts or machine-specific metadata."""

from __future__ import annotations

import json
import sys
from pathlib import Path


def problems(path: Path) -> list[str]:
    """List what is wrong with a notebook file."""
    try:
        notebook = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        return [f"{path}: not valid JSON ({error})"]
    found = []
    for number, cell in enumerate(notebook.get("cells", []), start=1):
        if cell.get("outputs"):
            found.append(f"{path}, cell {number}: has outputs")
        if cell.get("execution_count") is not None:
            found.append(f"{path}, cell {number}: has an execution count")
    if "papermill" in notebook.get("metadata", {}):
        found.append(f"{path}: has papermill's record of a run")
    return found


def main(folder: str) -> int:
    """Check all notebooks below a folder; return the exit status."""
    notebooks = sorted(Path(folder).rglob("*.ipynb"))
    found = [line for path in notebooks for line in problems(path)]
    for line in found:
        print(line, file=sys.stderr)
    if not notebooks:
        print(f"{folder}: no notebooks", file=sys.stderr)
    return 1 if found or not notebooks else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
