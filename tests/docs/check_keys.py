"""Keys of the program's JSON and of study files are documented: check_keys.py REPOSE"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

import documents
import workplace

# Objects whose keys are names of factors, coefficients, observables or experiments.
OPEN = {"effects", "interval_widths", "determined", "levels", "coded", "ranges", "direction", "values", "parameters", "sd", "simulated", "checked_at",
        "stiffness_factor", "shortest_timestep_s", "definitions_deg", "simulated_deg", "repeat_sd", "reading_sd"}
# Commands by the heading in json.md under which their output is described. (repose verify is left out
# because it takes long.)
OUTPUTS = {
    "measure": ["measure photos --json - --threads 2", "measure heap.avi --every 0.5 --json -",
                "measure heap.ply --unit mm --json -", "measure particles.csv --json -"],
    "measure#summary": ["measure photos --summary -"],
    "compare": ["compare photo.jpg render.png --json -"],
    "compare of sets": ["compare photos render.png --json -"],
    "track": ["track drop drop_01.avi --scale 20,10,20,90,208 --json -",
              "track roll roll_01.avi --released 150 --json -",
              "track tilt tilt_01.avi --json -"],
    "shape": ["shape --size-mm 20,18,17 --density-kg-m3 900 --json -"],
    "simulate": ["simulate fill study.toml --repeats 2 --set experiment.fill.taps=1 --json -",
                 "simulate drop study.toml --set contact.particle_wall.restitution_exponent=0.1 "
                 "--set contact.particle_wall.restitution_speed_m_s=1 --json -",
                 "simulate heap study.toml --views 2 --json -"],
    "render": ["render state/heap_seed_1.vtp --size 640,360 --out heap.png --truth -"],
    "bench": ["bench sliding --set angle_deg=22.1,22.9 --json -"],
    "regress": ["regress runs.csv --response angle_deg --target 23 --json -"],
    "export": ["export hazelnut --to edem --json -"],
    "plan": ["plan drops.toml --experiments pendulum --minutes 0.1 --out planned --json -"],
    "calibrate": ["calibrate study.toml --out hazelnut --json -", "calibrate study.toml --dry-run --json -",
                  "calibrate grain.toml --runs grain_runs.csv --json -",
                  "calibrate command.toml --json -"],
    "predict": ["predict grain.toml --runs grain_runs.csv --at grain_points.csv --json -"],
}
SECTIONS = ["study", "particle", "wall", "wall.tube", "contact", "contact.particle_wall", "contact.particle_wall.restitution",
            "experiment", "experiment.heap.measured", "experiment.drop.measured", "simulation", "uncertainty"]


def experiments(repose, folder):
    """Names of all experiments, which the program lists when given an unknown one."""
    done = subprocess.run([repose, "simulate", "unheard_of", "study.toml"], cwd=folder, capture_output=True, text=True)
    return re.findall(r"\w+", done.stderr.partition("Fix: ")[2].replace(" or ", ", "))


def simulations(names):
    """A run of each experiment missing from OUTPUTS, as in the study or with default numbers."""
    listed = {command.split()[1] for command in OUTPUTS["simulate"]}
    return [f"simulate {name} study.toml --repeats 2 --set experiment.{name}.stiffness_factor=1 --json -"
            for name in names if name not in listed]


def keys_in(value):
    """All keys of a JSON value except those of open objects."""
    if isinstance(value, list):
        for item in value:
            yield from keys_in(item)
    elif isinstance(value, dict):
        for key, item in value.items():
            yield key
            if key not in OPEN or not isinstance(item, dict):
                yield from keys_in(item)


def keys_of_schema(part):
    """All keys that a JSON Schema defines."""
    if isinstance(part, dict):
        if isinstance(part.get("properties"), dict):
            yield from part["properties"]
        part = list(part.values())
    if isinstance(part, list):
        for item in part:
            yield from keys_of_schema(item)


def words_under(document, heading=None):
    """All words in code spans and headings, below one heading or everywhere."""
    words = set()
    is_there = heading is None
    for line in document.lines:
        found = documents.HEADING.match(line.text)
        if found and heading is not None and line.text.startswith("## "):
            is_there = documents.anchor_of(found[1]) == heading
        if is_there:
            if found:
                words.update(re.findall(r"\w+", found[1]))
            for span in documents.SPAN.findall(line.text):
                words.update(re.findall(r"\w+", span))
    return words


def errors_of_outputs(document, folder, repose, names):
    outputs = {**OUTPUTS, "simulate": OUTPUTS["simulate"] + simulations(names)}
    for output, commands in outputs.items():
        heading = output.partition("#")[0]
        known = words_under(document, documents.anchor_of(heading))
        if heading == "calibrate":
            known |= words_under(document, "regress") | words_under(document, "simulate")
        for command in commands:
            done = subprocess.run([repose, *command.split()], cwd=folder, capture_output=True, text=True)
            if done.returncode != 0:
                yield f"repose {command}: exit code {done.returncode}\n{done.stderr}"
                continue
            for key in sorted(set(keys_in(json.loads(done.stdout))) - known):
                yield f"{document.name}: ## {heading} does not explain {key}, written by repose {command}"


def errors_of_schema(document, root):
    schema = json.loads((root / "calibrate/report/result.schema.json").read_text(encoding="utf-8"))
    known = words_under(document, "calibrate") | words_under(document, "regress")
    for key in sorted(set(keys_of_schema(schema)) - known):
        yield f"{document.name}: ## calibrate does not explain {key} of result.schema.json"


def errors_of_studies(document, folder, repose, names):
    """Relies on the program listing the keys of a section when given an unknown one."""
    words = words_under(document)
    experiment_sections = [f"experiment.{name}" for name in names]
    also = [f"{section}.also_measured" for section in experiment_sections]  # those that have any
    settings = [word for section in SECTIONS + experiment_sections + also for word in ("--set", f"{section}.unheard_of=1")]
    done = subprocess.run([repose, "simulate", "drop", "study.toml", *settings], cwd=folder,
                          capture_output=True, text=True)
    listed = dict(re.findall(r"keys of \[([\w.]*)\] are ([\w, ]+)", done.stderr))
    headings = {found[1] for line in document.lines if (found := documents.HEADING.match(line.text))}
    for name in names:
        if f"experiment.{name}" not in headings:
            yield f"{document.name}: the experiment {name} has no section"
    for section in SECTIONS + experiment_sections + [section for section in also if section in listed]:
        if section not in listed:
            yield f"repose does not list the keys of [{section}]: {done.stderr}"
            continue
        for key in sorted(set(re.findall(r"\w+", listed[section])) - words):
            yield f"{document.name}: {key} of [{section}] is not explained"


def main(repose):
    root = documents.root_folder()
    texts = {document.name: document for document in documents.user_documents(root)}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        workplace.prepare(folder, root, repose)
        study = (folder / "study.toml").read_text(encoding="utf-8")
        (folder / "drops.toml").write_text(study.partition("[experiment.tilt]")[0], encoding="utf-8")
        subprocess.run([repose, *"simulate heap study.toml --views 0 --out state".split()],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL)
        names = experiments(repose, folder)
        errors = [*errors_of_outputs(texts["docs/json.md"], folder, repose, names),
                  *errors_of_schema(texts["docs/json.md"], root),
                  *errors_of_studies(texts["docs/study-file.md"], folder, repose, names)]
    documents.finish(errors, f"{len(OUTPUTS)} outputs, {len(SECTIONS)} sections of a study and {len(names)} experiments")


main(*sys.argv[1:])
