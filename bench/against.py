#!/usr/bin/env python3
"""Compares two builds of espalier_bench row by row, in turns: how many times as fast is this one as the other?

usage: bench/against.py THIS OTHER [--rounds N] [--seconds S] [--row TEXT ...]

Of each row's work the fastest of all rounds counts. Rows that one of the two lacks are named at the end."""
import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def titles(program, words):
    """The rows of a program, by its own --list: titles with their goals, and indented lines."""
    chosen = [option for word in words for option in ("--row", word)]
    text = subprocess.run([program, "--list", *chosen], check=True, capture_output=True, text=True).stdout
    return [found[1] for line in text.splitlines() if (found := re.match(r"(\S.*?)\s+[<>]= \S+$", line))]


def seconds_of_work(program, title, seconds):
    """Of one run of a row's work; per item where the benchmark counts items. None: it does not measure that."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bench.json"
        run = subprocess.run([program, "--row", title, "--seconds", str(seconds), "--json", file],
                             capture_output=True, text=True)
        if run.returncode > 1:
            sys.exit(f"{program}: {run.stderr}")
        rows = [row for row in json.loads(file.read_text())["rows"] if row["goal"] == title]
    if not rows or "seconds" not in rows[0]["work"]:
        return None
    work = rows[0]["work"]
    return 1 / work["items_per_second"] if work.get("items_per_second") else work["seconds"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("this")
    parser.add_argument("other")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=2)
    parser.add_argument("--row", action="append", default=[])
    asked = parser.parse_args()
    ours, theirs = titles(asked.this, asked.row), titles(asked.other, asked.row)
    print(f"{'row':<90}{'times as fast':>14}")
    for title in [title for title in ours if title in theirs]:
        best = [float("inf")] * 2
        for _ in range(asked.rounds):
            for i, program in enumerate((asked.this, asked.other)):
                best[i] = min(best[i], seconds_of_work(program, title, asked.seconds) or float("inf"))
        if best[0] < float("inf"):
            print(f"{title[:88]:<90}{best[1] / best[0]:>14.2f}", flush=True)
    for whose, alone in (("this", set(ours) - set(theirs)), ("the other", set(theirs) - set(ours))):
        for title in sorted(alone):
            print(f"only in {whose} build: {title}")


main()
