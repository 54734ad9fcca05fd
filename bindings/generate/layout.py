"""Sizes and offsets of the ABI's structs for a pointer size, by the natural alignment every C compiler we know uses."""

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
