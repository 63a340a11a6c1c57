#include "transform/mesh_pass/sampled_runs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <tuple>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/random.h"

namespace rholm {
namespace {

constexpr std::size_t kScanGrain = std::size_t{1} << 15;  // faces, some 50 us (chosen)

struct Chosen {
  std::size_t first, n;  // faces
  double chance;
};

// A half-edge, named by the vertices at its ends in ascending order.
struct HalfEdge {
  std::uint64_t name;
  std::size_t run, triangle, side;
};
std::uint64_t edge_name(std::uint64_t a, std::uint64_t b) {
  return std::min(a, b) << 32 | std::max(a, b);
}

// A vertex of a run's faces.
struct RunVertex {
  std::uint32_t vertex;
  std::size_t run;
  bool own = false;  // true if its first face is in the run
};

// Marks the vertices of runs, and finds their places in the sorted list.
class VertexMarks {
 public:
  VertexMarks(std::size_t n_vertices, const std::vector<RunVertex>& sorted)
      : words_(n_vertices / 64 + 1), places_(n_vertices / 64 + 1) {
    std::uint32_t last = 0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const std::uint32_t vertex = sorted[k].vertex;
      if (k > 0 && vertex == last) continue;
      last = vertex;
      words_[vertex / 64] |= std::uint64_t{1} << vertex % 64;
      firsts_.push_back(k);
    }
    firsts_.push_back(sorted.size());
    std::uint32_t place = 0;
    for (std::size_t w = 0; w < words_.size(); ++w) {
      places_[w] = place;
      place += static_cast<std::uint32_t>(std::popcount(words_[w]));
    }
  }
  bool has(std::uint32_t v) const { return (words_[v / 64] >> v % 64 & 1) != 0; }
  // Returns the elements of the sorted list for this vertex, which must be marked.
  template <typename T>
  std::span<T> of(std::uint32_t v, std::vector<T>& sorted) const {
    const std::uint64_t below = words_[v / 64] & ((std::uint64_t{1} << v % 64) - 1);
    const std::size_t place = places_[v / 64] + static_cast<std::size_t>(std::popcount(below));
    return std::span(sorted).subspan(firsts_[place], firsts_[place + 1] - firsts_[place]);
  }

 private:
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> places_;
  std::vector<std::size_t> firsts_;
};

// Elements of a face around a run that belong to the run: bits 0 ... 2 for edges, 3 ... 5 for
// corners.
struct Around {
  std::size_t run, number;
  unsigned has;
};

class RunReader {
 public:
  RunReader(const MeshView& mesh, const MeshPassOptions& options, const BlockParameters& block,
            const Context& context)
      : mesh_(mesh), options_(options), parameters_(block), context_(context) {
    parameters_.largest_index = static_cast<std::uint32_t>(mesh.n_vertices - 1);
  }

  std::vector<SampledRun> read(const std::vector<Chosen>& chosen) {
    std::vector<SampledRun> runs(chosen.size());
    for (std::size_t r = 0; r < runs.size(); ++r) {
      ask_cancel();
      runs[r].chance = chosen[r].chance;
      read_triangles(mesh_, chosen[r].first, chosen[r].n, runs[r].faces);
      for (SampledTriangle& triangle : runs[r].faces) triangle.corners = {};
    }
    find_edges_and_vertices(chosen, runs);
    return runs;
  }

 private:
  void read_triangles(const MeshView& mesh, std::size_t first, std::size_t n,
                      std::vector<SampledTriangle>& triangles) {
    BlockSums sums = no_triangles();
    check_triangles(options_, first, n);
    work(mesh, first, n, sums, triangles);
  }

  void work(const MeshView& mesh, std::size_t first, std::size_t n, BlockSums& sums,
            std::vector<SampledTriangle>& triangles) {
    work_block(mesh, first, n, parameters_, *block_, sums);
    for (std::size_t t = 0; t < n; ++t) {
      SampledTriangle& triangle = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        triangle.p[i] = {block_->corner[i][0][t], block_->corner[i][1][t], block_->corner[i][2][t]};
        triangle.vertices[i] = mesh.triangle(first + t)[i];
        triangle.weight[i] = block_->edge_weight[i][t];
      }
      triangle.face_weight = block_->face_weight[t];
      triangle.lumped = (block_->flag[t] & kNodes) == 0;
    }
  }

  void find_edges_and_vertices(const std::vector<Chosen>& chosen, std::vector<SampledRun>& runs) {
    std::vector<HalfEdge> open;
    std::vector<RunVertex> vertices;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      find_inner_edges(r, runs[r].faces, open);
      add_vertices(r, runs[r].faces, vertices);
    }
    std::sort(open.begin(), open.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return a.name != b.name ? a.name < b.name : a.run < b.run;
    });
    std::sort(vertices.begin(), vertices.end(), [](const RunVertex& a, const RunVertex& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.run < b.run;
    });
    const VertexMarks marks(mesh_.n_vertices, vertices);
    const std::vector<std::size_t> touching = triangles_at(marks);
    find_own_vertices(chosen, touching, marks, vertices);
    std::vector<Around> around = around_vertices(chosen, touching, marks, vertices, runs);
    add_twins(chosen, touching, marks, open, runs, around);
    read_around(around, runs);
  }

  // Edges inside a run belong to it. Appends the half-edges at its border.
  static void find_inner_edges(std::size_t number, std::vector<SampledTriangle>& run,
                               std::vector<HalfEdge>& open) {
    std::vector<HalfEdge> all;
    all.reserve(3 * run.size());
    for (std::size_t t = 0; t < run.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        all.push_back({edge_name(run[t].vertices[i], run[t].vertices[(i + 1) % 3]), number, t, i});
      }
    }
    std::sort(all.begin(), all.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return a.name != b.name ? a.name < b.name : a.triangle < b.triangle;
    });
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool inner = (k > 0 && all[k - 1].name == all[k].name) ||
                         (k + 1 < all.size() && all[k + 1].name == all[k].name);
      if (inner) {
        run[all[k].triangle].edges[all[k].side] = true;
      } else {
        open.push_back(all[k]);
      }
    }
  }

  static void add_vertices(std::size_t number, const std::vector<SampledTriangle>& run,
                           std::vector<RunVertex>& vertices) {
    std::vector<std::uint32_t> all;
    all.reserve(3 * run.size());
    for (const SampledTriangle& triangle : run) {
      all.insert(all.end(), triangle.vertices.begin(), triangle.vertices.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const std::uint32_t vertex : all) vertices.push_back({vertex, number});
  }

  // Returns the elements of a sorted list that are this edge.
  static std::span<HalfEdge> those_with(std::vector<HalfEdge>& sorted, std::uint64_t name) {
    const auto begin =
        std::lower_bound(sorted.begin(), sorted.end(), name,
                         [](const HalfEdge& a, std::uint64_t b) { return a.name < b; });
    auto end = begin;
    while (end != sorted.end() && end->name == name) ++end;
    return {begin, end};
  }

  // Returns the faces of the mesh that have a marked vertex, in order.
  std::vector<std::size_t> triangles_at(const VertexMarks& marks) const {
    std::vector<std::vector<std::size_t>> found((mesh_.n_faces + kScanGrain - 1) / kScanGrain);
    parallel_for(mesh_.n_faces, kScanGrain, {.threads = context_.threads}, {},
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                     const Triangle t = mesh_.triangle(i);
                     if (marks.has(t[0]) || marks.has(t[1]) || marks.has(t[2])) {
                       found[begin / kScanGrain].push_back(i);
                     }
                   }
                   if (options_.release) options_.release(begin, end - begin);
                 });
    std::vector<std::size_t> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  static bool is_in(const Chosen& run, std::size_t number) {
    return number >= run.first && number < run.first + run.n;
  }

  void find_own_vertices(const std::vector<Chosen>& chosen,
                         const std::vector<std::size_t>& touching, const VertexMarks& marks,
                         std::vector<RunVertex>& vertices) const {
    std::vector<bool> seen(vertices.size());
    for (const std::size_t number : touching) {
      for (const std::uint32_t vertex : mesh_.triangle(number)) {
        if (!marks.has(vertex)) continue;
        for (RunVertex& one : marks.of(vertex, vertices)) {
          const auto k = static_cast<std::size_t>(&one - vertices.data());
          if (!seen[k]) one.own = is_in(chosen[one.run], number);
          seen[k] = true;
        }
      }
    }
  }

  // Sets the corners of the runs' own faces. Returns the faces around the runs' own
  // vertices.
  std::vector<Around> around_vertices(const std::vector<Chosen>& chosen,
                                      const std::vector<std::size_t>& touching,
                                      const VertexMarks& marks, std::vector<RunVertex>& vertices,
                                      std::vector<SampledRun>& runs) const {
    std::vector<Around> around;
    for (const std::size_t number : touching) {
      const Triangle t = mesh_.triangle(number);
      for (std::size_t i = 0; i < 3; ++i) {
        if (!marks.has(t[i])) continue;
        for (const RunVertex& one : marks.of(t[i], vertices)) {
          if (!one.own) continue;
          const Chosen& run = chosen[one.run];
          if (is_in(run, number)) {
            runs[one.run].faces[number - run.first].corners[i] = true;
          } else {
            around.push_back({one.run, number, 8U << i});
          }
        }
      }
    }
    return around;
  }

  // Finds the edges on the border of a run that belong to it, and adds the other faces at these
  // edges.
  void add_twins(const std::vector<Chosen>& chosen, const std::vector<std::size_t>& touching,
                 const VertexMarks& marks, std::vector<HalfEdge>& open,
                 std::vector<SampledRun>& runs, std::vector<Around>& around) const {
    std::vector<bool> own(open.size(), true);
    struct Twin {
      std::size_t half_edge, triangle, side;
    };
    std::vector<Twin> twins;
    twins.reserve(open.size());
    for (const std::size_t number : touching) {
      const Triangle t = mesh_.triangle(number);
      for (std::size_t side = 0; side < 3; ++side) {
        const std::uint32_t a = t[side], b = t[(side + 1) % 3];
        if (!marks.has(a) || !marks.has(b)) continue;
        for (const HalfEdge& edge : those_with(open, edge_name(a, b))) {
          const auto k = static_cast<std::size_t>(&edge - open.data());
          const std::size_t here = chosen[edge.run].first + edge.triangle;
          if (number < here) own[k] = false;
          if (number > here) twins.push_back({k, number, side});
        }
      }
    }
    for (std::size_t k = 0; k < open.size(); ++k) {
      runs[open[k].run].faces[open[k].triangle].edges[open[k].side] = own[k];
    }
    for (const Twin& twin : twins) {
      if (own[twin.half_edge]) {
        around.push_back({open[twin.half_edge].run, twin.triangle, 1U << twin.side});
      }
    }
  }

  void read_around(std::vector<Around>& around, std::vector<SampledRun>& runs) {
    std::sort(around.begin(), around.end(), [](const Around& a, const Around& b) {
      return std::tie(a.run, a.number) < std::tie(b.run, b.number);
    });
    std::vector<Triangle> corners;
    std::vector<unsigned> has;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Around& one = around[k];
      const bool again =
          k > 0 && around[k - 1].run == one.run && around[k - 1].number == one.number;
      if (again) {
        has.back() |= one.has;
      } else {
        check_triangles(options_, one.number, 1);
        corners.push_back(mesh_.triangle(one.number));
        has.push_back(one.has);
      }
      const bool last_of_run = k + 1 == around.size() || around[k + 1].run != one.run;
      if (!last_of_run) continue;
      add_around(corners, has, runs[one.run].faces);
      corners.clear();
      has.clear();
    }
  }

  void add_around(const std::vector<Triangle>& corners, const std::vector<unsigned>& has,
                  std::vector<SampledTriangle>& triangles) {
    MeshView gathered = mesh_;
    gathered.faces = reinterpret_cast<const std::byte*>(corners.data());
    gathered.face_stride = sizeof(Triangle);
    gathered.n_faces = corners.size();
    for (std::size_t first = 0; first < corners.size(); first += kTrianglesPerBlock) {
      BlockSums sums = no_triangles();
      const std::size_t n = std::min(kTrianglesPerBlock, corners.size() - first);
      work(gathered, first, n, sums, triangles);
      for (std::size_t t = 0; t < n; ++t) {
        SampledTriangle& triangle = triangles[triangles.size() - n + t];
        triangle.face = false;
        for (std::size_t i = 0; i < 3; ++i) {
          triangle.edges[i] = (has[first + t] >> i & 1) != 0;
          triangle.corners[i] = (has[first + t] >> (3 + i) & 1) != 0;
        }
      }
    }
  }

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  BlockParameters parameters_;
  const Context& context_;
  std::unique_ptr<TriangleBlock<double>> block_ = std::make_unique<TriangleBlock<double>>();
};

}  // namespace

SampledRuns sample_runs(const MeshView& mesh, const MeshPassOptions& options,
                        const BlockParameters& block, std::span<const float> errors, double share,
                        const RunCount& number, const Context& context) {
  const auto blocks = static_cast<double>(errors.size());
  const double count = std::clamp(share * blocks, number.fewest, number.most), even = 1 / blocks;
  double sum = 0;
  for (const double error : errors) sum += error;
  std::vector<Chosen> chosen;
  double weighted = 0, roots = 0, before = random_uniform(0x70726f6265, mesh.n_faces);
  for (std::size_t b = 0; b < errors.size(); ++b) {
    const double part = sum > 0 ? (errors[b] / sum + even) / 2 : even;
    const double chance = share < 1 ? std::min(1.0, count * part) : 1;
    weighted += errors[b] * std::sqrt(chance);
    roots += std::sqrt(chance);
    const double after = before + chance;
    if (std::floor(after) > std::floor(before)) {
      const std::size_t first = b * kTrianglesPerBlock;
      chosen.push_back({first, std::min(kTrianglesPerBlock, mesh.n_faces - first), chance});
    }
    before = after;
  }
  SampledRuns sample;
  const double even_root = roots / blocks;
  sample.common = std::pow(sum > 0 ? std::min(weighted / sum, even_root) : even_root, -2);
  double seen = 0;
  for (const Chosen& run : chosen) seen += static_cast<double>(run.n);
  sample.share = seen / static_cast<double>(mesh.n_faces);
  sample.runs = RunReader(mesh, options, block, context).read(chosen);
  return sample;
}

}  // namespace rholm
