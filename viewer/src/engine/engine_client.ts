import { workerScript } from "../data/worker_script";
import type { Answer, Orders } from "./messages";

/** Whether this page carries the engine: `make viewer` puts it in where `make viewer-engine` has built it. */
export const engineCarried = () => (document.getElementById("engine")?.textContent ?? "").trim() !== "";

/** The page's end of the worker that has the engine. */
export class EngineClient {
  private readonly waiting = new Map<number, { resolve: (value: never) => void; reject: (error: Error) => void }>();
  private next = 0;

  private constructor(
    private readonly worker: Worker,
    private readonly address: string,
  ) {
    worker.onmessage = ({ data: reply }: MessageEvent<Answer>) => {
      const { resolve, reject } = this.waiting.get(reply.id)!;
      this.waiting.delete(reply.id);
      if ("error" in reply) reject(new Error(reply.error));
      else resolve(reply.value as never);
    };
    worker.onerror = (event) => {
      for (const { reject } of this.waiting.values()) reject(new Error(`The engine does not start: ${event.message}`));
      this.waiting.clear();
    };
  }

  static async start(): Promise<EngineClient> {
    const address = await workerScript("engine");
    return new EngineClient(new Worker(address), address);
  }

  ask<K extends keyof Orders>(kind: K, order: Orders[K]["ask"]): Promise<Orders[K]["answer"]> {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (value: never) => void, reject });
      this.worker.postMessage({ id, kind, ...order });
    });
  }

  close(): void {
    this.worker.terminate();
    URL.revokeObjectURL(this.address);
    this.waiting.clear();
  }
}
