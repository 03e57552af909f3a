# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the .vtu files that voussoir writes; needs nothing but Python."""

import base64
import re
import struct
import zlib
from array import array

TYPES = {"Float32": "f", "Float64": "d", "Int8": "b", "UInt8": "B", "Int32": "i", "UInt32": "I", "Int64": "q"}


def read_vtu(path):
    """The arrays by name, flat; with Points (3 per point), connectivity, offsets and types."""
    with open(path, encoding="ascii") as file:
        text = file.read()
    result = {}
    for tag, body in re.findall(r"<DataArray\s([^>]*)>(.*?)</DataArray>", text, re.S):
        attributes = dict(re.findall(r'(\w+)="([^"]*)"', tag))
        kind = TYPES[attributes["type"]]
        name = attributes.get("Name", "Points")
        if attributes["format"] == "ascii":
            convert = float if kind in "fd" else int
            result[name] = array(kind, (convert(word) for word in body.split()))
            continue
        body = "".join(body.split())
        count, = struct.unpack("<I", base64.b64decode(body[:8])[:4])
        header = 4 * ((4 * (3 + count) + 2) // 3)  # characters
        sizes = struct.unpack(f"<{3 + count}I", base64.b64decode(body[:header])[:4 * (3 + count)])[3:]
        data, begin, blocks = base64.b64decode(body[header:]), 0, []
        for size in sizes:
            blocks.append(zlib.decompress(data[begin:begin + size]))
            begin += size
        result[name] = array(kind, b"".join(blocks))
    return result
