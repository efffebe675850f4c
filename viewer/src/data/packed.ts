/** Bytes that the page carries as text: base64, of gzip. */
export async function unpacked(text: string): Promise<Uint8Array<ArrayBuffer>> {
  const packed = await (await fetch(`data:application/gzip;base64,${text.trim()}`)).arrayBuffer();
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The same without gzip. */
export async function fromBase64(text: string): Promise<Uint8Array<ArrayBuffer>> {
  return new Uint8Array(await (await fetch(`data:application/octet-stream;base64,${text.trim()}`)).arrayBuffer());
}
