import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { csvNumber } from "../../viewer/src/save/csv_field";
import { choose, closeBrowser, openPage } from "./browser";
import { ENGINE, PROGRAM, ROOT } from "./places";

const skip = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";
const folder = mkdtempSync(path.join(tmpdir(), "holdfast-save-"));

after(async () => {
  rmSync(folder, { recursive: true });
  await closeBrowser();
});

/** Loads with containers, masses, mats and fixed boxes of their own, a layout file, and two that cannot be used. */
const FILES = ["tests/viewer/loads.json", "configs/loads/trailer.csv", "configs/layouts/BR8_009_layer.txt"];
const WRONG = {
  "wrong.csv": "name,x_m,y_m,z_m,length_m,width_m,height_m\r\nA,0,0,0,1,wide,1\r\n",
  "overlap.txt": "Two boxes\n0 0 0 100 100 100 1\n50 0 0 150 100 100 1\n",
};
const NAMES = [...FILES.map((file) => path.basename(file)), ...Object.keys(WRONG)];
for (const file of FILES) copyFileSync(path.join(ROOT, file), path.join(folder, path.basename(file)));
for (const [name, text] of Object.entries(WRONG)) writeFileSync(path.join(folder, name), text);

/** What the program says; it ends with 1 where a load could not be used. */
function program(...words: string[]): string {
  const { stdout, stderr, status } = spawnSync(PROGRAM, words, { cwd: folder, encoding: "utf8" });
  assert.ok(status === 0 || status === 1, stderr);
  return stdout;
}
const read = (...names: string[]) => readFileSync(path.join(folder, ...names), "utf8");

/** What the page gives when a button is pressed. */
async function saved(page: Page, button: string, name: string): Promise<string> {
  const [file] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  await file.saveAs(path.join(folder, name));
  return file.suggestedFilename();
}

async function savedAs(page: Page, kind: string, name: string): Promise<string> {
  await page.selectOption(".progress select", { label: kind });
  return saved(page, ".progress button:text-is('Save results')", name);
}

async function screen(page: Page, names: readonly string[]): Promise<void> {
  await page.setInputFiles(
    'input[aria-label="Files"]',
    names.map((name) => path.join(folder, name)),
  );
  await page.waitForSelector(".go button.primary:not([disabled])");
  await page.click(".go button.primary");
  await page.waitForFunction(() => / in \d/.test(document.querySelector(".progress")?.textContent ?? ""));
}

/** Prints a line for each dataset and attribute of a file, as h5py reads it: place, type, shape and values. */
const LIST = `
import h5py, json, sys
def told(place, value, of):
    values = value.tolist() if hasattr(value, "tolist") else value
    print(json.dumps([place, [str(of.dtype), list(of.shape), str(values)]]))
def visit(name, node):
    for key, value in node.attrs.items():
        told(f"{name} {key}", value, node.attrs.get_id(key))
    if isinstance(node, h5py.Dataset):
        told(name, node[()], node)
with h5py.File(sys.argv[1]) as file:
    visit("", file)
    file.visititems(lambda name, node: visit(f"/{name}", node))
`;

function contentsOf(name: string): Map<string, unknown> {
  const lines = execFileSync("/usr/bin/python3", ["-c", LIST, path.join(folder, name)], { encoding: "utf8" });
  return new Map(
    lines
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line)),
  );
}

/** The rows of the matrix, as they are drawn. */
async function matrixOf(page: Page): Promise<string> {
  await page.mouse.move(0, 0);
  const { x, y } = (await page.locator("canvas").boundingBox())!;
  const picture = await page.screenshot({ clip: { x, y, width: 830, height: 240 } });
  return picture.toString("base64");
}

/** What is of the program that ran, of its machine and of its clock. */
const OTHERS = /^ (git_commit|command_line|created_utc|host|fingerprint)$|\/cpu_seconds$/;

/** Lines of a table of worlds without the last column, the seconds. */
const withoutSeconds = (table: string) => table.split("\r\n").map((line) => line.slice(0, line.lastIndexOf(",")));

test("a screening is saved: file and tables of the program, and the same matrix when it is opened", {
  skip,
}, async () => {
  const page = await openPage();
  await screen(page, NAMES);
  assert.equal(await savedAs(page, "results file", "page.h5"), "5 files.h5");
  await savedAs(page, "CSV of worlds", "worlds.csv");
  await savedAs(page, "CSV of boxes", "boxes.csv");
  await savedAs(page, "CSV of margins", "margins.csv");
  await saved(page, ".tools button:text-is('CSV')", "matrix.csv");
  const shown = [await page.innerText(".counts"), await matrixOf(page)];

  program("screen", "--layouts", ...NAMES, "--norm", "road", "--margins", "--no-series", "--quiet", "-o", "program.h5");
  const [ours, theirs] = [contentsOf("page.h5"), contentsOf("program.h5")];
  assert.deepEqual([...ours.keys()].sort(), [...theirs.keys()].sort());
  let compared = 0;
  for (const [place, value] of theirs) {
    if (OTHERS.test(place)) continue;
    assert.deepEqual(ours.get(place), value, place);
    ++compared;
  }
  assert.ok(compared > 300, `${compared} places`);

  // The program reads it, and says the same of it.
  assert.equal(program("summary", "page.h5"), program("summary", "program.h5"));
  for (const of of ["page", "program"]) program("summary", `${of}.h5`, "--csv", of);
  for (const tables of [["page", "worlds.csv"], ["worlds.csv"]])
    assert.deepEqual(withoutSeconds(read(...tables)), withoutSeconds(read("program", "worlds.csv")));
  for (const tables of [["page", "boxes.csv"], ["boxes.csv"]])
    assert.deepEqual(read(...tables).split("\r\n"), read("program", "boxes.csv").split("\r\n"));
  for (const tables of [["page", "margins.csv"], ["margins.csv"]])
    assert.equal(read(...tables), read("program", "margins.csv"));
  program("report", "page.h5", "-o", "report.html");
  assert.match(read("report.html"), /screened in the page/);

  // The table of the matrix has the same cells.
  const cellsOf = (table: string) => {
    const [head, ...lines] = table.trim().split(/\r?\n/);
    const names = head.split(",");
    return lines.map((line) => Object.fromEntries(line.split(",").map((cell, i) => [names[i], cell])));
  };
  const worlds = cellsOf(read("program", "worlds.csv"));
  for (const { judged_at, ...cells } of cellsOf(read("matrix.csv"))) {
    assert.equal(judged_at, "any_time");
    const world = worlds.find((of) => of.layout === cells.layout && of.acceleration === cells.acceleration)!;
    for (const [name, cell] of Object.entries(cells)) assert.equal(cell, world[name], name);
  }

  // So does the page, when it opens the file.
  await choose(page, path.join(folder, "page.h5"));
  assert.deepEqual([await page.innerText(".counts"), await matrixOf(page)], shown);
  await saved(page, ".tools button:text-is('CSV')", "again.csv");
  assert.equal(read("again.csv"), read("matrix.csv"));
  await page.close();
});

test("a load that was mended is saved as it is now", { skip }, async () => {
  const page = await openPage();
  await screen(page, ["trailer.csv"]);
  await page.evaluate(() => {
    location.hash = "world=1&box=20";
  });
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.click("button:text-is('Mend')");
  await page.click(".mend button:text-is('Take away')");
  await page.waitForSelector("#app:not([aria-busy]) .mend button:text-is('Undo'):not([disabled])");
  await page.waitForFunction(() => !/…/.test(document.querySelector<HTMLElement>(".mend table")!.innerText));
  await saved(page, ".mend button:text-is('Save load')", "mended.json");
  await page.keyboard.press("m");
  await page.waitForSelector("main.fleet");
  assert.equal(await savedAs(page, "results file", "mended.h5"), "trailer.h5");
  program(
    "screen",
    "--layouts",
    "mended.json",
    "--norm",
    "road",
    "--margins",
    "--no-series",
    "--quiet",
    "-o",
    "load.h5",
  );
  const [ours, theirs] = [contentsOf("mended.h5"), contentsOf("load.h5")];
  for (const [place, value] of theirs)
    if (!OTHERS.test(place) && place !== "/inputs/layouts/name") assert.deepEqual(ours.get(place), value, place);
  await page.close();
});

test("of a screening that is cancelled, the loads are saved that were simulated whole", { skip }, async () => {
  const [head, ...boxes] = read("trailer.csv").trim().split("\n");
  // So many that a busy machine cancels before the last one.
  const loads = Array.from({ length: 500 }, (_, load) => boxes.map((box) => `Tour ${load + 1},${box}`)).flat();
  writeFileSync(path.join(folder, "many.csv"), [`load,${head}`, ...loads].join("\n"));
  const page = await openPage();
  await page.setInputFiles('input[aria-label="Files"]', path.join(folder, "many.csv"));
  await page.click(".go button.primary:not([disabled])");
  await page.waitForFunction(() => {
    const done = Number(/^(\d+) of 2000 worlds/.exec(document.querySelector<HTMLElement>(".progress")!.innerText)?.[1]);
    return done >= 6;
  });
  assert.ok(await page.isDisabled(".progress button:text-is('Save results')"));
  await page.click(".progress button:text-is('Cancel')");
  await page.waitForSelector(".progress button:text-is('Save results'):not([disabled])");
  const worlds = Number(/^(\d+) of 2000/.exec(await page.innerText(".progress"))![1]);
  assert.ok(worlds < 2000, `${worlds} worlds`);
  await savedAs(page, "results file", "part.h5");
  program("summary", "part.h5", "--csv", "part");
  const lines = read("part", "worlds.csv").trim().split("\r\n");
  assert.equal((lines.length - 1) % 4, 0);
  assert.ok(lines.length > 1 && lines.length - 1 <= worlds, `${lines.length - 1} worlds of ${worlds}`);
  await page.close();
});

test("numbers of tables are written as the program writes them", () => {
  const doubles = {
    0.1: "0.1",
    1e-4: "0.0001",
    1e-5: "1e-05",
    1.5e-9: "1.5e-09",
    1e15: "1000000000000000",
    1e16: "1e+16",
  };
  for (const [number, text] of Object.entries(doubles)) assert.equal(csvNumber(Number(number), false), text);
  assert.equal(csvNumber(Math.fround(0.1), true), "0.1");
  assert.equal(csvNumber(Math.fround(6.321449e-7), true), "6.321449e-07");
  assert.equal(csvNumber(Math.fround(16777216), true), "16777216");
  assert.equal(csvNumber(-0, true), "-0");
  assert.equal(csvNumber(Number.NaN, true), "");
});
