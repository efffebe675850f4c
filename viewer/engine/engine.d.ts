// Types of build/viewer/engine.mjs, which glue.mjs documents.
import type { WorldOutcome } from "../src/data/outcome";

export type { WorldOutcome };

/** What the user, or the calling program, has given that cannot be used: a sentence. */
export class EngineError extends Error {}

export type Numbers = ArrayLike<number>;

/** What settings a world has: the text of a config.ini, and keys that are set after it: section, key, value. */
export interface GivenSettings {
  config?: string;
  settings?: readonly (readonly [string, string, string])[];
}

/** One layout under one acceleration. */
export interface WorldInputs extends GivenSettings {
  /** Rows of seven numbers: corner with the smallest coordinates, corner with the largest (m), material. */
  boxes: Numbers;
  /** Rows of five numbers: start, duration (s), acceleration along x, y, z (m/s²). */
  segments: Numbers;
  /** kg, one per box; not a number: by its material. */
  masses?: Numbers | null;
  /** Coefficients of friction of the mats beneath boxes, one per box; not a number: none. */
  mats?: Numbers | null;
}

/** A world that is taken forward in pieces. */
export interface World {
  readonly boxCount: number;
  /** s */
  readonly time: number;
  /** s, the latest: a load that rests earlier stays as it is until then */
  readonly endTime: number;
  advance(time: number): void;
  /** Rows of seven numbers: centre of mass (m), quaternion w x y z. */
  poses(): Float64Array;
  /** Rows of six numbers: velocity (m/s), angular velocity (rad/s). */
  velocities(): Float64Array;
  /** Rows of three numbers, N: floor, front, rear, left, right, roof, ground, fixed boxes; with the setting WallForces. */
  sideForces(): Float64Array;
  stateHash(): string;
  /** m/s² */
  setAcceleration(acceleration: Numbers): void;
  setFriction(boxBox: number, boxFloor: number, boxWall: number): void;
  /** N; the point in m, container frame. */
  setForce(box: number, force: Numbers, point?: Numbers | null): void;
  free(): void;
}

export interface Engine {
  readonly version: string;
  readLayout(text: string, inputs?: GivenSettings & { name?: string }): Float64Array;
  readAcceleration(text: string, name?: string): Float64Array;
  /** What `holdfast screen` says of the world; `cpuSeconds` is 0, since the engine here has no clock. */
  screen(inputs: WorldInputs): WorldOutcome;
  world(inputs: WorldInputs): World;
}

/** Compiles the engine. */
export function loadEngine(): Promise<Engine>;
