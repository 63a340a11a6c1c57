// The page driven in a browser, one file after the other: npm run e2e.
import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["e2e/*.test.ts"],
    fileParallelism: false,
    // Chosen: a drawing buffer in software on a busy machine, never a measure of speed.
    testTimeout: 180_000,
    hookTimeout: 180_000,
  },
});
