# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of a scene and lines of a log as an engineer writes them: 27 GPa for 27000000000, m³ for m3."""

import math
import re

PREFIXES = {"Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1., "Pa")), "N": ((1e6, "MN"), (1e3, "kN"), (1., "N")),
            "N/m": ((1e6, "MN/m"), (1e3, "kN/m"), (1., "N/m")), "m": ((1., "m"), (1e-3, "mm"))}
NAMES = {"-": "", "kg/m^3": "kg/m³", "m/s^2": "m/s²", "degC": "°C", "degrees": "°"}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def superscript(exponent):
    return str(exponent).translate(SUPERSCRIPTS)


def decimal(value):
    """Text of a number with six digits, with a power of ten below 0.001 and from a million on."""
    text = f"{value:.6g}"
    if value != 0. and math.isfinite(value) and not 1e-3 <= abs(value) < 1e6:
        mantissa, exponent = f"{value:.5e}".split("e")
        text = f"{float(mantissa):g} × 10{superscript(int(exponent))}"
    return text.replace("-", "\N{MINUS SIGN}")


def with_prefix(value, unit):
    """Text of a value in SI with the largest unit that leaves at least 1: (27e9, "Pa") is "27 GPa"."""
    choices = PREFIXES.get(unit, ((1., NAMES.get(unit, unit)),))
    scale, name = next((choice for choice in choices if abs(value) >= 0.9999995 * choice[0]), choices[-1])
    return f"{decimal(value / scale)} {name}".rstrip()


def readable(text, unit):
    """Value of an entry as text, in SI, with its unit. Texts, lists, and -1 for "not given" stay as they are."""
    try:
        value = float(text)
    except ValueError:
        return text
    if unit is None or value == -1. and unit != "degC" or not math.isfinite(value):
        return text
    return with_prefix(value, unit) if value != 0. else "0"


def units_of(text):
    """Units of the entries of an input file that the program wrote, by the comment before each: "Section/Entry" -> unit."""
    found, path, remark = {}, [], ""
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("#"):
            remark += " " + line.lstrip("# ")
            continue
        if line.startswith("subsection "):
            path.append(line.split(" ", 1)[1].strip())
        elif line == "end" and path:
            path.pop()
        elif line.startswith("set ") and len(units := re.findall(r"\[([^\]\s]*)\]", remark)) == 1:
            found["/".join([*path, line[4:].partition("=")[0].strip()])] = units[0]
        remark = ""
    return found


def typeset(text):
    """A line of the log: units with exponents, powers of ten, and pressures and forces without long numbers."""
    text = re.sub(r"\b(m|mm|cm|km|s)\^?([23])\b", lambda found: found[1] + superscript(found[2]), text)
    text = re.sub(r"(?<![\w.])(-?\d+(?:\.\d*)?)e([+-]?\d+)", lambda found: f"{found[1]} × 10{superscript(int(found[2]))}", text)
    return re.sub(r"(?<=\d )deg(?=C)", "°", text)
