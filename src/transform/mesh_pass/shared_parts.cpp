#include "transform/mesh_pass/shared_parts.h"

#include <utility>

#include "base/bytes.h"
#include "base/progress.h"

namespace rholm {
namespace {

enum Round : std::uint32_t { kRanges, kParts, kGrids };

// Who shares the pass reports progress, by whole parts.
SharedProgress no_progress() {
  static const Context nobody;
  return {nobody, "", 0, 1, 1};
}

}  // namespace

template <typename T>
SharedParts<T>::SharedParts(const MeshView& mesh, const MeshPassOptions& options,
                            const MeshPlan& plan, const Division& division)
    : plan_(plan), division_(division), worker_(mesh, options, plan_, division_) {}

template <typename T>
void SharedParts<T>::set_ranges(std::vector<IndexRange> ranges, std::size_t groups,
                                bool in_common) {
  worker_.set_ranges(std::move(ranges));
  groups_ = groups;
  in_common_ = in_common;
}

template <typename T>
void SharedParts<T>::set_transform(const NonuniformPlan& transform) {
  transform_ = transform;
  kernel_ = grid_kernel<T>(transform.fourier);
}

template <typename T>
std::string SharedParts<T>::range_of(std::size_t part) const {
  ByteWriter writer;
  writer.value(worker_.range_of(part));
  return writer.take();
}

template <typename T>
std::string SharedParts<T>::work(std::size_t group) {
  if (in_common_) return work_in_common(group);
  if (transform_) return work_to_grid(group);
  ByteWriter writer;
  SharedProgress progress = no_progress();
  for (std::size_t p = first(group, groups_); p < first(group + 1, groups_); ++p) {
    WorkedPart<T> worked = worker_.work(p, nullptr, progress);
    write(worked.part, writer);
    const std::lock_guard lock(mutex_);
    held_.insert_or_assign(p, std::move(worked));
  }
  return writer.take();
}

template <typename T>
std::string SharedParts<T>::work_to_grid(std::size_t part) const {
  ByteWriter writer;
  SharedProgress progress = no_progress();
  GridSources<T> grid(*transform_, kernel_);
  const WorkedPart<T> worked = worker_.work(part, &grid, progress);
  worker_.spread(worked, grid);
  grid.flush();
  write(worked.part, writer);
  grid.write(writer);
  return writer.take();
}

template <typename T>
std::string SharedParts<T>::work_in_common(std::size_t group) const {
  ByteWriter writer;
  SharedProgress progress = no_progress();
  CommonLumps<LumpOf<T>> lumps(worker_.n_vertices(), lumps_per_vertex(plan_.block.hessians));
  for (std::size_t p = first(group, groups_); p < first(group + 1, groups_); ++p) {
    std::optional<GridSources<T>> grid;
    if (transform_) grid.emplace(*transform_, kernel_);
    const WorkedPart<T> worked = worker_.work(p, lumps, grid ? &*grid : nullptr, progress);
    write(worked.part, writer);
    if (grid) {
      grid->flush();
      grid->write(writer);
    } else {
      writer.array(std::span(worked.part.kept));
      writer.array(std::span(worked.part.kept_gradients));
    }
  }
  lumps.add_up(0, worker_.n_vertices());
  lumps.write(writer);
  return writer.take();
}

template <typename T>
std::string SharedParts<T>::spread(std::size_t grid, std::size_t n) {
  GridSources<T> sources(*transform_, kernel_);
  for (std::size_t p = first(grid, n); p < first(grid + 1, n); ++p) {
    worker_.spread(take_held(p), sources);
  }
  sources.flush();
  ByteWriter writer;
  sources.write(writer);
  return writer.take();
}

template <typename T>
WorkedPart<T> SharedParts<T>::take_held(std::size_t part) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = held_.find(part);
    if (found != held_.end()) {
      WorkedPart<T> worked = std::move(found->second);
      held_.erase(found);
      return worked;
    }
  }
  SharedProgress progress = no_progress();
  return worker_.work(part, nullptr, progress);
}

template class SharedParts<float>;
template class SharedParts<double>;

std::string ranges_job(const MeshPlan& plan, const Division& division) {
  ByteWriter writer;
  writer.value(std::uint32_t{kRanges});
  writer.value(plan);
  writer.value(division);
  return writer.take();
}

std::string parts_job(const std::vector<IndexRange>& ranges, std::size_t groups, bool in_common,
                      const NonuniformPlan* transform) {
  ByteWriter writer;
  writer.value(std::uint32_t{kParts});
  writer.array(std::span(ranges));
  writer.value(std::uint64_t{groups});
  writer.value(in_common);
  writer.value(transform != nullptr);
  if (transform != nullptr) writer.value(*transform);
  return writer.take();
}

std::string grids_job(std::size_t n, const NonuniformPlan& transform) {
  ByteWriter writer;
  writer.value(std::uint32_t{kGrids});
  writer.value(std::uint64_t{n});
  writer.value(transform);
  return writer.take();
}

Executor::Work PassHelper::work_of(std::string_view input) {
  ByteReader reader(input);
  std::uint32_t round = 0;
  reader.value(round);
  if (round == kRanges) {
    MeshPlan plan;
    Division division;
    reader.value(plan);
    reader.value(division);
    single_.reset();
    double_.reset();
    if (plan.single) {
      single_ = std::make_unique<SharedParts<float>>(mesh_, hooks_, plan, division);
    } else {
      double_ = std::make_unique<SharedParts<double>>(mesh_, hooks_, plan, division);
    }
  }
  if (single_) return work_of(single_, reader, round);
  if (double_) return work_of(double_, reader, round);
  ByteReader::refuse();
}

template <typename T>
Executor::Work PassHelper::work_of(std::unique_ptr<SharedParts<T>>& parts, ByteReader& reader,
                                   std::uint32_t round) {
  SharedParts<T>& all = *parts;
  std::uint64_t n = 0;
  NonuniformPlan transform;
  switch (round) {
    case kRanges:
      reader.finish();
      return [&all](std::size_t part, int) { return all.range_of(part); };
    case kParts: {
      std::vector<IndexRange> ranges;
      bool in_common = false, has_transform = false;
      reader.array(ranges);
      reader.value(n);
      reader.value(in_common);
      reader.value(has_transform);
      if (has_transform) {
        reader.value(transform);
        all.set_transform(transform);
      }
      reader.finish();
      all.set_ranges(std::move(ranges), n, in_common);
      return [&all](std::size_t group, int) { return all.work(group); };
    }
    case kGrids:
      reader.value(n);
      reader.value(transform);
      reader.finish();
      all.set_transform(transform);
      return [&all, n](std::size_t grid, int) { return all.spread(grid, n); };
    default:
      ByteReader::refuse();
  }
}

}  // namespace rholm
