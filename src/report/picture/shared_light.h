// A picture whose pixels share the rays of their light.
#pragma once

#include "base/parallel.h"
#include "report/picture/canvas.h"
#include "report/picture/panel_picture.h"

namespace rholm {

// Draws the panel into its part of the canvas, a strip of some pixels after the other; chosen: with
// some 130 bytes each they stay near the processor. The same bits for any number of threads, and
// for any strips.
inline constexpr int kStripCells = 1 << 15;
void draw_shared(Canvas& canvas, const PanelPicture& panel, const RayScene& scene,
                 const RenderOptions& options, const Context& context, const ParallelStage& stage,
                 int strip_cells = kStripCells);

}  // namespace rholm
