import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";
import { PICTURES } from "./places";

after(closeBrowser);

/** What part of the cells of a coarse grid two pictures may differ in: text and edges fall differently on other machines. */
const MOST_OTHER_CELLS = 0.02;

/** The share of the cells of a grid of 96 x 60 whose mean colours differ visibly. */
function otherCells(page: Page, pictures: [Buffer, Buffer]): Promise<number> {
  return page.evaluate(
    async (sources) => {
      const [a, b] = await Promise.all(
        sources.map(async (source) => {
          const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${source}`)).blob());
          const canvas = new OffscreenCanvas(96, 60);
          const context = canvas.getContext("2d", { willReadFrequently: true });
          if (!context) throw new Error("no canvas");
          context.imageSmoothingQuality = "high";
          context.drawImage(image, 0, 0, 96, 60);
          return context.getImageData(0, 0, 96, 60).data;
        }),
      );
      let other = 0;
      for (let cell = 0; cell < a.length; cell += 4)
        if ([0, 1, 2].some((channel) => Math.abs(a[cell + channel] - b[cell + channel]) > 32)) ++other;
      return (4 * other) / a.length;
    },
    pictures.map((picture) => picture.toString("base64")),
  );
}

async function settle(page: Page): Promise<void> {
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 300)))),
  );
}

async function show(page: Page, address: string): Promise<void> {
  await page.evaluate((hash) => {
    location.hash = hash;
  }, address);
  await settle(page);
}

async function check(page: Page, name: string): Promise<void> {
  await settle(page);
  const share = await otherCells(page, [await page.screenshot(), readFileSync(path.join(PICTURES, `${name}.png`))]);
  assert.ok(share < MOST_OTHER_CELLS, `${name}: ${(100 * share).toFixed(1)} % of the picture differ`);
}

// World 5 of demo.h5 is BR15_077_ep under 0.8 g to the front, as in the pictures of the documentation.
for (const dark of [false, true])
  test(`a world looks like its picture, ${dark ? "dark" : "light"}`, async () => {
    const page = await openPage({ file: "demo.h5", dark });
    await show(page, "world=5&time=1.2&ghost=1&box=60");
    await page.keyboard.press("1");
    await check(page, `world-${dark ? "dark" : "light"}`);
    await page.close();
  });

test("boxes taken apart, and coloured by displacement, look like their picture", async () => {
  const page = await openPage({ file: "demo.h5" });
  await show(page, "world=5&time=1.6&colouring=displacement&exploded=0.35");
  await check(page, "apart-light");
  await page.close();
});

test("a load that tips over the sill of an open container looks like its picture", async () => {
  const page = await openPage({ file: "open.h5" });
  await show(page, "world=2&time=2.2");
  await page.keyboard.press("1");
  await check(page, "open-light");
  await page.close();
});

test("a picture of another time is told apart", async () => {
  const page = await openPage({ file: "demo.h5" });
  await show(page, "world=5&time=0&colouring=displacement&exploded=0.35");
  await assert.rejects(check(page, "apart-light"), /differ/);
  await page.close();
});
