// Names in the model file: docs/model-file.md. Layer: model, private.
#pragma once

namespace rholm::layout {

inline constexpr const char* kFormatName = "rholm-model";
inline constexpr int kMajor = 1;
inline constexpr int kMinor = 1;

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
inline constexpr const char* kNormSquared = "norm_squared";
inline constexpr const char* kTailStrength = "tail_strength";
inline constexpr const char* kErrorRms = "error_rms";
inline constexpr const char* kErrorRmsIsExact = "error_rms_is_exact";
inline constexpr const char* kPredictedMax = "error_predicted_max";
inline constexpr const char* kPredictedMaxDistance = "error_predicted_max_distance";
inline constexpr const char* kMeasuredMax = "error_measured_max";
inline constexpr const char* kMeasuredMaxDistance = "error_measured_max_distance";
inline constexpr const char* kDistanceRms = "error_distance_rms";
inline constexpr const char* kErrorPoints = "error_points";
inline constexpr const char* kDiagonal = "diagonal";

inline constexpr const char* kCrc32 = "crc32";

inline constexpr unsigned kMaxAttributes = 64;  // in the header of an object; chosen: ample

}  // namespace rholm::layout
