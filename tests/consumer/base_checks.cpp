// Vectors, errors, cancellation, pictures, the version, and the header that includes all others.
#include <rholm/rholm.h>

#include <cmath>
#include <numbers>

#include "check.h"

namespace {

void vec3() {
  expect(rholm::cross({1, 0, 0}, {0, 1, 0}) == rholm::Vec3{0, 0, 1}, "x cross y is z");
  expect(rholm::norm({2, 3, 6}) == 7, "|(2, 3, 6)| is 7");
}

void error() {
  try {
    rholm::icosphere(-1);
  } catch (const rholm::Error& refused) {
    expect(refused.code() == rholm::ErrorCode::kInvalidInput, "the code says what is wrong");
    expect(rholm::to_string(refused.code()) == std::string("InvalidInput"), "codes have names");
    return;
  }
  expect(false, "an icosphere of -1 subdivisions is refused");
}

void error_info() {
  for (const rholm::ErrorInfo& kind : rholm::error_infos()) {
    expect(kind.name == std::string(rholm::to_string(kind.code)), "kinds of errors have names");
  }
}

void fields() {
  std::string names;
  rholm::for_each_field<rholm::SimplifyOptions>(
      [&](auto, const rholm::FieldInfo& info) { names += std::string(info.name) + " "; });
  expect(names == "faces share max_error ", "options list their fields");
}

void context() {
  rholm::Context context{.threads = 1};
  context.progress = [](std::string_view, double) { return false; };
  try {
    rholm::expand(rholm::icosphere(3), {}, context);
  } catch (const rholm::Error& stopped) {
    expect(stopped.code() == rholm::ErrorCode::kCancelled, "a callback's false cancels");
    return;
  }
  expect(false, "a callback's false stops a computation");
}

void image() {
  const rholm::Image image{2, 1, {255, 0, 0, 0, 0, 255}};
  const std::vector<char> png = rholm::encode_png(image);
  // A PNG file begins with 8 bytes, length and name of the first chunk, width, height.
  expect(png.size() > 24 && std::string(png.data() + 1, 3) == "PNG", "a PNG file says so");
  expect(png[19] == 2 && png[23] == 1, "it has the image's width and height");
}

void version() {
  expect(std::string(rholm::kVersion) == RHOLM_PACKAGE_VERSION,
         "the package has the version of its header");
}

// From a box to coefficients and back, with the single header.
void rholm_h() {
  rholm::ExpandOptions options;
  options.degree = 8;
  const rholm::Expanded expanded = rholm::expand(rholm::box({1, 1, 1}), options);
  const rholm::Expansion& expansion = expanded.transform.expansion;
  const double mean_radius = expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  expect(mean_radius > 0.5 && mean_radius < std::sqrt(0.75),
         "a box lies between its inscribed and its circumscribed sphere");
  expect(rholm::synthesize(expansion, rholm::icosphere(2)).vertices.size() == 162,
         "a surface has the vertices of its sphere");
}

}  // namespace

std::vector<HeaderCheck> base_checks() {
  return {{"vec3.h", vec3},       {"error.h", error},     {"error_info.h", error_info},
          {"fields.h", fields},   {"context.h", context}, {"image.h", image},
          {"version.h", version}, {"rholm.h", rholm_h}};
}
