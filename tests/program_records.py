#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program with records as agencies and spreadsheets give them. The files are written after the public descriptions of the formats
(see the table in source/motion/record_formats.cc).

    program_records.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import math
import re
from pathlib import Path

from program_motion import peak_response
from run_program import run_cases, expect, refused, runs, table, write

G = 9.80665
SCENE = "subsection Motion\n set Source = file\n set Time step = {}\nend\n"


def signal(peak, phase, n=64):
    """Samples with a peak of known size and place; the mean is not zero."""
    return [round(peak * math.exp(-.1 * abs(k - 20 - phase)) * math.cos(.9 * (k - 20 - phase)), 4) for k in range(n)]


NS, EW, UP = signal(312.5, 0), signal(-187.25, 3), signal(98.125, 5)  # [cm/s^2]


def rows(values, form, per_line):
    """Numbers in fixed columns, as Fortran writes them."""
    words = [form % value for value in values]
    return "".join("".join(words[k:k + per_line]) + "\n" for k in range(0, len(words), per_line))


def centred(values):
    return [value - sum(values) / len(values) for value in values]


def knet(values, direction="N-S", unit="gal", scale=(3920, 6182761), offset=12345, duration=None):
    counts = [round(value * scale[1] / scale[0]) + offset for value in values]
    fields = [("Origin Time", "2011/03/11 14:46:00"), ("Lat.", "38.103"), ("Long.", "142.861"), ("Depth. (km)", "24"), ("Mag.", "9.0"),
              ("Station Code", "MYG004"), ("Station Lat.", "38.7292"), ("Station Long.", "141.0217"), ("Station Height(m)", "40"),
              ("Record Time", "2011/03/11 14:46:36"), ("Sampling Freq(Hz)", "100Hz"), ("Duration Time(s)", f"{duration or len(values) / 100}"),
              ("Dir.", direction), ("Scale Factor", f"{scale[0]}({unit})/{scale[1]}"), ("Max. Acc. (gal)", "312.500"),
              ("Last Correction", "2011/03/11 14:46:21"), ("Memo.", "")]
    return "".join(f"{key:18}{value}\n" for key, value in fields) + rows(counts, "%9d", 8)


def esm(values, stream="HNN", units="cm/s^2", kind="ACCELERATION", n=None, step="0.010000"):
    head = {"EVENT_NAME": "NONE", "EVENT_ID": "EMSC-20161030_0000029", "EVENT_DATE_YYYYMMDD": "20161030", "EVENT_TIME_HHMMSS": "064018",
            "MAGNITUDE_W": "6.5", "NETWORK": "IT", "STATION_CODE": "T1212", "STREAM": stream, "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": "20161030_064013.000",
            "SAMPLING_INTERVAL_S": step, "NDATA": n or len(values), "DURATION_S": "0.640", "UNITS": units, "BASELINE_CORRECTION": "BASELINE REMOVED",
            "FILTER_TYPE": "BUTTERWORTH", "LOW_CUT_FREQUENCY_HZ": "0.050", "HIGH_CUT_FREQUENCY_HZ": "40.000", "HEADER_FORMAT": "DYNA 1.2",
            "DATA_TYPE": kind, "PROCESSING": "manual (Paolucci et al., 2011)"}
    lines = [f"{key}: {value}" for key, value in head.items()]
    return "\n".join(lines + [f"USER{k}:" for k in range(1, 65 - len(lines))]) + "\n" + rows(values, "%.6f", 1)


def afad(columns=("N-S", "E-W", "U-D"), n=None):
    values = {"N-S": NS, "E-W": EW, "U-D": UP}
    return (" STRONG GROUND MOTION RECORDS OF TURKIYE\n PLACE                 : GOLYAKA\n EARTHQUAKE DATE       : 12/11/1999 16:57:20 (GMT)\n"
            " EPICENTER COORDINATES : 40.8060N - 31.1870E\n STATION ID            : 8101\n RECORD TIME           : 12/11/1999 16:57:20.000000 (GMT)\n"
            f" NUMBER OF DATA        : {n or len(NS)}\n SAMPLING INTERVAL (SEC): 0.010000\n RAW PGA VALUES (gal)  : (N-S) 312.5 (E-W) 187.2 (U-D) 98.1\n\n"
            + "".join(f"{c:>12}" for c in columns) + "\n" + "".join("".join(f"{values[c][k]:12.6f}" for c in columns) + "\n" for k in range(len(NS))))


def smc(values, vertical=90, azimuth=360, kind="2 CORRECTED ACCELEROGRAM", n=None, rate=100., comments=2):
    text = [kind, "*", "1734", "1989 10 18 0004 15.2", "Moment Mag=6.9", "station =Gilroy # 1  component= 360", "", "", "", "", ""]
    integers = [-32768] * 48
    integers[1:7] = [1989, 291, 0, 4, 15, 200]
    integers[12], integers[13], integers[15], integers[16] = vertical, azimuth, comments, n or len(values)
    reals = [1.7e38] * 50
    reals[1] = rate
    return ("\n".join(text) + "\n" + rows(integers, "%10d", 8) + rows(reals, "%15.7E", 5) + "| a comment\n" * comments
            + rows(values, "%10.5f", 8))  # -187.25000 touches the number before


def cosmos_channel(values, azimuth, level=2, quantity="acceleration", units="cm/sec2 (04)", step=10., n=None, form="(8f10.5)"):
    integers, reals = [-999] * 100, [-999.] * 100
    integers[0], integers[53], reals[61] = level, azimuth, step
    n = n or len(values)
    return (f"Corrected {quantity}   (Format v01.20 with 13 text lines) Src: test\n" + "Record of one channel, 13 text lines\n" * 12
            + " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" + rows(integers, "%8d", 10)
            + " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n" + rows(reals, "%13.6f", 6)
            + "   1 Comment line(s) follow, each starting with a \"|\":\n| none\n"
            + f"    {n} {quantity} pts, approx   1 secs, units={units},Format={form}\n" + rows(values, "%10.5f", 8)
            + f"End-of-data for Chan  1 {quantity}\n")


def cosmos(**options):
    return "".join(cosmos_channel(values, azimuth, **options) for values, azimuth in ((EW, 90), (UP, 400), (NS, 360)))


def csmip(*channels, damage=""):
    text = ""
    for k, (values, direction) in enumerate(channels, 1):
        text += "Corrected accelerogram  24207-S2486-94020.02\n" + "Pacoima Dam\n" * 5 + f"Chan  {k}:  {direction} Location: Downstream\n" + "text\n" * 17
        text += f" {len(values)} points of instrument- and baseline-corrected accel, veloc and displ data\n"
        text += rows([0] * 100, "%5d", 16) + rows([0.] * 100, "%10.3f", 8)
        for name, unit, factor in (("accel", "cm/sec2", 1), ("veloc", "cm/sec", .1), ("displ", "cm", .01)):
            text += f" {len(values)} points of {name} data equally spaced at  .010 sec, in {unit}. (8f10.5)\n"
            text += rows([factor * value for value in values], "%10.5f", 8)
        text += f"/&  ----------  End of data for channel  {k}  ----------\n"
    return text.replace("312.50000", damage, 1) if damage else text


def at2(header, values=NS, unit="UNITS OF G", direction="000", scale=981., title="ACCELERATION TIME SERIES IN "):
    return (f"PEER NGA STRONG MOTION DATABASE RECORD\nLoma Prieta, 10/18/1989, Gilroy Array #1, {direction}\n{title}{unit}\n"
            + header + "\n" + rows([value / scale for value in values], "%15.7E", 5))


def columns(headings, *series, separator=",", step=.01):
    return headings + "".join(separator.join([f"{k * step:.3f}"] + [f"{value:.6f}" for value in row]) + "\n" for k, row in enumerate(zip(*series)))


def turned(azimuth_x, *channels):
    """x and y of horizontal channels (azimuth, values)."""
    return [[sum(values[k] * math.cos(math.radians(axis - azimuth)) for azimuth, values in channels) for k in range(len(NS))]
            for axis in (azimuth_x, azimuth_x - 90)]


FILTERED = at2("NPTS= 64, DT= .0100 SEC", unit="UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=50.0 Hz")
THREE = (EW, NS, UP)  # x to the east: y is north, z up
EAST = {"Azimuths": "x: 90"}
AT2 = {"File x": "f"}
# name: text, entries, x, y, z [cm/s^2], words of the log, tolerance [cm/s^2]
GOOD = {
    "knet": (knet(NS), {"File x": "f"}, (centred(NS), 0, 0), ("K-NET", "channels NS (1 x)", "steps of 0.01 s", "mean of 8."), 7e-4),
    "kiknet borehole": (knet(EW, "2"), {"File y": "f"}, (0, centred(EW), 0), ("channels EW1 (1 y)", "borehole"), 7e-4),
    "kiknet surface": (knet(UP, "6"), {"File z": "f"}, (0, 0, centred(UP)), ("channels UD2 (1 z)", "surface"), 7e-4),
    "knet turned": (knet(NS), {"File": "f", "Azimuths": "x: 60"}, turned(60, (0, centred(NS))) + [0], ("NS (0.5 x, 0.866 y)",), 7e-4),
    "esm": (esm(NS), {"File x": "f"}, (NS, 0, 0), ("ESM", "HNN (1 x)", "cm/s^2", "Paolucci", "low_cut_frequency_hz: 0.050"), 1e-5),
    "esm east": (esm(EW, "HNE"), {"File": "f", **EAST}, (EW, 0, 0), ("HNE (1 x)",), 1e-5),
    "afad header": (esm(UP, "HNZ", "gal"), {"File": "f", **EAST}, (0, 0, UP), ("HNZ (1 z)",), 1e-5),
    "esm in m/s2": (esm([v / 100 for v in NS], units="m/s^2"), {"File x": "f"}, (NS, 0, 0), ("unit m/s^2",), 1e-4),
    "afad": (afad(), {"File": "f", **EAST}, THREE, ("three columns", "NS (1 y); EW (1 x); UD (1 z)"), 1e-5),
    "afad other sequence": (afad(("U-D", "E-W", "N-S")), {"File": "f", **EAST}, THREE, ("UD (1 z); EW (1 x)",), 1e-5),
    "smc": (smc(NS), {"File x": "f"}, (NS, 0, 0), ("SMC", "channels 360 (1 x)", "cm/s^2", "corrected"), 1e-5),
    "smc down": (smc(UP, 180), {"File z": "f"}, (0, 0, [-v for v in UP]), ("down (-1 z)",), 1e-5),
    "smc uncorrected": (smc(EW, 90, 90, "1 UNCORRECTED ACCELEROGRAM"), {"File": "f", **EAST}, (EW, 0, 0), ("not corrected",), 1e-5),
    "cosmos v2": (cosmos(), {"File": "f", **EAST}, THREE, ("COSMOS", "90 (1 x); up (1 z); 360 (1 y)", "V2"), 1e-5),
    "cosmos v1 in g": (cosmos_channel([v / 981 for v in NS], 360, 1, units="g (02)"), {"File x": "f"}, ([v * G / 9.81 for v in NS], 0, 0),
                       ("V1, not corrected", "unit g"), 1e-2),
    "cosmos with velocity": (cosmos_channel(NS, 360) + cosmos_channel(EW, 360, quantity="velocity", units="cm/sec (05)"), {"File x": "f"}, (NS, 0, 0), (),
                             1e-5),
    "csmip": (csmip((NS, "360 Deg"), (UP, "Up"), (EW, "90 Deg")), {"File": "f", **EAST}, THREE, ("CSMIP V2", "360 (1 y); Up (1 z); 90 (1 x)"), 1e-5),
    "csmip turned": (csmip((NS, "265 Deg"), (EW, "355 Deg"), (UP, "Up")), {"File": "f", "Azimuths": "x: 175"}, turned(175, (265, NS), (355, EW)) + [UP], (),
                     1e-5),
    "at2": (at2("NPTS=     64, DT=   .0100 SEC"), AT2, ([v * G / 9.81 for v in NS], 0, 0), ("PEER AT2", "000 (1 x)", "unit g"), 1e-4),
    "at2 tight": (at2("NPTS=64, DT= .0100SEC"), AT2, ([v * G / 9.81 for v in NS], 0, 0), (), 1e-4),
    "at2 old": (at2("   64    0.0100    NPTS, DT"), AT2, ([v * G / 9.81 for v in NS], 0, 0), (), 1e-4),
    "at2 lower case": (at2("npts= 64, dt= .01 sec", title="acceleration in ", unit="units of g").lower(), AT2, ([v * G / 9.81 for v in NS], 0, 0), (), 1e-4),
    "at2 in cm/s2": (at2("NPTS= 64, DT= .0100 SEC", unit="UNITS OF CM/S/S", scale=1), AT2, (NS, 0, 0), ("unit cm/s^2",), 1e-3),
    "at2 down": (at2("NPTS= 64, DT= .0100 SEC", UP, direction="DWN"), {"File z": "f"}, (0, 0, [-v * G / 9.81 for v in UP]), ("DWN (-1 z)",), 1e-4),
    "column": (rows(NS, "%.4f", 1), {"File x": "f", "File step": ".01", "Unit": "gal"}, (NS, 0, 0),
               ("table", "unit gal (of the input file)", "steps of 0.01 s"), 1e-3),
    "column with heading": ("Acc. (gal)\n" + rows(NS, "%.4f", 1), {"File": "f", "File step": ".01", "Unit": "gal", "Azimuths": "x: 210; f: 210"}, (NS, 0,
                            0), (), 1e-3),
    "table by place": (columns("", *THREE), {"File": "f", "Unit": "gal"}, THREE, ("columns taken as t, a_x, a_y, a_z without headings",), 1e-4),
    "table in another sequence": (columns("t,a_z,a_x,a_y [gal]\n", UP, EW, NS), {"File": "f", "Unit": "gal"}, THREE, ("z (1 z); x (1 x); y (1 y)",), 1e-4),
    "table of directions": (columns("Time (s);UD (gal);Acc. NS (gal);a_EW (gal)\n", UP, NS, EW, separator=";"), {"File": "f", "Unit": "gal", **EAST}, THREE,
                            (), 1e-4),
    "table without time": ("N-S\tE-W\n" + "".join(f"{a:.4f}\t{b:.4f}\n" for a, b in zip(NS, EW)), {"File": "f", "File step": ".01", "Unit": "gal",
                           "Azimuths": "x: 100; NS: 10; EW: 100"}, (EW, NS, 0), (), 1e-3),
    "utf-16": (columns("t,a_x,a_y,a_z [gal]\n", *THREE).encode("utf-16"), {"File": "f", "Unit": "gal"}, THREE, (), 1e-4),
    "hand example": (columns("t,EW,NS\n", EW, NS), {"File": "f", "Unit": "gal", "Azimuths": "x: 120; EW: 90; NS: 0"},
                     ([a * math.sqrt(.75) - b / 2 for a, b in zip(EW, NS)], [a / 2 + b * math.sqrt(.75) for a, b in zip(EW, NS)], 0),
                     ("EW (0.866 x, 0.5 y); NS (-0.5 x, 0.866 y)",), 1e-4),
    "at2 with filters": (FILTERED, AT2, ([v * G / 9.81 for v in NS], 0, 0), ("unit g",), 1e-4),
    "at2 with a point": (at2("NPTS= 64, DT= .0100 SEC", unit="UNITS OF G."), AT2, ([v * G / 9.81 for v in NS], 0, 0), ("unit g",), 1e-4),
    "afad with a blank line": (afad(("U-D", "E-W", "N-S")).replace("N-S\n", "N-S\n\n"), {"File": "f", **EAST}, THREE, ("UD (1 z); EW (1 x)",), 1e-5),
    "cosmos without format": (cosmos_channel(NS, 90).replace("(10I8)", ""), AT2, (NS, 0, 0), ("COSMOS",), 1e-5),
    "heading with comment": (columns("t,a_x,a_y,a_z,, # as given, (filtered)\n", *THREE), {"File": "f", "Unit": "gal"}, THREE, ("z (1 z)",), 1e-4),
    "other heading": (columns("Seismogram\n", *THREE), {"File": "f", "Unit": "gal"}, THREE, ("headings not understood", "taken as t, a_x"), 1e-4),
    "slashes": (columns("t,N/S,E/W,Acc. (U/D)\n", NS, EW, UP), {"File": "f", "Unit": "gal", **EAST}, THREE, ("NS (1 y); EW (1 x); UD (1 z)",), 1e-4),
    "E, N, U": (columns("t/s,E,N,U\n", *THREE), {"File": "f", "Unit": "gal", **EAST}, THREE, ("E (1 x); N (1 y); up (1 z)",), 1e-4),
    "axis first": (columns("t,Z Acc (gal),X acceleration,Y accel.\n", UP, EW, NS), {"File": "f", "Unit": "gal"}, THREE, ("Z (1 z); X (1 x)",), 1e-4),
    "whole numbers": ("".join(f"{k},0,0,{-(k % 2)}\n" for k in range(64)), {"File": "f", "Unit": "gal", "Time step": "1"},
                      (0, 0, [-(k % 2) for k in range(64)]), (), 1e-9),
}


def entries(settings):
    return [word for key, value in settings.items() for word in ("--set", f"Motion/{key}={value}")]


def good():
    """Records of all formats: values (peak and unit), step and direction."""
    expect(len(GOOD) >= 30, f"{len(GOOD)} files")
    write("scene.prm", SCENE.format(.01))
    for name, (text, settings, expected, words, tolerance) in GOOD.items():
        Path("f").write_bytes(text if isinstance(text, bytes) else text.encode())
        shown = runs("motion", "scene.prm", "--output", "m.csv", *entries(settings))
        for word in words:
            expect(word in shown, f"{name}: '{word}' is missing: {shown}")
        motion = table("m.csv")[1]
        expect(len(motion) == len(NS), f"{name}: {len(motion)} samples")
        for d, component in enumerate(expected):
            for k, row in enumerate(motion):
                value = component[k] if component else 0.
                expect(abs(100 * row[d + 1] - value) <= tolerance, f"{name}: {'xyz'[d]} of sample {k} is {100 * row[d + 1]}, expected {value}")
        spectra = [[float(word) for word in row.split()] for row in re.search(r"RotD100.*\n((?:[ \d.]+\n)+)", shown)[1].splitlines()]
        expect(len(spectra) == 9 and all(row[5] >= max(row[1:3]) - 1e-3 and row[4] <= row[5] for row in spectra), f"{name}: {spectra}")
        if name == "knet turned":  # motion in one direction, 60 degrees from x
            expect(all(abs(row[5] - 2 * row[1]) < 3e-3 and abs(row[4] - math.sqrt(.5) * row[5]) < 2e-3 for row in spectra), f"{spectra}")
        peak = re.search(r"^peak acceleration\s+g\s+(\S+)\s+(\S+)\s+(\S+)", shown, re.M)
        for d, component in enumerate(expected):
            expect(abs(float(peak[d + 1]) - max(map(abs, component or [0])) / 980.665) < 6e-4, f"{name}: {peak[0]}")


TWO = {"File": "f", "Unit": "gal", **EAST}
BAD = {
    "knet cut": (knet(NS, duration=2.), AT2, ("states 200 values", "there are 64")),
    "knet scale": (knet(NS).replace("(gal)/", "/"), AT2, ("scale factor", "3920(gal)/6182761")),
    "knet velocity": (knet(NS, unit="kine"), AT2, ("'kine'", "no unit of acceleration")),
    "knet frequency": (knet(NS).replace("100Hz", "none"), AT2, ("line 11", "positive number after 'sampling freq(hz)'")),
    "knet vertical for x": (knet(NS, "U-D"), AT2, ("'UD'", "vertical", "Exchange the files")),
    "knet for File": (knet(NS), {"File": "f"}, ("one component", "File x")),
    "esm velocity": (esm(NS, kind="VELOCITY", units="cm/s"), AT2, ("not a record of acceleration", "velocity")),
    "esm unit": (esm(NS, units="counts"), AT2, ("'counts'", "no unit of acceleration")),
    "esm cut": (esm(NS, n=65), AT2, ("states 65 values", "there are 64")),
    "afad cut": (afad(n=70), TWO, ("states 210 values", "there are 192")),
    "smc velocity": (smc(NS, kind="3 VELOCITY"), AT2, ("line 1", "velocity")),
    "smc cut": (smc(NS, n=80), AT2, ("states 80 values", "there are 64")),
    "smc rate": (smc(NS, rate=1.7e38), AT2, ("sampling rate",)),
    "cosmos counts": (cosmos_channel(NS, 90, 0, units="counts (50)"), AT2, ("'counts'", "no unit of acceleration")),
    "cosmos cut": (cosmos_channel(NS, 90, n=90), AT2, ("not a finite number", "of 90")),
    "cosmos step": (cosmos_channel(NS, 90, step=1000.), AT2, ("about 1 s", "1000 ms")),
    "cosmos velocity": (cosmos_channel(NS, 90, quantity="velocity", units="cm/sec (05)"), AT2, ("not a record of acceleration", "velocity")),
    "cosmos channels": (cosmos(), AT2, ("3 channels", "Motion/Azimuths")),
    "csmip damaged": (csmip((NS, "360 Deg"), damage="3x2.50000"), AT2, ("'3x2.50000'", "not a finite number")),
    "at2 velocity": (at2("NPTS= 64, DT= .01 SEC", title="VELOCITY TIME SERIES IN "), AT2, ("line 3", "acceleration")),
    "at2 step": (at2("NPTS= 64, DT= .01 SEC"), {**AT2, "File step": ".02"}, ("0.01 s", "Motion/File step is 0.02")),
    "velocity column": (columns("t,a_x,v_y,a_z\n", *THREE), {"File": "f"}, ("'v_y'", "velocity")),
    "velocity unit": (columns("t,x (cm/s),y (cm/s),z (cm/s)\n", *THREE), {"File": "f"}, ("'x (cm/s)'", "velocity")),
    "displacement": (columns("t,displacement x\n", NS), AT2, ("displacement", "not an acceleration")),
    "unknown column": (columns("t,a_x,a_y,temperature\n", *THREE), {"File": "f"}, ("'temperature'", "unknown")),
    "comment of velocity": (columns("# velocity in cm/s\n", NS), AT2, ("velocity", "accelerations")),
    "directions without azimuths": (columns("t,UD,NS,EW\n", UP, NS, EW), {"File": "f"}, ("'NS'", "Motion/Azimuths")),
    "twice": (columns("t,a_x,a_x,a_z\n", *THREE), {"File": "f"}, ("'a_x'", "direction of another")),
    "units": (columns("t,a_x (g),a_y (gal),a_z (g)\n", *THREE), {"File": "f"}, ("another unit than g",)),
    "no time": (columns("a_x,a_y,a_z,a_w\n", *THREE), {"File": "f"}, ("no column for the time",)),
    "column without step": (rows(NS, "%.4f", 1), AT2, ("1 column", "Motion/File step")),
    "decimal comma": (columns("t;a_x;a_y;a_z\n", *THREE, separator=";").replace(".", ","), {"File": "f"}, ("line 2", "decimal comma")),
    "other format": ("Seismogram 12\nstation A\n1 2 3\n", AT2, ("not a finite number", "known formats", "K-NET", "COSMOS")),
    "not perpendicular": (columns("t,EW,NS\n", EW, NS), {**TWO, "Azimuths": "x: 0; EW: 80"}, ("perpendicular",)),
    "unknown name": (columns("t,EW,NS\n", EW, NS), {**TWO, "Azimuths": "x: 0; HNE: 80"}, ("HNE", "EW, NS")),
    "no x": (columns("t,EW,NS\n", EW, NS), {**TWO, "Azimuths": "EW: 80"}, ("azimuth of the axis x",)),
    "knet empty": (knet([], duration=.001).replace("Memo.", "Memo. "), AT2, ("line 17", "states 0 values", "must be whole")),
    "esm half": (esm(NS, n=64.5), AT2, ("states 64.5 values", "must be whole")),
    "cosmos pressure": (cosmos_channel(NS, 90, quantity="pore pressure", units="kPa (60)"), AT2, ("no channel of acceleration",)),
    "smc one value": (smc(NS, n=1), AT2, ("states 1 values",)),
    "afad directions": (afad().replace("         E-W", "        Long"), TWO, ("line 12", "three directions")),
    "horizontal for z": (columns("t,EW\n", EW), {"File z": "f", "Unit": "gal", **EAST}, ("'EW'", "horizontal", "other direction")),
    "azimuths of axes": (columns("t,a_x,a_y,a_z\n", *THREE), TWO, ("'x'", "Name the columns by direction, as in NS, EW, or remove Azimuths")),
    "azimuths without names": (rows(NS, "%.4f", 1), {"File": "f", "File step": ".01", "Azimuths": "x: 0; f: 9; g: 8"}, ("'g'", "channels are f.")),
    "fewer headings": (columns("t,a_z,a_x\n", *THREE), {"File": "f"}, ("line 1", "3 headings, 4 columns")),
    "unknown unit": (columns("t,Acc. X (mg),Acc. Y (mg),Acc. Z (mg)\n", *THREE), {"File": "f"}, ("unit '(mg)' is unknown",)),
    "percent": (columns("t,Acc. [%]\n", NS), AT2, ("unit '[%]' is unknown",)),
    "u alone": (columns("t,u\n", NS), AT2, ("'u'", "displacement")),
    "no direction": (columns("t,a1,a2\n", EW, NS), TWO, ("unknown",)),
}


def sequence():
    """Azimuths by file hold for all parts of a sequence and all stations; files that begin at different times are refused."""
    write("scene.prm", SCENE.format(.01))
    for name, values in (("f", NS), ("g", EW)):
        write(name, rows(values, "%.4f", 1))
    settings = {"Sequence": "f; g", "File step": ".01", "Unit": "gal", "Azimuths": "x: 0; f: 0; g: 90"}
    shown = runs("motion", "scene.prm", "--output", "m.csv", *entries(settings))
    expect("(1 x)" in shown and "(-1 y)" in shown, shown)
    settings["Azimuths"] += "; h: 9"
    refused(["motion", "scene.prm", "--output", "none.csv", *entries(settings)], "'h'", "channels are f, g.")
    write("f", knet(NS))
    for k, text in enumerate((knet(EW, "E-W"), knet(EW, "E-W").replace("14:46:36", "14:46:37"))):
        write("g", text)
        command = ["motion", "scene.prm", "--output", "knet.csv", *entries({"File x": "f", "File y": "g", "Azimuths": "x: 0"})]
        if k == 0:
            runs(*command)
        else:
            refused(command, "14:46:37", "14:46:36", "same first time")


# The same spectrum as OpenQuake, USGS, PEER and codes give it: periods [s] and accelerations [g].
POINTS = ((.01, .25), (.05, .4), (.2, .55), (1., .15), (4., .03))
BANNER = "#,,,,,,,\"generated_by='OpenQuake engine 3.16.0', start_date='2023-05-14T10:44:47', checksum=2967670219, kind='mean', investigation_time=50.0\"\n"


def hazard(sites=1, shuffled=False):
    """Uniform hazard spectra of OpenQuake (kind uhs): two probabilities, the second one with twice the accelerations."""
    points = [(f"SA({t})" if t > .01 else "PGA", a) for t, a in POINTS]
    pairs = [(poe, name, f * a) for poe, f in (("0.1", 1), ("0.02", 2)) for name, a in (points[::-1] if shuffled else points)]
    return BANNER + "lon,lat," + ",".join(f"{poe}~{name}" for poe, name, a in pairs) + "\n" + "".join(
        f"{7 + k:.5f},46.20000," + ",".join(f"{(1 + k) * a:.6E}" for poe, name, a in pairs) + "\n" for k in range(sites))


def column(headings, factor=1., first="0.01", separator=","):
    return headings + "\n" + "".join(f"{t if k else first}{separator}{factor * a:.9g}\n" for k, (t, a) in enumerate(POINTS))


SEARCH = (" -- Summary of PEER Ground Motion Search Parameters --\nDamping Ratio:,5%\nSpectral Ordinate:,SRSS\n\n"
          " -- Summary of Metadata of Selected Records --\n Result ID, Record Sequence Number, Scale Factor, Earthquake Name\n1, 6, 1.25, Imperial Valley-02\n\n"
          " -- Scaled Spectra used in Search & Scaling --\n"
          "Period (sec), Target pSa (g), Arithmetic Mean pSa (g), Arithmetic Mean + Sigma pSa (g), RSN-6 Horizontal-1 pSa (g)\n"
          + "".join(f"{t}, {a}, 0.9, 0.8, 0.7\n" for t, a in POINTS) + "\n -- Unscaled Spectra --\nPeriod (sec), RSN-6 Horizontal-1 pSa (g)\n0.01, 0.6\n")
SPECTRA = {  # file, choice, parts of the note, first period [s]
    "uhs.csv": (hazard(), ": 0.1", ("OpenQuake '0.1'", "unit g", "damping ratio 0.05", "5 periods from 0 s to 4 s")),
    "sites.csv": (hazard(2, True), ":0.1 at 7 46.2", ("'0.1 at 7 46.2'",)),
    "usgs.csv": ("Edition,Dynamic: Conterminous U.S. 2014 (update)\nReturn Period,2475\n\n" + column('"Period (s)","Ground Motion (g)"', first="PGA"), "",
                 ("'Ground Motion (g)'", "unit g", "from 0 s")),
    "nshm.txt": (column("# 5 % damping\nPeriod Sa (g)", separator="\t"), "", ("from 0.01 s", "damping ratio 0.05")),
    "_SearchResults.csv": (SEARCH, "", ("PEER search 'Target pSa (g)'", "unit g", "damping ratio 0.05", "5 periods")),
    "code.csv": (column("T [s]; Sa [m/s\u00b2]", G, separator=";"), "", ("unit m/s^2", "not stated")),
    "gal.csv": (column("Period (s), PSA (gal)", 100 * G), "", ("unit cm/s^2",)),
    "percent.csv": (column("T (s), Sa (%g), Sv (cm/s)", 100).replace("\n", ",1\n").replace("/s),1", "/s)"), "", ("unit %g",)),
    "hertz.txt": ("Frequency (Hz) Sa (g)\n" + "".join(f"{1 / t:.9g} {a}\n" for t, a in reversed(POINTS)), "", ("unit g", "0.01 s to 4 s")),
    "plain.txt": (column("T Sa", separator=" "), "", ("unit g (assumed: the file has none)", "not stated"))}


def spectra():
    """Each file has the same spectrum."""
    write("record.csv", "t,a_x,a_y,a_z (g)\n" + "".join(f"{.01 * k:.2f},{a},{b},{c}\n" for k, (a, b, c) in enumerate(zip(signal(.3, 0), signal(.2, 3), signal(.1, 5)))))
    write("scene.prm", SCENE.format(.01))
    target = None
    for name, (text, choice, parts) in SPECTRA.items():
        write(name, text)
        shown = runs("motion", "scene.prm", "--output", "out.csv", *entries({"File": "record.csv", "Unit": "g", "Target spectrum": name + choice}))
        note = re.search("^target spectrum .*", shown, re.M)[0]
        expect(all(part in note for part in (name, *parts)), note)
        column_of_target = [line.split()[-1] for line in shown.split("target x\n")[1].splitlines()]
        target = target or column_of_target
        expect(column_of_target == target and target[2] == "0.550" and target[6] == "0.150", f"{name}: {column_of_target}, {target}")


def suite():
    """Factors and misfits against spectra of this script, and relations between records. The program has 20 steps per period, so that its
    spectra are up to 1 - cos(pi/20) = 1.2 % smaller."""
    coarse = 1 - math.cos(math.pi / 20)
    band, damping, count = (.2, 2.), .07, 100
    periods = [band[0] * (band[1] / band[0]) ** (k / count) for k in range(count + 1)]
    series = {"x": [0, *signal(3.125, 0, 199)], "y": [0, *signal(1.8, 3, 199)], "zero": [0] * 200}  # from rest
    spectra = {c: [peak_response(series[c], .01, t, damping) for t in periods] for c in "xy"}
    write("own.csv", "T (s), Sa (m/s2)\n" + "".join(f"{t:.15g}, {a:.12g}\n" for t, a in zip(periods, spectra["x"])))
    for name, f, unit, components in (("one.csv", 1, "m/s2", ("x", "zero", "zero")), ("two.csv", 2, "m/s2", ("x", "zero", "zero")),
                                      ("both.csv", 1, "m/s2", ("x", "y", "x")), ("gal.csv", 100, "cm/s2", ("x", "y", "x")), ("up.csv", 1, "m/s2", ("zero", "zero", "x"))):
        write(name, columns(f"t,a_x ({unit}),a_y ({unit}),a_z ({unit})\n", *([f * a for a in series[c]] for c in components)))
    write("own_g.csv", "T (s), Sa (g)\n" + "".join(f"{t:.15g}, {a / G:.14g}\n" for t, a in zip(periods, spectra["x"])))
    write("own_gal.csv", "f (Hz), Sa (cm/s2)\n" + "".join(f"{1 / t:.15g}, {100 * a:.14g}\n" for t, a in zip(periods, spectra["x"])))
    write("scene.prm", SCENE.format(.01))

    def rows_of_suite(ensemble, **more):
        shown = runs("motion", "scene.prm", "--output", "out.csv", *entries({
            "Ensemble": ensemble, "Target spectrum": "own.csv", "Match": "scale", "Match band": "0.2, 2", "Damping": damping, "Vertical ratio": .5, **more}))
        with open("suite.csv") as file:
            return shown, list(csv.DictReader(file))

    shown, (one, two, both, up) = rows_of_suite("one.csv; two.csv; both.csv; up.csv", Factor=-1.5)
    expect(one["name"] == "'one.csv'" and 1 <= float(one["factor"]) < 1 + coarse and float(one["misfit_after"]) < float(one["misfit_before"]) < 100 * coarse, f"{one}")
    expect(f"multiplied by {float(one['factor']):.6f}" in shown and "from 0.2 s to 2 s" in shown, shown)
    expect(abs(float(two["factor"]) / float(one["factor"]) - .5) < 1e-8 and abs(float(two["misfit_before"]) - 100 * math.log(2)) < 100 * coarse, f"{two}")
    expect(abs(float(up["factor"]) / float(one["factor"]) - .5) < 1e-8, f"the target of z: {up}")
    for name in list(one)[4:]:
        expect(math.isclose(float(one[name]), float(two[name]), rel_tol=1e-8, abs_tol=1e-12), f"{name} of a record and its double: {one[name]}, {two[name]}")
    close = {"peak_acceleration_x": 1.5 * max(map(abs, series["x"])) * float(one["factor"]), "rotd100_1": 1.5 * peak_response(series["x"], .01, 1., damping)}
    for name, value in close.items():
        expect(abs(float(one[name]) / value - 1) < coarse, f"{name}: {one[name]}, {value}")
    for row in table("out.csv")[1]:
        expect(abs(row[1] + 1.5 * float(one["factor"]) * series["x"][round(row[0] / .01)]) < 1e-6, f"{row}")
    logs = [math.log(target / a) for c in "xy" for target, a in zip(spectra["x"], spectra[c])]
    mean, square = (sum(x ** k for x in logs) / len(logs) for k in (1, 2))
    for name, value in (("factor", 100 * math.exp(mean)), ("misfit_before", 100 * math.sqrt(square)), ("misfit_after", 100 * math.sqrt(square - mean ** 2))):
        expect(abs((100 if name == "factor" else 1) * float(both[name]) - value) < 100 * coarse * max(1., math.exp(mean)), f"{name} of two components: {both[name]}, {value}")
    for target, file, unit in (("own_g.csv", "both.csv", "m/s^2"), ("own_gal.csv", "gal.csv", "cm/s^2")):
        other = rows_of_suite(file, Factor=-1.5, Unit=unit, **{"Target spectrum": target})[1][0]
        for name in list(both)[2:]:
            expect(math.isclose(float(both[name]), float(other[name]), rel_tol=1e-7, abs_tol=1e-9), f"{name} with {target}, {file}: {both[name]}, {other[name]}")
    raw = rows_of_suite("both.csv", Match="false", **{"Match band": "", "Target spectrum": ""})[1][0]
    expect(raw["factor"] == "1" and raw["misfit_before"] == raw["misfit_after"] == "", f"{raw}")
    write("code.csv", column("T (s), Sa (g)").replace("0.01,", "0,"))
    matched = rows_of_suite("both.csv", Match="true", **{"Match band": "", "Target spectrum": "code.csv"})[1][0]
    expect(float(matched["misfit_after"]) < 6 < 30 < float(matched["misfit_before"]), f"{matched}")


def bad():
    """Files with one error each: one paragraph, exit status 2."""
    write("scene.prm", SCENE.format(.01))
    for name, (text, settings, words) in BAD.items():
        Path("f").write_text(text)
        message = refused(["motion", "scene.prm", "--output", "none.csv", *entries(settings)], *words)
        expect(message.count("\n") == 1 and len(message) < 900, f"{name}: {message}")
    expect(not Path("none.csv").exists(), "a motion was written")


if __name__ == "__main__":
    run_cases(good, sequence, spectra, suite, bad)
