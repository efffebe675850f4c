"""What same_results.py compares: one line for every object of a results file and for every text, with its hash.

A line is (run, file, object, description, hash). In a results file the objects come in the file's own order, by the
addresses of their object headers, so that another order of writing shows.
"""
import csv
import hashlib
import io
import re

import h5py
import numpy as np
from h5py import h5a, h5d, h5o, h5t

# What is not compared, because it differs between two runs of one program, or between two versions of it.
LEFT_OUT = (
    # where, what: a regular expression of the whole name, or of a part of the text; why
    ("dataset", r".*/cpu_seconds", "processor time"),
    ("attribute", r"/@(source_)?(created_utc|host|command_line)", "when, where and how the run was started"),
    ("attribute", r"/@(source_)?(software|git_commit)", "version of the program"),
    ("attribute", r"/inputs/settings@Screening/Threads", "two listings may be made with different numbers of threads"),
    ("fingerprint", r"software=[0-9a-f]{64}", "hash of the version; the rest of a fingerprint is compared"),
    ("column", r"cpu_seconds", "processor time, in tables of comma-separated values"),
    ("text", r'(?<="cpu_seconds":)[-+.0-9e]+', "processor time, in JSON"),
    ("text", r'(?<=": )[-+.0-9e]+(?=,?\n)', "processor time, in the file of --costs"),
    ("progress", r"\r?\d+/\d+ (worlds|layouts)\b[^\r\n]*[\r\n]*", "how far a run is, and how fast"),
    ("text", r"(?<=, )\d+ threads?(?=\n)|(?<=--threads )\d+", "number of threads"),
    ("text", r"(?<=<td>software</td><td class=text>)[^<]*|(?<=<td>run of</td><td class=text>)[^<]*|(?<=<td>command</td><td class=text>)[^<]*",
     "version, time and command of the run, in a report"),
)
MASK = "(left out)"
# Bytes by which sizes of files may differ: the gaps that HDF5 leaves depend on how well the processor times compress.
SIZE_TOLERANCE = 4096


def patterns(where):
    return [pattern for place, pattern, _ in LEFT_OUT if place == where]


def is_left_out(where, name):
    return any(re.fullmatch(pattern, name) for pattern in patterns(where))


def sha256(*parts):
    digest = hashlib.sha256()
    for part in parts:
        digest.update(part)
    return digest.hexdigest()


def masked_columns(text):
    """A table of comma-separated values without the columns that are left out."""
    rows = list(csv.reader(io.StringIO(text)))
    hidden = [i for i, name in enumerate(rows[0] if rows else []) if is_left_out("column", name)]
    for row in rows[1:]:
        for i in hidden:
            row[i] = MASK
    masked = io.StringIO()
    csv.writer(masked, lineterminator="\n").writerows(rows)
    return masked.getvalue()


def masked(text, name=""):
    """A text without what is left out; `name` is that of its file."""
    for pattern in patterns("progress"):
        text = re.sub(pattern, "", text)
    for pattern in patterns("text"):
        text = re.sub(pattern, MASK, text)
    return masked_columns(text) if name.endswith(".csv") else text


def type_name(kind, dtype):
    """Type of a dataset or an attribute, and for text how it is stored."""
    if not isinstance(kind, h5t.TypeStringID):
        return dtype.str if dtype.names is None else str(dtype)
    length = "variable" if kind.is_variable_str() else kind.get_size()
    return f"text length {length} padding {kind.get_strpad()} set {kind.get_cset()}"


def value_bytes(value):
    """The bits of a value; text of variable length is bytes already."""
    if isinstance(value, str):
        return value.encode("utf-8", "surrogateescape")
    if isinstance(value, bytes):
        return value
    array = np.asarray(value)
    return array.tobytes() if array.dtype != object else b"\0".join(map(value_bytes, array.ravel().tolist()))


def attribute_names(item):
    """In the order in which they are stored."""
    names = []
    h5a.iterate(item.id, lambda name, *_: names.append(name), order=h5py.h5.ITER_NATIVE)
    return [name.decode() for name in names]


def attribute_value(item, name):
    """Without what is left out of it."""
    value = item.attrs[name]
    if name.endswith("fingerprint") and isinstance(value, (str, bytes, np.bytes_)):
        value = value if isinstance(value, str) else value.decode()
        for pattern in patterns("fingerprint"):
            value = re.sub(pattern, MASK, value)
    return value


def attribute_lines(item):
    for name in attribute_names(item):
        full_name = f"{item.name}@{name}"
        if is_left_out("attribute", full_name):
            yield full_name, "left out", "-"
            continue
        attribute = h5a.open(item.id, name.encode())
        yield (full_name, f"{type_name(attribute.get_type(), attribute.dtype)} {attribute.shape}",
               sha256(value_bytes(attribute_value(item, name))))


def chunks_of(dataset):
    return [dataset.id.get_chunk_info(i) for i in range(dataset.id.get_num_chunks())]


def stored_parts(dataset, file_bytes):
    """The bytes of a dataset as they are stored, with the places of its chunks in the dataset."""
    if dataset.chunks:
        for chunk in chunks_of(dataset):
            mask, data = dataset.id.read_direct_chunk(chunk.chunk_offset)
            yield f"{chunk.chunk_offset} {mask} {len(data)}\n".encode()
            yield data
    elif dataset.id.get_offset() is not None:
        begin = dataset.id.get_offset()
        yield file_bytes[begin:begin + dataset.id.get_storage_size()]
    elif dataset.size:
        yield value_bytes(dataset[()])


def dataset_description(dataset):
    plan = dataset.id.get_create_plist()
    filters = [plan.get_filter(i) for i in range(plan.get_nfilters())]
    layout = {h5d.CHUNKED: "chunks", h5d.CONTIGUOUS: "contiguous", h5d.COMPACT: "compact"}.get(plan.get_layout(), "other layout")
    words = [type_name(dataset.id.get_type(), dataset.dtype), f"shape {dataset.shape}", f"most {dataset.maxshape}",
             layout + (f" {dataset.chunks}" if dataset.chunks else ""),
             *(f"{name.decode()} {' '.join(map(str, values))}" for _, _, values, name in filters),
             f"fill time {plan.get_fill_time()}, allocation {plan.get_alloc_time()}"]
    return ", ".join(words)


def objects_in_order(file):
    """All groups and datasets, by the addresses of their headers."""
    found = [file["/"]]
    file.visititems(lambda _, item: found.append(item))
    return sorted(found, key=lambda item: h5o.get_info(item.id).addr)


def results_lines(path):
    """(object, description, hash) of all that a results file has."""
    file_bytes = path.read_bytes()
    with h5py.File(path, "r") as file:
        items = objects_in_order(file)
        datasets = [item for item in items if isinstance(item, h5py.Dataset)]
        times = [item for item in datasets if is_left_out("dataset", item.name)]
        compared = [item for item in datasets if item not in times]
        size = len(file_bytes) - sum(item.id.get_storage_size() for item in times)
        yield "superblock", f"versions {file.id.get_create_plist().get_version()}", "-"
        yield "size", f"{size} bytes without times", "-"
        if "worlds/state_hash" in file:
            hashes = file["worlds/state_hash"][:]
            yield "state hashes", f"{len(hashes)} worlds", sha256(hashes.tobytes())
        for item in items:
            if item in compared:
                yield item.name, "dataset, " + dataset_description(item), sha256(*stored_parts(item, file_bytes))
            elif item in times:
                yield item.name, "dataset, " + dataset_description(item) + ", values left out", "-"
            else:
                yield item.name, f"group of {len(item)}", "-"
            yield from attribute_lines(item)


def is_same(name, left, right):
    """Whether two descriptions with their hashes, of objects of this name, are the same."""
    if name != "size":
        return left == right
    sizes = [int(description.split()[0]) for description, _ in (left, right)]
    return abs(sizes[0] - sizes[1]) <= SIZE_TOLERANCE


def lines_of_file(path):
    if path.suffix == ".h5" and h5py.is_hdf5(path):
        return results_lines(path)
    return [("text", f"{path.stat().st_size} bytes", sha256(path.read_bytes()))]


def lines_of_run(folder):
    """The lines of all files that a run has left in its folder."""
    for path in sorted(folder.rglob("*")):
        if not path.is_file():
            continue
        name = path.relative_to(folder).as_posix()
        for line in lines_of_file(path):
            yield (folder.name, name, *line)
