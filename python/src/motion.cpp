// Rotations, mirror images, alignment, and changes of the centre.
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/align.h"
#include "rholm/error.h"
#include "rholm/recenter.h"
#include "rholm/rotate.h"

namespace rholm::python {
namespace {

Axis parse_axis(const std::string& name) {
  if (name == "x") return Axis::kX;
  if (name == "y") return Axis::kY;
  if (name == "z") return Axis::kZ;
  throw Error(ErrorCode::kInvalidInput, "no axis is called '" + name + "'; there are x, y and z");
}

// Converts an argument to a number, with the error messages of rholm._arguments.
double number_of(const char* name, nb::handle value) {
  return nb::cast<double>(nb::module_::import_("rholm._arguments")
                              .attr("number")(value, std::string("Rotation(): ") + name));
}

void bind_rotations(nb::module_& m) {
  Record<Rotation> rotation(m, "Rotation", "A unit quaternion; the same rotation as its negative.");
  rotation.type().def(
      "__init__",
      [](Rotation* self, nb::handle w, nb::handle x, nb::handle y, nb::handle z) {
        new (self)
            Rotation{number_of("w", w), number_of("x", x), number_of("y", y), number_of("z", z)};
      },
      nb::arg("w") = 1.0, nb::arg("x") = 0.0, nb::arg("y") = 0.0, nb::arg("z") = 0.0,
      nb::sig("def __init__(self, w: float = 1.0, x: float = 0.0, y: float = 0.0, "
              "z: float = 0.0) -> None"));
  rotation.field("w", &Rotation::w, "cos(a/2), a the angle.")
      .field("x", &Rotation::x, "sin(a/2) times the axis.")
      .field("y", &Rotation::y, "sin(a/2) times the axis.")
      .field("z", &Rotation::z, "sin(a/2) times the axis.");
  m.def("rotation_about", &rotation_about);
  m.def("rotation_of_euler", [](double alpha, double beta, double gamma) {
    return rotation_of(EulerAngles{alpha, beta, gamma});
  });
  m.def("rotation_of_matrix", [](const Rows& rows) {
    if (rows.shape(0) != 3) {
      throw Error(ErrorCode::kInvalidInput, "a rotation's matrix is an array (3, 3)");
    }
    const std::span<const Vec3> r = span_of(rows);
    return rotation_of(RotationMatrix{r[0], r[1], r[2]});
  });
  m.def("axis_angle_of", [](const Rotation& r) {
    const AxisAngle turn = axis_angle_of(r);
    return nb::make_tuple(turn.axis, turn.angle);
  });
  m.def("euler_angles_of", [](const Rotation& r) {
    const EulerAngles angles = euler_angles_of(r);
    return nb::make_tuple(angles.alpha, angles.beta, angles.gamma);
  });
  m.def("matrix_of", [](const Rotation& r) {
    const RotationMatrix rows = matrix_of(r);
    return array_of(std::vector<Vec3>(rows.begin(), rows.end()));
  });
  m.def("compose", &compose);
  m.def("inverse", &inverse);
  m.def("angle_between", &angle_between);
  m.def("rotate", [](const Rows& points, const Rotation& r) {
    std::vector<Vec3> moved = vector_of(points);
    for (Vec3& x : moved) x = rotate(x, r);
    return array_of(std::move(moved));
  });
  m.def("rotate", [](const Coefficients& c, const Rotation& r, const Caller& caller) {
    return caller.run([&](const Context& context) { return rotate(c, r, context); });
  });
  m.def("rotate",
        [](const Expansion& e, const Rotation& r, const Vec3& about, const Caller& caller) {
          return caller.run([&](const Context& context) { return rotate(e, r, about, context); });
        });
  m.def("mirror",
        [](const Coefficients& c, const std::string& axis) { return mirror(c, parse_axis(axis)); });
  m.def("mirror", [](const Expansion& e, const std::string& axis, const Vec3& about) {
    return mirror(e, parse_axis(axis), about);
  });
}

void bind_alignment(nb::module_& m) {
  Record<PrincipalAxes>(m, "PrincipalAxes", "The axes of the quadratic form of degree 2.")
      .property(
          "axes",
          [](const PrincipalAxes& p) {
            return read_only(std::vector<Vec3>(p.axes.begin(), p.axes.end()));
          },
          "Rows: right-handed, orthonormal, longest first, (3, 3).")
      .property(
          "values",
          [](const PrincipalAxes& p) {
            return read_only(std::vector<double>(p.values.begin(), p.values.end()));
          },
          "Of the form, descending, (3,); their sum is 0.")
      .field("to_axes", &PrincipalAxes::to_axes, "Turns the axes to x, y and z.")
      .field("free_axes", &PrincipalAxes::free_axes,
             "About these the form turns freely: none, one or three, (n, 3).")
      .hidden("axes", [](PrincipalAxes& p) -> std::array<Vec3, 3>& { return p.axes; })
      .hidden("values", [](PrincipalAxes& p) -> std::array<double, 3>& { return p.values; });
  m.def("principal_axes", [](const Coefficients& c, const std::string& function) {
    return principal_axes(c, parse_name<RadialFunction>(function));
  });

  Options<AlignOptions>(m, "AlignOptions", "How a rotation is sought.").fields();
  Record<AlignedRotation>(m, "AlignedRotation", "A rotation of a, and how well it lays a on b.")
      .fields();
  Record<Alignment>(m, "Alignment", "The best rotation, and those that are nearly as good.")
      .fields();
  Record<Placement>(m, "Placement",
                    "The point p becomes R (p - from_point) + to_point, of the mirror image if "
                    "mirrored.")
      .field("alignment", &Placement::alignment, "R and whether it is mirrored.")
      .field("from_point", &Placement::from, "The point of a that is laid on b's, (3,).")
      .field("to_point", &Placement::to, "The point of b, (3,).")
      .field("centers", &Placement::centers,
             "Which points these are: \"volume\", the centroids, or \"own\", the centres of the "
             "expansions.")
      .field("why_own", &Placement::why_own,
             "Why the centroids could not be taken; empty if they were, or not asked for.");
  m.def("align", [](const Coefficients& a, const Coefficients& b, const AlignOptions& options,
                    const Caller& caller) {
    return caller.run([&](const Context& context) { return align(a, b, options, context); });
  });
  m.def("align", [](const Expansion& a, const Expansion& b, const std::string& centers,
                    const AlignOptions& options, const Caller& caller) {
    const AlignCenters which = parse_name<AlignCenters>(centers);
    return caller.run([&](const Context& context) { return align(a, b, which, options, context); });
  });
  m.def("placed", [](const Expansion& a, const Placement& placement, const Caller& caller) {
    return caller.run([&](const Context& context) { return placed(a, placement, context); });
  });
  m.def("distance", &distance);
  m.def("descriptor_distance", &descriptor_distance);
}

void bind_centers(nb::module_& m) {
  m.def("volume_centroid", [](const Expansion& e, const Caller& caller) {
    return caller.run([&](const Context& context) { return volume_centroid(e, context); });
  });
  m.def("seen_center", [](const Expansion& e, const Vec3& wanted, const Caller& caller) {
    return caller.run([&](const Context& context) { return seen_center(e, wanted, context); });
  });
  m.def("recentered", [](const Expansion& e, const Vec3& center, const Caller& caller) {
    return caller.run([&](const Context& context) { return recentered(e, center, context); });
  });
}

}  // namespace

void bind_motion(nb::module_& m) {
  bind_rotations(m);
  bind_alignment(m);
  bind_centers(m);
}

}  // namespace rholm::python
