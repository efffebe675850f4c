import * as hdf5 from "h5wasm";
import type { Column, FileContents } from "./file_contents";
import { type Axis, type Dataset, LABEL_BYTES, RESULTS_DATASETS } from "./results_datasets";

/** Types of numbers, as the library calls them, with the arrays that it takes them in. */
const NUMBERS = {
  uint8: ["<B", Uint8Array],
  uint32: ["<I", Uint32Array],
  int32: ["<i", Int32Array],
  float32: ["<f", Float32Array],
  float64: ["<d", Float64Array],
} as const;

/** Axes whose length grows with the number of boxes: entries of a chunk, as the program has them. */
const CHUNKS: Partial<Record<Axis, number>> = { N: 4096, B: 4096, S: 16384, R: 16384 };

/** Other datasets with more bytes are packed too, in chunks of at most so many. */
const PLAIN_BYTES = 1024;
const CHUNK_BYTES = 2 ** 18;

/** The bytes of a results file. What a screening has no entries of, its series, is there and empty. */
export async function writeResults({ attributes, columns }: FileContents): Promise<Uint8Array<ArrayBuffer>> {
  const { FS } = await hdf5.ready;
  const path = "/saved.h5";
  // As the program: every version of HDF5 reads it, and attributes stay in their order.
  const file = new hdf5.File(path, "w", { libver: ["earliest", "latest"] });
  for (const [group, values] of Object.entries(attributes)) {
    const on = groupOf(file, group);
    for (const [name, value] of Object.entries(values)) writeAttribute(on, name, value);
  }
  // The page has none.
  const config = groupOf(file, "/inputs").create_dataset({ name: "config", data: [""], shape: [], dtype: "S1" });
  describe(config, "none", "configuration file as used");
  const given = new Set(Object.keys(columns).map(folderOf));
  for (const dataset of RESULTS_DATASETS) {
    const folder = folderOf(dataset.path);
    if (dataset.asked && !given.has(folder)) continue;
    const column = columns[dataset.path] ?? (folder === "/series" ? [] : null);
    if (column === null) throw new Error(`${dataset.path} is not known.`);
    writeDataset(groupOf(file, folder), dataset, column);
  }
  file.close();
  const bytes = FS.readFile(path, { encoding: "binary" }) as Uint8Array<ArrayBuffer>;
  FS.unlink(path);
  return bytes;
}

const folderOf = (path: string) => path.slice(0, path.lastIndexOf("/"));

/** A group, which is made where it is not there yet. */
function groupOf(file: hdf5.File, path: string): hdf5.Group {
  return path
    .split("/")
    .filter((step) => step !== "")
    .reduce<hdf5.Group>(
      (group, step) => (group.keys().includes(step) ? (group.get(step) as hdf5.Group) : group.create_group(step)),
      file,
    );
}

function writeAttribute(on: hdf5.Group | hdf5.Dataset, name: string, value: string | number | bigint): void {
  const type = typeof value === "string" ? "S" : typeof value === "bigint" ? "<Q" : "<d";
  // The library's declaration forgets big numbers, which it takes.
  on.create_attribute(name, (typeof value === "bigint" ? BigUint64Array.of(value) : value) as number, [], type);
}

function describe(dataset: hdf5.Dataset, units: string, description: string): void {
  writeAttribute(dataset, "units", units);
  writeAttribute(dataset, "description", description);
}

function writeDataset(
  group: hdf5.Group,
  { path, type, axis, width, units, description }: Dataset,
  column: Column,
): void {
  const length = column.length / width;
  const grows = axis in CHUNKS;
  const size = type === "text" ? textBytes(column as readonly string[], grows) : Number(/\d+$/.exec(type)) / 8;
  const entry = size * width;
  const chunk = CHUNKS[axis] ?? Math.min(length, Math.max(1, Math.floor(CHUNK_BYTES / entry)));
  const packed = grows || length * entry > PLAIN_BYTES;
  const shape = (first: number) => (width === 1 ? [first] : [first, width]);
  const dataset = group.create_dataset({
    name: path.slice(path.lastIndexOf("/") + 1),
    ...valuesOf(type, column, size),
    shape: shape(length),
    ...(grows ? { maxshape: width === 1 ? [null] : [null, width] } : {}),
    ...(packed ? { chunks: shape(chunk), compression: "gzip", compression_opts: [1] } : {}),
  });
  describe(dataset, units, description);
}

/** Bytes of each text of a column: those of a label, or as many as the longest has. */
function textBytes(texts: readonly string[], grows: boolean): number {
  if (grows) return LABEL_BYTES;
  const encoder = new TextEncoder();
  return texts.reduce((most, text) => Math.max(most, encoder.encode(text).length), 1);
}

function valuesOf(type: Dataset["type"], column: Column, size: number) {
  if (type === "text") return { data: column as string[], dtype: `S${size}` };
  if (type === "uint64") {
    const data = BigUint64Array.from(column as ArrayLike<number | bigint>, BigInt);
    return { data, dtype: "<Q" };
  }
  const [dtype, Numbers] = NUMBERS[type];
  return { data: Numbers.from(column as ArrayLike<number>), dtype };
}
