#include "reconstruct/points/mesh_points.h"

#include <utility>

#include "rholm/topology.h"

namespace rholm {

PointCloud points_of_mesh(Mesh mesh) {
  PointCloud cloud;
  cloud.normals = area_normals(mesh.vertices, mesh.faces);
  std::erase_if(mesh.attributes, [](const Attribute& a) {
    return a.name == "nx" || a.name == "ny" || a.name == "nz";
  });
  cloud.points = std::move(mesh.vertices);
  cloud.attributes = std::move(mesh.attributes);
  return cloud;
}

}  // namespace rholm
