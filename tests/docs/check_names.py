"""Files, folders and tests named in the documents exist: check_names.py"""

import os
import re
import subprocess

import documents

FILE = re.compile(r"[\w.-]+\.(?:cpp|h|py|cmake|toml|md|txt)$")
TEST = re.compile(r"([A-Z]\w*[a-z]\w*)\.(\*|[A-Z]\w+)$")
TESTS_IN_SOURCES = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)")


def tracked_files(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, text=True)
    if listed.returncode == 0:
        return {name for name in listed.stdout.splitlines() if (root / name).exists()}
    skipped = {"build", "node_modules"}  # for an unpacked archive, which is not a repository
    files = set()
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in skipped]
        files.update(os.path.relpath(os.path.join(folder, name), root) for name in names)
    return files


def folders_of(files):
    folders = set()
    for name in files:
        parts = name.split("/")[:-1]
        folders.update("/".join(parts[:depth]) for depth in range(1, len(parts) + 1))
    return folders


def tests_in(root, files):
    """Names of suites, and of tests as SUITE.NAME."""
    names = set()
    for name in files:
        if name.startswith("tests/") and name.endswith(".cpp"):
            for suite, test in TESTS_IN_SOURCES.findall((root / name).read_text(encoding="utf-8")):
                names.update((suite, f"{suite}.{test}"))
    return names


def is_path(span, modules):
    """Whether it is a path from the repository's root, without a placeholder."""
    return span.split("/")[0] in modules and "/" in span and re.fullmatch(r"[\w./-]*[a-z0-9]", span)


def main():
    root = documents.root_folder()
    files = tracked_files(root)
    folders = folders_of(files)
    modules = {folder for folder in folders if "/" not in folder}
    base_names = {name.split("/")[-1] for name in files}
    tests = tests_in(root, files)
    errors = []
    checked = 0
    for document in documents.all_documents(root):
        for line, span in document.spans():
            test = TEST.match(span)
            if test:
                is_known = (test[1] if test[2] == "*" else span) in tests
            elif document.name == "docs/architecture.md" and FILE.match(span) and "NAME" not in span:
                is_known = span in base_names
            elif is_path(span, modules) and "NAME" not in span and "results" not in span:
                is_known = span in files or span in folders
            else:
                continue
            checked += 1
            if not is_known:
                errors.append(f"{document.place(line)}: there is no {span}")
    documents.finish(errors, f"{checked} names")


main()
