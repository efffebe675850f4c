/** The bytes of a file, wherever they are: read in ranges, synchronously, in a worker. */
export interface ByteSource {
  readonly name: string;
  readonly size: number;
  read(begin: number, end: number): Uint8Array;
}

export function bytesInMemory(name: string, bytes: Uint8Array): ByteSource {
  return { name, size: bytes.length, read: (begin, end) => bytes.subarray(begin, end) };
}

/** A file that the user chose. Only what is asked for leaves the disk. */
export function bytesOfFile(file: File): ByteSource {
  const reader = new FileReaderSync();
  return {
    name: file.name,
    size: file.size,
    read: (begin, end) => new Uint8Array(reader.readAsArrayBuffer(file.slice(begin, end))),
  };
}

/** A file behind an address that answers range requests. */
export function bytesAtAddress(name: string, url: string): ByteSource {
  const request = (method: string, range?: string) => {
    const xhr = new XMLHttpRequest();
    xhr.open(method, url, false);
    xhr.responseType = "arraybuffer";
    if (range) xhr.setRequestHeader("Range", range);
    xhr.send();
    if (xhr.status !== (range ? 206 : 200))
      throw new Error(`${name} cannot be read: the server answers ${xhr.status}.`);
    return xhr;
  };
  const size = Number(request("HEAD").getResponseHeader("Content-Length"));
  return {
    name,
    size,
    read: (begin, end) => new Uint8Array(request("GET", `bytes=${begin}-${end - 1}`).response as ArrayBuffer),
  };
}

/** Bytes in a block of the cache: small enough for metadata that is spread over the file, large enough for few requests. */
const BLOCK = 1 << 18;
/** Blocks that are kept: 64 MB. */
const KEPT = 256;

/** Reads whole blocks of a slow source and keeps the latest ones. */
export function cached(source: ByteSource): ByteSource {
  const blocks = new Map<number, Uint8Array>();
  const block = (index: number) => {
    const known = blocks.get(index);
    const bytes = known ?? source.read(index * BLOCK, Math.min((index + 1) * BLOCK, source.size));
    blocks.delete(index);
    blocks.set(index, bytes);
    if (blocks.size > KEPT) blocks.delete(blocks.keys().next().value as number);
    return bytes;
  };
  const read = (begin: number, end: number) => {
    const first = Math.floor(begin / BLOCK);
    if (end <= (first + 1) * BLOCK) return block(first).subarray(begin - first * BLOCK, end - first * BLOCK);
    if (end - begin > 4 * BLOCK) return source.read(begin, end);
    const bytes = new Uint8Array(end - begin);
    for (let at = begin; at < end; ) {
      const index = Math.floor(at / BLOCK);
      const piece = block(index).subarray(at - index * BLOCK, end - index * BLOCK);
      bytes.set(piece, at - begin);
      at += piece.length;
    }
    return bytes;
  };
  return { name: source.name, size: source.size, read };
}
