"""Runs the commands of the documents: check_commands.py REPOSE

In blocks marked sh or console each command is run in a shell, in a folder with sample files; in console
blocks commands follow "$ ", and the lines below are their output (which may have others between them).
After repose new the test fills in the sheets, as if the bench had been used. Scripts of the repository
are checked for syntax and options but not run. Other blocks are not run.
"""

import concurrent.futures
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

import documents
import workplace

LONGEST_S = 120


def commands_of(block):
    """Each command's line and text, and the output lines shown below it."""
    commands = []
    for line in block.lines:
        if block.language == "sh" and line.text.strip():
            commands.append((line, line.text.strip(), []))
        elif line.text.startswith("$ "):
            commands.append((line, line.text[2:], []))
        elif block.language == "console" and line.text.strip() and commands:
            commands[-1][2].append(line)
    return [(line, text, shown) for line, text, shown in commands if not text.startswith("#")]


def is_alike(shown, printed):
    """Whether the words are the same; numbers may differ by rounding."""
    if len(shown) != len(printed):
        return False
    for ours, theirs in zip(shown, printed):
        if ours == theirs:
            continue
        try:
            if abs(float(ours) - float(theirs)) > 0.02:
                return False
        except ValueError:
            return False
    return True


def missing_line(shown, output):
    """The first line that is missing from the output, in order; None if all are there."""
    printed = iter([line.split() for line in output.splitlines()])
    for line in shown:
        if not any(is_alike(line.text.split(), words) for words in printed):
            return line
    return None


class Runner:
    def __init__(self, document, folder, root, environment):
        self.document = document
        self.folder = folder
        self.root = root
        self.environment = environment
        self.errors = []
        self.count = 0

    def fail(self, line, what):
        self.errors.append(f"{self.document.place(line)}: {what}")

    def check(self, line, text, shown):
        self.count += 1
        program = shlex.split(text, comments=True)[0]
        if program == "repose":
            self.run(line, text, shown)
        elif os.access(self.root / program, os.X_OK):
            done = subprocess.run(["sh", "-n", self.root / program], capture_output=True, text=True)
            if done.returncode != 0:
                self.fail(line, f"{program}: {done.stderr}")
            script = (self.root / program).read_text(encoding="utf-8")
            for word in shlex.split(text, comments=True)[1:]:
                if word.startswith("--") and word not in script:
                    self.fail(line, f"{program} has no option {word}")
        else:
            self.fail(line, f"{program} is neither repose nor a script of the repository. "
                            "Fix: mark a block that is not to be run as text")

    def run(self, line, text, shown):
        try:
            done = subprocess.run(text, shell=True, cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True, timeout=LONGEST_S)
        except subprocess.TimeoutExpired:
            self.fail(line, f"took more than {LONGEST_S} s: {text}")
            return
        if done.returncode != 0:
            self.fail(line, f"exit code {done.returncode}: {text}\n{done.stderr.rstrip()}")
            return
        words = shlex.split(text, comments=True)
        if words[1] == "new":
            workplace.go_to_the_bench(self.folder / words[2])
        missing = missing_line(shown, done.stdout)
        if missing:
            self.fail(missing, f"is not printed by: {text}\n  shown: {missing.text}\n{done.stdout}")


def run_document(document, prepared, root, environment):
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder) / "work"
        shutil.copytree(prepared, place, symlinks=True)
        runner = Runner(document, place, root, environment)
        for block in document.blocks:
            if block.language in ("sh", "console"):
                for command in commands_of(block):
                    runner.check(*command)
    return runner


def main(repose):
    root = documents.root_folder()
    environment = workplace.environment(repose)
    texts = documents.user_documents(root)
    with tempfile.TemporaryDirectory() as folder:
        prepared = pathlib.Path(folder) / "prepared"
        prepared.mkdir()
        workplace.prepare(prepared, root, repose)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            runs = list(pool.map(lambda text: run_document(text, prepared, root, environment), texts))
    errors = [error for run in runs for error in run.errors]
    documents.finish(errors, f"{sum(run.count for run in runs)} commands")


main(*sys.argv[1:])
