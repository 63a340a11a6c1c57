// Tables of points as programs write them, with the expected meaning of every column. The points
// lie on an ellipsoid given by a formula, and every variant must return them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "io/shapes/test_support.h"
#include "rholm/point_stream.h"

namespace rholm {
namespace {

using testing::expect_refused;
using testing::parse;

constexpr int kRows = 40;

// Coordinates, normal, colour and two scalars of a point, from its index.
struct Point {
  Vec3 p, n;
  int r = 0, g = 0, b = 0;
  double f = 0;
};

double to_digits(double value) { return std::round(value * 1e4) / 1e4; }

Point point(int i) {
  // Directions lie on a spiral: no two rows have a coordinate in common.
  const double z = 1 - (2 * i + 1.0) / kRows, phi = 2.4 * i, s = std::sqrt(1 - z * z);
  const Vec3 u = {s * std::cos(phi), s * std::sin(phi), z}, axes = {1.2, 0.9, 0.7};
  const Vec3 n = normalized(Vec3{u.x / axes.x, u.y / axes.y, u.z / axes.z});
  return {.p = {to_digits(axes.x * u.x), to_digits(axes.y * u.y), to_digits(axes.z * u.z)},
          .n = {to_digits(n.x), to_digits(n.y), to_digits(n.z)},
          .r = (37 * i) % 256,
          .g = (11 * i + 5) % 256,
          .b = (91 * i + 200) % 256,
          .f = to_digits(10 + 3 * u.x)};
}

// Makes a row from a pattern. Letters stand for values; all other characters are copied: x y z, u v
// w (normal), r g b (0 ... 255), R G B (0 ... 1), f (scalar), i (row from 0), j (row from 1), A O D
// (latitude, longitude, radius), U V W (normal of length 0.9 ... 1).
std::string row_of(const std::string& pattern, int i, bool comma) {
  const Point a = point(i);
  const double radius = norm(a.p), degree = 180 / std::numbers::pi;
  const double shorter = 1 - 0.1 * (i % 10) / 10;
  std::string row;
  for (const char c : pattern) {
    std::string value;
    switch (c) {
      case 'x':
        value = fmt::format("{:.4f}", a.p.x);
        break;
      case 'y':
        value = fmt::format("{:.4f}", a.p.y);
        break;
      case 'z':
        value = fmt::format("{:.4f}", a.p.z);
        break;
      case 'u':
        value = fmt::format("{:.4f}", a.n.x);
        break;
      case 'v':
        value = fmt::format("{:.4f}", a.n.y);
        break;
      case 'w':
        value = fmt::format("{:.4f}", a.n.z);
        break;
      case 'U':
        value = fmt::format("{:.4f}", shorter * a.n.x);
        break;
      case 'V':
        value = fmt::format("{:.4f}", shorter * a.n.y);
        break;
      case 'W':
        value = fmt::format("{:.4f}", shorter * a.n.z);
        break;
      case 'r':
        value = fmt::format("{}", a.r);
        break;
      case 'g':
        value = fmt::format("{}", a.g);
        break;
      case 'b':
        value = fmt::format("{}", a.b);
        break;
      case 'R':
        value = fmt::format("{:.3f}", a.r / 255.0);
        break;
      case 'G':
        value = fmt::format("{:.3f}", a.g / 255.0);
        break;
      case 'B':
        value = fmt::format("{:.3f}", a.b / 255.0);
        break;
      case 'f':
        value = fmt::format("{:.4f}", a.f);
        break;
      case 'i':
        value = fmt::format("{}", i);
        break;
      case 'j':
        value = fmt::format("{}", i + 1);
        break;
      case 'A':
        value = fmt::format("{:.9f}", std::asin(a.p.z / radius) * degree);
        break;
      case 'O':
        value = fmt::format("{:.9f}", std::atan2(a.p.y, a.p.x) * degree);
        break;
      case 'D':
        value = fmt::format("{:.9f}", radius);
        break;
      default:
        value = std::string(1, c);
    }
    if (comma) std::replace(value.begin(), value.end(), '.', ',');
    row += value;
  }
  return row;
}

std::string table(const std::string& header, const std::string& pattern, bool comma = false,
                  const std::string& line_end = "\n") {
  std::string text = header;
  for (int i = 0; i < kRows; ++i) text += row_of(pattern, i, comma) + line_end;
  return text;
}

struct Variant {
  const char* name;
  std::string text;
  std::string taken;  // expected meaning of the columns, with commas
  const char* file = "table.txt";
  std::vector<const char*> said = {};  // expected words of the note
  bool unsure = false;
};

std::vector<Variant> variants() {
  const std::string rgb_normals = "x,y,z,r,g,b,nx,ny,nz";
  return {
      // Separators.
      {"blanks", table("", "x y z"), "x,y,z"},
      {"runs of blanks", table("", "  x   y    z  "), "x,y,z"},
      {"tabs", table("", "x\ty\tz"), "x,y,z"},
      {"commas", table("", "x,y,z"), "x,y,z"},
      {"commas and blanks", table("", "x, y, z"), "x,y,z"},
      {"semicolons", table("", "x;y;z"), "x,y,z"},
      {"semicolons and blanks", table("", "x; y; z"), "x,y,z"},
      {"a separator at the end of each row", table("", "x,y,z,"), "x,y,z"},
      {"ends of lines of Windows", table("X;Y;Z\r\n", "x;y;z", false, "\r\n"), "x,y,z"},
      // Decimal marks.
      {"decimal comma, semicolons", table("", "x;y;z", true), "x,y,z", "t.txt", {"decimal commas"}},
      {"decimal comma, blanks", table("", "x y z", true), "x,y,z", "t.txt", {"decimal commas"}},
      {"decimal comma, tabs", table("", "x\ty\tz", true), "x,y,z", "t.txt", {"decimal commas"}},
      {"decimal comma, comma and blank",
       [] {
         std::string text;
         for (int i = 0; i < kRows; ++i) {
           text += row_of("x", i, true) + ", " + row_of("y", i, true) + ", " +
                   row_of("z", i, true) + "\n";
         }
         return text;
       }(),
       "x,y,z",
       "t.txt",
       {"decimal commas"}},
      {"decimal comma, quotes",
       [] {
         std::string text = "\"x\",\"y\",\"z\"\n";
         for (int i = 0; i < kRows; ++i) {
           text += "\"" + row_of("x", i, true) + "\",\"" + row_of("y", i, true) + "\",\"" +
                   row_of("z", i, true) + "\"\n";
         }
         return text;
       }(),
       "x,y,z",
       "t.csv",
       {"decimal commas"}},
      {"decimal comma with header and colours", table("X;Y;Z;R;G;B\n", "x;y;z;r;g;b", true),
       "x,y,z,r,g,b", "t.csv"},
      {"decimal comma in later rows only", "1;2;3\n" + table("", "x;y;z", true), "x,y,z"},
      // Headers.
      {"names", table("x y z nx ny nz\n", "x y z u v w"), "x,y,z,nx,ny,nz"},
      {"names in a comment", table("# x y z nx ny nz\n", "x y z u v w"), "x,y,z,nx,ny,nz"},
      {"names in a comment with other separators", table("# x, y, z, f\n", "x y z f"), "x,y,z,f"},
      {"names with a title above", table("Scan of 3 May\nx y z\n", "x y z"), "x,y,z"},
      {"a title alone",
       table("exported by a program\n", "x y z"),
       "x,y,z",
       "t.txt",
       {"passed over"}},
      {"names and a row of units", table("x,y,z\nm,m,m\n", "x,y,z"), "x,y,z", "t.csv"},
      {"a title in a comment", table("# ellipsoid, 40 points\n", "x y z"), "x,y,z"},
      {"names in quotes", table("\"x\",\"y\",\"z\",\"my scalar\"\n", "x,y,z,f"), "x,y,z,my scalar",
       "t.csv"},
      {"names with blanks", table("X,Y,Z,Scalar field,Nx,Ny,Nz\n", "x,y,z,f,u,v,w"),
       "x,y,z,Scalar field,nx,ny,nz"},
      {"units in brackets", table("X [mm];Y [mm];Z [mm]\n", "x;y;z"), "x,y,z"},
      {"units in brackets between blanks", table("X [mm] Y [mm] Z [mm]\n", "x y z"), "x,y,z"},
      {"units in parentheses", table("x(m),y(m),z(m),quality\n", "x,y,z,f"), "x,y,z,quality"},
      {"units behind underscores", table("x_mm,y_mm,z_mm\n", "x,y,z"), "x,y,z"},
      {"units behind slashes", table("x/km y/km z/km\n", "x y z"), "x,y,z"},
      {"words before", table("pos_x,pos_y,pos_z,normal_x,normal_y,normal_z\n", "x,y,z,u,v,w"),
       "x,y,z,nx,ny,nz"},
      {"words behind", table("x_coord y_coord z_coord\n", "x y z"), "x,y,z"},
      {"capital letters", table("NX,NY,NZ,X,Y,Z\n", "u,v,w,x,y,z"), "nx,ny,nz,x,y,z"},
      {"ParaView",
       table("\"Points:0\",\"Points:1\",\"Points:2\",\"Normals:0\",\"Normals:1\",\"Normals:2\"\n",
             "x,y,z,u,v,w"),
       "x,y,z,nx,ny,nz", "t.csv"},
      {"CloudCompare", table("//X,Y,Z,R,G,B,Scalar field,Nx,Ny,Nz\n", "x,y,z,r,g,b,f,u,v,w"),
       "x,y,z,r,g,b,Scalar field,nx,ny,nz"},
      {"CloudCompare with blanks between values",
       table("//X Y Z Rf Gf Bf Intensity\n40\n", "x y z R G B f"), "x,y,z,r,g,b,Intensity"},
      {"other order", table("z,y,x\n", "z,y,x"), "z,y,x"},
      {"position last", table("id,red,green,blue,x,y,z\n", "j,r,g,b,x,y,z"), "id,r,g,b,x,y,z"},
      {"a map's names", table("Easting,Northing,Elevation\n", "x,y,z"), "x,y,z"},
      {"colours by their channel", table("x y z color_r color_g color_b\n", "x y z r g b"),
       "x,y,z,r,g,b"},
      // Numbers of rows.
      {"numbers from 1", table("", "j x y z"), "-,x,y,z", "t.txt", {"numbers the rows"}},
      {"numbers from 0, commas", table("", "i,x,y,z"), "-,x,y,z"},
      {"a count and numbers", table("40\n", "j x y z"), "-,x,y,z"},
      {"numbers with gaps",
       [] {
         std::string text;
         for (int i = 0; i < kRows; ++i) {
           text += std::to_string(7 * i + 100) + " " + row_of("x y z u v w", i, false) + "\n";
         }
         return text;
       }(),
       "-,x,y,z,nx,ny,nz"},
      {"pandas", table(",x,y,z\n", "i,x,y,z"), "-,x,y,z", "t.csv", {"no name"}},
      {"pandas, read and written again", table("Unnamed: 0,x,y,z\n", "i,x,y,z"), "-,x,y,z",
       "t.csv"},
      {"pandas without names", table(",0,1,2\n", "i,x,y,z"), "-,x,y,z", "t.csv"},
      {"pandas without names and numbers",
       table("0,1,2\n", "x,y,z"),
       "x,y,z",
       "t.csv",
       {"numbers the columns"}},
      {"R", table("\"x\" \"y\" \"z\"\n", "\"j\" x y z"), "-,x,y,z"},
      // Comments and texts.
      {"comments between and behind", "# by hand\n" + table("", "x y z # a point") + "% end\n",
       "x,y,z"},
      {"a column of text", table("name,x,y,z\n", "point_j,x,y,z"), "-,x,y,z", "t.csv", {"text"}},
      {"a column of text without a name", table("", "P-j x y z"), "-,x,y,z", "t.txt", {"text"}},
      // Missing values. (Another test checks that rows without a position are dropped.)
      {"empty cells", table("x,y,z,f,g\n", "x,y,z,,f"), "x,y,z,f,g", "t.csv"},
      {"dashes", table("x y z f\n", "x y z --"), "x,y,z,f"},
      // Columns without names.
      {"normals", table("", "x y z u v w"), "x,y,z,nx,ny,nz"},
      {"normals of nearly unit length",
       table("", "x y z U V W"),
       "x,y,z,nx,ny,nz",
       "t.xyz",
       {"normals of length 0.9"}},
      {"colours", table("", "x y z r g b"), "x,y,z,r,g,b"},
      {"colours 0 ... 1", table("", "x y z R G B"), "x,y,z,r,g,b", "t.xyz", {"0 ... 1"}, true},
      {"colours, then normals", table("", "x y z r g b u v w"), rgb_normals},
      {"normals, then colours", table("", "x y z u v w r g b"), "x,y,z,nx,ny,nz,r,g,b"},
      {"colours 0 ... 1, then short normals",
       table("", "x y z R G B U V W"),
       rgb_normals,
       "t.xyz",
       {},
       true},
      {"a scalar, then colours", table("40\n", "x y z f r g b"), "x,y,z,scalar_1,r,g,b", "t.pts"},
      {"colours with alpha", table("", "x y z r g b 255"), "x,y,z,r,g,b,a"},
      {"a scalar", table("", "x y z f"), "x,y,z,scalar_1"},
      // Angles.
      {"lat lon radius",
       table("lat lon radius\n", "A O D"),
       "lat,lon,radius",
       "t.txt",
       {"east longitude in degrees"}},
      {"Longitude (deg), Latitude (deg), Radius (km)",
       table("Longitude (deg),Latitude (deg),Radius (km)\n", "O,A,D"), "lon,lat,radius", "t.csv"},
      {"angles and numbers of rows", table("i lat lon r\n", "j A O D"), "i,lat,lon,radius"},
  };
}

std::string taken_for(const TableColumns& table) {
  std::string taken;
  for (const TableColumn& column : table.columns) {
    taken += (taken.empty() ? "" : ",") + column.taken_for;
  }
  return taken;
}

// Checks that every point is within `slack` of its exact position.
void expect_points(const PointCloud& cloud, std::size_t before, double slack) {
  ASSERT_EQ(cloud.points.size(), before + kRows);
  for (int i = 0; i < kRows; ++i) {
    const Vec3& p = cloud.points[before + static_cast<std::size_t>(i)];
    EXPECT_LE(norm(p - point(i).p), slack) << i;
  }
}

const std::vector<double>& values_of(const PointCloud& cloud, const char* name) {
  static const std::vector<double> none;
  const Attribute* attribute = find_attribute(cloud.attributes, name);
  EXPECT_NE(attribute, nullptr) << name;
  return attribute == nullptr ? none : attribute->values;
}

void expect_variant(const Variant& v) {
  SCOPED_TRACE(std::string(v.name) + ": " + v.text.substr(0, v.text.find('\n', 30)));
  const ShapeFile file = parse(v.text, v.file);
  EXPECT_EQ(taken_for(file.table), v.taken) << file.table.note;
  EXPECT_EQ(file.table.unsure, v.unsure) << file.table.note;
  for (const char* said : v.said) {
    EXPECT_NE(file.table.note.find(said), std::string::npos) << file.table.note;
  }
  const auto& cloud = std::get<PointCloud>(file.shape);
  const bool angles = v.taken.find("lat") != std::string::npos;
  expect_points(cloud, cloud.points.size() - kRows, angles ? 1e-8 : 0);
  if (v.taken.find("nx") != std::string::npos) {
    ASSERT_EQ(cloud.normals.size(), cloud.points.size());
    for (int i = 0; i < kRows; ++i) {
      EXPECT_GT(dot(normalized(cloud.normals[static_cast<std::size_t>(i)]), point(i).n), 0.9999)
          << i;
    }
  } else {
    EXPECT_TRUE(cloud.normals.empty());
  }
  if (v.taken.find("r,g,b") != std::string::npos) {
    const double scale =
        values_of(cloud, "red").size() > 1 && *std::max_element(values_of(cloud, "red").begin(),
                                                                values_of(cloud, "red").end()) > 1
            ? 1
            : 255;
    ASSERT_EQ(values_of(cloud, "blue").size(), cloud.points.size());
    for (std::size_t i = 0; i < kRows; ++i) {
      EXPECT_NEAR(scale * values_of(cloud, "red")[i], point(static_cast<int>(i)).r, 0.2) << i;
      EXPECT_NEAR(scale * values_of(cloud, "blue")[i], point(static_cast<int>(i)).b, 0.2) << i;
    }
  }
}

TEST(table, columns_are_taken_for_what_they_are) {
  const std::vector<Variant> all = variants();
  EXPECT_GE(all.size(), 60u);
  for (const Variant& v : all) expect_variant(v);
}

TEST(table, a_stream_takes_columns_for_the_same) {
  const testing::TemporaryFolder folder;
  for (const Variant& v : variants()) {
    if (v.text.starts_with("40\n")) continue;  // after plates, which streams refuse
    SCOPED_TRACE(v.name);
    const auto path = folder / v.file;
    testing::write_all(path, v.text);
    PointStream stream(path);
    const ShapeFile whole = read_shape(path);
    EXPECT_EQ(taken_for(stream.table()), taken_for(whole.table));
    EXPECT_EQ(stream.table().note, whole.table.note);
    PointCloud piece;
    std::vector<Vec3> points;
    while (stream.read(7, piece))
      points.insert(points.end(), piece.points.begin(), piece.points.end());
    EXPECT_EQ(points, std::get<PointCloud>(whole.shape).points);
  }
}

TEST(table, columns_may_be_said) {
  const std::string text = table("a b c d e f g\n", "f u v w y z x");
  const ShapeFile file = parse(text, "t.txt", {.columns = "weight,nx,ny,nz,y,z,x"});
  EXPECT_EQ(taken_for(file.table), "weight,nx,ny,nz,y,z,x");
  const auto& cloud = std::get<PointCloud>(file.shape);
  expect_points(cloud, 0, 0);
  EXPECT_EQ(cloud.normals.size(), cloud.points.size());
  EXPECT_EQ(values_of(cloud, "weight")[3], point(3).f);
  // The option takes precedence over the header; columns marked - may hold anything.
  const auto other = std::get<PointCloud>(
      parse(table("x,y,z,name\n", "z,y,x,some text"), "t.csv", {.columns = "z,y,x,-"}).shape);
  expect_points(other, 0, 0);
  EXPECT_TRUE(other.attributes.empty());
  const auto angles =
      std::get<PointCloud>(parse(table("", "O A D"), "t.txt", {.columns = "lon,lat,r"}).shape);
  expect_points(angles, 0, 1e-8);
}

TEST(table, columns_that_do_not_fit_are_refused) {
  const auto refused = [](const std::string& columns, std::initializer_list<const char*> words) {
    testing::expect_error([&] { parse("1 2 3\n4 5 6\n", "t.txt", {.columns = columns}); },
                          ErrorCode::kInvalidInput, words);
  };
  refused("x,y", {"x, y, z"});
  refused("x,y,z,f", {"4", "3 values"});
  refused("x,y,x", {"twice"});
  refused("x,y,lat", {"lat, lon, radius"});
  refused("x,y,z,nx,ny", {"nx, ny, nz"});
  refused("x,y,z,r,g", {"r, g, b"});
  refused("x,,z", {"no name"});
  testing::expect_error(
      [] { parse("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "t.off", {.columns = "x,y,z"}); },
      ErrorCode::kInvalidInput, {"no table"});
}

TEST(table, points_without_a_place_are_dropped_and_counted) {
  for (const std::string gap : {"nan nan nan\n", "NA 1 2\n", "inf 0 0\n", "- - -\n"}) {
    const ShapeFile file = parse(gap + table("", "x y z") + gap, "t.xyz");
    EXPECT_EQ(file.dropped, 2u) << gap;
    EXPECT_EQ(file.warnings,
              (std::vector<std::string>{
                  "2 points with a coordinate that is not a finite number dropped"}));
    expect_points(std::get<PointCloud>(file.shape), 0, 0);
  }
  const ShapeFile csv = parse(table("x,y,z,f\n", "x,y,z,f") + ",,,1\n1,,2,\n", "t.csv");
  EXPECT_EQ(csv.dropped, 2u);
  EXPECT_EQ(values_of(std::get<PointCloud>(csv.shape), "f").size(), 40u);
  expect_refused("nan nan nan\nnan 1 2\n", {"no point"}, "t.xyz");
  // Rows of separators only, as spreadsheets write them, are not points.
  EXPECT_EQ(parse(table("x;y;z\n", "x;y;z") + ";;\n;;\n", "t.csv").dropped, 0u);
}

TEST(table, colors_of_one_channel_are_no_normals) {
  // Unit vectors, none of which is perpendicular to the surface.
  std::string text;
  for (int i = 0; i < kRows; ++i) {
    const char* const channels[] = {" 1 0 0\n", " 0 1 0\n", " 0 0 1\n"};
    text += row_of("x y z", i, false) + channels[i % 3];
  }
  EXPECT_EQ(taken_for(parse(text, "t.xyz").table), "x,y,z,r,g,b");
  // The upper side of a plate has such constant normals.
  text.clear();
  for (int i = 0; i < kRows; ++i) {
    const int row = i / 8;
    text += fmt::format("{} {} 0.5 0 0 1\n", 0.37 * (i % 8), 0.29 * row);
  }
  EXPECT_EQ(taken_for(parse(text, "t.xyz").table), "x,y,z,nx,ny,nz");
}

TEST(table, angles_without_names_are_suspected) {
  for (const char* pattern : {"A O D", "O A D"}) {
    const ShapeFile file = parse(table("", pattern), "t.tab");
    EXPECT_EQ(taken_for(file.table), "x,y,z");
    EXPECT_TRUE(file.table.unsure);
    const char* const said = *pattern == 'A' ? "lat, lon, radius" : "lon, lat, radius";
    EXPECT_NE(file.table.note.find(said), std::string::npos) << file.table.note;
  }
}

TEST(table, grids_of_angles_without_names_are_refused_until_it_is_said_what_they_are) {
  struct Grid {
    double lat, lat_step, lon, lon_step;
    int n_lat, n_lon;
    bool lat_first, lon_fast;
  };
  const Grid grids[] = {{-90, 5, 0, 5, 37, 72, true, true},
                        {90, -5, 0, 5, 37, 73, true, true},
                        {-87.5, 5, -180, 10, 36, 36, false, true},
                        {-90, 15, 0, 15, 13, 24, true, false},
                        {-85, 10, -172.5, 15, 18, 24, false, false},
                        {89.5, -1, 0.5, 1, 180, 360, true, true},  // more rows than are examined
                        {-90, 180. / 7, 0, 360. / 7, 8, 7, true, true}};  // rounded steps
  const auto text_of = [](const Grid& g, const char* behind) {
    std::string text;
    for (int k = 0; k < g.n_lat * g.n_lon; ++k) {
      const int fast = k % (g.lon_fast ? g.n_lon : g.n_lat);
      const int slow = k / (g.lon_fast ? g.n_lon : g.n_lat);
      const double lat = g.lat + g.lat_step * (g.lon_fast ? slow : fast);
      const double lon = g.lon + g.lon_step * (g.lon_fast ? fast : slow);
      text += fmt::format("{:.3f} {:.3f} {:.4f}{}\n", g.lat_first ? lat : lon,
                          g.lat_first ? lon : lat, 1.5 + 0.4 * std::sin(lat * lon), behind);
    }
    return text;
  };
  for (const Grid& g : grids) {
    const std::string names = g.lat_first ? "lat,lon,radius" : "lon,lat,radius";
    for (const std::string more : {"", " 7.5"}) {
      const std::string text = text_of(g, more.c_str());
      try {
        parse(text, "grid.tab");
        ADD_FAILURE() << "a grid from " << g.lat << " by " << g.lat_step << " was read";
      } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::kInvalidInput);
        EXPECT_NE(std::string(e.what()).find("--columns " + names), std::string::npos) << e.what();
      }
      const std::string other = more.empty() ? "" : ",-";
      EXPECT_EQ(taken_for(parse(text, "grid.tab", {.columns = names + other}).table),
                names + other);
      EXPECT_EQ(taken_for(parse(text, "grid.tab", {.columns = "x,y,z" + other}).table),
                "x,y,z" + other);
    }
  }
  // Heights over a plane, half of the globe, and heights that are not radii.
  const Grid plane = {-40, 5, 0, 5, 17, 72, true, true}, half = {-90, 5, 0, 5, 37, 36, true, true};
  for (const Grid& g : {plane, half}) {
    EXPECT_EQ(taken_for(parse(text_of(g, ""), "grid.tab").table), "x,y,z");
  }
}

TEST(table, points_with_normals_are_read_as_they_are_written) {
  const testing::TemporaryFolder folder;
  // One octant of a sphere, first coordinates that count, and normals of one direction.
  PointCloud octant, counted, flat;
  for (int i = 0; i < kRows; ++i) {
    const Vec3 n = point(i).n;
    octant.points.push_back({n.z, n.x, n.y});
    octant.normals.push_back(normalized(Vec3{std::abs(n.x), std::abs(n.y), std::abs(n.z)}));
    counted.points.push_back({static_cast<double>(i), n.x, n.y});
    counted.normals.push_back(normalized(n));
    flat.points.push_back(n);
    flat.normals.push_back({0, 0, 1});
  }
  for (const PointCloud& cloud : {octant, counted, flat}) {
    write_shape(cloud, folder / "a.xyz");
    const auto read = std::get<PointCloud>(read_shape(folder / "a.xyz").shape);
    EXPECT_EQ(read.points, cloud.points);
    EXPECT_EQ(read.normals, cloud.normals);
  }
}

TEST(table, angles_have_units_and_directions) {
  const auto read = [](const std::string& text) {
    return std::get<PointCloud>(parse(text, "t.csv").shape).points[0];
  };
  EXPECT_LT(norm(read("lat,lon,radius\n0,90,2\n") - Vec3{0, 2, 0}), 1e-15);
  EXPECT_LT(norm(read("lat,West Longitude,radius\n0,90,2\n") - Vec3{0, -2, 0}), 1e-15);
  EXPECT_LT(norm(read("colatitude,lon,radius\n90,0,2\n") - Vec3{2, 0, 0}), 1e-15);
  EXPECT_LT(norm(read("lat (rad),lon (rad),radius\n1.5707963267948966,0,2\n") - Vec3{0, 0, 2}),
            1e-15);
  // A pole is one point for any longitude.
  EXPECT_EQ(read("lat,lon,radius\n90,77,2\n"), (Vec3{0, 0, 2}));
}

TEST(table, plate_models_are_meshes) {
  const std::string numbered = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n",
                    bare = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  for (const std::string& text : {"4\n" + numbered + "4\n1 1 3 2\n2 1 2 4\n3 1 4 3\n4 2 3 4\n",
                                  "# a body\n4\n" + bare + "4\n1 3 2\n1 2 4\n1 4 3\n2 3 4\n",
                                  "4 4\n" + bare + "1 3 2\n1 2 4\n1 4 3\n2 3 4\n",
                                  "4 4\n" + bare + "3\n1 3 2\n3\n1 2 4\n3\n1 4 3\n3\n2 3 4\n",
                                  "4\n" + bare + "4\n0 2 1\n0 1 3\n0 3 2\n1 2 3\n",
                                  "4 4\n" + bare + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"}) {
    SCOPED_TRACE(text);
    const ShapeFile file = parse(text, "body.tab");
    testing::expect_tetrahedron(std::get<Mesh>(file.shape));
    EXPECT_NE(file.table.note.find("plate model"), std::string::npos);
  }
  expect_refused("4\n" + numbered + "1\n1 1 3 5\n", {"plate 0", "vertex 5", "numbered from 1"});
  expect_refused("4\n" + numbered + "2\n1 1 3 2\n", {"truncated", "1 plate"});
  expect_refused("4\n" + numbered + "1\n1 1 3 x\n", {"line 7", "no plate"});
  expect_refused("4\n1 0 0 0\n2 1 0 0\n4 0 1 0\n3 0 0 1\n1\n1 1 3 2\n", {"line 4", "out of turn"});
}

TEST(table, quadrilateral_models_are_named) {
  std::string text = "1\n";
  for (int i = 0; i < 24; ++i) text += row_of("x y z\n", i, false);
  expect_refused(text, {"ICQ"}, "body.txt");
}

TEST(table, names_that_do_not_fit_are_said) {
  expect_refused("x,y,z,quality,more\n1,2,3,4\n", {"line 2", "4 values"}, "t.csv");
  const ShapeFile file = parse(table("# x y z of the hand\n", "x y z f"), "t.txt");
  EXPECT_EQ(taken_for(file.table), "x,y,z,scalar_1");
  EXPECT_NE(file.table.note.find("is not used"), std::string::npos);
}

TEST(table, rows_of_arrays_are_taken_alike) {
  std::vector<double> six, nine;
  for (int i = 0; i < kRows; ++i) {
    const Point a = point(i);
    six.insert(six.end(), {a.p.x, a.p.y, a.p.z, a.n.x, a.n.y, a.n.z});
    nine.insert(nine.end(),
                {a.p.x, a.p.y, a.p.z, static_cast<double>(a.r), static_cast<double>(a.g),
                 static_cast<double>(a.b), a.n.x, a.n.y, a.n.z});
  }
  TableColumns table;
  PointCloud cloud = points_of_rows(six, 6, {}, &table);
  EXPECT_EQ(taken_for(table), "x,y,z,nx,ny,nz");
  expect_points(cloud, 0, 0);
  cloud = points_of_rows(nine, 9, {}, &table);
  EXPECT_EQ(taken_for(table), "x,y,z,r,g,b,nx,ny,nz");
  EXPECT_EQ(find_attribute(cloud.attributes, "green")->type, ScalarType::kUint8);
  cloud = points_of_rows(six, 6, "x,y,z,a1,-,a3", &table);
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_EQ(cloud.attributes.size(), 2u);
  testing::expect_error([&] { points_of_rows(six, 2); }, ErrorCode::kInvalidInput,
                        {"3 coordinates"});
}

}  // namespace
}  // namespace rholm
