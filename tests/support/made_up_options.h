// A made-up struct of options with a field of each kind, to test what its list of fields gives.
#pragma once

#include <array>
#include <optional>

#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm::test {

enum class Colour { kRed, kGreen };
inline EnumNames names_of(Colour) {
  static constexpr std::array kNames = {"red", "green"};
  return {"colour", kNames};
}

struct Inner {
  double depth = 1;
};
template <typename Visitor>
void visit_fields(FieldsOf<Inner>, const Visitor& field) {
  field(&Inner::depth, {.name = "depth", .help = "how deep", .least = 0, .may_be_infinite = true});
}

struct Outer {
  double size = 2;
  std::optional<double> share = {};
  int count = 3;
  bool flag = false;
  Colour colour = Colour::kGreen;
  std::optional<Vec3> place = {};
  std::optional<Inner> inner = {};
  int threads = 0;
};
template <typename Visitor>
void visit_fields(FieldsOf<Outer>, const Visitor& field) {
  using O = Outer;
  field(&O::size, {.name = "size",
                   .help = "how large",
                   .value = "S",
                   .least = 0,
                   .above = true,
                   .unit = FieldUnit::kLength});
  field(&O::share,
        {.name = "share_of_all", .help = "how much", .value = "P", .least = 0, .most = 1});
  field(&O::count, {.name = "count", .help = "how many", .value = "N", .least = 1, .most = 9});
  field(&O::flag, {.name = "flag", .help = "whether"});
  field(&O::colour, {.name = "colour", .help = "which"});
  field(&O::place, {.name = "place", .help = "where", .value = "X,Y,Z"});
  field(&O::inner, {.name = "inner", .help = "what else", .in_program = false});
  field(&O::threads, {.name = "threads",
                      .help = "on how many",
                      .value = "N",
                      .changes_result = false,
                      .in_program = false});
}

}  // namespace rholm::test
