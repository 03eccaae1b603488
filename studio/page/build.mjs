// Builds the page: node build.mjs OUT [--check]. Writes OUT/page.js, OUT/page.css and OUT/index.html, and prints their sizes.
// --check runs the type checker first. A page above 900 kB in all is an error.
import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, statSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const kGreatestSize = 900_000;

const here = dirname(fileURLToPath(import.meta.url));
const args = process.argv.slice(2);
const out = args.find((arg) => !arg.startsWith("--"));
if (out === undefined) {
  console.error("usage: node build.mjs OUT [--check]");
  process.exit(2);
}
const target = resolve(out);
mkdirSync(target, { recursive: true });

if (args.includes("--check")) {
  execFileSync(process.execPath, [join(here, "node_modules/typescript/bin/tsc"), "--noEmit", "-p", here], { stdio: "inherit" });
}

await build({
  absWorkingDir: here,
  entryPoints: { page: "src/main.ts" },
  outfile: join(target, "page.js"),
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  legalComments: "eof",
  logLevel: "warning",
});
await build({
  absWorkingDir: here,
  entryPoints: ["src/page.css"],
  outfile: join(target, "page.css"),
  bundle: true,
  minify: true,
  target: "chrome123",
  logLevel: "warning",
});
copyFileSync(join(here, "index.html"), join(target, "index.html"));

let sum = 0;
for (const name of ["index.html", "page.css", "page.js"]) {
  const size = statSync(join(target, name)).size;
  sum += size;
  console.log(`${name} ${size} bytes`);
}
console.log(`page ${sum} bytes`);
if (sum > kGreatestSize) {
  console.error(`The page has ${sum} bytes (expected at most ${kGreatestSize}).`);
  process.exit(1);
}
