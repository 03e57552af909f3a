# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the .vtu files of voussoir, and writes such files. Requires only Python."""

import base64
import re
import struct
import zlib
from array import array

from .errors import InputError

TYPES = {"Float32": "f", "Float64": "d", "Int8": "b", "UInt8": "B", "Int32": "i", "UInt32": "I", "Int64": "q"}


def read_vtu(path):
    """The arrays by name, flat; with Points (3 per point), connectivity, offsets and types. Throws InputError for a damaged file."""
    try:
        with open(path, encoding="ascii") as file:
            return arrays_of(file.read())
    except (ArithmeticError, LookupError, ValueError, struct.error, zlib.error) as error:
        raise InputError(f"{path} is damaged: its arrays cannot be decoded ({error}). Repeat the run.") from error


def arrays_of(text):
    """The same, of the text of a file."""
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


def write_vtu(path, points, cells, kind, point_data=(), cell_data=()):
    """An unstructured grid of cells of one kind (of VTK: 9 quadrilateral, 12 hexahedron), as text. The data: name -> values, of each
    point or cell one number or three."""
    def array_of(name, values, type_name):
        rows = [row if hasattr(row, "__len__") else (row,) for row in values]
        width = f' NumberOfComponents="{len(rows[0])}"' if rows and len(rows[0]) > 1 else ""
        text = "\n".join(" ".join(f"{x:.7g}" if type_name == "Float32" else str(int(x)) for x in row) for row in rows)
        return f'<DataArray type="{type_name}" Name="{name}"{width} format="ascii">\n{text}\n</DataArray>\n'

    with open(path, "w", encoding="ascii") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
                   f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n')
        file.write("<Points>\n" + array_of("Points", points, "Float32") + "</Points>\n<Cells>\n")
        file.write(array_of("connectivity", cells, "Int32"))
        file.write(array_of("offsets", [sum(map(len, cells[:1])) * (i + 1) for i in range(len(cells))], "Int32"))
        file.write(array_of("types", [kind] * len(cells), "UInt8") + "</Cells>\n")
        for tag, data in (("PointData", point_data), ("CellData", cell_data)):
            file.write(f"<{tag}>\n" + "".join(array_of(name, values, "Float32") for name, values in dict(data).items()) + f"</{tag}>\n")
        file.write("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")
