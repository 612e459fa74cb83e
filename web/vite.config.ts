import { createHash } from "node:crypto";
import { readdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const here = path.dirname(fileURLToPath(import.meta.url));
const robot = process.env["PLUGPILOT_URL"] ?? "http://127.0.0.1:8000";

const WORKER = "worker.js";
const ICONS = ["/icons/icon.svg", "/manifest.webmanifest"];

/** Tells the service worker which files the home page is made of, and when one has changed. */
function listShell(): Plugin {
  return {
    name: "list-shell",
    apply: "build",
    async writeBundle({ dir }, bundle) {
      if (dir === undefined) throw new Error("the build has no output folder");
      const page = await readFile(path.join(dir, "index.html"), "utf-8");
      const found = new Set([...page.matchAll(/\/(assets\/[\w.-]+)/g)].map(([, name = ""]) => name));
      // What those load later belongs to them; a set grows while it is walked.
      for (const name of found) {
        const part = bundle[name];
        if (part?.type !== "chunk") continue;
        for (const next of [...part.imports, ...part.dynamicImports]) found.add(next);
        for (const style of part.viteMetadata?.importedCss ?? []) found.add(style);
      }
      const files = [...[...found].sort().map((name) => `/${name}`), ...ICONS];
      const digest = createHash("sha256").update(page).update(files.join());
      const version = digest.digest("hex").slice(0, 12);
      const worker = path.join(dir, WORKER);
      const code = await readFile(worker, "utf-8");
      if (!code.includes("__SHELL__")) throw new Error(`${WORKER} has no place for the list`);
      await writeFile(worker, code.replace("__SHELL__", JSON.stringify({ version, files })));
    },
  };
}

/** Puts a .gz beside every text file that gains from it, so that the server never compresses. */
function precompress(): Plugin {
  return {
    name: "precompress",
    apply: "build",
    async writeBundle({ dir }) {
      if (dir === undefined) throw new Error("the build has no output folder");
      for (const entry of await readdir(dir, { recursive: true, withFileTypes: true })) {
        if (!entry.isFile() || !/\.(html|js|css|svg|webmanifest)$/.test(entry.name)) continue;
        const file = path.join(entry.parentPath, entry.name);
        const plain = await readFile(file);
        const packed = gzipSync(plain, { level: 9 });
        if (packed.length < plain.length * 0.9) await writeFile(`${file}.gz`, packed);
      }
    },
  };
}

export default defineConfig({
  plugins: [listShell(), precompress()],
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
    rolldownOptions: {
      input: {
        index: path.join(here, "index.html"),
        kiosk: path.join(here, "kiosk.html"),
        technician: path.join(here, "technician.html"),
        worker: path.join(here, "src/worker/worker.ts"),
      },
      output: {
        // The worker's address may never change: browsers ask there for the next version.
        codeSplitting: {
          // One file for all that both pages need: each further one costs a journey to the robot.
          // What only the technician's page and its later parts share stays out of the home page.
          groups: [
            { name: "technician", test: /\/src\/technician\//, minShareCount: 2, priority: 1 },
            { name: "shared", test: /\/(src|preact|@preact)\//, minShareCount: 2 },
          ],
        },
        entryFileNames: ({ name }) => (name === "worker" ? WORKER : "assets/[name]-[hash].js"),
      },
    },
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
