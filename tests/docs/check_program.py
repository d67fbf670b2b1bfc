"""The C++ program in building.md is one of those compiled and run: check_program.py"""

import documents

MOST_LINES = 15


def main():
    root = documents.root_folder()
    compiled = (root / "tests/package/calibrate_study.cpp").read_text(encoding="utf-8").splitlines()
    shown = [[line.text for line in block.lines]
             for document in documents.all_documents(root) if document.name == "docs/building.md"
             for block in document.blocks if block.language == "cpp"]
    errors = []
    if shown != [compiled]:
        errors.append("docs/building.md: the C++ program is not that of tests/package/calibrate_study.cpp")
    if len(compiled) > MOST_LINES:
        errors.append(f"tests/package/calibrate_study.cpp: {len(compiled)} lines, at most {MOST_LINES}")
    documents.finish(errors, "1 program")


main()
