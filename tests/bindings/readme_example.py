"""Runs the first program of a README: readme_example.py [--calls TEMPLATE] README.md LANGUAGE FILE COMMAND...

Writes the first ```LANGUAGE block to FILE, runs COMMAND and compares what it prints with the ```text block after it.
A program without such a block only has to succeed. With --calls the second block is meant, a list of calls: it stands
in for the line @BLOCK@ of TEMPLATE, one tab deeper. A line @BLOCK 3@ means the third block.
"""

import pathlib
import re
import subprocess
import sys

arguments = sys.argv[1:]
template = None
if arguments[0] == "--calls":
    template, arguments = pathlib.Path(arguments[1]).read_text(), arguments[2:]
readme, language, path, command = arguments[0], arguments[1], pathlib.Path(arguments[2]), arguments[3:]
text = pathlib.Path(readme).read_text()
if template is not None:
    line = re.search(r"^@BLOCK(?: (\d+))?@\n", template, re.M)
    for _ in range(int(line.group(1) or 2) - 1):
        text = text[text.index("```" + language) + 3 :]
match = re.search(r"^```" + language + r"\n(.*?)^```\n(?:\s*prints:?\s*```text\n(.*?)^```)?", text, re.S | re.M)
if not match:
    sys.exit(f"error: {readme} has no {language} block")
path.parent.mkdir(parents=True, exist_ok=True)
program = match.group(1)
if template is not None:
    program = template.replace(line.group(0), "".join("\t" + row + "\n" if row else "\n" for row in program.splitlines()))
path.write_text(program)
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
