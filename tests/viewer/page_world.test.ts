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

test("from the fleet to the box that went first, with the keyboard alone", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.keyboard.press("n");
  await shown(page);
  assert.ok((await colours(page)) > 100, "the load is drawn");
  assert.match(await page.innerText(".panel"), /went first/i);
  await page.focus(".panel .link");
  await page.keyboard.press("Enter");
  assert.match(await page.innerText(".panel .box"), /displacement at the end/);
  await page.keyboard.press("f");
  await page.keyboard.press("m");
  await page.waitForSelector("main.fleet");
  await page.close();
});

test("arrows go by sample, with shift by first move; the address follows", async () => {
  const page = await openWorld("demo.h5", 4);
  await page.keyboard.press("ArrowRight");
  await reads(page, /^0\.10 s$/);
  await page.keyboard.press("Shift+ArrowRight");
  await reads(page, /^0\.[5-9]0 s$/);
  await page.waitForFunction(() => /world=4&time=0\.[5-9]/.test(location.hash));
  await page.keyboard.press("End");
  await reads(page, /^3\.00 s$/);
  await page.goBack();
  await page.waitForSelector("main.fleet");
  await page.close();
});

test("space plays and pauses", async () => {
  const page = await openWorld("demo.h5", 4);
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
  const page = await openWorld("demo.h5", 4);
  await page.waitForTimeout(200);
  const scene = await page.locator(".scene canvas").boundingBox();
  await page.mouse.click(scene!.x + scene!.width / 2, scene!.y + scene!.height / 2);
  assert.match(await page.innerText(".panel .box"), /BOX \d+|Box \d+/);
  await page.keyboard.press("Escape");
  assert.match(await page.innerText(".panel .box"), /Point at a box/);
  await page.close();
});

test("displaced boxes are blue, others are not", async () => {
  const page = await openWorld("demo.h5", 4, "&time=2&colouring=displacement");
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
    const page = await openWorld("demo.h5", 4, `&time=1&colouring=${colouring}`);
    assert.equal(await page.inputValue(".options select"), colouring);
    assert.ok((await colours(page)) > 100);
    assert.ok((await page.innerText(".colours")).length > 0);
    await page.close();
  });

test("the picture is a PNG at twice the size", async () => {
  const page = await openWorld("demo.h5", 4);
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
  const page = await openWorld("demo.h5", 4);
  await page.selectOption(".player select", "4");
  await page.focus(".scroller");
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("v")]);
  const webm = readFileSync(await download.path());
  assert.ok(webm.length > 1000, `${webm.length} bytes`);
  assert.equal(webm.readUInt32BE(0), 0x1a45dfa3);
  await page.close();
});

test("a file with margins, wall forces and replicas shows them", async () => {
  const page = await openWorld("rich.h5", 4, "&colouring=margin");
  const panel = await page.innerText(".panel");
  assert.match(panel, /Stands .* g front/);
  assert.match(panel, /replica/);
  assert.match(panel, /walls, share of en12642-xl/i);
  assert.match(await page.innerText(".colours"), /front .* g/);
  await page.close();
});

test("a world without series says so, and shows where boxes end", async () => {
  const page = await openWorld("no-series.h5", 4);
  assert.ok((await colours(page)) > 100);
  assert.match(await page.innerText(".boxes"), /cm/);
  await page.close();
});

test("two worlds are compared with one clock; another file joins by name", async () => {
  const page = await openWorld("demo.h5", 4);
  await page.keyboard.press("x");
  await page.waitForSelector(".scene + .scene");
  assert.match(await page.innerText("header"), /road-front-0g8\s+BR15_077_ep\.txt · road-rear-0g5/);
  await page.keyboard.press("ArrowRight");
  await reads(page, /^0\.10 s$/);
  await page.setInputFiles("input[aria-label='Second results file']", `${RESULTS}/rich.h5`);
  await page.waitForFunction(() => /otherFile=rich\.h5/.test(location.hash));
  await page.waitForFunction(() => document.querySelectorAll(".crumb")[1]?.textContent?.includes("road-front-0g8"));
  assert.match(await page.innerText(".compare"), /verdict\s+fell\s+fell/);
  await page.keyboard.press("x");
  await page.waitForFunction(() => document.querySelectorAll(".scene").length === 1);
  await page.close();
});
