"""The output of repose calibrate conforms to the schema: schema_test.py REPOSE SCHEMA"""

import copy
import json
import pathlib
import signal
import subprocess
import sys
import tempfile

import jsonschema

# A soft ball, which takes seconds to run.
BALL = """
[particle]
size_mm = [20, 20, 20]
spheres = 1
density_kg_m3 = 1000
young_modulus_pa = 2e6
poisson_ratio = 0.3
[wall]
young_modulus_pa = 1e8
poisson_ratio = 0.3
"""
STUDIES = {
    # A drop determines restitution and a tilting plate friction.
    "joint": BALL
    + """
[contact.particle_wall]
restitution = { min = 0.2, max = 0.9, mean = 0.5, sd = 0.3 }
sliding_friction = { min = 0.1, max = 0.8 }
rolling_friction = 0.01
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.2
rolling_friction = 0.04
[experiment.drop]
height_mm = 100
grains = 1
measured = { mean = 25, sd = 1, n = 5 }
[experiment.tilt]
rate_deg_s = 10
measured = { values = [20.1, 21.3, 20.7, 19.8] }
""",
    # The published method needs all six coefficients and all four experiments; balls, or fewer
    # grains, would form a single layer, which has no angle.
    "paper": BALL.replace("[20, 20, 20]", "[24, 16, 15]").replace("spheres = 1", "spheres = 3")
    + """
[contact.particle_wall]
restitution = { min = 0.2, max = 0.9 }
sliding_friction = { min = 0.1, max = 0.8 }
rolling_friction = { min = 0.01, max = 0.2 }
[contact.particle_particle]
restitution = { min = 0.05, max = 0.9 }
sliding_friction = { min = 0.4, max = 0.8 }
rolling_friction = { min = 0.1, max = 0.4 }
[experiment.drop]
height_mm = 100
grains = 1
measured = { mean = 25, sd = 1, n = 5 }
[experiment.tilt]
rate_deg_s = 10
measured = { values = [20.1, 21.3, 20.7, 19.8] }
[experiment.roll]
measured = { mean = 320, sd = 30, n = 10 }
[experiment.heap]
tube_diameter_mm = 100
tube_height_mm = 600
lift_speed_mm_s = 400
plate_mm = 400
grains = 220
measured = { mean = 25, sd = 1, n = 5 }
""",
}
# Runs of another program, as a table: y = 2 x + z, two runs per row.
TABLE = """
[parameter]
x = { min = 0, max = 1 }
z = { min = 0, max = 1, bounds = "known" }
[measured]
y = { mean = 1.5, sd = 0.2, n = 4 }
w = { mean = 1, sd = 0.1, n = 1, held_out = true }
"""
ROWS = "x,z,y,y_sd,w,n\n" + "".join(
    f"{x},{z},{2 * x + z + .01 * ((3 * x + 7 * z) % 1)},.02,{x * z + x},2\n"
    for x in (.1, .35, .6, .85) for z in (.05, .3, .7, .95)) + "1,1,NaN,,,1\n"
# Keys that may be missing from a result.
OPTIONAL = {"size_sd_percent", "known_before", "simulated", "extent", "additions", "candidates", "held_out",
            "stiffness_checks", "stiffer_coefficients", "shape_check", "narrowing", "heap_definition", "assumed",
            "systematic_uncertainty", "assumed_inputs", "with_assumed", "inputs_taken_as_exact",
            "degrees_of_freedom", "model_error_scale", "model_uncertainty", "model_sd",
            "assumed_scatter", "bench_correlation", "bounds_are", "useful_half_width", "systematic",
            "tolerance_from", "readings_to_decide", "possible", "hour", "checked_at", "repeats", "repeat_sd",
            "reading_sd", "engine", "coarse", "full_size", "size", "mixed", "grain_size", "provisional"}


def undescribed(schema, place="schema"):
    """The path of every key of the schema that has no description."""
    missing = []
    if isinstance(schema, dict):
        for name, part in schema.get("properties", {}).items():
            if not part.get("description"):
                missing.append(f"{place}.{name}")
        for key, part in schema.items():
            missing += undescribed(part, f"{place}.{key}")
    elif isinstance(schema, list):
        for part in schema:
            missing += undescribed(part, place)
    return missing


def open_objects(schema, place="schema"):
    """Objects that accept unknown keys."""
    found = []
    if isinstance(schema, dict):
        if "properties" in schema and isinstance(schema["properties"], dict):
            if schema.get("additionalProperties") is not False:
                found.append(place)
        for key, part in schema.items():
            found += open_objects(part, f"{place}.{key}")
    elif isinstance(schema, list):
        for part in schema:
            found += open_objects(part, place)
    return found


def unrequired(schema, place="schema"):
    """Keys that the schema does not require although it should."""
    found = []
    if isinstance(schema, dict):
        if isinstance(schema.get("properties"), dict):
            for key in set(schema["properties"]) - set(schema.get("required", [])) - OPTIONAL:
                found.append(f"{place}.{key}")
        for key, part in schema.items():
            found += unrequired(part, f"{place}.{key}")
    elif isinstance(schema, list):
        for part in schema:
            found += unrequired(part, place)
    return found


def result_of(repose, method):
    """The result of repose calibrate."""
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "study.toml"
        study.write_text(STUDIES[method], encoding="utf-8")
        subprocess.run(
            [repose, "calibrate", str(study), "--method", method, "--out", folder],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        return json.loads((pathlib.Path(folder) / "result.json").read_text(encoding="utf-8"))


def result_of_table(repose):
    """The result of repose calibrate --runs."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "table.toml").write_text(TABLE, encoding="utf-8")
        (folder / "rows.csv").write_text(ROWS, encoding="utf-8")
        subprocess.run([repose, "calibrate", "table.toml", "--runs", "rows.csv", "--out", "out"], cwd=folder,
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads((folder / "out/result.json").read_text(encoding="utf-8"))


def interrupted_result(repose):
    """What a study leaves that is interrupted after its first round."""
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "study.toml"
        study.write_text(STUDIES["joint"], encoding="utf-8")
        command = [repose, "calibrate", str(study), "--budget", "standard", "--jobs", "1", "--out", folder]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as running:
            for line in running.stderr:
                if "after round 1" in line:
                    running.send_signal(signal.SIGINT)
                    break
            running.stderr.read()
        result = json.loads((pathlib.Path(folder) / "result.json").read_text(encoding="utf-8"))
        assert "provisional" in result, "the study ended before it could be interrupted"
        return result


def check(schema, result, method):
    """Checks the result of one method against its branch of the schema, so that errors are specific."""
    validator = jsonschema.Draft202012Validator(
        {"$ref": f"#/$defs/{method}", "$defs": schema["$defs"]}
    )
    errors = [f"{error.json_path}: {error.message[:300]}" for error in validator.iter_errors(result)]
    assert not errors, errors
    assert jsonschema.Draft202012Validator(schema).is_valid(result)
    for key in result.keys() - OPTIONAL:
        broken = copy.deepcopy(result)
        del broken[key]
        assert not validator.is_valid(broken), key
    broken = copy.deepcopy(result)
    broken["unheard_of"] = 1
    assert not validator.is_valid(broken)


def main(repose, schema_file):
    schema = json.loads(pathlib.Path(schema_file).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    assert not undescribed(schema), undescribed(schema)
    assert not open_objects(schema), open_objects(schema)
    assert not unrequired(schema), unrequired(schema)
    for method in STUDIES:
        check(schema, result_of(repose, method), method)
    check(schema, interrupted_result(repose), "joint")
    check(schema, result_of_table(repose), "joint")
    print("results of both methods and of a table are as the schema says")


main(*sys.argv[1:])
