// Builds the page: bundles the sources and puts script, worker and style into one HTML file.
//   node build.mjs            build/viewer/viewer.html, and licenses.txt
//   node build.mjs --tests    the unit tests, into build/viewer/tests
import { createHash } from "node:crypto";
import { existsSync } from "node:fs";
import { mkdir, readdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const output = path.join(here, "../build/viewer");
/** The engine in WebAssembly, where `make viewer-engine` has built it. */
const engine = path.join(output, "engine.mjs");
/** Whose code is in the page beside ours: their licences go where it goes. HDF5's is in that of h5wasm. */
const pageLicenses = {
  fflate: path.join(here, "node_modules/fflate/LICENSE"),
  h5wasm: path.join(here, "node_modules/h5wasm/LICENSE.txt"),
  three: path.join(here, "node_modules/three/LICENSE"),
};
/** The engine's, as Debian's packages have them that it is built from. */
const engineLicenses = {
  Eigen: "/usr/share/doc/libeigen3-dev/copyright",
  Highway: "/usr/share/doc/libhwy-dev/copyright",
  fast_float: "/usr/share/doc/libfast-float-dev/copyright",
  "JSON for Modern C++": "/usr/share/doc/nlohmann-json3-dev/copyright",
  emscripten: "/usr/share/doc/emscripten/copyright",
};

async function licensesText(withEngine) {
  const files = Object.entries({ ...pageLicenses, ...(withEngine ? engineLicenses : {}) });
  const text = async (file) => (existsSync(file) ? (await readFile(file, "utf8")).trim() : `not found: ${file}`);
  const texts = await Promise.all(files.map(async ([name, file]) => `---- ${name} ----\n\n${await text(file)}\n`));
  return texts.join("\n\n");
}

/** The sources of norms, as `holdfast --norms-page` has written them: rows of name, accelerations and source. */
async function normSources() {
  const page = await readFile(path.join(here, "../docs/reference/norms.md"), "utf8");
  const [, table] = page.split("| norm | accelerations | source |");
  const rows = [...table.split("\n\n")[0].matchAll(/^\| `([^:`]+)(?::K)?` \| .*? \| (.*) \|$/gm)];
  if (rows.length === 0) throw new Error("docs/reference/norms.md has no norms");
  return JSON.stringify(Object.fromEntries(rows.map(([, name, source]) => [name, source])));
}

/** The datasets of the results file, as `holdfast --results-page` has written them in tables of its groups. */
async function resultsDatasets() {
  const page = await readFile(path.join(here, "../docs/reference/results_file.md"), "utf8");
  const datasets = page.split("\n### ").flatMap((group) => {
    const folder = group.split("\n", 1)[0];
    const asked = group.includes("\nOnly in files of runs with");
    const rows = [...group.matchAll(/^\| `(\w+)` \| (\w+) \| ([A-Z])(?: × (\d+))? \| (\S+) \| (.*) \|$/gm)];
    return rows.map(([, name, type, axis, width, units, description]) => ({
      path: `${folder}/${name}`,
      type,
      axis,
      width: Number(width ?? 1),
      units,
      description,
      asked,
    }));
  });
  if (datasets.length === 0) throw new Error("docs/reference/results_file.md has no datasets");
  return JSON.stringify(datasets);
}

/** What scripts have of the pages of the documentation that the program writes. */
const definitions = async () => ({
  HOLDFAST_NORM_SOURCES: await normSources(),
  HOLDFAST_RESULTS_DATASETS: await resultsDatasets(),
});

/** One script of everything that an entry file uses. */
async function bundle(entry) {
  const result = await build({
    entryPoints: [path.join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    alias: { "holdfast-engine": engine },
    define: await definitions(),
    // h5wasm looks for these under Node only.
    external: ["node:*", "fs", "path", "module", "url", "crypto", "worker_threads"],
  });
  return result.outputFiles[0].text;
}

/**
 * What the page may do: run its own script, the workers in it and WebAssembly, and nothing else. It asks nobody for anything, whatever
 * is in a file that it shows: `holdfast view --serve` alone lets it ask the server that it is from.
 */
function policyFor(script) {
  const hash = createHash("sha256").update(script).digest("base64");
  const rules = {
    "default-src": "'none'",
    "script-src": `'sha256-${hash}' 'wasm-unsafe-eval'`,
    "worker-src": "blob:",
    // Elements have styles of their own: colours, places, lengths of bars.
    "style-src": "'unsafe-inline'",
    "img-src": "data: blob:",
    "media-src": "blob:",
    // Packed parts of the page are read as such addresses.
    "connect-src": "data:",
    "base-uri": "'none'",
    "form-action": "'none'",
  };
  return Object.entries(rules)
    .map(([rule, sources]) => `${rule} ${sources}`)
    .join("; ");
}

async function buildPage() {
  const [page, style, script, worker, live] = await Promise.all([
    readFile(path.join(here, "index.html"), "utf8"),
    build({ entryPoints: [path.join(here, "style.css")], bundle: true, minify: true, write: false }).then(
      (r) => r.outputFiles[0].text,
    ),
    bundle("src/main.ts"),
    bundle("src/data/worker.ts"),
    existsSync(engine) ? bundle("src/engine/engine_worker.ts") : "",
  ]);
  const inline = script.replaceAll("</script", "<\\/script");
  const parts = {
    STYLE: style,
    SCRIPT: inline,
    POLICY: policyFor(inline),
    // The worker is nearly all HDF5 in WebAssembly: packed, it is a third as large.
    WORKER: gzipSync(worker, { level: 9 }).toString("base64"),
    ENGINE: live && gzipSync(live, { level: 9 }).toString("base64"),
  };
  const html = page.replaceAll(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
  await mkdir(output, { recursive: true });
  await writeFile(path.join(output, "viewer.html"), html);
  await writeFile(path.join(output, "licenses.txt"), await licensesText(live !== ""));
  console.log(
    `build/viewer/viewer.html: ${(html.length / 1e6).toFixed(2)} MB${live ? "" : ", without the engine: make viewer-engine builds it"}`,
  );
}

async function buildTests() {
  const folder = path.join(here, "../tests/viewer");
  const tests = (await readdir(folder)).filter((name) => name.endsWith(".test.ts"));
  await build({
    entryPoints: tests.map((name) => path.join(folder, name)),
    bundle: true,
    platform: "node",
    format: "esm",
    target: "node18",
    outdir: path.join(output, "tests"),
    outExtension: { ".js": ".mjs" },
    nodePaths: [path.join(here, "node_modules")],
    external: ["playwright-core", "ws"],
    define: await definitions(),
    logLevel: "warning",
  });
}

await (process.argv.includes("--tests") ? buildTests() : buildPage());
