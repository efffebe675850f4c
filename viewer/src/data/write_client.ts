import type { FileContents } from "./file_contents";
import type { Reply } from "./messages";
import { workerScript } from "./worker_script";

/** The bytes of a results file, written by a worker that has the HDF5 library, and ends afterwards. */
export async function bytesOfResults(contents: FileContents): Promise<Uint8Array<ArrayBuffer>> {
  const address = await workerScript("reader");
  const worker = new Worker(address);
  try {
    return await new Promise((resolve, reject) => {
      worker.onmessage = ({ data: reply }: MessageEvent<Reply>) => {
        if ("error" in reply) reject(new Error(reply.error));
        else resolve(reply.value as Uint8Array<ArrayBuffer>);
      };
      worker.onerror = (event) => reject(new Error(`The file cannot be written: ${event.message}`));
      worker.postMessage({ id: 0, kind: "write", contents });
    });
  } finally {
    worker.terminate();
    URL.revokeObjectURL(address);
  }
}
