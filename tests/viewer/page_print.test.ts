import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";
import { ENGINE, PROGRAM, RESULTS } from "./places";
import { papersOf } from "./printed_paper";

after(closeBrowser);

/** What a page asks the printer for: the text of each sheet, labels in drawings, and the number of sheets of paper. */
async function printed(
  page: Page,
  ask: () => Promise<void>,
): Promise<{ sheets: string[]; labels: string[]; papers: number }> {
  await page.evaluate(() => {
    Object.assign(window, { asked: 0, print: () => Object.assign(window, { asked: 1 }) });
  });
  await ask();
  await page.waitForFunction(() => (window as unknown as { asked: number }).asked > 0);
  const sheets = await page.$$eval(".report section", (all) => all.map((section) => section.textContent ?? ""));
  const labels = await page.$$eval(".report svg text", (all) => all.map((label) => label.textContent ?? ""));
  const papers = papersOf(await page.pdf({ preferCSSPageSize: true }));
  return { sheets, labels, papers };
}

async function open(page: Page, hash: string): Promise<void> {
  await page.evaluate((to) => {
    location.hash = to;
  }, hash);
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
}

test("a load that fails has one page: what it is, what it stands, what goes first", async () => {
  const page = await openPage({ file: "rich.h5", dark: true });
  await open(page, "world=5");
  const first = /Box (\d+)/.exec(await page.innerText(".panel .link"))?.[1];
  const { sheets, papers } = await printed(page, () => page.keyboard.press("Control+p"));
  assert.equal(sheets.length, 1);
  assert.equal(papers, 1);
  const [text] = sheets;
  assert.match(text, /^BR15_077_ep\.txt81 boxes of \d+ kg, 67 % of the container's volume; fails under 4 of 4/);
  assert.match(text, /container5\.87 × 2\.33 × 2\.20 m/);
  assert.match(
    text,
    /It may lie from 2\.64 m to 3\.23 m from the front wall \(CTU Code 2014, Annex 7, 3\.1\.4\): it does\./,
  );
  assert.match(text, /road: EN 12195-1, road; Directive 2014\/47\/EU, Annex III/);
  assert.match(text, /friction.*box on box 0\.5/);
  assert.match(
    text,
    new RegExp(`road-front-0g8front 0.8 gfellbox ${first}, 0.\\d\\d s`),
    "the box that the page names",
  );
  assert.match(text, /pushed toin placewithin limitsneededgoes first above/);
  assert.match(text, /Force on the walls, limits of en12642-xl/);
  assert.match(text, /holdfast \d+\.\d+\.\d+\S*, native standard/);
  assert.match(text, /BR15_077_ep\.txt, hashes of the ends: road-front-0g8 [0-9a-f]{16}, /);
  // The paper is white, whatever the page is.
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
  assert.equal(await page.isVisible("#app"), false);
  await page.close();
});

test("all loads that the matrix shows are printed, also those that hold, and names stand in the drawings", async () => {
  const page = await openPage({ file: "loads.h5" });
  const { sheets, labels, papers } = await printed(page, () => page.click("header button:text-is('Print')"));
  assert.equal(sheets.length, 5, "a page before those of the four loads");
  assert.equal(papers, 6, "one page per load, and a second of the one whose boxes leave");
  assert.match(sheets[0], /^loads\.h5\d of 4 loads do not hold\./);
  const trailer = sheets.find((text) => text.startsWith("trailer.csv")) ?? "";
  assert.match(trailer, /trailer-curtain, 13\.60 × 2\.48 × 2\.70 m; left, right open/);
  assert.match(trailer, /Axle loads are not calculated\./);
  assert.match(trailer, /What is loaded.*Paper280 × 120 × 160840 to 855 kg1695 kg3, 4/);
  assert.ok(labels.includes("Pump"), labels.join());
  await page.close();
});

/** Of the sheet of each load: its headings, paragraphs and the cells of its tables, and the labels and sizes of its drawings. */
const sheetsOf = (page: Page) =>
  page.evaluate(() =>
    [...document.querySelectorAll(".report section")].flatMap((section) => {
      const load = section.querySelector("h2")?.textContent;
      if (!load) return [];
      const text = (node: Element) => node.textContent ?? "";
      const parts = [...section.querySelectorAll("h3, p, tr, figcaption")];
      const rows = parts.map((row) => (row.matches("tr") ? [...row.children].map(text) : [text(row)]));
      const drawings = [...section.querySelectorAll("svg")].map((svg) => [
        svg.getAttribute("viewBox"),
        svg.querySelectorAll("polygon, path").length,
        ...[...svg.querySelectorAll("text")].map(text),
      ]);
      return [{ load, rows, drawings }];
    }),
  );

/** What rests on boxes is found by the engine. */
const skipped = (file: string) =>
  ["loads.h5", "bearing.h5"].includes(file) && !existsSync(ENGINE) && "make viewer-engine has not built the engine";

for (const file of ["rich.h5", "loads.h5", "trailer.h5", "demo.h5", "hostile.h5", "bearing.h5"])
  test(`the page is that of the program's report, cell by cell, of ${file}`, { skip: skipped(file) }, async () => {
    const folder = mkdtempSync(path.join(tmpdir(), "holdfast-report-"));
    const report = path.join(folder, "report.html");
    try {
      execFileSync(PROGRAM, ["report", `${RESULTS}/${file}`, "-o", report]);
      const [a, b] = [await openPage({ address: `file://${report}` }), await openPage({ file })];
      await b.evaluate(() => {
        window.print = () => {};
      });
      await b.keyboard.press("Control+p");
      await b.waitForSelector(".report section h2", { state: "attached" });
      const [told, here] = [await sheetsOf(a), await sheetsOf(b)];
      assert.ok(told.length > 0 && told[0].rows.length > 25, `${told.length} sheets`);
      for (const sheet of told) {
        const same = here.find(({ load }) => load === sheet.load);
        // The program also says what the replicas mean, has fewer digits of sizes, and another dash.
        const alike = (rows: string[][]) =>
          rows.map((row) =>
            row.map((cell) =>
              cell
                .replace(/(holds|fails|uncertain): (?=\d+ of)/, "")
                .replace(/\d[\d.]* × [\d.]+ × [\d.]+ m/, (size) =>
                  size.replaceAll(/\d[\d.]*/g, (one) => Number(one).toFixed(2)),
                )
                .replace(/^-$/, "–"),
            ),
          );
        assert.deepEqual(alike(same?.rows ?? []), alike(sheet.rows), sheet.load);
        assert.deepEqual(same?.drawings, sheet.drawings, sheet.load);
      }
      await a.close();
      await b.close();
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

test("a load that holds has its page", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.fill("input[type=search]", "BR8_009");
  const { sheets, papers } = await printed(page, () => page.keyboard.press("Control+p"));
  assert.equal(sheets.length, 1, "what is filtered out is not printed");
  assert.equal(papers, 1);
  assert.match(sheets[0], /^BR8_009_ep\.txt.*; (holds under all 4|fails under \d of 4) accelerations\./);
  await page.close();
});

test("the browser's menu prints the overview", async () => {
  const page = await openPage({ file: "demo.h5" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.match((await page.textContent(".report")) ?? "", /demo\.h5.*of 4 loads do not hold.*seed_example\.txt/s);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await page.textContent(".report"), "");
  await page.close();
});
