// Every parallel loop of the library runs on more than one chunk: results have the same bits on
// four threads as on one. Under ThreadSanitizer these tests search for races in every run. They are
// small, except where a loop makes chunks of thousands. scripts/check_loops lists the loops that
// they do not reach (docs/testing.md).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "parts/memory_store.h"
#include "parts/threads.h"
#include "reconstruct/field/tile_grid.h"
#include "reconstruct/normals/tile_fit.h"
#include "reconstruct/normals/tile_normals.h"
#include "reconstruct/tile_run.h"
#include "rholm/rholm.h"
#include "shape/points/outliers.h"
#include "shape/points/sampling_gaps.h"
#include "shape/queries/sheet_gaps.h"
#include "shape/queries/winding_tree.h"
#include "support/bits.h"
#include "support/random_data.h"
#include "support/test_meshes.h"
#include "support/test_points.h"
#include "support/test_shapes.h"
#include "surface/grid/block_grid.h"
#include "surface/level_set/components.h"
#include "surface/level_set/cut_handles.h"
#include "transform/error/closest_distances.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {
namespace {

using test::Bits;

void expect_same_bits(const std::function<Bits(const Context&)>& work) {
  const Bits one = work({.threads = 1});
  EXPECT_FALSE(one.bytes().empty());
  EXPECT_TRUE(work({.threads = 4}).bytes() == one.bytes());
}

constexpr CenterOptions kNoRays{.kind = CenterKind::kAuto, .point = {}, .rays = 0};

StarChart chart_of(const Mesh& mesh) { return make_star_chart(mesh, {.center = kNoRays}); }

// More sources than a single thread handles (second_thread_cost()): 20480 triangles, 30720 edges.
Mesh many_triangles() { return bumpy_sphere(5); }

// More vertices and triangles than one part in triangle_order.cpp, in random order.
Mesh large_mesh_in_random_order() {
  const Mesh sphere = latitude_longitude_sphere(520, 512);
  std::vector<std::uint32_t> order(sphere.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  test::shuffle(order, 1);
  Mesh mesh = test::renumbered(sphere, order);
  test::shuffle(mesh.faces, 2);
  return mesh;
}

// ---- Expansions ----

// Parts are spread as they arrive; there are more parts than may wait at the same time.
TEST(every_loop, gives_the_same_bits_for_a_mesh_in_parts) {
  const Mesh mesh = many_triangles();
  expect_same_bits([&](const Context& context) {
    const MeshPassOptions options{.degree = 120, .precision = 1e-4, .parts = 10};
    return Bits().add(mesh_pass(view_of(mesh), options, context).coefficients);
  });
}

// The first mesh is read a second time for the error; the second mesh uses a sample.
TEST(every_loop, gives_the_same_bits_for_a_measured_error) {
  for (const StarChart& chart : {chart_of(many_triangles()), chart_of(bumpy_sphere(7))}) {
    expect_same_bits([&](const Context& context) {
      const Transform transform = expand(chart, {.degree = 16, .precision = 1e-6}, context);
      return Bits().add(transform.expansion.coefficients).add(transform.fast->error);
    });
  }
}

TEST(every_loop, gives_the_same_bits_for_each_method) {
  const StarChart few = chart_of(bumpy_sphere(2)), many = chart_of(many_triangles());
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (const Method method : {Method::kEdge, Method::kCurl, Method::kArea}) {
      bits.add(expand(few, {.degree = 12, .method = method}, context).expansion.coefficients);
    }
    bits.add(
        expand(few, {.degree = 12, .engine = Engine::kDirect}, context).expansion.coefficients);
    return bits.add(
        expand(many, {.degree = 16, .method = Method::kGauge}, context).expansion.coefficients);
  });
}

TEST(every_loop, gives_the_same_bits_for_errors) {
  // The first case has many points, the second many triangles.
  for (const auto& [mesh, degree] : {std::pair{many_triangles(), 100}, {bumpy_sphere(6), 8}}) {
    const Expansion expansion = expand(chart_of(mesh), {.degree = degree}).expansion;
    expect_same_bits([&](const Context& context) {
      const TruncationErrors errors = truncation_errors(view_of(mesh), expansion, {}, context);
      Bits bits;
      return bits.add(*errors.rms)
          .add(*errors.measured_max)
          .add(errors.max_bound.value_or(0))
          .add(*errors.distance_rms)
          .add(*errors.measured_max_distance);
    });
  }
}

// Four parts share the vertices between their rows.
TEST(every_loop, gives_the_same_bits_for_a_mesh_in_rows) {
  Mesh mesh = latitude_longitude_sphere(150, 300);
  for (Vec3& v : mesh.vertices) v = (1 + 0.1 * std::sin(3 * v.x + v.y)) * v;
  expect_same_bits([&](const Context& context) {
    return Bits().add(
        mesh_pass(view_of(mesh), {.degree = 16, .precision = 1e-4}, context).coefficients);
  });
}

TEST(every_loop, gives_the_same_bits_for_a_large_mesh_in_random_order) {
  const Mesh mesh = large_mesh_in_random_order();
  expect_same_bits([&](const Context& context) {
    const Expanded expanded = expand(
        mesh, {.degree = 16, .precision = 1e-4, .errors = false, .chart = {.center = kNoRays}},
        context);
    return Bits().add(expanded.transform.expansion.coefficients).add(expanded.star.min_d);
  });
}

TEST(every_loop, gives_the_same_bits_for_the_strength_of_the_tail) {
  const Mesh mesh = bumpy_sphere(6, 0.3);  // three chunks
  expect_same_bits([&](const Context& context) {
    return Bits().add(tail_strength(view_of(mesh), {0.1, 0, 0}, context));
  });
}

TEST(every_loop, gives_the_same_bits_for_centres_and_star_checks) {
  const Mesh mesh = bumpy_sphere(5, 0.3);
  Mesh drawn_out = mesh;  // its centre is as far from the middle of the kernel as allowed
  for (Vec3& v : drawn_out.vertices) v = (1 + 5 * std::pow(std::max(0.0, v.x), 6)) * v;
  expect_same_bits([&](const Context& context) {
    Bits bits;
    bits.add(find_center(drawn_out, {.rays = 3000}, context).min_d);
    for (const CenterKind kind :
         {CenterKind::kAuto, CenterKind::kKernel, CenterKind::kCosine, CenterKind::kVolume}) {
      const StarReport found = find_center(mesh, {.kind = kind, .rays = 3000}, context);
      bits.add(found.min_d).add(found.min_cos_gamma).add(found.once_share);
    }
    bits.add(check_star(mesh, {2, 0, 0}, 3000, context).missed_share);
    Mesh open = mesh;
    open.faces.pop_back();
    return bits.add(check_star(open, {}, 3000, context).missed_share);
  });
}

TEST(every_loop, gives_the_same_bits_for_random_points_of_the_surface) {
  const StarChart chart = chart_of(bumpy_sphere(1));
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (const SamplePlaces places : {SamplePlaces::kEdges, SamplePlaces::kTriangles}) {
      const MonteCarlo found =
          monte_carlo(chart, {.degree = 8, .places = places, .samples = 16}, context);
      bits.add(found.expansion.coefficients).add(found.deviation);
    }
    return bits;
  });
}

TEST(every_loop, gives_the_same_bits_for_the_degree_of_a_tolerance) {
  const StarChart chart = chart_of(bumpy_sphere(3, 0.3));
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (const Tolerance& tolerance :
         {Tolerance{.error = 0.01, .measure = ErrorMeasure::kDistance, .max_degree = 32},
          Tolerance{.error = 0.01,
          .norm = ErrorNorm::kMax,
          .measure = ErrorMeasure::kDistance,
          .max_degree = 32},
          Tolerance{.error = 0.05, .norm = ErrorNorm::kMax, .max_degree = 16}}) {
      const ToleranceTransform found = expand(chart, tolerance, {}, context);
      bits.add(found.reached).add(found.transform.expansion.coefficients);
    }
    return bits;
  });
}

TEST(every_loop, gives_the_same_bits_for_closest_distances_to_a_model) {
  const StarChart chart = chart_of(test::l_prism(2));
  const Expansion expansion = expand(chart, {.degree = 8}).expansion;
  expect_same_bits([&](const Context& context) {
    ClosestDistances distances(view_of(chart.mesh), {}, 400);
    const SurfaceDistances found = distances.measure(expansion, 8, {}, 1e-6, context);
    return Bits().add(found.rms).add(found.max);
  });
}

TEST(every_loop, gives_the_same_bits_for_distances_between_surfaces) {
  const StarChart chart = chart_of(bumpy_sphere(5, 0.5));
  const Expansion expansion = expand(chart, {.degree = 8}).expansion;
  expect_same_bits([&](const Context& context) {
    const TruncationErrors found = truncation_errors(view_of(chart.mesh), expansion, {}, context);
    EXPECT_TRUE(found.distances_are_closest);
    return Bits().add(*found.distance_rms).add(*found.measured_max_distance);
  });
}

// ---- Functions on the sphere ----

TEST(every_loop, gives_the_same_bits_for_sums_over_directions) {
  const Coefficients f = test::random_coefficients(24, 1);
  const std::vector<Vec3> many = test::random_directions(30000, 2);
  const std::vector<double> weights = test::random_values(many.size(), 3);
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (const SumOptions& options :
         {SumOptions{.precision = 1e-12}, {.precision = 1e-4}, {.engine = Engine::kDirect}}) {
      const std::size_t n = options.engine == Engine::kDirect ? 600 : many.size();
      const auto directions = std::span(many).first(n);
      const ValuesAndGradients found = evaluate_with_gradient(f, directions, options, context);
      bits.add(found.values).add(found.gradients);
      bits.add(evaluate(f, directions, options, context));
      Coefficients sum(24);
      add_adjoint({.directions = directions, .weights = std::span(weights).first(n)}, sum, options,
                  context);
      bits.add(sum);
    }
    return bits;
  });
}

TEST(every_loop, gives_the_same_bits_for_rings_and_grids) {
  const Coefficients f = test::random_coefficients(40, 1);
  expect_same_bits([&](const Context& context) {
    Bits bits;
    const Grid grid = smallest_grid(GridKind::kGaussLegendre, f.degree());
    const std::vector<double> values = synthesize_grid(f, grid, context);
    bits.add(values).add(analyze_grid(values, grid, f.degree(), context));
    return bits.add(evaluate_rings(f, grid_colatitudes(grid), 50, context));
  });
}

TEST(every_loop, gives_the_same_bits_for_motions) {
  Expansion a{.coefficients = test::random_coefficients(24, 1)};
  for (double& value : a.coefficients.values()) value *= 0.005;
  a.coefficients.c(0, 0) = 5;
  const Expansion b = rotate(a, rotation_about({1, 2, 3}, 1));
  expect_same_bits([&](const Context& context) {
    Bits bits;
    bits.add(rotate(a.coefficients, rotation_about({3, 2, 1}, 0.5), context));
    bits.add(recentered(a, {0.1, 0, 0.05}, context).coefficients);
    const Placement found = align(a, b, AlignCenters::kVolume, {.bandwidth = 8}, context);
    return bits.add(placed(a, found, context).coefficients);
  });
}

TEST(every_loop, gives_the_same_bits_for_surfaces_of_expansions_and_their_distance) {
  Expansion expansion{.coefficients = test::random_coefficients(12, 1)};
  expansion.coefficients.c(0, 0) = 100;
  const Mesh sphere = icosphere(5);  // more triangles than one task of building a tree
  expect_same_bits([&](const Context& context) {
    const Mesh mesh = synthesize(expansion, sphere, context);
    const Comparison found = compare(mesh, sphere, {.samples = 2000}, context);
    const Comparison in_portions =
        compare({.mesh = view_of(mesh)}, {.mesh = view_of(sphere)}, 0, {.samples = 2000}, context);
    return Bits()
        .add(mesh)
        .add(in_portions.a_to_b.rms)
        .add(found.a_to_b.rms)
        .add(found.b_to_a.mean)
        .add(measure(expansion, context).area.value())
        .add(distances_to_surface(mesh.vertices, sphere, context));
  });
}

// ---- Points ----

TEST(every_loop, gives_the_same_bits_for_points_and_their_normals) {
  expect_same_bits([&](const Context& context) {
    PointCloud cloud =
        sample_surface(box({1, 2, 3}), {.points = 5000, .noise = 0.001, .normals = false}, context);
    orient(cloud, {}, context);
    return Bits().add(cloud.points).add(cloud.normals);
  });
}

TEST(every_loop, gives_the_same_bits_for_points_in_rows) {
  const Mesh ball = icosphere(4);
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (const SamplePattern pattern : {SamplePattern::kSlices, SamplePattern::kRings,
                                        SamplePattern::kGrid, SamplePattern::kLines}) {
      SampleOptions options{.points = 6000, .pattern = pattern};
      if (pattern == SamplePattern::kLines) options.scans = 2;
      bits.add(sample_surface(ball, options, context).points);
    }
    return bits;
  });
}

TEST(every_loop, gives_the_same_bits_for_many_points_and_discs) {
  const PointCloud cloud = test::sphere_points(20000);
  std::vector<Disc> discs;
  discs.reserve(5000);
  for (std::size_t i = 0; i < 5000; ++i) discs.push_back({cloud.points[i], cloud.normals[i], 0.02});
  expect_same_bits([&](const Context& context) {
    const PointTree tree(cloud.points, context);
    std::vector<Vec3> points, normals;
    for (const std::uint32_t i : tree.order()) {
      points.push_back(cloud.points[i]), normals.push_back(cloud.normals[i]);
    }
    const SamplingGaps gaps = find_gaps(tree, points, normals, context);
    const Cover caps = cover({tree, points, normals, &gaps, false}, {}, context);
    const auto blocks = list_blocks({}, 0.05, discs, 10000, context);
    Bits bits;
    bits.add(tree.order()).add(caps.coefficients).add(std::span(blocks));
    const std::vector<std::uint8_t> outliers = find_outliers(tree, points, normals, 0, context);
    std::vector<std::uint32_t> linked;
    for_links_of_groups(
        tree, normals,
        [&](std::uint32_t i, std::uint32_t j) {
          linked.insert(linked.end(), {i, j});
        },
        context);
    bits.add(std::span(outliers)).add(std::span<const std::uint32_t>(linked));
    return bits;
  });
}

TEST(every_loop, gives_the_same_bits_for_normals_of_thin_and_rowed_points) {
  // Two sheets as near as the spacing of points, so that the field decides; rows with an isolated
  // point.
  PointCloud shell = test::joined(test::sphere_points(420, 1), test::sphere_points(340, 2));
  for (std::size_t i = 420; i < shell.points.size(); ++i) shell.points[i] *= 0.85;
  PointCloud rows =
      sample_surface(torus(2, 0.7, 100, 50),
                     {.points = 1300, .pattern = SamplePattern::kRings, .pattern_ratio = 4});
  rows.points.push_back({30, 0, 0});
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (PointCloud cloud : {shell, rows}) {
      cloud.normals.clear();
      orient(cloud, {.confidence = true}, context);
      bits.add(cloud.normals).add(cloud.attributes[0].values);
    }
    PointCloud bare = test::sphere_points(1500);
    bare.normals.clear();
    const Reconstruction made = reconstruct(bare, {.confidence = true}, context);
    return bits.add(made.mesh.vertices).add(made.mesh.attributes.back().values);
  });
}

TEST(every_loop, gives_the_same_bits_for_normals_in_tiles) {
  PointCloud bare = test::sphere_points(6000);
  bare.normals.clear();
  expect_same_bits([&](const Context& context) {
    MemoryStore store;
    const auto source = points_in_memory(bare);
    const Survey found = survey(*source, {.points_per_tile = 3000}, context);
    const TilePlan plan = make_plan(found, 3000);
    distribute(*source, found, plan, store, {}, context);
    for (std::size_t tile = 0; tile < plan.n_tiles(); ++tile) sort_points(store, tile);
    Threads alone;
    StageTimes times;
    Stages stages(alone, store, {}, times, context);
    orient_tiles(store, plan, spacings_of_sample(found, plan, found.n_different), {}, stages);
    Bits bits;
    for (std::size_t tile = 0; tile < plan.n_tiles(); ++tile) {
      bits.add(std::span<const TileNormal>(read_normals(store, tile)));
    }
    return bits;
  });
}

TEST(every_loop, gives_the_same_bits_for_blocks_of_a_tile) {
  const GridFrame frame{
      {}, 1.0, [](const Vec3& x) { return static_cast<std::uint32_t>(x.x < 120 ? 0 : 1); }};
  std::vector<BlockCoordinates> all;
  for (std::int32_t z = 0; z < 30; ++z) {
    for (std::int32_t y = 0; y < 30; ++y) {
      for (std::int32_t x = 0; x < 30; ++x) all.push_back({x, y, z});
    }
  }
  expect_same_bits([&](const Context& context) {
    const OwnBlocks blocks = own_blocks(frame, 0, all, context);
    const std::vector<std::uint32_t> border = border_blocks(frame, 0, blocks.own, context);
    EXPECT_EQ(blocks.around.size(), 900U);
    EXPECT_EQ(border.size(), 900U);
    return Bits().add(std::span(blocks.own)).add(std::span(blocks.around)).add(std::span(border));
  });
}

// A wavy sheet: its borders are cut open, and beyond them its surface turns back.
TEST(every_loop, gives_the_same_bits_for_surfaces_in_tiles) {
  PointCloud sheet;
  for (std::size_t i = 0; i < 18000; ++i) {
    const double x = test::random_in(-1, 1, 5, 2 * i), y = test::random_in(-1, 1, 5, 2 * i + 1);
    sheet.points.push_back({x, y, 0.2 * std::sin(3 * x)});
    sheet.normals.push_back(normalized(Vec3{-0.6 * std::cos(3 * x), 0, 1}));
  }
  expect_same_bits([&](const Context& context) {
    MemoryStore store;
    const auto source = points_in_memory(sheet);
    Threads alone;
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                       ("tiles_of_loops_" + std::to_string(::getpid()) + ".ply");
    const TileRunOptions wanted{.reconstruct = {.step = 0.02,
                                                .holes = HolePolicy::kKeep,
                                                .confidence = true,
                                                .simplify = SimplifyOptions{.share = 0.3},
                                                .tile_points = 9000,
                                                .output = file}};
    run_tiles(*source, store, wanted, alone, context);
    const Mesh made = std::get<Mesh>(read_shape(file).shape);
    std::filesystem::remove(file);
    return Bits{}.add(made.vertices).add(made.faces).add(made.attributes.back().values);
  });
}

TEST(every_loop, gives_the_same_bits_for_scans_brought_together) {
  const Mesh body = bumpy_sphere(4);
  expect_same_bits([&](const Context& context) {
    PointCloud cloud = sample_surface(
        body, {.points = 1500, .scans = 2, .misalignment = 0.01, .sensor = true}, context);
    align_scans(cloud, context);
    const Reconstruction made = reconstruct(cloud, {.keep_scans = true}, context);
    return Bits().add(cloud.points).add(cloud.normals).add(made.mesh.vertices);
  });
}

TEST(every_loop, gives_the_same_bits_for_caps_of_different_sizes) {
  const PointCloud cloud = sample_surface(icosphere(4), {.points = 5000, .density_ratio = 300});
  expect_same_bits([&](const Context& context) {
    return Bits().add(reconstruct(cloud, {}, context).mesh.vertices);
  });
}

TEST(every_loop, gives_the_same_bits_for_bridges_that_are_cut) {
  // A ring with a neck: 20 000 vertices, some hundred of them on two loops.
  Mesh ring = test::ring_with_neck(0.1);
  test::add_normals(ring);
  const Resolution resolution{.typical = 0.15, .at = [](const Vec3&) { return 0.15; }};
  expect_same_bits([&](const Context& context) {
    Mesh mesh = ring;
    EXPECT_EQ(cut_handles(mesh, resolution, context).handles, 1U);
    return Bits().add(mesh);
  });
}

TEST(every_loop, gives_the_same_bits_for_components_that_are_dropped) {
  Mesh bodies = many_triangles();
  const std::size_t n = bodies.vertices.size(), n_faces = bodies.faces.size();
  for (const double scale : {0.01, 0.5, 0.02}) {
    const auto first = static_cast<std::uint32_t>(bodies.vertices.size());
    for (std::size_t v = 0; v < n; ++v) {
      bodies.vertices.push_back(scale * bodies.vertices[v] + Vec3{5, 0, 0});
    }
    for (std::size_t t = 0; t < n_faces; ++t) {
      const Triangle& own = bodies.faces[t];
      bodies.faces.push_back({first + own[0], first + own[1], first + own[2]});
    }
  }
  test::add_normals(bodies);
  expect_same_bits([&](const Context& context) {
    Mesh mesh = bodies;
    EXPECT_EQ(drop_small_components(mesh, 0.1, context).dropped, 2U);
    return Bits().add(mesh);
  });
}

TEST(every_loop, gives_the_same_bits_for_winding_numbers_and_identical_points) {
  const PointCloud cloud = test::sphere_points(500), places = test::sphere_points(10000);
  const WindingTree tree(cloud.points, cloud.normals);
  PointCloud twice = test::joined(places, places);
  expect_same_bits([&](const Context& context) {
    PointCloud once = twice;
    EXPECT_EQ(clean(once, context).duplicates, places.points.size());
    return Bits().add(tree.winding(places.points, context)).add(once.points).add(once.normals);
  });
}

Mesh surface_of(const PointCloud& cloud, HolePolicy holes, const Context& context) {
  return reconstruct(cloud, {.holes = holes, .simplify = SimplifyOptions{.share = 0.5}}, context)
      .mesh;
}

TEST(every_loop, gives_the_same_bits_for_surfaces_of_points) {
  PointCloud cloud = sample_surface(icosphere(4), {.points = 2500, .holes = 2, .hole_radius = 0.2});
  cloud.attributes = {{"height", ScalarType::kFloat64, {}}};
  for (const Vec3& p : cloud.points) cloud.attributes[0].values.push_back(p.z);
  const PointCloud noisy = sample_surface(
      icosphere(4),
      {.points = 1200, .noise = 0.002, .outliers = 0.02, .holes = 2, .hole_radius = 0.2});
  expect_same_bits([&](const Context& context) {
    return Bits()
        .add(surface_of(cloud, HolePolicy::kFill, context))
        .add(surface_of(noisy, HolePolicy::kKeep, context));
  });
}

TEST(every_loop, gives_the_same_bits_for_fewer_triangles) {
  const Mesh mesh = many_triangles();  // 10242 vertices
  expect_same_bits([&](const Context& context) {
    return Bits().add(simplify(mesh, {.share = 0.9}, context).mesh);
  });
}

// ---- Atlases ----

TEST(every_loop, gives_the_same_bits_for_few_caps) {
  const PointCloud cloud = sample_surface(box({1, 1, 20}), {.points = 4200});
  expect_same_bits([&](const Context& context) {
    const Compressed found = compress(cloud, {.tolerance = 0.5, .max_degree = 3}, context);
    return Bits()
        .add(found.model.atlas.coefficients)
        .add(found.model.errors->rms())
        .add(synthesize(found.model, {.degree = 2}, context));
  });
}

TEST(every_loop, gives_the_same_bits_for_gaps_between_sheets) {
  const Mesh mesh = icosphere(3);
  std::vector<std::uint32_t> triangles(mesh.faces.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  std::vector<Vec3> middles;
  middles.reserve(mesh.faces.size());
  for (const auto& [a, b, c] : mesh.faces) {
    middles.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
  }
  const PointsOnMesh points{mesh, middles, triangles};
  const RayScene scene(mesh);
  expect_same_bits([&](const Context& context) {
    const std::vector<int> windings = outer_winding(points, scene, context);
    return Bits().add(sheet_gaps(points, scene, context)).add(std::span(windings));
  });
}

#ifdef RHOLM_HAS_QHULL
TEST(every_loop, gives_the_same_bits_for_the_papers_caps) {
  const PointCloud cloud = test::sphere_points(400);
  expect_same_bits([&](const Context& context) {
    const PatchAtlas found = patch_atlas(cloud, {.degree = 4}, context);
    return Bits().add(found.model.atlas.coefficients).add(found.surface);
  });
}
#endif

// ---- Editing and pictures ----

TEST(every_loop, gives_the_same_bits_for_edits) {
  const Mesh mesh = bumpy_sphere(5);
  const std::vector<Region> here = {BallRegion{mesh.vertices[0], 0.2}},
                            there = {BallRegion{mesh.vertices[1], 0.2}};
  expect_same_bits([&](const Context& context) {
    Bits bits;
    for (const PatchFitting fitting : {PatchFitting::kRobust, PatchFitting::kAround}) {
      bits.add(analyze_patch(mesh, here, {.wavelength = 0.5, .fitting = fitting}, context).moves);
    }
    return bits.add(transfer(mesh, here, mesh, there, {.from_degree = 4}, {}, context));
  });
}

TEST(every_loop, gives_the_same_picture) {
  const Mesh mesh = bumpy_sphere(3);
  const Panel panel{.mesh = &mesh};
  expect_same_bits([&](const Context& context) {
    const Image image =
        render(std::span(&panel, 1), {.width = 64, .height = 48, .samples = 2}, context);
    const Image fine =
        render(std::span(&panel, 1), {.width = 64, .height = 48, .fine = true}, context);
    return Bits()
        .add(std::span<const std::uint8_t>(image.rgb))
        .add(std::span<const std::uint8_t>(fine.rgb));
  });
}

TEST(every_loop, gives_the_same_page) {
  const Mesh mesh = bumpy_sphere(2);
  const Expansion expansion = expand(chart_of(mesh), {.degree = 4}).expansion;
  expect_same_bits([&](const Context& context) {
    std::string page = report_html(expansion, &mesh, {.picture_size = 48}, context);
    return Bits().add(std::span(page));
  });
}

}  // namespace
}  // namespace rholm
