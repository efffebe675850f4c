import type { Place, Reply, Request } from "./messages";
import type { Results, World } from "./results";
import { workerScript } from "./worker_script";

/** Worlds that are kept in memory after they were looked at. */
const KEPT = 8;

/** The page's end of the worker that reads the file. */
export class ResultsClient {
  private readonly waiting = new Map<number, { resolve: (value: never) => void; reject: (error: Error) => void }>();
  private readonly worlds = new Map<number, Promise<World>>();
  private next = 0;

  private constructor(private readonly worker: Worker) {
    worker.onmessage = (event: MessageEvent<Reply>) => {
      const reply = event.data;
      const { resolve, reject } = this.waiting.get(reply.id)!;
      this.waiting.delete(reply.id);
      if ("error" in reply) reject(new Error(reply.error));
      else resolve(reply.value as never);
    };
    worker.onerror = (event) => {
      for (const { reject } of this.waiting.values()) reject(new Error(`The file cannot be read: ${event.message}`));
      this.waiting.clear();
    };
  }

  static async start(): Promise<ResultsClient> {
    return new ResultsClient(new Worker(await workerScript("reader")));
  }

  async open(place: Place): Promise<Results> {
    this.worlds.clear();
    return this.ask<Results>({ kind: "open", place });
  }

  world(index: number): Promise<World> {
    const known = this.worlds.get(index) ?? this.ask<World>({ kind: "world", index });
    this.worlds.delete(index);
    this.worlds.set(index, known);
    if (this.worlds.size > KEPT) this.worlds.delete(this.worlds.keys().next().value as number);
    return known;
  }

  private ask<T>(
    request: Omit<Extract<Request, { kind: "open" }>, "id"> | Omit<Extract<Request, { kind: "world" }>, "id">,
  ) {
    const id = this.next++;
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (value: never) => void, reject });
      this.worker.postMessage({ id, ...request });
    });
  }
}
