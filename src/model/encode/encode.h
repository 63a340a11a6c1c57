// Encoding a file with the help of other processes that can read it. Layer: model.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/shared_tasks.h"
#include "rholm/context.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/model.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/shared_parts.h"

namespace rholm {

// How tasks about a mesh are shared, which the others open by those bytes; or no function.
using ShareOfMesh = std::function<ShareTasks(const std::string& mesh)>;

// As encode_file() of model.h, with the mesh pass and the norms shared where it goes over the mesh
// as it is in the file. A task of another process may throw as the pass itself.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read,
                    const ShareOfMesh& share);

// In one of these processes: the mesh, mapped or read as the first one has it.
class SharedMesh {
 public:
  // Throws what reading it throws, and InvalidInput if it is another than the first process has.
  SharedMesh(std::string_view mesh, const Context& context);
  SharedMesh(const SharedMesh&) = delete;
  SharedMesh& operator=(const SharedMesh&) = delete;

  // Of a job of expand_in_place(): good until the next. Throws Io for bytes that are none.
  DoSharedTask tasks_of(std::string_view job);

 private:
  std::optional<MappedMesh> mapped_;
  Mesh mesh_;
  MeshView view_;
  MeshPassOptions hooks_;
  std::optional<PassHelper> helper_;
};

// What the mesh pass calls for blocks of a mesh in a file, which must outlive it.
MeshPassOptions hooks_of(const MappedMesh& mesh);

}  // namespace rholm
