import { readdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const here = path.dirname(fileURLToPath(import.meta.url));
const robot = process.env["PLUGPILOT_URL"] ?? "http://127.0.0.1:8000";

/** Puts a .gz beside every text file that gains from it, so that the server never compresses. */
function precompress(): Plugin {
  return {
    name: "precompress",
    apply: "build",
    async writeBundle({ dir }) {
      if (dir === undefined) throw new Error("the build has no output folder");
      for (const entry of await readdir(dir, { recursive: true, withFileTypes: true })) {
        if (!entry.isFile() || !/\.(html|js|css|svg)$/.test(entry.name)) continue;
        const file = path.join(entry.parentPath, entry.name);
        const plain = await readFile(file);
        const packed = gzipSync(plain, { level: 9 });
        if (packed.length < plain.length * 0.9) await writeFile(`${file}.gz`, packed);
      }
    },
  };
}

export default defineConfig({
  plugins: [precompress()],
  resolve: {
    alias: { "@": path.join(here, "src") },
    // The tests live beside web/, not below it: they take their libraries from here.
    dedupe: ["preact", "@preact/signals", "@testing-library/preact", "vitest"],
  },
  build: {
    outDir: "../server/static",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    rolldownOptions: { input: ["index.html", "technician.html"].map((page) => path.join(here, page)) },
  },
  server: {
    fs: { allow: [".."] },
    proxy: {
      "/api": { target: robot, ws: true },
      "/twin": { target: robot, ws: true },
    },
  },
  test: {
    dir: "../tests/web",
    include: ["**/*.test.ts"],
    setupFiles: ["../tests/web/setup.ts"],
    environment: "happy-dom",
    restoreMocks: true,
  },
});
