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
// Steps of the grid. Of the spacing (method 7.7): from 0.7 to 0.6 normals gain 3 %, faces and time
// grow by a third; below distances gain nothing more. Of a cap's support: its surface has no waves
// shorter than a third of it, and a step of half of that shows them.
inline constexpr double kStepOfSpacing = 0.6;
inline constexpr double kStepOfSupport = 0.15;
// Where points are a thousand times sparser than elsewhere caps differ by more than the band of 2.5
// fine steps: all but this share of the surface has smaller errors, and they may be this part of a
// step (scripts/constants): 0.07 steps on even points, 0.25 where density falls 30 times, both
// untouched; 2 where it falls 1000 times, torn to sheets below 1.2 steps of their error.
inline constexpr double kSparseShare = 0.02;
inline constexpr double kStepOfError = 2;
// Standard deviations of the noise within which caps are averaged: one that is off by as much must
// not count alone.
inline constexpr double kBandOfNoise = 3;

// As many as a cap has coefficients.
inline constexpr std::size_t kFewestPoints = 16;
// Each look for outliers near the surface sees what the one before has left (method 7.4).
inline constexpr int kOutlierPasses = 3;

// Among n points, `strays` of which there were beside these, far from all others, and about `wrong`
// whose given normals contradict those around: whether some near the surface are outliers as well.
bool are_suspicious(double n, double strays, double wrong);
// Where more look like outliers they are features that the points hardly show.
std::size_t most_outliers(double strays, double wrong);
// Where there are outliers, groups of fewer points are made of them.
std::size_t least_group(std::size_t n);

// Edges of the cubes of seen space: lines of sight to even points go through every one before them.
inline constexpr double kCubesOfSpacing = 2;
// Lines of sight end so many spacings, or deviations of the noise, before their points: beyond is
// the surface's own band, and what a line passes close to the rim of a hole.
inline constexpr double kEndOfSight = 4;

// Of the diagonal: points no farther from one line than this have no surface, whatever their
// normals; far above what single precision does to a line.
inline constexpr double kLine = 1e-5;
// Throw InvalidInput for points that no surface goes with: n of them, that span so much; that lie
// on one line; and whose normals all point to one side, so that they bound nothing.
void check_spread(std::size_t n, double diagonal);
[[noreturn]] void refuse_one_line(std::size_t n);
void check_sides(const SideBalance& balance, std::size_t n);
// Throws InvalidInput for n points that look like a curve or a volume.
void check_shape(const LocalShape& shape, std::size_t n);
// Into the report; the points span the diagonal.
void note_crossings(const Crossings& crossings, double diagonal, ReconstructReport& report);
void note_walls(const WallCheck& walls, ReconstructReport& report);
// Neighbours that tell the area of a point, where so many lie in a flat neighbourhood: the nearest
// ones of noisy points fill a volume.
std::size_t area_neighbors(std::size_t flat);

// What the options say of the surface, for its model.
SurfaceRules kept_rules(const ReconstructOptions& options);
// The attributes that are no normals.
std::vector<std::string> carried_names(const std::vector<Attribute>& attributes);

CoverOptions cover_options(const ReconstructOptions& options, const CapSize& size);

// Whether the step follows from the spacing: of exact points, of which all caps are as small as
// they can be.
bool is_even(const CapSize& size, const ReconstructOptions& options);
// `wanted`: of even points the error that kSparseShare of the surface exceeds, else the support
// that four of five caps have.
double choose_step(double fine_spacing, double wanted, bool even);

}  // namespace rholm
