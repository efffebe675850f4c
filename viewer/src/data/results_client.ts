import type { Place, Reply, Request } from "./messages";
import type { Results, World } from "./results";
import type { ResultsSource } from "./results_source";
import { workerScript } from "./worker_script";

/** Worlds that are kept in memory after they were looked at. */
const KEPT = 8;

/** Milliseconds for an answer. Files of gigabytes take a few seconds; with wrong bytes in a file HDF5 may never end. */
const PATIENCE = 20_000;

/** A request without its number. */
type Asked = { [K in Request["kind"]]: Omit<Extract<Request, { kind: K }>, "id"> }[Request["kind"]];

interface Waiting {
  resolve: (value: never) => void;
  reject: (error: Error) => void;
  timer: number;
}

/** The page's end of the worker that reads the file. */
export class ResultsClient implements ResultsSource {
  /** of the file that was opened last */
  results!: Results;
  private readonly waiting = new Map<number, Waiting>();
  private readonly worlds = new Map<number, Promise<World>>();
  private next = 0;
  private worker: Worker;

  private constructor(private readonly script: string) {
    this.worker = this.startWorker();
  }

  static async start(): Promise<ResultsClient> {
    return new ResultsClient(await workerScript("reader"));
  }

  private startWorker(): Worker {
    const worker = new Worker(this.script);
    worker.onmessage = (event: MessageEvent<Reply>) => {
      const reply = event.data;
      const { resolve, reject, timer } = this.waiting.get(reply.id)!;
      clearTimeout(timer);
      this.waiting.delete(reply.id);
      if ("error" in reply) reject(new Error(reply.error));
      else resolve(reply.value as never);
    };
    worker.onerror = (event) => this.rejectAll(`The file cannot be read: ${event.message}`);
    return worker;
  }

  private rejectAll(sentence: string): void {
    for (const { reject, timer } of this.waiting.values()) {
      clearTimeout(timer);
      reject(new Error(sentence));
    }
    this.waiting.clear();
    this.worlds.clear();
  }

  /** Another file can be opened afterwards. */
  private giveUp(): void {
    this.worker.terminate();
    this.worker = this.startWorker();
    this.rejectAll("The file is damaged: reading it does not come to an end.");
  }

  async open(place: Place): Promise<Results> {
    this.worlds.clear();
    this.results = await this.ask<Results>({ kind: "open", place });
    return this.results;
  }

  world(index: number): Promise<World> {
    const known = this.worlds.get(index) ?? this.ask<World>({ kind: "world", index });
    this.worlds.delete(index);
    this.worlds.set(index, known);
    if (this.worlds.size > KEPT) this.worlds.delete(this.worlds.keys().next().value as number);
    return known;
  }

  /** Names of the critical boxes of all worlds. */
  criticalNames(): Promise<string[]> {
    return this.ask<string[]>({ kind: "names" });
  }

  private ask<T>(request: Asked) {
    const id = this.next++;
    return new Promise<T>((resolve, reject) => {
      const timer = window.setTimeout(() => this.giveUp(), PATIENCE);
      this.waiting.set(id, { resolve: resolve as (value: never) => void, reject, timer });
      this.worker.postMessage({ id, ...request });
    });
  }
}
