import { type ByteSource, bytesAtAddress, bytesInMemory, bytesOfFile, cached } from "./byte_source";
import { Hdf5File, UnreadableFile } from "./hdf5_file";
import type { Place, Reply, Request } from "./messages";
import { ResultsReader } from "./read_results";
import { writeResults } from "./write_results";

/** Reads the results file, so that the page never waits for the disk, and writes one. */

let reader: ResultsReader | null = null;

function sourceOf(place: Place): ByteSource {
  if (place.kind === "file") return cached(bytesOfFile(place.file));
  if (place.kind === "bytes") return bytesInMemory(place.name, place.bytes);
  return cached(bytesAtAddress(place.name, place.url));
}

async function answer(request: Request) {
  if (request.kind === "world") return reader!.world(request.index);
  if (request.kind === "names") return reader!.criticalNames();
  if (request.kind === "write") return writeResults(request.contents);
  reader?.close();
  reader = null;
  const source = sourceOf(request.place);
  reader = ResultsReader.read(await Hdf5File.open(source), source.name, source.size);
  return reader.results;
}

/** HDF5 says what it could not do in many lines; the user is told what that means. */
function sentence(kind: Request["kind"], error: unknown): string {
  if (error instanceof UnreadableFile) return error.message;
  const message = error instanceof Error ? error.message : String(error);
  const meaning = kind === "write" ? "The file cannot be written" : "The file is damaged, or not all of it is there";
  return `${meaning}: ${message.split("\n")[0]}`;
}

self.onmessage = async (event: MessageEvent<Request>) => {
  const request = event.data;
  let reply: Reply;
  try {
    reply = { id: request.id, value: await answer(request) };
  } catch (error) {
    reply = { id: request.id, error: sentence(request.kind, error) };
  }
  self.postMessage(reply);
};
