#include "rholm_bench/bench_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rholm_bench/bench_rows.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <std::size_t kPadded>
HWY_INLINE void update_padded(const GridLayout& layout, std::span<const std::uint32_t> first_cells,
                              const double* HWY_RESTRICT taps, double* HWY_RESTRICT grid) {
  const hn::CappedTag<double, kPadded> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  const double* const value = taps + kPadded;
  const double* const slope = value + layout.width;
  for (const std::uint32_t cell : first_cells) {
    double* HWY_RESTRICT row = grid + cell;
    for (int i = 0; i < layout.width; ++i, row += layout.stride) {
      for (std::size_t v = 0; v < kPadded; v += kLanes) {
        const auto columns = hn::Load(d, taps + v);
        auto sum = hn::LoadU(d, row + v);
        sum = hn::MulAdd(hn::Set(d, value[i]), columns, sum);
        sum = hn::MulAdd(hn::Set(d, slope[i]), columns, sum);
        hn::StoreU(sum, d, row + v);
      }
    }
  }
}

void UpdateRows(const GridLayout& layout, std::span<const std::uint32_t> first_cells,
                const double* taps, double* grid) {
  const int padded = padded_width(layout.width);
  if (padded == 4) return update_padded<4>(layout, first_cells, taps, grid);
  if (padded == 8) return update_padded<8>(layout, first_cells, taps, grid);
  update_padded<16>(layout, first_cells, taps, grid);
}
const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(UpdateRows);
HWY_EXPORT(TargetName);

void update_rows(const GridLayout& layout, std::span<const std::uint32_t> first_cells,
                 const double* taps, double* grid) {
  HWY_DYNAMIC_DISPATCH(UpdateRows)(layout, first_cells, taps, grid);
}

const char* vector_target() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

}  // namespace rholm
#endif  // HWY_ONCE
