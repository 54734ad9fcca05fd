"""Runs the first program of a README: readme_example.py README.md LANGUAGE FILE COMMAND...

Writes the first ```LANGUAGE block to FILE, runs COMMAND and compares what it prints with the ```text block after it.
A program without such a block only has to succeed.
"""

import pathlib
import re
import subprocess
import sys

readme, language, path, command = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[4:]
text = pathlib.Path(readme).read_text()
match = re.search(r"^```" + language + r"\n(.*?)^```\n(?:\s*prints:?\s*```text\n(.*?)^```)?", text, re.S | re.M)
if not match:
    sys.exit(f"error: {readme} has no {language} block")
path.parent.mkdir(parents=True, exist_ok=True)
path.write_text(match.group(1))
run = subprocess.run(command, capture_output=True, text=True)
if run.returncode == 77:
    print(run.stdout)
    sys.exit(77)
sys.stderr.write(run.stderr)
if run.returncode != 0:
    sys.exit(f"error: the program of {readme} ended with {run.returncode}\n{run.stdout}")
if match.group(2) is not None and run.stdout.split() != match.group(2).split():
    sys.exit(f"error: the program of {readme} printed\n{run.stdout}\nand the README says\n{match.group(2)}")
print(run.stdout, end="")
