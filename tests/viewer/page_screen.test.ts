import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import type { Page } from "playwright-core";
import { closeBrowser, openPage } from "./browser";
import { ENGINE, LOADS, PAGE, PLANNER, PROGRAM } from "./places";
import { type Cell, csvOf, palletRows, partsOf, xlsxOf, zipped } from "./spreadsheets";

const skip = existsSync(ENGINE) ? false : "make viewer-engine has not built the engine";
const folder = mkdtempSync(path.join(tmpdir(), "holdfast-screen-"));

after(async () => {
  rmSync(folder, { recursive: true });
  await closeBrowser();
});

type Content = string | Uint8Array;

/** Writes files, and gives them to the page. */
async function drop(page: Page, files: Readonly<Record<string, Content>>): Promise<void> {
  const paths = Object.entries(files).map(([name, content]) => {
    const file = path.join(folder, name);
    writeFileSync(file, content);
    return file;
  });
  await page.setInputFiles('input[aria-label="Files"]', paths);
  await page.waitForSelector("#app:not([aria-busy]) > main:is(.setup:not([aria-busy]), .landing)");
}

const screened = async (page: Page) => {
  await page.click(".go button.primary");
  await page.waitForFunction(() => / in \d/.test(document.querySelector(".progress")?.textContent ?? ""));
};

/** What `holdfast screen` says of a file under a norm. */
function byProgram(file: string, options: readonly string[] = [], norm = "road") {
  const output = path.join(folder, "results.h5");
  const words = ["screen", "--layouts", path.join(folder, file), "--norm", norm, "--margins", ...options];
  const lines = execFileSync(PROGRAM, [...words, "--json", "--quiet", "--overwrite", "-o", output], {
    encoding: "utf8",
  });
  const all = lines
    .trim()
    .split("\n")
    .map((line) => JSON.parse(line));
  return { worlds: all.filter((one) => "verdict" in one), layout: all.find((one) => "margins_g" in one) };
}

test("a spreadsheet of pallets is dropped, screened, and a world is opened: verdicts, margins and bits of the program", {
  skip,
}, async () => {
  const page = await openPage();
  await drop(page, { "pallets.xlsx": xlsxOf({ Pallets: palletRows() }) });
  assert.match(await page.innerText(".file"), /pallets\.xlsx\s+spreadsheet, 1 load, 20 boxes/);
  // It does not fit what the program takes without a word of a container, and says what would help.
  assert.match(await page.innerText(".file"), /20 boxes are outside|boxes are outside/);
  const container = /container (\S+),/.exec(await page.innerText(".file button.advice"))![1];
  await page.click(".file button.advice");
  await page.waitForSelector(".go button.primary:not([disabled])");
  assert.match(await page.innerText(".file"), new RegExp(`As you said: the container ${container}\\.`));
  await screened(page);

  writeFileSync(path.join(folder, "pallets.csv"), csvOf(palletRows()));
  const { worlds, layout } = byProgram("pallets.csv", ["--container", container]);
  assert.ok(new Set(worlds.map((world) => world.verdict)).size > 1, "some fall or move, and some stay");
  for (const [index, world] of worlds.entries()) {
    await page.evaluate((number) => {
      location.hash = `world=${number}`;
    }, index + 1);
    await page.waitForFunction(
      (name) => document.querySelector("#app:not([aria-busy]) > main.world") && document.title.includes(name),
      world.acceleration,
    );
    const panel = await page.innerText(".panel .top");
    assert.match(panel, new RegExp(`^[^\\w]*${world.verdict}`), world.acceleration);
    assert.match(panel, new RegExp(world.state_hash), world.acceleration);
    if (world.moved_boxes > 0) assert.match(panel, new RegExp(`${world.moved_boxes} moved`));
    for (const direction of ["front", "rear", "left", "right"]) {
      const hundredths = Math.floor(100 * layout.margins_within_limits_g[direction] + 1e-6) / 100;
      assert.match(panel, new RegExp(`${hundredths.toFixed(2)}\\+? g ${direction}`), direction);
    }
  }
  // The motion is there: the last sample is later than the first.
  assert.match(await page.innerText(".readout"), /s$/);
  await page.keyboard.press("End");
  await page.waitForFunction(() => Number.parseFloat(document.querySelector(".readout")!.textContent!) > 1);
  // Live takes it over.
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.live");
  await page.close();
});

test("a screened load with its own centres of mass, fixed boxes and mats is replayed live with the same bits", {
  skip,
}, async () => {
  const page = await openPage();
  await drop(page, { "loads.json": readFileSync(LOADS, "utf8") });
  await screened(page);
  await page.evaluate(() => {
    location.hash = "world=2";
  });
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  await page.keyboard.press("l");
  await page.waitForSelector("#app:not([aria-busy]) > main.live");
  await page.keyboard.press("b");
  await page.waitForSelector(".bits.same");
  assert.match(await page.innerText(".bits"), /The same bits as when it was screened/);
  await page.close();
});

test("a norm that needs a size asks for it, keeps it in the address, and has the program's worlds", {
  skip,
}, async () => {
  const page = await openPage();
  await drop(page, { "pallets.csv": csvOf(palletRows()) });
  await page.selectOption(".choices select >> nth=1", "trailer-box");
  const size = page.locator(".choices label:has-text('Size K') input");
  assert.ok(!(await size.isVisible()), "the norm of the road has its sizes");
  await page.selectOption(".choices select >> nth=0", { label: (await eumosLabel(page))! });
  const refused = () =>
    page.waitForFunction(
      () =>
        document.querySelector(".go .problem")?.textContent ===
          "eumos-40509 needs a size K: a number of g from 0.01 to 2." &&
        document.querySelector(".go button.primary[disabled]"),
    );
  await refused();
  for (const wrong of ["2.01", "0.0099", "much"]) {
    await size.fill(wrong);
    await page.waitForSelector("main.setup[aria-busy]");
    await refused();
  }
  // A comma may be the decimal mark.
  await size.fill("1,5");
  await page.waitForSelector("main.setup:not([aria-busy]) .go button.primary:not([disabled])");
  assert.match(
    await page.innerText(".choices"),
    /Source: EUMOS 40509, K g for at least 0\.3 s[\s\S]*Needed: front 1\.5 g/,
  );
  await page.waitForFunction(() => /normSize%3A1%2C5/.test(location.hash));
  await screened(page);

  const { worlds, layout } = byProgram("pallets.csv", ["--container", "trailer-box"], "eumos-40509:1.5");
  assert.equal(worlds.length, 4);
  assert.ok(new Set(worlds.map((world) => world.verdict)).size > 1, "some move, and some stay");
  for (const [index, world] of worlds.entries()) {
    await page.evaluate((number) => {
      location.hash = `world=${number}`;
    }, index + 1);
    await page.waitForFunction(
      (name) => document.querySelector("#app:not([aria-busy]) > main.world") && document.title.includes(name),
      world.acceleration,
    );
    const panel = await page.innerText(".panel .top");
    assert.match(panel, new RegExp(`^[^\\w]*${world.verdict}`), world.acceleration);
    assert.match(panel, new RegExp(world.state_hash), world.acceleration);
  }
  assert.equal(worlds[0].acceleration, "eumos-40509-front-1g5");
  assert.ok(layout.margins_within_limits_g.front > 0);
  await page.close();

  // Who opens the address has the norm and its size.
  const other = await openPage({ address: `file://${PAGE}#run=norm%3Aeumos-40509%3A%3BnormSize%3A1%2C5` });
  await drop(other, { "pallets.csv": csvOf(palletRows()) });
  assert.equal(await other.inputValue(".choices label:has-text('Size K') input"), "1,5");
  assert.match(await other.innerText(".choices"), /Needed: front 1\.5 g/);
  await other.close();
});

const eumosLabel = (page: Page) => page.locator(".choices option:has-text('eumos-40509')").textContent();

test("several files at once: loads of all of them, a sheet without loads left out, what is wrong said by row", {
  skip,
}, async () => {
  const page = await openPage();
  const rows = palletRows().map((row, i): Cell[] => [i === 0 ? "Load" : i <= 10 ? "Tour 1" : "Tour 2", ...row]);
  const wrong = palletRows();
  wrong[3][4] = "wide";
  await drop(page, {
    "tours.xlsx": xlsxOf({ Notes: [["Loaded by"], ["somebody"]], Tours: rows }),
    "wrong.xlsx": xlsxOf({ Sheet1: wrong }),
    "planner.csv": readFileSync(PLANNER, "utf8"),
    "own.json": JSON.stringify({
      holdfast: 1,
      loads: [{ name: "One", container: "20", boxes: [{ corner_min: [0, 0, 0], corner_max: [1, 1, 1], mass: 90 }] }],
    }),
  });
  // What helps one file leaves the others as they are.
  await page.click(".file:has-text('planner.csv') button.advice:has-text('Take the axes -z x y') >> nth=0");
  await page.click(".file:has-text('tours.xlsx') button.advice:has-text('Take the container') >> nth=0");
  await page.waitForSelector("main.setup:not([aria-busy])");
  const files = await page.locator(".file").allInnerTexts();
  assert.equal(files.length, 4);
  assert.match(files[0], /tours\.xlsx Tours[\s\S]*Tour 1[\s\S]*10[\s\S]*Tour 2/);
  assert.match(files[1], /Row 4: [^\n]*not a number[^\n]*Length cm[^\n]*wide/);
  assert.match(files[2], /As you said: the axes -z x y\.[\s\S]*planner\.csv#Unit 1\s+3[\s\S]*planner\.csv#Unit 2\s+1/);
  assert.match(files[3], /own\.json#One\s+1\s+90\s+20/);
  assert.equal(await page.innerText(".go button.primary"), "Screen 5 loads");
  await screened(page);
  assert.match(await page.innerText(".progress"), /^20 worlds, margins of 5 loads in/);
  assert.match(await page.innerText("aside"), /failed\s*4/, "the load that cannot be read is not forgotten");
  await page.close();
});

test("a screening is cancelled, and another begins with other settings", { skip }, async () => {
  const page = await openPage();
  const many = Array.from({ length: 40 }, (_, load) =>
    palletRows()
      .slice(1)
      .map((row): Cell[] => [`Tour ${load + 1}`, ...row]),
  ).flat();
  await drop(page, { "many.csv": csvOf([["Load", ...palletRows()[0]], ...many]) });
  await page.selectOption(".choices select >> nth=1", "trailer-box");
  await page.waitForSelector("main.setup:not([aria-busy])");
  await page.click(".go button.primary");
  await page.waitForSelector(".progress progress");
  await page.click(".progress button:text-is('Cancel')");
  await page.waitForFunction(() => /ended after/.test(document.querySelector(".progress")?.textContent ?? ""));
  assert.match(await page.innerText(".progress"), /\d+ of (160 worlds|40 loads)/, "some are left out");
  await page.click(".progress button:text-is('Settings')");
  await page.click(".file button[aria-label='Leave out many.csv']");
  await page.waitForSelector(".go button.primary:text-is('No load can be screened')");
  await drop(page, { "pallets.csv": csvOf(palletRows()) });
  await page.fill(".choices label:has-text('Displacement') input", "500");
  await page.waitForSelector("main.setup:not([aria-busy]) .go button.primary:not([disabled])");
  await screened(page);
  assert.match(await page.innerText("aside"), /move 5\.00 m/);
  await page.close();
});

test("columns that are not understood are explained once, and remembered", { skip }, async () => {
  const page = await openPage();
  const head = ["Artikel", "PosX cm", "PosY cm", "PosZ cm", "Tiefe cm", "Breite cm", "Hoehe cm", "kg brutto"];
  const rows = [
    ["Tour of Monday"],
    head,
    ...palletRows()
      .slice(1, 7)
      .map((row) => row.slice(0, 8)),
  ];
  await drop(page, { "first.xlsx": xlsxOf({ Tour: rows }) });
  assert.match(await page.innerText(".file"), /Row 2: the header does not tell the length/);
  assert.match(await page.innerText(".puzzle"), /Artikel\s+PosX cm[\s\S]*Drinks 1\s+0\s+0\s+0\s+80\s+120\s+100\s+400/);
  const choices = {
    "Tiefe cm": "length",
    "Breite cm": "width",
    "Hoehe cm": "height",
    "kg brutto": "mass",
    Artikel: "name",
  };
  for (const [header, word] of Object.entries(choices)) {
    await page.selectOption(`.puzzle select[aria-label="What ${header} means"]`, word);
    await page.waitForSelector("main.setup:not([aria-busy])");
  }
  await page.click(".puzzle button:text-is('Done')");
  assert.match(
    await page.innerText(".file"),
    /Columns as you said: .*Tiefe cm = length, Breite cm = width, Hoehe cm = height/,
  );
  assert.match(await page.innerText(".file"), /spreadsheet, 1 load, 6 boxes/);
  await page.click(".file button.advice:has-text('Take the container')");
  await page.waitForSelector("main.setup:not([aria-busy]) .go button.primary:text-is('Screen 1 load')");
  await drop(page, { "second.csv": csvOf(rows) });
  assert.match(await page.innerText(".file:has-text('second.csv')"), /Columns as you said[\s\S]*second\.csv\s+6/);
  await page.click(".file:has-text('second.csv') button:text-is('Change')");
  await page.waitForSelector("main.setup:not([aria-busy]) .puzzle");
  await page.close();
});

test("hostile and damaged spreadsheets get a sentence", { skip }, async () => {
  const page = await openPage();
  const parts = partsOf({ Sheet1: palletRows() });
  const sheet = "xl/worksheets/sheet1.xml";
  const refused = async (content: Content, sentence: RegExp) => {
    await drop(page, { "bad.xlsx": content });
    assert.match(await page.innerText("#app"), sentence);
  };
  await refused(zipped({ ...parts, [sheet]: " ".repeat(60 << 20) }), /too large: unpacked it has more than 48 MB/);
  await refused(zipped({ "word/document.xml": "<a/>" }), /no spreadsheet of the kind \.xlsx/);
  await refused(xlsxOf({ Empty: [] }), /no sheet with cells/);
  await refused(
    zipped({ ...parts, [sheet]: parts[sheet].slice(0, 900) }),
    /its part xl\/worksheets\/sheet1\.xml cannot be read/,
  );
  await refused(
    zipped({ ...parts, [sheet]: `<!DOCTYPE a [<!ENTITY b "c">]>${parts[sheet]}` }),
    /its part xl\/worksheets\/sheet1\.xml cannot be read/,
  );
  await refused(
    zipped({ ...parts, [sheet]: parts[sheet].replace('r="2"', 'r="1048570"') }),
    /its rows are not in order/,
  );
  const formula = palletRows();
  formula[1][1] = { formula: "1+1" };
  await refused(xlsxOf({ Sheet1: formula }), /the formula in B2 was saved without its value/);
  await refused(xlsxOf({ Sheet1: palletRows() }).slice(0, 700), /damaged, or no spreadsheet/);
  await refused("\u0001\u0000x;y;z\n", /damaged, or no spreadsheet/);
  // Files that cannot be read do not keep others from being read, and whatever is changed in one gets a sentence or loads.
  const whole = xlsxOf({ Sheet1: palletRows() });
  const mutants = Array.from({ length: 150 }, (_, i) => {
    const mutant = whole.slice();
    for (let k = 0; k <= i % 3; ++k) mutant[(i * 7919 + k * 104729) % mutant.length] ^= 1 << ((i + k) % 8);
    return [`mutant ${i}.xlsx`, mutant] as const;
  });
  await drop(page, Object.fromEntries([...mutants, ["bad.xlsx", whole]]));
  await page.selectOption(".choices select >> nth=1", "trailer-box");
  await page.waitForSelector("main.setup:not([aria-busy])");
  const said = await page.locator(".file").allInnerTexts();
  assert.ok(said.length > 100);
  for (const text of said) assert.match(text, /spreadsheet, \d+ load|cannot be read[\s\S]+\.xlsx|Row \d+|boxes/);
  assert.match(await page.innerText(".go button.primary"), /^Screen \d+ loads?$/);
  // A value that was saved with its formula is taken; a name is a text, whatever it has in it.
  formula[1][1] = { formula: "1-1", value: 0 };
  formula[1][0] = "<img src=x onerror=alert(1)>";
  await drop(page, { "good.xlsx": xlsxOf({ Sheet1: formula }) });
  const good = page.locator(".file:has-text('good.xlsx')");
  assert.match(await good.innerText(), /spreadsheet, 1 load, 20 boxes\s+×[\s\S]*10,850/);
  await page.close();
});

/** A page that has screened a spreadsheet of pallets, and shows them under the second acceleration. */
async function worldOfPallets(): Promise<Page> {
  const page = await openPage();
  await drop(page, { "pallets.csv": csvOf(palletRows()) });
  await page.click(".file button.advice");
  await page.waitForSelector(".go button.primary:not([disabled])");
  await screened(page);
  await page.focus(".matrix");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#app:not([aria-busy]) > main.world");
  return page;
}

test("a load is mended: what would help is tried, taken, undone, and the mended load has the program's verdicts", {
  skip,
}, async () => {
  const page = await worldOfPallets();
  await page.click("button:text-is('Mend')");
  const answered = () =>
    page.waitForFunction(() => {
      const mend = document.querySelector<HTMLElement>("#app:not([aria-busy]) .mend");
      return (
        mend &&
        !/…/.test(mend.querySelector("table")!.innerText) &&
        mend.querySelector(".buttons button:not([disabled])")
      );
    });
  await answered();
  assert.match(await page.innerText(".mend table"), /road-front-0g8\s+–\s*moved 2\s+0\.50 g/);
  await page.click(".mend button:text-is('What would help?')");
  await page.waitForFunction(
    () =>
      document.querySelector(".remedies li") && !/Trying/.test(document.querySelector<HTMLElement>(".mend")!.innerText),
  );
  const remedies = await page.locator(".remedies li").allInnerTexts();
  assert.ok(remedies.length >= 4);
  assert.match(
    remedies[0],
    /^All boxes towards the front, until they touch: holds under all accelerations; margin front 0\.50 g → 1\.50\+ g\./,
  );
  assert.match(remedies[remedies.length - 1], /still fails under road-front-0g8/);
  await page.click(".remedies li:first-child button");
  await page.waitForFunction(() => /stayed/.test(document.querySelector<HTMLElement>(".panel .top")!.innerText));
  await answered();
  assert.match(await page.innerText(".mend table"), /road-front-0g8\s+stayed\s+1\.50\+ g/);

  // What is saved is what was screened.
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.click(".mend button:text-is('Save load')"),
  ]);
  await download.saveAs(path.join(folder, "mended.json"));
  const { worlds } = byProgram("mended.json", ["--container", "trailer-box"]);
  assert.ok(worlds.every((world) => world.verdict === "stayed"));
  assert.match(await page.innerText(".panel .top"), new RegExp(worlds[0].state_hash));

  // Boxes that cannot be so are refused with a sentence, and nothing changes.
  await page.evaluate(() => {
    location.hash = `${location.hash}&box=1`;
  });
  await page.click(".mend button:text-is('down')");
  await page.waitForFunction(() =>
    /outside the container at the floor/.test(document.querySelector(".mend .problem")!.textContent!),
  );
  assert.match(await page.innerText(".mend"), /Undo\n/, "one edit can be undone");
  await page.click(".mend button:text-is('Undo')");
  await page.waitForFunction(() => /moved/.test(document.querySelector<HTMLElement>(".panel .top")!.innerText));
  await answered();
  assert.match(await page.innerText(".mend table"), /road-front-0g8\s+–\s*moved 2\s+0\.50 g/);

  // So does the matrix, of whatever is done.
  await page.click(".mend button:text-is('Take away')");
  await page.waitForFunction(() => /Of 19 boxes/.test(document.querySelector<HTMLElement>(".panel .top")!.innerText));
  await answered();
  await page.keyboard.press("m");
  await page.waitForSelector("main.fleet");
  await page.keyboard.press("ArrowDown");
  assert.match(await page.innerText(".detail"), /boxes\s+19/);
  await page.close();
});

test("boxes are swapped, copied, added and described with the keyboard alone; what is saved has the program's bits", {
  skip,
}, async () => {
  const page = await worldOfPallets();
  await page.keyboard.press("e");
  await page.waitForSelector("#app:not([aria-busy]) .mend");
  /** Goes to what has a name with the tab key. */
  const reach = async (name: string) => {
    for (let press = 0; press < 120; ++press) {
      const at = await page.evaluate(() => {
        const node = document.activeElement as HTMLElement;
        return node.getAttribute("aria-label") ?? node.closest("label")?.textContent ?? node.textContent;
      });
      if (at === name) return;
      await page.keyboard.press("Tab");
    }
    throw new Error(`the tab key does not reach ${name}`);
  };
  const press = async (name: string) => {
    await reach(name);
    await page.keyboard.press("Enter");
  };
  const choose = async (box: number) => {
    await reach("Boxes. Arrow keys choose one.");
    const boxes = 22;
    for (let step = 0; step < 2 * boxes; ++step) {
      if (new RegExp(`Box ${box},`).test(await page.innerText(".mend"))) return;
      await page.keyboard.press(step < boxes ? "ArrowUp" : "ArrowDown");
    }
    throw new Error(`box ${box} is not in the list`);
  };
  const type = async (name: string, text: string) => {
    await reach(name);
    await page.keyboard.press("Control+A");
    await page.keyboard.type(text);
  };
  const undone = (edits: number) =>
    page.waitForFunction(
      (text) =>
        [...document.querySelectorAll("#app:not([aria-busy]) .mend:not([aria-busy]) button")].some(
          (button) => button.textContent === text,
        ),
      edits > 1 ? `Undo (${edits})` : "Undo",
    );
  const says = (words: RegExp) =>
    page.waitForFunction(
      (source) => new RegExp(source).test(document.querySelector(".mend:not([aria-busy]) .problem")?.textContent ?? ""),
      words.source,
    );
  const focused = () =>
    page.evaluate(() => (document.activeElement!.closest("label") ?? document.activeElement!).textContent);
  const hash = async () => /[0-9a-f]{16}/.exec(await page.innerText(".panel .top"))![0];
  let saves = 0;
  const save = async () => {
    const [download] = await Promise.all([page.waitForEvent("download"), press("Save load")]);
    const name = `mended-${++saves}.json`;
    await download.saveAs(path.join(folder, name));
    const { worlds } = byProgram(name, ["--container", "trailer-box"]);
    assert.equal(await hash(), worlds[0].state_hash, name);
    return JSON.parse(readFileSync(path.join(folder, name), "utf8")).loads[0].boxes;
  };
  const before = await hash();

  // A step that was chosen holds for the next boxes too.
  await choose(20);
  await press("by 10 cm");
  await press("rear");
  await undone(1);
  await press("by 1 cm");
  await press("Undo");
  await page.waitForSelector("#app:not([aria-busy]) .mend:not([aria-busy]) button[data-does='undo'][disabled]");
  assert.equal(await hash(), before);

  // The first and the last box, of other heights, swap their places.
  await choose(20);
  await press("Swap");
  assert.match(await page.innerText(".mend"), /Choose the box that box 20, Tinned food 20 swaps places with/);
  await choose(1);
  await press("Swap with box 20, Tinned food 20");
  await undone(1);
  const swapped = await save();
  assert.deepEqual(
    [swapped[0].corner_min, swapped[0].corner_max],
    [
      [7.8, 1.22, 0],
      [8.6, 2.42, 1],
    ],
  );
  assert.deepEqual(
    [swapped[19].corner_min, swapped[19].corner_max],
    [
      [0, 0, 0],
      [0.8, 1.2, 1.3],
    ],
  );

  // A copy stands behind the others, is chosen, and is described.
  await choose(3);
  await press("Copy");
  await undone(2);
  await page.waitForFunction(() => /Box 21, Paper 3/.test(document.querySelector<HTMLElement>(".mend")!.innerText));
  assert.equal(await focused(), "Copy", "the focus stays where it was");
  await press("Name, mass, material");
  await type("Name", "Spare");
  await type("Mass, kg", "123,5");
  await type("Material", "2");
  await page.keyboard.press("Enter");
  await undone(3);
  assert.equal(await focused(), "Material");
  assert.deepEqual((await save())[20], {
    corner_min: [8.6, 0, 0],
    corner_max: [9.4, 1.2, 1.2],
    name: "Spare",
    material: 2,
    mass: 123.5,
  });
  await type("Mass, kg", "heavy");
  await press("Change");
  await says(/^The mass has to be a number of kg above 0: heavy\.$/);

  // A new one needs a size and a mass that can be used, and a place.
  await press("Add a box");
  await type("Length, cm", "60");
  await type("Width, cm", "40");
  await press("Add");
  await says(/^The height has to be a number of cm above 0\.$/);
  await type("Height, cm", "900");
  await reach("Material");
  const form = page.locator(".mend form[aria-label='A new box']");
  await form.locator("label:has-text('Mass') input").focus();
  await page.keyboard.type("31");
  await page.keyboard.press("Enter");
  await says(/^There is no place where a box of 60 × 40 × 900 cm stands\.$/);
  await type("Height, cm", "50");
  await page.keyboard.press("Enter");
  await undone(4);
  await page.waitForFunction(() => /Box 22/.test(document.querySelector<HTMLElement>(".mend")!.innerText));
  const added = await save();
  assert.deepEqual(added[21], { corner_min: [7.2, 0, 0], corner_max: [7.8, 0.4, 0.5], material: 1, mass: 31 });
  assert.match(await page.innerText(".panel .top"), /Of 22 boxes/);

  // A swap for which there is no room is refused in the words of the program.
  await press("Swap");
  await choose(1);
  await press("Swap with box 22");
  await says(/^box \d+ overlaps box \d+:/);

  // All of it is taken back.
  await press("Undo (4)");
  for (const edits of [3, 2, 1]) {
    await undone(edits);
    assert.equal(await focused(), edits > 1 ? `Undo (${edits})` : "Undo");
    await page.keyboard.press("Enter");
  }
  await page.waitForSelector("#app:not([aria-busy]) .mend:not([aria-busy]) button[data-does='undo'][disabled]");
  assert.equal(await page.evaluate(() => document.activeElement!.className), "mend", "there is nothing left to undo");
  assert.equal(await hash(), before);
  await page.close();
});
