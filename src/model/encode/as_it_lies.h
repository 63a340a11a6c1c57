// Encoding a mesh where it lies, and why that may not do. Layer: model.
#pragma once

#include <variant>

#include "base/shared_tasks.h"
#include "rholm/mesh_view.h"
#include "rholm/model.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {

// Why a mesh cannot be taken as it lies. The way over a chart can change it first, or says best
// what is wrong.
enum class NotAsItLies {
  kOptions,       // vertices to be welded, a method or an engine that the mesh pass is not
  kUnusable,      // numbers, indices or faces that no pass can work with
  kNoCenter,      // no point sees the front of all faces
  kNotClosed,     // or not oriented alike
  kInsideOut,     // the enclosed volume is not above 0
  kFolded,        // faces turn their backs, and a surface that does is not wanted
  kCoveredTwice,  // no face turns its back, and directions meet more than one
};

// What jobs of other processes that have the mesh begin with: which tasks they are of.
inline constexpr char kPassTag = 'p';   // PassHelper::tasks_of()
inline constexpr char kNormsTag = 'n';  // norms_tasks()
ShareTasks with_tag(const ShareTasks& share, char tag);

// Everything from the mesh as it lies. `hooks`: `check` and `release` of it, and `share`. Throws
// InvalidInput for options out of range, and what is no fault of the mesh: Io, OutOfMemory,
// Cancelled, and whatever else a hook or the progress callback throws.
std::variant<Encoded, NotAsItLies> encode_as_it_lies(const MeshView& mesh,
                                                     const EncodeOptions& options,
                                                     const MeshPassOptions& hooks,
                                                     const Context& context);

}  // namespace rholm
