"""How Lighthouse judges the pages: `python -m tests.bench.pages LIGHTHOUSE [NAME=ADDRESS ...]`.

LIGHTHOUSE is the program, which is no part of this project: it is six times as large. Install it
somewhere else (`npm install lighthouse@12` in an empty folder) and name its
`node_modules/.bin/lighthouse` here.
Further addresses are measured the same way, for comparison.

Each page of the real server on the simulator is opened several times as a mid-range phone on a slow
4G network would (Lighthouse's mobile defaults), paired, with nothing in its cache. The machine's
load stands beside the figures: a busy machine makes a page look slower than it is.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tests.support.chromium import EXECUTABLE, FLAT
from tests.support.process import serving

ANCHORS = """\
For comparison, first visit, nothing set up   performance  accessibility  best practices
  OctoPrint 1.11                              28           87             71
Aims                                          95           100            100"""

RUNS = 3
PAGES = {"home page": "/", "technician's page": "/technician"}
CATEGORIES = ("performance", "accessibility", "best-practices")
FIGURES = {
    "first-contentful-paint": "first paint",
    "largest-contentful-paint": "largest paint",
    "total-blocking-time": "blocked",
    "cumulative-layout-shift": "shift",
}


@dataclass(frozen=True, slots=True)
class Report:
    """One run: scores from 0 to 100, what they rest on, and what failed."""

    scores: Mapping[str, int]
    figures: Mapping[str, str]
    failed: frozenset[str]


def main() -> None:
    """Measure and print."""
    if len(sys.argv) == 1:
        print("Left out: it needs Lighthouse, named as its first argument; see this file's head.")
        return
    lighthouse, *others = sys.argv[1:]
    with serving() as server:
        for name, path in PAGES.items():
            _measure(lighthouse, name, server.url + path, server.headers)
    for other in others:
        name, address = other.split("=", 1)
        _measure(lighthouse, name, address, {})
    print(f"\n{ANCHORS}")


def _measure(lighthouse: str, name: str, address: str, headers: Mapping[str, str]) -> None:
    reports = []
    for _ in range(RUNS):
        reports.append(_run(lighthouse, address, headers))
        load = os.getloadavg()[0]
        print(f"  {name}: {dict(reports[-1].scores)} {dict(reports[-1].figures)} load {load:.1f}")
    medians = (statistics.median(each.scores[one] for each in reports) for one in CATEGORIES)
    scores = ", ".join(f"{one} {score:.0f}" for one, score in zip(CATEGORIES, medians, strict=True))
    print(f"{name}: {scores} (medians of {RUNS})")
    failed = frozenset[str]().union(*(each.failed for each in reports))
    print(f"  not passed: {', '.join(sorted(failed)) or 'none'}")


def _run(lighthouse: str, address: str, headers: Mapping[str, str]) -> Report:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "report.json"
        command = [
            lighthouse,
            address,
            "--quiet",
            "--output=json",
            f"--output-path={path}",
            f"--only-categories={','.join(CATEGORIES)}",
            f"--chrome-flags=--headless=new {' '.join(FLAT)}",
        ]
        if headers:
            command.append(f"--extra-headers={json.dumps(dict(headers))}")
        environment = {**os.environ, "CHROME_PATH": EXECUTABLE}
        subprocess.run(command, check=True, env=environment)
        return _read(json.loads(path.read_text(encoding="utf-8")))


def _read(content: dict[str, Any]) -> Report:
    categories, audits = content["categories"], content["audits"]
    failed = {
        reference["id"]
        for one in ("accessibility", "best-practices")
        for reference in categories[one]["auditRefs"]
        if audits[reference["id"]]["score"] not in {None, 1} and reference["weight"] > 0
    }
    return Report(
        {one: round(100 * (categories[one]["score"] or 0)) for one in CATEGORIES},
        {words: audits[one].get("displayValue", "?") for one, words in FIGURES.items()},
        frozenset(failed),
    )


if __name__ == "__main__":
    main()
