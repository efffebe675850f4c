import { EngineClient } from "./engine_client";
import type { Orders } from "./messages";

interface Task {
  run: (client: EngineClient) => Promise<void>;
  cancel: () => void;
}

/** Engines in workers, one per core, which take what is asked for one after the other. */
export class EnginePool {
  private readonly urgent: Task[] = [];
  private readonly waiting: Task[] = [];
  private idle: EngineClient[] = [];
  private clients: EngineClient[] = [];
  private started = 0;

  /** @param size workers at most; they start when there is something to do */
  constructor(private readonly size = Math.max(1, navigator.hardwareConcurrency || 1)) {}

  /** @param isUrgent the user waits for this one: it comes before what is in line */
  ask<K extends keyof Orders>(
    kind: K,
    order: Orders[K]["ask"],
    isUrgent = false,
  ): Promise<Orders[K]["answer"]> {
    return new Promise((resolve, reject) => {
      const run = (client: EngineClient) => client.ask(kind, order).then(resolve, reject);
      (isUrgent ? this.urgent : this.waiting).push({ run, cancel: () => reject(new Cancelled()) });
      this.next();
    });
  }

  /** Leaves out what nobody has begun; its promises are rejected with `Cancelled`. */
  cancelWaiting(): void {
    for (const task of this.waiting.splice(0)) task.cancel();
  }

  close(): void {
    for (const client of this.clients) client.close();
    this.cancelWaiting();
    for (const task of this.urgent.splice(0)) task.cancel();
    this.clients = this.idle = [];
  }

  private async next(): Promise<void> {
    if (this.urgent.length + this.waiting.length === 0) return;
    const client = this.idle.pop() ?? (await this.start());
    if (!client) return;
    const task = this.urgent.shift() ?? this.waiting.shift();
    if (task) await task.run(client);
    this.idle.push(client);
    this.next();
  }

  /** Another engine, where there may be one more. */
  private async start(): Promise<EngineClient | null> {
    if (this.started >= this.size) return null;
    ++this.started;
    const client = await EngineClient.start();
    this.clients.push(client);
    return client;
  }
}

/** What was asked for was left out, since nobody wants it any more. */
export class Cancelled extends Error {}
