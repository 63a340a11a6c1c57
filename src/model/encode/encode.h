// Encoding a file with the help of other processes that can read it. Layer: model.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "parts/executor.h"
#include "rholm/context.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/model.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/shared_parts.h"

namespace rholm {

// Makes an executor whose other processes open a mesh by those bytes; or no function.
using ExecutorOfMesh = std::function<std::unique_ptr<Executor>(const std::string& mesh)>;

// As encode_file() of model.h, with the mesh pass and the norms shared where it goes over the mesh
// as it is in the file. What another process works may throw as the pass itself.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read,
                    const ExecutorOfMesh& executor_of);

// In one of these processes: the mesh, mapped or read as the first one has it.
class SharedMesh {
 public:
  // Throws what reading it throws, and InvalidInput if it is another than the first process has.
  SharedMesh(std::string_view mesh, const Context& context);
  SharedMesh(const SharedMesh&) = delete;
  SharedMesh& operator=(const SharedMesh&) = delete;

  // What expand_in_place() has other processes do: good until the next. Throws Io for what is none.
  Executor::Work work_of(std::string_view job, std::string_view input);

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
