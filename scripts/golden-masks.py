#!/usr/bin/env python3
"""Writes src/display/tests/looking_glass.json: for each model of the Looking Glass family a calibration and the views of some pixels.

The views are computed with 60 digits from the formula that the public tools share (src/display/looking_glass.rs cites it), and share no code
with the crate. The numbers of the calibrations are typical of the model; no source has those of the 27" devices, so theirs are invented.
Run from the root of the repository; the result is the same each time.
"""
import json
import random
from decimal import Decimal, getcontext, ROUND_FLOOR

getcontext().prec = 60
SEED = 29
PIXELS = 40
# A pixel this near the border of two views is left out, in views.
MARGIN = Decimal("1e-6")

TALL = [[-0.25, -0.31, -0.25, 0.28, 0.25, 0.0], [0.25, -0.31, 0.25, 0.28, -0.25, 0.0]]
WIDE = [[-0.31, 0.25, 0.28, 0.25, 0.0, -0.25], [-0.31, -0.25, 0.28, -0.25, 0.0, 0.25]]
KEYS = ["ROffsetX", "ROffsetY", "GOffsetX", "GOffsetY", "BOffsetX", "BOffsetY"]

# model, serial number, quilt, pitch, slope, centre, cone, dpi, screen, cell pattern and cells
MODELS = [
    ("8.9", "LKG-2K-01234", (5, 9), 49.79978561401367, 5.48, 0.176902174949646, 40, 338, (2560, 1600), None),
    ("15.6", "LKG-4K-01234", (5, 9), 50.07143783569336, -7.7, 0.25, 40, 283, (3840, 2160), None),
    ("15.6", "LKG-A01234", (5, 9), 50.125, -7.0, 0.5, 40, 283, (3840, 2160), None),
    ("8k", "LKG-8K-01234", (5, 9), 38.0545883178711, -7.7, 0.0625, 40, 280, (7680, 4320), None),
    ("8k", "LKG-B01234", (5, 9), 42.0, -6.0, 0.3, 40, 280, (7680, 4320), None),
    ("portrait", "LKG-P01234", (8, 6), 52.594383239746094, -7.21152925491333, 0.40277382731437683, 40, 324, (1536, 2048), None),
    ("kiosk", "LKG-F01234", (11, 6), 52.0, -7.0, 0.5, 40, 324, (1536, 2048), None),
    ("65", "LKG-D01234", (8, 9), 42.0, -6.0, 0.3, 40, 136, (7680, 4320), None),
    ("go", "LKG-E01234", (11, 6), 80.74475016919882, -6.6587766801719095, 0.47708486403293315, 54, 491, (1440, 2560), None),
    ("16-landscape", "LKG-J01234", (7, 7), 44.72, -6.9, 0.5, 50, 283, (3840, 2160), (2, WIDE)),
    ("16-portrait", "LKG-H01234", (11, 6), 44.72, -7.45, 0.0, 50, 283, (2160, 3840), (4, TALL)),
    ("27-landscape", "LKG-?01234", (8, 6), 48.25, -7.1, 0.375, 50, 218, (5120, 2880), (2, WIDE)),
    ("27-portrait", "LKG-?01234", (12, 4), 48.25, -7.1, 0.375, 50, 218, (2880, 5120), (4, TALL)),
    ("32-landscape", "LKG-L01234", (7, 7), 75.0, -7.2, -0.2, 50, 280, (7680, 4320), None),
    ("32-portrait", "LKG-K01234", (11, 6), 80.7, -6.3, -0.3, 54, 280, (4320, 7680), (2, WIDE)),
]


def cell_of(mode, x, y):
    """The cell of a pixel; y from the bottom."""
    return {2: x % 2, 4: y % 2}[mode]


def views_at(model, x, row):
    """Views of R, G and B of a pixel, or None where one is too near a border."""
    _, _, (columns, rows), pitch, slope, centre, _, dpi, (width, height), cells = model
    count = columns * rows
    pitch, slope, centre = Decimal(pitch), Decimal(slope), Decimal(centre)
    lenses = pitch * width / dpi * abs(slope) / (1 + slope * slope).sqrt()
    tilt = Decimal(height) / (width * slope)
    y = height - 1 - row
    found = []
    for colour in range(3):
        dx, dy = Decimal(colour) / 3, Decimal(0)
        if cells:
            cell = cells[1][cell_of(cells[0], x, y)]
            dx, dy = Decimal(cell[2 * colour]), Decimal(cell[2 * colour + 1])
        u = (x + Decimal("0.5") + dx) / width
        v = (y + Decimal("0.5") + dy) / height
        z = (u + v * tilt) * lenses - centre
        place = (1 - (z - z.to_integral_value(ROUND_FLOOR))) * count
        view = place.to_integral_value(ROUND_FLOOR)
        if min(place - view, view + 1 - place) < MARGIN:
            return None
        found.append(int(view))
    return found


def calibration(model):
    _, serial, _, pitch, slope, centre, cone, dpi, (width, height), cells = model
    value = lambda number: {"value": number}
    device = {
        "configVersion": "3.0", "serial": serial, "pitch": value(pitch), "slope": value(slope), "center": value(centre),
        "viewCone": value(cone), "invView": value(1), "verticalAngle": value(0), "DPI": value(dpi), "screenW": value(width),
        "screenH": value(height), "flipImageX": value(0), "flipImageY": value(0), "flipSubp": value(0),
    }
    if cells:
        device["CellPatternMode"] = value(cells[0])
        device["subpixelCells"] = [dict(zip(KEYS, cell)) for cell in cells[1]]
    return device


def main():
    chosen = random.Random(SEED)
    out = []
    for model in MODELS:
        width, height = model[8]
        corners = [(0, 0), (width - 1, 0), (0, height - 1), (width - 1, height - 1)]
        places = corners + [(chosen.randrange(width), chosen.randrange(height)) for _ in range(PIXELS)]
        pixels = [(x, row, views_at(model, x, row)) for x, row in places]
        out.append({
            "model": "looking-glass-" + model[0], "quilt": model[2], "calibration": calibration(model),
            "pixels": [[x, row, *views] for x, row, views in pixels if views],
        })
    lines = ",\n".join(json.dumps(entry) for entry in out)
    with open("src/display/tests/looking_glass.json", "w") as file:
        file.write("[\n" + lines + "\n]\n")


main()
