#!/usr/bin/env python3
"""Counts the lines and branches of the library that the tests reach: coverage.py BUILD_FOLDER SOURCE_FOLDER [ROOM]

Reads the counts of a build with --coverage (tests/run --full makes one) from gcov's JSON output. A line or a branch is
reached when any object file, or any instance of a template, reached it. Prints the files with the most missed lines and
branches, then COVERAGE_ROOM_LINES and COVERAGE_ROOM_BRANCHES of each room and of all, with their targets. With ROOM it
lists every missed branch of that room instead, with its line; reasons for them are in branches.md.

A call that can throw has two branches in gcov's graph: go on, or unwind. Neither counts. Branches on a line that decides
nothing are the compiler's (shared cleanup, the catch clause, thread-local data) and do not count. Only lines of src count,
so the branches of library code that the compiler inlines do not.
"""

import collections
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile

TARGET = {"lines": 95.0, "branches": 90.0}


DECIDES = re.compile(r"\b(if|for|while|switch|case)\b|\?|&&|\|\||\b(std::min|std::max)\b")
ENDS = re.compile(r"(^|[;{}:])\s*(//.*)?$")  # of a line: the next begins a statement


def deciding_lines(file):
    """The numbers of lines that hold a decision or go on with a statement of the line before."""
    text = [""] + file.read_text().splitlines()
    return {n for n in range(1, len(text)) if DECIDES.search(text[n]) or not ENDS.search(text[n - 1])}


def decisions(branches):
    """The branches of a line without those of calls that can throw: gcov lists "go on" just before "unwind"."""
    kept = []
    for branch in branches:
        if not branch["throw"]:
            kept.append(branch)
        elif kept and kept[-1]["fallthrough"]:
            kept.pop()
    return [branch["count"] for branch in kept]


def starts_of(entry):
    """{function: where it starts} of a file, and {where: functions that start there}"""
    starts = {function["name"]: (function["start_line"], function["start_column"]) for function in entry["functions"]}
    return starts, collections.Counter(starts.values())


def groups_of(line, starts, instances):
    """(start of the function, [times]) for each instance that a line of gcov's report stands for.

    gcov gives lambdas of a template one line for all instances, one after the other, and no name.
    """
    times = decisions(line["branches"])
    if line.get("function_name") in starts:
        return [(starts[line["function_name"]], times)]
    start = max((place for place in instances if place[0] <= line["line_number"]), default=None)
    count = instances.get(start, 1)
    each = len(times) // count
    if len(times) % count:
        return [(start, times)]
    return [(start, times[i * each:(i + 1) * each]) for i in range(count)]


def reports(build):
    """gcov's report of every object file of the library."""
    data = sorted((build / "src").rglob("*.gcda"))
    if not data:
        sys.exit(f"error: nothing was counted below {build}/src; build with --coverage and run the tests")
    with tempfile.TemporaryDirectory() as folder:
        for start in range(0, len(data), 40):
            subprocess.run(["gcov", "-b", "--json-format", *map(str, data[start:start + 40])], cwd=folder, check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for file in sorted(pathlib.Path(folder).glob("*.gcov.json.gz")):
                with gzip.open(file, "rt") as text:
                    yield json.load(text)
                file.unlink()


def counts(build, source):
    """{file below src: {line: times}} and {file: {(line, start of its function, number of branches): [times]}}

    Instances of a template start at the same place and add up. Those with other branches (if constexpr) stand apart.
    """
    lines = collections.defaultdict(collections.Counter)
    branches = collections.defaultdict(dict)
    deciding = {}
    for report in reports(build):
        for entry in report["files"]:
            path = pathlib.Path(report["current_working_directory"], entry["file"]).resolve()
            if source / "src" not in path.parents:
                continue
            name = str(path.relative_to(source / "src"))
            if name not in deciding:
                deciding[name] = deciding_lines(path)
            starts, instances = starts_of(entry)
            for line in entry["lines"]:
                number = line["line_number"]
                lines[name][number] += line["count"]
                if number not in deciding[name]:
                    continue
                for start, times in groups_of(line, starts, instances):
                    before = branches[name].setdefault((number, start, len(times)), [0] * len(times))
                    before[:] = [a + b for a, b in zip(before, times)]
    return lines, branches


def list_missed(branches, source, room):
    for name, groups in sorted(branches.items()):
        if name.split("/")[0] != room:
            continue
        text = (source / "src" / name).read_text().splitlines()
        for (number, _, _), times in sorted(groups.items(), key=lambda group: group[0][0]):
            if not all(times):
                print(f"{name}:{number}: {times} {text[number - 1].strip()}")


def print_worst(kind, missed):
    for name, gaps in sorted(missed.items(), key=lambda item: -len(item[1]))[:15]:
        more = " ..." if len(gaps) > 30 else ""
        print(f"{len(gaps):4} {kind} missed in {name}: {', '.join(map(str, gaps[:30]))}{more}")


def main():
    build, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    lines, branches = counts(build, source)
    if len(sys.argv) > 3:
        return list_missed(branches, source, sys.argv[3])
    found = {}  # kind: {file: [(line, times)]}, one entry each line or branch
    found["lines"] = {name: sorted(times.items()) for name, times in lines.items()}
    found["branches"] = {name: [(key[0], once) for key, times in sorted(groups.items(), key=lambda group: group[0][0])
                                for once in times] for name, groups in branches.items()}
    rooms = collections.defaultdict(lambda: {kind: [0, 0] for kind in found})
    for kind, files in found.items():
        missed = {}
        for name, entries in files.items():
            missed[name] = [number for number, times in entries if not times]
            for room in (name.split("/")[0], "all"):
                rooms[room][kind][0] += len(entries) - len(missed[name])
                rooms[room][kind][1] += len(entries)
        print_worst(kind, {name: gaps for name, gaps in missed.items() if gaps})
    short = 0
    for room, kinds in sorted(rooms.items()):
        for kind, (reached, total) in kinds.items():
            share = 100 * reached / max(total, 1)
            short += share < TARGET[kind]
            print(f"COVERAGE_{room.upper()}_{kind.upper()} {share:.2f} >={TARGET[kind]:g}")
    return 1 if short else 0


if __name__ == "__main__":
    sys.exit(main())
