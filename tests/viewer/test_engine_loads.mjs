// Loads in the engine of the page: what it reads of files, and what becomes of them, is what the program says.
//   node --test tests/viewer/test_engine_loads.mjs        after `make viewer-engine` and `make program`
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { ENGINE, PROGRAM, root } from "./engine_worlds.mjs";

const { loadEngine, EngineError } = await import(ENGINE);
const engine = await loadEngine();
const folder = mkdtempSync(path.join(tmpdir(), "holdfast-loads-"));
after(() => rmSync(folder, { recursive: true }));

const FOLDERS = ["configs/loads", "tests/io/loads/formats", "tests/fuzz/corpus/table", "tests/fuzz/corpus/json"];
const files = FOLDERS.flatMap((of) =>
  readdirSync(path.join(root, of))
    .filter((name) => /\.(csv|json|jsonl|txt)$/.test(name) && !name.endsWith(".schema.json"))
    .map((name) => path.join(root, of, name)),
);

/** All messages of a file, as `holdfast check` prints them. */
function messagesOf(file, options = []) {
  const { stdout, stderr } = spawnSync(PROGRAM, ["check", ...options, path.basename(file)], {
    cwd: path.dirname(file),
    encoding: "utf8",
  });
  const said = `${stderr}${stdout}`.split("\n").map((line) => line.replace(/^warning: /, ""));
  return said.filter((line) => line !== "" && !/^[^:]+: (ok|bad): |^\d+ of \d+ files? |^ {2}/.test(line)).sort();
}

/** The loads of a file, as `holdfast convert` writes them; null where it cannot. */
function convertedBy(file, options = []) {
  const output = path.join(folder, "converted.json");
  rmSync(output, { force: true });
  const done = spawnSync(PROGRAM, ["convert", file, ...options, "-o", output], { encoding: "utf8" });
  if (done.status !== 0) return null;
  const [first, ...lines] = readFileSync(output, "utf8").trimEnd().split("\n");
  return lines.length > 0 ? lines.map((line) => JSON.parse(line)) : JSON.parse(first).loads;
}

/** What the engine says of a file, in the program's words. */
function readByEngine(file, choices = {}) {
  const found = engine.readLoads(readFileSync(file), path.basename(file), choices);
  const all = [found.errors, found.notes, ...found.loads.flatMap(({ errors, warnings }) => [errors, warnings])].flat();
  return { ...found, messages: all.map(({ message }) => message).sort() };
}

/** Names of loads in a file of ours are without that of the file that they are from. */
const withoutFile = ({ name, ...load }) => ({ name: name.replace(/^[^#]*#/, ""), ...load });

test("loads of all files of the tree are those of the program, and so is every message", () => {
  let loads = 0;
  let problems = 0;
  assert.ok(files.length > 12);
  for (const file of files) {
    const found = readByEngine(file);
    assert.deepEqual(found.messages, messagesOf(file), file);
    problems += found.messages.length;
    const converted = convertedBy(file);
    if (!converted) continue;
    assert.deepEqual(
      found.loads.map(({ load }) => withoutFile(load)),
      converted.map(withoutFile),
      file,
    );
    loads += converted.length;
  }
  assert.ok(loads > 10 && problems > 8, `${loads} loads, ${problems} messages`);
});

test("options of the program have the same effect here", () => {
  const file = path.join(root, "tests/io/loads/formats/planner_export.csv");
  const found = readByEngine(file, { format: "planner" });
  assert.deepEqual(found.messages, messagesOf(file, ["--format", "planner"]));
  assert.deepEqual(
    found.loads.map(({ load }) => withoutFile(load)),
    convertedBy(file, ["--format", "planner"]).map(withoutFile),
  );
  const trailer = path.join(root, "configs/loads/trailer.csv");
  assert.deepEqual(readByEngine(trailer, { container: "20" }).messages, messagesOf(trailer, ["--container", "20"]));
});

/** Worlds and layouts of a run, as `holdfast screen --json` tells them. */
function screenedBy(words) {
  const output = path.join(folder, "results.h5");
  const options = ["--norm", "road", "--json", "--quiet", "--no-series", "--overwrite", "-o", output];
  const lines = execFileSync(PROGRAM, ["screen", ...words, ...options], { encoding: "utf8", maxBuffer: 1 << 28 });
  const all = lines
    .trim()
    .split("\n")
    .map((line) => JSON.parse(line));
  return { worlds: all.filter((one) => "verdict" in one), layouts: all.filter((one) => "margins_g" in one) };
}

function sameWorlds(worlds, loads, inputs) {
  const accelerations = engine.run(inputs).norm.accelerations.map(({ name }) => name);
  for (const world of worlds) {
    const { outcome } = engine.screenLoad(loads.get(world.layout), accelerations.indexOf(world.acceleration), inputs);
    const of = `${world.layout} under ${world.acceleration}`;
    assert.equal(outcome.stateHash, world.state_hash, of);
    assert.equal(outcome.verdict, world.verdict, of);
    assert.equal(outcome.stopReason, world.stop_reason, of);
    assert.equal(outcome.fallen, world.fallen_boxes, of);
    assert.equal(outcome.moved, world.moved_boxes, of);
    assert.equal(outcome.tilted, world.tilted_boxes, of);
    assert.equal(outcome.criticalBox, world.critical_box, of);
    assert.equal(outcome.peakDisplacement, world.peak_displacement_m, of);
  }
}

function sameMargins(layouts, loads, inputs) {
  const directions = ["front", "rear", "left", "right"];
  for (const layout of layouts) {
    const found = engine.loadMargins(loads.get(layout.layout), inputs);
    const values = (all) => directions.map((direction) => all[direction]);
    assert.deepEqual([...found.margin], values(layout.margins_g), layout.layout);
    assert.deepEqual([...found.margin_within_limits], values(layout.margins_within_limits_g), layout.layout);
    assert.deepEqual([...found.critical_box], values(layout.critical_boxes), layout.layout);
    assert.deepEqual([...found.critical_box_within_limits], values(layout.critical_boxes_within_limits), layout.layout);
  }
}

const loadsOf = (paths, choices = {}) =>
  new Map(paths.flatMap((file) => readByEngine(file, choices).loads.map(({ name, load }) => [name, load])));

test("loads with masses, mats, fixed boxes, centres of mass and containers of their own have the program's bits and margins", () => {
  const names = ["configs/loads/trailer.csv", "tests/viewer/loads.json", "tests/io/loads/formats/order_plan.json"];
  const paths = names.map((name) => path.join(root, name));
  const inputs = { settings: [["Screening", "Norm", "road"]] };
  const { worlds, layouts } = screenedBy(["--layouts", ...paths, "--margins"]);
  assert.ok(worlds.length >= 16 && layouts.length >= 4);
  assert.ok(new Set(worlds.map(({ verdict }) => verdict)).size > 1);
  sameWorlds(worlds, loadsOf(paths), inputs);
  sameMargins(layouts, loadsOf(paths), inputs);
});

test("loads under an acceleration of a file have the program's bits", () => {
  const paths = ["configs/loads/trailer.csv", "tests/viewer/loads.json"].map((name) => path.join(root, name));
  const file = path.join(root, "configs/accelerations/lane_change_2ms2.txt");
  const segments = engine.readAcceleration(readFileSync(file, "utf8"));
  const { worlds } = screenedBy(["--layouts", ...paths, "--accelerations", file]);
  const ofFile = worlds.filter(({ acceleration }) => acceleration.startsWith("lane_change"));
  assert.equal(ofFile.length, loadsOf(paths).size);
  for (const { layout, state_hash, verdict } of ofFile) {
    const { outcome } = engine.screenLoad(loadsOf(paths).get(layout), segments, {});
    assert.deepEqual([outcome.stateHash, outcome.verdict], [state_hash, verdict], layout);
  }
});

test("another container, friction and limits have the program's bits", () => {
  const config = path.join(root, "tests/viewer/loads.ini");
  const file = path.join(root, "configs/loads/trailer.csv");
  const choices = { config: readFileSync(config, "utf8"), container: "trailer-box" };
  const { worlds } = screenedBy(["-c", config, "--layouts", file, "--container", "trailer-box"]);
  sameWorlds(worlds, loadsOf([file], choices), { ...choices, settings: [["Screening", "Norm", "road"]] });
});

test("every bundled layout under the norm of the road has the program's bits, verdicts and counts", (t) => {
  const paths = ["configs/layouts", "bench/layouts"].flatMap((of) =>
    readdirSync(path.join(root, of))
      .filter((name) => name.endsWith(".txt"))
      .map((name) => path.join(root, of, name)),
  );
  const settings = [
    ["Screening", "Norm", "road"],
    ["Native", "Accuracy", "screening"],
  ];
  const { worlds } = screenedBy(["--accuracy", "screening", "--layouts", ...paths]);
  assert.equal(worlds.length, 4 * paths.length);
  sameWorlds(worlds, loadsOf(paths), { settings });
  t.diagnostic(`${worlds.length} worlds, ${new Set(worlds.map((world) => world.state_hash)).size} different hashes`);
});

test("what keeps a file from being read is told, and its first rows are there to be looked at", () => {
  const text = 'Tour of Monday\nArtikel;PosX;PosY;PosZ;Tiefe;Breite;Hoehe\n"A;1";0;0;0;80;120;100\n';
  const bytes = new TextEncoder().encode(text);
  const { errors, loads } = engine.readLoads(bytes, "a.csv");
  assert.equal(loads.length, 0);
  assert.equal(errors[0].line, 2);
  assert.match(errors[0].message, /^a\.csv:2: the header does not tell the length/);
  assert.match(errors[0].accepted, /--columns/);
  assert.deepEqual(engine.preview(bytes, 10)[2], { line: 3, cells: ["A;1", "0", "0", "0", "80", "120", "100"] });
  const columns = "PosX = x, Tiefe = length, Breite = width, Hoehe = height";
  assert.equal(engine.readLoads(bytes, "a.csv", { columns }).loads[0].boxCount, 1);
  const book = engine.readLoads(Uint8Array.of(0x50, 0x4b, 3, 4, 0, 0), "a.csv");
  assert.match(book.errors[0].message, /spreadsheet file/);
});

test("the columns of a world have what its verdict is from", () => {
  const { load } = readByEngine(path.join(root, "configs/layouts/seed_example.txt")).loads[0];
  const { outcome, columns } = engine.screenLoad(load, 0, { settings: [["Screening", "Norm", "road"]] }, true);
  const count = load.boxes.length;
  assert.equal(columns["boxes/mass"].length, count);
  assert.equal(
    columns["verdict/moved"].reduce((sum, flag) => sum + flag, 0),
    outcome.moved,
  );
  assert.equal(Math.max(...columns["boxes/peak_displacement"]), outcome.peakDisplacement);
  const samples = columns["series/time"].length;
  assert.ok(samples > 10);
  assert.equal(columns["series/displacement"].length, 3 * count * samples);
  assert.equal(columns["series/orientation"].length, 4 * count * samples);
});

test("what cannot be used is an error with a sentence", () => {
  const refused = (work, sentence) =>
    assert.throws(work, (error) => error instanceof EngineError && sentence.test(error.message));
  const box = { corner_min: [0, 0, 0], corner_max: [1, 1, 1] };
  const road = { settings: [["Screening", "Norm", "road"]] };
  refused(() => engine.screenLoad({ boxes: [box] }, 4, road), /no such acceleration/);
  refused(() => engine.screenLoad({ boxes: [box, box] }, 0, road), /overlap/);
  refused(() => engine.screenLoad({ boxes: [{ ...box, weigth: 1 }] }, 0, road), /weigth.*weight|unknown key/);
  refused(() => engine.run({ settings: [["Screening", "Norm", "roda"]] }), /roda|not a value/);
  refused(() => engine.readLoads("x;y\n", "a.csv", { container: "barge" }), /barge/);
});

/** Numbers from 0 to 1, the same in every run. */
function randomNumbers(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

test("2,000 mutations of files of loads get loads or sentences", (t) => {
  const random = randomNumbers(7);
  const pick = (list) => list[Math.floor(random() * list.length)];
  const texts = files.map((file) => ({ name: path.basename(file), bytes: readFileSync(file) }));
  const pieces = [
    '"',
    ";",
    ",",
    "\n",
    "\t",
    "-",
    "1e308",
    "nan",
    "{",
    "[",
    "\\u0000",
    "\0",
    "\xff",
    "<b>",
    "=1+1",
    "999999999999",
  ];
  let read = 0;
  let refused = 0;
  for (let i = 0; i < 2000; ++i) {
    const { name, bytes } = pick(texts);
    let mutant = Buffer.from(bytes);
    for (let change = 0; change <= i % 4; ++change) {
      const at = Math.floor(random() * mutant.length);
      const piece = Buffer.from(pick(pieces), "latin1");
      const gone = Math.floor(random() * 6);
      const put = random() < 0.7 ? piece : mutant.subarray(Math.floor(random() * mutant.length)).subarray(0, 40);
      mutant = Buffer.concat([mutant.subarray(0, at), put, mutant.subarray(at + gone)]);
    }
    const { loads, errors } = engine.readLoads(mutant, name);
    const said = [...errors, ...loads.flatMap((load) => load.errors)];
    assert.ok(said.every(({ message }) => message.length > 5));
    assert.ok(loads.every(({ load }) => Array.isArray(load.boxes)));
    if (errors.length > 0) ++refused;
    else ++read;
  }
  t.diagnostic(`${read} read, ${refused} refused as a whole`);
});

test("what rests on boxes is what the program's check finds", () => {
  const file = path.join(folder, "bridge.csv");
  const rows = ["0,0,0,50,40,100,50", "150,0,0,50,40,100,50", "0,0,100,200,40,10,20", "20,10,110,20,20,20,2"];
  writeFileSync(
    file,
    `x,y,z,length,width,height,mass
${rows.join("\n")}\n`,
  );
  const printed = execFileSync(PROGRAM, ["check", file, "--bearing"], { encoding: "utf8" });
  const told = [...printed.matchAll(/^ +\d+ .*?([\d.]+) +([\d.]+) +-$/gm)].map(([, ...range]) => range);
  assert.equal(told.length, 4);
  const { least, largest } = engine.loadBearing(readByEngine(file).loads[0].load, {});
  assert.deepEqual(
    told.map((_, box) => [least[box].toFixed(2), largest[box].toFixed(2)]),
    told,
  );
});
