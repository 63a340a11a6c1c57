// Builds the viewer of static pages and notebooks: one ES module without dependencies.
import { defineConfig } from "vite";

export default defineConfig({
  publicDir: false,
  define: { "process.env.NODE_ENV": JSON.stringify("production") },
  build: {
    outDir: "dist/viewer",
    target: "es2022",
    minify: true,
    chunkSizeWarningLimit: 2000,
    lib: { entry: "src/viewer.tsx", formats: ["es"], fileName: () => "viewer.js" },
    rolldownOptions: { output: { codeSplitting: false, minify: true } },
  },
});
