#include "rholm/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "base/check_fields.h"
#include "base/refuse.h"
#include "edit/texture/cap_swap.h"
#include "edit/texture/refine.h"
#include "edit/texture/repeated_map.h"
#include "edit/texture/textured_patch.h"
#include "rholm/outward.h"
#include "rholm/topology.h"

namespace rholm {
namespace {

// A base has waves of at least this number of edges: the limit of smoothing, plus some room.
constexpr double kFewestBaseEdges = 3;
// Width of transitions in radii of the regions, unless waves are
// shorter. A small width excludes limbs and folds around a region.
constexpr double kTransition = 0.25;
// Edge length of a refined target, in edges of the source times the scale. Lines
// on the texture's map are half an edge apart, and heights between them are cubic.
constexpr double kRefined = 1;

void check_update(const TransferUpdate& u, int from_degree) {
  if (u.mode == TransferMode::kCoefficients && from_degree >= kMaxSwapDegree) {
    refuse(
        fmt::format("coefficients are swapped up to degree {}, and the detail begins above {}; "
                    "take a degree below {}",
                    kMaxSwapDegree, from_degree, kMaxSwapDegree));
  }
  check_fields(u);
}

double median_edge(const TexturedPatch& textured) {
  std::vector<double> in(textured.row.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = textured.row[i] == kNoRow ? 0 : 1;
  return median_edge(textured.local.points, textured.local.faces, in);
}

// Heights of the source on the target's chart, whose lengths are `scale` of the source's lengths.
struct Texture {
  const DetailMap& map;
  const RepeatedMap& repeated;
  double scale = 1, angle = 0;
  bool repeat = false;

  double single(const Place2& at) const { return map(at) * map.weight(at); }

  double operator()(const Place2& at) const {
    // Converts back to the source: turned the other way, divided by the scale.
    const double c = std::cos(angle), s = std::sin(angle);
    const Place2 back{(c * at.p + s * at.q) / scale, (c * at.q - s * at.p) / scale};
    return repeat ? repeated(back) : single(back);
  }
};

double rms_in_disc(const DetailMap& map) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (map.weights[i] < 1) continue;
    sum += map.values[i] * map.values[i];
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

// A name that a file cannot give to a property.
constexpr const char* kCarriedName = "region of a transfer";

// Refines in the regions and their transition; returns the number of new vertices.
// Balls and boxes stay; other regions become an attribute, which refinement carries on.
std::size_t refine_target(double transition, double length, std::vector<Region>& regions,
                          Mesh& mesh) {
  std::vector<double> weights = region_weights(mesh, regions, transition);
  const auto is_place = [](const Region& region) {
    return std::holds_alternative<BallRegion>(region) || std::holds_alternative<BoxRegion>(region);
  };
  const bool all_places = std::all_of(regions.begin(), regions.end(), is_place);
  mesh.attributes.push_back({kCarriedName, ScalarType::kFloat64, weights});
  mesh = weld(mesh).mesh;
  weights = std::move(mesh.attributes.back().values);
  mesh.attributes.pop_back();
  const std::size_t n_before = mesh.vertices.size();
  refine(mesh, weights, length);
  if (!all_places) {
    mesh.attributes.push_back({kCarriedName, ScalarType::kFloat64, std::move(weights)});
    regions = {PropertyRegion{kCarriedName}};
  }
  return mesh.vertices.size() - n_before;
}

std::vector<Vec3> displaced(const TexturedPatch& target, const Texture& texture, double height,
                            bool remove_own) {
  const Patch& patch = target.patch;
  std::vector<Vec3> positions = remove_own ? update(patch) : patch.positions;
  for (std::size_t i = 0; i < target.local.points.size(); ++i) {
    const std::uint32_t row = target.row[i];
    if (row == kNoRow) continue;
    const double h = height * texture(target.chart(target.base[i])) * patch.weights[row];
    const Vec3 at = positions[row] + h * target.normals[i];
    // Points of a seam have one row each, in sequence.
    const std::size_t n = target.local.members_of(i).size();
    for (std::size_t k = row; k < row + n; ++k) {
      if (h != 0 || remove_own) positions[k] = at;
    }
  }
  return positions;
}

// Throws if the base needs waves that the source cannot represent.
void check_degree(const Mesh& source, std::span<const double> weights, double radius, int degree) {
  const double edge = median_edge(source.vertices, source.faces, weights);
  if (4 * radius / degree >= kFewestEdges * edge) return;
  const int most = static_cast<int>(4 * radius / (kFewestEdges * edge));
  refuse(
      fmt::format("the region is {:.3g} across and the mesh's edges are {:.3g} long there: a base "
                  "of degree {} has waves of {:.3g}, shorter than {:g} edges; take {}",
                  2 * radius, edge, degree, 4 * radius / degree, kFewestEdges,
                  most >= 2 ? fmt::format("degree {} or less, or a larger region", most)
                            : std::string("a larger region, or a finer mesh")));
}

// Turns a closed mesh that is inside out, because heights are along outward normals.
std::optional<Mesh> turned_outwards(const Mesh& mesh) {
  if (!(enclosed_volume(mesh) < 0) || !outward(mesh).flipped) return std::nullopt;
  Mesh turned = mesh;
  flip(turned);
  return turned;
}

}  // namespace

struct TransferSourceState {
  TexturedPatch patch;
  DetailMap texture;
  mutable std::once_flag repeating;
  mutable RepeatedMap repeated;  // computed when it is needed
};

struct TransferState {
  std::shared_ptr<const TransferSourceState> source;
  TexturedPatch target;
  TransferOptions options;
};

EnumNames names_of(TransferMode) {
  static constexpr std::array kNames = {"displacement", "coefficients"};
  return {"mode of transfer", kNames};
}

TransferSource analyze_source(const Mesh& source, std::span<const Region> from, int from_degree,
                              const Context& context) {
  check_fields(TransferOptions{.from_degree = from_degree});
  validate(source);
  if (from.empty()) refuse("a source region is needed");
  if (const auto turned = turned_outwards(source)) {
    return analyze_source(*turned, from, from_degree, context);
  }
  TransferSource analysis;
  analysis.from_degree = from_degree;
  analysis.radius = region_radius(source, from);
  analysis.wavelength = 4 * analysis.radius / from_degree;
  const double fading = std::min(analysis.wavelength, kTransition * analysis.radius);
  check_degree(source, region_weights(source, from, fading), analysis.radius, from_degree);
  auto state = std::make_shared<TransferSourceState>();
  state->patch = texture_of(source, from, analysis.wavelength, fading, context);
  state->texture = detail_of(state->patch);
  analysis.edge = median_edge(state->patch);
  analysis.rms = rms_in_disc(state->texture);
  analysis.state = std::move(state);
  return analysis;
}

TransferAnalysis analyze_transfer(const TransferSource& source, const Mesh& target,
                                  std::span<const Region> to, const TransferOptions& options,
                                  const Context& context) {
  check_fields(options);
  validate(target);
  if (!source.state) refuse("the source has no texture: analyze_source() takes one");
  if (options.from_degree != source.from_degree) {
    refuse(fmt::format("the source's detail begins above degree {}, not {}", source.from_degree,
                       options.from_degree));
  }
  if (to.empty()) refuse("a target region is needed");
  if (const auto turned = turned_outwards(target)) {
    TransferAnalysis analysis = analyze_transfer(source, *turned, to, options, context);
    flip(analysis.mesh);
    return analysis;
  }
  const TexturedPatch& patch = source.state->patch;
  TransferAnalysis analysis;
  analysis.mesh = target;
  TransferReport& report = analysis.report;
  report.source_wavelength = source.wavelength;
  report.source_edge = source.edge;
  report.source_rms = source.rms;
  const double target_radius = region_radius(target, to);
  const double about = options.scale * target_radius / source.radius;
  const double wanted = report.source_wavelength * about;
  std::vector<Region> regions(to.begin(), to.end());
  const double transition =
      options.transition.value_or(std::min(wanted, kTransition * target_radius));
  Mesh& mesh = analysis.mesh;
  if (options.refine) {
    report.new_vertices =
        refine_target(transition, kRefined * report.source_edge * about, regions, mesh);
  }
  const double edge =
      median_edge(mesh.vertices, mesh.faces, region_weights(mesh, regions, transition));
  report.target_wavelength = std::max(wanted, kFewestBaseEdges * edge);
  auto state = std::make_shared<TransferState>();
  state->source = source.state;
  state->options = options;
  state->target = texture_of(mesh, regions, report.target_wavelength, transition, context);
  count_azimuths_like(patch.chart, state->target.chart);
  report.target_edge = median_edge(state->target);
  // These sizes belong to the bases: detail does not count.
  report.source_radius = patch.chart.unit;
  report.target_radius = state->target.chart.unit;
  report.scale = options.scale * report.target_radius / report.source_radius;
  if (options.find_angle) {
    const Alignment best =
        align_maps(source.state->texture, 1 / options.scale, detail_of(state->target));
    report.angle = best.angle;
    report.correlation = best.correlation;
  }
  std::erase_if(mesh.attributes, [](const Attribute& a) { return a.name == kCarriedName; });
  analysis.patch = state->target.patch;
  analysis.state = std::move(state);
  return analysis;
}

TransferAnalysis analyze_transfer(const Mesh& source, std::span<const Region> from,
                                  const Mesh& target, std::span<const Region> to,
                                  const TransferOptions& options, const Context& context) {
  check_fields(options);  // checked before the work
  return analyze_transfer(analyze_source(source, from, options.from_degree, context), target, to,
                          options, context);
}

std::vector<Vec3> update(const TransferAnalysis& analysis, const TransferUpdate& wanted) {
  const TransferState& state = *analysis.state;
  const TransferSourceState& source = *state.source;
  check_update(wanted, state.options.from_degree);
  const double angle = wanted.angle.value_or(analysis.report.angle);
  if (wanted.mode == TransferMode::kCoefficients) {
    return swap_coefficients(source.patch, state.target, state.options.from_degree, angle,
                             wanted.height);
  }
  if (wanted.repeat) {
    std::call_once(source.repeating, [&] { source.repeated = repeat(source.texture); });
  }
  const Texture texture{source.texture, source.repeated, state.options.scale, angle, wanted.repeat};
  return displaced(state.target, texture, wanted.height * analysis.report.scale, wanted.remove_own);
}

Mesh transfer(const Mesh& source, std::span<const Region> from, const Mesh& target,
              std::span<const Region> to, const TransferOptions& options,
              const TransferUpdate& wanted, const Context& context) {
  check_update(wanted, options.from_degree);
  TransferOptions needed = options;
  if (wanted.angle) needed.find_angle = false;
  TransferAnalysis analysis = analyze_transfer(source, from, target, to, needed, context);
  apply(analysis.patch, update(analysis, wanted), analysis.mesh);
  return std::move(analysis.mesh);
}

}  // namespace rholm
