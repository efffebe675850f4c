import { type Engine, loadEngine, type World, type WorldOutcome, type WrittenFile } from "holdfast-engine";
import { sha256 } from "../data/sha256";
import type { Answer, Changes, Frame, HashedFile, LiveInputs, Order, Orders } from "./messages";

/** The native engine, so that the page never waits for it. It has one live world at a time. */

const loading = loadEngine();
let world: World | null = null;
/** The box that is pulled: its force ends with the pull. */
let pulled: number | null = null;

function frame(began: number, hashed: boolean): Frame {
  const at = world!;
  return {
    time: at.time,
    poses: at.poses(),
    velocities: at.velocities(),
    stateHash: hashed ? at.stateHash() : null,
    computed: (performance.now() - began) / 1000,
  };
}

function change({ acceleration, friction, force }: Changes): void {
  const at = world!;
  if (friction !== undefined) at.setFriction(friction, friction, friction);
  if (acceleration) at.setAcceleration(acceleration);
  if (pulled !== null && pulled !== force?.box) {
    at.setForce(pulled, [0, 0, 0]);
    pulled = null;
  }
  if (force) {
    at.setForce(force.box, force.force, force.point);
    pulled = force.box;
  }
}

function start(engine: Engine, { boxes, segments, masses, mats, settings }: LiveInputs): void {
  world?.free();
  world = null;
  pulled = null;
  world = engine.world({ boxes, segments, masses, mats, settings });
}

function screen(engine: Engine, { load, acceleration, settings }: Orders["screen"]["ask"]): WorldOutcome {
  const { loads, errors } = engine.readLoads(load, "the load", { settings });
  const [problem] = [...errors, ...loads.flatMap((read) => read.errors)];
  if (problem) throw new Error(problem.message);
  return engine.screenLoad(loads[0].load, engine.readAcceleration(acceleration), { settings }).outcome;
}

/** With the hashes that the program has of loads: of the bytes of a layout file, of any other load as it writes it. */
async function hashed(file: WrittenFile, bytes: Uint8Array<ArrayBuffer>): Promise<HashedFile> {
  const isLayoutFile = file.form.startsWith("text");
  const loads = file.loads.map(async ({ json, ...load }) => ({
    ...load,
    sha256: await sha256(isLayoutFile ? bytes : json),
  }));
  return { ...file, loads: await Promise.all(loads) };
}

async function answer(order: Order) {
  const engine = await loading;
  const began = performance.now();
  switch (order.kind) {
    case "version":
      return engine.version;
    case "start":
      start(engine, order);
      return frame(began, order.hashed);
    case "advance":
      change(order.changes);
      world!.advance(order.to);
      return frame(began, order.hashed);
    case "screen":
      return screen(engine, order);
    case "catalogue":
      return engine.catalogue();
    case "run":
      return engine.run(order.settings);
    case "read":
      return hashed(engine.readLoads(order.bytes, order.name, order.choices), order.bytes);
    case "preview":
      return engine.preview(order.bytes, order.rows);
    case "world": {
      const found = engine.screenLoad(order.load, order.acceleration, order.settings, true);
      return { ...found, seconds: (performance.now() - began) / 1000 };
    }
    case "margins":
      return {
        columns: engine.loadMargins(order.load, order.settings, order.direction),
        seconds: (performance.now() - began) / 1000,
      };
    case "bearing":
      return engine.loadBearing(order.load, order.settings);
  }
}

self.onmessage = async ({ data: order }: MessageEvent<Order>) => {
  let reply: Answer;
  try {
    reply = { id: order.id, value: await answer(order) };
  } catch (error) {
    reply = { id: order.id, error: (error as Error).message };
  }
  self.postMessage(reply);
};
