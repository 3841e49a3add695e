// Builds the page: one HTML file with all scripts and styles in it, dist/page.html. The hash of its sources is written into
// it, by which tests/viewer/check_fresh.py knows whether the page that is checked in is the page of these sources.
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, renameSync, rmSync, statSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const root = fileURLToPath(new URL(".", import.meta.url));
const single = ["index.html", "package.json", "package-lock.json", "tsconfig.json", "vite.config.ts", "colour_maps.json"];

function filesBelow(folder: string): string[] {
  return readdirSync(join(root, folder))
    .map((name) => `${folder}/${name}`)
    .flatMap((path) => (statSync(join(root, path)).isDirectory() ? filesBelow(path) : [path]));
}

/** SHA-256 over "PATH SIZE\n" and the bytes of each source, in order of path. */
function hashOfSources(): string {
  const hash = createHash("sha256");
  for (const path of [...single, ...filesBelow("src")].sort()) {
    const bytes = readFileSync(join(root, path));
    hash.update(`${path} ${bytes.length}\n`).update(bytes);
  }
  return hash.digest("hex");
}

const stamp: Plugin = {
  name: "undine-stamp",
  transformIndexHtml: (html) => html.replace("SOURCES", hashOfSources()),
};

const rename: Plugin = {
  name: "undine-rename",
  enforce: "post",
  writeBundle(options) {
    const folder = options.dir!;
    rmSync(join(folder, "page.html"), { force: true });
    renameSync(join(folder, "index.html"), join(folder, "page.html"));
  },
};

export default defineConfig({
  root,
  plugins: [stamp, viteSingleFile({ removeViteModuleLoader: true }), rename],
  build: { target: "es2022", outDir: "dist", emptyOutDir: true, reportCompressedSize: false, chunkSizeWarningLimit: 2000 },
});
