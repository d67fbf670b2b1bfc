"""Relative links of the documents lead to files and headings that exist: check_links.py"""

import urllib.parse

import documents

def error_of(document, link, known):
    """The error in a link; empty if there is none."""
    name, _, anchor = link.partition("#")
    target = (document.file.parent / urllib.parse.unquote(name)).resolve() if name else document.file
    if not target.exists():
        return f"there is no {name}"
    if anchor and target not in known:
        return f"{name} is not one of the documents, so its headings are unknown"
    if anchor and anchor not in known[target].anchors():
        return f"there is no heading {anchor} in {known[target].name}"
    return ""

def main():
    texts = documents.all_documents(documents.root_folder())
    known = {document.file: document for document in texts}
    errors = []
    checked = 0
    for document in texts:
        for line, link in document.links():
            if "://" in link:
                continue
            checked += 1
            error = error_of(document, link, known)
            if error:
                errors.append(f"{document.place(line)}: link {link}: {error}")
    documents.finish(errors, f"{checked} links")

main()
