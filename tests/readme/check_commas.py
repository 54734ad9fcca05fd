#!/usr/bin/env python3
"""Finds statements joined by commas in C and C++, and in such blocks of pages: "a = 1, b = 2;" in place of two statements.

usage: check_commas.py ROOT   prints FILE:LINE of each; exits with 1 if there is one

A declaration may list names, and the head of a for may step two variables. Preprocessor lines are left out.
"""

import re
import sys
from pathlib import Path

SPACE = r"\s+|//[^\n]*|/\*.*?\*/"
TEXT = r"""R"(?P<mark>[^()\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'"""
NUMBER = r"\.?\d(?:[eEpP][+-]|[\w.']|\b)*"
SIGN = r"->|\+\+|--|<<=|>>=|[-+*/%&|^]=|::|==|!=|<=|>=|&&|\|\||."
TOKEN = re.compile(f"(?P<space>{SPACE})|(?P<text>{TEXT})|(?P<word>[A-Za-z_]\\w*)|(?P<number>{NUMBER})|(?P<sign>{SIGN})", re.S)
ASSIGNS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
NO_ACT = set("const auto static typedef using constexpr extern struct enum class template return throw case default goto friend "
             "inline unsigned signed int double float char bool long short void operator typename if else for while switch public private protected".split())


def tokens_of(text):
    """(word, kind, position) of all that is no space, no comment and no preprocessor line."""
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda line: " " * len(line.group()), text, flags=re.M)
    return [(m.group(), m.lastgroup, m.start()) for m in TOKEN.finditer(text) if not m.group("space")]


def partners(tokens):
    """Of each bracket the place of its partner."""
    found, open_ = {}, []
    for i, (word, _, _) in enumerate(tokens):
        if word in ("(", "[", "{"):
            open_.append(i)
        elif word in (")", "]", "}") and open_:
            found[i] = open_.pop()
            found[found[i]] = i
    return found


def begins_statement(tokens, partner, i):
    """Whether a statement can begin at token i."""
    before = tokens[i - 1][0] if i else ";"
    if before == ")":  # of an if, a for or a while without braces
        opened = partner.get(i - 1, 0)
        return tokens[opened - 1][0] in ("if", "for", "while", "constexpr")
    if before == ":":  # of a case
        back = next((w for w, _, _ in reversed(tokens[: i - 1]) if w in (";", "{", "}", "?", "case", "default")), "")
        return back in ("case", "default")
    return before in (";", "{", "}", "else", "do")


def end_of_template(tokens, i):
    """The last token of a list of template arguments that begins at token i; i where there is none."""
    depth = 0
    for j in range(i, len(tokens)):
        word, kind, _ = tokens[j]
        if kind == "sign" and word not in ("<", ">", ",", "::", "*", "&"):
            return i
        depth += (word == "<") - (word == ">")
        if depth == 0:
            return j if j + 1 < len(tokens) and tokens[j + 1][0] in ("(", "{", "::") else i
    return i


def parts_of(tokens, partner, i):
    """The parts between the outer commas of a statement at token i; none where it is not closed by a semicolon."""
    parts, j = [[]], i
    while j < len(tokens):
        word = tokens[j][0]
        if word == ";":
            return parts
        if word in (")", "]", "}"):
            return []
        end = partner.get(j, end_of_template(tokens, j) if word == "<" else j)
        if word == ",":
            parts.append([])
        else:
            parts[-1] += tokens[j : end + 1]
        j = end + 1
    return []


def is_act(part):
    """An assignment, a call or a step; not a declaration and not a list of values."""
    if not part or part[0][0] in NO_ACT or part[0][1] == "number":
        return False
    if re.match(r"(const )?\w+( :: \w+)*( <.*>)? [*&]+ \w+ (=|\[|$)", " ".join(word for word, _, _ in part)):
        return False  # a type, a star and a name
    if any(word == ":" for word, _, _ in part) and not any(word == "?" for word, _, _ in part):
        return False  # a constructor and what it initialises
    if re.match(r"[\w.> -]+ < < ", " ".join(word for word, _, _ in part)):
        return False  # numbers that go into a matrix of Eigen
    depth, before, acts = 0, None, part[-1][0] == ")"
    for word, kind, _ in part:
        if depth == 0:
            if before and kind == "word" and (before[1] == "word" or before[0] == ">"):
                return False  # a type and a name
            if word in ASSIGNS:
                return True
            acts = acts or word in ("++", "--")
            before = (word, kind)
        depth += (word in ("(", "[", "{")) - (word in (")", "]", "}"))
    return acts


def joined(text):
    """The positions of all joined statements."""
    tokens = tokens_of(text)
    partner = partners(tokens)
    inside_round, found = [], []
    for i, (word, _, position) in enumerate(tokens):
        if begins_statement(tokens, partner, i) and word != "{" and not (inside_round and inside_round[-1]):
            parts = parts_of(tokens, partner, i)
            if len(parts) > 1 and all(map(is_act, parts)):
                found.append(position)
        if word in ("(", "[", "{"):
            inside_round.append(word == "(")
        elif word in (")", "]", "}") and inside_round:
            inside_round.pop()
    return found


def code_of(file):
    """The text of a file; of a page its blocks of C and C++, each line in its place."""
    text = file.read_text(encoding="utf-8")
    if file.suffix != ".md":
        return text
    kept, language = [], ""
    for line in text.split("\n"):
        if line.startswith("```"):
            language = "" if language else line[3:] or "text"
            line = ""
        kept.append(line if language in ("c", "cpp") else "")
    return "\n".join(kept)


def main():
    root, total = Path(sys.argv[1]), 0
    files = [root / "README.md"]
    for folder in ("src", "include", "samples", "tests", "bindings", "docs"):
        files += sorted((root / folder).rglob("*"))
    for file in files:
        if file.suffix not in (".c", ".cpp", ".h", ".hpp", ".inl", ".md"):
            continue
        text = code_of(file)
        for position in joined(text):
            total += 1
            print(f"{file.relative_to(root)}:{text.count(chr(10), 0, position) + 1}: {text[position:position + 80].splitlines()[0]}")
    print(f"{total} statements joined by commas")
    return 1 if total else 0


if __name__ == "__main__":
    sys.exit(main())
