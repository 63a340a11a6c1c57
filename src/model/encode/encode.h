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

// Returns an executor whose other processes open the mesh described by `mesh`; may be empty.
using ExecutorOfMesh = std::function<std::unique_ptr<Executor>(const std::string& mesh)>;

// Works as encode_file() of model.h. Processes share the mesh pass and the norms if these use the
// mesh as it is in the file. Work of another process throws the same errors as the pass itself.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read,
                    const ExecutorOfMesh& executor_of);

// The mesh in one of the other processes, mapped or read as in the first process.
class SharedMesh {
 public:
  // Throws the reader's errors, and InvalidInput if the mesh differs from the first process's.
  SharedMesh(std::string_view mesh, const Context& context);
  SharedMesh(const SharedMesh&) = delete;
  SharedMesh& operator=(const SharedMesh&) = delete;

  // Returns work for expand_in_place(), valid until the next call. Throws Io for invalid bytes.
  Executor::Work work_of(std::string_view job, std::string_view input);

 private:
  std::optional<MappedMesh> mapped_;
  Mesh mesh_;
  MeshView view_;
  MeshPassOptions hooks_;
  std::optional<PassHelper> helper_;
};

// Returns functions for the mesh pass over blocks of a mapped mesh, which must outlive them.
MeshPassOptions hooks_of(const MappedMesh& mesh);

}  // namespace rholm
