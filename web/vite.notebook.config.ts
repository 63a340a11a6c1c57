// Builds the studio of notebooks: one ES module that contains the page built by vite.config.ts.
import { defineConfig } from "vite";

export default defineConfig({
  publicDir: false,
  build: {
    outDir: "dist/viewer",
    emptyOutDir: false,
    target: "es2022",
    minify: true,
    chunkSizeWarningLimit: 2000,
    lib: { entry: "src/notebook.ts", formats: ["es"], fileName: () => "studio.js" },
    rolldownOptions: { output: { codeSplitting: false, minify: true } },
  },
});
