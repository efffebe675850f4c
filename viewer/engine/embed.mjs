// Writes the engine as one module: glue.mjs with the WebAssembly in base64.
//   node embed.mjs glue.mjs engine.wasm engine.mjs
import { readFileSync, writeFileSync } from 'node:fs';

const [glue, wasm, module] = process.argv.slice(2);
const place = "'@WASM@'";
const text = readFileSync(glue, 'utf8');
if (text.split(place).length !== 2) throw new Error(`${glue}: not exactly one ${place}`);
writeFileSync(module, text.replace(place, `'${readFileSync(wasm).toString('base64')}'`));
