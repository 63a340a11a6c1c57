// Whole pipelines.
#include <rholm/atlas_model.h>
#include <rholm/batch.h>
#include <rholm/compress.h>
#include <rholm/error.h>
#include <rholm/model.h>
#include <rholm/patch_atlas.h>
#include <rholm/points.h>
#include <rholm/primitives.h>
#include <rholm/reconstruct.h>
#include <rholm/synthesize.h>
#include <rholm/topology.h>

#include <cmath>
#include <numbers>
#include <string>

#include "check.h"

namespace {

const double kPi = std::numbers::pi;

void model() {
  rholm::EncodeOptions options;
  options.analyze.degree = 32;
  const rholm::Encoded encoded = rholm::encode(rholm::ellipsoid({1, 2, 3}, 5), options);
  const rholm::Expansion& expansion = encoded.analysis.expansion;
  // Flat triangles with edges of 1/30 of the radius lie 1e-4 radii inside the ellipsoid.
  expect_near(rholm::measure(expansion).volume.value(), 8 * kPi, 0.005 * 8 * kPi,
              "the volume of an ellipsoid");
  rholm::write_model(expansion, "ellipsoid.h5");
  expect(rholm::read_model("ellipsoid.h5").coefficients.c(2, 2) == expansion.coefficients.c(2, 2),
         "what is written is read");
}

void atlas_model() {
  rholm::AtlasModel few;
  few.atlas.caps.resize(1);  // all coefficients zero: a sphere of radius 1
  few.atlas.caps[0].frame = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1, 1};
  few.atlas.caps[0].where = {0, 0, 1, 0, 1};  // a disc of radius 1
  few.atlas.coefficients = {0};
  few.step = 0.1;
  rholm::write_atlas(few, "cap.h5");
  expect(rholm::is_model_file("cap.h5") && rholm::is_atlas_file("cap.h5"), "an atlas is a model");
  expect(rholm::read_atlas("cap.h5").step == few.step, "what is written is read");
}

void compress() {
  const rholm::Mesh torus = rholm::torus(1, 0.4, 96, 48);
  const rholm::Compressed few = rholm::compress(torus, {.tolerance = 0.02});
  expect(few.report.met && few.report.genus == 1, "a torus becomes caps");
  expect(rholm::size_of(few.model.atlas).numbers() < 3 * torus.vertices.size(),
         "which are fewer numbers");
  expect(rholm::inspect(rholm::synthesize(few.model)).genus == 1, "and a torus again");
}

void reconstruct() {
  const rholm::Mesh torus = rholm::torus(1, 0.4, 96, 48);
  const rholm::Reconstruction surface =
      rholm::reconstruct(rholm::sample_surface(torus, {.points = 5000}));
  const rholm::Inspection found = rholm::inspect(surface.mesh);
  expect(found.closed && found.manifold && found.genus == 1, "points of a torus are a torus");
  expect_near(found.volume, 2 * kPi * kPi * 0.16, 0.02 * 2 * kPi * kPi * 0.16,
              "the volume of a torus");
  const rholm::Reconstruction tiled =
      rholm::reconstruct(rholm::sample_surface(torus, {.points = 5000}), {.tile_points = 2000});
  expect(tiled.report.tiles == 4 && rholm::inspect(tiled.mesh).genus == 1,
         "a torus is made in four tiles");
  expect(rholm::foresee_tiles(5000, 2000).tiles == 3, "at least three of them");
}

void patch_atlas() {
  const rholm::Mesh sphere = rholm::icosphere(4);
#ifndef RHOLM_HAS_QHULL
  try {
    rholm::patch_picture(sphere, rholm::PatchView::kPatches);
  } catch (const rholm::Error& refused) {
    expect(refused.code() == rholm::ErrorCode::kUnsupported, "patches need Qhull");
    return;
  }
  expect(false, "patches are refused without Qhull");
#endif
  const rholm::PatchPicture picture = rholm::patch_picture(sphere, rholm::PatchView::kPatches);
  expect(picture.patches > 1, "a sphere has several sides");
  // The points of each patch lie on the sphere fitted to it. Triangles between them with edges e <
  // 0.08 lie at most e^2 / 6 = 1.1e-3 inside.
  const rholm::PatchAtlas made =
      rholm::patch_atlas(sphere, {.degree = 4, .extension = rholm::CapExtension::kSphere});
  expect_near(made.rms_along_rays, 0, 1.1e-3, "what caps miss of a sphere");
}

void batch() {
  const std::string list = "path,mineral\na.ply,quartz\nb.ply,olivine\n";
  const rholm::Manifest manifest = rholm::parse_manifest(list, "list.csv");
  expect(manifest.items.size() == 2 && manifest.items[1].values[0] == "olivine", "two grains");
  rholm::write_batch(
      rholm::gather_batch(
          {}, 2,
          [&](std::size_t i) -> rholm::BatchRow {
            return {{"path", manifest.items[i].path}, {"volume", 0.5 + static_cast<double>(i)}};
          }),
      "grains.h5");
  const rholm::BatchRow row = rholm::read_batch("grains.h5").row(1);
  expect(row == rholm::BatchRow{{"path", std::string("b.ply")}, {"volume", 1.5}},
         "what is written is read");
}

}  // namespace

std::vector<HeaderCheck> model_checks() {
  return {{"model.h", model},
          {"atlas_model.h", atlas_model},
          {"compress.h", compress},
          {"reconstruct.h", reconstruct},
          {"patch_atlas.h", patch_atlas},
          {"batch.h", batch}};
}
