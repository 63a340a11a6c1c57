#include "surface/star/compare_samples.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/check_fields.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::size_t kSamplesOfPart = std::size_t{1} << 13;  // chosen: some 20 ms and 130 kB

// Returns the power of two that brings shapes with these bounds to
// the order of 1, so that squares of coordinates do not overflow.
double common_scale(const Bounds& a, const Bounds& b) {
  return unit_frame(bounds({a.min, a.max, b.min, b.max})).scale;
}

Bounds bounds_of(const std::string& name, const MeshInPlace& mesh, const Context& context) {
  try {
    return checked_bounds(mesh, context);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInvalidInput) throw;
    throw Error(error.code(), name + ": " + error.what());
  }
}

}  // namespace

CompareSamples::CompareSamples(const Mesh& a, const Mesh& b, const CompareOptions& options)
    : options_(options) {
  check_fields(options);
  validate(a);
  validate(b);
  scale_ = common_scale(bounds(a.vertices), bounds(b.vertices));
  a_.emplace(a, scale_);
  b_.emplace(b, scale_);
}

CompareSamples::CompareSamples(const MeshInPlace& a, const MeshInPlace& b, std::size_t triangles,
                               const CompareOptions& options, const Context& context)
    : options_(options) {
  check_fields(options);
  const Bounds of_a = bounds_of("A", a, context), of_b = bounds_of("B", b, context);
  scale_ = common_scale(of_a, of_b);
  a_.emplace(a, of_a, scale_, triangles);
  b_.emplace(b, of_b, scale_, triangles);
}

void CompareSamples::prepare(Way way, const Context& context) {
  to(way).prepare_to_measure(context);
  from(way).prepare_to_draw();
}

SampleDistances CompareSamples::measure(Way way, const Context& context,
                                        const ParallelStage& stage) {
  prepare(way, context);
  const std::size_t n = options_.samples;
  SampleDistances all(n);
  const auto measure = [&](std::size_t first, std::size_t count, const Context& on,
                           const ParallelStage& part) {
    to(way).measure(from(way).draw(options_, first, count), all.range(first, count), on, part);
  };
  // Portions are loaded once for all samples.
  if (!from(way).is_kept()) {
    measure(0, n, context, stage);
  } else {
    parallel_for(n, kQueriesOfChunk, context, stage, [&](std::size_t begin, std::size_t end) {
      measure(begin, end - begin, {.threads = 1}, {});
    });
  }
  return all;
}

std::size_t CompareSamples::parts_of_way() const {
  return (options_.samples + kSamplesOfPart - 1) / kSamplesOfPart;
}

CompareSamples::Part CompareSamples::part(std::size_t number) const {
  const std::size_t first = number % parts_of_way() * kSamplesOfPart;
  return {number < parts_of_way() ? Way::kForth : Way::kBack, first,
          std::min(kSamplesOfPart, options_.samples - first)};
}

std::string CompareSamples::work(std::size_t number) {
  const Part part = this->part(number);
  const Context one = {.threads = 1};
  prepare(part.way, one);
  SampleDistances all(part.n);
  to(part.way).measure(from(part.way).draw(options_, part.first, part.n), all.range(0, part.n), one,
                       {});
  ByteWriter writer;
  writer.row(std::span<const double>(all.distances));
  writer.row(std::span<const double>(all.angles));
  return writer.take();
}

void CompareSamples::take(std::size_t number, std::string_view bytes, SampleDistances& forth,
                          SampleDistances& back) const {
  const Part part = this->part(number);
  const DistancesOut out = (part.way == Way::kForth ? forth : back).range(part.first, part.n);
  ByteReader reader(bytes);
  reader.row(out.distances);
  reader.row(out.angles);
  reader.finish();
}

}  // namespace rholm
