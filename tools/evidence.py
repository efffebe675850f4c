#!/usr/bin/env python3
"""Writes the tables of README.md and docs/ that come from runs, and the pictures, again.

    tools/evidence.py PROGRAM            runs the commands that the pages show, and writes tables and pictures
    tools/evidence.py PROGRAM --check    names the tables that are not current, and exits with 1 if there are any

A table of a page is an indented block below an indented command, `holdfast ...` or `make demo`. It may leave out lines, for which
it has "...": every part begins with a line that the command prints, its numbers apart, and has as many lines as are shown now.

Other pictures take minutes to hours, or need what this program does not have. They are drawn by hand when what they show changes:

    docs/guide/search.svg       the commands at the end of docs/guide/search.md, some 35 minutes of processor time
    docs/guide/viewer/*         node tests/viewer/pictures.mjs RESULTS docs/guide/viewer, as docs/develop/viewer_page.md says; needs
                                Chromium and the page
    docs/evidence/validation/*  holdfast validate -o validation && tools/validation_report.py validation, hours
    docs/evidence/peers.svg     bench/peers/compare.py, as bench/peers/README.md says; needs the sources of Box3D and Jolt
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ["README.md", "docs/start/first_screening.md",
         *(f"docs/guide/{name}.md" for name in ("confidence", "damage", "indicators", "load_shift", "margins", "walls"))]
INDENT = "    "
PROGRAM = "PROGRAM"
# Pictures, what draws them, and from which results.
PICTURES = {
    "docs/guide/margins.svg": ["examples/plot_margins.py", "margins.h5"],
    "docs/guide/walls.svg": ["examples/plot_walls.py", "walls.h5"],
    "docs/guide/verdicts.svg": ["examples/plot_verdicts.py", "--program", PROGRAM],
    "docs/guide/indicators.svg": ["examples/indicators.py", "indicators.h5"],
}
RESULTS = {
    "margins.h5": "margins -c configs/demo.ini --layouts configs/layouts --norm road",
    "walls.h5": "screen --layouts configs/layouts --accelerations configs/accelerations --walls en12642-xl",
    "indicators.h5": "screen --layouts configs/layouts bench/layouts --norm road --indicators --margins --accuracy screening",
    "report.h5": "screen --layouts configs/layouts/BR15_077_ep.txt --norm road --margins --walls en12642-l --replicas 32",
}


def printed(program, command, folder):
    """The lines that a command of a page prints, without progress and those that are empty."""
    if command == "make demo":
        recipe = (ROOT / "Makefile").read_text(encoding="utf-8")
        command = re.search(r"^demo:.*\n\t@mkdir.*\n\tbuild/release/bin/((?:.*\\\n)*.*)\n", recipe, re.MULTILINE)[1].replace("\\\n", " ")
    words = command.split()[1:]
    if "-o" in words:
        del words[words.index("-o"):words.index("-o") + 2]
    done = subprocess.run([program, *words, "--overwrite", "-o", str(folder / "results.h5")], cwd=ROOT, capture_output=True,
                          text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{command}\n{done.stderr}")
    lines = [line.rstrip() for line in (done.stderr + done.stdout).splitlines() if line.strip()]
    return [line for line in lines if not re.match(r" *\d+/\d+ worlds ", line)]  # progress, which a busy machine has time for


def without_numbers(line):
    return re.sub(r"[\d.]+", "#", " ".join(line.split()))


def renewed(block, lines, where):
    """The block with what the command prints now."""
    text, at, left_out = [], 0, True
    for line in block:
        shown = line.strip()
        if left_out and shown not in ("", "..."):
            begins = [i for i in range(at, len(lines)) if without_numbers(lines[i]) == without_numbers(shown)]
            if not begins:
                sys.exit(f"{where}: the command does not print this line: {shown}")
            at, left_out = begins[0], False
        if shown in ("", "..."):
            text.append(line)
            left_out = left_out or shown == "..."
            continue
        text.append(INDENT + lines[at] if at < len(lines) else line)
        at += 1
    return text


def renew(program, page, folder):
    """The text of a page with its tables as the commands print them now."""
    lines = (ROOT / page).read_text(encoding="utf-8").split("\n")
    command, i = None, 0
    while i < len(lines):
        if not lines[i].startswith(INDENT):
            if lines[i] != "":
                command = None  # a table stands right below its command
            i += 1
            continue
        end = i
        while end < len(lines) and (lines[end].startswith(INDENT) or (lines[end] == "" and lines[end + 1].startswith(INDENT))):
            end += 1
        block = lines[i:end]
        if re.match(r"(holdfast (screen|margins) |make demo$)", block[0].strip()):
            command = block[0].strip()
            block = block[1:]
            i += 1
            while block and block[0] == "":
                block, i = block[1:], i + 1
        if command and block:
            lines[i:end] = renewed(block, printed(program, command, folder), f"{page}:{i + 1}")
        i = end
    return "\n".join(lines)


def draw(program, folder):
    """Draws the pictures again; the same picture has the same bytes."""
    (folder / "matplotlibrc").write_text("svg.hashsalt: holdfast\n", encoding="ascii")
    environment = {**os.environ, "MATPLOTLIBRC": str(folder), "SOURCE_DATE_EPOCH": "0"}
    for name, words in RESULTS.items():
        subprocess.run([program, *words.split(), "--quiet", "--overwrite", "-o", str(folder / name)], cwd=ROOT, check=False)
    for picture, (script, *words) in PICTURES.items():
        words = [folder / word if word in RESULTS else program if word == PROGRAM else word for word in words]
        drawn = folder / pathlib.Path(picture).name
        subprocess.run([sys.executable, script, *words, "-o", drawn], cwd=ROOT, check=True, env=environment)
        shutil.copy(drawn, ROOT / picture)


def draw_report(program, results, folder):
    """A picture of the page that the report has for a layout, taken by Chromium; without one the picture stays."""
    browser = os.environ.get("HOLDFAST_BROWSER") or shutil.which("chromium")
    if not browser:
        print("docs/guide/report.png is not drawn: there is no chromium")
        return
    page, picture = folder / "report.html", folder / "report.png"
    subprocess.run([program, "report", results, "-o", page], cwd=ROOT, check=True, capture_output=True)
    text = page.read_text(encoding="utf-8")
    front = re.search(r"<body[^>]*>(.*?)<section", text, re.DOTALL)
    page.write_text(text[:front.start(1)] + text[front.end(1):], encoding="utf-8")
    subprocess.run([browser, "--headless", "--no-sandbox", "--hide-scrollbars", "--force-device-scale-factor=1",
                    "--window-size=720,1030", f"--screenshot={picture}", page.as_uri()], check=True, capture_output=True)
    shutil.copy(picture, ROOT / "docs/guide/report.png")


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--check"]):
        sys.exit(__doc__)
    program = str(pathlib.Path(sys.argv[1]).resolve())
    stale = []
    with tempfile.TemporaryDirectory(prefix="holdfast_evidence_") as folder:
        for page in PAGES:
            text = renew(program, page, pathlib.Path(folder))
            if text == (ROOT / page).read_text(encoding="utf-8"):
                continue
            stale.append(page)
            if len(sys.argv) == 2:
                (ROOT / page).write_text(text, encoding="utf-8")
        if len(sys.argv) == 2:
            draw(program, pathlib.Path(folder))
            draw_report(program, pathlib.Path(folder) / "report.h5", pathlib.Path(folder))
    for page in stale:
        print(f"{page} {'was' if len(sys.argv) == 2 else 'is'} not current")
    return 1 if stale and len(sys.argv) == 3 else 0


if __name__ == "__main__":
    sys.exit(main())
