#include "transform/mesh_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <numbers>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "harmonic/nonuniform.h"
#include "rholm/error.h"
#include "transform/mesh_block.h"
#include "transform/mesh_nodes.h"
#include "transform/mesh_plan.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kBlockSize = kTrianglesPerBlock;
// Blocks between two reports of progress: about 1 ms.
constexpr std::size_t kBlocksPerStep = 512;
constexpr std::size_t kVerticesPerStep = 1 << 16;
// Below this part of triangles with nodes these are kept until the sums of squares are known
// exactly; above, they are spread as they come, to a window chosen from the sample.
constexpr double kFewNodes = 0.01;
constexpr std::size_t kMostKept = std::size_t{1} << 20;  // nodes, 32 MB
constexpr std::size_t kMostUndivided = std::size_t{1} << 18;

// What placing of sources in single precision leaves, relative to the sum of the moduli of their
// weights: it is alike for neighbours and does not average out. Boxes of 1 to 12 million triangles
// left 1.8e-8, smooth bodies 2e-9.
constexpr double kSingleRounding = 1.8e-8;
// A second pass is rare, a third should not be needed.
constexpr int kMostPasses = 3;

// Single precision goes with sums in whole quanta of 32 bits.
template <typename T>
using LumpOf = std::conditional_t<sizeof(T) == 4, std::int32_t, double>;

// Progress of several threads.
class SharedProgress {
 public:
  SharedProgress(const Context& context, const char* stage, double from, double to, double total)
      : context_(context), stage_(stage), from_(from), to_(to), total_(total) {}
  void add(std::size_t work) {
    if (!context_.progress) return;
    const std::lock_guard lock(mutex_);
    done_ += static_cast<double>(work);
    report_progress(context_, stage_, from_ + (to_ - from_) * std::min(1.0, done_ / total_));
  }

 private:
  const Context& context_;
  const char* stage_;
  double from_, to_, total_;
  std::mutex mutex_;
  double done_ = 0;
};

// Sums of lumps are exact in any order: a thread takes any array that is free.
template <typename T>
class LumpArrays {
 public:
  explicit LumpArrays(std::size_t n_vertices) : n_vertices_(n_vertices) {}
  using Array = AlignedArray<VertexLump<T>>;
  std::unique_ptr<Array> take() {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      std::unique_ptr<Array> array = std::move(free_.back());
      free_.pop_back();
      return array;
    }
    auto array = std::make_unique<Array>(n_vertices_);
    std::memset(static_cast<void*>(array->data()), 0, n_vertices_ * sizeof(VertexLump<T>));
    return array;
  }
  void give_back(std::unique_ptr<Array> array) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(array));
  }
  std::size_t size() const { return free_.size(); }
  // Calls visit(i, lump of vertex i, in quanta) for the vertices [begin, end).
  template <typename Visit>
  void visit(std::size_t begin, std::size_t end, const Visit& visit) const {
    const VertexLump<T>* first = free_[0]->data();
    for (std::size_t i = begin; i < end; ++i) {
      VertexLump<T> sum = first[i];
      for (std::size_t a = 1; a < free_.size(); ++a) {
        for (int k = 0; k < 4; ++k) sum.value[k] = sum_of(sum.value[k], (*free_[a])[i].value[k]);
      }
      visit(i, sum.value);
    }
  }

 private:
  static std::int32_t sum_of(std::int32_t a, std::int32_t b) {  // modulo 2^32
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
  }
  static double sum_of(double a, double b) { return a + b; }

  std::size_t n_vertices_;
  std::vector<std::unique_ptr<Array>> free_;
  std::mutex mutex_;
};

// Sources on their way to a grid.
template <typename T>
class Spreading {
 public:
  // `slope` is what a gradient counts against a weight in a window's error.
  Spreading(const NonuniformPlan& plan, const GridKernel<T>& kernel, double slope)
      : spreader_(plan, kernel), slope2_(slope * slope) {}

  void add(std::span<const Node> nodes) {
    for (const Node& node : nodes) {
      put(values_, n_values_, node.x, node.weight);
      source2_ += node.weight * node.weight;
      if (n_values_ == kSize) flush_values();
    }
  }
  void add(const Vec3& x, double weight, const Vec3& gradient) {
    put(slopes_, n_slopes_, x, weight);
    slopes_.gradient[0][n_slopes_ - 1] = static_cast<T>(gradient.x);
    slopes_.gradient[1][n_slopes_ - 1] = static_cast<T>(gradient.y);
    slopes_.gradient[2][n_slopes_ - 1] = static_cast<T>(gradient.z);
    source2_ += weight * weight + slope2_ * dot(gradient, gradient);
    if (n_slopes_ == kSize) flush_slopes();
  }
  // A vertex with its lump in quanta. Without one its position may be anything.
  template <typename Lump>
  void add_vertex(const Vec3& x, double weight, double slope, const Lump (&lump)[4]) {
    const bool nothing = lump[0] == 0 && lump[1] == 0 && lump[2] == 0 && lump[3] == 0;
    const std::size_t n = n_slopes_++;
    slopes_.x[0][n] = static_cast<T>(nothing ? 1.0 : x.x);
    slopes_.x[1][n] = static_cast<T>(nothing ? 0.0 : x.y);
    slopes_.x[2][n] = static_cast<T>(nothing ? 0.0 : x.z);
    slopes_.value[n] = static_cast<T>(weight * static_cast<double>(lump[0]));
    for (int k = 0; k < 3; ++k) {
      slopes_.gradient[k][n] = static_cast<T>(slope * static_cast<double>(lump[k + 1]));
    }
    if (n_slopes_ == kSize) flush_slopes();
  }
  // Sources that were added by other ways than add().
  void count(double source2) { source2_ += source2; }
  void flush() {
    flush_values();
    flush_slopes();
  }

  double source2() const { return source2_; }
  GridSpreader<T> take_spreader() { return std::move(spreader_); }

 private:
  static constexpr std::size_t kSize = SourceBatch<T>::kSize;
  static void put(SourceBatch<T>& batch, std::size_t& n, const Vec3& x, double weight) {
    batch.x[0][n] = static_cast<T>(x.x);
    batch.x[1][n] = static_cast<T>(x.y);
    batch.x[2][n] = static_cast<T>(x.z);
    batch.value[n] = static_cast<T>(weight);
    ++n;
  }
  void flush_values() {
    if (n_values_ > 0) spreader_.add(values_, n_values_, 0);
    n_values_ = 0;
  }
  void flush_slopes() {
    if (n_slopes_ > 0) spreader_.add(slopes_, n_slopes_, 1);
    n_slopes_ = 0;
  }
  GridSpreader<T> spreader_;
  double source2_ = 0, slope2_;
  SourceBatch<T> values_, slopes_;
  std::size_t n_values_ = 0, n_slopes_ = 0;
};

// What a gradient counts against a weight in a window's error: some 9 L (measured at twofold
// oversampling).
double gradient_cost(const MeshPlan& plan) { return 9.0 * std::max(plan.divided.degree, 1); }

struct KeptSlope {
  Vec3 x, weight;
};

// What one part of the triangles leaves.
struct Part {
  BlockSums sums = no_triangles();
  double mean = 0;  // int r dOmega over triangles with nodes for it
  double source2 = 0;
  std::size_t nodes = 0;
  bool overflow = false;
  std::vector<SampledHalfEdge> half_edges;
  std::vector<Node> kept;
  std::vector<KeptSlope> slopes;
  std::vector<Vec3> undivided;
  std::vector<double> undivided_weights;
  Coefficients undivided_sum;
};

// Where a part's nodes go: kept, or to the part's grid.
template <typename T>
class PartSink : public NodeSink {
 public:
  PartSink(Part& part, Spreading<T>* spreading, const MeshPlan& plan)
      : part_(part), spreading_(spreading), plan_(plan) {}
  void add(std::span<const Node> nodes) override {
    part_.nodes += nodes.size();
    for (const Node& node : nodes) part_.source2 += node.weight * node.weight;
    if (spreading_ != nullptr) return spreading_->add(nodes);
    part_.overflow = part_.overflow || part_.kept.size() + nodes.size() > kMostKept;
    if (!part_.overflow) part_.kept.insert(part_.kept.end(), nodes.begin(), nodes.end());
  }
  void add_gradient(const Vec3& x, const Vec3& weight) override {
    ++part_.nodes;
    if (spreading_ != nullptr) return spreading_->add(x, 0, weight);
    part_.source2 += std::pow(gradient_cost(plan_), 2) * dot(weight, weight);
    part_.overflow = part_.overflow || part_.slopes.size() >= kMostKept;
    if (!part_.overflow) part_.slopes.push_back({x, weight});
  }
  void add_undivided(const Vec3& x, double weight) override {
    ++part_.nodes;
    part_.undivided.push_back(x / norm(x));
    part_.undivided_weights.push_back(weight);
    if (part_.undivided.size() >= kMostUndivided) sum_undivided();
  }
  void sum_undivided() {
    if (part_.undivided.empty()) return;
    if (part_.undivided_sum.degree() != plan_.divided.degree) {
      part_.undivided_sum = Coefficients(plan_.divided.degree);
    }
    double square = 0;
    for (const double w : part_.undivided_weights) square += w * w;
    const double l = plan_.divided.degree + 1.0;
    // Generic sums of these have the l2 norm L sqrt(sum w^2 / 4 pi).
    const double relative = plan_.window / (l * std::sqrt(square / (4 * kPi)));
    add_adjoint({.directions = part_.undivided, .weights = part_.undivided_weights},
                part_.undivided_sum, {.precision = std::clamp(0.5 * relative, 1e-14, 0.1)},
                {.threads = 1});
    part_.undivided.clear();
    part_.undivided_weights.clear();
  }

 private:
  Part& part_;
  Spreading<T>* spreading_;
  const MeshPlan& plan_;
};

[[noreturn]] void throw_index(const MeshView& mesh, std::size_t first, std::size_t n) {
  for (std::size_t t = first; t < first + n; ++t) {
    for (const std::uint32_t index : mesh.triangle(t)) {
      if (index < mesh.n_vertices) continue;
      throw Error(ErrorCode::kInvalidInput, "triangle " + std::to_string(t) + " names vertex " +
                                                std::to_string(index) + ", but there are only " +
                                                std::to_string(mesh.n_vertices));
    }
  }
  throw Error(ErrorCode::kInvalidInput, "a triangle names a vertex that does not exist");
}

// One way through the triangles with a given plan.
template <typename T>
class Pass {
 public:
  using Lump = LumpOf<T>;

  Pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
       const Context& context)
      : mesh_(mesh),
        options_(options),
        plan_(plan),
        context_(context),
        arrays_(mesh.n_vertices),
        n_blocks_((mesh.n_triangles + kBlockSize - 1) / kBlockSize) {}

  void run(MeshPassResult& result) {
    const bool upfront = plan_.node_share > kFewNodes;
    if (upfront) {
      choose_window(plan_.source2, estimated_sources());
      make_grids();
    }
    const std::size_t parts = upfront ? grids_.size() : part_count();
    parts_ = std::vector<Part>(parts);
    {
      const StageTimer timer(result.times, "triangles");
      work_triangles();
    }
    BlockSums sums = no_triangles();
    double source2 = 0;
    for (const Part& part : parts_) {
      if (part.overflow) {
        plan_.node_share = 1;
        return run_again(result);
      }
      sums.add(part.sums);
      source2 += part.source2;
      result.report.nodes += part.nodes;
    }
    check_sums(sums);
    sum_lumps();
    if (too_much_) {
      result.needs_double = true;
      return;
    }
    if (!upfront) {
      std::size_t kept = 0;
      for (const Part& part : parts_) kept += part.kept.size() + part.slopes.size();
      source2 += lumps2_;
      choose_window(source2, mesh_.n_vertices + kept);
      make_grids();
    }
    {
      const StageTimer timer(result.times, "spread");
      grids_[0]->count(lumps2_);
      spread_vertices();
    }
    {
      const StageTimer timer(result.times, "fourier");
      transform_grids(result);
    }
    report_mesh(sums, result);
    report_error(sums, result);
  }

 private:
  void run_again(MeshPassResult& result) {
    arrays_.~LumpArrays<Lump>();
    new (&arrays_) LumpArrays<Lump>(mesh_.n_vertices);
    result.report.nodes = 0;
    ++result.report.passes;
    run(result);
  }

  std::size_t estimated_sources() const {
    // Some five nodes a triangle.
    return mesh_.n_vertices +
           static_cast<std::size_t>(5 * plan_.node_share * static_cast<double>(mesh_.n_triangles));
  }

  // Parts of the triangles when they need no grids: as many as pay, whatever the number of threads.
  std::size_t part_count() const {
    return std::clamp<std::size_t>(mesh_.n_triangles / 20000, 1, 8);
  }

  void choose_window(double source2, std::size_t sources) {
    NonuniformNeeds needs{.degree = plan_.divided.degree,
                          .error = std::clamp(window_error(plan_, source2), 1e-15, 1e-2),
                          .sources = sources,
                          .derivatives = 1,
                          .forbid_single = sizeof(T) == 8,
                          // The sum of squares has gradients in it already.
                          .gradient_size = 0};
    transform_ = plan_nonuniform(needs);
    transform_.single = sizeof(T) == 4;
    kernel_ = grid_kernel<T>(transform_.fourier);
  }

  void make_grids() {
    const std::size_t n = grid_count(transform_, estimated_sources());
    for (std::size_t i = 0; i < n; ++i) {
      grids_.push_back(std::make_unique<Spreading<T>>(transform_, kernel_, gradient_cost(plan_)));
    }
  }

  void work_triangles() {
    const std::size_t n = parts_.size(), size = (n_blocks_ + n - 1) / n;
    SharedProgress progress(context_, "triangles", 0, 0.5, static_cast<double>(n_blocks_));
    const Context silent{.threads = context_.threads};
    parallel_for(n_blocks_, size, silent, {}, [&](std::size_t begin, std::size_t end) {
      work_part(begin / size, begin, end, progress);
    });
  }

  void work_part(std::size_t p, std::size_t begin, std::size_t end, SharedProgress& progress) {
    Part& part = parts_[p];
    BlockParameters parameters = plan_.block;
    auto lumps = arrays_.take();
    auto block = std::make_unique<TriangleBlock<Lump>>();
    PartSink<T> sink(part, grids_.empty() ? nullptr : grids_[p].get(), plan_);
    NodeWriter writer({plan_.divided, plan_.undivided}, sink);
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t first = b * kBlockSize;
      const std::size_t n = std::min(kBlockSize, mesh_.n_triangles - first);
      if (options_.check && !options_.check(first, n)) {
        throw Error(ErrorCode::kUnsupported, "a face is not a triangle");
      }
      parameters.largest_index = largest_index(mesh_, first, n);
      if (parameters.largest_index >= mesh_.n_vertices) throw_index(mesh_, first, n);
      const std::size_t before = part.sums.nodes;
      work_block(mesh_, first, n, parameters, *block, part.sums);
      scatter_lumps(mesh_, first, n, *block, lumps->data());
      sample_half_edges(*block, n, part.half_edges);
      if (part.sums.nodes != before || part.sums.max_edge2 > plan_.block.mean_reach2) {
        write_nodes(*block, first, n, writer, part);
      }
      if ((b - begin) % kBlocksPerStep == kBlocksPerStep - 1) {
        if (options_.release) {
          options_.release(first + n - kBlocksPerStep * kBlockSize, kBlocksPerStep * kBlockSize);
        }
        progress.add(kBlocksPerStep);
      }
    }
    writer.flush();
    sink.sum_undivided();
    arrays_.give_back(std::move(lumps));
  }

  void write_nodes(const TriangleBlock<Lump>& block, std::size_t first, std::size_t n,
                   NodeWriter& writer, Part& part) {
    for (std::size_t t = 0; t < n; ++t) {
      if (block.flag[t] == kLumped) continue;
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) {
        p[i] = {block.corner[i][0][t], block.corner[i][1][t], block.corner[i][2][t]};
      }
      if ((block.flag[t] & kNodes) != 0) {
        writer.add_triangle(p, mesh_.triangle(first + t));
      }
      if ((block.flag[t] & kMeanNodes) != 0) part.mean += radius_integral(p, plan_.mean_error);
    }
  }

  void check_sums(const BlockSums& sums) const {
    if (std::isfinite(sums.probe)) return;
    validate(mesh_);
    throw Error(ErrorCode::kInvalidInput, "the coordinates are too large to be multiplied");
  }

  Vec3 position(std::size_t i) const {
    return plan_.block.scale * (mesh_.vertex(i) - plan_.block.center);
  }

  // Sum of squares of the lumps, with gradients as much as they count in a window's error. The
  // weights of each triangle add up to 0, all but rounding to quanta: where the sum of all is far
  // from it, a vertex has left the range of its integers.
  void sum_lumps() {
    const double weight = 1 / plan_.block.per_weight,
                 slope = gradient_cost(plan_) / plan_.block.per_gradient;
    double sum = 0, moduli = 0, values = 0, slopes = 0;
    arrays_.visit(0, mesh_.n_vertices, [&](std::size_t, const auto& lump) {
      const double w = static_cast<double>(lump[0]), x = static_cast<double>(lump[1]);
      const double y = static_cast<double>(lump[2]), z = static_cast<double>(lump[3]);
      sum += w;
      moduli += std::abs(w);
      values += w * w;
      slopes += x * x + y * y + z * z;
    });
    lumps2_ = weight * weight * values + slope * slope * slopes;
    too_much_ = sizeof(T) == 4 &&
                (std::abs(sum) > 0x1p31 || kSingleRounding * weight * moduli > 2 * plan_.window);
  }

  void spread_vertices() {
    const std::size_t n = grids_.size(), size = (mesh_.n_vertices + n - 1) / n;
    SharedProgress progress(context_, "spread", 0.5, 0.9, static_cast<double>(mesh_.n_vertices));
    const Context silent{.threads = context_.threads};
    parallel_for(mesh_.n_vertices, size, silent, {}, [&](std::size_t begin, std::size_t end) {
      const std::size_t g = begin / size;
      Spreading<T>& spreading = *grids_[g];
      for (std::size_t p = g; p < parts_.size(); p += n) {
        spreading.add(parts_[p].kept);
        for (const KeptSlope& node : parts_[p].slopes) spreading.add(node.x, 0, node.weight);
      }
      const double weight = 1 / plan_.block.per_weight, slope = 1 / plan_.block.per_gradient;
      for (std::size_t first = begin; first < end; first += kVerticesPerStep) {
        const std::size_t last = std::min(end, first + kVerticesPerStep);
        arrays_.visit(first, last, [&](std::size_t i, const auto& lump) {
          spreading.add_vertex(position(i), weight, slope, lump);
        });
        progress.add(last - first);
      }
      spreading.flush();
    });
  }

  void transform_grids(MeshPassResult& result) {
    const int degree = plan_.divided.degree;
    Coefficients sum(degree);
    std::vector<GridSpreader<T>> spreaders;
    source2_ = 0;
    for (auto& grid : grids_) {
      source2_ += grid->source2();
      spreaders.push_back(grid->take_spreader());
    }
    finish_adjoint<T>(transform_, spreaders, sum, context_, {"transform", 0.9, 1});
    divide(sum);
    for (const Part& part : parts_) {
      if (part.undivided_sum.degree() != degree) continue;
      for (std::size_t i = 0; i < sum.values().size(); ++i) {
        sum.values()[i] += part.undivided_sum.values()[i];
      }
    }
    result.coefficients = std::move(sum);
  }

  void report_mesh(const BlockSums& sums, MeshPassResult& result) const {
    double mean = sums.mean;
    for (const Part& part : parts_) mean += part.mean;
    Coefficients& c = result.coefficients;
    c.c(0, 0) = mean / std::sqrt(4 * kPi);
    const double unscale = 1 / plan_.block.scale;
    for (double& value : c.values()) value *= unscale;
    result.volume = sums.volume6 / 6 * unscale * unscale * unscale;
    result.closed = sums.hash1 == 0 && sums.hash2 == 0;
    const auto root = [](double x) { return std::copysign(std::sqrt(std::abs(x)), x); };
    result.min_d = root(sums.min_d2) * unscale;
    result.min_cos_gamma = root(sums.min_cos2);
    result.bad_triangles = sums.bad;
    FastReport& report = result.report;
    report.single = sizeof(T) == 4;
    report.width = transform_.fourier.layout.width;
    report.oversampling = static_cast<double>(transform_.fourier.layout.n_phi) /
                          (2.0 * std::max(plan_.divided.degree, 1));
    report.lumped_triangles = mesh_.n_triangles - sums.nodes;
    report.vertices = mesh_.n_vertices;
  }

  // What rules, windows and rounding have left, by the model the plan was made with and the sums
  // that are known by now.
  void report_error(const BlockSums& sums, MeshPassResult& result) const {
    const int degree = plan_.divided.degree;
    std::vector<SampledHalfEdge> sample;
    for (const Part& part : parts_) {
      sample.insert(sample.end(), part.half_edges.begin(), part.half_edges.end());
    }
    const double edges2 = sampled_error2(sample, plan_.block.sampled_names);
    const double lumped2 =
        plan_.coherence > 0 ? plan_.coherence * sums.face_error2 : sums.face_error2 + edges2;
    const double rules = rule_error(plan_, lumped2, static_cast<double>(sums.nodes));
    const double spread = std::sqrt(source2_ / (4 * kPi));
    const double relative_window =
        spread_error(transform_.fourier.layout.width, result.report.oversampling);
    const double window = spread * (relative_window + (sizeof(T) == 4 ? kSingleNoise : 0.0));
    double whole2 = 0, band2 = 0;
    for (int l = 1; l <= degree; ++l) {
      double energy = 0;
      for (int m = 0; m <= l; ++m) {
        const double c = result.coefficients.c(l, m), s = result.coefficients.s(l, m);
        energy += c * c + s * s;
      }
      whole2 += energy;
      if (4 * l > 3 * degree) band2 += energy;
    }
    const double scale = plan_.block.scale;
    const auto relative = [&](double error, double square) {
      return square > 0 ? error / (scale * std::sqrt(square)) : 0.0;
    };
    // Vertices in step with the grid leave the window's error of the whole, see
    // MeshPlan::most_window.
    const double in_step = 0.5 * relative_window * scale * std::sqrt(whole2);
    result.report.error =
        relative(std::hypot(rules, window, std::hypot(in_step, quantum_error(plan_))), whole2);
    // Of l^6, as the error of lumping grows, 0.82 lies above 3L/4; of (2l+1)/(l(l+1))^2, as that of
    // windows falls, 0.78 / L^2.
    result.report.band_error =
        relative(std::hypot(0.9 * rules, 0.88 / std::max(degree, 1) * window), band2);
  }

  static void divide(Coefficients& c) {
    for (int l = 1; l <= c.degree(); ++l) {
      const double factor = 1.0 / (static_cast<double>(l) * (l + 1));
      for (int m = 0; m <= l; ++m) {
        c.c(l, m) *= factor;
        c.s(l, m) *= factor;
      }
    }
  }

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  MeshPlan plan_;
  const Context& context_;
  LumpArrays<Lump> arrays_;
  std::size_t n_blocks_;
  std::vector<Part> parts_;
  NonuniformPlan transform_;
  GridKernel<T> kernel_;
  std::vector<std::unique_ptr<Spreading<T>>> grids_;
  double source2_ = 0, lumps2_ = 0;
  bool too_much_ = false;
};

// l2 norm of the coefficients but c_00.
double result_norm(const MeshPassResult& result) {
  double sum = 0;
  for (const double value : result.coefficients.values()) sum += value * value;
  const double c00 = result.coefficients.c(0, 0);
  return std::sqrt(std::max(sum - c00 * c00, 0.0));
}

}  // namespace

MeshPassResult mesh_pass(const MeshView& mesh, const MeshPassOptions& options,
                         const Context& caller) {
  if (mesh.n_triangles == 0) {
    throw Error(ErrorCode::kInvalidInput, "the mesh has no triangles");
  }
  MeshSample sample = sample_mesh(mesh, options.center, options.degree);
  // A second pass does not go back.
  double furthest = 0;
  Context context = caller;
  if (caller.progress) {
    context.progress = [&](std::string_view stage, double fraction) {
      furthest = std::max(furthest, fraction);
      return caller.progress(stage, furthest);
    };
  }
  MeshPassResult result;
  result.covers = sample.covers;
  double tighten = 1;
  bool wide = false;
  for (int pass = 1; pass <= kMostPasses; ++pass) {
    const MeshPlan plan =
        plan_mesh(mesh, sample, options.center, options.degree, options.precision, tighten);
    result.report = {.passes = pass};
    if (plan.single && !wide) {
      Pass<float>(mesh, options, plan, context).run(result);
      if (result.needs_double) {
        wide = true;
        continue;
      }
    } else {
      Pass<double>(mesh, options, plan, context).run(result);
    }
    // The sample may have missed what matters, or taken the norm for larger than it is.
    const double wish = std::max(options.precision, plan.rounding / result_norm(result));
    if (!(result.report.error > wish)) break;
    tighten *= 1.5 * result.report.error / wish;
    sample.edge_ratio = std::max(sample.edge_ratio, result.edge_ratio);
  }
  return result;
}

}  // namespace rholm
