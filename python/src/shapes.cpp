// Meshes and points, in memory and in files.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <tuple>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "formats.h"
#include "record.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/shape_io.h"

namespace rholm::python {
namespace {

// Returns NumPy's name of a type.
const char* dtype_of(ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
      return "int8";
    case ScalarType::kUint8:
      return "uint8";
    case ScalarType::kInt16:
      return "int16";
    case ScalarType::kUint16:
      return "uint16";
    case ScalarType::kInt32:
      return "int32";
    case ScalarType::kUint32:
      return "uint32";
    case ScalarType::kFloat32:
      return "float32";
    case ScalarType::kFloat64:
      break;
  }
  return "float64";
}

ScalarType scalar_type(const std::string& dtype) {
  for (int t = 0; t <= static_cast<int>(ScalarType::kFloat64); ++t) {
    const auto type = static_cast<ScalarType>(t);
    if (dtype == dtype_of(type)) return type;
  }
  throw nb::type_error(("no attribute can be of the type " + dtype).c_str());
}

using AttributeTuple = std::tuple<std::string, std::string, Doubles>;  // name, dtype, values

std::vector<Attribute> attributes_of(const std::vector<AttributeTuple>& tuples) {
  std::vector<Attribute> attributes;
  attributes.reserve(tuples.size());
  for (const auto& [name, dtype, values] : tuples) {
    attributes.push_back({name, scalar_type(dtype), vector_of(values)});
  }
  return attributes;
}

// Returns (name, dtype, values) of each attribute, with copied values.
nb::list tuples_of(const std::vector<Attribute>& attributes) {
  nb::list tuples;
  for (const Attribute& a : attributes) {
    tuples.append(nb::make_tuple(a.name, dtype_of(a.type), array_of(a.values)));
  }
  return tuples;
}

std::vector<Triangle> triangles_of(const Indices& triangles) {
  const auto* first = reinterpret_cast<const Triangle*>(triangles.data());
  return {first, first + triangles.shape(0)};
}

NumpyIndices indices_of(const std::vector<Triangle>& triangles) {
  const std::size_t n = triangles.size();
  return array_of<std::uint32_t>(std::vector(triangles), {n, 3});
}

bool same(const std::vector<Attribute>& a, const std::vector<Attribute>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const Attribute& x, const Attribute& y) {
        return x.name == y.name && x.type == y.type &&
               std::ranges::equal(x.values, y.values,
                                  [](double u, double v) { return u == v || (u != u && v != v); });
      });
}

void bind_mesh(nb::module_& m) {
  nb::class_<Mesh> mesh_class(m, "Mesh", "A mesh of triangles that share vertices.");
  bind_state(
      mesh_class,
      [](const Mesh& mesh) {
        return nb::make_tuple(array_of(std::vector(mesh.vertices)), indices_of(mesh.faces),
                              tuples_of(mesh.attributes));
      },
      [](const nb::object& state) {
        const auto [vertices, triangles, attributes] =
            nb::cast<std::tuple<Rows, Indices, std::vector<AttributeTuple>>>(state);
        Mesh mesh{vector_of(vertices), triangles_of(triangles), attributes_of(attributes)};
        validate(mesh);
        return mesh;
      });
  mesh_class
      .def("__init__",
           [](Mesh* self, const Rows& vertices, const Indices& triangles,
              const std::vector<AttributeTuple>& attributes) {
             new (self)
                 Mesh{vector_of(vertices), triangles_of(triangles), attributes_of(attributes)};
           })
      .def_prop_ro("vertices",
                   [](nb::handle self) {
                     const auto& v = nb::cast<const Mesh&>(self).vertices;
                     return array_within<const double>(self, v.data(), {v.size(), 3});
                   })
      .def_prop_ro("faces",
                   [](nb::handle self) {
                     const auto& t = nb::cast<const Mesh&>(self).faces;
                     return array_within<const std::uint32_t>(self, t.data(), {t.size(), 3});
                   })
      .def_prop_ro("attributes", [](const Mesh& mesh) { return tuples_of(mesh.attributes); });
  mesh_class.def(
      "__eq__",
      [](const Mesh& a, const Mesh& b) {
        return a.vertices == b.vertices && a.faces == b.faces && same(a.attributes, b.attributes);
      },
      nb::is_operator(), nb::sig("def __eq__(self, arg: object, /) -> bool"));
  nb::class_<PointCloud> cloud_class(m, "PointCloud", "Points without faces.");
  bind_state(
      cloud_class,
      [](const PointCloud& cloud) {
        return nb::make_tuple(array_of(std::vector(cloud.points)),
                              array_of(std::vector(cloud.normals)), tuples_of(cloud.attributes));
      },
      [](const nb::object& state) {
        const auto [points, normals, attributes] =
            nb::cast<std::tuple<Rows, Rows, std::vector<AttributeTuple>>>(state);
        return PointCloud{vector_of(points), vector_of(normals), attributes_of(attributes)};
      });
  cloud_class
      .def(
          "__eq__",
          [](const PointCloud& a, const PointCloud& b) {
            return a.points == b.points && a.normals == b.normals &&
                   same(a.attributes, b.attributes);
          },
          nb::is_operator(), nb::sig("def __eq__(self, arg: object, /) -> bool"))
      .def(
          "__init__",
          [](PointCloud* self, const Rows& points, const std::optional<Rows>& normals,
             const std::vector<AttributeTuple>& attributes) {
            new (self)
                PointCloud{vector_of(points), normals ? vector_of(*normals) : std::vector<Vec3>(),
                           attributes_of(attributes)};
          },
          nb::arg(), nb::arg().none(), nb::arg())
      .def_prop_ro("points",
                   [](nb::handle self) {
                     const auto& p = nb::cast<const PointCloud&>(self).points;
                     return array_within<const double>(self, p.data(), {p.size(), 3});
                   })
      .def_prop_ro("normals",
                   [](nb::handle self) -> std::optional<ReadOnlyDoubles> {
                     const auto& n = nb::cast<const PointCloud&>(self).normals;
                     if (n.empty()) return std::nullopt;
                     return array_within<const double>(self, n.data(), {n.size(), 3});
                   })
      .def_prop_ro("attributes",
                   [](const PointCloud& cloud) { return tuples_of(cloud.attributes); });
  m.def("validate", [](const Mesh& mesh) { unlocked([&] { validate(mesh); }); });
  m.def("validate", [](const PointCloud& cloud) { unlocked([&] { validate(cloud); }); });
}

// Returns the meaning of each column.
std::vector<std::string> columns_of(const TableColumns& table) {
  std::vector<std::string> columns;
  columns.reserve(table.columns.size());
  for (const TableColumn& column : table.columns) columns.push_back(column.taken_for);
  return columns;
}

void bind_files(nb::module_& m) {
  m.def("shape_formats", [] {
    nb::list formats;
    for (const ShapeFormatInfo& format : shape_formats()) {
      formats.append(format_row(format.file, held_by(format)));
    }
    return formats;
  });
  m.def("is_shape_file", [](const nb::bytes& beginning, const std::string& name) {
    return is_shape_file({beginning.c_str(), beginning.size()}, name);
  });
  const auto shape_file = [](ShapeFile&& file) {
    return nb::make_tuple(std::move(file.shape), to_string(file.format), file.encoding,
                          file.warnings, columns_of(file.table), file.table.note, file.table.unsure,
                          file.dropped);
  };
  m.def("read_shape", [=](const std::string& path, bool attributes, const std::string& columns,
                          const Caller& caller) {
    return shape_file(caller.run([&](const Context& context) {
      return read_shape(path, {.attributes = attributes, .columns = columns}, context);
    }));
  });
  m.def("parse_shape", [=](const nb::bytes& bytes, const std::string& name, bool attributes,
                           const std::string& columns, const Caller& caller) {
    const std::span<const char> all(bytes.c_str(), bytes.size());
    return shape_file(caller.run([&](const Context& context) {
      return parse_shape(all, name, {.attributes = attributes, .columns = columns}, context);
    }));
  });
  m.def("points_of_rows", [](const Doubles& values, std::size_t width, const std::string& columns) {
    TableColumns table;
    const std::vector<double> own = vector_of(values);
    PointCloud cloud = unlocked([&] { return points_of_rows(own, width, columns, &table); });
    return nb::make_tuple(std::move(cloud), columns_of(table), table.note, table.unsure);
  });
  const auto options = [](const std::optional<std::string>& format, bool ascii) {
    ShapeWriteOptions wanted{.ascii = ascii};
    if (format) wanted.format = parse_shape_format(*format);
    return wanted;
  };
  m.def(
      "write_shape",
      [=](const std::variant<const Mesh*, const PointCloud*>& shape, const std::string& path,
          const std::optional<std::string>& format, bool ascii, const Caller& caller) {
        return caller.run([&](const Context& context) {
          return std::visit(
              [&](const auto* s) { return write_shape(*s, path, options(format, ascii), context); },
              shape);
        });
      },
      nb::arg(), nb::arg(), nb::arg().none(), nb::arg(), nb::arg());
  m.def("attributes_left_out",
        [](const std::vector<std::string>& names, const std::string& format) {
          std::vector<Attribute> attributes;
          attributes.reserve(names.size());
          for (const std::string& name : names) attributes.push_back({.name = name});
          return attributes_left_out(attributes, parse_shape_format(format));
        });
}

// Returns the bytes from the first number of n rows to the last, for rows of any alignment in
// files.
nb::ndarray<nb::numpy, const std::uint8_t> bytes_of(nb::handle owner, const std::byte* data,
                                                    std::size_t n, std::size_t stride,
                                                    std::size_t row) {
  return {data, {n == 0 ? 0 : (n - 1) * stride + row}, owner};
}

void bind_mapped(nb::module_& m) {
  nb::class_<MappedMesh>(m, "MappedMesh", "A mesh in a mapped file.")
      .def_prop_ro("vertex_bytes",
                   [](nb::handle self) {
                     const MeshView& v = nb::cast<const MappedMesh&>(self).view();
                     const std::size_t size = v.coordinate == ScalarType::kFloat32 ? 4 : 8;
                     return bytes_of(self, v.vertices, v.n_vertices, v.vertex_stride, 3 * size);
                   })
      .def_prop_ro("vertex_layout",
                   [](const MappedMesh& mesh) {
                     const MeshView& v = mesh.view();
                     return nb::make_tuple(v.n_vertices, v.vertex_stride, dtype_of(v.coordinate));
                   })
      .def_prop_ro("triangle_bytes",
                   [](nb::handle self) {
                     const MeshView& v = nb::cast<const MappedMesh&>(self).view();
                     return bytes_of(self, v.faces, v.n_faces, v.face_stride, sizeof(Triangle));
                   })
      .def_prop_ro("triangle_layout", [](const MappedMesh& mesh) {
        const MeshView& v = mesh.view();
        return nb::make_tuple(v.n_faces, v.face_stride, "uint32");
      });
  m.def("map_mesh", [](const std::string& path, const Caller& caller) {
    return caller.run([&](const Context& context) { return map_mesh(path, context); });
  });
}

}  // namespace

void bind_shapes(nb::module_& m) {
  bind_mesh(m);
  bind_files(m);
  bind_mapped(m);
}

}  // namespace rholm::python
