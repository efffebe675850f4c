// How long the page takes to answer for a load anew after an edit, under the norm of the road, in headless Chromium:
//   node bench/viewer_mend.mjs LAYOUT ...
//
// Of each load the first box is taken away, and put back. Prints the seconds until the world that is looked at, and until
// all worlds and margins are those of the edited load. Needs `make viewer-engine viewer`.
import path from "node:path";
import { launched, namedLayouts, openedPage, screened } from "./viewer_page.mjs";

const browser = await launched();
for (const layout of namedLayouts("viewer_mend.mjs")) {
  const page = await openedPage(browser, [layout]);
  await page.click(".go button.primary");
  await screened(page);
  await page.focus(".matrix");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.evaluate(() => {
    location.hash += "&box=1";
  });
  await page.click("button:text-is('Mend')");
  const answered = () =>
    page.waitForFunction(
      () => !/…/.test(document.querySelector("#app:not([aria-busy]) .mend:not([aria-busy]) table")?.innerText ?? "…"),
      undefined,
      { timeout: 0, polling: 5 },
    );
  await answered();
  const said = () => page.innerText(".panel .top");
  const seconds = async (button) => {
    const before = await said();
    const begin = await page.evaluate((button) => {
      const begin = performance.now();
      [...document.querySelectorAll(".mend button")].find(({ textContent }) => textContent === button).click();
      return begin;
    }, button);
    await page.waitForFunction((before) => document.querySelector(".panel .top")?.innerText !== before, before, { polling: 5 });
    const first = await page.evaluate(() => performance.now());
    await answered();
    return [first - begin, (await page.evaluate(() => performance.now())) - begin].map((ms) => (ms / 1000).toFixed(2));
  };
  const edits = [await seconds("Take away"), await seconds("Undo")].map(([world, all]) => `world ${world} s, all ${all} s`);
  console.log(`${path.basename(layout)}: taken away: ${edits[0]}; put back: ${edits[1]}`);
  await page.close();
}
await browser.close();
