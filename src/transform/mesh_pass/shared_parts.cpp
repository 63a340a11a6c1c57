#include "transform/mesh_pass/shared_parts.h"

#include <utility>

#include "base/bytes.h"
#include "base/progress.h"

namespace rholm {
namespace {

enum Round : std::uint32_t { kRanges, kParts };

template <typename T>
Executor::Work part_tasks(PartWorker<T>& worker, ByteReader& reader) {
  std::vector<IndexRange> ranges;
  bool in_common = false;
  reader.array(ranges);
  reader.value(in_common);
  reader.finish();
  worker.set_ranges(std::move(ranges));
  return [&worker, in_common](std::size_t part, int) { return part_task(worker, in_common, part); };
}

}  // namespace

template <typename T>
std::string range_task(const PartWorker<T>& worker, std::size_t part) {
  ByteWriter writer;
  writer.value(worker.range_of(part));
  return writer.take();
}

template <typename T>
std::string part_task(const PartWorker<T>& worker, bool in_common, std::size_t part) {
  // The process that runs the pass reports progress, by whole parts.
  const Context nobody;
  SharedProgress progress(nobody, "", 0, 1, 1);
  ByteWriter writer;
  const std::unique_ptr<GridSources<T>> grid = worker.new_grid();
  if (!in_common) {
    write(worker.work(part, *grid, progress), writer);
    grid->write(writer);
    return writer.take();
  }
  CommonLumps<LumpOf<T>> lumps = worker.no_lumps();
  write(worker.work(part, lumps, *grid, progress), writer);
  grid->write(writer);
  lumps.write(writer);
  return writer.take();
}

template std::string range_task(const PartWorker<float>&, std::size_t);
template std::string range_task(const PartWorker<double>&, std::size_t);
template std::string part_task(const PartWorker<float>&, bool, std::size_t);
template std::string part_task(const PartWorker<double>&, bool, std::size_t);

std::string ranges_job(const MeshPlan& plan, const NonuniformPlan& transform,
                       const Division& division) {
  ByteWriter writer;
  writer.value(std::uint32_t{kRanges});
  writer.value(plan);
  writer.value(transform);
  writer.value(division);
  return writer.take();
}

std::string parts_job(const std::vector<IndexRange>& ranges, bool in_common) {
  ByteWriter writer;
  writer.value(std::uint32_t{kParts});
  writer.array(std::span(ranges));
  writer.value(in_common);
  return writer.take();
}

Executor::Work PassHelper::work_of(std::string_view input) {
  ByteReader reader(input);
  std::uint32_t round = 0;
  reader.value(round);
  if (round == kParts && single_) return part_tasks(*single_, reader);
  if (round == kParts && double_) return part_tasks(*double_, reader);
  if (round != kRanges) ByteReader::refuse();
  MeshPlan plan;
  NonuniformPlan transform;
  Division division;
  reader.value(plan);
  reader.value(transform);
  reader.value(division);
  reader.finish();
  single_.reset();
  double_.reset();
  const auto begin = [&]<typename T>(std::unique_ptr<PartWorker<T>>& worker) -> Executor::Work {
    worker = std::make_unique<PartWorker<T>>(mesh_, hooks_, plan, division, transform);
    return [&worker = *worker](std::size_t part, int) { return range_task(worker, part); };
  };
  return plan.single ? begin(single_) : begin(double_);
}

}  // namespace rholm
