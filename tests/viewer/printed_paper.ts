import { inflateSync } from "node:zlib";

/** The number of sheets of paper in a PDF, whose descriptions of pages may be packed. */
export function papersOf(pdf: Buffer): number {
  const text = pdf.toString("latin1");
  const unpacked = [...text.matchAll(/stream\r?\n([\s\S]*?)endstream/g)].map(([, bytes]) => {
    try {
      return inflateSync(Buffer.from(bytes, "latin1")).toString("latin1");
    } catch {
      return "";
    }
  });
  return [text, ...unpacked].join("\n").match(/\/Type\s*\/Page\b/g)?.length ?? 0;
}
