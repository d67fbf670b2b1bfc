"""A program in ten lines: angle and bulk density from formulas, with random scatter. run.py FOLDER"""
import json, math, pathlib, random, sys

folder = pathlib.Path(sys.argv[1])
run = json.loads((folder / "run.json").read_text())
sliding, rolling = run["parameters"]["sliding"], run["parameters"]["rolling"]
chance = random.Random(run["seed"])
angle = 6 + 52 * math.sqrt(sliding * (rolling + 0.05)) + chance.gauss(0, run["settings"]["scatter_deg"])
density = 860 - 120 * sliding - 40 * rolling + chance.gauss(0, 2)
(folder / "reading.json").write_text(json.dumps({"aor": angle, "density": density}))
