#!/usr/bin/env python3
"""Counts the lines of the library that the tests reach: coverage.py BUILD_FOLDER SOURCE_FOLDER

Reads the counts of a build with --coverage (tests/run --full makes one) from gcov's JSON output. A line is reached when
any object file reached it. Prints the files with the most missed lines, then COVERAGE_LINES of all rooms together and of
each room with its target.
"""

import collections
import gzip
import json
import pathlib
import subprocess
import sys
import tempfile

TARGET = 95.0


def counted_lines(build, source):
    """{file below src: {line: times}}"""
    lines = collections.defaultdict(lambda: collections.defaultdict(int))
    data = sorted((build / "src").rglob("*.gcda"))
    if not data:
        sys.exit(f"error: nothing was counted below {build}/src; build with --coverage and run the tests")
    with tempfile.TemporaryDirectory() as folder:
        for start in range(0, len(data), 40):
            subprocess.run(["gcov", "--json-format", *map(str, data[start:start + 40])], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            for file in pathlib.Path(folder).glob("*.gcov.json.gz"):
                with gzip.open(file, "rt") as text:
                    report = json.load(text)
                file.unlink()
                for entry in report["files"]:
                    path = pathlib.Path(report["current_working_directory"], entry["file"]).resolve()
                    if source / "src" not in path.parents:
                        continue
                    for line in entry["lines"]:
                        lines[str(path.relative_to(source / "src"))][line["line_number"]] += line["count"]
    return lines


def main():
    build, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    lines = counted_lines(build, source)
    rooms = collections.defaultdict(lambda: [0, 0])
    missed = []
    for name, counts in lines.items():
        reached = sum(1 for times in counts.values() if times)
        room = rooms[name.split("/")[0]]
        room[0] += reached
        room[1] += len(counts)
        gaps = [number for number, times in sorted(counts.items()) if not times]
        if gaps:
            missed.append((len(gaps), name, gaps))
    for count, name, gaps in sorted(missed, reverse=True)[:15]:
        print(f"{count:4} missed in {name}: {', '.join(map(str, gaps[:30]))}{' ...' if count > 30 else ''}")
    rooms["lines"] = [sum(room[i] for room in rooms.values()) for i in (0, 1)]
    short = 0
    for room, (reached, total) in sorted(rooms.items()):
        share = 100 * reached / total
        short += share < TARGET
        print(f"COVERAGE_{room.upper()} {share:.2f} >={TARGET:g}")
    return 1 if short else 0


if __name__ == "__main__":
    sys.exit(main())
