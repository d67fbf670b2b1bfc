"""A heap in LIGGGHTS: run.py FOLDER fills in the deck, runs it there, and names its spheres as the reading."""
import json
import math
import pathlib
import string
import subprocess
import sys

SIDES = 48


def tube_stl(radius, bottom, top):
    """A tube around the z axis, made of flat sides."""
    lines = ["solid tube"]
    places = [(radius * math.cos(2 * math.pi * k / SIDES), radius * math.sin(2 * math.pi * k / SIDES))
              for k in range(SIDES + 1)]
    for (x1, y1), (x2, y2) in zip(places, places[1:]):
        low1, low2, high1, high2 = (x1, y1, bottom), (x2, y2, bottom), (x1, y1, top), (x2, y2, top)
        for corners in ((low1, low2, high2), (low1, high2, high1)):
            lines += ["facet normal 0 0 0", "outer loop",
                      *("vertex {:.7g} {:.7g} {:.7g}".format(*corner) for corner in corners),
                      "endloop", "endfacet"]
    return "\n".join([*lines, "endsolid tube", ""])


def prime_above(number):
    """LIGGGHTS accepts only primes above 10000 as seeds."""
    while any(number % divisor == 0 for divisor in range(2, math.isqrt(number) + 1)):
        number += 1
    return number


folder = pathlib.Path(sys.argv[1])
run = json.loads((folder / "run.json").read_text(encoding="utf-8"))
values = {**run["settings"], **run["parameters"], "seed": prime_above(20000 + 97 * run["seed"])}
deck = string.Template(pathlib.Path(__file__).with_name("heap.lig").read_text(encoding="utf-8"))
(folder / "heap.lig").write_text(deck.substitute(values), encoding="utf-8")
(folder / "tube.stl").write_text(tube_stl(values["tube_radius_m"], 0.0005, 0.36), encoding="utf-8")
subprocess.run(["liggghts", "-in", "heap.lig", "-log", "heap.log"], cwd=folder, check=True)
(folder / "reading.json").write_text(json.dumps({"aor": "heap.dump"}), encoding="utf-8")
