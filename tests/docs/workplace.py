"""Creates the files that the documents' commands read, in a separate folder."""

import math
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import zlib

import documents

PHOTOGRAPHS = {"heap_01.jpg": "heap_01.jpg", "heap_02.jpg": "heap_02.jpg",
               "photo.jpg": "heap_02.jpg", "my_heap.jpg": "heap_03.jpg"}

DROPS = "drop_mm,rebound_mm\n500,9.1\n500,9.6\n500,9.4\n"

# The same plane on two days, one of which gives angles 2 degrees smaller.
TWO_DAYS = """mu_s,mu_r,Day,angle_deg
.1,.01,Mon,18.2
.3,.05,Mon,28.1
.2,.03,Mon,23.1
.2,.03,Mon,22.8
.1,.05,Tue,19.9
.3,.01,Tue,22.3
.2,.03,Tue,21.1
.2,.03,Tue,20.7
"""

# A plane in two factors with some scatter, at three levels of each.
RUNS = """mu_s,mu_r,angle_deg
.1,.01,18.1
.1,.05,21.9
.3,.01,24.2
.3,.05,28.3
.2,.03,23.2
.2,.03,22.9
.2,.01,21.1
.2,.05,25.0
.1,.03,20.2
.3,.03,26.1
"""


def ellipsoid(half_axes_mm, rings=16, sectors=24):
    """The triangles of a closed surface, each as three vertices."""
    def point(ring, sector):
        polar, azimuth = math.pi * ring / rings, 2 * math.pi * (sector % sectors) / sectors
        if ring in (0, rings):
            return (0.0, 0.0, half_axes_mm[2] * (1 if ring == 0 else -1))
        return (half_axes_mm[0] * math.sin(polar) * math.cos(azimuth),
                half_axes_mm[1] * math.sin(polar) * math.sin(azimuth),
                half_axes_mm[2] * math.cos(polar))

    for ring in range(rings):
        for sector in range(sectors):
            a, b = point(ring, sector), point(ring + 1, sector)
            c, d = point(ring + 1, sector + 1), point(ring, sector + 1)
            if ring < rings - 1:
                yield a, b, c
            if ring > 0:
                yield a, c, d


def stl_of(triangles):
    lines = ["solid nut"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x:.6f} {y:.6f} {z:.6f}" for x, y, z in corners]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid nut", ""])


def cone_ply(angle_deg=27, height=80, half_side=260, points=90_000):
    """A cone on the ground, as a point cloud in millimetres, from a sequence that fills a square evenly."""
    golden = 1.32471795724474602596
    slope = math.tan(math.radians(angle_deg))
    body = bytearray()
    for k in range(points):
        x = (2 * ((k / golden) % 1) - 1) * half_side
        y = (2 * ((k / golden ** 2) % 1) - 1) * half_side
        body += struct.pack("<3f", x, y, max(0, height - slope * math.hypot(x, y)))
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {points}",
              "property float x", "property float y", "property float z", "end_header", ""]
    return "\n".join(header).encode() + body


def silhouette_png(width=960, height=640, slope=0.45):
    """A black heap with straight flanks on white, as drawn by repose render."""
    foot = height - 120
    top = foot - int(0.4 * width * slope)
    rows = bytearray()
    for y in range(height):
        half = int((y - top) / slope) if top <= y < foot else 0
        white = width // 2 - half
        rows += b"\0" + b"\xff" * white + b"\0" * (2 * half) + b"\xff" * (width - white - 2 * half)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b""))


def dropped_height_mm(t, restitution):
    """Height of a grain that is held for a tenth of a second, falls 200 mm and bounces."""
    gravity, held_s = 9806.65, 0.1
    speed = math.sqrt(2 * gravity * 200)
    t -= held_s
    if t <= 0:
        return 200.0
    if t < speed / gravity:
        return 200 - gravity * t * t / 2
    t -= speed / gravity
    speed *= restitution
    while t > 2 * speed / gravity and speed > 1:
        t -= 2 * speed / gravity
        speed *= restitution
    return max(0.0, speed * t - gravity * t * t / 2)


def dropped_grain_avi(restitution, mm_per_px=2.6, frames_per_s=60):
    return grain_avi(lambda k: (60 + 0.2 * k, dropped_height_mm(k / frames_per_s, restitution) / mm_per_px),
                     frames_per_s)


def rolled_grain_avi(frames_per_s=60, slope=math.radians(20)):
    """A grain released after 6 frames that reaches the flat after 20 more and rests after 20 more."""
    def place(k):
        k = max(0, k - 6)
        left = 50 * max(0.0, 1 - (k / 20) ** 2)
        out = 50 * (1 - max(0.0, 1 - max(0, k - 20) / 20) ** 2)
        return 70 - left * math.cos(slope) + out, left * math.sin(slope)

    return grain_avi(place, frames_per_s, frames=80)


def tilted_plate_avi(frames_per_s=30, width=160, height=120, rate=math.radians(8), onset=math.radians(12)):
    """A bar on a plate that turns about its left end from frame 10 on; the bar finally slides towards it."""
    hinge_x, hinge_y = 10.0, 100.0

    def cover(inside):
        return min(1.0, max(0.0, inside + 0.5))

    def frame(k):
        t = max(0, k - 10) / frames_per_s
        c, s = math.cos(rate * t), math.sin(rate * t)
        slid = 300 * max(0.0, t - onset / rate) ** 2
        rows = []
        for y in range(height):
            row = bytearray(bytes([190, 200, 205]) * width)
            up = hinge_y - y - 0.5
            for x in range(width):
                right = x + 0.5 - hinge_x
                along, above = right * c + up * s, -right * s + up * c
                if not -7 < above < 10:
                    continue
                bar = cover(min(above, 9 - above, 10 - abs(along - 90 + slid)))
                plate = cover(min(-above, above + 6, along, 140 - along))
                for channel, (dark, grey) in enumerate(((40, 90), (60, 100), (90, 110))):
                    wall = row[3 * x + channel]
                    row[3 * x + channel] = round((wall * (1 - bar) + dark * bar) * (1 - plate) + grey * plate)
            rows.append(row)
        return b"".join(reversed(rows))

    return avi(frame, frames_per_s, width, height, frames=68)


def grain_avi(place, frames_per_s, width=160, height=120, frames=60):
    """A dark disc in front of a light wall; `place` gives its position to the right and above the floor."""
    radius = 5.0
    floor = height - 14

    def frame(k):
        rows = [bytearray(bytes([190, 200, 205]) * width if y < floor else bytes([70, 90, 110]) * width)
                for y in range(height)]
        x0, up = place(k)
        y0 = floor - radius - up
        for y in range(max(0, int(y0 - radius) - 1), min(height, int(y0 + radius) + 2)):
            for x in range(int(x0 - radius) - 1, int(x0 + radius) + 2):
                cover = min(1.0, max(0.0, radius + 0.5 - math.hypot(x + 0.5 - x0, y + 0.5 - y0)))
                for c, dark in enumerate((40, 60, 90)):
                    rows[y][3 * x + c] = round(rows[y][3 * x + c] * (1 - cover) + dark * cover)
        return b"".join(reversed(rows))

    return avi(frame, frames_per_s, width, height, frames)


def grown_heap_avi(frames_per_s=10, width=320, height=200, slope=0.45):
    """A black heap on white that grows in four frames and then rests."""
    foot = height - 40

    def frame(k):
        top = foot - int(0.4 * width * slope * min(1.0, 0.4 + 0.15 * k))
        rows = []
        for y in range(height):
            half = int((y - top) / slope) if top <= y < foot else 0
            white = b"\xff" * (3 * (width // 2 - half))
            rows.append(white + b"\0" * (6 * half) + white)
        return b"".join(reversed(rows))

    return avi(frame, frames_per_s, width, height, frames=18)


def avi(frame, frames_per_s, width, height, frames):
    """An uncompressed film; `frame` returns the rows from the bottom up, in blue, green and red."""
    def chunk(kind, data):
        return kind + struct.pack("<I", len(data)) + data

    def chunks(kind, data):
        return chunk(b"LIST", kind + data)

    size = 3 * width * height
    main = struct.pack("<14I", 1000000 // frames_per_s, size * frames_per_s, 0, 0, frames, 0, 1, size, width,
                       height, 0, 0, 0, 0)
    stream = b"vidsDIB " + struct.pack("<5I", 0, 0, 0, 1, frames_per_s) + struct.pack(
        "<5I4H", 0, frames, size, 0, 0, 0, 0, width, height)
    bitmap = struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, size, 0, 0, 0, 0)
    header = chunks(b"hdrl", chunk(b"avih", main)
                    + chunks(b"strl", chunk(b"strh", stream) + chunk(b"strf", bitmap)))
    film = chunks(b"movi", b"".join(chunk(b"00db", frame(k)) for k in range(frames)))
    return chunk(b"RIFF", b"AVI " + header + film)


def packed_cone(angle_deg, height=30.0, radius=2.0):
    """Spheres in close-packed, wavy layers in a cone on a plate, slightly displaced: x, y, z in mm."""
    chance = random.Random(7)
    spheres, layer, z = [], 0, radius
    while z < height:
        reach = (height - z + radius) / math.tan(math.radians(angle_deg)) - radius
        rows = int(reach / (math.sqrt(3) * radius)) + 1
        for j in range(-rows, rows + 1):
            for i in range(-2 * rows, 2 * rows + 1):
                x = 2 * radius * (i + 0.5 * (j % 2)) + layer % 2 * radius
                y = math.sqrt(3) * radius * (j + layer % 2 / 3)
                if math.hypot(x, y) <= reach:
                    wave = 2 * min(1, (z - radius) / 20) * math.sin(x / 9 + 1) * math.cos(y / 8)
                    spheres.append((x + chance.uniform(-0.1, 0.1), y + chance.uniform(-0.1, 0.1), z + wave))
        layer, z = layer + 1, z + 2 * radius * math.sqrt(2 / 3)
    return spheres


def particle_csv(spheres, radius=2.0):
    rows = [f"{x:.4f},{y:.4f},{z:.4f},{radius}" for x, y, z in spheres]
    return "\n".join(["x [mm],y [mm],z [mm],radius [mm]", *rows, ""])


def particle_vtu(spheres, radius=0.002):
    places = " ".join(f"{x / 1e3:.7f} {y / 1e3:.7f} {z / 1e3:.7f}" for x, y, z in spheres)

    def array(name, parts, text):
        return f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{parts}" format="ascii">{text}</DataArray>'

    return (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">'
            f'<UnstructuredGrid><Piece NumberOfPoints="{len(spheres)}" NumberOfCells="0"><PointData>'
            + array("radius", 1, " ".join([str(radius)] * len(spheres))) + "</PointData><Points>"
            + array("Points", 3, places) + "</Points></Piece></UnstructuredGrid></VTKFile>\n")


# Possible bench readings by column; the protocol's numbers are those of a new study.
BENCH = {"drop_mm": (500, 500, 500), "rebound_mm": (150, 162, 156), "angle_deg": (17.4, 18.1, 17.9),
         "incline_deg": (20, 20, 20), "released_mm": (150, 150, 150), "stopped_mm": (410, 440, 425)}


def go_to_the_bench(study):
    """Fills in the sheets of a new study, and makes it run in seconds: soft grains and no heap."""
    for sheet in study.with_suffix("").glob("*.csv"):
        columns = sheet.read_text(encoding="utf-8").split()[0].split(",")
        rows = [",".join(str(BENCH[column][row]) for column in columns) for row in range(3)]
        sheet.write_text("\n".join([",".join(columns), *rows, ""]), encoding="utf-8")
    text = study.read_text(encoding="utf-8").partition("[experiment.heap]")[0]
    before, pair, after = text.partition("[contact.particle_particle]")
    text = before + pair + re.sub(r"{ value = ([\d.]+),.*}", r"\1", after)
    text = re.sub(r"young_modulus_pa = 1e8", "young_modulus_pa = 1e6", text)
    text = re.sub(r"spheres = \d+", "spheres = 1", text)
    study.write_text(text, encoding="utf-8")


def environment(repose):
    """An environment in which `repose` is the program under test."""
    folder = str(pathlib.Path(repose).resolve().parent)
    return {**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"]}


def prepare(folder, root, repose):
    """Fills a folder with samples of everything that the documents name as input."""
    samples = root / "samples"
    (folder / "samples").symlink_to(samples)
    (folder / "photos").mkdir()
    for name in ("heap_01.jpg", "heap_02.jpg"):
        shutil.copy(samples / "hazelnut/photos" / name, folder / "photos" / name)
    for name, photograph in PHOTOGRAPHS.items():
        shutil.copy(samples / "hazelnut/photos" / photograph, folder / name)
    study = pathlib.Path(__file__).with_name("study.toml").read_text(encoding="utf-8")
    for name in ("study.toml", "my_study.toml"):
        (folder / name).write_text(study, encoding="utf-8")
    (folder / "nut.stl").write_text(stl_of(ellipsoid((11.2, 9.1, 8.7))), encoding="utf-8")
    (folder / "render.png").write_bytes(silhouette_png())
    (folder / "heap.ply").write_bytes(cone_ply())
    (folder / "scans").mkdir()
    for angle_deg in (26, 28):
        (folder / "scans" / f"heap_{angle_deg}.ply").write_bytes(cone_ply(angle_deg))
    (folder / "particles.csv").write_text(particle_csv(packed_cone(25)), encoding="utf-8")
    (folder / "heap.vtu").write_text(particle_vtu(packed_cone(25)), encoding="utf-8")
    (folder / "heap.avi").write_bytes(grown_heap_avi())
    (folder / "drop_01.avi").write_bytes(dropped_grain_avi(0.6))
    (folder / "drop_02.avi").write_bytes(dropped_grain_avi(0.5))
    (folder / "roll_01.avi").write_bytes(rolled_grain_avi())
    (folder / "tilt_01.avi").write_bytes(tilted_plate_avi())
    (folder / "drops.csv").write_text(DROPS, encoding="utf-8")
    (folder / "runs.csv").write_text(RUNS, encoding="utf-8")
    (folder / "two_days.csv").write_text(TWO_DAYS, encoding="utf-8")
    engines = documents.Document(root / "docs/engines.md", root)
    for language, names in (("toml", ["grain.toml", "seen.toml", "command.toml"]), ("python", ["run.py"]),
                            ("csv", ["grain_runs.csv", "seen_runs.csv", "grain_points.csv"])):
        blocks = [block for block in engines.blocks if block.language == language]
        for name, block in zip(names, blocks):
            (folder / name).write_text("\n".join([*(line.text for line in block.lines), ""]), encoding="utf-8")
    (folder / "heaps").mkdir()
    for run in range(1, 7):
        spheres = packed_cone(12 + 4 * run, height=24)
        (folder / f"heaps/run_{run}.csv").write_text(particle_csv(spheres), encoding="utf-8")
    for name, out in (("study.toml", "hazelnut"), ("my_study.toml", "my_study_calibration")):
        subprocess.run([repose, "calibrate", name, "--out", out], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
