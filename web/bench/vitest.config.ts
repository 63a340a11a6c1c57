// Measures the page's own times in a browser: npm run latency. Nothing is asserted.
import { defineConfig } from "vitest/config";

export default defineConfig({
  test: { include: ["bench/*.test.ts"], testTimeout: 600_000, hookTimeout: 600_000 },
});
