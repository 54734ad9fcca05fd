"""Sizes and offsets of the ABI's structs for a pointer size, by the natural alignment every C compiler we know uses.

usage: layout.py INCLUDE_DIR OUT.c     writes a C file that does not compile where a compiler lays a struct out otherwise than
                                       the bindings do, or where a constant has another value
"""

import pathlib
import sys

SIZES = {"int32_t": 4, "uint32_t": 4, "hf_result": 4, "float": 4, "double": 8, "char": 1, "uint8_t": 1, "uint16_t": 2, "int64_t": 8,
    "uint64_t": 8}


def is_pointer(api, item):
    """Whether a field or parameter is as wide as a pointer: pointers, handles, callbacks."""
    return item["pointer"] > 0 or item["type"] == "function" or any(h["name"] == item["type"] for h in api["handles"])


def struct_named(api, name):
    return next((s for s in api["structs"] if s["name"] == name), None)


def measure(api, item, pointer_size):
    """(size, alignment) of one field, arrays included."""
    if is_pointer(api, item) or item["type"] == "size_t":
        size = align = pointer_size
    elif item["type"] in SIZES:
        size = align = SIZES[item["type"]]
    else:
        size, align, _ = lay_out(api, struct_named(api, item["type"]), pointer_size)
    return size * max(1, item.get("count", 0)), align


def lay_out(api, struct, pointer_size):
    """(size, alignment, {field: offset})."""
    offset, widest, offsets = 0, 1, {}
    for field in struct["fields"]:
        size, align = measure(api, field, pointer_size)
        offset = (offset + align - 1) // align * align
        offsets[field["name"]] = offset
        offset += size
        widest = max(widest, align)
    return (offset + widest - 1) // widest * widest, widest, offsets


def check_in_c(api, header):
    """Lines of C: every size, offset and constant as an assertion, and no padding that a caller could leave undefined."""
    lines = [f'#include "{header}"', "#include <stddef.h>"]
    claims = 0

    def claim(condition):
        nonlocal claims
        claims += 1
        lines.append(f"typedef char claim_{claims}[({condition}) ? 1 : -1];")

    for constant in api["constants"]:
        claim(f"{constant['name']} == {constant['value']}")
    for width, test in ((8, "#if UINTPTR_MAX > 0xffffffffu"), (4, "#else")):
        lines.append(test)
        for struct in api["structs"]:
            size, _, offsets = lay_out(api, struct, width)
            end = 0
            for field in struct["fields"]:
                place = offsets[field["name"]]
                if width == 8 and place != end:
                    sys.exit(f"error: {struct['name']} has padding before {field['name']}")
                end = place + measure(api, field, width)[0]
                claim(f"offsetof({struct['name']}, {field['name']}) == {place}")
            if width == 8 and end != size:
                sys.exit(f"error: {struct['name']} ends with padding")
            claim(f"sizeof({struct['name']}) == {size}")
    return lines + ["#endif", "int hf_layout_is_checked;"]


def main():
    import parse_headers

    include, out = map(pathlib.Path, sys.argv[1:3])
    out.write_text("\n".join(check_in_c(parse_headers.read_api(include), "hf/hf.h")) + "\n")


if __name__ == "__main__":
    main()
