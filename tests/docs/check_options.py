"""Options in the documents exist, and all that exist are documented: check_options.py REPOSE"""

import concurrent.futures
import re
import subprocess
import sys

import documents

OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")
# Options of cmake, mpirun, npm and our own scripts that the documents mention outside of commands.
OTHER_PROGRAMS = {
    "--fresh", "--install", "--preset", "--sanitize", "--tests", "--thread", "--tidy", "--workflow",
}


def helps_of(repose):
    """The help of the program and of each command, by the command's name."""
    def help_of(command):
        words = [repose, *command.split(), "--help"]
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout

    commands = re.findall(r"^  ([a-z]+)  ", help_of(""), re.MULTILINE)
    assert "measure" in commands, f"no commands found in repose --help: {commands}"
    with concurrent.futures.ThreadPoolExecutor() as pool:
        return dict(zip(["", *commands], pool.map(help_of, ["", *commands])))


def wrong_in_command(text, options):
    """Options of a command line that the command does not have."""
    words = text.split("#")[0]
    command = re.search(r"\brepose ([a-z]+)\b", words)
    if command and command[1] in options:
        for option in OPTION.findall(words):
            if option not in options[command[1]]:
                yield f"repose {command[1]} has no option {option}"


def wrong_in_blocks(document, options):
    for block in document.blocks:
        for line in block.lines:
            for error in wrong_in_command(line.text, options):
                yield f"{document.place(line)}: {error}"


def wrong_in_helps(helps, options):
    """Checks the examples in each help, which are indented."""
    for command, text in helps.items():
        for line in re.findall(r"^  repose .*", text, re.MULTILINE):
            for error in wrong_in_command(line, options):
                yield f"repose {command} --help: {error}"


def wrong_in_text(document, options):
    """Options in running text that no command has, or not the one named in the same code span."""
    every = set().union(*options.values()) | OTHER_PROGRAMS
    for line, span in document.spans():
        command = re.search(r"\brepose ([a-z]+)\b", span)
        known = options.get(command[1], every) if command else every
        for option in OPTION.findall(span):
            if option not in known:
                yield f"{document.place(line)}: there is no option {option} (in `{span}`)"


def undocumented(texts, options):
    written = "\n".join(line.text for document in texts for line in document.lines)
    for document in texts:
        for block in document.blocks:
            written += "\n".join(line.text for line in block.lines)
    mentioned = set(OPTION.findall(written))
    for command, names in options.items():
        for option in sorted(names - mentioned - {"--help"}):
            yield f"docs: {option} of repose {command} is nowhere explained"


def main(repose):
    texts = documents.user_documents(documents.root_folder())
    helps = helps_of(repose)
    options = {command: set(re.findall(r"^  (?:-\w,)? *(--[a-z][a-z0-9-]*)", text, re.MULTILINE))
               for command, text in helps.items() if command}
    errors = [*undocumented(texts, options), *wrong_in_helps(helps, options)]
    for document in texts:
        errors += wrong_in_blocks(document, options)
        errors += wrong_in_text(document, options)
    documents.finish(errors, f"{sum(map(len, options.values()))} options")


main(*sys.argv[1:])
