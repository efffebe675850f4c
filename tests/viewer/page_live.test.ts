import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";
import { ENGINE, PAGE, PROGRAM } from "./places";

const skip = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";

after(closeBrowser);

/** The fourth world of the file: 81 boxes under braking, of which some fall. */
async function openLive(file = "demo.h5", world = 5): Promise<Page> {
  const page = await openPage({ file });
  await page.evaluate((hash) => {
    location.hash = hash;
  }, `world=${world}`);
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.live");
  await page.waitForTimeout(200);
  return page;
}

/** Waits until the text of a part of the page is such. */
const says = (page: Page, part: string, words: RegExp) =>
  page.waitForFunction(
    ([selector, source]) => new RegExp(source).test(document.querySelector<HTMLElement>(selector)!.innerText),
    [part, words.source],
  );

/** The least accuracy: the world starts anew. */
async function chooseScreening(page: Page): Promise<void> {
  await page.selectOption(".drive select", "screening");
  await says(page, ".speed", /Stands at the start/);
  await page.waitForTimeout(300);
}

/** Takes the keys from a field, so that they drive. */
const leaveField = (page: Page) => page.evaluate(() => (document.activeElement as HTMLElement).blur());
const seconds = async (page: Page) => Number.parseFloat(await page.innerText(".readout"));
const reaches = (page: Page, time: number) =>
  page.waitForFunction((least) => Number.parseFloat(document.querySelector(".readout")!.textContent!) >= least, time);
/** Displacement in the list of boxes: that of a box, m. */
const moved = (page: Page, box: number) =>
  page.evaluate((id) => {
    const row = [...document.querySelectorAll(".rows .row")].find((of) => of.firstChild?.textContent === String(id));
    const [number, unit] = row!.children[2].textContent!.split(" ");
    return number === "" ? 0 : Number(number) * { mm: 0.001, cm: 0.01, m: 1 }[unit]!;
  }, box);

/** Verdict, counts and critical box of a panel, without the times. */
const judgement = async (page: Page) =>
  (await page.innerText(".panel .top")).replace(/native|live/, "").replaceAll(/, at [\d.]+ s/g, "");

test("a replayed world has the bits of the file, its verdict, its counts and its critical box", { skip }, async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.evaluate(() => {
    location.hash = "world=5";
  });
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  const recorded = await judgement(page);
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.live");
  assert.match(await page.innerText(".panel .top"), /^[^\w]*stayed/, "nothing has happened at the start");
  assert.doesNotMatch(await page.innerText(".panel .top"), /State hash/, "that of the file is of another world");
  await page.selectOption(".player select", "4");
  await leaveField(page);
  await page.keyboard.press("b");
  await page.waitForSelector(".bits.same", { timeout: 120_000 });
  assert.match(await page.innerText(".bits"), /^The same bits as the file\s+[0-9a-f]{16}$/);
  assert.equal(await judgement(page), recorded);
  await page.close();
});

test("an unstable load is not accelerated, and its replay has the bits of the file", { skip }, async () => {
  const page = await openLive("demo.h5", 13);
  await says(page, ".speed", /unstable under gravity alone: it is not accelerated/);
  await page.keyboard.press(" ");
  await page.waitForTimeout(300);
  assert.equal(await seconds(page), 0);
  assert.match(await page.innerText(".panel .top"), /^[^\w]*unstable/);
  await page.keyboard.press("b");
  await page.waitForSelector(".bits.same");
  await page.close();
});

/** Saves what was driven, and gives what `holdfast screen` says of the three files. */
async function screenSaved(page: Page) {
  const folder = mkdtempSync(path.join(tmpdir(), "holdfast-live-"));
  try {
    const files: Record<string, string> = {};
    for (const name of ["Load", "Acceleration", "Settings"]) {
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.click(`.drive .buttons button:text-is("${name}")`),
      ]);
      files[name] = path.join(folder, download.suggestedFilename());
      await download.saveAs(files[name]);
    }
    await says(page, ".saved", /-live\.ini/);
    const words = ["screen", "-c", files.Settings, "--layouts", files.Load, "--accelerations", files.Acceleration];
    words.push("--json", "--quiet", "-o", path.join(folder, "results.h5"));
    return JSON.parse(execFileSync(PROGRAM, words, { encoding: "utf8" }));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

for (const { number, container, cause } of [
  { number: 3, container: "trailer-curtain", cause: /Box 1, Drinks 1[\s\S]*more than friction holds \(0\.30 g\)/ },
  { number: 6, container: "4\\.00 × 2\\.20 × 2\\.00 m; rear open", cause: /Box 2, Pump/ },
])
  test(`a load that says more than places has the bits of the file, and what is saved has them too, world ${number}`, {
    skip,
  }, async () => {
    const page = await openLive("loads.h5", number);
    await leaveField(page);
    assert.match(await page.innerText(".panel"), new RegExp(`In a container of its own: ${container}`));
    await page.keyboard.press("b");
    await page.waitForSelector(".bits.same");
    assert.match(await page.innerText(".panel .top"), cause);
    const world = await screenSaved(page);
    assert.match(await page.innerText(".bits"), new RegExp(world.state_hash));
    const said = await page.innerText(".saved");
    assert.match(said, new RegExp(`holdfast screen says ${world.verdict}, hash ${world.state_hash}\\.`));
    await page.close();
  });

test("a world that is not touched ends as the file; accuracy starts it anew", { skip }, async () => {
  const page = await openLive("demo.h5", 1);
  await leaveField(page);
  await page.keyboard.press(" ");
  await says(page, ".speed", /Paused at 3\.00 s/);
  await chooseScreening(page);
  await page.keyboard.press("r");
  await says(page, ".speed", /Stands at the start/);
  await page.waitForFunction(() => document.querySelector(".readout")!.textContent === "0.00 s");
  await page.keyboard.press(".");
  await reaches(page, 0.01);
  assert.ok((await seconds(page)) < 0.03, "a step is a sixtieth of a second");
  await page.close();
});

test("arrow keys drive: boxes move, and what was driven is screened by the program to the same bits", {
  skip,
}, async () => {
  const page = await openLive();
  await chooseScreening(page);
  await leaveField(page);
  await page.keyboard.press("0");
  for (let press = 0; press < 7; ++press) await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowUp");
  await says(page, ".drive", /by hand[\s\S]*along\s+0\.70 g front[\s\S]*across\s+0\.10 g right/);
  await page.keyboard.press(" ");
  await reaches(page, 0.5);
  await page.keyboard.press("ArrowUp");
  await reaches(page, 0.8);
  await page.keyboard.press(" ");
  assert.match(await page.innerText(".panel .top"), /moved[\s\S]*beyond a limit first/);

  const world = await screenSaved(page);
  assert.equal(world.boxes, 81);
  const said = await page.innerText(".saved");
  assert.match(said, new RegExp(`holdfast screen says ${world.verdict}, hash ${world.state_hash}\\.`));
  assert.ok(world.moved_boxes > 10);
  await page.close();
});

test("the slider of friction acts on the way, and tells that it is no longer the file's", { skip }, async () => {
  const page = await openLive("demo.h5", 1);
  await says(page, ".drive", /μ\s+file/);
  await page.focus("input[aria-label='Coefficient of friction of all pairs']");
  await page.keyboard.press("Home");
  await says(page, ".drive", /μ\s+0\.00/);
  await page.keyboard.press(" ");
  // It has as long to come to rest as the settings say.
  await says(page, ".speed", /Paused at 8\.00 s/);
  assert.match(await page.innerText(".panel .top"), /moved/);
  await page.close();
});

test("a box is pulled with the pointer", { skip }, async () => {
  const page = await openLive("demo.h5", 1);
  await chooseScreening(page);
  await leaveField(page);
  await page.keyboard.press("0");
  await page.keyboard.press(" ");
  await reaches(page, 0.1);
  // From the left, the picture's x is that of the container: the box that is taken goes along.
  await page.keyboard.press("2");
  await page.waitForTimeout(300);
  const at = await findBox(page);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 40, at.y - 60, { steps: 3 });
  await says(page, ".speed", /Pulls with [\d.]+ k?N/);
  await page.waitForTimeout(1500);
  await page.mouse.up();
  await page.keyboard.press(" ");
  const box = Number((await page.innerText(".panel .box h2")).replace(/\D/g, ""));
  assert.ok((await moved(page, box)) > 0.05, `box ${box} has moved by ${await moved(page, box)} m`);
  await page.close();
});

/** A place of the picture where a box is. */
async function findBox(page: Page): Promise<{ x: number; y: number }> {
  const scene = (await page.locator(".scene canvas").boundingBox())!;
  for (let row = 0.75; row > 0.3; row -= 0.05)
    for (let column = 0.15; column < 0.9; column += 0.1) {
      const at = { x: scene.x + column * scene.width, y: scene.y + row * scene.height };
      await page.mouse.move(at.x, at.y);
      await page.waitForTimeout(120);
      if (await page.isVisible(".hint")) return at;
    }
  throw new Error("no box is seen");
}

test("a box is put elsewhere by its number, by key and by pointer; the engine says what cannot be", {
  skip,
}, async () => {
  const page = await openLive("demo.h5", 1);
  const field = page.locator("input[aria-label^='From the front']");
  await page.focus(".scroller");
  await page.keyboard.press("ArrowDown");
  const before = Number(await field.inputValue());
  await page.keyboard.press("Shift+ArrowRight");
  await page.waitForFunction(
    (value) => document.querySelector<HTMLInputElement>("input[aria-label^='From the front']")!.value === value,
    String(before + 1),
  );
  await says(page, ".drive .problem", /box \d+ overlaps box \d+/);
  await field.fill("700");
  await field.press("Enter");
  await says(page, ".drive .problem", /outside/);
  await field.fill(String(before));
  await field.press("Enter");
  await page.waitForSelector(".drive .problem[hidden]", { state: "attached" });
  await page.keyboard.press("4");
  await page.waitForTimeout(300);
  const at = await findBox(page);
  await page.mouse.click(at.x, at.y);
  await says(page, ".drive", /BOX \d+/i);
  const places = () =>
    page.$$eval<string, HTMLInputElement>(".corner input", (all) => all.map(({ value }) => value).join(" "));
  const stood = await places();
  await page.mouse.down();
  await page.mouse.move(at.x + 8, at.y + 30, { steps: 3 });
  await page.mouse.up();
  await page.waitForTimeout(500);
  const stands = await places();
  assert.notEqual(stands, stood);
  assert.equal(stands.split(" ")[2], stood.split(" ")[2], "it stays on its level");
  await page.close();
});

test("reset at the start brings back the layout of the file", { skip }, async () => {
  const page = await openLive("demo.h5", 1);
  await page.focus(".scroller");
  await page.keyboard.press("ArrowDown");
  const field = page.locator("input[aria-label^='From the front']");
  const before = await field.inputValue();
  await field.fill("700");
  await field.press("Enter");
  await says(page, ".drive .problem", /outside/);
  await page.click(".drive button:text-is('Restore')");
  await page.waitForSelector(".drive .problem[hidden]", { state: "attached" });
  assert.equal(await field.inputValue(), before);
  await page.close();
});

test("a page without the engine says so", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "holdfast-live-"));
  try {
    const file = path.join(folder, "viewer.html");
    const whole = readFileSync(PAGE, "utf8");
    writeFileSync(file, whole.replace(/(<script type="text\/plain" id="engine">)[^<]*/, "$1"));
    const page = await openPage({ address: `file://${file}`, file: "demo.h5" });
    await page.evaluate(() => {
      location.hash = "world=5";
    });
    await page.waitForSelector("#app:not([aria-busy]) > main.world");
    assert.equal(await page.getAttribute(".options button:text-is('Live')", "aria-disabled"), "true");
    await page.keyboard.press("l");
    await says(page, "header", /This page has no engine in it: make viewer-engine/);
    await page.close();
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("escape and L go back to the file", { skip }, async () => {
  const page = await openLive();
  await page.keyboard.press("Escape");
  await page.waitForSelector("#app:not([aria-busy]) > main.world:not(.live)");
  await page.keyboard.press("l");
  await page.waitForSelector("main.live");
  await page.keyboard.press("m");
  await page.waitForSelector("main.fleet");
  await page.close();
});
