// Reports and pictures.
#include <rholm/model.h>
#include <rholm/primitives.h>
#include <rholm/render.h>
#include <rholm/report.h>
#include <rholm/studio.h>

#include <array>

#include "check.h"

namespace {

std::array<int, 3> pixel(const rholm::Image& image, int x, int y) {
  const std::uint8_t* rgb = image.rgb.data() + 3 * (std::ptrdiff_t{y} * image.width + x);
  return {rgb[0], rgb[1], rgb[2]};
}

void render() {
  const rholm::Mesh sphere = rholm::icosphere(3);
  const rholm::Panel panel{&sphere, "", std::vector<double>(sphere.vertices.size(), 1.0)};
  const rholm::Image image = rholm::render({&panel, 1}, {.width = 64, .height = 64});
  expect(image.rgb.size() == 64 * 64 * 3, "a picture has its pixels");
  expect(pixel(image, 32, 32) != pixel(image, 1, 1), "a sphere is in the middle");
  expect(pixel(image, 1, 1) == pixel(image, 62, 1), "and not in the corners");
}

void report() {
  rholm::EncodeOptions options;
  options.analyze.degree = 4;
  const rholm::Mesh box = rholm::box({1, 1, 1});
  const rholm::Expansion expansion = rholm::encode(box, options).analysis.expansion;
  const std::string page = rholm::report_html(
      expansion, &box, {.title = "One box", .shape_name = "box.ply", .picture_size = 32});
  expect(page.starts_with("<!DOCTYPE html>"), "a report is a page");
  expect(page.find("One box") != std::string::npos, "with a title");
  expect(page.find("<script") == std::string::npos, "and without scripts");
}

void studio() {
  rholm::Studio studio({.threads = 1});
  const std::string session = studio.offered_session();
  const rholm::StudioResponse state = studio.handle({.path = "api/state", .session = session});
  expect(state.status == 200, "a session has a state");
  expect(state.body.find("\"items\":[]") != std::string::npos, "without shapes");
  expect(studio.handle({.path = "api/state"}).status == 404, "which nobody else has");
  const std::unique_ptr<rholm::StudioListener> listener = studio.listen(session);
  expect(listener->wait(std::chrono::seconds(10)).size() == 1, "who listens is told it");
  studio.close();
  expect(listener->ended(), "and when it ends");
}

}  // namespace

std::vector<HeaderCheck> report_checks() {
  return {{"render.h", render}, {"report.h", report}, {"studio.h", studio}};
}
