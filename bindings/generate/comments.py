"""The words of the headers: what a comment says about a field, a parameter, an enum or a function.

Field of a struct            [a][b] at the start: an array of a rows of b. `in`, `out`: who writes it. NULL: it may be left out.
                             An hf_array also says its numbers: [a][b] of float or double.
                             HF_X_*: a value of that enum. "1: ..." of an int32_t: a flag. HF_NO_INDEX: -1 stands for it.
Parameter, in the function's `name: type[a][b]` or `name: NULL, or ...`; `name: receives ...` is one value out.
comment
Enum                         the word Bits at the start: its values can be combined.
Function                     Errors: ..., Cost: ..., Thread safety: ..., Since ... end it.
"""

import re

DIMS = r"((?:\[[^\]]+\])+)"
VIEWS = ("hf_array", "hf_array_out")
NUMBERS = r" of (float|double|u?int\d+_t)(?: or (float|double|u?int\d+_t))?"
UNITS = [("ms", r"_ms$", None), ("bytes", r"_bytes$", None), ("radians", None, r"\bradians\b"), ("degrees", None, r"\bdegrees\b"),
         ("1 / length^2", None, r"1 / length\^2"), ("length", None, r"in (?:the|each surface's|the target's) units?\b|unit of the (?:mesh|positions)"),
         ("MiB", r"_mb$", None)]


def plain(comment):
    """A comment without its marks, paragraphs kept."""
    lines = [re.sub(r"^\s*\*? ?", "", line).rstrip() for line in comment[2:-2].strip().splitlines()]
    return re.sub(r"[ \t]*\n[ \t]*", " ", "\n".join(lines).replace("\n\n", "\0")).replace("\0", "\n\n").strip()


def first_sentence(text):
    match = re.match(r"(.+?[.:])(\s|$)", text, re.S)
    return (match.group(1) if match else text).rstrip(":")


def dims_of(text):
    """'[a][b + 1]' -> ['a', 'b + 1']."""
    return [part.replace("->", ".").strip() for part in re.findall(r"\[([^\]]+)\]", text)]


def unit_of(name, text):
    for unit, by_name, by_text in UNITS:
        if (by_name and re.search(by_name, name)) or (by_text and re.search(by_text, text)):
            return unit
    return ""


def say_field(field, text, struct_text):
    """Adds what the comment of a field says."""
    said = re.match(r"(in|out)(?:[:;]\s*|$)", text)
    field["direction"] = said.group(1) if said else ""
    if said and said.group(1) == "in" and re.search(r";\s*out:", text):
        field["direction"] = "inout"
    rest = text[said.end():] if said else text
    array = re.match(r"(?:NULL(?: = [\w ]+)?, or )?" + DIMS, rest)
    field["dims"] = dims_of(array.group(1)) if array and (field["pointer"] or field["type"] in VIEWS) else []
    field["view"] = numbers_of(field, rest[array.end():] if array else "")
    other = re.search(r"[Ww]ithout (\w+)[:,]? " + DIMS, rest) if field["dims"] else None
    field["without"] = {other.group(1): dims_of(other.group(2))} if other else {}
    field["optional"] = bool(re.search(r"\bNULL\b", text) or (field["pointer"] and re.search(
        r"[Ee]ach (?:array )?(?:may be|is) NULL", struct_text)))
    field["enum"] = said_enum(text)
    field["flag"] = field["type"] in ("int32_t", "uint8_t") and not field["count"] and bool(
        re.search(r"(?:^|\s)1: ", rest)) and not field["enum"]
    field["sentinel"] = "HF_NO_INDEX" in text
    field["unit"], field["doc"] = unit_of(field["name"], text), text
    return field


def numbers_of(item, text):
    """The types that an hf_array may have, the plain one first."""
    said = re.match(NUMBERS, text)
    return [kind for kind in said.groups() if kind] if said and item["type"] in VIEWS else []


def said_enum(text):
    match = re.search(r"\b(HF_[A-Z_]+_)\*", text)
    return match.group(1) if match else ""


def parts(text):
    """A function's comment: (prose, {Errors, Cost, Thread safety, Since})."""
    found, cut = {}, len(text)
    marks = list(re.finditer(r"(?:(?<=\s)|^)(Errors(?:, with index = \w+)?:|Cost:|Thread safety:|Since )", text))
    for mark, following in zip(marks, [*marks[1:], None]):
        end = following.start() if following else len(text)
        found[mark.group(1).split(",")[0].rstrip(": ")] = text[mark.end():end].strip()
        cut = min(cut, mark.start())
    return text[:cut].strip(), found


def segments(prose, names):
    """{name: text} of 'name: ...' in prose, and the prose before the first of them."""
    one = "|".join(map(re.escape, sorted(names, key=len, reverse=True))) or r"$^"
    marks = list(re.finditer(rf"(?:(?<=\s)|^)((?:{one})(?:(?:, | and )(?:{one}))*): ", prose))
    found = {}
    for mark, following in zip(marks, [*marks[1:], None]):
        piece = prose[mark.end():following.start() if following else len(prose)].strip()
        alone = re.match(rf"(?:NULL, or )?(?:\w+ ?)?{DIMS}(?:{NUMBERS})?\.(?=\s|$)", piece)  # what follows is about the call
        piece = alone.group(0) if alone else piece
        for name in re.findall(r"\w+", mark.group(1).replace(" and ", " ")):
            found[name] = piece.split("\n\n")[0].strip()
    return found


def say_parameter(parameter, text):
    """Adds what a function's comment says of a parameter."""
    first = re.split(r"(?<=[.])\s", text)[0] if text else ""
    array = re.search(rf"(?:^|\b)(?:{parameter['type']} ?)?{DIMS}", first) or re.match(rf"{DIMS}", text)
    parameter["dims"] = dims_of(array.group(1)) if array and parameter["pointer"] else []
    parameter["view"] = numbers_of(parameter, first[array.end():] if array else "")
    parameter["optional"] = bool(parameter["pointer"] or parameter["type"].startswith("hf_")) and bool(
        re.search(r"^NULL\b|\bor NULL\b|; NULL\b", text))
    parameter["receives"] = "receives" in text
    parameter["enum"] = said_enum(text)
    parameter["sentinel"] = "HF_NO_INDEX" in text
    parameter["flag"] = parameter["type"] in ("int32_t", "uint8_t") and bool(re.search(r"(?:^|\s)1: ", text))
    parameter["zero"] = bool(re.search(r"\b0( to |\s*=|:| for )", text))
    parameter["unit"], parameter["doc"] = unit_of(parameter["name"], text), text
    return parameter


def default_of(text):
    """What 0 stands for, where the comment says it as a number: '0 = 4', '0: 4', '0 for 4'."""
    match = re.search(r"\b0(?: =|:| for) ([\d,.]+?)(?=[;.,)]?(?:\s|$))", text)
    return match.group(1).replace(",", "") if match else ""


def errors_of(text, also=()):
    return sorted({*re.findall(r"HF_ERROR_\w+", text), *also})
