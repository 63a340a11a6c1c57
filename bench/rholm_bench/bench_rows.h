// The inner loop of spreading: row updates of sources whose cells are known, with constant taps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "harmonic/nonuniform/spread.h"

namespace rholm {

// Adds a value and a gradient in theta to the cells that begin at each of `first_cells`:
// `layout.width` rows of padded_width() cells. `taps`: padded_width() columns, then two windows of
// `layout.width` rows.
void update_rows(const GridLayout& layout, std::span<const std::uint32_t> first_cells,
                 const double* taps, double* grid);

const char* vector_target();

}  // namespace rholm
