// Makes the results files that the tests of the page read: node tests/viewer/results.mjs PROGRAM FOLDER
import { spawn, spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), "../..");
const [program, folder] = process.argv.slice(2).map((argument) => path.resolve(argument));
const at = (name) => path.join(folder, name);
const layouts = ["seed_example", "BR15_077_ep", "BR8_009_ep", "unstable_BR2_007_bpjs"].map(
  (name) => `${root}/configs/layouts/${name}.txt`,
);

const DEMO = `${root}/configs/demo.ini`;

function screen(output, config, ...options) {
  const words = ["screen", "--quiet", "-c", config, "-o", at(output), "--overwrite", ...options];
  const { status } = spawnSync(program, words, { stdio: "inherit" });
  if (status !== 0) throw new Error(`holdfast ${words.join(" ")} ended with ${status}`);
}

/** A part of a run that is killed when its first part is there. */
async function unfinished() {
  const parts = `${at("killed.h5")}.parts`;
  rmSync(parts, { recursive: true, force: true });
  // Parts appear every two seconds: with all layouts the run takes several times as long.
  const folders = [`${root}/configs/layouts`, `${root}/bench/layouts`];
  const words = ["screen", "--quiet", "-c", DEMO, ...folders.flatMap((each) => ["--layouts", each])];
  const run = spawn(program, [...words, "--norm", "road", "--threads", "1", "-o", at("killed.h5"), "--overwrite"]);
  const ended = new Promise((resolve) => run.on("exit", resolve));
  while (run.exitCode === null && !existsSync(`${parts}/part-000001.h5`)) await new Promise((go) => setTimeout(go, 20));
  run.kill("SIGKILL");
  await ended;
  copyFileSync(`${parts}/part-000001.h5`, at("part.h5"));
  rmSync(parts, { recursive: true, force: true });
}

async function library() {
  const hdf5 = await import(`${root}/viewer/node_modules/h5wasm/dist/node/hdf5_hl.js`);
  await hdf5.ready;
  return hdf5;
}

async function foreign() {
  const hdf5 = await library();
  const file = new hdf5.File(at("foreign.h5"), "w");
  file.create_dataset({ name: "temperature", data: new Float64Array([1, 2, 3]) });
  file.close();
}

/** Puts a dataset, with the groups that it is in. */
function put(file, path, data, shape, dtype) {
  const names = path.split("/").slice(1);
  const group = names.slice(0, -1).reduce((of, next) => of.get(next) ?? of.create_group(next), file);
  group.create_dataset({ name: names[names.length - 1], data, shape, dtype });
}

/** Copies a group and what is in it, without the datasets and attributes that are left out. */
function copy(hdf5, group, file, leftOut, path = "") {
  const target = path === "" ? file : file.get(path);
  for (const [key, { value, shape, dtype }] of Object.entries(group.attrs))
    if (!leftOut(`${path}/${key}`)) target.create_attribute(key, value, shape, dtype);
  for (const key of group.keys()) {
    const entity = group.get(key);
    const inside = `${path}/${key}`;
    if (entity instanceof hdf5.Group) {
      target.create_group(key);
      copy(hdf5, entity, file, leftOut, inside);
    } else if (!leftOut(inside)) put(file, inside, entity.value, entity.shape, entity.dtype);
  }
}

/** What files have since version 3, by which worlds are judged. */
const SINCE_3 =
  /\/(status_time|caveats|fallen_at_end|critical_box|first_beyond|peak_(drop|tilt|speed)|settling_peak_\w+|end_(displacement|kinetic_energy)|\w+_within_limits)$/;
/** The same names where earlier versions have them too. */
const SINCE_1 = /^\/(boxes\/end_|margins\/critical_box$)/;
/** Worlds of the file below that have ended early. */
const ENDED_EARLY = [0, 4];

/** A file of version 2, with what another one has: worlds are judged by where boxes are at the end. */
async function earlier(name, from) {
  const hdf5 = await library();
  const source = new hdf5.File(at(from), "r");
  const file = new hdf5.File(at(name), "w");
  const column = (path) => source.get(path).value;
  const judged = new Set([
    "/format_version",
    "/worlds/stop_reason",
    ...["verdict", "fallen_boxes", "moved_boxes", "tilted_boxes"].map((of) => `/summary/worlds/${of}`),
    ...["fallen", "moved", "tilted"].map((of) => `/summary/boxes/${of}`),
  ]);
  copy(hdf5, source, file, (path) => judged.has(path) || (SINCE_3.test(path) && !SINCE_1.test(path)));
  file.create_attribute("format_version", 2);

  const displacement = column("boxes/end_displacement");
  const drop = Float32Array.from(column("boxes/id"), (_, box) => -displacement[3 * box + 2]);
  const length = drop.map((_, box) => Math.hypot(...displacement.subarray(3 * box, 3 * box + 3)));
  const flags = {
    fallen: Uint8Array.from(drop, (value) => (value > 0.05 ? 1 : 0)),
    moved: Uint8Array.from(length, (value) => (value > 0.1 ? 1 : 0)),
    tilted: Uint8Array.from(column("boxes/end_tilt"), (value) => (value > 10 ? 1 : 0)),
  };
  put(file, "/summary/boxes/drop", drop);
  for (const [of, values] of Object.entries(flags)) put(file, `/summary/boxes/${of}`, values);
  const boxes = column("worlds/box_count");
  const begin = Array.from(column("worlds/box_begin"), Number);
  const ofWorld = (values, world) => Array.from(values.subarray(begin[world], begin[world] + boxes[world]));
  const count = (values) => Uint32Array.from(boxes, (_, world) => ofWorld(values, world).reduce((a, b) => a + b, 0));
  for (const of of Object.keys(flags)) put(file, `/summary/worlds/${of}_boxes`, count(flags[of]));
  put(
    file,
    "/summary/worlds/max_displacement",
    Float32Array.from(boxes, (_, world) => Math.max(...ofWorld(length, world))),
  );
  const [fallen, moved, tilted] = [flags.fallen, flags.moved, flags.tilted].map(count);
  const verdict = Uint8Array.from(boxes, (_, world) =>
    fallen[world] > 0 ? 2 : moved[world] + tilted[world] > 0 ? 1 : 0,
  );
  const stopReason = column("worlds/stop_reason").slice();
  for (const world of ENDED_EARLY) {
    verdict[world] = 5;
    stopReason[world] = 4;
  }
  put(file, "/summary/worlds/verdict", verdict);
  put(file, "/worlds/stop_reason", stopReason);
  source.close();
  file.close();
}

/** Five boxes, cm: the first goes out at the rear, the second over the left side, and the fourth is a bulkhead. */
const TRAILER = `trailer 5
460\t20\t0\t560\t120\t100\t1
200\t0\t100\t300\t80\t200\t1
200\t0\t0\t300\t80\t100\t1
0\t0\t0\t10\t233\t150\t2
10\t60\t0\t110\t160\t100\t1
`;

/** How boxes go that are on their way for a time, s: m, and the quaternion w, x, y, z. Both end on the ground. */
function trailerMoves(box, time) {
  const fall = (from, height) => -Math.min(height, 4.9 * Math.max(0, time - from) ** 2);
  const turn = (from, axis) => {
    const half = (Math.PI / 4) * Math.min(1, Math.max(0, (time - from) / 0.5));
    return [Math.cos(half), axis === 0 ? Math.sin(half) : 0, axis === 1 ? Math.sin(half) : 0, 0];
  };
  if (box === 0) return { by: [Math.min(2.1, 2 * time * time), 0, fall(0.65, 1.2)], turn: turn(0.65, 1) };
  if (box === 1) return { by: [0, -Math.min(1.6, 2 * time * time), fall(0.5, 2.3)], turn: turn(0.4, 0) };
  return { by: [0, 0, 0], turn: [1, 0, 0, 0] };
}

/** N: rows of the sides, with the ground and the fixed boxes behind them. */
const withGroundAndFixed = (forces, width) =>
  forces.flatMap((_, i) => (i % width === 0 ? [...forces.slice(i, i + 6), 4905, 700] : []));

/** A trailer whose rear and roof are open and whose left and right sides are low. How its boxes go is made by hand. */
async function trailer(name) {
  const hdf5 = await library();
  writeFileSync(at("trailer.txt"), TRAILER);
  writeFileSync(at("to-front.txt"), "0 2 -8 0 0\n");
  writeFileSync(at("trailer.ini"), "[Container]\nOpenSides = rear roof\n");
  screen(
    "sliding.h5",
    at("trailer.ini"),
    "--layouts",
    at("trailer.txt"),
    "--accelerations",
    at("to-front.txt"),
    "--wall-forces",
  );
  const source = new hdf5.File(at("sliding.h5"), "r");
  const file = new hdf5.File(at(name), "w");
  const column = (path) => source.get(path).value;
  const samples = column("series/time");
  const last = samples[samples.length - 1];
  if (last < 1.5) throw new Error(`the trailer rests at ${last} s`);
  const boxes = [0, 1, 2, 3, 4];
  const series = [...samples].flatMap((time) => boxes.map((box) => trailerMoves(box, time)));
  const end = boxes.map((box) => trailerMoves(box, last));
  const far = Float32Array.from(end, ({ by }) => Math.hypot(...by));
  const drop = Float32Array.from(end, ({ by }) => -by[2]);
  const tilt = Float32Array.of(90, 90, 0, 0, 0);
  const gone = Uint8Array.of(1, 1, 0, 0, 0);
  const nan = Number.NaN;
  const made = {
    "/series/displacement": Float32Array.from(series.flatMap(({ by }) => by)),
    "/series/orientation": Float32Array.from(series.flatMap(({ turn }) => turn)),
    "/boxes/end_displacement": Float32Array.from(end.flatMap(({ by }) => by)),
    "/boxes/settling_displacement": new Float32Array(15),
    "/boxes/peak_displacement": far,
    "/boxes/peak_drop": drop,
    "/boxes/peak_tilt": tilt,
    "/boxes/end_tilt": tilt,
    "/boxes/first_beyond": Float32Array.of(0.24, 0.25, nan, nan, nan),
    "/summary/boxes/first_beyond": Float32Array.of(0.24, 0.25, nan, nan, nan),
    "/summary/boxes/unstable": new Uint8Array(5),
    ...Object.fromEntries(["fallen", "moved", "tilted", "fallen_at_end"].map((of) => [`/summary/boxes/${of}`, gone])),
    "/summary/worlds/verdict": Uint8Array.of(2),
    "/summary/worlds/critical_box": Uint32Array.of(1),
    ...Object.fromEntries(
      ["fallen_boxes", "moved_boxes", "tilted_boxes", "fallen_at_end"].map((of) => [
        `/summary/worlds/${of}`,
        Uint32Array.of(2),
      ]),
    ),
    "/summary/worlds/unstable_boxes": Uint32Array.of(0),
    "/summary/worlds/peak_displacement": Float32Array.of(Math.max(...far)),
    "/summary/worlds/end_displacement": Float32Array.of(Math.max(...far)),
    "/summary/worlds/peak_drop": Float32Array.of(Math.max(...drop)),
    "/summary/worlds/peak_tilt": Float32Array.of(90),
  };
  const walls = ["peak_force", "lasting_force", "limit", "force"].map((of) => `/walls/${of}`);
  copy(hdf5, source, file, (path) => path in made || walls.includes(path));
  for (const [path, data] of Object.entries(made)) {
    const { shape, dtype } = source.get(path);
    put(file, path, data, shape, dtype);
  }
  for (const path of walls) {
    const { shape, value, dtype } = source.get(path);
    put(file, path, withGroundAndFixed([...value], shape[1]), [shape[0], 8], dtype);
  }
  const settings = file.get("inputs/settings");
  for (const [key, value] of [
    ["Container/DropSides", "left 60 right 60"],
    ["Container/BedHeight", "120"],
    ["Material 2/Fixed", "true"],
  ]) {
    if (key in settings.attrs) settings.delete_attribute(key);
    settings.create_attribute(key, value);
  }
  source.close();
  file.close();
}

/** A load on a trailer that is open at the rear and above, on a floor that is smoother than what the norm asks of the load. */
function onTrailer(name) {
  const friction = ["BoxBox", "BoxFloor", "BoxWall"].map((pair) => `${pair} = 0.4\n`).join("");
  const container = "OpenSides = rear roof\nDropSides = left 60 right 60\nBedHeight = 120\n";
  writeFileSync(at("open.ini"), `[Container]\n${container}[Contact]\nFrictionModel = pairs\n${friction}`);
  screen(name, at("open.ini"), "--layouts", `${root}/configs/layouts/BR8_009_layer.txt`, "--norm", "road");
}

/** Loads in JSON: a wheel arch of which nothing has to be known and a box that says all of itself; and some of each kind. */
const WHEELS = {
  holdfast: 1,
  loads: [
    {
      name: "wheels",
      container: { size: [4, 2.2, 2], open_sides: ["rear"] },
      boxes: [
        { corner_min: [0, 0, 0], corner_max: [1, 0.4, 0.5], fixed: true },
        {
          corner_min: [1, 0, 0],
          corner_max: [1.8, 1.2, 1],
          name: "Pump",
          mass: 180,
          bearing_limit: 250,
          centre_of_mass: [0.05, 0, -0.1],
        },
      ],
    },
    {
      name: "arches",
      container: { size: [4.1, 2.21, 2], drop_sides: { rear: 0.33 }, bed_height: 0.9 },
      boxes: [
        { corner_min: [1.3, 0, 0], corner_max: [2.3, 0.4, 0.5], material: "pallet", fixed: true },
        { corner_min: [0.1, 0.6, 0], corner_max: [0.9, 1.8, 1], material: "pallet", mass: 180, mat: 0.45 },
        { corner_min: [1.3, 0, 0.5], corner_max: [2.3, 0.4, 0.9], material: 7, mass: 11.5 },
        { corner_min: [3, 0.6, 0], corner_max: [3.6, 1.4, 0.8], material: "carton" },
      ],
    },
  ],
};

/** Loads that say of themselves what there is to say, beside one that says nothing. */
function loads(name) {
  writeFileSync(at("wheels.json"), JSON.stringify(WHEELS));
  writeFileSync(at("pairs.ini"), "[Friction]\npallet, floor = 0.3\ncarton, pallet = 0.5\n1, floor = 0.4\n");
  const files = [`${root}/configs/loads/trailer.csv`, at("wheels.json"), layouts[0]];
  screen(name, at("pairs.ini"), "--layouts", ...files, "--norm", "road");
}

/** A plank across two posts with a box on top, near the first post: statics leaves the shares of the posts open. */
const BRIDGE = `name,x,y,z,length,width,height,mass,bearing limit
Post 1,100,100,0,50,40,100,50,12
Post 2,250,100,0,50,40,100,50,13
Plank,100,100,100,200,40,10,20,1.5
Box,120,110,110,20,20,20,2,
`;

/** A load whose boxes say what they may bear. */
function bearing(name) {
  writeFileSync(at("bridge.csv"), BRIDGE);
  screen(name, DEMO, "--layouts", at("bridge.csv"), "--norm", "road");
}

/** Names that would be scripts where they were not text. */
function hostile(name) {
  const box = (from, called) => ({ corner_min: [from, 0, 0], corner_max: [from + 1, 1, 1], name: called });
  const boxes = [box(0, "<img src=x onerror=window.hacked=1>"), box(1.5, "</script><script>window.hacked=1</script>")];
  const loads = [{ name: "<script>window.hacked=1</script>", boxes }];
  writeFileSync(at("hostile.json"), JSON.stringify({ holdfast: 1, loads }));
  screen(name, DEMO, "--layouts", at("hostile.json"), "--norm", "road");
}

/** A file from before loads said more than places, sizes and materials. */
async function withoutLoads(name, from) {
  const hdf5 = await library();
  const source = new hdf5.File(at(from), "r");
  const file = new hdf5.File(at(name), "w");
  const since =
    /^\/inputs\/layouts\/(material_name|box_name|mass|mat|fixed|order|bearing_limit|container_\w+|\w+_sides|bed_height)$/;
  copy(hdf5, source, file, (path) => since.test(path));
  source.close();
  file.close();
}

mkdirSync(folder, { recursive: true });
loads("loads.h5");
bearing("bearing.h5");
hostile("hostile.h5");
screen("demo.h5", DEMO, "--layouts", ...layouts, "--norm", "road");
const analyses = ["--margins", "--walls", "en12642-xl", "--replicas", "27", "--damage"];
// Boxes slide sooner than on the mats of the demo: more of them fall, and the 0.5 g of the road just move them.
const cardboard = at("cardboard.ini");
writeFileSync(cardboard, readFileSync(DEMO, "utf8").replaceAll("= anti-slip", "= cardboard-cardboard"));
screen("rich.h5", cardboard, "--layouts", ...layouts.slice(0, 2), "--norm", "road", ...analyses);
screen("early.h5", DEMO, "--layouts", ...layouts, "--norm", "road", "--stop-when", "moved");
await earlier("earlier.h5", "rich.h5");
await withoutLoads("without-loads.h5", "demo.h5");
await trailer("trailer.h5");
onTrailer("open.h5");
screen("no-series.h5", DEMO, "--layouts", ...layouts, "--norm", "road", "--no-series");
const { status } = spawnSync(program, ["view", at("demo.h5"), "--no-open", "-o", at("demo.html")], {
  stdio: "inherit",
});
if (status !== 0) throw new Error(`holdfast view ended with ${status}`);
const whole = readFileSync(at("demo.h5"));
writeFileSync(at("truncated.h5"), whole.subarray(0, whole.length / 2));
// The HDF5 library reads texts of attributes from such a heap for ever.
const endless = Buffer.from(whole);
for (let heap = endless.indexOf("GCOL"); heap >= 0; heap = endless.indexOf("GCOL", heap + 4))
  endless.fill(0, heap + 16, heap + 16 + 4096);
writeFileSync(at("endless.h5"), endless);
writeFileSync(at("text.h5"), "This is no HDF5 file.\n".repeat(100));
await foreign();
await unfinished();
