// Samples of a comparison of two surfaces, in both directions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "parts/executor.h"
#include "surface/star/compared_surface.h"

namespace rholm {

enum class Way { kForth, kBack };  // from A to B, from B to A

struct SampleDistances {
  std::vector<double> distances, angles;  // values as in DistancesOut

  explicit SampleDistances(std::size_t n) : distances(n), angles(n) {}
  DistancesOut range(std::size_t first, std::size_t n) {
    return {std::span(distances).subspan(first, n), std::span(angles).subspan(first, n)};
  }
};

class CompareSamples {
 public:
  // Takes meshes that stay in memory. Throws InvalidInput for options and meshes like compare().
  CompareSamples(const Mesh& a, const Mesh& b, const CompareOptions& options);
  // Takes meshes that are read in portions of this many triangles.
  CompareSamples(const MeshInPlace& a, const MeshInPlace& b, std::size_t triangles,
                 const CompareOptions& options, const Context& context);

  // Measures all samples of one direction, on the threads of `context`.
  SampleDistances measure(Way way, const Context& context, const ParallelStage& stage);

  // Returns the number of parts of all samples: first direction first, then the other.
  std::size_t n_parts() const { return 2 * parts_of_way(); }
  // Computes a part and returns its bytes. Any thread may call it.
  std::string work(std::size_t number);
  // Stores the bytes of a part in the distances. Throws Io for bytes that do not fit.
  void take(std::size_t number, std::string_view bytes, SampleDistances& forth,
            SampleDistances& back) const;

  const CompareOptions& options() const { return options_; }
  double scale() const { return scale_; }                      // factor of lengths: a power of two
  double diagonal() const { return a_->bounds().diagonal(); }  // diagonal of A's box, scaled

 private:
  struct Part {
    Way way;
    std::size_t first, n;
  };
  std::size_t parts_of_way() const;
  Part part(std::size_t number) const;
  void prepare(Way way, const Context& context);
  ComparedSurface& from(Way way) { return way == Way::kForth ? *a_ : *b_; }
  ComparedSurface& to(Way way) { return way == Way::kForth ? *b_ : *a_; }

  CompareOptions options_;
  double scale_ = 1;
  std::optional<ComparedSurface> a_, b_;
};

// Compares by these samples. With an executor, other processes compute parts
// too, by work() of their own samples of the same surfaces and options.
Comparison compare(CompareSamples& samples, const Context& context, Executor* executor = nullptr);

}  // namespace rholm
