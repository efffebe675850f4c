import assert from "node:assert/strict";
import { closeSync, fstatSync, openSync, readSync } from "node:fs";
import { test } from "node:test";
import { type ByteSource, cached } from "../../viewer/src/data/byte_source";
import { Hdf5File } from "../../viewer/src/data/hdf5_file";
import { ResultsReader } from "../../viewer/src/data/read_results";
import { RESULTS } from "./places";

/** A file on the disk, and how many bytes were read of it. */
function onDisk(name: string): ByteSource & { bytesRead: number; close: () => void } {
  const file = openSync(`${RESULTS}/${name}`, "r");
  return {
    name,
    size: fstatSync(file).size,
    bytesRead: 0,
    read(begin, end) {
      const bytes = new Uint8Array(end - begin);
      readSync(file, bytes, 0, bytes.length, begin);
      this.bytesRead += bytes.length;
      return bytes;
    },
    close: () => closeSync(file),
  };
}

async function open(name: string) {
  const source = onDisk(name);
  const file = await Hdf5File.open(cached(source), `/${name}`);
  return { source, file, reader: ResultsReader.read(file, name, source.size) };
}

test("the summary has one world per layout and acceleration", async () => {
  const { reader } = await open("demo.h5");
  const { worlds, layouts, accelerations, thresholds, container, complete } = reader.results;
  assert.deepEqual(layouts, ["seed_example.txt", "BR15_077_ep.txt", "BR8_009_ep.txt", "unstable_BR2_007_bpjs.txt"]);
  assert.equal(accelerations[0], "road-front-0g8");
  assert.equal(worlds.layout.length, 16);
  assert.deepEqual(thresholds, { drop: 0.05, move: 0.1, tilt: 10 });
  assert.deepEqual(container, [5.87, 2.33, 2.2]);
  assert.ok(complete);
  assert.ok(worlds.verdict.includes(2), "a box falls somewhere");
});

test("the last sample of a world is where the summary says it ends", async () => {
  const { reader } = await open("demo.h5");
  for (const index of [4, 15]) {
    const { boxes, series } = reader.world(index);
    assert.ok(series);
    const count = boxes.id.length;
    assert.equal(series.displacement.length, series.time.length * count * 3);
    assert.equal(series.orientation.length, series.time.length * count * 4);
    const last = series.displacement.subarray(-3 * count);
    for (let i = 0; i < last.length; ++i) assert.ok(Math.abs(last[i] - boxes.endDisplacement[i]) < 1e-6);
  }
});

test("boxes stand where the layout has them", async () => {
  const { reader } = await open("demo.h5");
  const { boxes } = reader.world(0);
  assert.equal(boxes.id.length, 3);
  assert.deepEqual(
    [...boxes.size.subarray(0, 3)].map((side) => side.toFixed(2)),
    ["0.80", "0.59", "1.06"],
  );
  assert.ok(Math.abs(boxes.reference[0] - 0.4) < 1e-3);
});

test("margins, wall forces and replicas are there when the run made them", async () => {
  const plain = (await open("demo.h5")).reader;
  assert.equal(plain.results.margins, null);
  assert.equal(plain.world(0).walls, null);
  const { reader } = await open("rich.h5");
  assert.equal(reader.results.margins?.margin.length, 8);
  assert.ok(reader.results.replicas!.count.some((count) => count > 0));
  const { walls, series } = reader.world(0);
  assert.equal(walls?.peak.length, 6);
  assert.equal(walls?.force.length, 6 * series!.time.length);
  assert.ok(walls!.limit.some((limit) => limit > 0));
});

test("a file without series has worlds with ends", async () => {
  const { reader } = await open("no-series.h5");
  const world = reader.world(4);
  assert.equal(world.series, null);
  assert.ok(world.boxes.endDisplacement.some((value) => Math.abs(value) > 0.1));
});

test("the worlds of a part are its own", async () => {
  const { reader } = await open("part.h5");
  assert.ok(!reader.results.complete);
  const { worlds } = reader.results;
  for (let index = 0; index < worlds.layout.length; ++index)
    assert.equal(reader.world(index).boxes.id.length, worlds.boxes[index]);
});

test("a damaged or foreign file is refused in a sentence", async () => {
  for (const name of ["text.h5", "truncated.h5"]) await assert.rejects(open(name), /damaged|no HDF5/);
  await assert.rejects(open("foreign.h5"), /foreign\.h5 is an HDF5 file, but no results of holdfast\./);
});

test("opening a file reads little of its series", async () => {
  const { source } = await open("rich.h5");
  assert.ok(source.bytesRead <= source.size);
});
