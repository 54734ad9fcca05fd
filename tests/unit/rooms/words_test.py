#!/usr/bin/env python3
"""Habits of words that make a reader go back, in headers, comments of src, pages and error texts.

usage: words_test.py SOURCE_FOLDER
Each habit has a pattern, the rule that mends it, and sentences that must be found. ALLOWED holds sentences that are
right all the same, each with its reason. No pattern finds H4, a clause far from its noun ("a part may jump that turns").
"""
import pathlib
import re
import sys

NOUNS = (
    "vertex|vertices|pieces?|fields?|surfaces?|body|bodies|foot|feet|parts?|bones?|pairs?|sites?|handles?|joints?|"
    "nodes?|regions?|clusters?"
)
PRIVATE = "sees?|asks?|informs?|stands?|sinks?|carry|carries|rides?|settles?|hears?"
UNITS = "ms|us|ns|MB|kB|GB|bytes|numbers|lines|weights|joints|words|vertices|sites|steps"
THINGS = (
    "vertex|frame|site|step|core|second|row|column|sentence|pair|function|mesh|handle|factor|box|number|line|file|run|"
    "call|edit|character|side|triangle"
)
MOST_NUMBERS = 6  # of a sentence; a table reads better from seven on. Half finds every range of a parameter

# name: (pattern, rule, sentences that show the habit)
HABITS = {
    "H1": (
        r"\b(?:that|those) of\b|(?<![?.] )\bwhat (?:it|they|is|are|was|were|follows|comes|stands|does|moves|lies)\b(?!.*\?)",
        "say the noun again",
        ["The bits are those of the plain build.", "A cluster keeps what it is."],
    ),
    "H2": (
        r"^(?:Of|What)\b(?!.*\?)",
        "a sentence starts with its subject and has a verb",
        ["Of two joints the first.", "What a solve changes."],
    ),
    "H3": (r"\bbut for\b", "an exception is a sentence of its own", ["Allocates first, but for the last step."]),
    "H5": (
        r"\b(?:%s) (?:%s)\b" % (NOUNS, PRIVATE),
        "use the field's verb",
        ["The vertex sees its joint.", "A part sinks into the ground."],
    ),
    "H6": (None, "write a table, or fewer numbers", ["With 1, 2, 3 and 4 it takes 5, 6, 7 and 8 ms."]),
    "H7": (
        r"\b(?:%s) an? (?:%s)\b|\b(?:an?|one) (?:site|handle|vertex|row|column|field|pair|step|constraint) more\b(?! often)"
        % (UNITS, THINGS),
        "write per, and one more",
        ["It takes 16 bytes a vertex.", "Add one site more."],
    ),
    "H8": (
        r"\((?:slots?|blocks?|blocks? of columns|bands? of vertices|anchors?|groups? of vertices[^)]*)\)",
        "rename the thing",
        ["Each has a number (slot)."],
    ),
}
NUMBER = re.compile(r"(?<![A-Za-z_.])\d[\d,.]*(?:e-?\d+)?")
COMPILED = {name: re.compile(habit[0], re.I if name != "H2" else 0) for name, habit in HABITS.items() if habit[0]}

# (file, part of the sentence): reason
ALLOWED = {
    ("docs/invariance.md", "horse (900), torus (390)"): "a list of names, each with one number",
    ("src/mesh/face_correction.h", "pairs 01 02 03 12 13 23"): "the digits name pairs of corners",
}

# (start of the path, part of the sentence): words that wait for the change that is under way there. "" is every one.
def faults(sentence):
    """The habits of one sentence, by name."""
    if len(re.findall(r"[A-Za-z][A-Za-z'_-]*", sentence)) < 4:
        return []
    found = [name for name, pattern in COMPILED.items() if pattern.search(sentence)]
    is_formula = re.search(r" [=+*/] |\^|%[-\d.*]*[a-z]|\[\[|\": ", sentence)  # an equation, a format, or JSON
    if len(NUMBER.findall(sentence)) > MOST_NUMBERS and not is_formula:
        found.append("H6")
    return found


def sentences(paragraph):
    return re.split(r"(?<=[.!?;])\s+(?=[A-Z(])|\\n\s*", paragraph)


def page(text):
    """The paragraphs of a page, as code() gives them, without code, tables, headings and links."""
    lines, code = text.split("\n"), False
    block, start = [], 0
    for number, line in enumerate(lines + [""], 1):
        if line.lstrip().startswith("```"):
            code = not code
        if code or not line.strip() or line.startswith(("    ", "#", "!", "|", "```")):
            if block:
                yield start, True, " ".join(block)
            block = []
            continue
        if not block or re.match(r"\s*(?:[-*]|\d+\.) ", line):
            if block:
                yield start, True, " ".join(block)
            block, start = [], number
        line = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line)
        block.append(re.sub(r"`[^`]*`", "x", line).strip().lstrip("-* "))


TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'|//[^\n]*|/\*.*?\*/', re.S)


def code(text):
    """Comments as paragraphs, and texts in quotes, each as (line, whether a comment, text). A comment behind code is a
    paragraph with the comment lines below it."""
    block, start, last, column, literal, at, end = [], 0, 0, 0, [], 0, 0
    for match in TOKEN.finditer(text):
        token, number = match.group(0), text.count("\n", 0, match.start()) + 1
        before = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
        if token[0] == '"':
            if literal and text[end : match.start()].strip():
                yield at, False, "".join(literal)
                literal = []
            if before.lstrip().startswith("#"):
                continue
            if not literal:
                at = number
            literal.append(token[1:-1])
            end = match.end()
            continue
        if token[0] == "'":
            continue
        if token[1] == "/":
            words = token.strip("/").strip()
            if block and (number != last + 1 or before.strip() or len(before) != column or not words):
                yield start, True, " ".join(block)
                block = []
            if words:
                start = start if block else number
                block.append(words)
            last, column = number, len(before)
            continue
        for offset, line in enumerate(token[2:-2].split("\n")):
            words = line.strip().lstrip("*").strip()
            if not words or words.startswith("- "):
                if block:
                    yield start, True, " ".join(block)
                block = []
            if words:
                start = start if block else number + offset
                block.append(words.lstrip("- "))
        if block:
            yield start, True, " ".join(block)
        block = []
    if block:
        yield start, True, " ".join(block)
    if literal:
        yield at, False, "".join(literal)


def main(root):
    root = pathlib.Path(root)
    files = [root / "README.md"]
    files += sorted((root / "docs").glob("*.md"))
    for folder, endings in (("include", "h"), ("src", "h cpp"), ("samples", "h cpp")):
        for ending in endings.split():
            files += sorted((root / folder).rglob("*." + ending))
    count, bad, used = 0, 0, set()
    for path in files:
        name = path.relative_to(root).as_posix()
        text = path.read_text(encoding="utf-8")
        for line, is_comment, paragraph in page(text) if path.suffix == ".md" else code(text):
            if is_comment and name.startswith("samples/"):
                continue  # of programs only the texts that users see
            for sentence in sentences(paragraph):
                count += 1
                found = faults(sentence)
                if not found:
                    continue
                allowed = [key for key in ALLOWED if key[0] == name and key[1] in sentence]
                used.update(allowed)
                if allowed:
                    continue
                bad += 1
                print("%s:%d: %s: %s" % (name, line, ", ".join("%s (%s)" % (f, HABITS[f][1]) for f in found), sentence))
    for key in set(ALLOWED) - used:
        bad += 1
        print("%s: nothing to allow: %s" % key)
    for habit, (_, _, examples) in HABITS.items():
        for example in examples:
            if habit not in faults(example):
                bad += 1
                print("%s is not found in: %s" % (habit, example))
    if count < 5000:
        bad += 1
        print("only %d sentences were read" % count)
    print("%d sentences, %d to mend" % (count, bad))
    return bad > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
