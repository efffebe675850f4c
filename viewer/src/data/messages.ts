import type { FileContents } from "./file_contents";
import type { Results, World } from "./results";

/** Where a results file is. */
export type Place =
  | { kind: "file"; file: File }
  | { kind: "bytes"; name: string; bytes: Uint8Array }
  | { kind: "address"; name: string; url: string };

/** What page and worker say to each other. */
export type Request = { id: number } & (
  | { kind: "open"; place: Place }
  | { kind: "world"; index: number }
  | { kind: "names" }
  | { kind: "write"; contents: FileContents }
);
export type Reply = { id: number } & ({ value: Results | World | string[] | Uint8Array } | { error: string });
