// Expected values are the atlas that was written, with rounding bounds of float and 16-bit steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "io/shapes/test_support.h"
#include "model/file/model_read.h"
#include "reconstruct/file/atlas_pack.h"
#include "reconstruct/file/atlas_read.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

using testing::read_all;
using testing::TemporaryFolder;

// Frames have all orientations, also half turns; a third of the coefficients are zero.
AtlasModel random_model(std::size_t n_caps, CapBasis basis) {
  AtlasModel model;
  std::uint64_t drawn = 0;
  const auto next = [&] { return random_uniform(5, drawn++); };
  for (std::size_t c = 0; c < n_caps; ++c) {
    Cap cap;
    cap.frame.z = normalized({next() - 0.5, next() - 0.5, next() - 0.5});
    if (c == 0) cap.frame.z = {0, 0, -1};
    cap.frame.x = normalized(cross(cap.frame.z, c == 0 ? Vec3{0, 1, 0} : Vec3{next(), next(), 1}));
    cap.frame.y = cross(cap.frame.z, cap.frame.x);
    cap.frame.support = 0.1 + next();
    cap.frame.radius = 2 * cap.frame.support;
    cap.frame.dilation = 1 + 3 * next();
    cap.frame.center = {100 + next(), next(), next()};
    const double square = 1 / (cap.frame.support * cap.frame.support);
    cap.where = {0, 0, square, 0, square};
    cap.basis = basis;
    cap.degree = static_cast<std::uint16_t>(c % 7);
    cap.error = 1e-3 * next();
    cap.first = model.atlas.coefficients.size();
    for (std::size_t i = 0; i < n_coefficients(basis, cap.degree); ++i) {
      model.atlas.coefficients.push_back(i % 3 == 1 ? 0 : 0.2 * (next() - 0.5));
    }
    model.atlas.caps.push_back(cap);
  }
  model.atlas.diagonal = 3, model.atlas.band = 0.1;
  model.step = 0.05, model.tolerance = 0.01, model.input_numbers = 12345;
  model.errors = AtlasErrors{0.009, 0.02, 0.0095, 0.03};
  model.unit = "km", model.method = "greedy";
  return model;
}

std::string bytes_of(const AtlasModel& model) {
  const TemporaryFolder folder;
  write_atlas(model, folder / "a.h5");
  return read_all(folder / "a.h5");
}

ErrorCode code_of(const std::string& bytes, std::string* words = nullptr) {
  try {
    parse_atlas(bytes, "test");
  } catch (const Error& error) {
    if (words != nullptr) *words = error.what();
    return error.code();
  }
  return ErrorCode::kCancelled;  // means that nothing was thrown
}

TEST(atlas_file, round_trip_is_within_rounding_and_then_exact) {
  for (const CapBasis basis : {CapBasis::kEven, CapBasis::kFull}) {
    const AtlasModel model = random_model(20, basis);
    const AtlasModel back = parse_atlas(bytes_of(model), "test");
    ASSERT_EQ(back.atlas.caps.size(), model.atlas.caps.size());
    for (std::size_t c = 0; c < model.atlas.caps.size(); ++c) {
      const Cap &a = model.atlas.caps[c], &b = back.atlas.caps[c];
      // Seeds lie within 3 of their middle and radii are below 2.2; both are stored with 24 bits.
      EXPECT_LT(norm(a.frame.seed() - b.frame.seed()), 1e-6);
      EXPECT_LT(norm(a.frame.x - b.frame.x) + norm(a.frame.z - b.frame.z), 1e-6);
      EXPECT_NEAR(a.frame.support, b.frame.support, 1e-6);
      EXPECT_EQ(a.degree, b.degree);
      EXPECT_EQ(b.basis, basis);
      const auto from = model.atlas.coefficients_of(a), to = back.atlas.coefficients_of(b);
      for (std::size_t i = 0; i < from.size(); ++i) {
        EXPECT_NEAR(from[i], to[i], 0.1 / 32767);  // half a step of at most 0.1
        EXPECT_EQ(from[i] == 0, i % 3 == 1);
      }
    }
    EXPECT_EQ(back.unit, "km");
    EXPECT_EQ(back.input_numbers, 12345U);
    EXPECT_EQ(back.step, model.step);
    EXPECT_EQ(back.errors->max_to, 0.03);
    const AtlasModel again = parse_atlas(bytes_of(back), "test");
    EXPECT_EQ(again.atlas.coefficients, back.atlas.coefficients);
    EXPECT_EQ(size_of(again.atlas).numbers(), size_of(back.atlas).numbers());
  }
}

TEST(atlas_file, overhead_is_small) {
  const AtlasModel model = random_model(100, CapBasis::kEven);
  const AtlasSize size = size_of(model.atlas);
  // A cap takes 44 bytes and a degree, a kept coefficient 2 bytes, each coefficient a bit.
  const std::size_t content =
      45 * size.caps + 2 * size.coefficients + model.atlas.coefficients.size() / 8;
  EXPECT_LT(bytes_of(model).size(), content + 4096);
}

TEST(atlas_file, ellipses_and_weights_are_kept) {
  AtlasModel model = random_model(3, CapBasis::kFull);
  model.atlas.caps[1].where = {0.01, 0.02, 30, 5, 40};
  model.atlas.caps[2].weight = 7;
  model.atlas.caps[0].weight = 2;
  const AtlasModel back = parse_atlas(bytes_of(model), "test");
  EXPECT_FLOAT_EQ(static_cast<float>(back.atlas.caps[1].where.xy), 5);
  EXPECT_FLOAT_EQ(static_cast<float>(back.atlas.caps[2].weight), 7);
  EXPECT_FLOAT_EQ(static_cast<float>(back.atlas.caps[0].weight), 2);
}

TEST(atlas_file, the_blend_is_kept) {
  AtlasModel model = random_model(3, CapBasis::kEven);
  EXPECT_EQ(parse_atlas(bytes_of(model), "test").atlas.blend, CapBlend::kSmooth);
  model.atlas.blend = CapBlend::kSpline;
  EXPECT_EQ(parse_atlas(bytes_of(model), "test").atlas.blend, CapBlend::kSpline);
}

// Caps that are spheres store no coefficients, and their file is read back.
TEST(atlas_file, caps_whose_coefficients_are_all_zero_are_read_back) {
  AtlasModel model = random_model(4, CapBasis::kEven);
  std::fill(model.atlas.coefficients.begin(), model.atlas.coefficients.end(), 0.0);
  const TemporaryFolder folder;
  write_atlas(model, folder / "zero.h5");
  const AtlasModel back = read_atlas(folder / "zero.h5");
  EXPECT_EQ(back.atlas.caps.size(), model.atlas.caps.size());
  EXPECT_EQ(back.atlas.coefficients, model.atlas.coefficients);
}

TEST(atlas_file, cut_off_files_are_refused) {
  const std::string bytes = bytes_of(random_model(5, CapBasis::kEven));
  for (std::size_t n = 0; n < bytes.size(); n += 7) {
    EXPECT_NE(code_of(bytes.substr(0, n)), ErrorCode::kCancelled) << n;
  }
}

TEST(atlas_file, a_flipped_bit_is_refused_or_means_nothing) {
  const AtlasModel model = random_model(5, CapBasis::kEven);
  const std::string bytes = bytes_of(model);
  const AtlasModel right = parse_atlas(bytes, "test");
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
    try {
      const AtlasModel found = parse_atlas(damaged, "test");
      EXPECT_EQ(found.atlas.coefficients, right.atlas.coefficients) << at;
    } catch (const Error& refused) {
      EXPECT_STRNE(refused.what(), "") << at;
    }
  }
}

TEST(atlas_file, what_no_atlas_can_be_is_refused_in_words) {
  const AtlasModel model = random_model(4, CapBasis::kEven);
  const auto refused = [](const PackedAtlas& packed) {
    try {
      unpack(packed, "test");
    } catch (const Error& error) {
      return error.code() == ErrorCode::kInvalidInput;
    }
    return false;
  };
  const PackedAtlas good = pack(model.atlas);
  EXPECT_FALSE(refused(good));
  PackedAtlas bad = good;
  bad.degrees[1] = 200;
  EXPECT_TRUE(refused(bad));
  bad = good, bad.values.pop_back();
  EXPECT_TRUE(refused(bad));
  bad = good, bad.caps[3] = NAN;
  EXPECT_TRUE(refused(bad));
  bad = good, bad.caps[6] = -1;  // the radius of the first cap
  EXPECT_TRUE(refused(bad));
  bad = good, bad.kept.clear();
  EXPECT_TRUE(refused(bad));
}

TEST(atlas_file, kinds_of_models_are_told_apart) {
  const TemporaryFolder folder;
  write_atlas(random_model(2, CapBasis::kEven), folder / "atlas.h5");
  write_model(Expansion{}, folder / "star.h5");
  EXPECT_TRUE(is_atlas_file(folder / "atlas.h5"));
  EXPECT_FALSE(is_atlas_file(folder / "star.h5"));
  EXPECT_THROW(read_atlas(folder / "star.h5"), Error);
  try {
    read_model(folder / "atlas.h5");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported);
    EXPECT_NE(std::string(error.what()).find("atlas of caps"), std::string::npos);
  }
  EXPECT_THROW(write_atlas(AtlasModel{}, folder / "empty.h5"), Error);
}

}  // namespace
}  // namespace rholm
