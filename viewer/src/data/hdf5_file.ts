import * as hdf5 from "h5wasm";
import type { ByteSource } from "./byte_source";

export type Numbers = Float64Array | Float32Array | Uint32Array | Int32Array | Uint8Array;

/** What a file cannot be read for, as one sentence for the user. */
export class UnreadableFile extends Error {}

interface FileNode {
  contents: unknown;
  usedBytes: number;
  stream_ops: Record<string, unknown>;
}
interface FileSystem {
  createFile(parent: string, name: string, properties: object, canRead: boolean, canWrite: boolean): FileNode;
  analyzePath(path: string): { exists: boolean };
  unlink(path: string): void;
}
interface Stream {
  position: number;
}

/** Bytes that a column, and a chunk of it, may take: a file may claim any number. */
const MOST_BYTES = 2 ** 29;
const MOST_CHUNK_BYTES = 2 ** 20;

/** Where the library would ask whoever looks at the page for the data of a column that lies outside of its file. */
const ASKS = "/dev/stdin";

/** Shows the bytes of a source as a file to the HDF5 library, which then reads what it needs. */
function mount(files: FileSystem, path: string, source: ByteSource): void {
  for (const old of [path, ASKS]) if (files.analyzePath(old).exists) files.unlink(old);
  const node = files.createFile("/", path.slice(1), {}, true, false);
  Object.defineProperty(node, "usedBytes", { get: () => source.size });
  node.stream_ops = {
    ...node.stream_ops,
    read: (_: Stream, buffer: Int8Array, offset: number, length: number, position: number) => {
      const end = Math.min(position + length, source.size);
      if (end <= position) return 0;
      const bytes = source.read(position, end);
      buffer.set(new Int8Array(bytes.buffer, bytes.byteOffset, bytes.length), offset);
      return bytes.length;
    },
  };
}

/** An HDF5 file: columns and attributes as plain values. */
export class Hdf5File {
  private constructor(private readonly file: hdf5.File) {}

  static async open(source: ByteSource, path = "/results.h5"): Promise<Hdf5File> {
    await hdf5.ready;
    mount(hdf5.FS as unknown as FileSystem, path, source);
    const file = new hdf5.File(path, "r");
    if (file.file_id < 0n) throw new UnreadableFile(`${source.name} is no HDF5 file, or its beginning is damaged.`);
    return new Hdf5File(file);
  }

  close(): void {
    this.file.close();
  }

  has(path: string): boolean {
    return this.find(path) !== null;
  }

  /** Attributes of a group, by name; `/` is the file's own. */
  attributes(path: string): Record<string, string | number> {
    const group = path === "/" ? this.file : this.find(path);
    const values: Record<string, string | number> = {};
    for (const [name, attribute] of Object.entries(group?.attrs ?? {})) {
      const value = attribute.value;
      values[name] = typeof value === "bigint" ? Number(value) : (value as string | number);
    }
    return values;
  }

  /** Entries [begin, end) of a column of numbers, all when no range is given; rows of a table lie one after the other. */
  numbers(path: string, begin?: number, end?: number): Numbers {
    const data = this.entries(path, begin, end);
    if (data instanceof BigUint64Array || data instanceof BigInt64Array) return Float64Array.from(data, Number);
    return data as Numbers;
  }

  /** Entries of a column of hashes, as 16 hexadecimal digits. */
  hashes(path: string, begin: number, end: number): string[] {
    const data = this.entries(path, begin, end) as unknown as BigUint64Array;
    return Array.from(data, (hash) => hash.toString(16).padStart(16, "0"));
  }

  texts(path: string, begin?: number, end?: number): string[] {
    return this.entries(path, begin, end) as string[];
  }

  private entries(path: string, begin = 0, end?: number) {
    const dataset = this.find(path);
    if (!(dataset instanceof hdf5.Dataset)) throw new UnreadableFile(`The file has no ${path}.`);
    const length = dataset.shape?.[0] ?? 0;
    const last = end ?? length;
    if (last > length) throw new UnreadableFile(`${path} ends before entry ${last}: the file is damaged.`);
    if (last === begin) return new Float64Array();
    const { size, total_size: entries, chunks } = dataset.metadata;
    const chunkBytes = (chunks ?? []).reduce((bytes, extent) => bytes * extent, size);
    if ((size * entries * (last - begin)) / length > MOST_BYTES || (chunks && chunkBytes > MOST_CHUNK_BYTES))
      throw new UnreadableFile(`${path} is too large to be shown: the file is damaged, or not from holdfast.`);
    const data = begin === 0 && last === length ? dataset.value : dataset.slice([[begin, last]]);
    if (data === null) throw new UnreadableFile(`${path} cannot be read: the file is damaged.`);
    return data;
  }

  private find(path: string) {
    // A missing link makes h5wasm print HDF5's error stack; one step at a time nothing is asked for in vain.
    let group: hdf5.Group = this.file;
    const steps = path.split("/").filter((step) => step !== "");
    for (const [index, step] of steps.entries()) {
      if (!group.keys().includes(step)) return null;
      const place = `/${steps.slice(0, index + 1).join("/")}`;
      if (this.file.get_link(place) !== null || this.file.get_external_link(place).filename !== undefined)
        throw new UnreadableFile(`${place} is a link, which files of holdfast do not have.`);
      const entity = group.get(step);
      if (index + 1 === steps.length) return entity as hdf5.Group | hdf5.Dataset | null;
      if (!(entity instanceof hdf5.Group)) return null;
      group = entity;
    }
    return null;
  }
}
