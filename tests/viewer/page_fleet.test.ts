import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { after, test } from "node:test";
import { choose, closeBrowser, openPage } from "./browser";
import { PROGRAM, RESULTS } from "./places";

after(closeBrowser);

test("a file opens as the fleet, and its table is saved", async () => {
  const page = await openPage({ file: "demo.h5" });
  assert.match(await page.innerText("header"), /demo\.h5\s+16 worlds/);
  assert.match(await page.innerText("aside"), /stayed\s+\d+/);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("text=CSV")]);
  const lines = readFileSync(await download.path(), "utf8")
    .trim()
    .split("\n");
  assert.equal(lines.length, 17);
  assert.match(
    lines[0],
    /^layout,acceleration,container,verdict,judged_at,.*,critical_box,critical_box_name,peak_displacement_m,/,
  );
  await page.close();
});

test("the overview has the caveats, both margins, and what is not modelled", async () => {
  const page = await openPage({ file: "rich.h5" });
  const aside = await page.innerText("aside");
  assert.match(aside, /caveats[\s\S]*\smarginal\s+6/i);
  assert.match(aside, /Straps, air bags and stretch film are not modelled\./);
  await page.keyboard.press("ArrowDown");
  const detail = await page.innerText(".detail");
  assert.match(detail, /largest displacement\s+[\d.]+ cm\s+displacement at the end/);
  assert.match(detail, /(goes first|nearest to a limit)\s+box \d+/);
  assert.match(detail, /margins in place\s+front [\d.]+ g.*\s+margins within the limits\s+front [\d.]+ g/);
  const scales = await page.innerText(".tools select[aria-label=Colour]");
  assert.match(scales, /largest displacement, m\s+margin within the limits, g\s+margin in place, g/);
  await page.close();
});

test("the matrix is coloured by damage and by forces on walls; verdicts keep their signs, and lose their colours", async () => {
  const page = await openPage({ file: "rich.h5" });
  const background = () => page.$eval(".verdicts .swatch", (swatch) => getComputedStyle(swatch).backgroundColor);
  assert.notEqual(await background(), "rgba(0, 0, 0, 0)");
  await page.selectOption(".tools select[aria-label=Colour]", { label: "force on walls, share of en12642-xl" });
  assert.equal(await background(), "rgba(0, 0, 0, 0)");
  assert.match(await page.innerText(".order"), /0 %\s+100 % of en12642-xl, or more/);
  await page.focus(".matrix");
  await page.keyboard.press("Home");
  assert.match(await page.innerText(".detail"), /The load is pushed to the front with 0\.8 g/);
  assert.match(await page.innerText(".detail"), /hardest on a wall\s+[\d.]+ kN, \d+ % of en12642-xl/);
  await page.selectOption(".tools select[aria-label=Colour]", { label: "boxes beyond the damage boundary" });
  assert.match(await page.innerText(".order"), /no box\s+100 boxes or more/);
  assert.match(await page.innerText(".detail"), /beyond the damage boundary\s+\d/);
  await page.close();
});

test("a file of an earlier version says that it is judged at the end", async () => {
  const page = await openPage({ file: "earlier.h5" });
  assert.match(await page.innerText("aside"), /This file is of an earlier version: .* by where boxes are at the end/);
  assert.doesNotMatch(await page.innerText("aside"), /caveats/i);
  const scales = await page.innerText(".tools select[aria-label=Colour]");
  assert.match(scales, /displacement at the end, m\s+margin in place, g/);
  assert.doesNotMatch(scales, /within the limits/);
  await page.close();
});

test("worlds that ended early are at least what their cells say", async () => {
  const page = await openPage({ file: "early.h5" });
  await page.fill("input[type=search]", "BR15");
  await page.focus(".matrix");
  await page.keyboard.press("ArrowDown");
  assert.match(await page.innerText(".detail"), /at least moved[\s\S]*moved\s+at least 1/);
  await page.close();
});

test("the page of `holdfast view` has its results in it", async () => {
  const page = await openPage({ address: `file://${RESULTS}/demo.html#world=5&time=1` });
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  assert.match(await page.innerText("header"), /demo\.h5\s+BR15_077_ep\.txt · road-front-0g8/);
  await page.close();
});

test("a page that is served asks its server alone", async () => {
  const server = spawn(PROGRAM, ["view", "--serve", "--no-open", `${RESULTS}/demo.h5`], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  try {
    const address = await new Promise<string>((told) =>
      server.stdout.once("data", (text) => told(String(text).trim())),
    );
    const page = await openPage({ address });
    await page.waitForSelector("#app:not([aria-busy]) > main.fleet");
    assert.match(await page.innerText("header"), /demo\.h5/);
    await page.keyboard.press("n");
    await page.waitForSelector("#app:not([aria-busy]) > main.world");
    await page.close();
  } finally {
    server.kill();
  }
});

test("the table has names of critical boxes, and of containers", async () => {
  const page = await openPage({ file: "loads.h5" });
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(".tools button:has-text('CSV')")]);
  const [head, ...lines] = readFileSync(await download.path(), "utf8")
    .trim()
    .split("\n");
  const fields = (line: string) => Object.fromEntries(line.split(",").map((field, i) => [head.split(",")[i], field]));
  const table = lines.map(fields);
  assert.equal(table.length, 16);
  const of = (layout: string) => table.filter((line) => line.layout === layout);
  assert.ok(of("trailer.csv").every((line) => line.container === "trailer-curtain"));
  assert.ok(of("wheels.json#wheels").every((line) => line.container === "4 x 2.2 x 2 m"));
  assert.ok(of("seed_example.txt").every((line) => line.container === "" && line.critical_box_name === ""));
  assert.ok(of("trailer.csv").some((line) => line.critical_box === "1" && line.critical_box_name === "Drinks 1"));
  await page.hover("canvas", { position: { x: 400, y: 50 } });
  assert.match(await page.innerText(".detail"), /container\s+trailer-curtain, 13\.60/);
  await page.close();
});

test("a cell says what goes first by its name", async () => {
  const page = await openPage({ file: "loads.h5" });
  await page.fill("input[type=search]", "trailer");
  await page.focus(".matrix");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() =>
    /goes first\s+box 17, Flour 1/.test(document.querySelector<HTMLElement>(".detail")?.innerText ?? ""),
  );
  await page.close();
});

test("the filter leaves the layouts that it names", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.fill("input[type=search]", "BR ep");
  assert.match(await page.innerText(".tools"), /2 of 4 layouts/);
  await page.close();
});

test("the keyboard alone moves over the matrix", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.keyboard.press("ArrowDown");
  assert.match(await page.innerText(".detail"), /unstable_BR2_007_bpjs\.txt/);
  await page.close();
});

const sentences: Record<string, RegExp> = {
  "text.h5": /text\.h5 is no HDF5 file/,
  "truncated.h5": /damaged|not all of it/,
  "foreign.h5": /no results of holdfast/,
  "endless.h5": /does not come to an end/,
};
for (const [file, sentence] of Object.entries(sentences))
  test(`${file} gets a sentence, and another file can be opened`, async () => {
    const page = await openPage({ file });
    assert.match(await page.innerText(".problem"), sentence);
    await choose(page, "demo.h5");
    assert.match(await page.innerText("header"), /16 worlds/);
    await page.close();
  });

test("a part says that its run is not finished", async () => {
  const page = await openPage({ file: "part.h5" });
  assert.match(await page.innerText("header"), /unfinished run.*--resume/);
  await page.close();
});

test("the overview says what the order is, what colours mean, and the friction that acts", async () => {
  const page = await openPage({ file: "rich.h5" });
  assert.match(await page.innerText(".order"), /^By how many boxes are unstable, then by how many fell/);
  assert.match(
    await page.innerText("aside"),
    /friction\s+box on box 0\.5, on the floor 0\.5, on walls 0\.45\s+container/,
  );
  const sort = ".tools select[aria-label=Sort]";
  const colour = ".tools select[aria-label=Colour]";
  await page.selectOption(sort, "margin");
  assert.match(await page.innerText(".order"), /^By the smallest margin/);
  for (const [scale, legend] of [
    ["displacement", /1 mm or less\s+10 m or more.*\s+not known/],
    ["margin", /1 g or more\s+0 g, or unstable\s+not known/],
    ["place", /1 g or more\s+0 g, or unstable\s+not known/],
    ["share", /0, none fails\s+1, all fail\s+not known/],
  ] as const) {
    await page.selectOption(colour, scale);
    assert.match(await page.innerText(".colours"), legend);
  }
  await page.evaluate(() => {
    location.hash = "scale=displacement&sort=name";
  });
  await page.waitForFunction((of) => document.querySelector<HTMLSelectElement>(of)?.value === "displacement", colour);
  assert.equal(await page.inputValue(sort), "name", "choices follow the address");
  await page.close();
});
