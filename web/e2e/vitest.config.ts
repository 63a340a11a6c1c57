// Drives the page in a browser, one test file at a time: npm run e2e.
import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["e2e/*.test.ts"],
    fileParallelism: false,
    // Chosen for a software drawing buffer on a busy machine; never a measure of speed.
    testTimeout: 180_000,
    hookTimeout: 180_000,
  },
});
