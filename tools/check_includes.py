#!/usr/bin/env python3
"""Checks that every source includes only what its folder may: docs/develop/architecture.md gives the rules and the reasons.

Prints one finding per line, `file:line: what`, and exits with 1 if there is any.
"""
import pathlib
import re
import sys

# What each third-party or system header belongs to; <name> without a dot or slash is the standard library.
LIBRARIES = {
    "Eigen": r"Eigen/",
    "Highway": r"hwy/",
    "HDF5": r"hdf5(_hl)?\.h$|H5\w*\.h$",
    "inih": r"(INIReader|ini)\.h$",
    "OpenSSL": r"openssl/",
    "libdeflate": r"libdeflate\.h$",
    "zlib": r"zlib\.h$",
    "fmt": r"fmt/",
    "TBB": r"(tbb|oneapi)/",
    "OpenMP": r"omp\.h$",
    "OpenCL": r"CL/",
    "ThreadSanitizer": r"sanitizer/tsan_interface\.h$",
    "Bullet": r"bullet/|bt\w+\.h$|(Bullet(Collision|Dynamics)|LinearMath)/",
    "Bullet3OpenCL": r"Bullet3\w+/",
    "CLI11": r"CLI/",
    "nlohmann": r"nlohmann/",
    "microhttpd": r"microhttpd\.h$",
    "MPI": r"mpi\.h$",
    "Catch2": r"catch2/",
    "pybind11": r"pybind11/",
    "POSIX": r"(unistd|fcntl|dlfcn|signal|spawn|sched|pthread|poll|glob|dirent|termios|sysexits|strings)\.h$|(sys|arpa|netinet)/\w+\.h$",
}

# A folder under src: the folders and the libraries that it may name.
RULES = {
    "core": ({"core"}, {"Eigen", "Highway"}),
    "analyses": ({"analyses", "core", "io"}, {"Eigen", "nlohmann", "fmt"}),
    "io": ({"core", "io"}, {"HDF5", "inih", "nlohmann", "OpenSSL", "libdeflate", "zlib", "fmt", "POSIX"}),
    "bullet": ({"core", "bullet"}, {"Bullet"}),
    "parallel": ({"core", "parallel"}, {"fmt", "TBB", "OpenMP", "OpenCL", "Bullet3OpenCL", "ThreadSanitizer", "POSIX"}),
    "validate": ({"core", "parallel", "validate"}, {"fmt"}),
    "api": ({"analyses", "core", "io", "parallel", "api"}, {"fmt", "POSIX"}),
    "mpi": ({"app", "core", "io", "mpi"}, {"MPI", "fmt"}),
    "app": ({"analyses", "api", "core", "io", "bullet", "parallel", "validate", "app"}, {"CLI11", "nlohmann", "microhttpd", "fmt", "POSIX"}),
}

# Public headers that everything shares: what an outcome consists of.
PUBLIC_WORDS = {"holdfast/outcome_fields.h", "holdfast/outcomes.hpp"}

# Libraries that are kept to the files that match, so that they can be replaced there.
KEPT_TO = {
    "Highway": r"src/core/native/solver/(\w+_kernels\.cpp|instruction_sets\.cpp|(pack|lorentz_cone)-inl\.hpp)",
    "CLI11": r"src/app/command_line\w*\.[ch]pp",
    "microhttpd": r"src/app/page_server/page_server\.cpp",
    "Bullet3OpenCL": r"src/parallel/opencl/bullet3_pipeline\.cpp",
    "ThreadSanitizer": r"src/parallel/schedulers/tsan_annotations\.hpp",
}

# Core knows no file, thread, clock, environment or printing.
NOT_IN_CORE = {"cstdio", "filesystem", "fstream", "iostream", "syncstream", "chrono", "ctime", "thread", "mutex",
               "shared_mutex", "condition_variable", "future", "semaphore", "latch", "barrier", "stop_token"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
# What was to be done later belongs into an issue.
LEFTOVER = re.compile(r"\b(TODO|FIXME|XXX)\b")


def library_of(header):
    return next((name for name, pattern in LIBRARIES.items() if re.match(pattern, header)), None)


def judge(folder, header, quoted, src):
    """What is wrong with the include, or None."""
    ours, libraries = RULES[folder]
    first = header.split("/")[0]
    if quoted and header in PUBLIC_WORDS:
        return None
    if quoted and first == "holdfast":
        return None if folder in ("api", "app") else f"src/{folder} must not include a public header of the library"
    if quoted and first in RULES:
        if not (src / header).is_file():
            return f'"{header}" is not there'
        return None if first in ours else f"src/{folder} must not include src/{first}"
    library = library_of(header)
    if library:
        return None if library in libraries else f"src/{folder} must not include {library} ({header})"
    if quoted:
        return f'"{header}": write the path from src'
    if re.search(r"[./]", header):
        return f"<{header}> is of no known library: add it to {pathlib.Path(__file__).name} if it belongs here"
    if folder == "core" and header in NOT_IN_CORE:
        return f"src/core must not include <{header}>: it knows no file, thread, clock or printing"
    return None


def judge_module(header, quoted, folder):
    """The same for the Python module, which uses the library as any other program does."""
    if quoted:
        return None if (folder / header).is_file() else f'"{header}" is not there'
    if re.match(r"pybind11/|holdfast/holdfast\.hpp$", header) or not re.search(r"[./]", header):
        return None
    return f"python/module must not include {header}: only pybind11 and the library's header"


def check(root):
    src = root / "src"
    findings = []
    sources = [p for top in ("include", "src", "tests", "bench", "python")
               for p in sorted((root / top).rglob("*.[ch]pp"))]
    for path in sources:
        name = path.relative_to(root).as_posix()
        folder = name.split("/")[1] if name.startswith("src/") else None
        if folder is not None and folder not in RULES:
            findings.append(f"{name}:1: src/{folder} has no rule")
            continue
        lines = path.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines, 1):
            if LEFTOVER.search(line):
                findings.append(f"{name}:{number}: a note of what is left to do")
            match = INCLUDE.match(line)
            if match and name.startswith("python/"):
                wrong = judge_module(match[2], match[1] == '"', path.parent)
                if wrong:
                    findings.append(f"{name}:{number}: {wrong}")
            if not match or folder is None:
                continue
            wrong = judge(folder, match[2], match[1] == '"', src)
            if wrong:
                findings.append(f"{name}:{number}: {wrong}")
            kept_to = KEPT_TO.get(library_of(match[2]))
            if kept_to and not re.fullmatch(kept_to, name):
                findings.append(f"{name}:{number}: {library_of(match[2])} is kept to {kept_to}")
    return len(sources), findings


def main():
    count, findings = check(pathlib.Path(__file__).resolve().parent.parent)
    print(*findings, f"{count} sources, {len(findings)} findings", sep="\n")
    return 1 if findings or not count else 0


if __name__ == "__main__":
    sys.exit(main())
