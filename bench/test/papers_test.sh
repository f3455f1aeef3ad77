#!/usr/bin/env bash
# Every experiment of the papers runs, small, and writes files that are whole:
# each CSV file in rows of one length, each chart an SVG document.
set -euo pipefail
run_papers=$1
out=$2
rm -rf "$out"
"$run_papers" --out "$out" --trees 1 --size 64 --most-parallel 1000 >/dev/null
python3 - "$out" <<'PYTHON'
import csv, pathlib, sys, xml.dom.minidom

folder = pathlib.Path(sys.argv[1])
rows = {}
for path in folder.glob("*.csv"):
    with open(path, newline="", encoding="ascii") as file:
        rows[path.stem] = list(csv.reader(file))
    assert len({len(row) for row in rows[path.stem]}) == 1, path
counts = {name: len(lines) - 1 for name, lines in rows.items()}
expected = {"f2b-figures-12-to-14": 15, "f2b-figures-15-16": 1,
            "f2b-tree-sizes": 45, "fag83-table-1": 16, "fag83-table-2": 4,
            "heur-figures-4-to-7": 24, "faq-screens": 15, "f2b-depth-sort": 20}
assert counts == expected, counts
charts = sorted(folder.glob("*.svg"))
assert len(charts) == 12, charts
for path in charts:
    assert xml.dom.minidom.parse(str(path)).getElementsByTagName("polyline")
PYTHON
