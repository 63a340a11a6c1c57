// The objects of the paper's experiments: real meshes where a file is given, else bodies made here.
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
  std::string source;  // what the mesh is: a file's name, or how it was made
  bool real = false;
  StarChart chart;
};

// Where meshes of the world may lie; empty: nowhere.
struct Data {
  std::filesystem::path folder;
};

// A mesh whose file's name contains `key` (small letters), the first by name; else the stand-in. A
// file with less than half of `faces` triangles has them cut in four until it has not: the same
// surface, with about as many faces as the paper's. 0 faces leave it as it is.
Subject subject(const std::string& name, const std::string& key, const Data& data,
                std::size_t faces, const Mesh& stand_in, const std::string& made,
                const Context& context);
// About a given centre.
Subject subject_of(const std::string& name, const std::string& made, const Mesh& mesh,
                   const Vec3& center, const Context& context);

// Directions of about `faces` triangles of nearly equal size, closed: the cube's squares brought to
// the sphere.
Mesh sphere_of_faces(std::size_t faces);

// r = 1 + random coefficients with an energy per degree that falls with l^-3.5, l = 2 ... degree,
// root mean square 0.12: a statue's roughness. Star-shaped about the origin.
Mesh rough_body(std::size_t faces, int degree, std::uint64_t seed, const Context& context);
// A lathe-turned vase with flutes, and a roughness of 0.004: star-shaped about the origin.
Mesh vase(std::size_t faces, const Context& context);
// Vertices on the axes at random distances, 8 faces.
Mesh octahedron();
// Elongated, with hills, and 6 % of noise from vertex to vertex: every edge is a crease.
Mesh rough_asteroid(int subdivisions);

}  // namespace rholm::paper
