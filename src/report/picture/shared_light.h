// A picture whose pixels share the rays of their light.
#pragma once

#include "base/parallel.h"
#include "report/picture/canvas.h"
#include "report/picture/panel_picture.h"

namespace rholm {

// Draws the panel into its part of the canvas. The same bits for any number of threads.
void draw_shared(Canvas& canvas, const PanelPicture& panel, const RayScene& scene,
                 const RenderOptions& options, const Context& context, const ParallelStage& stage);

}  // namespace rholm
