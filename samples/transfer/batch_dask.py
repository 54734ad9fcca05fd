#!/usr/bin/env python3
"""Runs the lines of a list for hf_transfer --batch on a cluster of dask.distributed.

    batch_dask.py LIST [--program hf_transfer] [--scheduler HOST:PORT] [--workers N]

Without --scheduler, N workers start on this machine. The files of the list and the program must have the same paths on
every worker. A line of JSON is printed for each line, as hf_transfer --batch does. A line whose worker dies is run
again on another. The exit code is the largest of all. Debian: python3-distributed.
"""
import argparse
import json
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path


def read_list(path: Path) -> list:
    """[(number, words)]: blanks part words, double quotes keep them together, # starts a line that says nothing."""
    lines = []
    for number, text in enumerate(path.read_text(encoding="utf-8-sig").splitlines(), 1):
        lexer = shlex.shlex(text, posix=True, punctuation_chars=False)
        lexer.whitespace, lexer.whitespace_split, lexer.quotes, lexer.commenters = " \t\r", True, '"', ""
        try:
            words = list(lexer)
        except ValueError as error:
            raise SystemExit(f"batch_dask: {path.name}, line {number}: {error}") from error
        if words and not words[0].startswith("#"):
            lines.append((number, words))
    if not lines:
        raise SystemExit(f"batch_dask: {path}: the list has no line")
    return lines


def run_line(program: str, number: int, words: list) -> dict:
    """One transfer in a process of its own; what it says comes back as a dictionary."""
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        outcome = Path(folder) / "outcome.json"
        try:
            code = subprocess.run([program, "--silent", "--outcome", str(outcome), *words], check=False).returncode
        except OSError as error:
            return {"line": number, "exit": 1, "error": str(error)}
        said = json.loads(outcome.read_text(encoding="utf-8")) if outcome.exists() else {}
    if code < 0:
        code = 128 - code
    if code and "error" not in said:
        said["error"] = "the process ended without a word"
    return {"line": number, "exit": code, **said, "seconds": time.monotonic() - start, "worker": os.getpid()}


def main() -> int:
    from distributed import Client, LocalCluster, as_completed  # not needed to read this file

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("list", type=Path)
    parser.add_argument("--program", default="hf_transfer")
    parser.add_argument("--scheduler")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    lines = read_list(given.list)
    cluster = given.scheduler or LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=None)
    worst = 0
    with Client(cluster) as client:
        # pure=False: the same words twice are two transfers; retries: lines of a worker that dies
        jobs = [client.submit(run_line, given.program, number, words, pure=False, retries=2) for number, words in lines]
        numbers = {job.key: number for job, (number, _) in zip(jobs, lines)}
        for job in as_completed(jobs):
            failed = job.exception()
            said = {"line": numbers[job.key], "exit": 1, "error": str(failed)} if failed else job.result()
            worst = max(worst, said["exit"])
            print(json.dumps(said), flush=True)
    return worst


if __name__ == "__main__":
    sys.exit(main())
