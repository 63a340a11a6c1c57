// Builds the page of `rholm studio`: index.html, one script, one style sheet, with relative addresses only.
import { defineConfig } from "vitest/config";

export default defineConfig({
  base: "./",
  build: {
    outDir: "dist",
    target: "es2022",
    modulePreload: false,
    chunkSizeWarningLimit: 2000, // kB; three.js is the largest part
    rolldownOptions: {
      output: {
        codeSplitting: false,
        entryFileNames: "assets/studio.js",
        assetFileNames: "assets/studio[extname]",
      },
    },
  },
  test: { include: ["tests/**/*.test.ts"] },
});
