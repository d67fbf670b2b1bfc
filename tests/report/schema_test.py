"""What repose calibrate writes is what the schema describes: schema_test.py REPOSE SCHEMA"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

# A soft ball whose restitution a drop tells and whose friction a tilting plate: seconds to run.
STUDY = """
[particle]
size_mm = [20, 20, 20]
spheres = 1
density_kg_m3 = 1000
young_modulus_pa = 1e6
poisson_ratio = 0.3
[wall]
young_modulus_pa = 1e8
poisson_ratio = 0.3
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
"""


def undescribed(schema, place="schema"):
    """Every key of the schema without a description, as text."""
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
    """Objects that let unknown keys through."""
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


def main(repose, schema_file):
    schema = json.loads(pathlib.Path(schema_file).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    assert not undescribed(schema), undescribed(schema)
    assert not open_objects(schema), open_objects(schema)
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "study.toml"
        study.write_text(STUDY, encoding="utf-8")
        subprocess.run(
            [repose, "calibrate", str(study), "--out", folder, "--json", str(study) + ".json"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        result = json.loads((pathlib.Path(folder) / "result.json").read_text(encoding="utf-8"))
    # The joint branch alone: its faults are named, those of "one of two" are not.
    branch = {"$ref": f"#/$defs/{result['method']}", "$defs": schema["$defs"]}
    validator = jsonschema.Draft202012Validator(branch)
    faults = [f"{error.json_path}: {error.message[:300]}" for error in validator.iter_errors(result)]
    assert not faults, faults
    assert jsonschema.Draft202012Validator(schema).is_valid(result)
    for key in ("parameters", "provenance"):
        broken = copy.deepcopy(result)
        del broken[key]
        assert not validator.is_valid(broken), key
    broken = copy.deepcopy(result)
    broken["unheard_of"] = 1
    assert not validator.is_valid(broken)
    print("the result is as the schema says")


main(*sys.argv[1:])
