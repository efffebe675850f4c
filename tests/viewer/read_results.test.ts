import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { closeSync, fstatSync, mkdtempSync, openSync, readFileSync, readSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { type ByteSource, cached } from "../../viewer/src/data/byte_source";
import { isBeyond } from "../../viewer/src/data/excursions";
import { Hdf5File } from "../../viewer/src/data/hdf5_file";
import { STOP_REASON_CODES, VERDICT_CODES } from "../../viewer/src/data/outcome";
import { ResultsReader } from "../../viewer/src/data/read_results";
import type { Excursions } from "../../viewer/src/data/results";
import { fleetCsv } from "../../viewer/src/fleet/csv";
import { rowsOf } from "../../viewer/src/fleet/rows";
import { tiltOf, times } from "../../viewer/src/time/poses";
import { PROGRAM, RESULTS } from "./places";

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
  assert.deepEqual(container.size, [5.87, 2.33, 2.2]);
  assert.ok(complete);
  assert.ok(worlds.verdict.includes(1), "a box moves somewhere");
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

test("peaks are not less than what the series shows, and first times not later", async () => {
  const { reader } = await open("demo.h5");
  const { thresholds, worlds } = reader.results;
  for (let index = 0; index < worlds.layout.length; ++index) {
    const { boxes, series } = reader.world(index);
    const count = boxes.id.length;
    assert.equal(boxes.judged, boxes.peak);
    for (let sample = 0; sample < series!.time.length; ++sample)
      for (let box = 0; box < count; ++box) {
        const at = sample * count + box;
        const [x, y, z] = series!.displacement.subarray(3 * at, 3 * at + 3);
        const now: Excursions = {
          displacement: Float32Array.of(Math.hypot(x, y, z)),
          drop: Float32Array.of(-z),
          tilt: Float32Array.of(tiltOf(series!.orientation, 4 * box, 4 * at)),
        };
        const name = `box ${box + 1} of world ${index} at ${series!.time[sample]} s`;
        assert.ok(now.displacement[0] <= boxes.peak.displacement[box] + 1e-6, name);
        assert.ok(now.drop[0] <= boxes.peak.drop[box] + 1e-6, name);
        assert.ok(now.tilt[0] <= boxes.peak.tilt[box] + 1e-3, name);
        if (isBeyond(now, 0, thresholds)) assert.ok(boxes.firstBeyond[box] <= series!.time[sample] + 1e-6, name);
      }
    const flags = (of: "fallen" | "moved" | "tilted" | "unstable") => boxes[of].reduce((sum, flag) => sum + flag, 0);
    for (const of of ["fallen", "moved", "tilted", "unstable"] as const)
      assert.equal(worlds[of][index], flags(of), `${of} of world ${index}`);
  }
});

test("the critical box is the file's: the first that is beyond a limit", async () => {
  const { reader } = await open("demo.h5");
  const { worlds } = reader.results;
  for (let index = 0; index < worlds.layout.length; ++index) {
    const { boxes, criticalBox, verdict } = reader.world(index);
    assert.equal(criticalBox, worlds.criticalBox[index]);
    const times = boxes.firstBeyond.filter((time) => !Number.isNaN(time));
    assert.equal(verdict === VERDICT_CODES.stayed, times.length === 0);
    if (times.length > 0) assert.equal(boxes.firstBeyond[criticalBox - 1], Math.min(...times));
  }
  assert.equal(worlds.criticalBox[2], 0, "nothing moves, and no box is named");
});

test("a world that is unstable is that of settling: before 0, from the layout, and not accelerated", async () => {
  for (const name of ["demo.h5", "no-series.h5"]) {
    const { reader } = await open(name);
    const world = reader.world(12);
    assert.equal(world.verdict, VERDICT_CODES.unstable);
    assert.ok(!world.accelerated);
    const span = times(world);
    assert.deepEqual([span[0], span[span.length - 1]], [-2, Math.max(world.endTime, -2)]);
    assert.ok(world.boxes.firstBeyond.some((time) => time < 0) && !world.boxes.firstBeyond.some((time) => time > 0));
    assert.deepEqual(world.boxes.peak, world.boxes.settling);
    const { boxes } = world.loaded!;
    world.boxes.reference.forEach((place, i) => {
      const [box, axis] = [Math.floor(i / 3), i % 3];
      assert.ok(Math.abs(place - (boxes[7 * box + axis] + boxes[7 * box + axis + 3]) / 2) < 1e-6);
    });
    assert.ok(reader.world(4).accelerated);
    assert.equal(times(reader.world(4))[0], 0);
  }
});

test("a world that ended with a box beyond a limit says so", async () => {
  const { reader } = await open("early.h5");
  const world = reader.world(4);
  assert.equal(world.stopReason, STOP_REASON_CODES.decided);
  assert.ok(world.endTime < 3);
  assert.ok(world.boxes.firstBeyond.some((time) => Math.abs(time - world.endTime) < 1e-6));
});

test("a file of an earlier version is judged by where boxes are at the end", async () => {
  const { reader } = await open("earlier.h5");
  const { results } = reader;
  const { worlds } = results;
  assert.ok(results.judgedAtEnd);
  assert.ok(!(await open("demo.h5")).reader.results.judgedAtEnd);
  assert.equal(results.margins?.withinLimits, null);
  assert.ok(!worlds.verdict.includes(5), "a verdict that is no longer given");
  assert.equal(worlds.verdict[0], VERDICT_CODES.moved);
  assert.equal(worlds.verdict[4], VERDICT_CODES.fell);
  assert.deepEqual(worlds.fallenAtEnd, worlds.fallen);
  const { boxes, accelerated } = reader.world(4);
  assert.ok(accelerated);
  assert.equal(boxes.judged, boxes.end);
  assert.ok(boxes.peak.displacement.every((peak, box) => peak >= boxes.end.displacement[box] - 1e-6));
  for (const column of [boxes.peak.drop, boxes.peak.tilt, boxes.firstBeyond]) assert.ok(column.every(Number.isNaN));
});

for (const name of ["demo.h5", "early.h5", "rich.h5", "earlier.h5", "loads.h5"])
  test(`the table of ${name} is that of the program`, async () => {
    const { reader } = await open(name);
    const folder = mkdtempSync(path.join(tmpdir(), "holdfast-page-"));
    try {
      execFileSync(PROGRAM, ["summary", `${RESULTS}/${name}`, "--csv", folder]);
      const program = readTable(readFileSync(path.join(folder, "worlds.csv"), "utf8"));
      const page = readTable(fleetCsv(reader.results, rowsOf(reader.results), reader.criticalNames()));
      assert.equal(page.length, program.length);
      for (const [index, world] of page.entries())
        for (const heading of Object.keys(world).filter((of) => of in program[index])) {
          // The program takes them from the end, and the page from the file, where it has them.
          if (reader.results.judgedAtEnd && /^peak_/.test(heading)) continue;
          const [said, known] = [world[heading], program[index][heading]];
          // Of an earlier version it is found when a world is opened.
          const shown =
            heading === "critical_box" && said === "" && known !== "" ? String(reader.world(index).criticalBox) : said;
          const same = shown === known || Math.abs(Number(shown) - Number(known)) <= 1e-6 * Math.abs(Number(known));
          assert.ok(same, `${heading} of world ${index}: ${shown}, not ${known}`);
        }
      assert.ok(Object.keys(page[0]).filter((heading) => heading in program[0]).length >= 18);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

/** Lines of a table, whose fields have no line breaks. */
function readTable(text: string): Record<string, string>[] {
  const fields = (line: string) => Array.from(line.matchAll(/(?:^|,)("(?:[^"]|"")*"|[^",]*)/g), ([, field]) => field);
  const [head, ...lines] = text.trim().split(/\r?\n/);
  const headings = fields(head);
  return lines.map((line) => Object.fromEntries(fields(line).map((field, i) => [headings[i], field])));
}

test("loads have names, mats, masses, fixed boxes and containers of their own, where they say so", async () => {
  const { reader } = await open("loads.h5");
  const { results } = reader;
  const of = (name: string) =>
    reader.world(results.worlds.layout.findIndex((l) => results.layouts[l].startsWith(name)));
  assert.deepEqual(results.container.size, [5.87, 2.33, 2.2]);
  assert.equal(results.ownContainers.size, results.layouts.length - 1);
  const trailer = of("trailer.csv");
  const { boxes, container } = trailer;
  assert.equal(container.type, "trailer-curtain");
  assert.ok(container.size[0] > 13 && container.openings.walls[2] === 0 && container.openings.bedHeight === 1.2);
  assert.deepEqual([boxes.name[0], boxes.name[19], boxes.material[0]], ["Drinks 1", "Parts 2", "pallet"]);
  assert.deepEqual([...boxes.mass.subarray(0, 3)], [620, 635, 840]);
  assert.deepEqual([...boxes.mat.subarray(5, 8)], [Number.NaN, 0.6, 0.6]);
  assert.deepEqual([...boxes.fixed].indexOf(1), -1);
  assert.equal(trailer.loaded?.load.container, container.shape);
  assert.equal(trailer.loaded?.load.boxes[0].material, "pallet");
  const json = of("wheels.json");
  assert.deepEqual([...json.boxes.fixed], [1, 0]);
  assert.equal(json.boxes.bearingLimit[1], 250);
  assert.deepEqual(json.boxes.centre, Float32Array.of(0, 0, 0, 0.05, 0, -0.1));
  const wheels = JSON.parse(readFileSync(`${RESULTS}/wheels.json`, "utf8")).loads[0];
  const { load } = json.loaded!;
  const defaults = wheels.boxes.map((box: object) => ({ material: 1, ...box }));
  assert.deepEqual(JSON.parse(JSON.stringify(load.boxes)), defaults, "all that the load says");
  assert.deepEqual(load.container, { bed_height: 1.2, ...wheels.container });
  const plain = of("seed_example.txt");
  assert.deepEqual(plain.container, results.container);
  assert.deepEqual(plain.boxes.name, ["", "", ""]);
  for (const name of ["trailer.h5", "demo.h5", "earlier.h5"]) {
    const { load, masses, mats, settings } = (await open(name)).reader.world(0).loaded!;
    assert.equal(load.container, undefined, name);
    for (const box of load.boxes)
      assert.deepEqual(Object.keys(JSON.parse(JSON.stringify(box))), ["corner_min", "corner_max", "material"], name);
    assert.deepEqual([masses, mats, settings], [null, null, {}], name);
  }
});

test("a file that has nothing of loads has their boxes", async () => {
  const { reader } = await open("without-loads.h5");
  assert.equal(reader.results.ownContainers.size, 0);
  const { boxes, container, loaded } = reader.world(0);
  assert.equal(container, reader.results.container);
  assert.deepEqual(
    [boxes.name, boxes.material],
    [
      ["", "", ""],
      ["1", "1", "1"],
    ],
  );
  assert.ok(boxes.mat.every(Number.isNaN) && boxes.bearingLimit.every(Number.isNaN));
  assert.deepEqual(loaded?.settings, {});
  assert.ok(reader.criticalNames().every((name) => name === ""));
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
  const { inPlace, withinLimits } = reader.results.margins!;
  assert.equal(inPlace.margin.length, 8);
  assert.ok(withinLimits!.margin.every((margin, i) => margin >= inPlace.margin[i]));
  assert.ok(withinLimits!.criticalBox.some((box) => box > 0));
  assert.ok(reader.results.replicas!.count.some((count) => count > 0));
  const { walls, series } = reader.world(0);
  assert.equal(walls?.peak.length, 8);
  assert.equal(walls?.force.length, 8 * series!.time.length);
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

test("links, and columns that claim to be huge, are refused in a sentence", async () => {
  const make = `
import h5py, shutil, sys
for kind in ("link", "circle", "huge"):
    path = f"{sys.argv[1]}/{kind}.h5"
    shutil.copy(f"{sys.argv[1]}/demo.h5", path)
    with h5py.File(path, "r+") as file:
        name = "/boxes/mass" if kind == "huge" else "/inputs/layouts/name"
        kept = file[name].dtype
        del file[name]
        if kind == "huge": file.create_dataset(name, (10**10,), kept, chunks=(1000,))
        else: file[name] = h5py.SoftLink(name) if kind == "circle" else h5py.ExternalLink("demo.h5", name)
`;
  execFileSync("/usr/bin/python3", ["-c", make, RESULTS]);
  for (const name of ["link.h5", "circle.h5"])
    await assert.rejects(open(name), /name is a link, which files of holdfast do not have/);
  await assert.rejects(async () => (await open("huge.h5")).file.numbers("boxes/mass"), /too large to be shown/);
});

test("opening a file reads little of its series", async () => {
  const { source } = await open("rich.h5");
  assert.ok(source.bytesRead <= source.size);
});
