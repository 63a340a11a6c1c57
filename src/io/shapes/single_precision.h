// What coordinates lose where a format keeps them in single precision. Layer: io.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "rholm/vec3.h"

namespace rholm {

// Takes the faces that are written, with their corners in double precision.
class SinglePrecisionLoss {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c);

  // Between neighbouring numbers at the largest coordinate.
  double step() const;
  // Faces that lose their area or turn by more than 10 degrees.
  std::size_t faces_lost() const { return lost_; }
  // What to say of a file in that format: none where faces stay and steps are below 1e-5 of the
  // diagonal. `instead` names what would hold the digits.
  std::optional<std::string> warning(const std::string& format, const std::string& instead) const;

 private:
  Vec3 min_ = {}, max_ = {};
  std::size_t faces_ = 0, lost_ = 0;
};

}  // namespace rholm
