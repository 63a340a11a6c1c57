// Figures of a report, before they become text.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/report.h"
#include "rholm/rms_beyond.h"
#include "rholm/star.h"
#include "rholm/synthesize.h"
#include "rholm/topology.h"

namespace rholm::report {

// Chosen: the shortest wave of this degree is 3 pixels of a picture
// of the default size, and measuring points takes a second.
inline constexpr int kHighestDrawn = 512;

// Throws InvalidInput for options out of range, and for a shape without faces.
void check(const Mesh* shape, const ReportOptions& options);

struct ShapeFigures {
  Mesh mesh;  // welded, outward, without attributes
  Inspection inspection;
  StarReport star;  // star-shape test from the model's centre
  // Returns true if radial errors and Parseval apply: closed, each direction meets it once.
  bool is_star() const { return inspection.closed && inspection.oriented && star.star_shaped; }
};
ShapeFigures shape_figures(const Mesh& mesh, const Vec3& center, double weld_tolerance,
                           const Context& context);

// Returns true if the model may belong to this shape, by the norm and the diagonal
// that it stores. A model of another shape stores errors of that other shape.
bool may_be_of(const Expansion& expansion, const ShapeFigures& shape);

// Degree at which the series is cut off.
struct DegreeRow {
  int degree = 0;
  // Radial, over solid angle, in the unit of lengths; nullopt if unknown.
  std::optional<double> rms;
  bool rms_is_exact = false;
  std::optional<double> rms_at_most;   // bound, set where rms is unknown but bounded
  std::optional<double> max;           // largest radial error
  std::optional<double> max_distance;  // largest distance between the surfaces
};

struct Data {
  std::optional<ShapeFigures> shape;
  std::vector<double> energy;              // energy per degree
  RmsBeyond beyond;                        // computed with `errors`
  std::vector<std::optional<double>> rms;  // copy of RmsBeyond::figures()
  std::vector<DegreeRow> rows;             // ascending degrees, the last one is the model's own
  std::optional<TruncationErrors> errors;  // errors at the model's own degree
  std::optional<SurfaceMeasures> model;    // nullopt above kHighestDrawn, or without a surface
  double mean_radius = 0;  // mean over solid angle; 0 for a gauge and for a signed sum
  double diagonal = 0;     // diagonal of the shape; 0 if unknown
};

Data find_data(const Expansion& expansion, std::optional<ShapeFigures> shape,
               const Context& context);

// Returns 1, 2, 4, ... below `degree`, and `degree`.
std::vector<int> degree_ladder(int degree);

// Returns the expansion cut off at `degree`, without data that are no longer valid.
Expansion cut_off(const Expansion& expansion, int degree);

}  // namespace rholm::report
