import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import type { Engine } from "holdfast-engine";
import { bytesInMemory } from "../../viewer/src/data/byte_source";
import { Hdf5File } from "../../viewer/src/data/hdf5_file";
import { ResultsReader } from "../../viewer/src/data/read_results";
import { LiveRecord } from "../../viewer/src/live/live_record";
import { engineSettings, layoutText } from "../../viewer/src/live/saved_files";
import { accelerationAt } from "../../viewer/src/time/acceleration";
import { firstMoves } from "../../viewer/src/time/first_moves";
import { ENGINE, RESULTS } from "./places";

const skip = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";
const engine: Engine = skip ? null : await (await import(ENGINE)).loadEngine();

async function demo() {
  const bytes = readFileSync(`${RESULTS}/demo.h5`);
  return ResultsReader.read(await Hdf5File.open(bytesInMemory("demo.h5", bytes), "/demo.h5"), "demo.h5", bytes.length);
}

test("a world that is recorded live is the world of the file: hash, verdict, counts, samples, first moves", {
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
    const frame = () => ({
      time: world.time,
      endTime: world.endTime,
      poses: world.poses(),
      velocities: world.velocities(),
      stateHash: null,
      computed: 0,
    });
    const record = new LiveRecord(results, file);
    record.restart(inputs.boxes, frame(), accelerationAt(file.segments, 0));
    assert.equal(record.interval, 0.1);
    while (world.time < file.endTime) {
      world.advance(Math.min(world.time + 1 / 60, record.nextSample, file.endTime));
      record.add(frame(), accelerationAt(file.segments, world.time - 1e-9));
    }
    assert.equal(world.stateHash(), file.stateHash);
    world.free();
    const name = `${file.layout} under ${file.acceleration}`;
    const { worlds } = results;
    const live = record.results.worlds;
    assert.equal(record.world.verdict, file.verdict, name);
    for (const column of ["fallen", "moved", "tilted", "unstable"] as const)
      assert.equal(live[column][0], worlds[column][index], `${name}: ${column}`);
    assert.ok(Math.abs(live.displacement[0] - worlds.displacement[index]) < 1e-6, name);
    const { series } = record.world;
    near(series!.time, file.series!.time, 1e-9, `${name}: time`);
    near(series!.displacement, file.series!.displacement, 1e-6, `${name}: displacement`);
    near(series!.orientation, file.series!.orientation, 1e-6, `${name}: orientation`);
    near(series!.energy, file.series!.energy, 1e-3, `${name}: energy`);
    assert.deepEqual([...series!.fallen], [...file.series!.fallen], name);
    assert.deepEqual(
      [...firstMoves(record.world, results.thresholds)],
      [...firstMoves(file, results.thresholds)],
      `${name}: first moves`,
    );
    near(record.world.boxes.endTilt, file.boxes.endTilt, 0.05, `${name}: tilt`);
  }
});

test("a saved layout is read by the engine as the same boxes, with either axis up", { skip }, async () => {
  const reader = await demo();
  const { results } = reader;
  for (let index = 0; index < results.worlds.layout.length; index += 4) {
    const { boxes, header } = reader.world(index).loaded!;
    for (const up of ["z", "y"]) {
      const settings = [["Container", "UpAxis", up] as const];
      const read = engine.readLayout(layoutText(header, boxes, up, results.container[1]), { settings });
      near(read, boxes, up === "z" ? 0 : 1e-12, `${results.layouts[results.worlds.layout[index]]}, ${up} up`);
    }
  }
});

/** Numbers of two columns, to an absolute difference that grows with their size. */
function near(a: ArrayLike<number>, b: ArrayLike<number>, most: number, what: string): void {
  assert.equal(a.length, b.length, what);
  for (let i = 0; i < a.length; ++i)
    assert.ok(Math.abs(a[i] - b[i]) <= most * (1 + Math.abs(b[i])), `${what}: ${a[i]}, not ${b[i]}, at ${i}`);
}
