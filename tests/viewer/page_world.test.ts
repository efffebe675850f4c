import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";
import { RESULTS } from "./places";

after(closeBrowser);

const shown = (page: Page) => page.waitForSelector("#app:not([aria-busy]) > main.world");
const reads = (page: Page, time: RegExp) =>
  page.waitForFunction(
    (source) => new RegExp(source).test(document.querySelector(".readout")?.textContent ?? ""),
    time.source,
  );

/** Opens a world of a file by its number. */
async function openWorld(file: string, world: number, more = "") {
  const page = await openPage({ file });
  await page.evaluate((hash) => {
    location.hash = hash;
  }, `world=${world}${more}`);
  await shown(page);
  return page;
}

/** How many colours a picture has: one that is drawn has many. */
async function colours(page: Page): Promise<number> {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.evaluate(() => {
    const source = document.querySelector(".scene canvas") as HTMLCanvasElement;
    const copy = document.createElement("canvas");
    copy.width = source.width;
    copy.height = source.height;
    const context = copy.getContext("2d") as CanvasRenderingContext2D;
    context.drawImage(source, 0, 0);
    const pixels = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
    return new Set(pixels).size;
  });
}

test("from the fleet to the critical box, with the keyboard alone", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.keyboard.press("n");
  await shown(page);
  assert.ok((await colours(page)) > 100, "the load is drawn");
  assert.match(await page.innerText(".panel"), /what goes first\s+Box \d+ .*beyond a limit first, at −?\d\.\d\d s/i);
  await page.focus(".panel .link");
  await page.keyboard.press("Enter");
  assert.match(await page.innerText(".panel .box"), /largest displacement\s+[\d.]+ cm\s+displacement at the end/);
  await page.keyboard.press("f");
  await page.keyboard.press("m");
  await page.waitForSelector("main.fleet");
  await page.close();
});

test("arrows go by sample, with shift to where a box is beyond a limit; the address follows", async () => {
  const page = await openWorld("demo.h5", 5);
  await page.keyboard.press("ArrowRight");
  await reads(page, /^0\.10 s$/);
  await page.keyboard.press("Shift+ArrowRight");
  await reads(page, /^0\.[5-9]\d s$/);
  await page.waitForFunction(() => /world=5&time=0\.[5-9]/.test(location.hash));
  await page.keyboard.press("End");
  await reads(page, /^[3-9]\.\d\d s$/);
  const last = await page.innerText(".readout");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.innerText(".readout"), last, "nothing comes after the end");
  await page.goBack();
  await page.waitForSelector("main.fleet");
  await page.close();
});

test("space plays and pauses", async () => {
  const page = await openWorld("demo.h5", 5);
  await page.keyboard.press(" ");
  await reads(page, /^0\.[1-9]/);
  await page.keyboard.press(" ");
  await page.waitForSelector(".play[aria-label=Play]");
  await page.waitForTimeout(500);
  const time = await page.innerText(".readout");
  await page.waitForTimeout(500);
  assert.equal(await page.innerText(".readout"), time);
  await page.close();
});

test("a click chooses the box under the pointer", async () => {
  const page = await openWorld("demo.h5", 5);
  await page.waitForTimeout(200);
  const scene = await page.locator(".scene canvas").boundingBox();
  await page.mouse.click(scene!.x + scene!.width / 2, scene!.y + scene!.height / 2);
  assert.match(await page.innerText(".panel .box"), /BOX \d+|Box \d+/);
  await page.keyboard.press("Escape");
  assert.match(await page.innerText(".panel .box"), /Point at a box/);
  await page.close();
});

test("displaced boxes are blue, others are not", async () => {
  const page = await openWorld("demo.h5", 5, "&time=2&colouring=displacement");
  const blue = () =>
    page.evaluate(() => {
      const source = document.querySelector(".scene canvas") as HTMLCanvasElement;
      const copy = document.createElement("canvas");
      copy.width = source.width;
      copy.height = source.height;
      const context = copy.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(source, 0, 0);
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i + 2] - data[i] > 60) ++count;
      return count;
    });
  await colours(page);
  assert.ok((await blue()) > 10_000);
  await page.keyboard.press("Home");
  await reads(page, /^0\.00 s$/);
  await colours(page);
  assert.ok((await blue()) < 1000);
  await page.close();
});

for (const colouring of ["displacement", "speed", "tilt", "first", "material", "mass"])
  test(`boxes are coloured by ${colouring}`, async () => {
    const page = await openWorld("demo.h5", 5, `&time=1&colouring=${colouring}`);
    assert.equal(await page.inputValue(".options select"), colouring);
    assert.ok((await colours(page)) > 100);
    assert.ok((await page.innerText(".colours")).length > 0);
    await page.close();
  });

test("boxes are coloured by how near they came to the damage boundary, and say their hardest impact", async () => {
  const page = await openWorld("rich.h5", 5, "&colouring=damage&box=60");
  assert.match(await page.innerText(".colours"), /not struck\s+twice the damage boundary, or more/);
  assert.match(await page.innerText(".panel .box"), /hardest impact\s+[\d.]+ g, [\d.]+ m\/s/);
  assert.match(
    await page.innerText(".panel .top"),
    /The load is pushed to the front with 0\.8 g, from 0\.5 s to 1\.5 s\./,
  );
  await page.close();
});

test("a scale has two ends: where one box goes beyond a limit, its time has one colour", async () => {
  const page = await openWorld("demo.h5", 1, "&colouring=first");
  assert.match(await page.innerText(".colours"), /^first, 0\.\d\d s\s+never beyond a limit$/);
  await page.close();
});

test("the picture is a PNG at twice the size", async () => {
  const page = await openWorld("demo.h5", 5);
  await page.waitForTimeout(200);
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("s")]);
  assert.match(download.suggestedFilename(), /BR15_077_ep-road-front-0g8\.png/);
  const png = readFileSync(await download.path());
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  const scene = await page.locator(".scene").boundingBox();
  assert.equal(png.readUInt32BE(16), 2 * Math.round(scene!.width));
  await page.close();
});

test("the video is a WebM of one run through time", async () => {
  const page = await openWorld("demo.h5", 5);
  await page.selectOption(".player select", "4");
  await page.focus(".scroller");
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("v")]);
  const webm = readFileSync(await download.path());
  assert.ok(webm.length > 1000, `${webm.length} bytes`);
  assert.equal(webm.readUInt32BE(0), 0x1a45dfa3);
  await page.close();
});

test("a file with margins, wall forces and replicas shows them", async () => {
  const page = await openWorld("rich.h5", 5, "&colouring=margin");
  const panel = await page.innerText(".panel");
  assert.match(panel, /In place, within 5 mm, up to [\d.]+ g front/);
  assert.match(panel, /Within the limits up to [\d.]+ g front/);
  assert.match(panel, /replica/);
  assert.match(panel, /walls, share of en12642-xl/i);
  // A box that is critical in several directions has one colour, and others have theirs.
  assert.match(
    await page.innerText(".colours"),
    /^box 60: front [\d.]+ g, rear [\d.]+ g\s+box 64: left [\d.]+ g\s+box 74: right [\d.]+ g\s+other boxes$/,
  );
  await page.close();
});

test("a world without series says so, and shows where boxes end", async () => {
  const page = await openWorld("no-series.h5", 5);
  assert.ok((await colours(page)) > 100);
  assert.match(await page.innerText(".boxes"), /cm/);
  await page.close();
});

test("a world that is unstable is that of settling, before 0", async () => {
  const page = await openWorld("demo.h5", 13);
  const panel = await page.innerText(".panel");
  assert.match(panel, /unstable[\s\S]*settled under gravity alone; it was not accelerated/);
  assert.match(panel, /beyond a limit first, at −1\.\d\d s/);
  await page.keyboard.press("Home");
  await reads(page, /^−2\.00 s$/);
  assert.equal(await page.getAttribute(".line canvas", "aria-valuemin"), "-2.000");
  await page.keyboard.press("Shift+ArrowRight");
  await reads(page, /^−1\.\d\d s$/);
  await page.keyboard.press("End");
  await reads(page, /^0\.00 s$/);
  await page.keyboard.press(" ");
  await reads(page, /^−0\.[1-9]/);
  await page.close();
});

test("a world says what has to be known beside its verdict, and what is not modelled", async () => {
  const page = await openWorld("rich.h5", 6);
  const panel = await page.innerText(".panel");
  assert.match(panel, /A friction coefficient is within 2 % of what the acceleration asks for/);
  assert.match(panel, /Straps, air bags and stretch film are not modelled\./);
  assert.doesNotMatch(panel, /at least|earlier version/);
  await page.close();
});

test("a world that ended early is at least its verdict", async () => {
  const page = await openWorld("early.h5", 5);
  const panel = await page.innerText(".panel");
  assert.match(panel, /at least moved[\s\S]*at least 1 moved[\s\S]*It ended when that was decided/);
  await page.close();
});

test("a world of an earlier version is judged at the end, alone and beside another one", async () => {
  const page = await openWorld("earlier.h5", 5);
  const panel = await page.innerText(".panel");
  assert.match(panel, /at least fell[\s\S]*lower by more than the limit at the end/);
  assert.match(panel, /This file is of an earlier version/);
  assert.match(panel, /Box \d+ went farthest beyond a limit: [\d.]+ cm of displacement, where the limit is 10\.0 cm/);
  assert.doesNotMatch(await page.innerText(".options select"), /first/);
  await page.keyboard.press("x");
  await page.waitForSelector(".scene + .scene");
  await page.setInputFiles("input[aria-label='Second results file']", `${RESULTS}/demo.h5`);
  await page.waitForFunction(() =>
    /judged at\s+the end\s+any time/.test(document.querySelector<HTMLElement>(".compare")?.innerText ?? ""),
  );
  await page.close();
});

test("a trailer says how boxes left it, and which are fixed", async () => {
  const page = await openWorld("trailer.h5", 1);
  const panel = await page.innerText(".panel");
  assert.match(
    panel,
    /Of 4 boxes 2 fell, 2 moved, 2 tilted\.\s+Left the container: 1 through the open rear, 1 over the low left side\./,
  );
  assert.match(panel, /It slides towards the rear\.[\s\S]*It has 27\.0 cm of free space there, up to the open rear\./);
  assert.match(panel, /It left through the open rear by 0\.70 s, and fell to the ground\./);
  assert.match(panel, /4\s+fixed/);
  const bars = (await page.innerText(".walls")).split("\n").filter((word) => /^[a-z ]+$/.test(word));
  assert.deepEqual(bars, ["floor", "front", "left", "right", "ground", "fixed boxes"]);
  assert.match(await page.innerText(".colours"), /stayed\s+fell\s+fixed/);
  assert.match(await page.innerText(".labels"), /front\s*rear/);
  await page.evaluate(() => {
    location.hash = "world=1&box=4";
  });
  await page.waitForFunction(() =>
    /BOX 4\s+fixed/i.test(document.querySelector<HTMLElement>(".panel .box")?.innerText ?? ""),
  );
  assert.match(await page.innerText(".panel .box"), /part of the container: it never moves, and has no verdict/);
  assert.doesNotMatch(await page.innerText(".panel .box"), /displacement|mass/);
  await page.keyboard.press("m");
  await page.waitForSelector("main.fleet");
  assert.match(
    await page.innerText("main.fleet"),
    /rear, roof open; left 60 cm high; right 60 cm high; floor 120 cm above the ground/,
  );
  await page.close();
});

test("a load shows its own container, and the names, mats and friction of its boxes", async () => {
  const page = await openWorld("loads.h5", 3, "&time=1&box=7");
  const panel = await page.innerText(".panel");
  assert.match(
    panel,
    /In a container of its own: trailer-curtain, 13\.60 × 2\.48 × 2\.70 m; left, right open; floor 120 cm/,
  );
  assert.match(panel, /Box 1, Drinks 1 and \d+ more were beyond a limit first/);
  assert.match(panel, /The push of 0\.50 g is more than friction holds \(0\.30 g\)\./);
  assert.match(panel, /It left through the open left side/);
  assert.match(
    await page.innerText(".panel .box"),
    /box 7, tiles 1[\s\S]*material\s+pallet\s+mat beneath it\s+friction 0\.6/i,
  );
  assert.match(await page.innerText(".row.head"), /box\s+name\s+first\s+moved/);
  await page.click(".row.head button:has-text('name')");
  await page.waitForFunction(() => /Castings 1/.test(document.querySelector(".rows .row")?.textContent ?? ""));
  assert.equal(await page.getAttribute(".rows .name", "title"), "Castings 1");
  await page.evaluate(() => {
    location.hash = "world=13";
  });
  await page.waitForFunction(() => /seed_example/.test(document.querySelector("header")?.textContent ?? ""));
  assert.doesNotMatch(await page.innerText(".panel"), /container of its own/);
  assert.match(await page.innerText(".row.head"), /box\s+first/, "a load without names has no column for them");
  await page.close();
});

test("boxes on the ground are in the picture, from every side", async () => {
  const page = await openWorld("trailer.h5", 1, "&time=3");
  for (const key of ["1", "2", "3", "4", "5", "6"]) {
    await page.keyboard.press(key);
    await colours(page);
    const border = await page.evaluate(() => {
      const source = document.querySelector(".scene canvas") as HTMLCanvasElement;
      const copy = document.createElement("canvas");
      copy.width = source.width;
      copy.height = source.height;
      const context = copy.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(source, 0, 0);
      const { data, width, height } = context.getImageData(0, 0, copy.width, copy.height);
      // Boxes that fell are red.
      const red: boolean[] = Array.from({ length: width * height }, (_, i) => data[4 * i] - data[4 * i + 2] > 60);
      const at = (x: number, y: number) => red[y * width + x];
      let touching = 0;
      for (let x = 0; x < width; ++x) touching += Number(at(x, 0)) + Number(at(x, height - 1));
      for (let y = 0; y < height; ++y) touching += Number(at(0, y)) + Number(at(width - 1, y));
      return { touching, inside: red.filter((is) => is).length };
    });
    assert.equal(border.touching, 0, `a box is cut off in view ${key}`);
    assert.ok(border.inside > 1000, `${border.inside} pixels of boxes in view ${key}`);
  }
  await page.close();
});

test("boxes count from 1, in the address too", async () => {
  const page = await openWorld("demo.h5", 5, "&box=60");
  assert.match(await page.innerText(".panel .box"), /^box 60/i);
  await page.focus(".scroller");
  await page.keyboard.press("ArrowDown");
  const box = (await page.innerText(".panel .box h2")).replace(/\D/g, "");
  assert.notEqual(box, "60");
  await page.waitForFunction((id) => location.hash.includes(`box=${id}`), box);
  await page.close();
});

test("two worlds are compared with one clock; another file joins by name", async () => {
  const page = await openWorld("demo.h5", 5);
  await page.keyboard.press("x");
  await page.waitForSelector(".scene + .scene");
  assert.match(await page.innerText("header"), /road-front-0g8\s+BR15_077_ep\.txt · road-rear-0g5/);
  await page.keyboard.press("ArrowRight");
  await reads(page, /^0\.10 s$/);
  await page.setInputFiles("input[aria-label='Second results file']", `${RESULTS}/rich.h5`);
  await page.waitForFunction(() => /otherFile=rich\.h5/.test(location.hash));
  await page.waitForFunction(() => document.querySelectorAll(".crumb")[1]?.textContent?.includes("road-front-0g8"));
  assert.match(await page.innerText(".compare"), /verdict\s+moved\s+fell/);
  await page.keyboard.press("x");
  await page.waitForFunction(() => document.querySelectorAll(".scene").length === 1);
  await page.close();
});
