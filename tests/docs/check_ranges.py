"""Ranges and defaults in the study reference match the program's: check_ranges.py REPOSE

Every number key in a table of docs/study-file.md is given a wrong value; the table must name all numbers
of the rule in the program's error. Defaults of the experiments are compared with those that repose new
writes."""

import pathlib
import re
import subprocess
import sys
import tempfile

import documents

SECTION = re.compile(r"^###? `?([a-z._]+)`?$")
ROW = re.compile(r"^\| `(\w+)` \|(.*)\|$")
NUMBER = re.compile(r"(?<![\w.])-?\d[\d,]*(?:\.\d+)?(?:e\d+)?")
WRONG = "-1e30"
# Two with an implausible and an impossible range, explained in a separate section; and two that stand in
# braces within a table.
ELSEWHERE = {"density_kg_m3", "young_modulus_pa", "tolerance", "bias_sd"}
# Any one of the sections that have the keys under a heading.
SECTION_OF = {"experiment": "experiment.heap"}
ENDLESS = 1e15  # a limit beyond any realistic value


def numbers_in(text):
    """"above 0, at most 100,000": {0, 100000}."""
    numbers = {float(word.replace(",", "").rstrip(".")) for word in NUMBER.findall(text)}
    return {number for number in numbers if number < ENDLESS}


def number_keys(document):
    """Line, section, key, default and rule of each number in the document's tables."""
    section, rule = None, ""
    for line in document.lines:
        heading = SECTION.match(line.text)
        if line.text.startswith("#"):
            section = SECTION_OF.get(heading[1], heading[1]) if heading else None
        row = ROW.match(line.text)
        if not row or section is None:
            continue
        cells = [cell.strip() for cell in row[2].split("|")]
        if len(cells) < 2 or not re.match(r"(whole )?number\b", cells[0]):
            continue
        default, rule = cells[1], rule if cells[2].startswith("the same") else cells[2]
        if row[1] not in ELSEWHERE:
            yield line, section, row[1], default, rule


def rules_of(keys, folder, repose):
    """The program's rule for each key, from its error for a wrong value, and all that it printed."""
    settings = [word for _, section, key, _, _ in keys for word in ("--set", f"{section}.{key}={WRONG}")]
    done = subprocess.run([repose, "simulate", "drop", "study.toml", *settings], cwd=folder,
                          capture_output=True, text=True)
    rules = {}
    for name, rule in re.findall(r"([\w.]+) = \S+\. Rule: (.*?)\. Fix: ", done.stderr):
        rules.setdefault(name, rule)  # if there are two rules, the range comes first
    return rules, done.stderr


def defaults_of(folder, repose):
    """Defaults of the experiments' keys, as in a new study."""
    subprocess.run([repose, "new", "ranges.toml", "--experiments",
                    "drop,tilt,roll,drop_on_grains,tilt_on_grains,roll_on_grains,fill,pendulum"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    section, defaults = "", {}
    for line in (folder / "ranges.toml").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            section = line.strip("[]")
        key, equals, value = line.partition(" = ")
        if equals and section.startswith("experiment.") and re.fullmatch(r"[\d.e]+", value):
            defaults[f"{section}.{key}"] = float(value)
    return defaults


def errors_of(document, folder, repose):
    keys = list(number_keys(document))
    rules, printed = rules_of(keys, folder, repose)
    defaults = defaults_of(folder, repose)
    for line, section, key, default, rule in keys:
        name = f"{section}.{key}"
        if name not in rules:
            yield f"{document.place(line)}: {name} = {WRONG} is not refused: {printed}"
        elif not numbers_in(rules[name]) <= numbers_in(rule):
            yield f"{document.place(line)}: {name}: the program's rule is {rules[name]}, here {rule}"
        if name in defaults and numbers_in(default) != {defaults[name]}:
            yield f"{document.place(line)}: {name}: the default is {defaults[name]:g}, here {default}"
    if len(keys) < 15 or len(defaults) < 6:
        yield f"{document.name}: only {len(keys)} numbers and {len(defaults)} defaults found"


def main(repose):
    root = documents.root_folder()
    document = {text.name: text for text in documents.user_documents(root)}["docs/study-file.md"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        study = pathlib.Path(__file__).with_name("study.toml").read_text(encoding="utf-8")
        (folder / "study.toml").write_text(study, encoding="utf-8")
        errors = list(errors_of(document, folder, repose))
    documents.finish(errors, "the study reference")


main(*sys.argv[1:])
