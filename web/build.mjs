/** Makes `dist/` from `page/` and the module that `build.sh` compiled. */
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { build } from "esbuild";

const at = (path) => new URL(path, import.meta.url).pathname;
const target = process.env.CARGO_TARGET_DIR ?? at("target");
const dist = at("dist");
rmSync(dist, { recursive: true, force: true });
mkdirSync(dist);
copyFileSync(`${target}/wasm32-wasip1/release/selfosc-web.wasm`, `${dist}/selfosc.wasm`);
for (const file of ["index.html", "icon.svg", "manifest.webmanifest"]) copyFileSync(at(`page/${file}`), `${dist}/${file}`);
copyFileSync(at("../fixtures/pool/heading.csv"), `${dist}/heading.csv`);
copyFileSync(at("../fixtures/heater.csv"), `${dist}/heater.csv`);
const options = { bundle: true, minify: true, target: "es2022", outdir: dist, logLevel: "warning" };
await build({ ...options, entryPoints: [at("page/main.ts"), at("page/worker.ts"), at("page/main.css")], format: "iife" });
const files = readdirSync(dist).sort();
const digest = createHash("sha256");
for (const file of files) digest.update(readFileSync(`${dist}/${file}`));
const define = { VERSION: JSON.stringify(digest.digest("hex")), FILES: JSON.stringify(["./", ...files]) };
await build({ ...options, entryPoints: [at("page/offline.ts")], define });
await build({ entryPoints: readdirSync(at("tests")).filter((file) => file.endsWith(".test.ts")).map((file) => at(`tests/${file}`)), outdir: at("tested"), outExtension: { ".js": ".mjs" }, bundle: true, platform: "node", format: "esm", packages: "external", logLevel: "warning" });
const module = readFileSync(`${dist}/selfosc.wasm`);
const packed = brotliCompressSync(module, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: module.length } });
// A server that sends packed files as they are finds them here.
writeFileSync(`${dist}/selfosc.wasm.br`, packed);
console.log(`selfosc.wasm: ${module.length} bytes, ${packed.length} by brotli, ${gzipSync(module, { level: 9 }).length} by gzip`);
