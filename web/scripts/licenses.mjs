// Writes the licences of the bundled packages to dist/LICENSES.txt: all dependencies
// of package.json and their dependencies. Fails for a licence that is not one of the
// permissive ones below, and for a package without the text of its licence.
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");
const permissive = new Set(["MIT", "ISC", "BSD-2-Clause", "BSD-3-Clause", "Apache-2.0", "0BSD"]);

const read = (folder) => JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));

function bundled() {
  const found = new Map();
  const visit = (name) => {
    const folder = join(root, "node_modules", name);
    if (found.has(name) || !existsSync(folder)) return;
    const manifest = read(folder);
    found.set(name, { folder, manifest });
    Object.keys(manifest.dependencies ?? {}).forEach(visit);
  };
  Object.keys(read(root).dependencies).forEach(visit);
  return [...found].sort(([a], [b]) => (a < b ? -1 : 1));
}

const parts = ["What the scripts of this folder hold of other projects, and their licences.\n"];
for (const [name, { folder, manifest }] of bundled()) {
  if (!permissive.has(manifest.license)) throw new Error(`${name}: licence ${manifest.license}`);
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name}: no text of its licence`);
  const text = readFileSync(join(folder, file), "utf8").trim();
  parts.push(`${"=".repeat(80)}\n${name} ${manifest.version} (${manifest.license})\n\n${text}\n`);
}
writeFileSync(join(root, "dist", "LICENSES.txt"), parts.join("\n"));
