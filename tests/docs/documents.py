"""Contents of the documents: headings, links, code spans and blocks, each with its line."""

import dataclasses
import pathlib
import re

FENCE = re.compile(r"^\s*```(\S*)")
HEADING = re.compile(r"^#+\s+(.*)")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
SPAN = re.compile(r"`([^`]+)`")


@dataclasses.dataclass
class Line:
    number: int
    text: str


@dataclasses.dataclass
class Block:
    language: str
    lines: list


class Document:
    """A Markdown file; `lines` are those outside code blocks."""

    def __init__(self, file, root):
        self.file = file
        self.name = str(file.relative_to(root))
        self.lines = []
        self.blocks = []
        block = None
        for number, text in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            fence = FENCE.match(text)
            if fence and block is None:
                block = Block(fence[1], [])
                self.blocks.append(block)
            elif fence:
                block = None
            else:
                (self.lines if block is None else block.lines).append(Line(number, text))

    def place(self, line):
        return f"{self.name}:{line.number}"

    def anchors(self):
        """Names of the headings as used in links."""
        found = (HEADING.match(line.text) for line in self.lines)
        return {anchor_of(heading[1]) for heading in found if heading}

    def links(self):
        return [(line, link) for line in self.lines for link in LINK.findall(line.text)]

    def spans(self):
        return [(line, span) for line in self.lines for span in SPAN.findall(line.text)]


def anchor_of(heading):
    """As on GitHub: lower case, without punctuation, hyphens for spaces."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def user_documents(root):
    """The documents that explain the program, with commands to type."""
    files = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
    samples = sorted((root / "samples").glob("*/README.md"))
    return [Document(file, root) for file in [*files, *samples]]


def all_documents(root):
    theory = [file for module in ("dem", "calibrate") for file in (root / module).rglob("THEORY.md")]
    return user_documents(root) + [Document(file, root) for file in sorted(theory)]


def root_folder():
    return pathlib.Path(__file__).resolve().parents[2]


def finish(errors, checked):
    """Prints the errors and exits with 1 if there are any, else 0."""
    for error in errors:
        print(error)
    print(f"{checked}: {len(errors)} wrong")
    raise SystemExit(1 if errors else 0)
