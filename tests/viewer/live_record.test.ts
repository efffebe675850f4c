import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import type { Engine } from "holdfast-engine";
import { bytesInMemory } from "../../viewer/src/data/byte_source";
import { Hdf5File } from "../../viewer/src/data/hdf5_file";
import { loadText } from "../../viewer/src/data/load_text";
import { withCorners } from "../../viewer/src/data/loaded_layout";
import { VERDICT_CODES } from "../../viewer/src/data/outcome";
import { ResultsReader } from "../../viewer/src/data/read_results";
import { centresOf, LiveRecord } from "../../viewer/src/live/live_record";
import { engineSettings } from "../../viewer/src/live/saved_files";
import { accelerationAt } from "../../viewer/src/time/acceleration";
import { ENGINE, RESULTS } from "./places";

const skip = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";
const engine: Engine = skip ? null : await (await import(ENGINE)).loadEngine();

async function demo(name = "demo.h5") {
  const bytes = readFileSync(`${RESULTS}/${name}`);
  return ResultsReader.read(await Hdf5File.open(bytesInMemory(name, bytes), `/${name}`), name, bytes.length);
}

/** Frames of a world whose boxes go as the first ones of a list say: m from where they are loaded, and degree about y. */
async function scripted(world: number) {
  const { results, ...reader } = await demo().then((of) => ({ results: of.results, world: of.world(world) }));
  const record = new LiveRecord(results, reader.world);
  const { boxes } = reader.world.loaded!;
  const centres = centresOf(boxes, results.settings);
  const frame = (time: number, moves: { by?: number[]; tilt?: number }[]) => {
    const poses = Float64Array.from({ length: boxes.length }, (_, i) => {
      const [box, column] = [Math.floor(i / 7), i % 7];
      const { by = [0, 0, 0], tilt = 0 } = moves[box] ?? {};
      const half = (tilt * Math.PI) / 360;
      return column < 3 ? centres[3 * box + column] + by[column] : [Math.cos(half), 0, Math.sin(half), 0][column - 3];
    });
    return { time, poses, velocities: new Float64Array((6 * boxes.length) / 7), stateHash: null, computed: 0 };
  };
  return { record, boxes, frame };
}

test("what a live world ever did counts, and what it does at the end stands beside it", async () => {
  const { record, boxes, frame } = await scripted(0);
  const still = [0, 0, 0];
  record.restart(boxes, frame(0, []), still);
  const { world } = record;
  const { worlds } = record.results;
  assert.equal(world.verdict, VERDICT_CODES.stayed);
  assert.equal(world.criticalBox, 0, "nothing has moved");
  record.add(frame(0.1, [{ by: [0.05, 0, 0] }]), still);
  assert.equal(world.verdict, VERDICT_CODES.stayed);
  assert.equal(world.criticalBox, 1, "it came nearest to a limit");
  record.add(frame(0.2, [{ by: [0.05, 0, 0] }, { by: [0, 0, -0.02], tilt: 12 }]), still);
  record.add(frame(0.3, [{ by: [0.3, 0, 0] }]), still);
  record.add(frame(0.4, [{ by: [0.01, 0, 0] }, { by: [0, 0, -0.06] }]), still);
  record.add(frame(0.5, []), still);
  assert.equal(world.verdict, VERDICT_CODES.fell);
  assert.deepEqual([worlds.fallen[0], worlds.moved[0], worlds.tilted[0], worlds.unstable[0]], [1, 1, 1, 0]);
  assert.equal(worlds.fallenAtEnd[0], 0);
  assert.deepEqual([...world.series!.fallen], [0, 0, 0, 0, 1, 0]);
  assert.equal(world.criticalBox, 2, "it was beyond a limit first, though the other one went farther");
  near(world.boxes.firstBeyond.subarray(0, 2), [0.3, 0.2], 1e-6, "first beyond");
  assert.ok(Number.isNaN(world.boxes.firstBeyond[2]));
  near([worlds.peakDisplacement[0], worlds.peakDrop[0], worlds.peakTilt[0]], [0.3, 0.06, 12], 1e-5, "peaks");
  near([worlds.endDisplacement[0], world.boxes.end.tilt[1]], [0, 0], 1e-6, "at the end");
  record.restart(boxes, frame(0, []), still);
  assert.equal(world.verdict, VERDICT_CODES.stayed, "nothing is left of the world before");
  assert.equal(worlds.peakDisplacement[0], 0);
});

test("a world that stops at the time of a sample, but for rounding, has this sample once", async () => {
  const { record, boxes, frame } = await scripted(0);
  record.restart(boxes, frame(0, []), [0, 0, 0]);
  assert.ok(record.add(frame(0.1, []), [0, 0, 0]));
  assert.ok(!record.add({ ...frame(0.1 + 1e-16, []), stateHash: "0" }, [0, 0, 0]));
  assert.equal(record.world.stateHash, "0");
  assert.ok(record.add({ ...frame(0.15, []), stateHash: "1" }, [0, 0, 0]), "its end is a sample");
  assert.deepEqual([...record.world.series!.time], [0, 0.1, 0.15]);
});

test("a live world counts from where it has settled; one that is unstable from the layout", async () => {
  const { record, boxes, frame } = await scripted(0);
  const { world } = record;
  const still = [0, 0, 0];
  record.restart(boxes, frame(0, [{ by: [0, 0, -0.03] }]), still);
  assert.ok(world.accelerated);
  assert.equal(record.results.worlds.peakDrop[0], 0);
  record.add(frame(0.1, [{ by: [0, 0, -0.06] }]), still);
  assert.equal(world.verdict, VERDICT_CODES.stayed, "three centimetres lower than it has settled");
  record.restart(boxes, frame(0, [{ by: [0, 0, -0.06] }]), still);
  assert.equal(world.verdict, VERDICT_CODES.unstable);
  assert.ok(!world.accelerated);
  assert.equal(record.results.worlds.unstable[0], 1);
  assert.equal(world.criticalBox, 1);
  near([record.results.worlds.peakDrop[0]], [0.06], 1e-6, "drop");
});

test("a world that is recorded live is the world of the file: hash, verdict, counts, peaks, samples", {
  skip,
}, async () => {
  const reader = await demo();
  const { results } = reader;
  for (let index = 0; index < results.worlds.layout.length; ++index) {
    const file = reader.world(index);
    const inputs = {
      boxes: file.loaded!.boxes,
      segments: Float64Array.from(file.segments.flatMap((s) => [s.start, s.duration, ...s.value])),
      settings: engineSettings(results.settings, {}),
    };
    const world = engine.world(inputs);
    assert.ok(world.endTime >= file.endTime, "it is the latest");
    const frame = () => ({
      time: world.time,
      poses: world.poses(),
      velocities: world.velocities(),
      stateHash: world.time >= file.endTime ? world.stateHash() : null,
      computed: 0,
    });
    const record = new LiveRecord(results, file);
    record.restart(inputs.boxes, frame(), accelerationAt(file.segments, 0));
    assert.equal(record.interval, 0.1);
    while (world.time < file.endTime) {
      world.advance(Math.min(world.time + 1 / 240, record.nextSample, file.endTime));
      record.add(frame(), accelerationAt(file.segments, world.time - 1e-9));
    }
    assert.equal(world.stateHash(), file.stateHash);
    world.free();
    const name = `${file.layout} under ${file.acceleration}`;
    const { worlds } = results;
    const live = record.results.worlds;
    assert.equal(record.world.verdict, file.verdict, name);
    for (const column of ["fallen", "moved", "tilted", "unstable", "fallenAtEnd"] as const)
      assert.equal(live[column][0], worlds[column][index], `${name}: ${column}`);
    assert.ok(Math.abs(live.endDisplacement[0] - worlds.endDisplacement[index]) < 1e-6, name);
    near(record.world.boxes.end.tilt, file.boxes.end.tilt, 1e-3, `${name}: tilt`);
    // Of a load that settles the page sees the end alone.
    if (!file.accelerated) continue;
    assert.equal(record.world.criticalBox, file.criticalBox, `${name}: critical box`);
    for (const column of ["displacement", "drop", "tilt"] as const)
      near(record.world.boxes.peak[column], file.boxes.peak[column], 1e-3, `${name}: peak ${column}`);
    const never = (times: Float32Array) => times.map((time) => (Number.isNaN(time) ? -1 : time));
    near(never(record.world.boxes.firstBeyond), never(file.boxes.firstBeyond), 1 / 120, `${name}: first beyond`);
    const { series } = record.world;
    near(series!.time, file.series!.time, 1e-9, `${name}: time`);
    near(series!.displacement, file.series!.displacement, 1e-6, `${name}: displacement`);
    near(series!.orientation, file.series!.orientation, 1e-6, `${name}: orientation`);
    near(series!.energy, file.series!.energy, 1e-3, `${name}: energy`);
    assert.deepEqual([...series!.fallen], [...file.series!.fallen], name);
  }
});

test("loads with masses, centres of mass, mats, names of materials, pairs, fixed boxes and containers have the program's bits", {
  skip,
}, async () => {
  const reader = await demo("loads.h5");
  const { results } = reader;
  let withCentres = 0;
  for (const [index, layout] of results.worlds.layout.entries()) {
    const file = reader.world(index);
    const { masses, mats, settings } = file.loaded!;
    if (results.layouts[layout] === "wheels.json#wheels") ++withCentres;
    const inputs = {
      boxes: file.loaded!.boxes,
      segments: Float64Array.from(file.segments.flatMap((s) => [s.start, s.duration, ...s.value])),
      masses,
      mats,
      settings: engineSettings({ ...results.settings, ...settings }, {}),
    };
    const world = engine.world(inputs);
    world.advance(file.endTime);
    assert.equal(world.stateHash(), file.stateHash, `${file.layout} under ${file.acceleration}`);
    world.free();
  }
  assert.equal(withCentres, results.accelerations.length);
});

test("a saved load is read by the engine as it is, whichever axis is up in other files", { skip }, async () => {
  for (const name of ["demo.h5", "loads.h5"]) {
    const reader = await demo(name);
    const { accelerations, worlds } = reader.results;
    for (let index = 0; index < worlds.layout.length; index += accelerations.length) {
      const { load, boxes } = reader.world(index).loaded!;
      const saved = withCorners(load, boxes);
      assert.deepEqual(saved, load);
      for (const up of ["z", "y"]) {
        const settings = [["Container", "UpAxis", up] as const];
        const { loads, errors } = engine.readLoads(loadText(saved), "saved.json", { settings });
        assert.deepEqual([errors, loads.length, loads[0].errors], [[], 1, []], load.name);
        assert.deepEqual({ ...loads[0].load, name: load.name }, JSON.parse(JSON.stringify(load)));
      }
    }
  }
});

test("the boxes of a saved load stand where they were put", async () => {
  const { load, boxes } = (await demo()).world(0).loaded!;
  const put = boxes.slice();
  for (const axis of [0, 3]) put[7 + axis] += 0.125;
  const { corner_min, corner_max, ...rest } = withCorners(load, put).boxes[1];
  const before = load.boxes[1];
  assert.deepEqual(corner_min, [before.corner_min[0] + 0.125, before.corner_min[1], before.corner_min[2]]);
  assert.deepEqual(corner_max, [before.corner_max[0] + 0.125, before.corner_max[1], before.corner_max[2]]);
  assert.deepEqual({ ...before, ...rest }, before);
});

/** Numbers of two columns, to an absolute difference that grows with their size. */
function near(a: ArrayLike<number>, b: ArrayLike<number>, most: number, what: string): void {
  assert.equal(a.length, b.length, what);
  for (let i = 0; i < a.length; ++i)
    assert.ok(Math.abs(a[i] - b[i]) <= most * (1 + Math.abs(b[i])), `${what}: ${a[i]}, not ${b[i]}, at ${i}`);
}
