// Objects of the paper's experiments: meshes from files where given, otherwise bodies made here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/star.h"

namespace rholm::paper {

struct Subject {
  std::string name;
  std::string source;  // name of the file, or how the mesh was made
  bool real = false;
  StarChart chart;
};

// Folder of real meshes; empty if there is none.
struct Data {
  std::filesystem::path folder;
};

// Returns the first mesh, by name, whose file's name contains `key` (lower case), or the stand-in.
// If it has less than half of `faces` triangles, they are split into four, repeatedly, until it has
// at least half. The surface stays the same. With 0 faces nothing is split.
Subject subject(const std::string& name, const std::string& key, const Data& data,
                std::size_t faces, const Mesh& stand_in, const std::string& made,
                const Context& context);
// Returns a subject about a given centre.
Subject subject_of(const std::string& name, const std::string& made, const Mesh& mesh,
                   const Vec3& center, const Context& context);

// Returns a closed mesh of about `faces` triangles of nearly equal size on the sphere: the squares
// of a cube, projected.
Mesh sphere_of_faces(std::size_t faces);

// r = 1 + random coefficients, l = 2 ... degree, with an energy per degree that falls with l^-3.5
// and the root mean square 0.12: as rough as a statue. The body is star-shaped about the origin.
Mesh rough_body(std::size_t faces, int degree, std::uint64_t seed, const Context& context);
// Returns a turned vase with flutes and a roughness of 0.004, star-shaped about the origin.
Mesh vase(std::size_t faces, const Context& context);
// Returns 8 faces with vertices on the axes at random distances.
Mesh octahedron();
// Returns an elongated body with hills and 6 % of noise at vertices: every edge is a crease.
Mesh rough_asteroid(int subdivisions);

}  // namespace rholm::paper
