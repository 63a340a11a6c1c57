// Rules and figures of reconstructions. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "atlas/cover/cap_size.h"
#include "rholm/reconstruct.h"
#include "shape/points/crossings.h"
#include "shape/points/local_shape.h"
#include "shape/points/side_balance.h"
#include "shape/points/wall_check.h"

namespace rholm {

inline constexpr int kDegree = 3;  // of small caps: method 7.3
// Steps of the grid. In spacings (method 7.7): from 0.7 to 0.6 normals gain 3 %, faces and time
// grow by a third; below, distances gain nothing more. In supports of caps: the surface of a cap
// has no waves shorter than a third of its support, and a step of half of that shows them.
inline constexpr double kStepOfSpacing = 0.6;
inline constexpr double kStepOfSupport = 0.15;
// Share of the surface with larger errors than the step allows, and least step in errors. Where
// points are 1000 times sparser, caps differ by more than the band of 2.5 fine steps. Errors are
// 0.07 steps on even points, 0.25 where density falls 30 times (scripts/constants), both untouched.
// They are 2 where it falls 1000 times; below 1.2 steps of the error the surface tears.
inline constexpr double kSparseShare = 0.02;
inline constexpr double kStepOfError = 2;
// Caps are averaged within this number of standard deviations of the noise. A cap that is off by as
// much must not count alone.
inline constexpr double kBandOfNoise = 3;

// Least number of points: the number of coefficients of a cap.
inline constexpr std::size_t kFewestPoints = 16;
// Each search for outliers near the surface sees what the one before has left (method 7.4).
inline constexpr int kOutlierPasses = 3;

// Returns true if some of n points near the surface may be outliers. Either `isolated` points were
// far from all others, or about `wrong` given normals contradict the normals around them.
bool are_suspicious(double n, double isolated, double wrong);
// Returns the largest number of outliers; more are features that the points hardly show.
std::size_t most_outliers(double isolated, double wrong);
// Returns the least size of a group of points that is not taken for outliers.
std::size_t least_group(std::size_t n);

// Edge of the cubes of seen space: lines of sight to even points cross every cube before them.
inline constexpr double kCubesOfSpacing = 2;
// Lines of sight end before their points, by this number of spacings or deviations of the noise.
// Beyond are the surface's own band, and places close to the rim of a hole.
inline constexpr double kEndOfSight = 4;

// Part of the diagonal: points within this distance of one line have no surface, whatever their
// normals. It is far above the rounding of a line to single precision.
inline constexpr double kLine = 1e-5;
// Throw InvalidInput for points without a surface: too few points or an extreme diagonal; points on
// one line; normals that all point to one side, so that they bound nothing.
void check_spread(std::size_t n, double diagonal);
[[noreturn]] void refuse_one_line(std::size_t n);
void check_sides(const SideBalance& balance, std::size_t n);
// Throws InvalidInput for n points that look like a curve or a volume.
void check_shape(const LocalShape& shape, std::size_t n);
// Write the results into the report; the points span the diagonal.
void note_crossings(const Crossings& crossings, double diagonal, ReconstructReport& report);
void note_walls(const WallCheck& walls, ReconstructReport& report);
// Returns the number of neighbours that tell the area of a point; `flat` of them lie in a flat
// neighbourhood. The nearest neighbours of noisy points fill a volume.
std::size_t area_neighbors(std::size_t flat);

// Returns the rules of the surface that follow from the options, for its model.
SurfaceRules kept_rules(const ReconstructOptions& options);
// Returns the names of the attributes that are not normals.
std::vector<std::string> carried_names(const std::vector<Attribute>& attributes);

CoverOptions cover_options(const ReconstructOptions& options, const CapSize& size);

// Returns true if the step follows from the spacing. This is so for exact points, all of whose caps
// are as small as they can be.
bool is_even(const CapSize& size, const ReconstructOptions& options);
// `wanted` is the error that kSparseShare of the surface exceeds, for even points. Otherwise it is
// the support that four of five caps exceed.
double choose_step(double fine_spacing, double wanted, bool even);

}  // namespace rholm
