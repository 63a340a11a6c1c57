// Names in the model file (docs/model-file.md), and checks of the beginning that all model files
// have. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/hdf5/hdf5_values.h"

namespace rholm::layout {

inline constexpr const char* kFormatName = "rholm-model";
inline constexpr int kMajor = 1;
inline constexpr int kMinor = 5;

// Root attributes
inline constexpr const char* kFormat = "format";
inline constexpr const char* kVersionMajor = "version_major";
inline constexpr const char* kVersionMinor = "version_minor";
inline constexpr const char* kProgram = "program";

// The group of an expansion, its dataset and attributes
inline constexpr const char* kExpansion = "expansion";
inline constexpr const char* kCoefficients = "coefficients";
inline constexpr const char* kDegree = "degree";
inline constexpr const char* kNormalization = "normalization";
inline constexpr const char* kCsphase = "csphase";
inline constexpr const char* kFunction = "function";
inline constexpr const char* kCenter = "center";
inline constexpr const char* kUnit = "unit";
inline constexpr const char* kMethod = "method";
inline constexpr const char* kSignedSum = "signed_sum";
inline constexpr const char* kErrorRms = "error_rms";
inline constexpr const char* kErrorRmsIsExact = "error_rms_is_exact";
inline constexpr const char* kDistancesAreClosest = "error_distances_are_closest";
inline constexpr const char* kPredictedMax = "error_predicted_max";
inline constexpr const char* kPredictedMaxDistance = "error_predicted_max_distance";
inline constexpr const char* kMeasuredMax = "error_measured_max";
inline constexpr const char* kMaxBound = "error_max_bound";
inline constexpr const char* kMeasuredMaxDistance = "error_measured_max_distance";
inline constexpr const char* kDistanceRms = "error_distance_rms";
inline constexpr const char* kErrorPoints = "error_points";
inline constexpr const char* kDiagonal = "diagonal";

inline constexpr const char* kCrc32 = "crc32";

// The group of an atlas, its datasets and attributes; unit, method, diagonal and crc32 as above
inline constexpr const char* kAtlas = "atlas";
inline constexpr const char* kCaps = "caps";
inline constexpr const char* kEllipses = "ellipses";
inline constexpr const char* kWeights = "weights";
inline constexpr const char* kDegrees = "degrees";
inline constexpr const char* kKept = "kept";
inline constexpr const char* kValues = "values";
inline constexpr const char* kBasis = "basis";
inline constexpr const char* kBlend = "blend";
inline constexpr const char* kOrigin = "origin";
inline constexpr const char* kScales = "scales";  // spacing, noise, band, step, tolerance
inline constexpr std::size_t kScaleNumbers = 5;
inline constexpr const char* kWeightPower = "weight_power";
inline constexpr const char* kAtlasErrors = "errors";  // rms and max from the shape, to the shape
inline constexpr std::size_t kErrorNumbers = 4;
inline constexpr const char* kInputNumbers = "input_numbers";

// The group of a reconstruction, its datasets and attributes; caps, coefficients and crc32 as above
inline constexpr const char* kReconstruction = "reconstruction";
inline constexpr const char* kSpacings = "spacings";
inline constexpr const char* kSeen = "seen";
inline constexpr const char* kLeftOut = "left_out";
inline constexpr const char* kHoles = "holes";
inline constexpr const char* kMinComponent = "min_component";
inline constexpr const char* kSimplify = "simplify";  // triangles, share, largest error; -1: any
inline constexpr std::size_t kSimplifyNumbers = 3;
inline constexpr const char* kTiles = "bricks";          // as files of 1.5 have it
inline constexpr const char* kSeenFrame = "seen_frame";  // origin, edge, cubes along each axis
inline constexpr std::size_t kSeenNumbers = 7;

}  // namespace rholm::layout

namespace rholm {

bool looks_like_model(std::span<const char> bytes);
// Throws InvalidInput unless the bytes look like a model; `name` serves messages.
void check_model_signature(std::span<const char> bytes, const std::string& name);
// Throws Unsupported unless the file says that it is a model of this major version.
void check_model_version(const hdf5::File& file, const hdf5::Object& root);

}  // namespace rholm
