import assert from "node:assert/strict";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";

after(closeBrowser);

async function openWorld(page: Page, more = ""): Promise<void> {
  await page.evaluate((hash) => {
    location.hash = hash;
  }, `world=5${more}`);
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
}

/** What can be used has a name, and a place of its own: names of what has none, and of what lies over another one or beside the page. */
const faults = (page: Page) =>
  page.evaluate(() => {
    const found: string[] = [];
    const all = [...document.querySelectorAll<HTMLElement>("#app :is(button, input, select, [tabindex])")];
    const shown = all.filter((node) => node.checkVisibility() && !node.closest("dialog, .scroller, .matrix"));
    const nameOf = (node: HTMLElement) =>
      node.getAttribute("aria-label") ?? node.closest("label")?.textContent ?? node.textContent ?? "";
    const boxes = shown.map((node) => node.getBoundingClientRect());
    for (const [i, node] of shown.entries()) {
      const name = nameOf(node).trim();
      const box = boxes[i];
      if (name === "") found.push(`no name: ${node.outerHTML.slice(0, 80)}`);
      const within = node.closest("aside, .drive");
      if (!within && (box.right > innerWidth + 1 || box.left < -1)) found.push(`outside: ${name}`);
      for (const [j, other] of boxes.entries()) {
        if (j <= i || shown[j].contains(node) || node.contains(shown[j])) continue;
        const across = Math.min(box.right, other.right) - Math.max(box.left, other.left);
        const down = Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top);
        if (across > 1 && down > 1) found.push(`${name} over ${nameOf(shown[j]).trim()}`);
      }
    }
    if (document.documentElement.scrollWidth > innerWidth) found.push("the page is wider than the window");
    return found;
  });

for (const width of [1440, 1100, 800])
  test(`all that can be used has a name and a place of its own, ${width} pixels wide`, async () => {
    const page = await openPage({ file: "rich.h5", width, height: 800 });
    assert.deepEqual(await faults(page), [], "the matrix");
    await openWorld(page);
    assert.deepEqual(await faults(page), [], "a world");
    const scene = await page.locator(".scene").boundingBox();
    assert.ok((scene?.width ?? 0) > 0.4 * width && (scene?.height ?? 0) > 200, "the load has room");
    await page.close();
  });

test("tab goes through all that can be used, and shows where it is", async () => {
  const page = await openPage({ file: "rich.h5" });
  const seen = new Set<string>();
  for (let press = 0; press < 14; ++press) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const node = document.activeElement as HTMLElement;
      if (node === document.body) return ["", ""];
      return [node.getAttribute("aria-label") ?? node.textContent ?? "", getComputedStyle(node).outlineStyle];
    });
    if (/^Layouts by/.test(at[0])) assert.match(await page.innerText(".detail"), /road-front-0g8/, "a cell is chosen");
    else if (at[0] !== "") assert.notEqual(at[1], "none", `${at[0]} shows the focus`);
    seen.add(at[0]);
  }
  for (const name of ["Print", "Open…", "Filter layouts by words of their names", "Sort", "Colour", "CSV"])
    assert.ok(seen.has(name), `${name} is reached: ${[...seen].join(" | ")}`);
  await page.close();
});

test("nothing moves by itself, whoever would rather have less motion", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.emulateMedia({ reducedMotion: "reduce" });
  await openWorld(page);
  const time = await page.innerText(".readout");
  await page.waitForTimeout(300);
  assert.equal(await page.innerText(".readout"), time);
  assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
  await page.close();
});
