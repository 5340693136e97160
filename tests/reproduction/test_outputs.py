"""What notebooks leave in the output folder, when several run at once."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from workbench.reproduction.outputs import Outputs, forget, read_parts


def test_notebooks_that_run_at_once_forget_their_own_parts_only(tmp_path: Path) -> None:
    """What one notebook forgets may vanish while another looks for its own."""
    outputs = Outputs(tmp_path, profile="quick", seed=0)
    items = [f"test:fig{n}" for n in range(161)]
    for item in items:
        outputs.not_made(item, "The data for it are missing.")
    shares = [set(items[start:160:8]) for start in range(8)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(forget, [tmp_path] * 8, [f"notebook {n}" for n in range(8)], shares))
    assert [part["item"] for part in read_parts(tmp_path)] == [items[160]]
