#include "surface/level_set/components.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/indices_where.h"
#include "base/parallel.h"

namespace rholm {
namespace {

// Area vectors of a closed surface cancel. Rounding leaves far less than this
// part of the area; an opening leaves far more, unless it is negligible.
constexpr double kClosed = 1e-9;

struct Component : ComponentSize {
  Vec3 origin;  // one of its vertices
};

constexpr std::size_t kGrain = 8192;  // vertices or triangles; chosen

// Returns the component of each vertex; components are numbered by first vertex.
std::vector<std::uint32_t> number_components(SharedSets& sets,
                                             const std::vector<std::uint32_t>& first,
                                             const Context& context) {
  std::vector<std::uint32_t> component(sets.size());
  for (std::uint32_t c = 0; c < first.size(); ++c) component[first[c]] = c;
  parallel_for(component.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t own = sets.find(static_cast<std::uint32_t>(v));
      if (own != v) component[v] = component[own];
    }
  });
  return component;
}

std::vector<Component> measure(const Mesh& mesh, const std::vector<std::uint32_t>& component,
                               const std::vector<std::uint32_t>& first, const Context& context) {
  std::vector<Component> measures(first.size());
  for (std::size_t c = 0; c < first.size(); ++c) measures[c].origin = mesh.vertices[first[c]];
  // Sums over consecutive triangles of the same component.
  using Run = std::pair<std::uint32_t, Component>;
  std::vector<std::vector<Run>> runs((mesh.faces.size() + kGrain - 1) / kGrain);
  parallel_for(mesh.faces.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Run>& own = runs[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.faces[i];
      const std::uint32_t which = component[t[0]];
      if (own.empty() || own.back().first != which) own.emplace_back(which, Component{});
      Component& c = own.back().second;
      const Vec3 a = mesh.vertices[t[0]] - measures[which].origin;
      const Vec3 b = mesh.vertices[t[1]] - measures[which].origin;
      const Vec3 d = mesh.vertices[t[2]] - measures[which].origin;
      const Vec3 twice = cross(b - a, d - a);
      c.area_vector += 0.5 * twice;
      c.area += 0.5 * norm(twice);
      c.volume += dot(a, cross(b, d)) / 6;
    }
  });
  for (const std::vector<Run>& some : runs) {
    for (const auto& [which, part] : some) {
      Component& c = measures[which];
      c.area_vector += part.area_vector, c.area += part.area, c.volume += part.volume;
    }
  }
  return measures;
}

// Returns the new index of each vertex after dropping components; entries of dropped vertices
// repeat the next index.
std::vector<std::uint32_t> renumber(const std::vector<std::uint32_t>& component,
                                    const std::vector<char>& stays) {
  std::vector<std::uint32_t> renumbered(component.size() + 1);
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < component.size(); ++v) {
    renumbered[v] = next;
    next += stays[component[v]] != 0;
  }
  renumbered.back() = next;
  return renumbered;
}

template <typename T>
void keep(std::vector<T>& values, const std::vector<std::uint32_t>& renumbered) {
  if (values.empty()) return;
  for (std::size_t v = 0; v + 1 < renumbered.size(); ++v) {
    if (renumbered[v + 1] != renumbered[v]) values[renumbered[v]] = values[v];
  }
  values.resize(renumbered.back());
}

bool has_area(const Mesh& mesh) {
  return std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const Triangle& t) {
    const Vec3& a = mesh.vertices[t[0]];
    return norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) > 0;
  });
}

}  // namespace

std::vector<char> large_components(std::span<const ComponentSize> sizes, double least_share) {
  double largest_area = 0;
  double largest_volume = 0;
  const auto is_closed = [](const ComponentSize& c) {
    return norm(c.area_vector) <= kClosed * c.area;
  };
  for (const ComponentSize& c : sizes) {
    largest_area = std::max(largest_area, c.area);
    if (is_closed(c)) largest_volume = std::max(largest_volume, std::abs(c.volume));
  }
  const double least_volume = std::pow(least_share, 1.5) * largest_volume;
  std::vector<char> stays(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const ComponentSize& c = sizes[i];
    // A vertex without triangles forms a component of area 0.
    stays[i] = c.area > 0 && c.area >= least_share * largest_area &&
               (!is_closed(c) || std::abs(c.volume) >= least_volume);
  }
  return stays;
}

SharedSets connected_vertices(const Mesh& mesh, const Context& context) {
  SharedSets sets(mesh.vertices.size());
  parallel_for(mesh.faces.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.faces[i];
      sets.unite(t[0], t[1]), sets.unite(t[1], t[2]);
    }
  });
  return sets;
}

std::vector<std::uint32_t> first_members(const SharedSets& sets, const Context& context) {
  return indices_where(sets.size(), context, [&](std::uint32_t v) { return sets.is_first(v); });
}

DroppedComponents drop_small_components(Mesh& mesh, double least_share, const Context& context) {
  DroppedComponents result;
  SharedSets sets = connected_vertices(mesh, context);
  const std::vector<std::uint32_t> first = first_members(sets, context);
  const std::size_t n = first.size();
  if (n == 1 && has_area(mesh)) return {.components = 1};
  const std::vector<std::uint32_t> component = number_components(sets, first, context);
  const std::vector<Component> measures = measure(mesh, component, first, context);
  const std::vector<char> stays =
      large_components(std::vector<ComponentSize>(measures.begin(), measures.end()), least_share);
  double area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    result.components += measures[i].area > 0;
    result.dropped += measures[i].area > 0 && !stays[i];
    result.dropped_area += stays[i] ? 0 : measures[i].area;
    area += measures[i].area;
  }
  if (area > 0) result.dropped_area /= area;
  if (std::find(stays.begin(), stays.end(), 0) == stays.end()) return result;
  const std::vector<std::uint32_t> renumbered = renumber(component, stays);
  std::erase_if(mesh.faces, [&](const Triangle& t) { return !stays[component[t[0]]]; });
  parallel_for(mesh.faces.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (std::uint32_t& v : mesh.faces[t]) v = renumbered[v];
    }
  });
  parallel_for(1 + mesh.attributes.size(), 1, context, {}, [&](std::size_t i, std::size_t) {
    if (i == 0) return keep(mesh.vertices, renumbered);
    keep(mesh.attributes[i - 1].values, renumbered);
  });
  return result;
}

}  // namespace rholm
